//! Passivity control: a hand gets back at most the energy that it put in.
//!
//! ```text
//! W_n = W_{n−1} − F_{n−2}·(x_n − x_{n−1})                        observer
//! f'  = (1 − D/W₀)⁺ (f − (f·u)⁺ u),   D = −W − W₀ > 0            controller, u = the last way/its length
//! ```
//!
//! W is the energy at the port, exact for forces that are constant between ticks: F_{n−2} is the device's force until
//! tick n. As in [Hannaford and Ryu 2002] the controller acts only while more energy has come out than went in, here
//! beyond an energy budget W₀. Damping of just this size removes the part of the force along the motion; more damping
//! would generate energy itself, since it acts a tick and a half late. This delay is also why the rest of the force
//! decreases with the deficit: at 2 W₀ the force is zero.
//!
//! The stored energy is reset after 50 ms without force, since it would hide a later gain, and never exceeds 5 mJ.
//!
//! *How we know*: `passivity::…` in the tests: a stiff wall at 60 Hz with it and without, normal palpation that it
//! leaves unchanged to the bit.
//!
//! *Limits*: one sum for all three axes, since a tissue's stiffness couples them. A wall that it damps feels softer
//! than specified.

use crate::Vec3;

/// The largest stored energy [J].
const CREDIT: f64 = 5e-3;
/// Time without force after which a contact has ended [s].
const FREE: f64 = 0.050;

/// Energy at the port.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Passivity {
    stored: f64,
    moved: Vec3,
    free: f64,
}

impl Passivity {
    /// Counts the work of `held` [N], the force of the last `dt` [s], while the hand `moved` [m].
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

    /// W, the energy that the hand put in and did not get back in this contact [J].
    pub fn stored(&self) -> f64 {
        self.stored
    }

    /// The passive part of a `force` [N], with an `allowance` W₀ [J].
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

    /// By hand: 1 N over 1.5 mm out is 1.5 mJ, half a budget beyond it.
    #[test]
    fn only_what_gives_energy_is_taken_away() {
        let energy_budget = 1e-3;
        let mut passivity = Passivity::default();
        let force = Vec3::new(1.0, 0.5, 0.0);
        assert_eq!(passivity.control(&force, energy_budget), force);
        passivity.observe(&Vec3::x(), &(Vec3::x() * 1.5e-3), 1e-3);
        let sent = passivity.control(&force, energy_budget);
        assert!((sent - Vec3::y() * 0.25).norm() < 1e-12, "{sent}");
        // The part that resists the motion stays, in part.
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
