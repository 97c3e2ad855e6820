//! Table 5-1 as numbers.

use crate::published::cell;

/// Its organs, in its order.
pub(super) const ORGANS: [&str; 4] = ["liver", "esophagus", "kidney", "spleen"];

/// Its depths [mm].
pub(crate) const DEPTHS_MM: [u32; 6] = [1, 2, 4, 5, 6, 8];

/// Half the last digit of its forces [N].
pub(super) const ROUNDING: f64 = 5e-5;

/// Steady forces of an organ at a depth [N].
#[derive(Clone, Copy)]
pub(crate) struct Printed {
    pub(crate) depth_mm: u32,
    pub(crate) min: f64,
    pub(crate) mean: f64,
    pub(crate) max: f64,
    /// Whether a number of the row must be a misprint.
    pub(crate) suspect: bool,
}

impl Printed {
    /// The row of `organ` at `depth_mm`; none where the table has none.
    pub(crate) fn of(organ: &str, depth_mm: u32) -> Option<Self> {
        let cell = |column| cell(&format!("table-5-1 {organ} {depth_mm} {column}")).ok();
        Some(Self {
            depth_mm,
            min: cell("min_n")?,
            mean: cell("mean_n")?,
            max: cell("max_n")?,
            suspect: cell("suspect")? != 0.0,
        })
    }

    /// Its depth [m].
    pub(crate) fn depth(&self) -> f64 {
        1e-3 * f64::from(self.depth_mm)
    }

    /// Its mean as it is drawn, in [mN] over [mm].
    pub(crate) fn drawn(&self) -> (f64, f64) {
        (f64::from(self.depth_mm), 1e3 * self.mean)
    }

    /// All depths [m] and means [N] of `rows`.
    pub(crate) fn columns(rows: &[Self]) -> [Vec<f64>; 2] {
        let means = rows.iter().map(|row| row.mean).collect();
        [rows.iter().map(Self::depth).collect(), means]
    }

    /// All rows of `organ`.
    pub(crate) fn all(organ: &str) -> Vec<Self> {
        DEPTHS_MM
            .into_iter()
            .filter_map(|depth| Self::of(organ, depth))
            .collect()
    }

    /// Forces with this least, mean and largest one, as few as can have them; none where no forces can.
    pub(super) fn forces(&self) -> Option<Vec<f64>> {
        let Self { min, mean, max, .. } = *self;
        if !(min <= mean && mean <= max) {
            return None;
        }
        // The others are alike; what they have to be may be off by the rounding of all three numbers.
        (1..).find_map(|others| {
            let count = f64::from(others);
            let other = ((count + 2.0) * mean - min - max) / count;
            let between = other.clamp(min, max);
            let rounding = ROUNDING * (count + 4.0) / count;
            ((other - between).abs() <= rounding)
                .then(|| [vec![min, max], vec![between; others as usize]].concat())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the three numbers themselves, to their rounding.
    #[test]
    fn forces_have_the_printed_mean() {
        let (mut none, mut some) = (0, 0);
        for printed in ORGANS.into_iter().flat_map(Printed::all) {
            let Some(forces) = printed.forces() else {
                none += 1;
                continue;
            };
            some += 1;
            let mean = forces.iter().sum::<f64>() / forces.len() as f64;
            assert!((mean - printed.mean).abs() <= 2.0 * ROUNDING, "{mean}");
            assert!(
                forces
                    .iter()
                    .all(|f| (printed.min..=printed.max).contains(f))
            );
        }
        assert_eq!((none, some), (3, 20));
    }
}
