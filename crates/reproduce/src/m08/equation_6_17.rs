//! (6.17) and (6.18): the source's starting values, as if the probe compressed a column evenly.
//!
//! ```text
//! F/A = 2 (C10 + C01/λ) (1/λ² − λ),   λ = 1 − d/L
//! ```
//!
//! *Assumed*: A is the probe's face and L that of figure 6-3, for the source prints neither. All moduli are proportional
//! to 1/A, so their ratio depends on L alone.

use nalgebra::{Matrix2, Vector2};
use palpate_characterize::lumped::{Contact, column_size};

use crate::Error;
use crate::m06::Printed;
use crate::published::cell;
use crate::row::{Line, Rows};
use crate::virtual_rig::RADIUS;

use super::block::ORGANS;

/// The column, and what one unit of each modulus contributes to its stress at the depths of table 5-1.
pub(super) struct Column {
    /// [m²]
    area: f64,
    /// [m]
    length: f64,
    /// Measured stress [Pa] and its derivatives by C10 and C01 [-].
    samples: Vec<(f64, Vector2<f64>)>,
}

impl Column {
    pub(super) fn of(organ: &str) -> Self {
        let printed = Printed::all(organ);
        let deepest = printed.last().map_or(0.0, |row| f64::from(row.depth_mm));
        let [area, length] = column_size(Contact::Flat(RADIUS), 1e-3 * deepest);
        let sample = |row: &Printed| {
            let stretch = 1.0 - row.depth() / length;
            let first = 2.0 * (1.0 / (stretch * stretch) - stretch); // (6.17)
            (row.mean / area, Vector2::new(first, first / stretch)) // (6.18)
        };
        Self {
            area,
            length,
            samples: printed.iter().map(sample).collect(),
        }
    }

    /// C10 of (6.17) by least squares [Pa].
    pub(super) fn neo_hookean(&self) -> f64 {
        let products = self.samples.iter().map(|(stress, by)| stress * by.x);
        let squares = self.samples.iter().map(|(_, by)| by.x * by.x);
        products.sum::<f64>() / squares.sum::<f64>()
    }

    /// C10 and C01 of (6.18) by least squares [Pa]; none when the depths do not tell them apart.
    pub(super) fn mooney_rivlin(&self) -> Option<Vector2<f64>> {
        let matrix: Matrix2<f64> = self.samples.iter().map(|(_, by)| by * by.transpose()).sum();
        let right: Vector2<f64> = self.samples.iter().map(|(stress, by)| by * *stress).sum();
        matrix.lu().solve(&right)
    }

    /// `line` with its area and length in the note.
    pub(super) fn in_note_of<'r, 'a>(&self, line: Line<'r, 'a>) -> Line<'r, 'a> {
        line.with("area", format!("{:.2}", 1e6 * self.area))
            .with("length", format!("{:.0}", 1e3 * self.length))
    }
}

pub(crate) fn neo_hookean(rows: &mut Rows<'_>) -> Result<(), Error> {
    for (organ, _) in ORGANS {
        let column = Column::of(organ);
        let found = column.neo_hookean();
        column
            .in_note_of(rows.row(&format!("{organ}/c10")))
            .is(found);
        let printed = cell(&format!("table-6-4 {organ} initial_c10_pa"))?;
        let needed = column.area * found / printed;
        rows.add(&format!("{organ}/area_needed"), 1e6 * needed);
    }
    Ok(())
}

pub(crate) fn mooney_rivlin(rows: &mut Rows<'_>) -> Result<(), Error> {
    for (organ, _) in ORGANS {
        let column = Column::of(organ);
        let Some(found) = column.mooney_rivlin() else {
            return Err(Error::failed("the depths do not tell the two moduli apart"));
        };
        for (word, ours) in [("c10", found.x), ("c01", found.y)] {
            column
                .in_note_of(rows.row(&format!("{organ}/{word}")))
                .is(ours);
        }
        let c10 = cell(&format!("table-6-5 {organ} initial_c10_pa"))?;
        let c01 = cell(&format!("table-6-5 {organ} initial_c01_pa"))?;
        rows.row(&format!("{organ}/c01_over_c10"))
            .published(c01 / c10)
            .is(found.y / found.x);
        let alone = cell(&format!("table-6-4 {organ} initial_c10_pa"))?;
        rows.row(&format!("{organ}/sum_over_neo_hookean"))
            .published((c10 + c01) / alone)
            .is(found.sum() / column.neo_hookean());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the stress of a known law, at the depths of the table.
    #[test]
    fn a_column_gives_back_its_moduli() {
        let mut column = Column::of("liver");
        for (stress, by) in &mut column.samples {
            *stress = 300.0 * by.x + 100.0 * by.y;
        }
        let found = column.mooney_rivlin().unwrap();
        // The two columns of the matrix are nearly parallel: rounding times its condition number, below 1e6.
        assert!(
            (found - Vector2::new(300.0, 100.0)).norm() < 1e-6,
            "{found}"
        );
        for (stress, by) in &mut column.samples {
            *stress = 300.0 * by.x;
        }
        assert!((column.neo_hookean() - 300.0).abs() < 1e-10);
    }
}
