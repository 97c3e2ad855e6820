/// Bits of a time in nanoseconds that distinguish bins within one power of two: a bin is 1/16 wide or less.
const FINE: u32 = 4;
/// Powers of two with bins of their own: up to 2⁴⁰ ns, 18 minutes.
const POWERS: usize = 40;
const BINS: usize = (POWERS - FINE as usize + 2) << FINE;

/// A histogram of times, in bins of at most a sixteenth of their size; it never grows.
#[derive(Debug, Clone)]
pub struct Histogram {
    bins: [u64; BINS],
    count: u64,
    longest: u64,
}

/// Percentiles of times [s].
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct Percentiles {
    /// Median [s].
    pub p50: f64,
    /// 99th percentile [s].
    pub p99: f64,
    /// 99.9th percentile [s].
    pub p99_9: f64,
    /// Maximum [s].
    pub max: f64,
}

impl Default for Histogram {
    fn default() -> Self {
        Self {
            bins: [0; BINS],
            count: 0,
            longest: 0,
        }
    }
}

impl Histogram {
    /// Counts a `time` [s]; a negative one counts as zero.
    pub fn add(&mut self, time: f64) {
        let nanoseconds = (time * 1e9) as u64;
        self.bins[bin(nanoseconds)] += 1;
        self.count += 1;
        self.longest = self.longest.max(nanoseconds);
    }

    /// Number of counted times.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The percentiles: upper ends of bins, so at most 1/16 above the true value; the maximum is exact.
    pub fn percentiles(&self) -> Percentiles {
        let mut left = [0.5, 0.99, 0.999].map(|part| (part * self.count as f64).ceil() as u64);
        let mut found = [0.0; 3];
        for (number, &times) in self.bins.iter().enumerate() {
            for (left, found) in left.iter_mut().zip(&mut found) {
                if *left > 0 {
                    *left = left.saturating_sub(times);
                    *found = upper_end(number).min(self.longest) as f64 * 1e-9;
                }
            }
        }
        Percentiles {
            p50: found[0],
            p99: found[1],
            p99_9: found[2],
            max: self.longest as f64 * 1e-9,
        }
    }
}

fn bin(nanoseconds: u64) -> usize {
    if nanoseconds < 1 << FINE {
        return nanoseconds as usize;
    }
    let power = nanoseconds.ilog2();
    let fine = (nanoseconds >> (power - FINE)) as usize & ((1 << FINE) - 1);
    ((((power - FINE + 1) as usize) << FINE) + fine).min(BINS - 1)
}

/// The largest time [ns] in a bin.
fn upper_end(bin: usize) -> u64 {
    if bin < 1 << FINE {
        return bin as u64;
    }
    let power = (bin >> FINE) - 1;
    let fine = (bin & ((1 << FINE) - 1)) as u64;
    (((1 << FINE) + fine + 1) << power) - 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_time_is_in_a_bin_that_ends_within_a_sixteenth() {
        for power in 0..POWERS as u32 {
            for time in [1u64 << power, (1 << power) + 1, (2 << power) - 1] {
                let end = upper_end(bin(time));
                assert!(end >= time && end - time <= time / 16, "{time}: {end}");
            }
        }
        assert_eq!(bin(u64::MAX), BINS - 1);
    }

    #[test]
    fn percentiles_of_a_thousand_times() {
        let mut histogram = Histogram::default();
        (1..=1000).for_each(|number| histogram.add(f64::from(number) * 1e-6));
        let found = histogram.percentiles();
        for (found, exact) in [(found.p50, 500.0), (found.p99, 990.0), (found.p99_9, 999.0)] {
            let ratio = found * 1e6 / exact;
            // The width of a bin.
            assert!(
                (1.0..=1.0 + 1.0 / 16.0).contains(&ratio),
                "{exact}: {ratio}"
            );
        }
        // Truncated to a nanosecond.
        assert!((found.max - 1e-3).abs() < 2e-9);
        assert_eq!(Histogram::default().percentiles(), Percentiles::default());
    }
}
