use std::fmt;

use crate::words::words;

words! {
    /// What can happen to a tool in a step.
    pub enum Event {
        /// It touches the organ, which it did not in the step before.
        Contact = "contact",
        /// It no longer touches the organ.
        Release = "release",
        /// It takes hold.
        Grip = "grip",
        /// It lets go.
        GripRelease = "grip_release",
        /// Its blade opens at least one layer, or the organ where there are no layers.
        Cut = "cut",
        /// It opens the innermost layer.
        Perforation = "perforation",
        /// Its shaft, not its tip, touches the organ.
        ShaftContact = "shaft_contact",
        /// It is deeper than the models can be trusted: beyond 10 mm.
        DepthBeyondTrust = "depth_beyond_trust",
        /// The model gave a force that is no number; it was replaced by zero.
        NonFiniteForce = "non_finite_force",
        /// Its hand says: here, or: done.
        Mark = "mark",
        /// Its hand is gone; the row has its last place, and the tool is not there until its next row.
        Lifted = "lifted",
        /// Before the step the last cut was closed again.
        UndoCut = "undo_cut",
        /// Before the step the organ was made whole and at rest.
        Restart = "begin_anew",
        /// It moved faster than a hand can: it lost what it touched and held, and touches anew where it is now.
        Jump = "jump",
        /// The organ gave back more work than was done on it.
        EnergyGain = "energy_gain",
        /// It opens the outermost layer of the organ at its tip.
        OpensLayer1 = "opens_layer_1",
        /// It opens the second layer from outside.
        OpensLayer2 = "opens_layer_2",
        /// It opens the third layer from outside.
        OpensLayer3 = "opens_layer_3",
        /// It opens the fourth layer from outside.
        OpensLayer4 = "opens_layer_4",
        /// It opens the fifth layer from outside.
        OpensLayer5 = "opens_layer_5",
        /// It opens the sixth layer from outside.
        OpensLayer6 = "opens_layer_6",
        /// Its shaft no longer touches the organ.
        ShaftRelease = "shaft_release",
        /// From this step on the direction of its shaft is not known, so that only its tip and jaws touch an organ that bends;
        /// its rows have the orientation that is seen.
        ShaftUnknown = "shaft_unknown",
        /// The direction of its shaft is known again.
        ShaftKnown = "shaft_known",
        /// No equilibrium of the organ was found: it is at rest again, and the tool has lost what it touched and held.
        NoEquilibrium = "no_equilibrium",
    }
}

impl Event {
    /// The events of the layers, from the outermost: as many as an organ may have layers.
    pub const OPENS_LAYER: [Self; 6] = [
        Self::OpensLayer1,
        Self::OpensLayer2,
        Self::OpensLayer3,
        Self::OpensLayer4,
        Self::OpensLayer5,
        Self::OpensLayer6,
    ];
}

/// The events of a tool in a step, in the order of their list.
#[derive(Clone, Copy, PartialEq, Eq, Default)]
pub struct Events {
    bits: u32,
}

impl Events {
    /// No event.
    pub const NONE: Self = Self { bits: 0 };

    /// Adds an event; a repeated one is stored once.
    pub fn insert(&mut self, event: Event) {
        self.bits |= 1 << event as u32;
    }

    /// Removes an event.
    pub fn remove(&mut self, event: Event) {
        self.bits &= !(1 << event as u32);
    }

    /// Whether an event is present.
    pub fn contains(self, event: Event) -> bool {
        self.bits & (1 << event as u32) != 0
    }

    /// The number, from 1 for the outermost, of the deepest layer that was opened; none if none was.
    pub fn deepest_opened(self) -> Option<usize> {
        let mut opened = Event::OPENS_LAYER.iter();
        opened
            .rposition(|event| self.contains(*event))
            .map(|index| index + 1)
    }

    /// Whether there is no event.
    pub fn is_empty(self) -> bool {
        self.bits == 0
    }

    /// The events, in the order of their list.
    pub fn iter(self) -> impl Iterator<Item = Event> {
        let all = Event::WORDS.iter().map(|(_, event)| *event);
        all.filter(move |event| self.contains(*event))
    }

    /// The events of a text in which `;` separates them; none when a word is no event.
    pub fn from_words(text: &str) -> Option<Self> {
        let words = text
            .split(';')
            .map(str::trim)
            .filter(|word| !word.is_empty());
        words.map(Event::from_word).collect()
    }
}

impl From<Event> for Events {
    fn from(event: Event) -> Self {
        [event].into_iter().collect()
    }
}

impl FromIterator<Event> for Events {
    fn from_iter<T: IntoIterator<Item = Event>>(events: T) -> Self {
        let mut all = Self::NONE;
        events.into_iter().for_each(|event| all.insert(event));
        all
    }
}

impl std::ops::BitOr for Events {
    type Output = Self;

    /// The union of both.
    fn bitor(self, other: Self) -> Self {
        Self {
            bits: self.bits | other.bits,
        }
    }
}

impl fmt::Display for Events {
    /// The words with `;` between them, as in a session.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, event) in self.iter().enumerate() {
            let separator = if number == 0 { "" } else { ";" };
            write!(f, "{separator}{event}")?;
        }
        Ok(())
    }
}

impl fmt::Debug for Events {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_are_a_set_in_the_order_of_the_list() {
        let events: Events = [Event::Cut, Event::Contact, Event::Cut]
            .into_iter()
            .collect();
        assert_eq!(events.to_string(), "contact;cut");
        assert_eq!(Events::from_words("cut;contact"), Some(events));
        assert_eq!(Events::from_words(""), Some(Events::NONE));
        assert_eq!(Events::from_words("contact;sneeze"), None);
        assert_eq!(Event::WORDS.len(), 25);
    }

    #[test]
    fn deepest_opened_layer_is_named() {
        let events = Events::from_words("cut;opens_layer_1;opens_layer_3");
        assert_eq!(events.unwrap().deepest_opened(), Some(3));
        assert_eq!(Events::NONE.deepest_opened(), None);
    }
}
