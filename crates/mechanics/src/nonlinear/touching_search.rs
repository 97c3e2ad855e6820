//! Search for places where the boundary of a body is near itself.

use palpate_geometry::{AabbTree, NodeId, TriangleId, TriangleMesh, closest_on_triangle};

use super::boundary::shape_on_face;
use super::contact::{Against, NODES, UnilateralContact};
use super::model::NonlinearModel;
use super::state::NonlinearState;
use super::touching::{
    NODE_PLACES, NOWHERE, PART_NODES, PARTS, POINTS, TouchingBoundary, on_face, shape_at_point,
    slopes_on_face,
};
use crate::Vec3;

/// In mean edges [-]: nearer than this a point may touch in the step; so deep it is not taken as in contact any more; and so far
/// others are sought.
const NEAR: f64 = 0.3;
const DEEPEST: f64 = 0.5;
const REACH: f64 = 1.0;

/// Largest tangential distance of a point from its projection onto the surface [mean edges].
const MAX_TANGENTIAL: f64 = 0.02;

/// What a point lies behind is by so much at most farther than the nearest face, whatever way that faces [mean edges]: else it
/// is beyond a wall or a whole piece.
const BEYOND: f64 = 0.1;

/// Cosine of the angle between two normals, above which their surfaces do not touch [-].
const OPPOSES: f64 = -0.2;

/// By how much a point of a face may move more than its nodes, and they all [-].
const FASTEST: f64 = 2.5;

/// Steps in which a point is projected onto the surface, and its lag below which it is [mean edges].
const PROJECTIONS: usize = 8;
const PROJECTED: f64 = 1e-9;

/// Scratch of the search; dropping it changes nothing.
#[derive(Debug, Clone)]
pub struct TouchingSearch {
    /// The boundary now, and boxes around its triangles.
    mesh: TriangleMesh,
    tree: AabbTree,
    /// Low and high corner of the box around each piece [m].
    boxes: Vec<[Vec3; 2]>,
    /// Normals of each face alone at its nodes, and of the smooth surface.
    raw: Vec<[Vec3; NODES]>,
    normals: Vec<[Vec3; NODES]>,
    /// How far its nodes have moved so far at most [m], and from where on each point is sought again.
    travelled: f64,
    until: Vec<f64>,
}

/// A point of the boundary that may touch another place of it in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TouchingPoint {
    /// Its signed distance from there [m], negative inside.
    pub gap: f64,
    /// Whether both are sides of a slit, which lie on each other at rest.
    pub is_in_slit: bool,
    /// The contact.
    pub contact: UnilateralContact,
}

/// A point of the boundary that is near another place of it.
pub(super) struct Found {
    pub(super) point: usize,
    face: usize,
    weights: [f64; NODES],
    normal: Vec3,
    /// Signed, along the normal [m].
    pub(super) distance: f64,
    friction: f64,
}

/// A place of a face.
#[derive(Debug, Clone, Copy)]
struct Place {
    face: usize,
    at: [f64; 3],
}

impl TouchingSearch {
    /// Room for `boundary`.
    pub fn new(boundary: &TouchingBoundary) -> Self {
        let mesh = boundary.rest.clone();
        Self {
            tree: AabbTree::new(&mesh),
            mesh,
            boxes: vec![[Vec3::zeros(); 2]; boundary.pieces],
            raw: vec![[Vec3::zeros(); NODES]; boundary.faces.len()],
            normals: vec![[Vec3::zeros(); NODES]; boundary.faces.len()],
            travelled: 0.0,
            until: vec![0.0; POINTS * boundary.faces.len()],
        }
    }

    /// Visits the contacts of the body in `state` with itself that may be active in a step. Returns how deep
    /// a point lies at most that is too deep to be one [m]: nothing pushes it out.
    ///
    /// # Panics
    /// When it, `boundary` or `state` are those of another model.
    pub fn find(
        &mut self,
        boundary: &TouchingBoundary,
        model: &NonlinearModel,
        state: &NonlinearState,
        mut visit: impl FnMut(TouchingPoint),
    ) -> f64 {
        let (near, deepest) = (NEAR * boundary.edge, DEEPEST * boundary.edge);
        let mut lost = 0.0_f64;
        self.find_all(boundary, model, state, |found| {
            let gap = found.distance - boundary.allowed[found.point];
            if gap < -deepest {
                lost = lost.max(-gap);
            } else if gap < near {
                let face = &boundary.faces[found.face];
                let against = std::array::from_fn(|k| {
                    (boundary.nodes[face.nodes[k] as usize], found.weights[k])
                });
                let point = boundary.point(found.point);
                let own = &model.boundary_points()[point];
                let moved =
                    own.displacement(&state.displacements) - state.mean_displacement(&against);
                visit(TouchingPoint {
                    gap,
                    is_in_slit: boundary.is_in_slit(found.point, found.face),
                    contact: UnilateralContact {
                        point: point as u32,
                        normal: found.normal,
                        offset: gap - found.normal.dot(&moved),
                        friction: found.friction,
                        against: Against::Boundary(against),
                    },
                });
            }
        });
        lost
    }

    /// Visits all points that are near a place of the boundary.
    pub(super) fn find_all(
        &mut self,
        boundary: &TouchingBoundary,
        model: &NonlinearModel,
        state: &NonlinearState,
        mut visit: impl FnMut(Found),
    ) {
        self.go_to(boundary, model, state);
        if self.until.iter().all(|until| *until > self.travelled) {
            return;
        }
        self.tree.refit_all(&self.mesh);
        self.find_boxes(boundary);
        self.find_normals(boundary);
        for point in 0..self.until.len() {
            if self.until[point] <= self.travelled
                && let Some(found) = self.seek(boundary, point)
            {
                visit(found);
            }
        }
    }

    /// Goes to where the body is.
    fn go_to(
        &mut self,
        boundary: &TouchingBoundary,
        model: &NonlinearModel,
        state: &NonlinearState,
    ) {
        let mut farthest = 0.0_f64;
        for (number, &node) in boundary.nodes.iter().enumerate() {
            let at = 3 * node as usize;
            let u = &state.displacements[at..at + 3];
            let bulge = &boundary.bulges[number];
            let q = state.rotations[node as usize].map(f64::from);
            let place = Vec3::from_fn(|i, _| {
                let turned = q[i] * bulge.x + q[3 + i] * bulge.y + q[6 + i] * bulge.z;
                model.nodes()[node as usize][i] + u[i] + turned
            });
            let number = NodeId(number as u32);
            let before = self.mesh.vertices()[number.index()];
            farthest = farthest.max((place - before).norm());
            self.mesh.move_vertex(number, place);
        }
        self.travelled += farthest;
    }

    fn find_boxes(&mut self, boundary: &TouchingBoundary) {
        self.boxes
            .fill([Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY)]);
        for face in &boundary.faces {
            let [low, high] = &mut self.boxes[face.piece];
            for node in face.nodes {
                let place = &self.mesh.vertices()[node as usize];
                (*low, *high) = (low.inf(place), high.sup(place));
            }
        }
    }

    fn find_normals(&mut self, boundary: &TouchingBoundary) {
        for (face, raw) in self.raw.iter_mut().enumerate() {
            let places = places(&self.mesh, boundary, face);
            for (normal, at) in raw.iter_mut().zip(NODE_PLACES) {
                let [u, v] = slopes_on_face(at).map(|slopes| on_face(&places, &slopes));
                *normal = u.cross(&v).try_normalize(0.0).unwrap_or_default();
            }
        }
        for (face, normals) in boundary.faces.iter().zip(&mut self.normals) {
            for (normal, [from, to]) in normals.iter_mut().zip(face.around) {
                let around = &boundary.around[from as usize..to as usize];
                let each = around.iter();
                let sum: Vec3 = each
                    .map(|&(other, node, weight)| weight * self.raw[other as usize][node as usize])
                    .sum();
                *normal = sum.try_normalize(0.0).unwrap_or_default();
            }
        }
    }

    /// The place that a point is near to, and the travel after which it is searched again.
    fn seek(&mut self, boundary: &TouchingBoundary, point: usize) -> Option<Found> {
        let reach = REACH * boundary.edge;
        let own = point / POINTS;
        let shape = shape_at_point(point);
        let place = on_face(&places(&self.mesh, boundary, own), &shape);
        let normal = on_face(&self.normals[own], &shape).normalize();
        let mut nearest = reach;
        let mut best = (reach, None);
        if self.is_near_a_box(boundary, own, &place) {
            let margin = Vec3::repeat(reach);
            let (low, high) = (place - margin, place + margin);
            self.tree.visit_box(&low, &high, |part| {
                let Some(friction) = boundary.pair(point, part.index()) else {
                    return;
                };
                let corners = self.mesh.positions(part);
                let on = closest_on_triangle(&corners, &place);
                let distance = (on.position - place).norm();
                nearest = nearest.min(distance);
                let outward = self.mesh.area_vector(part);
                if distance < best.0 && outward.dot(&normal) < OPPOSES * outward.norm() {
                    best = (distance, Some((part, on.barycentric, friction)));
                }
            });
        }
        self.until[point] = self.travelled + (nearest - NEAR * boundary.edge).max(0.0) / FASTEST;
        let (part, barycentric, friction) = best.1?;
        let on = on_whole_face(part, &barycentric);
        let (on, normal, distance) = self.project(boundary, on, &place)?;
        if distance < 0.0 && best.0 > nearest + BEYOND * boundary.edge {
            return None;
        }
        Some(Found {
            point,
            face: on.face,
            weights: shape_on_face(on.at),
            normal,
            distance,
            friction,
        })
    }

    /// Whether a place of a face is near a piece that the face may touch.
    fn is_near_a_box(&self, boundary: &TouchingBoundary, face: usize, place: &Vec3) -> bool {
        let reach = Vec3::repeat(REACH * boundary.edge);
        let own = boundary.faces[face].piece;
        self.boxes.iter().enumerate().any(|(other, [low, high])| {
            boundary.touches(own, other)
                && (0..3).all(|k| place[k] > low[k] - reach[k] && place[k] < high[k] + reach[k])
        })
    }

    /// The place of the smooth surface, from `on`, whose normal leads to `point` [m]; with the normal, and the distance
    /// along it [m]. None if the point has no projection on the surface.
    fn project(
        &self,
        boundary: &TouchingBoundary,
        mut on: Place,
        point: &Vec3,
    ) -> Option<(Place, Vec3, f64)> {
        for _ in 0..PROJECTIONS {
            let places = places(&self.mesh, boundary, on.face);
            let weights = shape_on_face(on.at);
            let normal = on_face(&self.normals[on.face], &weights).normalize();
            let apart = point - on_face(&places, &weights);
            let tangential = apart - normal * normal.dot(&apart);
            if tangential.norm() < PROJECTED * boundary.edge {
                break;
            }
            let [u, v] = slopes_on_face(on.at).map(|slopes| on_face(&places, &slopes));
            let (uu, uv, vv) = (u.dot(&u), u.dot(&v), v.dot(&v));
            let (ru, rv) = (u.dot(&tangential), v.dot(&tangential));
            let determinant = uu * vv - uv * uv;
            if determinant <= 0.0 {
                return None;
            }
            let (du, dv) = (
                (vv * ru - uv * rv) / determinant,
                (uu * rv - uv * ru) / determinant,
            );
            on.at = [on.at[0] + du, on.at[1] + dv, on.at[2] - du - dv];
            on = self.onto_face(boundary, on);
        }
        let weights = shape_on_face(on.at);
        let normal = on_face(&self.normals[on.face], &weights).normalize();
        let apart = point - on_face(&places(&self.mesh, boundary, on.face), &weights);
        let distance = normal.dot(&apart);
        let tangential = (apart - normal * distance).norm();
        (tangential < MAX_TANGENTIAL * boundary.edge).then_some((on, normal, distance))
    }

    /// A place beyond an edge, on that edge: of the face beyond it if the edge is smooth.
    fn onto_face(&self, boundary: &TouchingBoundary, on: Place) -> Place {
        let corner = (0..3)
            .min_by(|a, b| on.at[*a].total_cmp(&on.at[*b]))
            .unwrap_or(0);
        if on.at[corner] >= 0.0 {
            return on;
        }
        let cut = on.at.map(|part| part.max(0.0));
        let sum: f64 = cut.iter().sum();
        let at = cut.map(|part| part / sum);
        let own = &boundary.faces[on.face];
        let beyond = own.across[corner];
        if beyond == NOWHERE {
            return Place { at, ..on };
        }
        let other = &boundary.faces[beyond as usize];
        let same = |k: usize| (0..3).find(|j| own.nodes[*j] == other.nodes[k]);
        Place {
            face: beyond as usize,
            at: [0, 1, 2].map(|k| same(k).map_or(0.0, |j| at[j])),
        }
    }
}

/// Positions of the nodes of a face [m].
fn places(mesh: &TriangleMesh, boundary: &TouchingBoundary, face: usize) -> [Vec3; NODES] {
    boundary.faces[face]
        .nodes
        .map(|node| mesh.vertices()[node as usize])
}

/// A place of one of the triangles of a face.
fn on_whole_face(part: TriangleId, barycentric: &[f64; 3]) -> Place {
    let corners = PART_NODES[part.index() % PARTS];
    let at = [0, 1, 2].map(|i| {
        let each = corners.iter().zip(barycentric);
        each.map(|(&node, weight)| weight * NODE_PLACES[node][i])
            .sum()
    });
    Place {
        face: part.index() / PARTS,
        at,
    }
}
