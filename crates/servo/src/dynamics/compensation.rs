//! What a device adds against its own weight, spring and mass, so that less of it is felt.
//!
//! ```text
//! F_c = J⁻ᵀ g(q) + k x + M ẍ_f,   ẍ_f = s² x/(1 + s/ω_c)²
//! ```
//!
//! The acceleration of positions is filtered twice and comes late, which is negative damping: a mass m that is
//! held with b and k stays at rest for M below [`largest_mass`]; to first order
//!
//! ```text
//! M < m/(1 + k (2/ω_c + t)/b)
//! ```
//!
//! with t from a place to its force, one and a half ticks of a loop.
//!
//! *How we know*: `compensation::…` in the tests of the crate `measure`: mass by sine injection beside the closed form, force at rest
//! over the workspace, the edge of stability in the loop.
//!
//! *Limits*: a mass is taken off alike in all directions; steps of an encoder are felt as a rustle of M times
//! their filtered second difference, which is why the corner is low.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::Linkage;
use crate::{HandImpedance, Vec3};

/// What is compensated of a device.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compensation {
    /// Whose weight is held; none for a device that is balanced.
    pub weight: Option<Linkage>,
    /// k, of the device's own spring to the middle [N/m].
    pub stiffness: f64,
    /// M, what is taken off its mass [kg].
    pub mass: f64,
    /// ω_c/2π [Hz].
    pub cutoff: f64,
}

impl Compensation {
    /// F_c over x of a handle that swings with `frequency` [Hz] in a loop with ticks of `period` [s] [N/m], when
    /// it acts: it is held for a tick and sent a tick late.
    pub fn impedance(&self, frequency: f64, period: f64) -> Complex<f64> {
        let turn = TAU * frequency * period;
        let back = Complex::from_polar(1.0, -turn);
        let part = self.part(period);
        let filter = Complex::new(part, 0.0) / (1.0 - back * (1.0 - part));
        let moved = (1.0 - back) * filter / period;
        // Held for a tick, a sine is late by half of one and smaller.
        let half = 0.5 * turn;
        let held = if half > 0.0 { half.sin() / half } else { 1.0 };
        let late = Complex::from_polar(held, -1.5 * turn);
        (moved * moved * self.mass + self.stiffness) * late
    }

    /// The part of a step that a filter follows in a tick [-].
    fn part(&self, dt: f64) -> f64 {
        -(-TAU * self.cutoff * dt).exp_m1()
    }
}

/// The largest mass [kg] that may be taken off what is held as `held`, with a corner at `cutoff` [Hz] and
/// forces that act `delay` [s] late: m s² + b s + k = M s² e^(−st)/(1 + s/ω_c)² has a root on the imaginary
/// axis.
pub fn largest_mass(held: &HandImpedance, cutoff: f64, delay: f64) -> f64 {
    let at = |omega: f64| {
        let corner = omega / (TAU * cutoff);
        let own = Complex::new(
            held.mass * omega * omega - held.stiffness,
            held.damping * omega,
        );
        let lag = 2.0 * corner.atan() + omega * delay;
        // The lag rises and the phase falls, so that they meet once.
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

/// A compensation in a loop.
#[derive(Debug, Clone)]
pub(crate) struct Compensator {
    settings: Compensation,
    /// Place [m], filtered velocity [m/s] and acceleration [m/s²].
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

    /// F_c [N] at `position` [m], `dt` [s] after the last.
    pub(crate) fn force(&mut self, position: &Vec3, dt: f64) -> Vec3 {
        let settings = self.settings;
        match self.last {
            Some(last) if dt > 0.0 => {
                let part = settings.part(dt);
                let change = ((position - last) / dt - self.velocity) * part;
                self.velocity += change;
                self.acceleration += (change / dt - self.acceleration) * part;
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

    /// Begins anew: what comes next was not reached by a way.
    pub(crate) fn forget(&mut self) {
        self.last = None;
    }
}
