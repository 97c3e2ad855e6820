//! Animals of appendix A whose forces have the spread of table 5-1.
//!
//! Of n animals, number k has at every depth the force
//!
//! ```text
//! F_k = least + (largest − least) (k / (n − 1))^p,   k = 0 … n − 1
//! ```
//!
//! with the power p that gives the printed mean. *Assumed*: the order of the animals, which is that of the appendix;
//! where a bound is a misprint, the spread over the mean is that of the nearest depth without one. A mean that n
//! animals cannot have between their bounds is met as nearly as p within 8 and 1/8 allows.

use crate::m06::Printed;

/// Largest power, and one over the least.
const STEEPEST: f64 = 8.0;

/// How the forces of an organ spread at a depth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spread {
    least: f64,
    largest: f64,
    power: f64,
    animals: usize,
}

impl Spread {
    /// At each depth of the printed table of `organ`.
    pub(super) fn all(organ: &str, animals: usize) -> Vec<Self> {
        let printed = Printed::all(organ);
        let each = printed.iter().map(|row| {
            let right = printed.iter().filter(|other| !other.suspect);
            let bounds = right.min_by_key(|other| other.depth_mm.abs_diff(row.depth_mm));
            let bounds = bounds.unwrap_or(row);
            let part = row.mean / bounds.mean;
            Self::with_mean([part * bounds.min, row.mean, part * bounds.max], animals)
        });
        each.collect()
    }

    fn with_mean([least, mean, largest]: [f64; 3], animals: usize) -> Self {
        let of_power = |power: f64| Self {
            least,
            largest,
            power,
            animals,
        };
        // The mean falls with the power.
        let (mut low, mut high) = (1.0 / STEEPEST, STEEPEST);
        for _ in 0..60 {
            let middle = f64::sqrt(low * high);
            if of_power(middle).mean() > mean {
                low = middle;
            } else {
                high = middle;
            }
        }
        of_power(high)
    }

    /// The force of animal `number`, counted from zero [N].
    pub(super) fn force(&self, number: usize) -> f64 {
        let rank = number as f64 / (self.animals - 1).max(1) as f64;
        self.least + (self.largest - self.least) * rank.powf(self.power)
    }

    /// The mean over all animals [N].
    pub(super) fn mean(&self) -> f64 {
        let sum: f64 = (0..self.animals).map(|number| self.force(number)).sum();
        sum / self.animals as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the printed numbers, which the bounds meet exactly and the mean to rounding; the liver at 2 mm has a mean
    /// that ten animals cannot have, for nine at the least and one at the largest force have more.
    #[test]
    fn spreads_have_the_printed_numbers() {
        for (organ, animals) in [
            ("liver", 10),
            ("esophagus", 8),
            ("kidney", 5),
            ("spleen", 4),
        ] {
            for (spread, row) in Spread::all(organ, animals).iter().zip(Printed::all(organ)) {
                let most = row.min + (row.max - row.min) / animals as f64;
                if row.suspect || row.mean < most {
                    continue;
                }
                assert!(
                    (spread.mean() / row.mean - 1.0).abs() < 1e-9,
                    "{organ} {spread:?}"
                );
                assert_eq!(spread.force(0), row.min);
                assert!((spread.force(animals - 1) / row.max - 1.0).abs() < 1e-12);
            }
        }
        let liver = Spread::all("liver", 10)[1];
        assert!((1.0..1.05).contains(&(liver.mean() / 0.0079)), "{liver:?}");
    }
}
