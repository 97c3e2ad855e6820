//! Directions of fibres in a body: a table with a row for each location.
//!
//! ```text
//! # format = 1
//! x_m,y_m,z_m,axis_x,axis_y,axis_z,across_x,across_y,across_z
//! 0.001,0.002,0.0,1.0,0.0,0.0,0.0,1.0,0.0
//! ```

use std::path::Path;

use crate::atomic_write::{MAX_TABLE_BYTES, read_text};
use crate::table::{Column, Row, TableText};
use crate::{Domain, Error};

/// Directions of fibres in a body.
#[derive(Debug, Clone, PartialEq)]
pub struct FibreDirections {
    /// At least one.
    pub rows: Vec<FibreDirection>,
}

/// Directions of fibres at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FibreDirection {
    /// The place at rest [m].
    pub position_m: [f64; 3],
    /// The reference axis, of any length but zero [-].
    pub axis: [f64; 3],
    /// A second direction in the plane of the fibres, not parallel to the axis [-]; all rows have it or none.
    pub across: Option<[f64; 3]>,
}

/// Sine of the angle below which two directions are parallel [-].
const PARALLEL: f64 = 1e-9;

impl FibreDirections {
    /// Reads a table of directions.
    ///
    /// # Errors
    /// When the file cannot be read or holds no directions.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::parse(&read_text(path, MAX_TABLE_BYTES)?, path)
    }

    /// Reads the text of such a table; `path` is its name in errors.
    ///
    /// # Errors
    /// When the text holds no directions, or an axis that is zero or parallel to its second direction.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let table = TableText::parse(text, path, &[])?;
        let three = |names: [&str; 3]| -> Result<[Column; 3], Error> {
            let [x, y, z] = names.map(|name| table.column(name));
            Ok([x?, y?, z?])
        };
        let position = three(["x_m", "y_m", "z_m"])?;
        let axis = three(["axis_x", "axis_y", "axis_z"])?;
        let across = match table.optional_column("across_x")? {
            Some(_) => Some(three(["across_x", "across_y", "across_z"])?),
            None => None,
        };
        table.refuse_near_misses(&[
            "x_m", "y_m", "z_m", "axis_x", "axis_y", "axis_z", "across_x", "across_y", "across_z",
        ])?;
        let mut read = Vec::new();
        let mut rows = table.rows();
        while let Some(row) = rows.next()? {
            let direction = FibreDirection {
                position_m: numbers(&row, &position, Domain::POSITION)?,
                axis: direction(&row, &axis)?,
                across: across
                    .as_ref()
                    .map(|across| direction(&row, across))
                    .transpose()?,
            };
            if let (Some(second), Some(columns)) = (direction.across, &across)
                && sine(direction.axis, second) < PARALLEL
            {
                return Err(row.invalid(&columns[0], "a direction that is not that of the axis"));
            }
            read.push(direction);
        }
        match read.is_empty() {
            true => Err(Error::NoRows {
                path: path.to_owned(),
            }),
            false => Ok(Self { rows: read }),
        }
    }
}

fn numbers(row: &Row<'_>, columns: &[Column; 3], domain: Domain) -> Result<[f64; 3], Error> {
    let [x, y, z] = columns.each_ref().map(|column| row.number(column, domain));
    Ok([x?, y?, z?])
}

fn direction(row: &Row<'_>, columns: &[Column; 3]) -> Result<[f64; 3], Error> {
    let found = numbers(row, columns, COMPONENT)?;
    match found.iter().all(|part| *part == 0.0) {
        true => Err(row.invalid(&columns[0], "a direction, of which a component is not zero")),
        false => Ok(found),
    }
}

/// A component of a direction [-].
const COMPONENT: Domain = Domain::number(
    "a component of a direction",
    [
        std::ops::Bound::Included(-1e6),
        std::ops::Bound::Included(1e6),
    ],
);

/// Of the angle between two directions [-].
fn sine(a: [f64; 3], b: [f64; 3]) -> f64 {
    let norm = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let cross = [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ];
    norm(cross) / (norm(a) * norm(b))
}
