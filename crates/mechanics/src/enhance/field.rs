use super::interpolation::{Interpolation, SurfacePoint};
use super::press::{Dimple, Press};
use super::weights::Weights;
use crate::Vec3;

/// Sweeps over the presses until each has its own depth together with the others: two flat tips side by
/// side give each other a third, so that the error falls by nine in each.
const SWEEPS: usize = 16;

/// The displacement of a coarse surface at one instant, which can be evaluated anywhere on it.
#[derive(Debug, Clone, Default)]
pub struct SurfaceField {
    /// Displacement of each centroid less that of the dimples [m].
    residual: Vec<Vec3>,
    dimples: Vec<(Dimple, Vec3)>,
    rows: Weights,
}

impl SurfaceField {
    /// Zero, with room for `presses` at a time, which then allocate nothing.
    pub fn with_capacity(interpolation: &Interpolation, presses: usize) -> Self {
        Self {
            residual: Vec::with_capacity(interpolation.nodes().len()),
            dimples: Vec::with_capacity(presses),
            rows: Weights::with_capacity(presses, presses * interpolation.longest_row()),
        }
    }

    /// Takes the `displacements` of all centroids [m] and the `presses` that made them. With these the
    /// surface touches its tips; without, the displacements are only spread, and the dimple is shallower.
    /// Allocates nothing where there is room: see [`SurfaceField::with_capacity`].
    ///
    /// # Panics
    /// When there are not as many displacements as triangles.
    pub fn update(
        &mut self,
        interpolation: &Interpolation,
        displacements: &[Vec3],
        presses: &[Press],
    ) {
        let nodes = interpolation.nodes();
        assert_eq!(displacements.len(), nodes.len(), "one per triangle");
        self.residual.clear();
        self.residual.extend_from_slice(displacements);
        self.dimples.clear();
        self.rows.clear();
        for (number, press) in presses.iter().enumerate() {
            interpolation.write_row(&press.at, &mut self.rows);
            // Of one node, it would leap from triangle to triangle.
            let row = self.rows.row(number);
            let influence = row
                .map(|(node, weight)| weight * nodes[node.index()].radius)
                .sum();
            let dimple = Dimple::new(interpolation, press, influence);
            for (left, node) in self.residual.iter_mut().zip(nodes) {
                *left -= dimple.at(&node.place, &node.normal) * press.own;
            }
            self.dimples.push((dimple, press.own));
        }
        self.meet_the_tips(interpolation, presses);
    }

    /// Finds the amplitudes with which each contact point goes where its tip is.
    fn meet_the_tips(&mut self, interpolation: &Interpolation, presses: &[Press]) {
        for _ in 0..SWEEPS {
            for (number, press) in presses.iter().enumerate() {
                let (place, normal) = (
                    interpolation.place(&press.at),
                    interpolation.normal(&press.at),
                );
                let there =
                    self.rows.sum(number, &self.residual) + self.of_dimples(&place, &normal);
                self.dimples[number].1 += press.displacement - there;
            }
        }
    }

    /// Displacement of a point of the coarse surface [m]. Many points are better carried.
    pub fn displacement(&self, interpolation: &Interpolation, at: &SurfacePoint) -> Vec3 {
        let mut weights = Weights::default();
        interpolation.write_row(at, &mut weights);
        let (place, normal) = (interpolation.place(at), interpolation.normal(at));
        self.at(&place, &normal, &weights, 0)
    }

    /// Displacement [m] of a point at `place` [m] with the unit `normal` [-], `row` of `weights`.
    pub(super) fn at(&self, place: &Vec3, normal: &Vec3, weights: &Weights, row: usize) -> Vec3 {
        weights.sum(row, &self.residual) + self.of_dimples(place, normal)
    }

    fn of_dimples(&self, place: &Vec3, normal: &Vec3) -> Vec3 {
        let terms = self.dimples.iter();
        terms
            .map(|(dimple, amplitude)| dimple.at(place, normal) * amplitude)
            .sum()
    }
}
