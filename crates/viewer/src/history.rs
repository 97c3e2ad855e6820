use std::collections::VecDeque;

/// How far back the plots go [s].
pub(crate) const SPAN: f64 = 10.0;

/// Points that a curve is drawn with.
const POINTS: usize = 500;

/// The last seconds of one tool.
#[derive(Debug, Clone, Default)]
pub(crate) struct History {
    /// Time [s], force [N], depth [m].
    samples: VecDeque<[f64; 3]>,
}

impl History {
    /// Adds the force [N] and the depth [m] at `time` [s].
    pub(crate) fn add(&mut self, time: f64, [force, depth]: [f64; 2]) {
        self.samples.push_back([time, force, depth]);
        let oldest = time - SPAN;
        while self.samples.front().is_some_and(|s| s[0] < oldest) {
            self.samples.pop_front();
        }
    }

    /// Another tool, or another organ.
    pub(crate) fn clear(&mut self) {
        self.samples.clear();
    }

    /// The last force [N] and depth [m].
    pub(crate) fn last(&self) -> (f64, f64) {
        self.samples.back().map_or((0.0, 0.0), |s| (s[1], s[2]))
    }

    /// Force [mN] against seconds before now: of each stretch of time the largest, so that no peak is lost.
    pub(crate) fn force(&self) -> Vec<[f64; 2]> {
        self.curve(|stretch| largest(stretch, 1))
    }

    /// The same of a sensor, whose noise has peaks of its own: of each stretch of time the mean.
    pub(crate) fn mean_force(&self) -> Vec<[f64; 2]> {
        self.curve(|stretch| {
            stretch.iter().map(|sample| sample[1]).sum::<f64>() / stretch.len() as f64
        })
    }

    /// Depth [mm] against seconds before now.
    pub(crate) fn depth(&self) -> Vec<[f64; 2]> {
        self.curve(|stretch| largest(stretch, 2))
    }

    /// A value of each stretch of samples, in thousandths of its unit.
    fn curve(&self, value: impl Fn(&[&[f64; 3]]) -> f64) -> Vec<[f64; 2]> {
        let Some(now) = self.samples.back().map(|sample| sample[0]) else {
            return Vec::new();
        };
        let length = SPAN / POINTS as f64;
        // Stretches are counted from time zero, so that peaks stay where they are as time goes on.
        let number = |sample: &[f64; 3]| (sample[0] / length).floor();
        let samples: Vec<&[f64; 3]> = self.samples.iter().collect();
        let stretches = samples.chunk_by(|one, other| number(one) == number(other));
        let point = |own: &[&[f64; 3]]| [number(own[0]) * length - now, 1e3 * value(own)];
        stretches.map(point).collect()
    }
}

fn largest(stretch: &[&[f64; 3]], column: usize) -> f64 {
    let values = stretch.iter().map(|sample| sample[column]);
    values.fold(f64::NEG_INFINITY, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_peak_of_one_step_is_drawn_and_the_past_forgotten() {
        let mut history = History::default();
        for step in 0..20_000 {
            let force = if step == 19_001 { 0.5 } else { 0.1 };
            history.add(f64::from(step) * 0.005, [force, 0.001]);
        }
        assert!(history.samples.len() <= 2_001);
        let force = history.force();
        assert!(force.len() <= POINTS + 2);
        let peak = force.iter().fold(0.0_f64, |a, p| a.max(p[1]));
        assert_eq!(peak, 500.0);
        // Four steps are a stretch.
        let mean = history.mean_force();
        let peak = mean.iter().fold(0.0_f64, |a, p| a.max(p[1]));
        assert!((peak - 200.0).abs() < 1e-9, "{peak}");
    }
}
