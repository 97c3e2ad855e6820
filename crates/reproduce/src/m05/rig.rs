//! The rig over a virtual organ: a device of two masses with friction and encoders under its PID, a force
//! sensor with its steps, approach until first contact.

use palpate_files::Recording;
use palpate_files::protocol::Stimulus;
use palpate_files::recording::Samples;
use palpate_measure::phantom::{Imperfections, MECHANICS_STEP, Machine, TwoMass};
use palpate_measure::{DepthTrajectory, Rig, RigSample, RigSettings, VirtualSpecimen};
use palpate_servo::Clock;

use crate::Error;

/// How long the tissue rests from being looked for [s].
const REST: f64 = 10.0;

/// A recording, and how it came about.
pub(super) struct Measured {
    pub(super) recording: Recording,
    /// What was pressed.
    pub(super) trajectory: DepthTrajectory,
    /// Height at which the rig says that tissue begins [m].
    pub(super) contact: f64,
}

/// Presses `stimulus` into a fresh copy of `specimen`; noise is that of `seed`.
pub(super) fn measured(
    specimen: &VirtualSpecimen,
    stimulus: Stimulus,
    repeat: u64,
    seed: u64,
) -> Result<Measured, Error> {
    let machine = Machine::of_two_masses(&TwoMass::consistent(), MECHANICS_STEP);
    let mut rig = Rig::over(
        specimen.clone(),
        machine,
        Imperfections::premium(),
        RigSettings::default(),
        Clock::virtual_time(),
        seed,
    )?;
    let trajectory = DepthTrajectory::of(stimulus)?;
    rig.approach(&mut |_| true)?;
    rig.wait(REST, &mut |_| true)?;
    let mut rig_samples: Vec<RigSample> = Vec::new();
    let listener = &mut |sample: &RigSample| {
        rig_samples.push(*sample);
        true
    };
    rig.press(&trajectory, listener)?;
    let begun = rig_samples.first().map_or(0.0, |first| first.time);
    let samples = Samples {
        time_s: rig_samples
            .iter()
            .map(|sample| sample.time - begun)
            .collect(),
        depth_m: rig_samples
            .iter()
            .map(|sample| sample.depth.unwrap_or_default())
            .collect(),
        force_n: rig_samples.iter().map(|sample| sample.force).collect(),
    };
    let contact = rig_samples
        .last()
        .map_or(0.0, |last| last.height + last.depth.unwrap_or_default());
    Ok(Measured {
        recording: Recording::new(rig.describe(&trajectory, repeat), samples)?,
        trajectory,
        contact,
    })
}

impl Measured {
    /// Time from first contact [s], depth [m] and commanded depth [m], from first contact on.
    pub(super) fn tracked(&self) -> impl Iterator<Item = [f64; 3]> + '_ {
        let depths = self.recording.depth_m().iter();
        let touching = self.times().zip(depths).filter(|(time, _)| *time >= 0.0);
        touching.map(|(time, depth)| [time, *depth, self.trajectory.at(time)[0]])
    }

    /// Times from first contact [s].
    pub(super) fn times(&self) -> impl Iterator<Item = f64> + '_ {
        let times = self.recording.time_s();
        // A recording ends with its stimulus.
        let last = times.last().copied().unwrap_or_default();
        let contact = last - self.trajectory.duration();
        times.iter().map(move |time| time - contact)
    }
}
