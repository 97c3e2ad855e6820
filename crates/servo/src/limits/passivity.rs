//! A hand gets back at most the energy that it put in.
//!
//! ```text
//! W_n = W_{n−1} − F_{n−2}·(x_n − x_{n−1})                        observer
//! f'  = (1 − D/W₀)⁺ (f − (f·u)⁺ u),   D = −W − W₀ > 0            controller, u = the last way/its length
//! ```
//!
//! W is the energy at the port, exact for forces that are held between ticks: F_{n−2} is what the device had
//! until tick n. As in [Hannaford and Ryu 2002] the controller acts only while more has come out than went in,
//! here beyond an allowance W₀. The part of a force along the motion is damping of just the size that ends the
//! giving; more damping than that gives energy itself, for it comes a tick and a half late. Its lateness is also
//! why the rest of the force is shortened with the debt: at 2 W₀ nothing is left that could give.
//!
//! Credit is forgotten after 50 ms without force, or it would hide what comes later, and never exceeds 5 mJ.
//!
//! *How we know*: `passivity::…` in the tests: a stiff wall at 60 Hz with it and without, normal palpation that
//! it leaves alone to the bit.
//!
//! *Limits*: one sum for all three axes, since a tissue's stiffness couples them. A wall that has to be held back
//! is felt softer than it is meant.

use crate::Vec3;

/// The most that is remembered in favour of the loop [J].
const CREDIT: f64 = 5e-3;
/// Time without force after which a contact is over [s].
const FREE: f64 = 0.050;

/// Energy at the port.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Passivity {
    stored: f64,
    moved: Vec3,
    free: f64,
}

impl Passivity {
    /// Counts what `held` [N], the force of the last `dt` [s], did while the hand `moved` [m].
    pub fn observe(&mut self, held: &Vec3, moved: &Vec3, dt: f64) {
        self.moved = *moved;
        self.stored = (self.stored - held.dot(moved)).min(CREDIT);
        self.free = if *held == Vec3::zeros() {
            self.free + dt
        } else {
            0.0
        };
        if self.free >= FREE {
            self.stored = 0.0;
        }
    }

    /// W, what the hand put in and did not get back in this contact [J].
    pub fn stored(&self) -> f64 {
        self.stored
    }

    /// What of a `force` [N] may be sent, with an `allowance` W₀ [J].
    pub fn control(&self, force: &Vec3, energy_budget: f64) -> Vec3 {
        let debt = -self.stored - energy_budget;
        if debt <= 0.0 {
            return *force;
        }
        let along = self.moved.try_normalize(0.0).unwrap_or_default();
        let giving = force.dot(&along).max(0.0);
        (force - along * giving) * (1.0 - debt / energy_budget).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: 1 N over 1.5 mm out is 1.5 mJ, half an allowance beyond it.
    #[test]
    fn only_what_gives_energy_is_taken_away() {
        let energy_budget = 1e-3;
        let mut passivity = Passivity::default();
        let force = Vec3::new(1.0, 0.5, 0.0);
        assert_eq!(passivity.control(&force, energy_budget), force);
        passivity.observe(&Vec3::x(), &(Vec3::x() * 1.5e-3), 1e-3);
        let sent = passivity.control(&force, energy_budget);
        assert!((sent - Vec3::y() * 0.25).norm() < 1e-12, "{sent}");
        // What holds the hand back already goes on doing so, in part.
        let back = passivity.control(&-force, energy_budget);
        assert!((back + force * 0.5).norm() < 1e-12, "{back}");
        passivity.observe(&Vec3::x(), &(Vec3::x() * 0.5e-3), 1e-3);
        assert!(passivity.control(&-force, energy_budget).norm() < 1e-12);
        assert_eq!(passivity.control(&force, f64::INFINITY), force);
    }

    #[test]
    fn credit_is_bounded_and_forgotten() {
        let mut passivity = Passivity::default();
        passivity.observe(&-Vec3::x(), &Vec3::x(), 1e-3);
        assert_eq!(passivity.stored(), CREDIT);
        for _ in 0..49 {
            passivity.observe(&Vec3::zeros(), &Vec3::x(), 1e-3);
        }
        assert_eq!(passivity.stored(), CREDIT);
        passivity.observe(&Vec3::zeros(), &Vec3::x(), 2e-3);
        assert_eq!(passivity.stored(), 0.0);
    }
}
