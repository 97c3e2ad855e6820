use std::num::NonZero;
use std::thread;

use faer::Mat;

use super::integrals::{Place, integrate};
use super::kelvin::Kelvin;
use super::panel::Panel;

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
        let count = self.panels.len();
        let mut displacement = Mat::zeros(3 * count, 3 * count);
        let mut traction = Mat::zeros(3 * count, 3 * count);
        let cores = thread::available_parallelism().map_or(1, NonZero::get);
        // Columns are contiguous: each core fills those of its own panels.
        let share = count.div_ceil(cores).max(1);
        thread::scope(|scope| {
            let mut left = (displacement.as_mut(), traction.as_mut());
            let mut first = 0;
            while first < count {
                let many = share.min(count - first);
                let (u, u_left) = left.0.split_at_col_mut(3 * many);
                let (t, t_left) = left.1.split_at_col_mut(3 * many);
                left = (u_left, t_left);
                scope.spawn(move || self.fill(first..first + many, u, t));
                first += many;
            }
        });
        InfluenceMatrices {
            displacement,
            traction,
        }
    }

    fn fill(
        &self,
        sources: std::ops::Range<usize>,
        mut displacement: faer::MatMut<'_, f64>,
        mut traction: faer::MatMut<'_, f64>,
    ) {
        for (column, source) in sources.enumerate() {
            for (row, target) in self.panels.iter().enumerate() {
                let place = if row == source {
                    Place::OnPanel
                } else {
                    Place::Elsewhere
                };
                let found = integrate(&self.kelvin, &self.panels[source], &target.centroid, place);
                for a in 0..3 {
                    for b in 0..3 {
                        displacement[(3 * row + a, 3 * column + b)] = found.displacement[(a, b)];
                        let free = if row == source && a == b { 0.5 } else { 0.0 };
                        traction[(3 * row + a, 3 * column + b)] = found.traction[(a, b)] + free;
                    }
                }
            }
        }
    }
}
