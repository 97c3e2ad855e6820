use std::f64::consts::TAU;

use palpate_files::protocol::{Stimulus, Sweep};
use palpate_files::recording::RecordingHeader;

use crate::Error;

/// Depth over time of a valid stimulus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepthTrajectory(Stimulus);

/// How fast the indenter goes to the depth that it swings about [m/s].
const SETTLING_SPEED: f64 = 0.004;
/// How long it stays there first [s].
const SETTLED: f64 = 2.0;

/// How far the indenter overshoots a stimulus at most [m].
const OVERSHOOT: f64 = 0.2e-3;

impl DepthTrajectory {
    /// The course of `stimulus`.
    ///
    /// # Errors
    /// When one of its numbers is not above zero, or it would leave the tissue while it swings.
    pub fn of(stimulus: Stimulus) -> Result<Self, Error> {
        let positive = |(what, found): (&'static str, f64)| match found > 0.0 && found.is_finite() {
            true => Ok(()),
            false => Err(Error::Stimulus { what, found }),
        };
        match stimulus {
            Stimulus::RampAndHold {
                depth_m,
                ramp_s,
                hold_s,
            } => [
                ("the depth [m]", depth_m),
                ("the ramp [s]", ramp_s),
                ("the hold [s]", hold_s),
            ]
            .into_iter()
            .try_for_each(positive),
            Stimulus::Swing {
                amplitude_m,
                pre_indentation_m,
                sweep,
                duration_s,
            } => [
                ("the amplitude [m]", amplitude_m),
                (
                    "the pre-indentation less the amplitude [m]",
                    pre_indentation_m - amplitude_m,
                ),
                ("the first frequency [Hz]", sweep.ends()[0]),
                ("the last frequency [Hz]", sweep.ends()[1]),
                ("the duration [s]", duration_s),
            ]
            .into_iter()
            .try_for_each(positive),
        }
        .map(|()| Self(stimulus))
    }

    /// What is pressed.
    pub fn stimulus(&self) -> Stimulus {
        self.0
    }

    /// How long it takes, from first contact [s].
    pub fn duration(&self) -> f64 {
        match self.0 {
            Stimulus::RampAndHold { ramp_s, hold_s, .. } => ramp_s + hold_s,
            Stimulus::Swing {
                pre_indentation_m,
                duration_s,
                ..
            } => settling(pre_indentation_m) + duration_s,
        }
    }

    /// The deepest that it goes [m].
    pub fn deepest(&self) -> f64 {
        match self.0 {
            Stimulus::RampAndHold { depth_m, .. } => depth_m,
            Stimulus::Swing {
                amplitude_m,
                pre_indentation_m,
                ..
            } => pre_indentation_m + amplitude_m,
        }
    }

    /// The deepest that an indenter may come on it, which overshoots [m].
    pub fn deepest_expected(&self) -> f64 {
        self.deepest() + OVERSHOOT
    }

    /// The fastest that it goes [m/s].
    pub fn fastest(&self) -> f64 {
        match self.0 {
            Stimulus::RampAndHold {
                depth_m, ramp_s, ..
            } => depth_m / ramp_s,
            Stimulus::Swing {
                amplitude_m, sweep, ..
            } => {
                let [first, last] = sweep.ends();
                SETTLING_SPEED.max(TAU * first.max(last) * amplitude_m)
            }
        }
    }

    /// Depth [m] and speed [m/s] at `time` [s] from first contact.
    pub fn at(&self, time: f64) -> [f64; 2] {
        match self.0 {
            Stimulus::RampAndHold {
                depth_m, ramp_s, ..
            } => ramp_to(depth_m, ramp_s, time),
            Stimulus::Swing {
                amplitude_m,
                pre_indentation_m: middle,
                sweep,
                duration_s,
            } => {
                let swinging = time - settling(middle);
                if swinging < 0.0 {
                    return ramp_to(middle, middle / SETTLING_SPEED, time);
                }
                let [phase, rate] = phase(sweep, duration_s, swinging);
                [
                    middle + amplitude_m * phase.sin(),
                    amplitude_m * rate * phase.cos(),
                ]
            }
        }
    }

    /// Header of its recording.
    pub(crate) fn describe(&self, header: &mut RecordingHeader) {
        header.stimulus = Some(self.0.kind());
        match self.0 {
            Stimulus::RampAndHold {
                depth_m, ramp_s, ..
            } => {
                header.amplitude_m = Some(depth_m);
                header.ramp_s = Some(ramp_s);
            }
            Stimulus::Swing {
                amplitude_m,
                pre_indentation_m,
                sweep,
                ..
            } => {
                let [first, last] = sweep.ends();
                header.amplitude_m = Some(amplitude_m);
                header.pre_indentation_m = Some(pre_indentation_m);
                header.frequency_hz = Some(first);
                header.end_frequency_hz = (!matches!(sweep, Sweep::Constant(_))).then_some(last);
            }
        }
    }
}

/// The time to a depth that is swung about, and to rest there [s].
fn settling(middle: f64) -> f64 {
    middle / SETTLING_SPEED + SETTLED
}

fn ramp_to(depth: f64, ramp: f64, time: f64) -> [f64; 2] {
    if time < ramp {
        [depth * (time / ramp).max(0.0), depth / ramp]
    } else {
        [depth, 0.0]
    }
}

/// Phase [rad] and its rate [rad/s] at `time` [s] of a sweep over `duration` [s].
fn phase(sweep: Sweep, duration: f64, time: f64) -> [f64; 2] {
    let [first, last] = sweep.ends();
    match sweep {
        Sweep::Exponential(_) if first != last => {
            let growth = (last / first).ln() / duration;
            let gone = (growth * time).exp_m1();
            [TAU * first * gone / growth, TAU * first * (1.0 + gone)]
        }
        _ => {
            let slope = (last - first) / duration;
            let phase = TAU * (first + 0.5 * slope * time) * time;
            [phase, TAU * (first + slope * time)]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn swing(sweep: Sweep) -> Stimulus {
        Stimulus::Swing {
            amplitude_m: 1e-3,
            pre_indentation_m: 2e-3,
            sweep,
            duration_s: 10.0,
        }
    }

    fn all() -> [DepthTrajectory; 4] {
        let ramp = Stimulus::RampAndHold {
            depth_m: 4e-3,
            ramp_s: 0.5,
            hold_s: 10.0,
        };
        let swings = [
            Sweep::Constant(2.0),
            Sweep::Linear([0.5, 5.0]),
            Sweep::Exponential([0.5, 5.0]),
        ];
        let [sine, linear, exponential] = swings.map(swing);
        [ramp, sine, linear, exponential].map(|stimulus| DepthTrajectory::of(stimulus).unwrap())
    }

    /// Speeds are differences of depths, wherever a course has no corner; the error of a central difference is
    /// that of the square of its step.
    #[test]
    fn speeds_are_those_of_the_depths() {
        for trajectory in all() {
            for i in 1..1000 {
                let time = 0.0097 * f64::from(i);
                let [before, after] = [time - 1e-5, time + 1e-5].map(|t| trajectory.at(t));
                if (before[1] - after[1]).abs() > 0.1 * trajectory.fastest() {
                    continue;
                }
                let speed = (after[0] - before[0]) / 2e-5;
                let off = (speed - trajectory.at(time)[1]).abs();
                assert!(off < 1e-5, "{trajectory:?} at {time}: {off}");
                assert!(trajectory.at(time)[0] <= trajectory.deepest() + 1e-12);
                assert!(trajectory.at(time)[1].abs() <= trajectory.fastest() + 1e-12);
            }
        }
    }

    /// A chirp ends with its last frequency, and one that grows by nothing is a sine.
    #[test]
    fn chirps_arrive() {
        for sweep in [Sweep::Linear, Sweep::Exponential] {
            let [_, first] = phase(sweep([0.5, 5.0]), 10.0, 0.0);
            let [_, last] = phase(sweep([0.5, 5.0]), 10.0, 10.0);
            assert!((first / TAU - 0.5).abs() < 1e-12 && (last / TAU - 5.0).abs() < 1e-9);
            let still = phase(sweep([2.0, 2.0]), 10.0, 3.0);
            assert_eq!(still, phase(Sweep::Constant(2.0), 10.0, 3.0));
        }
    }

    #[test]
    fn what_leaves_the_tissue_is_refused() {
        let leaving = Stimulus::Swing {
            amplitude_m: 2e-3,
            pre_indentation_m: 1e-3,
            sweep: Sweep::Constant(1.0),
            duration_s: 3.0,
        };
        let said = DepthTrajectory::of(leaving).unwrap_err().to_string();
        assert!(
            said.contains("pre-indentation less the amplitude"),
            "{said}"
        );
    }
}
