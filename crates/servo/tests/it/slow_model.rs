//! A model that answers more slowly than the loop asks, and may die.

use nalgebra::Matrix3;
use palpate_servo::{AffineForce, Controller, DeviceState, Extrapolator, HandOver, Vec3};

/// Force [N] and stiffness [N/m] at a depth [m] above zero.
pub(crate) type Law = fn(f64) -> (f64, f64);

/// A surface at z = 0 whose answers arrive one period after the places that they were made for.
pub(crate) struct SlowModel {
    law: Law,
    period: f64,
    /// From this time on it does not answer [s].
    dies_at: f64,
    extrapolator: Extrapolator,
    pending: Option<AffineForce>,
    steps: u32,
    time: f64,
}

impl SlowModel {
    pub(crate) fn new(law: Law, rate: f64, hand_over: HandOver) -> Self {
        Self {
            law,
            period: 1.0 / rate,
            dies_at: f64::INFINITY,
            extrapolator: Extrapolator::new(hand_over, 1.0 / rate, 1e-3),
            pending: None,
            steps: 0,
            time: 0.0,
        }
    }

    pub(crate) fn dying_at(mut self, time: f64) -> Self {
        self.dies_at = time;
        self
    }

    fn answer(&self, state: &DeviceState) -> AffineForce {
        let depth = -state.position.z;
        if depth <= 0.0 {
            return AffineForce::none(state.time);
        }
        let (force, stiffness) = (self.law)(depth);
        let gradient = Matrix3::from_diagonal(&(-Vec3::z() * stiffness));
        AffineForce {
            normal: Vec3::z(),
            ..AffineForce::new(state.time, state.position, Vec3::z() * force, gradient)
        }
    }
}

impl Controller for SlowModel {
    fn update(&mut self, state: &DeviceState, _dt: f64) -> Vec3 {
        self.time = state.time;
        // A thousandth of a tick: rounding of the times.
        let due = state.time >= f64::from(self.steps) * self.period - 1e-6;
        if due && state.time < self.dies_at {
            if let Some(answer) = self.pending.take() {
                self.extrapolator.receive(&answer);
            }
            self.pending = Some(self.answer(state));
            self.steps += 1;
        }
        self.extrapolator.force(state.time, &state.position)
    }

    fn age(&self) -> Option<f64> {
        Some(self.extrapolator.age(self.time))
    }

    fn overdue(&self) -> Option<f64> {
        Some(self.extrapolator.overdue(self.time))
    }
}
