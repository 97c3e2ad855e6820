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
use crate::published::{TABLE_6_4, TABLE_6_5};
use crate::row::Value;
use crate::virtual_rig::RADIUS;
use crate::{Item, Rows};

use super::block::ORGANS;

pub(crate) const EQUATION_6_17: Item = Item {
    name: "equation-6-17",
    title: "starting values of the neo-Hookean law, from a column",
    seconds: 0.1,
    run: neo_hookean,
};

pub(crate) const EQUATION_6_18: Item = Item {
    name: "equation-6-18",
    title: "starting values of the Mooney-Rivlin law, from a column",
    seconds: 0.1,
    run: mooney_rivlin,
};

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
            let stretch = 1.0 - 1e-3 * f64::from(row.depth_mm) / length;
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

    pub(super) fn note(&self) -> String {
        format!(
            "by least squares on the means of table 5-1, with the probe's face, {:.2} mm², and a column of {:.0} mm; the source prints \
             neither the area nor the length that it took",
            1e6 * self.area,
            1e3 * self.length
        )
    }
}

fn neo_hookean(rows: &mut Rows<'_>) -> Result<(), Error> {
    for (organ, _) in ORGANS {
        let column = Column::of(organ);
        let published = TABLE_6_4.value(organ, "initial_c10_pa");
        let value = Value::beside(published, column.neo_hookean(), "Pa");
        let note = format!(
            "published: initial value of table 6-4; {}; no fixed pair returns its C10 for both organs",
            column.note()
        );
        rows.add(&format!("{organ}/c10"), value, note);
        let needed = published.map(|c10| column.area * column.neo_hookean() / c10);
        let note = "area of the column with which (6.17) returns the printed value, where the probe's face has 3.14 mm²: moduli go as \
                    one over the area, so that this is all of the difference for this length; the two organs need different areas, and \
                    none of them is printed";
        let needed = Value {
            published: None,
            ours: needed.map(|area| 1e6 * area),
            unit: "mm²",
        };
        rows.add(&format!("{organ}/area_needed"), needed, note);
    }
    Ok(())
}

fn mooney_rivlin(rows: &mut Rows<'_>) -> Result<(), Error> {
    for (organ, _) in ORGANS {
        let column = Column::of(organ);
        let Some(found) = column.mooney_rivlin() else {
            rows.add_missing(organ, "Pa", "the depths do not tell the two moduli apart");
            continue;
        };
        let printed = ["initial_c10_pa", "initial_c01_pa"].map(|name| TABLE_6_5.value(organ, name));
        let note = format!("published: initial value of table 6-5; {}", column.note());
        for (word, published, ours) in [("c10", printed[0], found.x), ("c01", printed[1], found.y)]
        {
            let value = Value::beside(published, ours, "Pa");
            rows.add(&format!("{organ}/{word}"), value, note.clone());
        }
        let both = printed[0].zip(printed[1]);
        let note = "C01 over C10, which does not depend on the area; the printed ones are within 3 % of 1, as a rule that splits \
                    what it cannot tell apart gives them: where the column is hardly compressed only the sum is known";
        let ratio = Value::beside(both.map(|(c10, c01)| c01 / c10), found.y / found.x, "1");
        rows.add(&format!("{organ}/c01_over_c10"), ratio, note);
        let note = "C10 + C01 of (6.18) over C10 of (6.17), which does not depend on the area either; 1 for a column that is hardly \
                    compressed";
        let alone = TABLE_6_4.value(organ, "initial_c10_pa");
        let published = both
            .zip(alone)
            .map(|((c10, c01), alone)| (c10 + c01) / alone);
        let sum = Value::beside(published, found.sum() / column.neo_hookean(), "1");
        rows.add(&format!("{organ}/sum_over_neo_hookean"), sum, note);
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
