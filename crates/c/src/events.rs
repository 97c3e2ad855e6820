//! What can happen to a tool in a step, as bits; the words of a session.

use palpate_files::session::{Event, Events};

/// It touches the organ, which it did not in the step before.
pub const PALPATE_EVENT_CONTACT: u32 = 1 << 0;
/// It no longer touches the organ.
pub const PALPATE_EVENT_RELEASE: u32 = 1 << 1;
/// It takes hold.
pub const PALPATE_EVENT_GRIP: u32 = 1 << 2;
/// It lets go.
pub const PALPATE_EVENT_GRIP_RELEASE: u32 = 1 << 3;
/// Its blade opens at least one layer, or the organ where there are no layers.
pub const PALPATE_EVENT_CUT: u32 = 1 << 4;
/// It opens the innermost layer.
pub const PALPATE_EVENT_PERFORATION: u32 = 1 << 5;
/// Its shaft, not its tip, touches the organ.
pub const PALPATE_EVENT_SHAFT_CONTACT: u32 = 1 << 6;
/// It is deeper than the models can be trusted: beyond 10 mm.
pub const PALPATE_EVENT_DEPTH_BEYOND_TRUST: u32 = 1 << 7;
/// The model gave a force that is no number; it was replaced by zero.
pub const PALPATE_EVENT_NON_FINITE_FORCE: u32 = 1 << 8;
/// Before the step the last cut was closed again.
pub const PALPATE_EVENT_UNDO_CUT: u32 = 1 << 11;
/// It moved faster than a hand can: it lost what it touched and held, and touches anew where it is now.
pub const PALPATE_EVENT_JUMP: u32 = 1 << 13;
/// The organ gave back more work than was done on it.
pub const PALPATE_EVENT_ENERGY_GAIN: u32 = 1 << 14;
/// It opens the outermost layer of the organ at its tip.
pub const PALPATE_EVENT_OPENS_LAYER_1: u32 = 1 << 15;
/// It opens the second layer from outside.
pub const PALPATE_EVENT_OPENS_LAYER_2: u32 = 1 << 16;
/// It opens the third layer from outside.
pub const PALPATE_EVENT_OPENS_LAYER_3: u32 = 1 << 17;
/// It opens the fourth layer from outside.
pub const PALPATE_EVENT_OPENS_LAYER_4: u32 = 1 << 18;
/// It opens the fifth layer from outside.
pub const PALPATE_EVENT_OPENS_LAYER_5: u32 = 1 << 19;
/// It opens the sixth layer from outside.
pub const PALPATE_EVENT_OPENS_LAYER_6: u32 = 1 << 20;
/// Its shaft no longer touches the organ.
pub const PALPATE_EVENT_SHAFT_RELEASE: u32 = 1 << 21;
/// From this step on the direction of its shaft is not known, so that only its tip and jaws touch an organ that bends.
pub const PALPATE_EVENT_SHAFT_UNKNOWN: u32 = 1 << 22;
/// The direction of its shaft is known again.
pub const PALPATE_EVENT_SHAFT_KNOWN: u32 = 1 << 23;
/// No equilibrium of the organ was found: it is at rest again, and the tool has lost what it touched and held.
pub const PALPATE_EVENT_NO_EQUILIBRIUM: u32 = 1 << 24;

/// The bit of an event: none for what a caller has done itself.
fn bit(event: Event) -> u32 {
    match event {
        Event::Contact => PALPATE_EVENT_CONTACT,
        Event::Release => PALPATE_EVENT_RELEASE,
        Event::Grip => PALPATE_EVENT_GRIP,
        Event::GripRelease => PALPATE_EVENT_GRIP_RELEASE,
        Event::Cut => PALPATE_EVENT_CUT,
        Event::Perforation => PALPATE_EVENT_PERFORATION,
        Event::ShaftContact => PALPATE_EVENT_SHAFT_CONTACT,
        Event::DepthBeyondTrust => PALPATE_EVENT_DEPTH_BEYOND_TRUST,
        Event::NonFiniteForce => PALPATE_EVENT_NON_FINITE_FORCE,
        Event::Mark | Event::Lifted | Event::Restart => 0,
        Event::UndoCut => PALPATE_EVENT_UNDO_CUT,
        Event::Jump => PALPATE_EVENT_JUMP,
        Event::EnergyGain => PALPATE_EVENT_ENERGY_GAIN,
        Event::OpensLayer1 => PALPATE_EVENT_OPENS_LAYER_1,
        Event::OpensLayer2 => PALPATE_EVENT_OPENS_LAYER_2,
        Event::OpensLayer3 => PALPATE_EVENT_OPENS_LAYER_3,
        Event::OpensLayer4 => PALPATE_EVENT_OPENS_LAYER_4,
        Event::OpensLayer5 => PALPATE_EVENT_OPENS_LAYER_5,
        Event::OpensLayer6 => PALPATE_EVENT_OPENS_LAYER_6,
        Event::ShaftRelease => PALPATE_EVENT_SHAFT_RELEASE,
        Event::ShaftUnknown => PALPATE_EVENT_SHAFT_UNKNOWN,
        Event::ShaftKnown => PALPATE_EVENT_SHAFT_KNOWN,
        Event::NoEquilibrium => PALPATE_EVENT_NO_EQUILIBRIUM,
    }
}

pub(crate) fn bits(events: Events) -> u32 {
    events.iter().fold(0, |bits, event| bits | bit(event))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the bits of the headers so far, which programs are compiled with: a new event takes the next one.
    #[test]
    fn bits_are_those_that_programs_were_compiled_with() {
        let bits = Event::WORDS.iter().map(|&(_, event)| bit(event));
        let told: Vec<u32> = bits.filter(|&bit| bit != 0).collect();
        let expected: Vec<u32> = (0..=24)
            .filter(|place| ![9, 10, 12].contains(place))
            .map(|place| 1 << place)
            .collect();
        assert_eq!(told, expected);
    }
}
