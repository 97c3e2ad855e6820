//! Compensation of a device's own weight, spring and mass, so that the hand feels less of them.
//!
//! ```text
//! F_c = J⁻ᵀ g(q) + k x + M ẍ_f,   ẍ_f = s² x/(1 + s/ω_c)²
//! ```
//!
//! The acceleration from positions is filtered twice and late, which is negative damping: with a hand of mass m,
//! stiffness k and damping b the loop is stable for M below [`largest_mass`]; to first order
//!
//! ```text
//! M < m/(1 + k (2/ω_c + t)/b)
//! ```
//!
//! where t is the delay from a position to its force, one and a half ticks of a loop.
//!
//! *How we know*: `compensation::…` in the tests of the crate `measure`: mass by sine injection versus the closed form,
//! force at rest over the workspace, the stability limit in the loop.
//!
//! *Limits*: the compensated mass is the same in all directions; encoder steps cause a noise of M times their filtered
//! second difference, which is why the corner frequency is low.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::Linkage;
use crate::{HandImpedance, Vec3};

/// Settings of the compensation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compensation {
    /// The linkage whose weight is compensated; none for a balanced device.
    pub weight: Option<Linkage>,
    /// k, stiffness of the device's own centering spring [N/m].
    pub stiffness: f64,
    /// M, the compensated mass [kg].
    pub mass: f64,
    /// ω_c/2π [Hz].
    pub cutoff: f64,
}

impl Compensation {
    /// Effective impedance F_c/x [N/m] of a handle that moves sinusoidally at `frequency` [Hz] in a loop with ticks of
    /// `period` [s]: the force is constant during a tick and sent one tick late.
    pub fn impedance(&self, frequency: f64, period: f64) -> Complex<f64> {
        let turn = TAU * frequency * period;
        let back = Complex::from_polar(1.0, -turn);
        let filter_gain = self.filter_gain(period);
        let filter = Complex::new(filter_gain, 0.0) / (1.0 - back * (1.0 - filter_gain));
        let moved = (1.0 - back) * filter / period;
        // A zero-order hold delays a sine by half a tick and attenuates it.
        let half = 0.5 * turn;
        let held = if half > 0.0 { half.sin() / half } else { 1.0 };
        let late = Complex::from_polar(held, -1.5 * turn);
        (moved * moved * self.mass + self.stiffness) * late
    }

    /// The part of a step that the filter follows in a tick [-].
    fn filter_gain(&self, dt: f64) -> f64 {
        -(-TAU * self.cutoff * dt).exp_m1()
    }
}

/// The largest mass [kg] that can be compensated with a hand of impedance `held`, a corner at `cutoff` [Hz] and forces
/// that act `delay` [s] late: m s² + b s + k = M s² e^(−st)/(1 + s/ω_c)² has a root on the imaginary axis.
pub fn largest_mass(held: &HandImpedance, cutoff: f64, delay: f64) -> f64 {
    let at = |omega: f64| {
        let corner = omega / (TAU * cutoff);
        let own = Complex::new(
            held.mass * omega * omega - held.stiffness,
            held.damping * omega,
        );
        let lag = 2.0 * corner.atan() + omega * delay;
        // The lag rises and the phase falls, so that they cross once.
        let mass = own.norm() * (1.0 + corner * corner) / (omega * omega);
        (lag - own.arg(), mass)
    };
    let (mut slow, mut fast) = (1e-3, 1e6);
    while fast / slow > 1.0 + 1e-12 {
        let middle = f64::sqrt(slow * fast);
        if at(middle).0 < 0.0 {
            slow = middle;
        } else {
            fast = middle;
        }
    }
    at(fast).1
}

/// The state of a compensation in a loop.
#[derive(Debug, Clone)]
pub(crate) struct Compensator {
    settings: Compensation,
    /// Position [m], filtered velocity [m/s] and acceleration [m/s²].
    last: Option<Vec3>,
    velocity: Vec3,
    acceleration: Vec3,
}

impl Compensator {
    pub(crate) fn new(settings: Compensation) -> Self {
        Self {
            settings,
            last: None,
            velocity: Vec3::zeros(),
            acceleration: Vec3::zeros(),
        }
    }

    /// F_c [N] at `position` [m], `dt` [s] after the last call.
    pub(crate) fn force(&mut self, position: &Vec3, dt: f64) -> Vec3 {
        let settings = self.settings;
        match self.last {
            Some(last) if dt > 0.0 => {
                let filter_gain = settings.filter_gain(dt);
                let change = ((position - last) / dt - self.velocity) * filter_gain;
                self.velocity += change;
                self.acceleration += (change / dt - self.acceleration) * filter_gain;
            }
            _ => (self.velocity, self.acceleration) = (Vec3::zeros(), Vec3::zeros()),
        }
        self.last = Some(*position);
        let holding = settings
            .weight
            .and_then(|links| links.holding_force(position));
        holding.unwrap_or_default()
            + position * settings.stiffness
            + self.acceleration * settings.mass
    }

    /// Restarts: the next position is not reached by a motion.
    pub(crate) fn reset(&mut self) {
        self.last = None;
    }
}
