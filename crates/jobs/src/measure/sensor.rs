//! Opens the force sensor of a protocol.

use nalgebra::Matrix3;
use palpate_devices::force_sensor::{
    Counts, Field, Gauges, LineFormat, SensorFormat, SensorLimits, SensorPlaces, Separator,
    open_force_sensor,
};
use palpate_files::protocol::{SensorPlan, SensorSource, SerialField, SerialLine, SerialSeparator};
use palpate_measure::MountedSensor;
use palpate_servo::ForceTorque;

use crate::Error;

/// A real sensor, and its address.
#[derive(Debug, Clone)]
pub(super) struct RealSensor {
    format: SensorFormat,
    limits: SensorLimits,
    places: SensorPlaces,
    plan: SensorPlan,
}

impl RealSensor {
    /// The sensor of `plan`, located by the environment; none for a virtual one.
    pub(super) fn of(plan: &SensorPlan) -> Result<Option<Self>, Error> {
        let format = match &plan.source {
            SensorSource::Virtual => return Ok(None),
            SensorSource::NiDaq(voltages) => SensorFormat::NiDaq(Box::new(Gauges {
                channels: voltages.channels.clone(),
                rate: voltages.rate_hz,
                range: voltages.range_v,
                matrix: voltages.matrix,
            })),
            SensorSource::NetFt(counts) => SensorFormat::NetFt(Counts {
                per_newton: counts.per_newton,
                per_newton_metre: counts.per_newton_metre,
            }),
            SensorSource::Serial(line) => SensorFormat::Serial(line_format(line)),
        };
        let usual = SensorLimits::default();
        let [fx, fy, fz, tx, ty, tz] = usual.range.components();
        let [fx, fy, fz] = plan.range_n.unwrap_or([fx, fy, fz]);
        let [tx, ty, tz] = plan.range_n_m.unwrap_or([tx, ty, tz]);
        Ok(Some(Self {
            format,
            limits: SensorLimits {
                range: ForceTorque::from_components([fx, fy, fz, tx, ty, tz]),
                timeout: plan.timeout_s.unwrap_or(usual.timeout),
            },
            places: SensorPlaces::from_environment()?,
            plan: plan.clone(),
        }))
    }

    /// The sensor, opened.
    pub(super) fn open(&self) -> Result<MountedSensor, Error> {
        let sensor = open_force_sensor(&self.format, self.limits, &self.places);
        Ok(MountedSensor {
            sensor: sensor?,
            indenter_from_sensor: Matrix3::from_fn(|row, column| self.plan.axes[row][column]),
            tip_distance: self.plan.tip_distance_m,
        })
    }
}

fn line_format(line: &SerialLine) -> LineFormat {
    let field = |field: &SerialField| match field {
        SerialField::Fx => Field::Axis(0),
        SerialField::Fy => Field::Axis(1),
        SerialField::Fz => Field::Axis(2),
        SerialField::Tx => Field::Axis(3),
        SerialField::Ty => Field::Axis(4),
        SerialField::Tz => Field::Axis(5),
        SerialField::Sequence => Field::Sequence,
        SerialField::Skipped => Field::Skipped,
    };
    LineFormat {
        baud: line.baud,
        fields: line.fields.iter().map(field).collect(),
        separator: match line.separator {
            SerialSeparator::Comma => Separator::Character(','),
            SerialSeparator::Semicolon => Separator::Character(';'),
            SerialSeparator::Tab => Separator::Character('\t'),
            SerialSeparator::Space => Separator::Space,
        },
        per_newton: line.per_newton,
        per_newton_metre: line.per_newton_metre,
    }
}
