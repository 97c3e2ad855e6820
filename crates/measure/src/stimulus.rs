use std::f64::consts::TAU;

use palpate_files::recording::{self, RecordingHeader};

use crate::Error;

/// What an indenter does, from first contact (figure 5-8).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stimulus {
    /// To a depth, and to stay there.
    RampAndHold {
        /// The depth [m].
        depth: f64,
        /// How long the way takes [s].
        ramp: f64,
        /// How long it stays [s].
        hold: f64,
    },
    /// Swings about a depth, from it downward first.
    Sine {
        /// From the middle to an end [m].
        amplitude: f64,
        /// The middle [m].
        pre_indentation: f64,
        /// How often [Hz].
        frequency: f64,
        /// How many times.
        cycles: f64,
    },
    /// Swings about a depth, faster and faster.
    Chirp {
        /// From the middle to an end [m].
        amplitude: f64,
        /// The middle [m].
        pre_indentation: f64,
        /// How often at the beginning and at the end [Hz].
        frequencies: [f64; 2],
        /// How long [s].
        duration: f64,
        /// Whether the frequency grows by equal parts, not by equal steps.
        exponential: bool,
    },
}

/// How fast the indenter goes to the depth that it swings about [m/s].
const SETTLING_SPEED: f64 = 0.004;
/// How long it stays there first [s].
const SETTLED: f64 = 2.0;

impl Stimulus {
    /// Whether its numbers make sense.
    ///
    /// # Errors
    /// When one of them is not a number above zero, or it would leave the tissue while it swings.
    pub fn check(&self) -> Result<(), Error> {
        let positive = |what: &'static str, found: f64| match found > 0.0 && found.is_finite() {
            true => Ok(()),
            false => Err(Error::Stimulus { what, found }),
        };
        match *self {
            Self::RampAndHold { depth, ramp, hold } => {
                positive("the depth [m]", depth)?;
                positive("the ramp [s]", ramp)?;
                positive("the hold [s]", hold)
            }
            Self::Sine {
                amplitude,
                pre_indentation,
                frequency,
                cycles,
            } => {
                positive("the amplitude [m]", amplitude)?;
                positive(
                    "the pre-indentation less the amplitude [m]",
                    pre_indentation - amplitude,
                )?;
                positive("the frequency [Hz]", frequency)?;
                positive("the number of cycles", cycles)
            }
            Self::Chirp {
                amplitude,
                pre_indentation,
                frequencies,
                duration,
                ..
            } => {
                positive("the amplitude [m]", amplitude)?;
                positive(
                    "the pre-indentation less the amplitude [m]",
                    pre_indentation - amplitude,
                )?;
                positive("the first frequency [Hz]", frequencies[0])?;
                positive("the last frequency [Hz]", frequencies[1])?;
                positive("the duration [s]", duration)
            }
        }
    }

    /// How long it takes, from first contact [s].
    pub fn duration(&self) -> f64 {
        match *self {
            Self::RampAndHold { ramp, hold, .. } => ramp + hold,
            Self::Sine {
                pre_indentation,
                frequency,
                cycles,
                ..
            } => settling(pre_indentation) + cycles / frequency,
            Self::Chirp {
                pre_indentation,
                duration,
                ..
            } => settling(pre_indentation) + duration,
        }
    }

    /// The deepest that it goes [m].
    pub fn deepest(&self) -> f64 {
        match *self {
            Self::RampAndHold { depth, .. } => depth,
            Self::Sine {
                amplitude,
                pre_indentation,
                ..
            }
            | Self::Chirp {
                amplitude,
                pre_indentation,
                ..
            } => pre_indentation + amplitude,
        }
    }

    /// The fastest that it goes [m/s].
    pub fn fastest(&self) -> f64 {
        match *self {
            Self::RampAndHold { depth, ramp, .. } => depth / ramp,
            Self::Sine {
                amplitude,
                frequency,
                ..
            } => SETTLING_SPEED.max(TAU * frequency * amplitude),
            Self::Chirp {
                amplitude,
                frequencies,
                ..
            } => SETTLING_SPEED.max(TAU * frequencies[0].max(frequencies[1]) * amplitude),
        }
    }

    /// Depth [m] and speed [m/s] at `time` [s] from first contact.
    pub fn at(&self, time: f64) -> [f64; 2] {
        match *self {
            Self::RampAndHold { depth, ramp, .. } => ramp_to(depth, ramp, time),
            Self::Sine {
                amplitude,
                pre_indentation,
                frequency,
                ..
            } => about(pre_indentation, amplitude, time, |t| {
                [TAU * frequency * t, TAU * frequency]
            }),
            Self::Chirp {
                amplitude,
                pre_indentation,
                frequencies: [first, last],
                duration,
                exponential,
            } => about(pre_indentation, amplitude, time, |t| {
                sweep([first, last], duration, exponential, t)
            }),
        }
    }

    /// What a recording's head says of it.
    pub(crate) fn describe(&self, header: &mut RecordingHeader) {
        match *self {
            Self::RampAndHold { depth, ramp, .. } => {
                header.stimulus = Some(recording::Stimulus::RampAndHold);
                header.amplitude_m = Some(depth);
                header.ramp_s = Some(ramp);
            }
            Self::Sine {
                amplitude,
                pre_indentation,
                frequency,
                ..
            } => {
                header.stimulus = Some(recording::Stimulus::Sine);
                header.amplitude_m = Some(amplitude);
                header.pre_indentation_m = Some(pre_indentation);
                header.frequency_hz = Some(frequency);
            }
            Self::Chirp {
                amplitude,
                pre_indentation,
                frequencies,
                exponential,
                ..
            } => {
                header.stimulus = Some(match exponential {
                    true => recording::Stimulus::ChirpExponential,
                    false => recording::Stimulus::ChirpLinear,
                });
                header.amplitude_m = Some(amplitude);
                header.pre_indentation_m = Some(pre_indentation);
                header.frequency_hz = Some(frequencies[0]);
                header.end_frequency_hz = Some(frequencies[1]);
            }
        }
    }
}

/// The time to a depth that is swung about, and to rest there [s].
fn settling(pre_indentation: f64) -> f64 {
    pre_indentation / SETTLING_SPEED + SETTLED
}

fn ramp_to(depth: f64, ramp: f64, time: f64) -> [f64; 2] {
    if time < ramp {
        [depth * (time / ramp).max(0.0), depth / ramp]
    } else {
        [depth, 0.0]
    }
}

/// To `middle` [m], and when that is settled, swings with phase [rad] and its rate [rad/s].
fn about(middle: f64, amplitude: f64, time: f64, phase: impl Fn(f64) -> [f64; 2]) -> [f64; 2] {
    let swinging = time - settling(middle);
    if swinging < 0.0 {
        return ramp_to(middle, middle / SETTLING_SPEED, time);
    }
    let [phase, rate] = phase(swinging);
    [
        middle + amplitude * phase.sin(),
        amplitude * rate * phase.cos(),
    ]
}

/// Phase [rad] and rate [rad/s] of a chirp.
fn sweep([first, last]: [f64; 2], duration: f64, exponential: bool, time: f64) -> [f64; 2] {
    let growth = (last / first).ln() / duration;
    if exponential && growth.abs() > 1e-9 {
        let rate = TAU * first * (growth * time).exp();
        [(rate - TAU * first) / growth, rate]
    } else {
        let slope = (last - first) / duration;
        let phase = TAU * (first + 0.5 * slope * time) * time;
        [phase, TAU * (first + slope * time)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> [Stimulus; 4] {
        let chirp = |exponential| Stimulus::Chirp {
            amplitude: 1e-3,
            pre_indentation: 2e-3,
            frequencies: [0.5, 5.0],
            duration: 10.0,
            exponential,
        };
        let ramp = Stimulus::RampAndHold {
            depth: 4e-3,
            ramp: 0.5,
            hold: 10.0,
        };
        let sine = Stimulus::Sine {
            amplitude: 1e-3,
            pre_indentation: 2e-3,
            frequency: 2.0,
            cycles: 5.0,
        };
        [ramp, sine, chirp(false), chirp(true)]
    }

    /// Speeds are differences of depths, wherever a course has no corner; the error of a central difference is
    /// that of the square of its step.
    #[test]
    fn speeds_are_those_of_the_depths() {
        for stimulus in all() {
            stimulus.check().unwrap();
            for i in 1..1000 {
                let time = 0.0097 * f64::from(i);
                let [before, after] = [time - 1e-5, time + 1e-5].map(|t| stimulus.at(t));
                if (before[1] - after[1]).abs() > 0.1 * stimulus.fastest() {
                    continue;
                }
                let speed = (after[0] - before[0]) / 2e-5;
                let off = (speed - stimulus.at(time)[1]).abs();
                assert!(off < 1e-5, "{stimulus:?} at {time}: {off}");
                assert!(stimulus.at(time)[0] <= stimulus.deepest() + 1e-12);
                assert!(stimulus.at(time)[1].abs() <= stimulus.fastest() + 1e-12);
            }
        }
    }

    /// A chirp ends with its last frequency.
    #[test]
    fn chirps_arrive() {
        for exponential in [false, true] {
            let [_, first] = sweep([0.5, 5.0], 10.0, exponential, 0.0);
            let [_, last] = sweep([0.5, 5.0], 10.0, exponential, 10.0);
            assert!((first / TAU - 0.5).abs() < 1e-12 && (last / TAU - 5.0).abs() < 1e-9);
        }
    }

    #[test]
    fn what_leaves_the_tissue_is_refused() {
        let sine = Stimulus::Sine {
            amplitude: 2e-3,
            pre_indentation: 1e-3,
            frequency: 1.0,
            cycles: 3.0,
        };
        let said = sine.check().unwrap_err().to_string();
        assert!(
            said.contains("pre-indentation less the amplitude"),
            "{said}"
        );
    }
}
