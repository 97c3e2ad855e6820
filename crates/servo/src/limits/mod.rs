//! What a force passes before it reaches a hand. The order is fixed; each stage is a small type or
//! function of its own.
//!
//! 1. A force or a state that is no number is no force, and a fault; so is what a device reports of itself.
//! 2. A hand faster than 1 m/s is a fault.
//! 3. [`watchdog`]: a device that had to keep a force much too long is a fault, and so is a model whose answer
//!    is overdue by 10 ms, in which its force has faded; a device that had to keep one too long gets none for a
//!    tick.
//! 4. [`dead_man`]: what is let go of has no force 50 ms later, and is armed anew.
//! 5. [`arming`]: no force before the session allows one ([`crate::supervisor`]), the device is ready and held, the
//!    hand slow and the force small; then it is raised over half a second.
//! 6. [`passivity`]: a hand gets back at most the energy that it put in.
//! 7. [`walls`]: a soft wall before the ends of the workspace.
//! 8. [`magnitude`]: at most 3 N, and at most what the device displays, by shortening the vector; half of it
//!    where no dead-man's switch is; [`heat`]: at most what its motors bear.
//! 9. [`slew`]: a force rises by at most 400 N/s and falls at once.
//!
//! What is added against the device's own weight, spring and mass passes stages 1 to 5, 8 (what the device displays, and
//! its motors bear) and 9 with the rest: what is sent is one force, an [`OutputForce`].
//!
//! A fault keeps forces off until somebody arms them again. What the stages did is counted
//! ([`Interventions`]).
//!
//! *How we know*: `limits::nothing_passes_the_limits`, `chain::…`, `passivity::…`, and the tests of each stage.
//!
//! *Limits*: no second thread watches over a loop that hangs in its device; that is left to the device's own
//! watchdog. No virtual coupling: tissue is softer than what needs one.

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

use crate::extrapolate::FADE;
use crate::{Capabilities, Fault};

/// The numbers of the stages.
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
    /// Time in which an armed force is raised to its whole [s].
    pub ramp: f64,
    /// Width of the wall before the ends of the workspace [m].
    pub wall: f64,
    /// How much longer than a tick a device may keep a force before it gets none [s].
    pub late: f64,
    /// How much longer before that is a fault [s].
    pub much_too_late: f64,
    /// How long a model's answer may be overdue before that is a fault [s].
    pub silence: f64,
    /// Time in which a force is gone from a hand that lets go of its dead-man's switch [s].
    pub release: f64,
    /// The part of the largest force that is displayed without such a switch [-].
    pub without_dead_man: f64,
    /// The energy that may come out of a contact beyond what a hand put in [J]; infinite to leave it alone.
    pub energy_budget: f64,
    /// τ, in which motors cool [s].
    pub heat_time: f64,
    /// Whether a fault keeps forces off until somebody arms them; else they are armed when it is over.
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
            late: 0.005,
            much_too_late: 0.020,
            silence: FADE,
            release: 0.050,
            without_dead_man: 0.5,
            energy_budget: 0.25e-3,
            heat_time: 30.0,
            latched: true,
        }
    }
}

impl Limits {
    /// The limits for a device. Where no force reaches a hand nothing can hurt it: a mouse may be as fast
    /// as it likes, and a fault ends by itself.
    pub fn of(capabilities: &Capabilities) -> Self {
        let default = Self::default();
        if capabilities.displays_force {
            return default;
        }
        Self {
            speed: f64::INFINITY,
            arming_speed: f64::INFINITY,
            arming_force: f64::INFINITY,
            much_too_late: f64::INFINITY,
            silence: f64::INFINITY,
            energy_budget: f64::INFINITY,
            latched: false,
            ..default
        }
    }

    /// The limits of a machine that no hand holds, such as an indenter: it has nothing to let go of, and it is
    /// there to do work.
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
            late,
            much_too_late,
            silence,
            release,
            without_dead_man,
            energy_budget,
            heat_time,
            latched: _,
        } = *self;
        Fault::unless_finite_and_positive("the largest force [N]", force)?;
        Fault::unless_finite_and_positive("the rise of a force [N/s]", slew)?;
        Fault::unless_finite_and_positive("the time of the ramp [s]", ramp)?;
        Fault::unless_finite_and_positive("the width of the wall [m]", wall)?;
        Fault::unless_positive("the fastest hand [m/s]", speed)?;
        Fault::unless_positive("the fastest hand at arming [m/s]", arming_speed)?;
        Fault::unless_positive("the largest force at arming [N]", arming_force)?;
        Fault::unless_positive("the time that is late [s]", late)?;
        Fault::unless_positive("the time that is much too late [s]", much_too_late)?;
        Fault::unless_positive("the longest silence of the model [s]", silence)?;
        Fault::unless_finite_and_positive("the time to let go in [s]", release)?;
        Fault::unless_finite_and_positive(
            "the part without a dead-man's switch [-]",
            without_dead_man,
        )?;
        Fault::unless_positive("the energy that may come out [J]", energy_budget)?;
        Fault::unless_finite_and_positive("the time in which motors cool [s]", heat_time)
    }
}
