//! The dead-man's switch: when the hand releases it, the force drops to zero within 50 ms.

use crate::DeviceState;

/// A dead-man's switch: forces are on only while the hand holds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DeadMan {
    /// One of these buttons or safety switches (bit mask).
    Buttons(u32),
    /// A grip that is shut at least this far [-].
    Grip(f64),
}

impl DeadMan {
    /// Whether it is held in `state`.
    pub fn is_pressed(&self, state: &DeviceState) -> bool {
        match *self {
            Self::Buttons(buttons) => state.buttons & buttons != 0,
            Self::Grip(shut) => state.grip >= shut,
        }
    }
}

/// The state of a dead-man's switch.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum DeadManState {
    /// Not held.
    #[default]
    Free,
    /// Held.
    Held,
    /// Released, this long ago [s].
    Releasing(f64),
}

impl DeadManState {
    /// The state `dt` [s] later. A release always takes its full time `release` [s], even if the hand holds the switch
    /// again meanwhile: forces are then armed anew.
    #[must_use]
    pub fn next(self, held: bool, dt: f64, release: f64) -> Self {
        let since = match self {
            Self::Free | Self::Held if held => return Self::Held,
            Self::Free => return Self::Free,
            Self::Held => dt,
            Self::Releasing(since) => since + dt,
        };
        // A millionth of a tick: rounding of the times.
        if since >= release - 1e-6 * dt {
            Self::Free
        } else {
            Self::Releasing(since)
        }
    }

    /// The remaining part of a force [-].
    pub fn part(self, release: f64) -> f64 {
        match self {
            Self::Free => 0.0,
            Self::Held => 1.0,
            Self::Releasing(since) => 1.0 - since / release,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vec3;

    #[test]
    fn a_button_or_a_grip_is_held() {
        let mut state = DeviceState::at(0.0, Vec3::zeros());
        let (button, grip) = (DeadMan::Buttons(0b110), DeadMan::Grip(0.5));
        assert!(!button.is_pressed(&state) && !grip.is_pressed(&state));
        (state.buttons, state.grip) = (0b010, 0.5);
        assert!(button.is_pressed(&state) && grip.is_pressed(&state));
        (state.buttons, state.grip) = (0b001, f64::NAN);
        assert!(!button.is_pressed(&state) && !grip.is_pressed(&state));
    }

    #[test]
    fn what_is_let_go_of_is_gone_in_fifty_ticks() {
        let release = 0.050;
        let mut hold = DeadManState::Held;
        for tick in 1..50 {
            // Holding it again does not restore the force.
            hold = hold.next(tick > 20, 1e-3, release);
            // A line from one to zero.
            assert!((hold.part(release) - (1.0 - f64::from(tick) / 50.0)).abs() < 1e-12);
        }
        assert_eq!(hold.next(true, 1e-3, release), DeadManState::Free);
        assert_eq!(
            DeadManState::Free.next(true, 1e-3, release),
            DeadManState::Held
        );
    }
}
