use std::path::Path;

use palpate_characterize::online::OnlineEstimate;
use palpate_files::recording::RecordingHeader;
use palpate_measure::live::RigCommand;
use palpate_measure::{
    Axes, DepthTrajectory, Ended, Recorded, Recorder, Rig, RigSample, recording_name, stimulus_name,
};
use palpate_servo::{Vec3, lock_memory};

use super::Files;
use super::estimating::Estimating;
use super::live::LiveMeasuring;
use super::plan::{OnRig, Plan};
use crate::{Error, ProgressCallback};

/// A recording, and the online estimate of the tissue.
#[derive(Debug)]
pub struct Measured {
    /// The name of the stimulus.
    pub stimulus: String,
    /// The recording.
    pub recorded: Recorded,
    /// The last estimate; none of a stimulus without a hold, or of a specimen whose force over depth is not
    /// tabulated.
    pub estimate: Option<OnlineEstimate>,
    /// Whether the press ended early because the estimate met its target.
    pub is_enough: bool,
}

/// A running protocol without a window.
pub struct Measuring {
    plan: Plan,
    specimens: Vec<OnRig>,
    /// The stimuli, each with its name and repetition.
    stimuli: Vec<(String, u64, DepthTrajectory)>,
    /// Warnings.
    pub warnings: Vec<String>,
}

impl Measuring {
    /// Rejects, before any motion, a protocol that exceeds a limit.
    pub fn of(plan: Plan, watch: &dyn ProgressCallback) -> Result<Self, Error> {
        plan.check()?;
        let mut warnings = plan.warnings.clone();
        if plan.has_device() {
            warnings.extend(lock_memory().warning());
        }
        let mut specimens = Vec::new();
        for place in 0..plan.specimens.len() {
            let (found, specimen_warnings) = plan.specimen(place, &mut |part| {
                watch.report_step(&format!("solving the specimen, {:.0} %", 100.0 * part));
            })?;
            warnings.extend(specimen_warnings);
            specimens.push(found);
        }
        let repeated = plan.stimuli.iter().flat_map(|(trajectory, repeats)| {
            let name = stimulus_name(&trajectory.stimulus());
            (1..=*repeats).map(move |repeat| (name.clone(), repeat, *trajectory))
        });
        Ok(Self {
            stimuli: repeated.collect(),
            plan,
            specimens,
            warnings,
        })
    }

    /// The unique names of the recordings, in their order.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for (place, specimen) in (1..).zip(&self.specimens) {
            for (stimulus, repeat, _) in &self.stimuli {
                let name = recording_name(specimen.header(), place, stimulus, *repeat);
                names.push(unique(name, &names));
            }
        }
        names
    }

    /// Runs the protocol and writes the `files` of its recordings, until it ends or the user presses Ctrl-C.
    pub fn run(&self, files: &Files, watch: &dyn ProgressCallback) -> Result<Vec<Measured>, Error> {
        let mut recorded = Vec::new();
        let count = files.paths.len();
        let mut files = files.paths.iter();
        for (place, specimen) in self.specimens.iter().enumerate() {
            let clock = self.plan.clock();
            let mut rig = AnyRig::by(self.plan.rig(specimen.clone(), place, clock)?)?;
            if self.go_to_place(&mut rig, place, watch)? == Ended::Stopped {
                return Ok(recorded);
            }
            for ((name, repeat, trajectory), file) in self.stimuli.iter().zip(files.by_ref()) {
                watch.report_step(&file.display().to_string());
                if watch.should_stop() {
                    return Ok(recorded);
                }
                let target = self.plan.target;
                let (done, estimating) = match &mut rig {
                    AnyRig::Virtual(rig) => {
                        let header = rig.describe(trajectory, *repeat);
                        let mut online = Estimating::of(&header, trajectory, target);
                        let done = record(rig, trajectory, header, file, &mut online, watch);
                        (done, online)
                    }
                    AnyRig::Live(live) => {
                        let settings = &self.plan.settings;
                        let header = settings.describe(live.header(), trajectory, *repeat);
                        let mut online = Estimating::of(&header, trajectory, target);
                        let done = live.record(trajectory, header, file, &mut online, watch);
                        (done, online)
                    }
                };
                let done = done.map_err(|failure| failure.about(file))?;
                watch.report_fraction((recorded.len() + 1) as f64 / count as f64);
                let Some(done) = done else {
                    return Ok(recorded);
                };
                let is_enough = estimating.as_ref().is_some_and(Estimating::is_enough);
                recorded.push(Measured {
                    stimulus: name.clone(),
                    is_enough: is_enough && done.cut_short.is_some(),
                    recorded: done,
                    estimate: estimating.and_then(Estimating::last),
                });
            }
        }
        Ok(recorded)
    }
}

impl Measuring {
    /// Moves to the place of a specimen, and measures the normal there if the protocol asks for it.
    fn go_to_place(
        &self,
        rig: &mut AnyRig,
        place: usize,
        watch: &dyn ProgressCallback,
    ) -> Result<Ended, Error> {
        let place = &self.plan.specimens[place].place;
        let there = rig.go_to(&Vec3::from(place.place_m), watch)?;
        if there == Ended::Stopped || !place.measure_normal {
            return Ok(there);
        }
        watch.report_step("measuring the normal of the surface");
        rig.measure_normal(watch)
    }
}

/// A rig: simulated in the calling thread as fast as the machine can, or on a real device.
enum AnyRig {
    Virtual(Box<Rig>),
    Live(Box<LiveMeasuring>),
}

impl AnyRig {
    fn by(rig: Rig) -> Result<Self, Error> {
        match rig.is_real() {
            false => Ok(Self::Virtual(Box::new(rig))),
            true => Ok(Self::Live(Box::new(LiveMeasuring::start(rig)?))),
        }
    }

    fn go_to(&mut self, place: &Vec3, watch: &dyn ProgressCallback) -> Result<Ended, Error> {
        let go_on = &mut |_: &RigSample| !watch.should_stop();
        match self {
            Self::Virtual(rig) => Ok(rig.go_to(place, go_on)?),
            Self::Live(live) => live.carry_out(RigCommand::GoTo(*place), watch),
        }
    }

    fn measure_normal(&mut self, watch: &dyn ProgressCallback) -> Result<Ended, Error> {
        let go_on = &mut |_: &RigSample| !watch.should_stop();
        match self {
            Self::Virtual(rig) => Ok(rig.measure_normal(go_on)?),
            Self::Live(live) => live.carry_out(RigCommand::MeasureNormal, watch),
        }
    }
}

/// `name`, with a number appended if it is among `taken`.
fn unique(name: String, taken: &[String]) -> String {
    let numbered = (2..).map(|number| format!("{name}-{number}"));
    let mut all = std::iter::once(name.clone()).chain(numbered);
    all.find(|own| !taken.contains(own))
        .expect("numbers do not end")
}

/// Runs one stimulus; none when Ctrl-C came before it.
fn record(
    rig: &mut Rig,
    trajectory: &DepthTrajectory,
    header: RecordingHeader,
    file: &Path,
    online: &mut Option<Estimating>,
    watch: &dyn ProgressCallback,
) -> Result<Option<Recorded>, Error> {
    let go_on = &mut |_: &RigSample| !watch.should_stop();
    // The tissue recovers from the previous stimulus, then from the search for contact.
    for rests in [true, false] {
        let rested = rig.recover(go_on)?;
        if rested == Ended::Stopped || rests && rig.approach(go_on)? == Ended::Stopped {
            return Ok(None);
        }
    }
    let axes = match rig.has_six_axes() {
        true => Axes::Six,
        false => Axes::One,
    };
    let mut recorder = Recorder::begin(file, &header, axes)?;
    let mut unwritten = None;
    let ended = rig.press(trajectory, &mut |sample| {
        unwritten = recorder.take(sample).err();
        let online = online.as_mut();
        let is_enough = online.is_some_and(|online| online.take(sample, watch));
        unwritten.is_none() && !is_enough && !watch.should_stop()
    });
    let is_enough = online.as_ref().is_some_and(Estimating::is_enough);
    let ended = ended.map(|ended| match ended {
        Ended::Stopped if is_enough => Ended::Enough,
        ended => ended,
    });
    if let Some(error) = unwritten {
        return Err(error.into());
    }
    // Save the samples, however the stimulus ended.
    let recorded = recorder.finish(&ended)?;
    ended?;
    Ok(Some(recorded))
}

#[cfg(test)]
mod tests {
    use super::*;
    use palpate_files::Protocol;

    /// Two sines of one frequency, and two specimens of one subject.
    #[test]
    fn no_two_recordings_have_one_name() {
        let sine = |amplitude: &str| {
            format!(
                "[[stimulus]]\nkind = \"sine\"\namplitude_m = {amplitude}\npre_indentation_m = 0.002\n\
                 frequency_hz = 2\nrepeats = 2\n"
            )
        };
        let specimen = "[[specimen]]\npublished = \"liver\"\nsubject = \"1\"\n";
        let text = [
            "format = 1\n",
            specimen,
            specimen,
            &sine("0.0005"),
            &sine("0.001"),
        ]
        .concat();
        let plan = Plan::of(Protocol::parse(&text, "test").unwrap(), 1).unwrap();
        let names = Measuring::of(plan, &crate::NoProgress).unwrap().names();
        assert_eq!(names[0], "liver-1-sine-2hz-1");
        let mut once = names.clone();
        once.sort();
        once.dedup();
        assert_eq!(once.len(), 8, "{names:?}");
    }

    /// The command's path from a document to a file: the rig goes to a point off the top of a ball, measures the
    /// normal there and presses along it. Judge: the ball's own normal at that point, asin(8/50); without the normal,
    /// the lateral force is above a twentieth of the force.
    #[test]
    fn a_curved_specimen_is_measured_along_its_normal_on_six_axes() {
        let text = |more: &str| {
            format!(
                "format = 1\n[rig]\nrecovery_s = 1\n[[specimen]]\npublished = \"liver\"\nsurface_radius_m = 0.05\n\
                 place_m = [0.008, 0.0, 0.0]\n{more}\n[[stimulus]]\nkind = \"ramp_and_hold\"\ndepth_m = 0.004\nhold_s = 1\n"
            )
        };
        let measured = |more: &str| {
            let folder = tempfile::tempdir().unwrap();
            let plan = Plan::of(Protocol::parse(&text(more), "test").unwrap(), 1).unwrap();
            let measuring = Measuring::of(plan, &crate::NoProgress).unwrap();
            let out = crate::measure::Out {
                path: folder.path(),
                overwrite: palpate_files::Overwrite::Refused,
            };
            let files = crate::measure::files(&measuring, out).unwrap();
            measuring.run(&files, &crate::NoProgress).unwrap();
            palpate_files::Recording::read(&files.paths[0]).unwrap()
        };
        let sideways = |recording: &palpate_files::Recording| {
            let axes = recording.axes().unwrap();
            let most = recording.force_n().iter().copied().fold(0.0, f64::max);
            axes.largest_lateral_n() / most
        };
        let straight = measured("");
        assert_eq!(straight.header.approach_normal, Some([0.0, 0.0, 1.0]));
        let along = measured("measure_normal = true\nnormal = [0.0, 0.0, 1.0]");
        let normal = Vec3::from(along.header.approach_normal.unwrap());
        let (sine, cosine) = (
            (0.008_f64 / 0.05),
            (1.0 - (0.008_f64 / 0.05).powi(2)).sqrt(),
        );
        let off = normal
            .dot(&Vec3::new(sine, 0.0, cosine))
            .min(1.0)
            .acos()
            .to_degrees();
        println!(
            "{off} degrees off; {} and {} sideways",
            sideways(&straight),
            sideways(&along)
        );
        // Contacts are found to 0.05 mm over 10 mm, and later on softer tissue than the tests of the rig have.
        assert!(off < 2.0, "{off}");
        assert_eq!(
            along.header.force_sensor.as_deref(),
            Some("virtual ATI Nano17")
        );
        assert_eq!(along.incomplete(), None);
    }

    #[test]
    fn the_printed_protocol_explains_every_key_of_the_rig() {
        for key in [
            "contact_force_n",
            "lateral_limit_m",
            "indenter_axis",
            "[sensor]",
            "kind",
            "tip_distance_m",
            "axes",
            "range_n",
            "range_n_m",
            "timeout_s",
            "counts_per_newton",
            "counts_per_newton_metre",
            "channels",
            "rate_hz",
            "range_v",
            "matrix",
            "baud",
            "columns",
            "separator",
            "place_m",
            "normal",
            "measure_normal",
            "surface_normal",
            "surface_radius_m",
        ] {
            assert!(crate::measure::DEFAULT.contains(key), "{key}");
        }
    }
}
