//! The stages of arming: Off → Ready → Ramping → Live, and Fault from anywhere.

use crate::Fault;

use super::Limits;

/// The stage of arming.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Stage {
    /// The device is not ready, or no hand is present.
    #[default]
    Off,
    /// The device is ready; forces wait until the hand is slow and the force small.
    Ready,
    /// Forces are ramping up; the time since the start of the ramp [s].
    Ramping(f64),
    /// Full forces are on.
    Live,
    /// Forces are off, for this reason.
    Faulted(Fault),
}

/// The inputs of arming.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conditions {
    /// Whether the session allows a force, the device is ready and a hand is present.
    pub ready: bool,
    /// Whether the session allows a force.
    pub allowed: bool,
    /// Speed of the hand [m/s].
    pub speed: f64,
    /// Magnitude of the commanded force [N].
    pub force: f64,
    /// Whether a person asked to arm again.
    pub rearm_requested: bool,
}

impl Stage {
    /// The stage `dt` [s] later.
    #[must_use]
    pub fn next(self, conditions: &Conditions, limits: &Limits, dt: f64) -> Self {
        match self {
            Self::Faulted(_)
                if conditions.rearm_requested || (conditions.allowed && !limits.latched) =>
            {
                Self::Off
            }
            Self::Faulted(_) => self,
            // Forces were off in between, if only for less than a tick.
            _ if conditions.rearm_requested || !conditions.ready => Self::Off,
            Self::Off => Self::Ready,
            Self::Ready => {
                let slow = conditions.speed < limits.arming_speed;
                let small = conditions.force < limits.arming_force;
                if slow && small {
                    Self::Ramping(0.0)
                } else {
                    Self::Ready
                }
            }
            Self::Ramping(since) if since + dt < limits.ramp => Self::Ramping(since + dt),
            Self::Ramping(_) | Self::Live => Self::Live,
        }
    }

    /// The ramp gain, from 0 to 1 [-].
    pub fn part(self, limits: &Limits) -> f64 {
        match self {
            Self::Off | Self::Ready | Self::Faulted(_) => 0.0,
            Self::Ramping(since) => since / limits.ramp,
            Self::Live => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STILL: Conditions = Conditions {
        ready: true,
        allowed: true,
        speed: 0.0,
        force: 0.0,
        rearm_requested: false,
    };

    fn after(mut stage: Stage, conditions: Conditions, ticks: usize) -> Stage {
        for _ in 0..ticks {
            stage = stage.next(&conditions, &Limits::default(), 1e-3);
        }
        stage
    }

    #[test]
    fn a_still_hand_is_armed_in_half_a_second() {
        let limits = Limits::default();
        let half = after(Stage::Off, STILL, 252).part(&limits);
        // 250 ticks after the two that lead to the ramp.
        assert!((half - 0.5).abs() < 1e-12, "{half}");
        assert_eq!(after(Stage::Off, STILL, 503), Stage::Live);
    }

    #[test]
    fn a_fast_hand_or_a_large_force_is_not_armed() {
        let fast = Conditions {
            speed: 0.06,
            ..STILL
        };
        let large = Conditions {
            force: 0.31,
            ..STILL
        };
        assert_eq!(after(Stage::Off, fast, 1000), Stage::Ready);
        assert_eq!(after(Stage::Off, large, 1000), Stage::Ready);
    }

    #[test]
    fn a_fault_stays_until_somebody_asks() {
        let fault = Stage::Faulted(Fault::Silent);
        assert_eq!(after(fault, STILL, 1000), fault);
        let asked = Conditions {
            rearm_requested: true,
            ..STILL
        };
        assert_eq!(after(fault, asked, 1), Stage::Off);
        let absent = Conditions {
            ready: false,
            ..STILL
        };
        assert_eq!(after(Stage::Live, absent, 1), Stage::Off);
    }
}
