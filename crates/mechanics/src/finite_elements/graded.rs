//! Lines whose intervals grow away from where the answer changes fast.

/// How the intervals of a line grow.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grading {
    /// The first interval [m].
    pub(super) first: f64,
    /// Growth from one interval to the next [-] ...
    pub(super) growth: f64,
    /// ... up to this place [m], ...
    pub(super) near: f64,
    /// ... and beyond it [-].
    pub(super) far_growth: f64,
}

impl Grading {
    /// Places from 0 to `length` [m]; then every interval is halved `halvings` times. Below 0 the first is
    /// doubled as often, and there is one where there would be two.
    pub(super) fn line(&self, length: f64, halvings: i32) -> Vec<f64> {
        if halvings < 0 {
            let coarse = Self {
                first: 2.0 * self.first,
                growth: self.growth.powi(2),
                far_growth: self.far_growth.powi(2),
                ..*self
            };
            return coarse.line(length, halvings + 1);
        }
        let (mut line, mut interval) = (vec![0.0], self.first);
        let mut at = 0.0;
        while at + interval < length {
            at += interval;
            line.push(at);
            interval *= if at < self.near {
                self.growth
            } else {
                self.far_growth
            };
        }
        // A rest that is no good interval of its own goes to the last, which is the longest.
        if line.len() > 1 && length - at < 0.5 * interval {
            line.pop();
        }
        line.push(length);
        for _ in 0..halvings {
            line = halved(&line);
        }
        line
    }
}

/// `line` with `parts` intervals [-] in the place of each, as near as whole numbers come: places in between
/// are where the line's own numbering, continued linearly, has them.
pub(super) fn resampled(line: &[f64], parts: f64) -> Vec<f64> {
    let last = line.len() - 1;
    let intervals = (parts * last as f64).round().max(1.0) as usize;
    (0..=intervals)
        .map(|k| {
            let at = (k * last) as f64 / intervals as f64;
            let from = (at as usize).min(last - 1);
            let part = at - from as f64;
            (1.0 - part) * line[from] + part * line[from + 1]
        })
        .collect()
}

/// `line` with the middle of every interval.
pub(super) fn halved(line: &[f64]) -> Vec<f64> {
    let mut all: Vec<f64> = line
        .windows(2)
        .flat_map(|w| [w[0], 0.5 * (w[0] + w[1])])
        .collect();
    all.extend(line.last());
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_where_asked_and_nests() {
        let grading = Grading {
            first: 0.1,
            growth: 1.25,
            near: 3.0,
            far_growth: 1.7,
        };
        for length in [0.05, 0.1, 0.13, 0.3, 1.0, 7.0, 100.0] {
            let line = grading.line(length, 0);
            assert_eq!(line[0], 0.0);
            assert_eq!(*line.last().unwrap(), length);
            assert!(line.windows(2).all(|w| w[1] > w[0]), "{line:?}");
            assert!(line.len() < 3 || line[1] == 0.1, "{line:?}");
            let fine = grading.line(length, 1);
            assert!(line.iter().enumerate().all(|(i, x)| fine[2 * i] == *x));
            let coarse = grading.line(length, -1);
            assert_eq!([coarse[0], *coarse.last().unwrap()], [0.0, length]);
            assert!(coarse.len() < 3 || coarse[1] == 0.2, "{coarse:?}");
            assert!(2 * coarse.len() <= line.len() + 4, "{coarse:?}");
            assert_eq!(resampled(&line, 2.0), fine);
            assert_eq!(resampled(&line, 1.0), line);
        }
    }
}
