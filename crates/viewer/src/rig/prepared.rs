use palpate_files::protocol::{Stimulus, Sweep};
use palpate_measure::{DepthTrajectory, RigSettings};

/// A stimulus with its button and its settings.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Prepared {
    pub(super) stimulus: Stimulus,
    /// How often a protocol repeats it.
    pub(super) repeats: u64,
    /// Whether its numbers are shown.
    pub(super) open: bool,
}

impl Prepared {
    pub(super) fn new(trajectory: DepthTrajectory, repeats: u64) -> Self {
        Self {
            stimulus: trajectory.stimulus(),
            repeats,
            open: false,
        }
    }

    /// Its course, or why it cannot be pressed.
    pub(super) fn trajectory(&self, settings: &RigSettings) -> Result<DepthTrajectory, String> {
        let trajectory = DepthTrajectory::of(self.stimulus).map_err(|error| error.to_string())?;
        settings
            .check(&trajectory)
            .map_err(|error| error.to_string())?;
        Ok(trajectory)
    }

    /// Its course, as often as it is repeated; nothing when it makes no sense.
    pub(super) fn repeated(&self) -> impl Iterator<Item = DepthTrajectory> {
        let trajectory = DepthTrajectory::of(self.stimulus).ok();
        let repeats = self.repeats as usize;
        trajectory
            .into_iter()
            .flat_map(move |trajectory| std::iter::repeat_n(trajectory, repeats))
    }

    /// Its kind, depth and repetitions.
    pub(super) fn words(&self) -> [String; 2] {
        let mm = |metres: f64| format!("{} mm", (1e6 * metres).round() / 1e3);
        match self.stimulus {
            Stimulus::RampAndHold {
                depth_m,
                ramp_s,
                hold_s,
            } => [
                format!("ramp and hold  {}", mm(depth_m)),
                format!("down in {ramp_s} s, held for {hold_s} s"),
            ],
            Stimulus::Swing {
                amplitude_m,
                pre_indentation_m,
                sweep,
                duration_s,
            } => {
                let often = match sweep {
                    Sweep::Constant(frequency) => format!("sine  {frequency} Hz"),
                    Sweep::Linear([first, last]) => format!("linear chirp  {first} to {last} Hz"),
                    Sweep::Exponential([first, last]) => {
                        format!("exponential chirp  {first} to {last} Hz")
                    }
                };
                let about = mm(pre_indentation_m);
                [
                    format!("{often}, {}", mm(amplitude_m)),
                    format!("about {about}, for {duration_s} s"),
                ]
            }
        }
    }

    /// Its numbers: what each is called, its unit, how many of that unit are one of SI, and the number.
    pub(super) fn numbers(&mut self) -> Vec<(&'static str, &'static str, f64, &mut f64)> {
        match &mut self.stimulus {
            Stimulus::RampAndHold {
                depth_m,
                ramp_s,
                hold_s,
            } => vec![
                ("depth", "mm", 1e3, depth_m),
                ("ramp", "s", 1.0, ramp_s),
                ("hold", "s", 1.0, hold_s),
            ],
            Stimulus::Swing {
                amplitude_m,
                pre_indentation_m,
                sweep,
                duration_s,
            } => {
                let mut numbers = vec![
                    ("amplitude", "mm", 1e3, amplitude_m),
                    ("about", "mm", 1e3, pre_indentation_m),
                ];
                match sweep {
                    Sweep::Constant(frequency) => numbers.push(("frequency", "Hz", 1.0, frequency)),
                    Sweep::Linear([first, last]) | Sweep::Exponential([first, last]) => {
                        numbers.push(("from", "Hz", 1.0, first));
                        numbers.push(("to", "Hz", 1.0, last));
                    }
                }
                numbers.push(("duration", "s", 1.0, duration_s));
                numbers
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A stimulus longer than a breath is refused in a sentence with both times.
    #[test]
    fn a_stimulus_longer_than_a_breath_is_refused_on_its_button() {
        let stimulus = Stimulus::RampAndHold {
            depth_m: 4e-3,
            ramp_s: 0.5,
            hold_s: 40.0,
        };
        let mut prepared = Prepared::new(DepthTrajectory::of(stimulus).unwrap(), 3);
        let settings = RigSettings {
            breath: Some(25.0),
            ..RigSettings::default()
        };
        let said = prepared.trajectory(&settings).unwrap_err();
        assert!(said.contains("25.0 s"), "{said}");
        *prepared.numbers()[2].3 = 10.0;
        assert!(prepared.trajectory(&settings).is_ok());
        assert_eq!(prepared.repeated().count(), 3);
        assert_eq!(prepared.words()[0], "ramp and hold  4 mm");
    }
}
