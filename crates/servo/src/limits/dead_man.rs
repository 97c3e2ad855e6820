//! A hand that lets go takes the force with it, within 50 ms.

use crate::DeviceState;

/// What a hand holds for as long as it wants forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DeadMan {
    /// One of these buttons or safety switches, bit by bit.
    Buttons(u32),
    /// A grip that is shut at least so far [-].
    Grip(f64),
}

impl DeadMan {
    /// Whether it is held at `state`.
    pub fn is_held(&self, state: &DeviceState) -> bool {
        match *self {
            Self::Buttons(buttons) => state.buttons & buttons != 0,
            Self::Grip(shut) => state.grip >= shut,
        }
    }
}

/// How a hand holds it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Hold {
    /// Not at all.
    #[default]
    Free,
    /// It does.
    Held,
    /// It let go, this long ago [s].
    LettingGo(f64),
}

impl Hold {
    /// The hold `dt` [s] later. What was let go of is let go of whole, in `release` [s], whoever takes it up
    /// meanwhile: forces are armed anew.
    #[must_use]
    pub fn next(self, held: bool, dt: f64, release: f64) -> Self {
        let since = match self {
            Self::Free | Self::Held if held => return Self::Held,
            Self::Free => return Self::Free,
            Self::Held => dt,
            Self::LettingGo(since) => since + dt,
        };
        // A millionth of a tick: rounding of the times.
        if since >= release - 1e-6 * dt {
            Self::Free
        } else {
            Self::LettingGo(since)
        }
    }

    /// The part of a force that is left [-].
    pub fn part(self, release: f64) -> f64 {
        match self {
            Self::Free => 0.0,
            Self::Held => 1.0,
            Self::LettingGo(since) => 1.0 - since / release,
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
        assert!(!button.is_held(&state) && !grip.is_held(&state));
        (state.buttons, state.grip) = (0b010, 0.5);
        assert!(button.is_held(&state) && grip.is_held(&state));
        (state.buttons, state.grip) = (0b001, f64::NAN);
        assert!(!button.is_held(&state) && !grip.is_held(&state));
    }

    #[test]
    fn what_is_let_go_of_is_gone_in_fifty_ticks() {
        let release = 0.050;
        let mut hold = Hold::Held;
        for tick in 1..50 {
            // Taking it up again does not bring it back.
            hold = hold.next(tick > 20, 1e-3, release);
            // A line from one to zero.
            assert!((hold.part(release) - (1.0 - f64::from(tick) / 50.0)).abs() < 1e-12);
        }
        assert_eq!(hold.next(true, 1e-3, release), Hold::Free);
        assert_eq!(Hold::Free.next(true, 1e-3, release), Hold::Held);
    }
}
