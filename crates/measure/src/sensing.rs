//! Forces on the tip from readings of a sensor: rotated into the axes of the indenter, less the zero.

use nalgebra::{Matrix3, Rotation3};
use palpate_servo::{ForceSensor, ForceTorque, SensorFault, Vec3, latest};

use crate::{RigSettings, VirtualForceSensor};

/// A real sensor between a device and its indenter.
pub struct MountedSensor {
    /// The sensor.
    pub sensor: Box<dyn ForceSensor>,
    /// The indenter's x, y and z in the sensor's axes, row by row: a rotation.
    pub indenter_from_sensor: Matrix3<f64>,
    /// From the sensor's origin to the tip [m], for recordings; none when nobody said it.
    pub tip_distance: Option<f64>,
}

pub(crate) enum Source {
    Virtual {
        sensor: VirtualForceSensor,
        /// Force on the tip in the rig's axes, and torque about the tip.
        tip_load: latest::Receiver<ForceTorque>,
        /// From the sensor's origin to the tip [m].
        tip_distance: f64,
    },
    Real(MountedSensor),
}

impl Source {
    /// A virtual sensor of `tip_load`.
    pub(crate) fn of_virtual(
        tip_load: latest::Receiver<ForceTorque>,
        seed: u64,
        settings: &RigSettings,
    ) -> Self {
        Self::Virtual {
            sensor: VirtualForceSensor::nano17(seed),
            tip_load,
            tip_distance: settings.tip_distance,
        }
    }
}

/// A sensor on its indenter.
pub(crate) struct Sensing {
    source: Source,
    rig_from_indenter: Rotation3<f64>,
    zero: Zero,
    /// The last reading that could be used, in the indenter's axes.
    pub(crate) last: ForceTorque,
    /// Why there is no newer one.
    pub(crate) fault: Option<SensorFault>,
}

/// The mean of readings without load.
#[derive(Debug, Clone, Copy, Default)]
struct Zero {
    sum: ForceTorque,
    taken: u32,
    /// Readings that it is the mean of.
    wanted: u32,
}

impl Sensing {
    /// With the indenter's axis, from its tip to the device, along `axis` in the rig's axes.
    pub(crate) fn new(source: Source, axis: &Vec3) -> Self {
        let up = Vec3::z();
        // None for an axis straight down, which settings refuse.
        let mount = Rotation3::rotation_between(&up, axis).unwrap_or_default();
        Self {
            source,
            rig_from_indenter: mount,
            zero: Zero::default(),
            last: ForceTorque::zero(),
            fault: None,
        }
    }

    /// Whether the sensor is real, so that its zero has to be taken.
    pub(crate) fn is_real(&self) -> bool {
        matches!(self.source, Source::Real(_))
    }

    /// Its name, for recordings.
    pub(crate) fn name(&self) -> String {
        match &self.source {
            Source::Virtual { .. } => "virtual ATI Nano17".to_owned(),
            Source::Real(mounted) => mounted.sensor.spec().name.clone(),
        }
    }

    /// From its origin to the tip [m].
    pub(crate) fn tip_distance(&self) -> Option<f64> {
        match &self.source {
            Source::Virtual { tip_distance, .. } => Some(*tip_distance),
            Source::Real(mounted) => mounted.tip_distance,
        }
    }

    /// The largest force along its axis [N].
    pub(crate) fn axial_range(&self) -> f64 {
        match &self.source {
            Source::Virtual { sensor, .. } => sensor.ranges[2],
            Source::Real(mounted) => {
                let range = mounted.sensor.spec().range.force;
                // An axis of the indenter is one of the sensor's.
                (mounted.indenter_from_sensor * range).z.abs()
            }
        }
    }

    pub(crate) fn has_six_axes(&self) -> bool {
        match &self.source {
            Source::Virtual { .. } => true,
            Source::Real(mounted) => mounted.sensor.spec().has_six_axes,
        }
    }

    /// Takes the mean of the next `readings` for zero, if the sensor is there; nothing may touch the tip meanwhile.
    pub(crate) fn begin_zero(&mut self, readings: usize) {
        if self.is_real() {
            self.zero = Zero {
                wanted: u32::try_from(readings).unwrap_or(u32::MAX),
                ..Zero::default()
            };
        }
    }

    /// Takes a reading; a failed one leaves the last reading and sets a fault.
    pub(crate) fn read(&mut self) {
        match self.reading() {
            Ok(reading) => {
                self.last = self.zero.less(reading);
                self.fault = None;
            }
            Err(fault) => self.fault = Some(fault),
        }
    }

    fn reading(&mut self) -> Result<ForceTorque, SensorFault> {
        match &mut self.source {
            Source::Virtual {
                sensor,
                tip_load,
                tip_distance,
            } => {
                let mount = self.rig_from_indenter;
                let on_tip = tip_load.latest().map(|vector| mount.inverse() * vector);
                let tip = Vec3::z() * -*tip_distance;
                sensor.read(&ForceTorque {
                    torque: on_tip.torque + tip.cross(&on_tip.force),
                    ..on_tip
                })
            }
            Source::Real(mounted) => {
                let reading = mounted.sensor.read()?;
                let reading = mounted.sensor.spec().check(reading)?;
                Ok(reading.map(|vector| mounted.indenter_from_sensor * vector))
            }
        }
    }

    /// The last force in the rig's axes [N].
    pub(crate) fn force_in_rig(&self) -> Vec3 {
        self.rig_from_indenter * self.last.force
    }
}

impl Zero {
    fn less(&mut self, reading: ForceTorque) -> ForceTorque {
        if self.taken < self.wanted {
            self.sum = self.sum + reading;
            self.taken += 1;
        }
        match self.taken {
            0 => reading,
            taken => {
                let mean = self.sum.map(|vector| vector / f64::from(taken));
                reading - mean
            }
        }
    }
}
