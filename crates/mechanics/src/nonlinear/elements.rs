//! Quadratic tetrahedra with straight edges, eight side by side, and the gather and scatter of nodal values.

use palpate_geometry::TetrahedronMesh;

use super::lanes::{LANES, Lanes, Scalar, Vector, plus, scaled};
use super::law::Moduli;

/// Nodes of a quadratic tetrahedron, in the order of `ElementKind::Tet10`.
pub(super) const NODES: usize = 10;

/// Middle node between two corners.
const MIDDLE: [[usize; 4]; 4] = [[0, 4, 6, 7], [4, 0, 5, 8], [6, 5, 0, 9], [7, 8, 9, 0]];

/// Integration points, each of a quarter of the volume and near one corner: exact for quadratic functions.
pub(super) const POINTS: usize = 4;

/// Barycentric coordinates of a point: of the corner near it, and of the others [-].
pub(super) const NEAR: f64 = 0.585_410_196_624_968_5;
pub(super) const FAR: f64 = 0.138_196_601_125_010_5;

/// Displacements of, or forces on, the nodes of each element.
pub(super) type Nodal<T> = [Vector<T>; NODES];

/// Eight elements.
#[derive(Debug, Clone)]
pub(super) struct Pack<T> {
    /// Their nodes. A place that is left over in the last pack has nodes of another element, and no volume.
    pub(super) nodes: [[u32; LANES]; NODES],
    /// Gradients of the barycentric coordinates at rest [1/m].
    pub(super) slopes: [Vector<T>; 4],
    /// A quarter of the volume at rest [m³].
    pub(super) quarter: Lanes<T>,
    pub(super) moduli: Moduli<Lanes<T>>,
}

impl<T: Scalar> Pack<T> {
    /// All elements of `mesh`; `nodes` are the ten of each, `moduli` those of each element.
    pub(super) fn all(mesh: &TetrahedronMesh, nodes: &[u32], moduli: &[Moduli<f64>]) -> Vec<Self> {
        let numbers: Vec<usize> = (0..mesh.tetrahedra().len()).collect();
        numbers
            .chunks(LANES)
            .map(|elements| Self::of(mesh, elements, nodes, moduli))
            .collect()
    }

    fn of(
        mesh: &TetrahedronMesh,
        elements: &[usize],
        nodes: &[u32],
        moduli: &[Moduli<f64>],
    ) -> Self {
        let mut pack = Self {
            nodes: [[0; LANES]; NODES],
            slopes: [Vector::default(); 4],
            quarter: Lanes::default(),
            moduli: Moduli::default(),
        };
        for lane in 0..LANES {
            let element = elements[lane.min(elements.len() - 1)];
            for (own, node) in pack.nodes.iter_mut().zip(&nodes[NODES * element..]) {
                own[lane] = *node;
            }
            let [a, b, c, d] = mesh.positions(element);
            let six_fold = (b - a).dot(&(c - a).cross(&(d - a)));
            let slopes = [
                (d - b).cross(&(c - b)),
                (c - a).cross(&(d - a)),
                (d - a).cross(&(b - a)),
                (b - a).cross(&(c - a)),
            ];
            for (own, slope) in pack.slopes.iter_mut().zip(slopes) {
                for axis in 0..3 {
                    own[axis].0[lane] = T::of(slope[axis] / six_fold);
                }
            }
            pack.moduli.put(lane, &moduli[element]);
            if lane < elements.len() {
                pack.quarter.0[lane] = T::of(six_fold / 24.0);
            }
        }
        pack
    }

    /// The displacements [m] of the nodes relative to that of the first, which strains nothing: no digit is lost
    /// where a body has moved far.
    #[inline(always)]
    pub(super) fn gather_displacements(&self, values: &[f64]) -> Nodal<T> {
        let mut nodal = Nodal::default();
        for lane in 0..LANES {
            let first = 3 * self.nodes[0][lane] as usize;
            for (own, nodes) in nodal.iter_mut().zip(&self.nodes).skip(1) {
                let at = 3 * nodes[lane] as usize;
                for axis in 0..3 {
                    own[axis].0[lane] = T::of(values[at + axis] - values[first + axis]);
                }
            }
        }
        nodal
    }

    /// The values of the nodes.
    #[inline(always)]
    pub(super) fn gather(&self, values: &[T]) -> Nodal<T> {
        let mut nodal = Nodal::default();
        for (own, nodes) in nodal.iter_mut().zip(&self.nodes) {
            for (lane, &node) in nodes.iter().enumerate() {
                let at = 3 * node as usize;
                let value = &values[at..at + 3];
                own[0].0[lane] = value[0];
                own[1].0[lane] = value[1];
                own[2].0[lane] = value[2];
            }
        }
        nodal
    }

    /// Adds to the values of the nodes.
    #[inline(always)]
    pub(super) fn scatter(&self, nodal: &Nodal<T>, values: &mut [T]) {
        for (own, nodes) in nodal.iter().zip(&self.nodes) {
            for (lane, &node) in nodes.iter().enumerate() {
                let at = 3 * node as usize;
                let value = &mut values[at..at + 3];
                value[0] += own[0].0[lane];
                value[1] += own[1].0[lane];
                value[2] += own[2].0[lane];
            }
        }
    }

    /// ∂u/∂X at an integration point [-].
    #[inline(always)]
    pub(super) fn gradient(&self, nodal: &Nodal<T>, point: usize) -> [Vector<T>; 3] {
        let mut gradient = <[Vector<T>; 3]>::default();
        for corner in 0..4 {
            let weights = weights(corner, point);
            let mut sum = scaled(&nodal[corner], Lanes::splat(weights[corner]));
            for other in (0..4).filter(|other| *other != corner) {
                let middle = &nodal[MIDDLE[corner][other]];
                sum = plus(&sum, &scaled(middle, Lanes::splat(weights[other])));
            }
            for (column, slope) in gradient.iter_mut().zip(&self.slopes[corner]) {
                *column = plus(column, &scaled(&sum, *slope));
            }
        }
        gradient
    }

    /// Adds the forces of a first Piola-Kirchhoff stress at an integration point, times its volume [N].
    #[inline(always)]
    pub(super) fn add_forces(&self, stress: &[Vector<T>; 3], point: usize, nodal: &mut Nodal<T>) {
        for corner in 0..4 {
            let weights = weights(corner, point);
            let force = super::lanes::times(stress, &self.slopes[corner]);
            let own = scaled(&force, Lanes::splat(weights[corner]));
            nodal[corner] = plus(&nodal[corner], &own);
            for other in (0..4).filter(|other| *other != corner) {
                let share = scaled(&force, Lanes::splat(weights[other]));
                let middle = &mut nodal[MIDDLE[corner][other]];
                *middle = plus(middle, &share);
            }
        }
    }
}

/// Parts of ∇λ of `corner` in the gradients of the shape functions at a point: of the corner's own, 4 λ − 1, and of
/// the middles towards the others, 4 λ of those.
#[inline(always)]
fn weights(corner: usize, point: usize) -> [f64; 4] {
    let mut weights = [4.0 * FAR; 4];
    weights[point] = 4.0 * NEAR;
    weights[corner] -= 1.0;
    weights
}
