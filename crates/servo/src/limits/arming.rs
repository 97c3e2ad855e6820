//! When forces are on: Off → Ready → Ramping → Live, and Fault from anywhere.

use crate::Fault;

use super::Limits;

/// How far forces are on.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Stage {
    /// The device is not ready, or nobody is there.
    #[default]
    Off,
    /// It is; forces wait until the hand is slow and the force small.
    Ready,
    /// Forces are raised; this long since [s].
    Ramping(f64),
    /// They are whole.
    Live,
    /// They are off, for this reason.
    Faulted(Fault),
}

/// What arming looks at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conditions {
    /// Whether the session allows a force, the device is ready and somebody there.
    pub ready: bool,
    /// Whether the session allows a force.
    pub allowed: bool,
    /// How fast the hand is [m/s].
    pub speed: f64,
    /// How large the force would be [N].
    pub force: f64,
    /// Whether somebody asked to arm again.
    pub asked: bool,
}

impl Stage {
    /// The stage after `dt` [s] more.
    #[must_use]
    pub fn next(self, conditions: &Conditions, limits: &Limits, dt: f64) -> Self {
        match self {
            Self::Faulted(_) if conditions.asked || (conditions.allowed && !limits.latched) => {
                Self::Off
            }
            Self::Faulted(_) => self,
            // Forces were off meanwhile, be it for less than a tick.
            _ if conditions.asked || !conditions.ready => Self::Off,
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

    /// The part of a force that is on [-].
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
        asked: false,
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
            asked: true,
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
