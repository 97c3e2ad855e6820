//! Uniformity of the sampling of a recording, and the uniform grid on which it is filtered.

use super::LowPass;
use crate::Error;

/// An interval longer than this many usual ones is a gap [-].
const GAP: f64 = 3.0;
/// Intervals that differ by less than this part are even [-].
const EVEN: f64 = 0.05;
/// Most points of an even grid.
const MAX_POINTS: f64 = 2e6;

/// The intervals between the samples of a recording.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sampling {
    /// Samples per second, from the usual (median) interval [Hz].
    pub rate_hz: f64,
    /// Whether all intervals are alike, within 5 %.
    pub is_even: bool,
    /// Intervals more than three times as long as the usual one.
    pub gaps: usize,
    /// The longest interval [s].
    pub longest_s: f64,
    /// The shortest interval [s].
    shortest: f64,
}

impl Sampling {
    /// Of two or more ascending `times` [s].
    pub(super) fn of(times: &[f64]) -> Self {
        let mut intervals: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        intervals.sort_by(f64::total_cmp);
        let usual = intervals[intervals.len() / 2];
        let (shortest, longest_s) = (intervals[0], intervals[intervals.len() - 1]);
        Self {
            rate_hz: 1.0 / usual,
            is_even: longest_s - shortest <= EVEN * usual,
            gaps: intervals.iter().filter(|&&own| own > GAP * usual).count(),
            longest_s,
            shortest,
        }
    }

    pub(super) fn add_warnings(&self, warnings: &mut Vec<String>) {
        if self.gaps > 0 {
            warnings.push(format!(
                "samples are missing in {} places, for up to {:.3} s; the curve is taken as straight there",
                self.gaps, self.longest_s
            ));
        } else if !self.is_even {
            warnings.push(format!(
                "samples do not come evenly, from {:.4} to {:.4} s apart; for the filter they were laid on even times",
                self.shortest, self.longest_s
            ));
        }
    }

    /// `values` at `times` [s] through a low-pass with `cutoff` [Hz].
    pub(super) fn smooth(
        &self,
        times: &[f64],
        values: &[f64],
        cutoff: f64,
    ) -> Result<Vec<f64>, Error> {
        let filter = LowPass::new(cutoff, self.rate_hz)?;
        if self.is_even {
            return Ok(filter.smooth(values));
        }
        let (start, end) = (times[0], times[times.len() - 1]);
        let points = ((end - start) / self.shortest).ceil().min(MAX_POINTS);
        let step = (end - start) / points;
        let grid: Vec<f64> = (0..=points as usize)
            .map(|i| start + i as f64 * step)
            .collect();
        let laid = interpolated(times, values, &grid);
        let smooth = LowPass::new(cutoff, 1.0 / step)?.smooth(&laid);
        Ok(interpolated(&grid, &smooth, times))
    }
}

/// The values at ascending places `wanted`, linear between those at ascending `places`; the first and
/// last value beyond them.
pub(super) fn interpolated(places: &[f64], values: &[f64], wanted: &[f64]) -> Vec<f64> {
    let mut next = 0;
    let at = |&place: &f64| {
        while next < places.len() && places[next] <= place {
            next += 1;
        }
        match next {
            0 => values[0],
            _ if next == places.len() => values[next - 1],
            _ => {
                let share = (place - places[next - 1]) / (places[next] - places[next - 1]);
                values[next - 1] + share * (values[next] - values[next - 1])
            }
        }
    };
    wanted.iter().map(at).collect()
}
