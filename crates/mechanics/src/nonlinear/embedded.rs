//! Points that are embedded in the elements: the vertices of the display mesh.
//!
//! A point X inside an element moves by its shape functions. A point outside moves with the nearest point Y of the boundary,
//! and rotates about it with the body: with u the displacement and Q the rotation of the body at Y,
//!
//! ```text
//! u(Y) + (Q(Y) − 1) (X − Y)
//! ```
//!
//! Both are continuous along the boundary, so that the display mesh has no steps between elements. Shape functions would have:
//! outside their element quadratic functions grow fast, and differ from element to element.

use std::ops::Range;

use nalgebra::Matrix3;
use palpate_geometry::{AabbTree, NodeId, TetrahedronMesh, TriangleMesh};

use super::boundary::shape_on_face;
use super::elements::NODES;
use super::model::NonlinearModel;
use super::state::NonlinearState;
use crate::finite_elements::ElementKind;
use crate::finite_elements::solid::{Face, faces};
use crate::{Error, Vec3};

/// Barycentric coordinates down to minus this are inside [-]: rounding.
const OUTSIDE: f64 = 1e-9;

/// Points that move with the elements of a body.
#[derive(Debug, Clone, Default)]
pub struct EmbeddedPoints {
    points: Vec<EmbeddedPoint>,
}

#[derive(Debug, Clone, Copy)]
struct EmbeddedPoint {
    /// Nodes, and their weights in the displacement [-].
    nodes: [u32; NODES],
    shape: [f32; NODES],
    /// None inside an element.
    outside: Option<Outside>,
}

/// A point outside, relative to the nearest point of the boundary.
#[derive(Debug, Clone, Copy)]
struct Outside {
    /// X − Y [m].
    offset: Vec3,
    /// Nodes, and their weights in the rotation [-].
    rotation: [(u32, f64); 3],
}

impl EmbeddedPoints {
    /// `elements` are the nodes of the quadratic tetrahedra of `mesh`; the `points` are embedded in those of `range`.
    ///
    /// # Errors
    /// When the range is empty.
    pub(super) fn new(
        mesh: &TetrahedronMesh,
        elements: &[u32],
        points: &[Vec3],
        range: Range<usize>,
    ) -> Result<Self, Error> {
        let faces = faces(mesh).into_iter();
        let faces: Vec<Face> = faces
            .filter(|face| range.contains(&face.tetrahedron))
            .collect();
        let corners = faces.iter().map(|face| face.corners).collect();
        let boundary = TriangleMesh::new(mesh.vertices().to_vec(), corners);
        let boundary = boundary.map_err(|_| Error::NoElements)?;
        let tree = AabbTree::new(&boundary);
        let inside = InElements::new(mesh, range);
        let points = points.iter().map(|point| {
            inside.of(elements, point).unwrap_or_else(|| {
                let nearest = tree.nearest(&boundary, point);
                let on = nearest.on;
                EmbeddedPoint::outside(
                    &faces[nearest.triangle.index()],
                    on.barycentric,
                    point - on.position,
                )
            })
        });
        Ok(Self {
            points: points.collect(),
        })
    }

    /// Appends the points of `other`.
    pub fn extend(&mut self, other: Self) {
        self.points.extend(other.points);
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Of each point the free piece of `model` that it moves with, from 1 on; zero for all that is fixed.
    pub fn free_pieces(&self, model: &NonlinearModel) -> impl Iterator<Item = u32> {
        let points = self.points.iter();
        points.map(|point| model.drag.piece(point.nodes[0]))
    }

    /// Displacement [m] of each point, in their order, where the body is in `state`.
    pub fn displacements<'a>(
        &'a self,
        state: &'a NonlinearState,
    ) -> impl Iterator<Item = Vec3> + 'a {
        self.points.iter().map(|point| point.displacement(state))
    }
}

impl EmbeddedPoint {
    /// A point at this `offset` [m] from the point of a face with these `barycentric` coordinates.
    fn outside(face: &Face, barycentric: [f64; 3], offset: Vec3) -> Self {
        let (mut nodes, mut shape) = ([face.nodes[0] as u32; NODES], [0.0; NODES]);
        let weights = shape_on_face(barycentric);
        for (k, (node, weight)) in face.nodes.iter().zip(weights).enumerate() {
            (nodes[k], shape[k]) = (*node as u32, weight as f32);
        }
        let corners = face.corners.map(NodeId::index);
        let rotation = std::array::from_fn(|k| (corners[k] as u32, barycentric[k]));
        Self {
            nodes,
            shape,
            outside: Some(Outside { offset, rotation }),
        }
    }

    fn displacement(&self, state: &NonlinearState) -> Vec3 {
        let mut sum = Vec3::zeros();
        for (&node, &weight) in self.nodes.iter().zip(&self.shape) {
            let u = &state.displacements[3 * node as usize..][..3];
            sum += f64::from(weight) * Vec3::new(u[0], u[1], u[2]);
        }
        if let Some(Outside { offset, rotation }) = &self.outside {
            for &(node, weight) in rotation {
                let q = state.rotations[node as usize].map(f64::from);
                sum += weight * (Matrix3::from_column_slice(&q) * offset - offset);
            }
        }
        sum
    }
}

/// Tetrahedra, with the maps to their barycentric coordinates.
pub(super) struct InElements {
    first: usize,
    frames: Vec<(Vec3, Matrix3<f64>)>,
}

impl InElements {
    pub(super) fn new(mesh: &TetrahedronMesh, range: Range<usize>) -> Self {
        let first = range.start;
        let frames = range.map(|tetrahedron| {
            let [a, b, c, d] = mesh.positions(tetrahedron);
            let edges = Matrix3::from_columns(&[b - a, c - a, d - a]);
            // Tetrahedra of a mesh are not flat.
            (a, edges.try_inverse().unwrap_or_default())
        });
        Self {
            first,
            frames: frames.collect(),
        }
    }

    /// The first that a point is in, and its barycentric coordinates but for the first.
    fn find(&self, point: &Vec3) -> Option<(usize, [f64; 3])> {
        let mut frames = self.frames.iter();
        let mut at = [0.0; 3];
        let number = frames.position(|(corner, inverse)| {
            at = (inverse * (point - corner)).into();
            let [x, y, z] = at;
            (1.0 - x - y - z).min(x).min(y).min(z) >= -OUTSIDE
        })?;
        Some((number, at))
    }

    /// The tetrahedron that a point is in, and which of its integration points is nearest: that near its nearest corner.
    pub(super) fn nearest_point(&self, point: &Vec3) -> Option<(usize, usize)> {
        let (number, [x, y, z]) = self.find(point)?;
        let shares = [1.0 - x - y - z, x, y, z].into_iter().enumerate();
        let (nearest, _) = shares.max_by(|one, other| one.1.total_cmp(&other.1))?;
        Some((self.first + number, nearest))
    }

    /// A point inside one of them.
    fn of(&self, elements: &[u32], point: &Vec3) -> Option<EmbeddedPoint> {
        let (number, at) = self.find(point)?;
        let own = &elements[(self.first + number) * NODES..][..NODES];
        let mut shape = [0.0; NODES];
        ElementKind::Tet10.shape(at, &mut shape);
        Some(EmbeddedPoint {
            nodes: std::array::from_fn(|k| own[k]),
            shape: shape.map(|value| value as f32),
            outside: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Rotation3};
    use palpate_geometry::{NodeId, TetrahedronMesh};

    use super::Vec3;
    use crate::nonlinear::{Moduli, NonlinearModel, NonlinearState};

    /// A flat and a tall tetrahedron that share a face.
    fn model() -> NonlinearModel {
        let vertices = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.3, 0.3, 0.2],
            [0.3, 0.3, -2.0],
        ];
        let vertices = vertices.map(Vec3::from).to_vec();
        let tetrahedra = vec![[0, 1, 2, 3].map(NodeId), [0, 2, 1, 4].map(NodeId)];
        let mesh = TetrahedronMesh::new(vertices, tetrahedra).unwrap();
        let moduli = vec![Moduli::mooney_rivlin(1.0, 0.0, 0.45).unwrap(); 2];
        NonlinearModel::on_boundary(&mesh, &moduli, |_, place| place.z == 0.0).unwrap()
    }

    /// The body with its nodes at the given places, each rotated by `turn`.
    fn moved(
        model: &NonlinearModel,
        place: impl Fn(&Vec3) -> Vec3,
        turn: &Matrix3<f64>,
    ) -> NonlinearState {
        let mut state = NonlinearState::at_rest(model, 0);
        for (at, node) in model.nodes().iter().enumerate() {
            let by = place(node) - node;
            state.displacements[3 * at..][..3].copy_from_slice(by.as_slice());
            state.rotations[at] = std::array::from_fn(|k| turn.as_slice()[k] as f32);
        }
        state
    }

    /// Places around the body, inside and outside.
    fn places() -> Vec<Vec3> {
        let steps = |k: i32| 0.13 * f64::from(k) - 0.5;
        let grid = (0..15).flat_map(|i| (0..15).map(move |j| (i, j)));
        let grid = grid.flat_map(|(i, j)| (0..15).map(move |k| (i, j, k)));
        grid.map(|(i, j, k)| Vec3::new(steps(i), steps(j), 2.0 * steps(k) - 1.0))
            .collect()
    }

    /// Judge: the rotation itself; weights are stored in single precision.
    #[test]
    fn embedded_points_rotate_with_the_body() {
        let model = model();
        let turn = Rotation3::from_euler_angles(0.4, -1.1, 2.0);
        let state = moved(&model, |place| turn * place, turn.matrix());
        let places = places();
        let embedded = model.embed(&places, 0..2).unwrap();
        for (place, by) in places.iter().zip(embedded.displacements(&state)) {
            assert!((place + by - turn * place).norm() < 1e-5, "{place}");
        }
    }

    /// Judge: continuity. Pairs of points around a bent body, 1e-6 apart, stay as near. The body is convex, so that each has one
    /// nearest point of the boundary.
    #[test]
    fn embedded_points_move_continuously() {
        let model = model();
        let bent = |place: &Vec3| {
            let [x, y, z] = [place.x, place.y, place.z];
            place + Vec3::new(0.3 * z * z, 0.2 * x * y, 0.1 * x * x)
        };
        let state = moved(&model, bent, &Matrix3::identity());
        let near = Vec3::new(5e-7, -4e-7, 6e-7);
        let outside: Vec<Vec3> = (0..2000)
            .map(|k| {
                let (up, around) = (1.0 - f64::from(k) / 1000.0, 2.4 * f64::from(k));
                let across = (1.0 - up * up).sqrt();
                let direction = Vec3::new(across * around.cos(), across * around.sin(), up);
                Vec3::new(0.3, 0.3, -0.5) + 3.0 * direction
            })
            .collect();
        let beside: Vec<Vec3> = outside.iter().map(|place| place + near).collect();
        let [first, second] = [outside, beside].map(|places| {
            let embedded = model.embed(&places, 0..2).unwrap();
            embedded.displacements(&state).collect::<Vec<_>>()
        });
        for (own, other) in first.iter().zip(&second) {
            assert!((own - other).norm() < 1e-5, "{own} {other}");
        }
    }
}
