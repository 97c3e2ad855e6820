//! The limits that a force passes before it reaches a hand. The order is fixed; each stage is a small type or function
//! of its own.
//!
//! 1. A force or state that is not finite is a fault and gives no force; so does a fault that the device reports.
//! 2. A hand faster than 1 m/s is a fault.
//! 3. [`watchdog`]: it is a fault if a device had to keep a force much too long, or if a model's answer is overdue by
//!    10 ms, in which its force has faded; a device that had to keep a force too long gets none for a tick.
//! 4. [`dead_man`]: after a release the force drops to zero within 50 ms, and is armed anew.
//! 5. [`arming`]: no force before the session allows one ([`crate::supervisor`]), the device is ready and held, the
//!    hand slow and the force small; then it is raised over half a second.
//! 6. [`passivity`]: a hand gets back at most the energy that it put in.
//! 7. [`walls`]: a soft wall before the ends of the workspace.
//! 8. [`magnitude`]: at most 3 N, and at most what the device displays, by saturating the vector; half of it without a
//!    dead-man's switch; [`thermal`]: at most what its motors bear.
//! 9. [`slew`]: a force rises by at most 400 N/s and falls at once.
//!
//! The compensation of the device's own weight, spring and mass passes stages 1 to 5, 8 (the device's peak force, and
//! the thermal limit) and 9 with the rest: the sum is one force, an [`OutputForce`].
//!
//! A fault keeps forces off until a person arms again. [`Interventions`] counts the actions of the stages.
//!
//! *How we know*: `limits::nothing_passes_the_limits`, `chain::…`, `passivity::…`, and the tests of each stage.
//!
//! *Limits*: no second thread guards a loop that hangs in its device; that is left to the device's own watchdog. No
//! virtual coupling: tissue is softer than the stiffness that would need one.

pub mod arming;
pub mod dead_man;
mod guard;
mod interventions;
pub mod magnitude;
pub mod passivity;
pub mod slew;
pub mod thermal;
pub mod walls;
pub mod watchdog;

pub use arming::Stage;
pub use dead_man::DeadMan;
pub use guard::{CommandedForce, Guard, OutputForce};
pub use interventions::Interventions;

use crate::extrapolate::FADE_TIME;
use crate::{Capabilities, Fault};

/// The numerical limits of the stages.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest magnitude of a force [N].
    pub force: f64,
    /// Fastest rise of a force [N/s].
    pub slew: f64,
    /// Fastest hand [m/s].
    pub speed: f64,
    /// Fastest hand for which forces are armed [m/s].
    pub arming_speed: f64,
    /// Largest force with which they are armed [N].
    pub arming_force: f64,
    /// Time in which an armed force ramps up to full [s].
    pub ramp: f64,
    /// Width of the wall before the ends of the workspace [m].
    pub wall: f64,
    /// How much longer than a tick a device may keep a force before it gets zero force [s].
    pub deadline_tolerance: f64,
    /// How much longer than a tick it may keep one before that is a fault [s].
    pub deadline_fault_threshold: f64,
    /// How long a model's answer may be overdue before that is a fault [s].
    pub model_timeout: f64,
    /// Time in which the force drops to zero after a release of the dead-man's switch [s].
    pub release_time: f64,
    /// The part of the largest force that is allowed without such a switch [-].
    pub without_dead_man: f64,
    /// The energy budget: energy that may come out of a contact beyond what a hand put in [J]; infinite disables the
    /// passivity controller.
    pub energy_budget: f64,
    /// τ, thermal time constant of the motors [s].
    pub thermal_time_constant: f64,
    /// Whether a fault keeps forces off until a person arms again; otherwise arming restarts when the fault ends.
    pub latched: bool,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            force: 3.0,
            slew: 400.0,
            speed: 1.0,
            arming_speed: 0.05,
            arming_force: 0.3,
            ramp: 0.5,
            wall: 0.01,
            deadline_tolerance: 0.005,
            deadline_fault_threshold: 0.020,
            model_timeout: FADE_TIME,
            release_time: 0.050,
            without_dead_man: 0.5,
            energy_budget: 0.25e-3,
            thermal_time_constant: 30.0,
            latched: true,
        }
    }
}

impl Limits {
    /// The limits for a device. A device without force is harmless: a mouse may have any speed, and a fault ends by
    /// itself.
    pub fn of(capabilities: &Capabilities) -> Self {
        let default = Self::default();
        if capabilities.displays_force {
            return default;
        }
        Self {
            speed: f64::INFINITY,
            arming_speed: f64::INFINITY,
            arming_force: f64::INFINITY,
            deadline_fault_threshold: f64::INFINITY,
            model_timeout: f64::INFINITY,
            energy_budget: f64::INFINITY,
            latched: false,
            ..default
        }
    }

    /// The limits of a machine that no hand holds, such as an indenter: it has no dead-man's switch, and it is meant to
    /// do work.
    pub fn without_hand() -> Self {
        Self {
            without_dead_man: 1.0,
            energy_budget: f64::INFINITY,
            ..Self::default()
        }
    }

    fn check(&self) -> Result<(), Fault> {
        let Self {
            force,
            slew,
            speed,
            arming_speed,
            arming_force,
            ramp,
            wall,
            deadline_tolerance,
            deadline_fault_threshold,
            model_timeout,
            release_time,
            without_dead_man,
            energy_budget,
            thermal_time_constant,
            latched: _,
        } = *self;
        Fault::unless_finite_and_positive("the largest force [N]", force)?;
        Fault::unless_finite_and_positive("the rise of a force [N/s]", slew)?;
        Fault::unless_finite_and_positive("the time of the ramp [s]", ramp)?;
        Fault::unless_finite_and_positive("the width of the wall [m]", wall)?;
        Fault::unless_positive("the fastest hand [m/s]", speed)?;
        Fault::unless_positive("the fastest hand at arming [m/s]", arming_speed)?;
        Fault::unless_positive("the largest force at arming [N]", arming_force)?;
        Fault::unless_positive("the time that is late [s]", deadline_tolerance)?;
        Fault::unless_positive(
            "the time that is much too late [s]",
            deadline_fault_threshold,
        )?;
        Fault::unless_positive("the longest silence of the model [s]", model_timeout)?;
        Fault::unless_finite_and_positive("the time to let go in [s]", release_time)?;
        Fault::unless_finite_and_positive(
            "the part without a dead-man's switch [-]",
            without_dead_man,
        )?;
        Fault::unless_positive("the energy that may come out [J]", energy_budget)?;
        Fault::unless_finite_and_positive(
            "the time in which motors cool [s]",
            thermal_time_constant,
        )
    }
}
