//! The clock of a loop: real time, or virtual time as fast as the processor runs.
//!
//! A real clock waits for an absolute time, not for a duration, so that errors do not add up: it sleeps until 150 µs
//! before that time and spins the rest, since a sleeping thread wakes up some 70 µs late. A virtual clock jumps there
//! at once; the same inputs give the same bytes.

use std::time::{Duration, Instant};

/// How long before its time a thread stops sleeping and spins.
const SPUN: Duration = Duration::from_micros(150);

/// The time source of a loop.
#[derive(Debug, Clone, Copy)]
pub enum Clock {
    /// The machine's time, counted from this instant.
    Real(Instant),
    /// The time [s] that it was last set to.
    Virtual(f64),
}

impl Clock {
    /// The machine's time, zero now. Copies count from the same zero.
    pub fn real() -> Self {
        Self::Real(Instant::now())
    }

    /// A virtual clock at zero; only waiting advances it.
    pub fn virtual_time() -> Self {
        Self::Virtual(0.0)
    }

    /// The time [s].
    pub fn now(&self) -> f64 {
        match self {
            Self::Real(zero) => zero.elapsed().as_secs_f64(),
            Self::Virtual(time) => *time,
        }
    }

    /// Returns at `time` [s], or at once when that has passed.
    pub fn wait_until(&mut self, time: f64) {
        match self {
            Self::Real(zero) => sleep_then_spin(*zero + Duration::from_secs_f64(time.max(0.0))),
            Self::Virtual(now) => *now = now.max(time),
        }
    }

    /// Returns at `time` [s], or a little later: for threads that need no exact time.
    pub fn sleep_until(&mut self, time: f64) {
        match self {
            Self::Real(_) => {
                let left = (time - self.now()).max(0.0);
                std::thread::sleep(Duration::from_secs_f64(left));
            }
            Self::Virtual(now) => *now = now.max(time),
        }
    }
}

fn sleep_then_spin(until: Instant) {
    let left = until.saturating_duration_since(Instant::now());
    if left > SPUN {
        std::thread::sleep(left - SPUN);
    }
    while Instant::now() < until {
        std::hint::spin_loop();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_virtual_clock_never_goes_back() {
        let mut clock = Clock::virtual_time();
        clock.wait_until(2.0);
        clock.wait_until(1.0);
        assert_eq!(clock.now(), 2.0);
    }

    #[test]
    fn a_real_clock_is_never_early() {
        let mut clock = Clock::real();
        for number in 1..=20 {
            let due = f64::from(number) * 1e-3;
            clock.wait_until(due);
            // To the nanosecond that a duration is rounded to.
            assert!(clock.now() >= due - 1e-9);
        }
    }
}
