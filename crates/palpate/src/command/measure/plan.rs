use palpate_files::Protocol;
use palpate_files::protocol::{Gains, Measured, RigLimits, Stimulus};
use palpate_measure::{
    BREATH_MOTION, Course, Error, Rig, RigSettings, VirtualSpecimen, stimulus_name,
};
use palpate_servo::dynamics::{Imperfections, Machine, TwoMass};
use palpate_servo::{Clock, MECHANICS_STEP, PidGains};

use super::specimen;
use crate::failure::Failure;

/// Beyond this depth [m] and this frequency [Hz] an answer deserves doubt.
const TRUSTED: [f64; 2] = [0.010, 8.0];

/// How much deeper than asked for a tip can come [m]: the contact is not met exactly, and a heart moves it.
const MISSED: f64 = 0.3e-3;
const BEATING: f64 = 1e-3;

/// What a protocol asks for.
#[derive(Debug, Clone)]
pub(super) struct Plan {
    pub(super) settings: RigSettings,
    pub(super) specimens: Vec<Measured>,
    /// Each with how often it is repeated.
    pub(super) stimuli: Vec<(Course, u64)>,
    pub(super) doubts: Vec<String>,
    seed: u64,
}

impl Plan {
    /// What `protocol` asks for, with the seed of all chance.
    pub(super) fn of(protocol: Protocol, seed: u64) -> Result<Self, Failure> {
        let breathes = protocol.specimens.iter().any(|own| own.alive);
        let settings = RigSettings {
            breath_motion: if breathes { BREATH_MOTION } else { 0.0 },
            ..settings(&protocol.rig)
        };
        let mut doubts = Vec::new();
        let mut stimuli = Vec::new();
        for plan in &protocol.stimuli {
            let name = stimulus_name(&plan.stimulus);
            let course = Course::of(plan.stimulus).map_err(Failure::input)?;
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
            stimuli.push((course, plan.repeats));
        }
        Ok(Self {
            settings,
            specimens: protocol.specimens,
            stimuli,
            doubts,
            seed,
        })
    }

    /// Refuses, before anything moves, what goes beyond a limit; a window says it on the stimulus's button.
    pub(super) fn check(&self) -> Result<(), Failure> {
        let courses = self.stimuli.iter();
        let mut checked = courses.map(|(course, _)| self.settings.check(course));
        checked.try_for_each(|one| one.map_err(Failure::input))
    }

    /// The specimen at `place` of the protocol, and what deserves doubt about it. A nonlinear law is solved
    /// before, which takes a minute the first time; `at_step` hears the part that is done [-].
    pub(super) fn specimen(
        &self,
        place: usize,
        at_step: &mut dyn FnMut(f64),
    ) -> Result<(VirtualSpecimen, Vec<String>), Failure> {
        let measured = &self.specimens[place];
        let deepest = self.stimuli.iter().map(|(course, _)| course.deepest());
        let deepest = deepest.fold(0.0, f64::max);
        let further = if measured.alive { BEATING } else { MISSED };
        let (found, doubts) = specimen::of(measured, deepest + further, at_step)?;
        let found = match measured.alive {
            true => found.alive(self.seed.wrapping_add(place as u64)),
            false => found,
        };
        Ok((found, doubts))
    }

    /// A rig over the specimen at `place`, on `clock`.
    pub(super) fn rig(
        &self,
        (specimen, place): (VirtualSpecimen, usize),
        clock: Clock,
    ) -> Result<Rig, Error> {
        let machine = Machine::of_two_masses(&TwoMass::consistent(), MECHANICS_STEP);
        let device = (machine, Imperfections::premium());
        let seed = self.seed.wrapping_add(place as u64);
        Rig::over(specimen, device, self.settings, (clock, seed))
    }
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
