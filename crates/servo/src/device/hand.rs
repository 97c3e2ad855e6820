use crate::{Fault, Vec3};

/// A compliant hand: a mass on a spring and a damper attached to the target position, m a = k (x_w − x) + b (v_w − v) +
/// F.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HandImpedance {
    /// m, of hand and handle together [kg].
    pub mass: f64,
    /// b [N s/m].
    pub damping: f64,
    /// k [N/m].
    pub stiffness: f64,
}

impl Default for HandImpedance {
    /// A light grasp of a handle.
    fn default() -> Self {
        Self {
            mass: 0.18,
            damping: 5.0,
            stiffness: 500.0,
        }
    }
}

/// Longest step of its motion [s]: a part in six hundred of the period of a stiff grasp (0.1 kg, 4 kN/m).
const LONGEST: f64 = 50e-6;

/// Position and velocity of a hand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HandState {
    /// [m]
    pub(super) position: Vec3,
    /// [m/s]
    pub(super) velocity: Vec3,
}

impl HandImpedance {
    pub(super) fn check(&self) -> Result<(), Fault> {
        Fault::unless_finite_and_positive("the hand's mass [kg]", self.mass)?;
        Fault::unless_finite_and_positive("the hand's stiffness [N/m]", self.stiffness)?;
        Fault::unless_finite_and_positive("the hand's damping [N s/m]", self.damping)
    }

    /// Advances `state` by `elapsed` [s] under `force` [N]; `wanted` gives the target position [m] and velocity [m/s]
    /// at a fraction of that time. Semi-implicit Euler in steps of 50 µs at most.
    pub(super) fn advance(
        &self,
        state: &mut HandState,
        force: &Vec3,
        elapsed: f64,
        commanded: impl Fn(f64) -> (Vec3, Vec3),
    ) {
        let steps = (elapsed / LONGEST).ceil().clamp(1.0, 20_000.0);
        let step = elapsed / steps;
        for number in 1..=steps as u32 {
            let (place, velocity) = commanded(f64::from(number) / steps);
            let pulled = (place - state.position) * self.stiffness
                + (velocity - state.velocity) * self.damping
                + force;
            state.velocity += pulled * (step / self.mass);
            state.position += state.velocity * step;
        }
    }
}
