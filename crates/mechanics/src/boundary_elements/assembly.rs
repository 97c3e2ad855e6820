use faer::{Mat, MatRef};
use nalgebra::Matrix3;

use super::integrals::{Place, integrate};
use super::kelvin::Kelvin;
use super::panel::Panel;
use super::precision::Precision;
use crate::cores::on_all_cores;

/// All influences of panels on panels: 3 n × 3 n, row 3 i + a for component a at the centroid of panel i.
pub struct InfluenceMatrices {
    /// U [m³/N]: of the traction on each panel.
    pub displacement: Mat<f64>,
    /// ½ 1 + T [-]: of the displacement of each panel.
    pub traction: Mat<f64>,
}

/// The panels of a solid.
pub struct Influences<'a> {
    /// Kelvin's solution in it.
    pub kelvin: Kelvin,
    /// Its surface, closed.
    pub panels: &'a [Panel],
}

impl Influences<'_> {
    /// Both matrices, by all cores.
    pub fn matrices(&self) -> InfluenceMatrices {
        let size = 3 * self.panels.len();
        let mut displacement = vec![0.0; size * size];
        let mut traction = vec![0.0; size * size];
        let columns = displacement.chunks_exact_mut(3 * size);
        let columns = columns.zip(traction.chunks_exact_mut(3 * size)).enumerate();
        on_all_cores(columns, |(source, (u, t))| {
            for target in 0..self.panels.len() {
                let (displacement, traction) = self.between(source, target);
                put(u, target, &displacement);
                put(t, target, &traction);
            }
        });
        let [displacement, traction] = [displacement, traction]
            .map(|columns| MatRef::from_column_major_slice(&columns, size, size).to_owned());
        InfluenceMatrices {
            displacement,
            traction,
        }
    }

    /// Blocks of U [m³/N] and ½ 1 + T [-]: what the panel `source` does at the centroid of `target`.
    pub(super) fn between(&self, source: usize, target: usize) -> (Matrix3<f64>, Matrix3<f64>) {
        let (place, free) = if source == target {
            (Place::OnPanel, 0.5)
        } else {
            (Place::Elsewhere, 0.0)
        };
        let x = &self.panels[target].centroid;
        let found = integrate(&self.kelvin, &self.panels[source], x, place);
        let traction = found.traction + Matrix3::identity() * free;
        (found.displacement, traction)
    }
}

/// Writes the rows of the panel `target` into the three columns of a source.
pub(super) fn put<T: Precision>(columns: &mut [T], target: usize, block: &Matrix3<f64>) {
    let size = columns.len() / 3;
    for (column, values) in columns.chunks_exact_mut(size).zip(block.column_iter()) {
        for (place, &value) in column[3 * target..].iter_mut().zip(values.iter()) {
            *place = T::of(value);
        }
    }
}
