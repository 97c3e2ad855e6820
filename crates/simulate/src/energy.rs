//! Energy check: an organ returns no more work than was done on it.
//!
//! From the first touch of an organ at rest to the last release, with F the force on a tool and x its tip (for jaws,
//! the tissue that they hold), step by step over all tools,
//!
//! ```text
//! W = −½ (F₀ + F₁)·(x₁ − x₀)      a contact that begins: ½ F₁ᵀ K⁻¹ F₁      one that ends: −½ F₀ᵀ K⁻¹ F₀
//! ```
//!
//! A tip that is no longer pressed against the organ ends its contact: its force falls to zero within that step. Where
//! it is pressed again another contact begins. In a step in which held tissue slips, the work is the change of ½ Fᵀ K⁻¹
//! F: the slip dissipates the rest, and the force falls to the friction limit within the step.
//!
//! The positive parts are the work done, the negative ones the work returned. Where the second exceeds
//! [`MAX_RETURNED`] times the first, the solution is not that of an elastic organ: [`Event::EnergyGain`], once for
//! each touch, on every tool that touches.
//!
//! *How we know*: `grip::energy::…`, `random_scenes::…`.
//!
//! *Limits*: only touches by jaws and by flat tips that stick are checked. A slipping tip moves without work between
//! locations of different stiffness, a sticking sphere shears at one depth and returns at another, and the work of
//! turning jaws does not appear in the force: those models have no energy to compare with.

use palpate_files::session::Event;
use palpate_geometry::Vec3;
use palpate_mechanics::contact::{Friction, Tip};

use crate::grip::Grasp;
use crate::simulation::Simulation;
use crate::state::{SimulationState, ToolState};
use crate::tool::Tool;

/// Work returned over work done above which there is a gain [-]. A contact that begins or ends within a step counts by
/// its tangent stiffness: for a force that rises with the n-th power of depth that is (n+1)/2n of its energy, never
/// less than a half. Linear tissue returns at most 1.01.
const MAX_RETURNED: f64 = 2.0;

/// Work below this is rounding [J]: a micronewton over a tenth of a millimetre.
const NOISE: f64 = 1e-10;

/// Jaws that have turned farther than this with tissue between them [rad] did work that does not appear in the force.
const MAX_TURNED: f64 = 0.1;

/// The work of all tools since the organ was at rest.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct EnergyAccount {
    /// Done on the organ, and returned by it [J].
    done: f64,
    returned: f64,
    /// Whether this touch is no longer checked: it cannot be, or its gain has been reported.
    is_closed: bool,
}

impl EnergyAccount {
    fn add(&mut self, work: f64) {
        self.done += work.max(0.0);
        self.returned -= work.min(0.0);
    }

    /// Stops the check until the organ is at rest again.
    pub(crate) fn close(&mut self) {
        self.is_closed = true;
    }

    fn gains(&self) -> bool {
        !self.is_closed && self.returned > MAX_RETURNED * self.done + NOISE
    }
}

/// The tip of a pressing tool, or the tissue that it holds [m], and the force on it [N].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pressed {
    tip: Vec3,
    held: Option<Vec3>,
    /// The contact location on the organ at rest [m]: a change means another contact.
    point: Vec3,
    /// Slip of the tissue in the jaws [m].
    slid: Vec3,
    force: Vec3,
    /// Energy of this contact alone [J].
    stored: f64,
}

/// Adds the work of a step, and reports a gain.
pub(crate) fn check(simulation: &Simulation, state: &mut SimulationState) {
    let account = &mut state.energy;
    for (tool, own) in simulation.tools.iter().zip(&mut state.tools) {
        if own.touches() && !has_energy(tool, own) {
            account.close();
        }
        let before = own.pressed;
        own.pressed = own.pressing();
        let begins = own.row.events.contains(Event::Contact);
        let goes_on = |before: &Pressed, now: &Pressed| !begins && before.point == now.point;
        match (before, own.pressed) {
            (Some(before), Some(now)) if goes_on(&before, &now) && before.slid != now.slid => {
                account.add(now.stored - before.stored);
            }
            (Some(before), Some(now)) if goes_on(&before, &now) => {
                let motion = match (before.held, now.held) {
                    (Some(before), Some(now)) => now - before,
                    _ => now.tip - before.tip,
                };
                account.add(-0.5 * (before.force + now.force).dot(&motion));
            }
            (before, now) => {
                account.add(-before.map_or(0.0, |before| before.stored));
                account.add(now.map_or(0.0, |now| now.stored));
            }
        }
    }
    if account.gains() {
        account.close();
        for own in &mut state.tools {
            // A tool that has just released took part.
            if own.touches() || own.row.events.contains(Event::Release) {
                own.row.events.insert(Event::EnergyGain);
                own.limits.count_energy_gain();
            }
        }
    }
    if !state.tools.iter().any(ToolState::touches) {
        state.energy = EnergyAccount::default();
    }
}

/// Whether the force on a tool is the derivative of an energy.
fn has_energy(tool: &Tool, state: &ToolState) -> bool {
    if state.is_pushed() {
        // The load on a shaft does not move with the tip.
        return false;
    }
    match &state.grip.grasp {
        Some(hold) => hold.has_turned() <= MAX_TURNED,
        None => {
            matches!(
                (tool.tip, tool.tip_friction),
                (Tip::Flat { .. }, Friction::Bonded)
            ) && tool.friction.is_none()
        }
    }
}

impl ToolState {
    fn pressing(&self) -> Option<Pressed> {
        if !self.touches() || self.contact.is_some_and(|contact| !contact.is_pressed) {
            return None;
        }
        let force = self.force_of_organ();
        let hold = self.grip.grasp.as_ref();
        let yields = self.stiffness.try_inverse().map(|inverse| inverse * force);
        Some(Pressed {
            tip: Vec3::from(self.pose?.position_m),
            held: hold.map(Grasp::carried_without_slip),
            slid: hold.map_or_else(Vec3::zeros, |hold| *hold.slid()),
            point: hold
                .map(Grasp::place)
                .or(self.contact.map(|contact| contact.point()))?,
            force,
            stored: yields.map_or(0.0, |by| (0.5 * force.dot(&by)).max(0.0)),
        })
    }
}
