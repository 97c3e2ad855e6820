use std::path::{Path, PathBuf};

use palpate_files::Protocol;
use palpate_files::protocol::{Gains, RigLimits, Stimulus, Sweep};
use palpate_files::recording::RecordingWriter;
use palpate_measure::{Course, Ended, Rig, RigSample, RigSettings, VirtualSpecimen};
use palpate_servo::dynamics::{Imperfections, Machine, TwoMass};
use palpate_servo::{Clock, MECHANICS_STEP, PidGains};

use super::specimen;
use crate::failure::Failure;
use crate::interrupt;
use crate::progress::Progress;

/// Beyond this depth [m] and this frequency [Hz] an answer deserves doubt.
const TRUSTED: [f64; 2] = [0.010, 8.0];

/// How much deeper than asked for a tip can come [m]: the contact is not met exactly, and a heart moves it.
const MISSED: f64 = 0.3e-3;
const BEATING: f64 = 1e-3;

/// A protocol that can be carried out.
pub(super) struct Measuring {
    settings: RigSettings,
    specimens: Vec<VirtualSpecimen>,
    /// Each with what it is called and which repetition it is.
    stimuli: Vec<(String, u64, Course)>,
    seed: u64,
    pub(super) doubts: Vec<String>,
}

/// A recording that was made.
pub(super) struct Recorded {
    pub(super) file: PathBuf,
    pub(super) stimulus: String,
    pub(super) samples: usize,
    /// The largest force [N].
    pub(super) peak: f64,
    /// Whether it was stopped before its end.
    pub(super) stopped: bool,
}

impl Measuring {
    /// Refuses, before anything moves, what goes beyond a limit.
    pub(super) fn of(protocol: &Protocol, seed: u64, progress: &Progress) -> Result<Self, Failure> {
        let settings = settings(&protocol.rig);
        let mut doubts = Vec::new();
        let mut stimuli = Vec::new();
        for plan in &protocol.stimuli {
            let name = name(&plan.stimulus);
            let course = Course::of(plan.stimulus).map_err(Failure::input)?;
            settings.check(&course).map_err(Failure::input)?;
            if course.deepest() > TRUSTED[0] {
                doubts.push(format!(
                    "{name}: deeper than 10 mm, where no tissue here was measured"
                ));
            }
            if let Stimulus::Swing { sweep, .. } = plan.stimulus
                && sweep.ends().iter().any(|frequency| *frequency > TRUSTED[1])
            {
                doubts.push(format!(
                    "{name}: beyond 8 Hz, where the device itself is felt"
                ));
            }
            stimuli.extend((1..=plan.repeats).map(|repeat| (name.clone(), repeat, course)));
        }
        let deepest = stimuli
            .iter()
            .map(|(_, _, own): &(_, _, Course)| own.deepest());
        let deepest = deepest.fold(0.0, f64::max);
        let mut specimens = Vec::new();
        for (measured, place) in protocol.specimens.iter().zip(0..) {
            let further = if measured.alive { BEATING } else { MISSED };
            let (found, said) = specimen::of(measured, deepest + further, &mut |part| {
                progress.say(format!("solving the specimen, {:.0} %", 100.0 * part));
            })?;
            doubts.extend(said);
            specimens.push(match measured.alive {
                true => found.alive(seed.wrapping_add(place)),
                false => found,
            });
        }
        Ok(Self {
            settings,
            specimens,
            stimuli,
            seed,
            doubts,
        })
    }

    /// What the recordings are called, in their order; each once.
    pub(super) fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for (place, specimen) in (1..).zip(&self.specimens) {
            let header = &specimen.header;
            let organ = header.organ.as_deref().unwrap_or("specimen");
            let subject = header.subject.clone().unwrap_or_else(|| format!("{place}"));
            for (stimulus, repeat, _) in &self.stimuli {
                let name = plain(&format!("{organ}-{subject}-{stimulus}-{repeat}"));
                let taken = names.contains(&name);
                names.push(if taken {
                    format!("{name}-specimen-{place}")
                } else {
                    name
                });
            }
        }
        names
    }

    /// Carries the protocol out, into `files`, until it is done or somebody presses Ctrl-C.
    pub(super) fn run(
        &self,
        files: &[PathBuf],
        progress: &Progress,
    ) -> Result<Vec<Recorded>, Failure> {
        let mut recorded = Vec::new();
        let mut files = files.iter();
        for (place, specimen) in (0..).zip(&self.specimens) {
            let mut rig = self.rig(specimen, place)?;
            for ((name, repeat, course), file) in self.stimuli.iter().zip(files.by_ref()) {
                progress.say(format!("{}", file.display()));
                if interrupt::is_asked() {
                    return Ok(recorded);
                }
                let done = record(&mut rig, (course, *repeat), file);
                let done = done.map_err(|failure| failure.about(file))?;
                progress.step();
                let Some(mut done) = done else {
                    return Ok(recorded);
                };
                done.stimulus.clone_from(name);
                recorded.push(done);
            }
        }
        Ok(recorded)
    }

    fn rig(&self, specimen: &VirtualSpecimen, place: u64) -> Result<Rig, Failure> {
        let machine = Machine::of_two_masses(&TwoMass::consistent(), MECHANICS_STEP);
        let device = (machine, Imperfections::premium());
        let clock = (Clock::virtual_time(), self.seed.wrapping_add(place));
        Rig::over(specimen.clone(), device, self.settings, clock).map_err(Failure::failed)
    }
}

/// One stimulus; none when Ctrl-C came before it.
fn record(
    rig: &mut Rig,
    (course, repeat): (&Course, u64),
    file: &Path,
) -> Result<Option<Recorded>, Failure> {
    let go_on = &mut |_: &RigSample| !interrupt::is_asked();
    // The tissue rests from what was done to it, then from being looked for.
    for rests in [true, false] {
        let rested = rig.recover(go_on).map_err(Failure::failed)?;
        if rested == Ended::Stopped
            || rests && rig.approach(go_on).map_err(Failure::failed)? == Ended::Stopped
        {
            return Ok(None);
        }
    }
    let mut writer = RecordingWriter::create(file, &rig.describe(course, repeat))?;
    let (mut samples, mut peak, mut first) = (0, 0.0_f64, None);
    let mut unwritten = None;
    let ended = rig.press(course, &mut |sample| {
        let begun = *first.get_or_insert(sample.time);
        // To the microsecond, which is what a clock can say.
        let time = (1e6 * (sample.time - begun)).round() / 1e6;
        let row = [time, sample.depth.unwrap_or_default(), sample.force];
        samples += 1;
        peak = peak.max(sample.force);
        unwritten = writer.write(row).err();
        unwritten.is_none() && !interrupt::is_asked()
    });
    if let Some(error) = unwritten {
        return Err(error.into());
    }
    // What was recorded is kept, however it ended.
    writer.finish()?;
    let ended = ended.map_err(Failure::failed)?;
    Ok(Some(Recorded {
        file: file.to_owned(),
        stimulus: String::new(),
        samples,
        peak,
        stopped: ended == Ended::Stopped,
    }))
}

fn settings(limits: &RigLimits) -> RigSettings {
    let default = RigSettings::default();
    RigSettings {
        approach_speed: limits
            .approach_speed_m_per_s
            .unwrap_or(default.approach_speed),
        force_limit: limits.force_limit_n.unwrap_or(default.force_limit),
        depth_limit: limits.depth_limit_m.unwrap_or(default.depth_limit),
        speed_limit: limits.speed_limit_m_per_s.unwrap_or(default.speed_limit),
        breath: limits.breath_s,
        recovery: limits.recovery_s.unwrap_or(default.recovery),
        gains: match limits.gains {
            Some(Gains::Gentle) => PidGains::gentle(),
            Some(Gains::Tuned) | None => default.gains,
        },
        ..default
    }
}

/// What a stimulus is called: `ramp-and-hold-4mm`, `sine-2hz`.
fn name(stimulus: &Stimulus) -> String {
    let kind = stimulus.kind();
    match *stimulus {
        Stimulus::RampAndHold { depth_m, .. } => format!("{kind}-{}mm", 1e3 * depth_m),
        Stimulus::Swing { sweep, .. } => match sweep {
            Sweep::Constant(frequency) => format!("{kind}-{frequency}hz"),
            Sweep::Linear([first, last]) | Sweep::Exponential([first, last]) => {
                format!("{kind}-{first}-{last}hz")
            }
        },
    }
}

/// As the name of a file.
fn plain(name: &str) -> String {
    let letter = |c: char| {
        if c.is_alphanumeric() || c == '.' {
            c
        } else {
            '-'
        }
    };
    name.chars().map(letter).collect()
}
