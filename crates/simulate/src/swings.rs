//! The frequency at which the depth of a tool oscillates.

/// A smaller oscillation does not count [m]: rounded positions and pose sensors cause such.
const LEAST: f64 = 1e-4;

/// Detects oscillations of a depth, sample by sample.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Swings {
    /// None before the depth has changed.
    rises: Option<bool>,
    /// The farthest depth [m] since the last turn, and when it was [s].
    extreme: Option<(f64, f64)>,
    /// Times of the last two turning points [s].
    turns: [Option<f64>; 2],
    /// The shortest time from a turning point to the next but one [s].
    shortest: Option<f64>,
}

impl Swings {
    pub(crate) fn add(&mut self, time: f64, depth: f64) {
        let (extreme, at) = *self.extreme.get_or_insert((depth, time));
        let change = depth - extreme;
        let ahead = match self.rises {
            Some(false) => -change,
            Some(true) => change,
            None if change.abs() > LEAST => {
                self.rises = Some(change > 0.0);
                change.abs()
            }
            None => return,
        };
        if ahead < -LEAST {
            if let [Some(before), _] = self.turns {
                let cycle = at - before;
                self.shortest = Some(self.shortest.map_or(cycle, |least| least.min(cycle)));
            }
            self.turns = [self.turns[1], Some(at)];
            self.rises = self.rises.map(|rises| !rises);
        }
        if !(-LEAST..0.0).contains(&ahead) {
            self.extreme = Some((depth, time));
        }
    }

    /// Lower bound of the frequency of the fastest cycle [Hz], for samples that are a `step` [s] apart; none without a
    /// cycle.
    pub(crate) fn fastest(&self, step: f64) -> Option<f64> {
        self.shortest.map(|cycle| 1.0 / (cycle + step))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    const STEP: f64 = 0.005;

    fn fastest(of: impl Fn(f64) -> f64) -> Option<f64> {
        let mut swings = Swings::default();
        (0..400).for_each(|step| {
            let time = STEP * f64::from(step);
            swings.add(time, of(time));
        });
        swings.fastest(STEP)
    }

    /// Judge: sines. A turning point is up to half a step from its nearest sample.
    #[test]
    fn a_sine_has_its_frequency() {
        for frequency in [1.0, 4.0, 8.0, 12.0] {
            let found = fastest(|t| 0.004 + 0.002 * (TAU * frequency * t).sin()).unwrap();
            let least = 1.0 / (1.0 / frequency + 2.0 * STEP);
            assert!(
                least - 1e-9 <= found && found <= frequency + 1e-9,
                "{found} for {frequency}"
            );
        }
        assert_eq!(fastest(|t| 0.004 + 4e-5 * (TAU * 20.0 * t).sin()), None);
        assert_eq!(fastest(|t| 0.01 * t), None);
    }
}
