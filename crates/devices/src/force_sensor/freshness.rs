use std::time::{Duration, Instant};

use palpate_servo::SensorFault;

/// The age of the last reading.
#[derive(Debug, Clone, Copy)]
pub(super) struct Freshness {
    last: Instant,
    limit: Duration,
}

impl Freshness {
    /// Fresh now, and for this long [s].
    pub(super) fn new(limit: f64) -> Self {
        Self {
            last: Instant::now(),
            limit: Duration::from_secs_f64(limit),
        }
    }

    /// A reading came.
    pub(super) fn renew(&mut self) {
        self.last = Instant::now();
    }

    /// An error when the last reading is too old.
    pub(super) fn check(&self) -> Result<(), SensorFault> {
        let age = self.last.elapsed();
        match age > self.limit {
            true => Err(SensorFault::Silent {
                age: age.as_secs_f64(),
                limit: self.limit.as_secs_f64(),
            }),
            false => Ok(()),
        }
    }
}

/// The sequence numbers of readings, which grow by one from each to the next.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sequence {
    last: Option<u32>,
    /// Lost readings, less one for each hundred that arrived [-].
    missing: f64,
}

/// More lost readings than that are a fault: ten at once, or one in a hundred for long.
const MAX_MISSING: f64 = 10.0;
/// Decrease for each reading that arrived.
const FORGIVEN: f64 = 0.01;

impl Sequence {
    /// Whether the reading with this number is newer than all before it.
    ///
    /// # Errors
    /// When too many before it were lost.
    pub(super) fn is_new(&mut self, number: u32) -> Result<bool, SensorFault> {
        let Some(last) = self.last else {
            self.last = Some(number);
            return Ok(true);
        };
        let gap = number.wrapping_sub(last);
        // A repeated or overtaken reading.
        if gap == 0 || gap > u32::MAX / 2 {
            return Ok(false);
        }
        self.last = Some(number);
        self.missing = (self.missing - FORGIVEN).max(0.0) + f64::from(gap - 1);
        if self.missing > MAX_MISSING {
            let lost = self.missing.ceil() as u32;
            self.missing = 0.0;
            return Err(SensorFault::Lost { lost });
        }
        Ok(true)
    }

    /// A sensor that was silent may count from any number.
    pub(super) fn reset(&mut self) {
        self.last = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lost(numbers: impl IntoIterator<Item = u32>) -> Option<u32> {
        let mut sequence = Sequence::default();
        numbers
            .into_iter()
            .find_map(|number| match sequence.is_new(number) {
                Err(SensorFault::Lost { lost }) => Some(lost),
                _ => None,
            })
    }

    #[test]
    fn ten_lost_readings_are_forgiven_and_eleven_are_not() {
        assert_eq!(lost([1, 12, 13]), None);
        assert_eq!(lost([1, 13]), Some(11));
        // Across the wrap-around of the numbers.
        assert_eq!(lost([u32::MAX - 1, u32::MAX, 0, 1]), None);
        assert_eq!(lost([u32::MAX - 1, 20]), Some(21));
    }

    /// One lost in two hundred is tolerated without end, one in fifty is not.
    #[test]
    fn a_rate_of_loss_is_a_fault() {
        let without = |every: u32| (1..100_000).filter(move |number| number % every != 0);
        assert_eq!(lost(without(200)), None);
        assert_eq!(lost(without(50)), Some(11));
    }

    #[test]
    fn an_overtaken_reading_is_not_new() {
        let mut sequence = Sequence::default();
        let new = [5, 7, 6, 7, 8].map(|number| sequence.is_new(number).unwrap());
        assert_eq!(new, [true, true, false, false, true]);
    }
}
