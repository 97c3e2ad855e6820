use super::samples::Repeated;
use crate::table::{Column, Row, TableText};
use crate::{Domain, Error};

/// The six axes of a force and torque sensor, column by column, in the axes of the indenter: z points from the tip to
/// the device, so that tissue which is pressed gives a positive fz. Torques are about the sensor's origin.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SensorAxes {
    /// fx, fy, fz [N], tx, ty, tz [N m]; each with one number for each sample.
    pub columns: [Vec<f64>; 6],
}

/// One row of a recording.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RecordingRow {
    /// [s]
    pub time_s: f64,
    /// [m]
    pub depth_m: f64,
    /// Along the approach [N].
    pub force_n: f64,
    /// fx, fy, fz [N], tx, ty, tz [N m]; none for a sensor of one axis.
    pub axes: Option<[f64; 6]>,
}

impl From<[f64; 3]> for RecordingRow {
    /// Time [s], depth [m] and force [N] of a sensor of one axis.
    fn from([time_s, depth_m, force_n]: [f64; 3]) -> Self {
        Self {
            time_s,
            depth_m,
            force_n,
            axes: None,
        }
    }
}

impl SensorAxes {
    /// The names of the columns, with their units.
    pub const COLUMNS: [&'static str; 6] = ["fx_n", "fy_n", "fz_n", "tx_n_m", "ty_n_m", "tz_n_m"];

    const DOMAINS: [Domain; 6] = [
        Domain::ANY_FORCE,
        Domain::ANY_FORCE,
        Domain::ANY_FORCE,
        Domain::ANY_TORQUE,
        Domain::ANY_TORQUE,
        Domain::ANY_TORQUE,
    ];

    /// The largest force perpendicular to the indenter's axis [N].
    pub fn largest_lateral_n(&self) -> f64 {
        let [fx, fy, ..] = &self.columns;
        let both = fx.iter().zip(fy);
        both.fold(0.0, |most, (x, y)| most.max(x.hypot(*y)))
    }

    /// The six columns of a table; none unless all are there, because a single one may have another meaning.
    pub(super) fn columns_of(table: &TableText<'_>) -> Result<Option<[Column; 6]>, Error> {
        let mut found = Vec::with_capacity(6);
        for name in Self::COLUMNS {
            match table.optional_column(name)? {
                Some(column) => found.push(column),
                None => return Ok(None),
            }
        }
        Ok(found.try_into().ok())
    }

    /// Takes the fields of a row.
    pub(super) fn take(&mut self, row: &Row<'_>, columns: &[Column; 6]) -> Result<(), Error> {
        let own = self.columns.iter_mut().zip(columns).zip(Self::DOMAINS);
        for ((values, column), domain) in own {
            values.push(row.number(column, domain)?);
        }
        Ok(())
    }

    /// The numbers of a sample.
    pub(super) fn of_sample(&self, sample: usize) -> [f64; 6] {
        std::array::from_fn(|axis| self.columns[axis][sample])
    }
}

/// Columns and rules for reading a table.
pub(super) struct Reading<'c> {
    /// Time, depth and force.
    pub(super) columns: &'c [Column; 3],
    /// The six axes, if the table has them.
    pub(super) axes: Option<&'c [Column; 6]>,
    /// Treatment of rows that repeat the one above.
    pub(super) on_repeated: Repeated,
}
