use std::path::Path;

use palpate_measure::{
    Course, Ended, Recorded, Recorder, Rig, RigSample, VirtualSpecimen, recording_name,
    stimulus_name,
};
use palpate_servo::lock_memory;

use super::Files;
use super::live::LiveMeasuring;
use super::plan::Plan;
use crate::{Error, Watch};

/// A protocol that is carried out without a window.
pub struct Measuring {
    plan: Plan,
    specimens: Vec<VirtualSpecimen>,
    /// Each with what it is called and which repetition it is.
    stimuli: Vec<(String, u64, Course)>,
    /// What deserves doubt.
    pub doubts: Vec<String>,
}

impl Measuring {
    /// Refuses, before anything moves, what goes beyond a limit.
    pub fn of(plan: Plan, watch: &dyn Watch) -> Result<Self, Error> {
        plan.check()?;
        let mut doubts = plan.doubts.clone();
        if plan.has_device() {
            doubts.extend(lock_memory().warning());
        }
        let mut specimens = Vec::new();
        for place in 0..plan.specimens.len() {
            let (found, said) = plan.specimen(place, &mut |part| {
                watch.say(&format!("solving the specimen, {:.0} %", 100.0 * part));
            })?;
            doubts.extend(said);
            specimens.push(found);
        }
        let repeated = plan.stimuli.iter().flat_map(|(course, repeats)| {
            let name = stimulus_name(&course.stimulus());
            (1..=*repeats).map(move |repeat| (name.clone(), repeat, *course))
        });
        Ok(Self {
            stimuli: repeated.collect(),
            plan,
            specimens,
            doubts,
        })
    }

    /// What the recordings are called, in their order; each once.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for (place, specimen) in (1..).zip(&self.specimens) {
            for (stimulus, repeat, _) in &self.stimuli {
                let name = recording_name(&specimen.header, place, (stimulus, *repeat));
                names.push(unique(name, &names));
            }
        }
        names
    }

    /// Carries the protocol out, into the `files` of its recordings, until it is done or somebody presses Ctrl-C.
    /// Each recording comes with what its stimulus is called.
    pub fn run(&self, files: &Files, watch: &dyn Watch) -> Result<Vec<(String, Recorded)>, Error> {
        let mut recorded = Vec::new();
        let count = files.paths.len();
        let mut files = files.paths.iter();
        for (place, specimen) in self.specimens.iter().enumerate() {
            let clock = self.plan.clock();
            let mut rig = Measured::by(self.plan.rig((specimen.clone(), place), clock)?)?;
            for ((name, repeat, course), file) in self.stimuli.iter().zip(files.by_ref()) {
                watch.say(&file.display().to_string());
                if watch.is_asked_to_stop() {
                    return Ok(recorded);
                }
                let done = match &mut rig {
                    Measured::Virtual(rig) => record(rig, (course, *repeat), file, watch),
                    Measured::Live(live) => {
                        let settings = &self.plan.settings;
                        let header = settings.describe(&specimen.header, (course, *repeat));
                        live.record((course, header), file, watch)
                    }
                };
                let done = done.map_err(|failure| failure.about(file))?;
                watch.at((recorded.len() + 1) as f64 / count as f64);
                let Some(done) = done else {
                    return Ok(recorded);
                };
                recorded.push((name.clone(), done));
            }
        }
        Ok(recorded)
    }
}

/// A rig that measures: in the calling thread as fast as the machine can, or on a device that is there.
enum Measured {
    Virtual(Box<Rig>),
    Live(Box<LiveMeasuring>),
}

impl Measured {
    fn by(rig: Rig) -> Result<Self, Error> {
        match rig.is_real() {
            false => Ok(Self::Virtual(Box::new(rig))),
            true => Ok(Self::Live(Box::new(LiveMeasuring::start(rig)?))),
        }
    }
}

/// `name`, or with a number behind it when it is among `taken`.
fn unique(name: String, taken: &[String]) -> String {
    let numbered = (2..).map(|number| format!("{name}-{number}"));
    let mut all = std::iter::once(name.clone()).chain(numbered);
    all.find(|own| !taken.contains(own))
        .expect("numbers do not end")
}

/// One stimulus; none when Ctrl-C came before it.
fn record(
    rig: &mut Rig,
    (course, repeat): (&Course, u64),
    file: &Path,
    watch: &dyn Watch,
) -> Result<Option<Recorded>, Error> {
    let go_on = &mut |_: &RigSample| !watch.is_asked_to_stop();
    // The tissue rests from what was done to it, then from being looked for.
    for rests in [true, false] {
        let rested = rig.recover(go_on).map_err(Error::failed)?;
        if rested == Ended::Stopped
            || rests && rig.approach(go_on).map_err(Error::failed)? == Ended::Stopped
        {
            return Ok(None);
        }
    }
    let mut recorder = Recorder::begin(file, &rig.describe(course, repeat))?;
    let mut unwritten = None;
    let ended = rig.press(course, &mut |sample| {
        unwritten = recorder.take(sample).err();
        unwritten.is_none() && !watch.is_asked_to_stop()
    });
    if let Some(error) = unwritten {
        return Err(error.into());
    }
    // What was recorded is kept, however it ended.
    let recorded = recorder.finish(&ended)?;
    ended.map_err(Error::failed)?;
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
        let names = Measuring::of(plan, &crate::Nobody).unwrap().names();
        assert_eq!(names[0], "liver-1-sine-2hz-1");
        let mut once = names.clone();
        once.sort();
        once.dedup();
        assert_eq!(once.len(), 8, "{names:?}");
    }
}
