use palpate_devices::{Kind, Places};
use palpate_files::Protocol;
use palpate_files::protocol::{Gains, Measured, RigDevice, RigLimits, Stimulus};
use palpate_files::recording::RecordingHeader;
use palpate_measure::phantom::{Imperfections, MECHANICS_STEP, Machine, TwoMass};
use palpate_measure::{
    BREATH_MOTION, DepthTrajectory, NormalFrom, Rig, RigSettings, VirtualSpecimen, stimulus_name,
};
use palpate_servo::{Clock, Device, PidGains, Vec3};

use super::sensor::RealSensor;
use super::specimen;
use crate::Error;

/// Beyond this depth [m] and this frequency [Hz] an answer gets a warning.
const TRUSTED: [f64; 2] = [0.010, 8.0];

/// How much deeper than commanded a tip can come [m]: the detected contact is not exact, and a heart moves it.
const MISSED: f64 = 0.3e-3;
const BEATING: f64 = 1e-3;

/// A checked protocol.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The rig's limits and speeds.
    pub settings: RigSettings,
    /// In the order of the protocol.
    pub specimens: Vec<Measured>,
    /// Each with how often it is repeated.
    pub stimuli: Vec<(DepthTrajectory, u64)>,
    /// The relative half interval of every parameter at which a press ends [-]; none for whole stimuli.
    pub target: Option<f64>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// The real device; none for a virtual one.
    device: Option<(Kind, Places)>,
    /// The real force sensor; none for a virtual one.
    sensor: Option<RealSensor>,
    seed: u64,
}

/// The material under the indenter.
#[derive(Debug, Clone)]
pub enum OnRig {
    /// A virtual specimen.
    Virtual(Box<VirtualSpecimen>),
    /// A real one, with its entries for the header of recordings.
    Real(Box<RecordingHeader>),
}

impl OnRig {
    /// The specimen's entries for the header of its recordings.
    pub fn header(&self) -> &RecordingHeader {
        match self {
            Self::Virtual(specimen) => &specimen.header,
            Self::Real(header) => header,
        }
    }
}

/// The name of a real device in a protocol.
fn kind(device: RigDevice) -> Option<Kind> {
    match device {
        RigDevice::Virtual => None,
        RigDevice::Haply => Some(Kind::Haply),
        RigDevice::OpenHaptics => Some(Kind::OpenHaptics),
        RigDevice::ForceDimension => Some(Kind::ForceDimension),
    }
}

impl Plan {
    /// Checks `protocol`; `seed` sets all random numbers.
    pub fn of(protocol: Protocol, seed: u64) -> Result<Self, Error> {
        let breathes = protocol.specimens.iter().any(|own| own.alive);
        let settings = RigSettings {
            breath_motion: if breathes { BREATH_MOTION } else { 0.0 },
            tip_distance: protocol
                .sensor
                .tip_distance_m
                .unwrap_or(RigSettings::default().tip_distance),
            ..settings(&protocol.rig)
        };
        let mut warnings = protocol.warnings.clone();
        let device = match protocol.rig.device.and_then(kind) {
            None => None,
            Some(kind) => Some((kind, Places::from_environment()?)),
        };
        let sensor = RealSensor::of(&protocol.sensor)?;
        if sensor.is_some() {
            warnings.push("the drivers of force sensors were not tried on hardware".to_owned());
        } else if let Some((kind, _)) = &device {
            warnings.push(format!(
                "the tissue is not there and its force is displayed by `{kind}`, without a force sensor in [sensor]; \
                 it was not tried on hardware"
            ));
        }
        let mut stimuli = Vec::new();
        for plan in &protocol.stimuli {
            let name = stimulus_name(&plan.stimulus);
            let trajectory = DepthTrajectory::of(plan.stimulus)?;
            if trajectory.deepest() > TRUSTED[0] {
                warnings.push(format!(
                    "{name}: deeper than 10 mm, where no tissue here was measured"
                ));
            }
            if let Stimulus::Swing { sweep, .. } = plan.stimulus
                && sweep.ends().iter().any(|frequency| *frequency > TRUSTED[1])
            {
                warnings.push(format!(
                    "{name}: beyond 8 Hz, where the device itself is felt"
                ));
            }
            stimuli.push((trajectory, plan.repeats));
        }
        Ok(Self {
            settings,
            specimens: protocol.specimens,
            stimuli,
            target: protocol.rig.stop_at_relative_interval,
            warnings,
            device,
            sensor,
            seed,
        })
    }

    /// Rejects, before any motion, a stimulus that exceeds a limit; a window shows this on the stimulus's button.
    pub fn check(&self) -> Result<(), Error> {
        self.open_device()?;
        for measured in &self.specimens {
            let place = &measured.place;
            let [to, normal] = [place.place_m, place.normal].map(Vec3::from);
            let from = match place.measure_normal {
                true => NormalFrom::ByTouch,
                false => NormalFrom::Stated,
            };
            self.settings.check_place(&to, &normal, from)?;
        }
        let courses = self.stimuli.iter();
        let mut checked = courses.map(|(trajectory, _)| self.settings.check(trajectory));
        Ok(checked.try_for_each(|one| one)?)
    }

    /// The specimen at `place` of the protocol, and warnings about it. A nonlinear law is solved first, which takes a
    /// minute the first time; `at_step` receives the completed fraction [-].
    pub fn specimen(
        &self,
        place: usize,
        at_step: &mut dyn FnMut(f64),
    ) -> Result<(OnRig, Vec<String>), Error> {
        let measured = &self.specimens[place];
        if self.sensor.is_some() {
            let header = specimen::real(measured);
            return Ok((OnRig::Real(Box::new(header)), Vec::new()));
        }
        let deepest = self
            .stimuli
            .iter()
            .map(|(trajectory, _)| trajectory.deepest());
        let deepest = deepest.fold(0.0, f64::max);
        let further = if measured.alive { BEATING } else { MISSED };
        let (found, warnings) = specimen::of(measured, deepest + further, at_step)?;
        let found = match measured.alive {
            true => found.alive(self.seed.wrapping_add(place as u64)),
            false => found,
        };
        Ok((OnRig::Virtual(Box::new(found)), warnings))
    }

    /// Whether a real device carries the indenter.
    pub fn has_device(&self) -> bool {
        self.device.is_some()
    }

    /// The real device, if the protocol names one.
    pub fn open_device(&self) -> Result<Option<Box<dyn Device>>, Error> {
        let device = self.device.as_ref();
        let opened = device.map(|(kind, places)| kind.open(0, places));
        Ok(opened.transpose()?)
    }

    /// The clock of a rig without a window: a real device uses the machine's.
    pub fn clock(&self) -> Clock {
        match self.device {
            Some(_) => Clock::real(),
            None => Clock::virtual_time(),
        }
    }

    /// A rig over the specimen at `place`, on `clock`, that faces it as the protocol says.
    pub fn rig(&self, specimen: OnRig, place: usize, clock: Clock) -> Result<Rig, Error> {
        let mut rig = self.made(specimen, place, clock)?;
        let normal = Vec3::from(self.specimens[place].place.normal);
        rig.face(&normal)?;
        Ok(rig)
    }

    fn made(&self, specimen: OnRig, place: usize, clock: Clock) -> Result<Rig, Error> {
        let (settings, seed) = (self.settings, self.seed.wrapping_add(place as u64));
        let rig = match (specimen, self.open_device()?, &self.sensor) {
            (OnRig::Virtual(specimen), Some(device), _) => {
                Rig::on(device, *specimen, settings, clock, seed)
            }
            (OnRig::Virtual(specimen), None, _) => {
                let machine = Machine::of_two_masses(&TwoMass::consistent(), MECHANICS_STEP);
                let imperfections = Imperfections::premium();
                Rig::over(*specimen, machine, imperfections, settings, clock, seed)
            }
            (OnRig::Real(header), Some(device), Some(sensor)) => {
                Rig::with_sensor(device, sensor.open()?, *header, settings, clock)
            }
            (OnRig::Real(_), ..) => {
                return Err(Error::input(
                    "a real specimen needs a device and a force sensor; name them in [rig] and [sensor]",
                ));
            }
        };
        Ok(rig?)
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
        contact_force: limits.contact_force_n.unwrap_or(default.contact_force),
        lateral_limit: limits.lateral_limit_m.unwrap_or(default.lateral_limit),
        indenter_axis: limits
            .indenter_axis
            .map_or(default.indenter_axis, Vec3::from),
        recovery: limits.recovery_s.unwrap_or(default.recovery),
        gains: match limits.gains {
            Some(Gains::Gentle) => PidGains::gentle(),
            Some(Gains::Tuned) | None => default.gains,
        },
        ..default
    }
}
