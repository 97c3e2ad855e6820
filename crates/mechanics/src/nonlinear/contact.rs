//! Unilateral contact of the boundary with bodies, with Coulomb friction.
//!
//! Points of each face stay out of half-spaces, through a small compliance c of their own: three points of a quadrature out
//! of fixed bodies and of the boundary itself, and the centroids of four or sixteen equal parts out of tools, which are
//! slender relative to large faces.
//!
//! ```text
//! g = n · u + o + c λ,   λ ≥ 0, g ≥ 0, λ g = 0
//! ```
//!
//! The half-space is fixed in the step, or moves with another place of the boundary ([`super::touching`]): then u is the
//! displacement of the point less that of the place, on which −λ acts.
//!
//! A point in contact that sticks keeps its anchor a, through the same compliance; an anchor on a tool moves with the tool.
//! The force τ along the surface stays within the cone, and the anchor follows a point that slides:
//!
//! ```text
//! e · (u − a) + c τ = 0,   |τ| ≤ μ λ
//! ```
//!
//! A contact that is smaller than a face is not resolved. A new contact has friction from the next step on.

use palpate_geometry::TetrahedronMesh;

use super::boundary::{for_each_part, shape_on_face};
use super::constraints::Turned;
use super::law::Moduli;
use super::model::NonlinearModel;
use super::state::NonlinearState;
use crate::Vec3;
use crate::finite_elements::solid::Face;

/// Contacts of a step, at most.
pub const MAX_CONTACTS: usize = 192;

/// Points of a face in barycentric coordinates: one of these, and two of the other [-].
const NEAR: f64 = 2.0 / 3.0;
const FAR: f64 = 1.0 / 6.0;
pub(super) const AT: [[f64; 3]; 3] = [[NEAR, FAR, FAR], [FAR, NEAR, FAR], [FAR, FAR, NEAR]];

/// c times the area over 1/E, in lengths of an edge [-]: under a pressure of a tenth of E a point is that part of a tenth of an edge deep.
const SOFTNESS: f64 = 0.005;

/// Directions of a contact with friction.
pub(super) const ROWS: usize = 3;

/// Nodes of a point or a place of a face, and of both.
pub(super) const NODES: usize = 6;
const MAX_NODES: usize = 2 * NODES;
const NOWHERE: u32 = u32::MAX;

/// Points of a face that may touch tools: a few, then more in their place where a tool is slender.
pub const TOOL_POINTS: [usize; 2] = [4, 16];

/// A point of the boundary that may touch bodies.
#[derive(Debug, Clone)]
pub struct BoundaryPoint {
    /// With their weights [-].
    pub(super) nodes: [(u32, f64); NODES],
    /// Its position at rest [m].
    pub place: Vec3,
    /// c [m/N].
    pub(super) compliance: f64,
}

/// The body that a point of the boundary touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Against {
    /// A fixed body.
    Fixed,
    /// A tool, where it is at the end of the step.
    Tool {
        /// Its number.
        number: usize,
        /// Motion of the tool behind the half-space in the step [m].
        motion: Vec3,
    },
    /// Another place of the boundary, which takes the opposite force: nodes with their weights [-].
    Boundary([(u32, f64); NODES]),
}

/// A half-space that a point of the boundary stays out of during a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnilateralContact {
    /// Number in [`NonlinearModel::boundary_points`]; against a tool, in [`NonlinearModel::tool_points`].
    pub point: u32,
    /// Outward normal of the half-space [-].
    pub normal: Vec3,
    /// Distance of the point at rest from the half-space [m]; negative inside.
    pub offset: f64,
    /// Coulomb's coefficient μ [-].
    pub friction: f64,
    /// The body behind the half-space.
    pub against: Against,
}

impl UnilateralContact {
    /// Its slot in a state: contacts with fixed bodies, with the boundary itself, then with each tool.
    pub(super) fn slot(&self, model: &NonlinearModel) -> usize {
        let points = model.boundary_points().len();
        let first = match self.against {
            Against::Fixed => 0,
            Against::Boundary(_) => points,
            Against::Tool { number, .. } => 2 * points + number * model.tool_points().len(),
        };
        first + self.point as usize
    }
}

/// Friction state (history) of a point of the boundary.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct FrictionState {
    /// Force along the surface, on the body [N].
    pub(super) force: Vec3,
    /// The displacement of the point at which there would be none [m]; against a place of the boundary, less the
    /// displacement itself.
    pub(super) anchor: Vec3,
    pub(super) slides: bool,
}

impl BoundaryPoint {
    /// Points of a quadrature, which may touch fixed bodies and the boundary itself.
    pub(super) fn of_quadrature(
        mesh: &TetrahedronMesh,
        faces: &[Face],
        moduli: &[Moduli<f64>],
        edge: f64,
    ) -> Vec<Self> {
        Self::all(mesh, faces, moduli, edge, &[AT.to_vec()])
    }

    /// Both [`TOOL_POINTS`] of each face, one face after the other, which may touch tools.
    pub(super) fn for_tools(
        mesh: &TetrahedronMesh,
        faces: &[Face],
        moduli: &[Moduli<f64>],
        edge: f64,
    ) -> Vec<Self> {
        let parts = TOOL_POINTS.map(|count| {
            let mut parts = Vec::with_capacity(count);
            for_each_part(count.isqrt(), |part| parts.push(part));
            parts
        });
        Self::all(mesh, faces, moduli, edge, &parts)
    }

    /// Those of each face at barycentric coordinates [-]: each of `sets` shares the area equally.
    fn all(
        mesh: &TetrahedronMesh,
        faces: &[Face],
        moduli: &[Moduli<f64>],
        edge: f64,
        sets: &[Vec<[f64; 3]>],
    ) -> Vec<Self> {
        let mut points = Vec::new();
        for face in faces {
            let [a, b, c] = face.corners.map(|node| mesh.vertices()[node.index()]);
            let area = 0.5 * (b - a).cross(&(c - a)).norm();
            let Moduli { c10, c01, .. } = moduli[face.tetrahedron];
            let stiffness = 6.0 * (c10 + c01) * area / (SOFTNESS * edge);
            let each = sets
                .iter()
                .flat_map(|set| set.iter().map(|at| (*at, set.len() as f64)));
            for ([u, v, w], count) in each {
                let weights = shape_on_face([u, v, w]);
                points.push(Self {
                    nodes: std::array::from_fn(|k| (face.nodes[k] as u32, weights[k])),
                    place: a * u + b * v + c * w,
                    compliance: count / stiffness,
                });
            }
        }
        points
    }

    /// Its displacement [m] at these `displacements` of the nodes [m].
    pub fn displacement(&self, displacements: &[f64]) -> Vec3 {
        mean(&self.nodes, displacements)
    }
}

/// The weighted sum of the `values` of some nodes.
fn mean(nodes: &[(u32, f64)], values: &[f64]) -> Vec3 {
    let each = nodes.iter().map(|&(node, weight)| {
        let value = &values[3 * node as usize..][..3];
        weight * Vec3::new(value[0], value[1], value[2])
    });
    each.sum()
}

/// The contacts of a step.
#[derive(Debug, Clone)]
pub(super) struct Contacts {
    /// Those along the normals, then those along the surface, in pairs.
    pub(super) listed: Vec<Contact>,
    pub(super) frictional: Vec<FrictionalContact>,
    /// The nodes of the points, and the place of each node among them.
    nodes: Vec<u32>,
    places: Vec<u32>,
    /// Displacement of each of `nodes` by a unit force on each of `listed` [m/N].
    columns: Vec<[f32; 3]>,
}

/// A contact with friction, as its two directions along the surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct FrictionalContact {
    /// Numbers in the list of the contact along the normal, and of the first of the two along the surface.
    pub(super) normal: usize,
    pub(super) along: usize,
    /// μ [-].
    pub(super) friction: f64,
}

/// One of them, with the force λ along `normal`: that of the half-space, or a direction along it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contact {
    /// Its slot in a state.
    pub(super) slot: usize,
    /// c [m/N].
    pub(super) compliance: f64,
    nodes: [(u32, f64); MAX_NODES],
    /// Whether the half-space goes with a place of the boundary, whose nodes are the second half.
    pub(super) is_between: bool,
    pub(super) normal: Vec3,
    offset: f64,
    /// Motion of the anchor in the step [m]: with a tool.
    motion: Vec3,
}

impl Contact {
    fn new(model: &NonlinearModel, contact: &UnilateralContact) -> Self {
        let points = match contact.against {
            Against::Fixed | Against::Boundary(_) => model.boundary_points(),
            Against::Tool { .. } => model.tool_points(),
        };
        let point = &points[contact.point as usize];
        let mut nodes = [(0, 0.0); MAX_NODES];
        nodes[..NODES].copy_from_slice(&point.nodes);
        if let Against::Boundary(opposite) = contact.against {
            for (own, (node, weight)) in nodes[NODES..].iter_mut().zip(opposite) {
                *own = (node, -weight);
            }
        }
        Self {
            slot: contact.slot(model),
            compliance: point.compliance,
            nodes,
            is_between: matches!(contact.against, Against::Boundary(_)),
            normal: contact.normal,
            offset: contact.offset,
            motion: match contact.against {
                Against::Tool { motion, .. } => motion,
                Against::Fixed | Against::Boundary(_) => Vec3::zeros(),
            },
        }
    }

    /// With their weights [-].
    pub(super) fn nodes(&self) -> &[(u32, f64)] {
        let count = if self.is_between { MAX_NODES } else { NODES };
        &self.nodes[..count]
    }

    /// Along the normal, of `values` on all nodes.
    pub(super) fn along(&self, values: &[f32]) -> f64 {
        let along = self.nodes().iter().map(|&(node, weight)| {
            let value = &values[3 * node as usize..][..3];
            let along = value.iter().zip(self.normal.iter());
            weight * along.map(|(u, n)| f64::from(*u) * n).sum::<f64>()
        });
        along.sum()
    }

    /// n · u + o where the nodes have the `displacements` [m].
    pub(super) fn gap(&self, displacements: &[f64]) -> f64 {
        self.offset + self.normal.dot(&self.displacement(displacements))
    }

    /// Displacement of the point [m]; against a place of the boundary, relative to that.
    pub(super) fn displacement(&self, displacements: &[f64]) -> Vec3 {
        mean(self.nodes(), displacements)
    }

    /// The displacement without friction at the point [m].
    pub(super) fn anchor(&self, state: &NonlinearState) -> Vec3 {
        let known = state.friction_state_at(self.slot).anchor;
        match self.is_between {
            true => self.displacement(&state.displacements) + known,
            false => known + self.motion,
        }
    }

    /// Adds a `force` [N] on the body to the forces on all nodes.
    pub(super) fn add(&self, force: f64, forces: &mut [f32]) {
        for &(node, weight) in self.nodes() {
            let own = &mut forces[3 * node as usize..][..3];
            for (own, n) in own.iter_mut().zip(self.normal.iter()) {
                *own += (force * weight * n) as f32;
            }
        }
    }
}

/// Two directions at right angles to a `normal` and to one another.
fn tangents(normal: &Vec3) -> [Vec3; 2] {
    let mut axis = Vec3::zeros();
    axis[normal.iamin()] = 1.0;
    let first = normal.cross(&axis).normalize();
    [first, normal.cross(&first)]
}

impl Contacts {
    pub(super) fn new(nodes: usize) -> Self {
        Self {
            listed: Vec::with_capacity(ROWS * MAX_CONTACTS),
            frictional: Vec::with_capacity(MAX_CONTACTS),
            nodes: Vec::with_capacity(MAX_NODES * MAX_CONTACTS),
            places: vec![NOWHERE; nodes],
            columns: Vec::with_capacity(MAX_NODES * MAX_CONTACTS * ROWS * MAX_CONTACTS),
        }
    }

    /// How many of `listed` are along the normals.
    pub(super) fn normals(&self) -> usize {
        self.listed.len() - 2 * self.frictional.len()
    }

    /// Lists the `contacts`, the first [`MAX_CONTACTS`] of them, and finds what a force on each moves.
    pub(super) fn prepare(
        &mut self,
        body: Turned<'_>,
        contacts: &[UnilateralContact],
        state: &NonlinearState,
    ) {
        let Turned { model, rotations } = body;
        self.listed.clear();
        self.frictional.clear();
        let contacts = &contacts[..contacts.len().min(MAX_CONTACTS)];
        let listed = contacts.iter().map(|contact| Contact::new(model, contact));
        self.listed.extend(listed);
        for (normal, contact) in contacts.iter().enumerate() {
            let own = self.listed[normal];
            let is_active = state.pressed_at(own.slot) > 0.0;
            if is_active && contact.friction > 0.0 {
                let along = self.listed.len();
                let anchor = own.anchor(state);
                let [first, second] = tangents(&contact.normal);
                for direction in [first, second] {
                    self.listed.push(Contact {
                        normal: direction,
                        offset: -direction.dot(&anchor),
                        ..own
                    });
                }
                self.frictional.push(FrictionalContact {
                    normal,
                    along,
                    friction: contact.friction,
                });
            }
        }
        for node in self.nodes.drain(..) {
            self.places[node as usize] = NOWHERE;
        }
        for &(node, _) in self.listed.iter().flat_map(Contact::nodes) {
            let place = &mut self.places[node as usize];
            if *place == NOWHERE {
                *place = self.nodes.len() as u32;
                self.nodes.push(node);
            }
        }
        self.displace(model, rotations);
    }

    /// Q_a Σ_b w_b K⁻¹_ab Q_bᵀ n.
    fn displace(&mut self, model: &NonlinearModel, rotations: &[[f32; 9]]) {
        self.columns.clear();
        for own in &self.listed {
            let first = self.columns.len();
            self.columns.resize(first + self.nodes.len(), [0.0; 3]);
            let columns = &mut self.columns[first..];
            for &(node, weight) in own.nodes() {
                let Some(influence) = model.influence(node) else {
                    continue;
                };
                let q = &rotations[node as usize];
                let f: [f32; 3] = std::array::from_fn(|i| {
                    let along = (0..3).map(|k| f64::from(q[3 * i + k]) * own.normal[k]);
                    (weight * along.sum::<f64>()) as f32
                });
                let [x, y, z] = influence.columns();
                for (column, &there) in columns.iter_mut().zip(&self.nodes) {
                    let first = 3 * there as usize;
                    for (i, u) in column.iter_mut().enumerate() {
                        let at = first + i;
                        *u += x[at] * f[0] + y[at] * f[1] + z[at] * f[2];
                    }
                }
            }
            for (column, &there) in columns.iter_mut().zip(&self.nodes) {
                let q = &rotations[there as usize];
                let [x, y, z] = *column;
                *column = std::array::from_fn(|i| q[i] * x + q[3 + i] * y + q[6 + i] * z);
            }
        }
    }

    /// How far a unit force on contact `from` moves contact `to` along its normal, by the factors at rest [m/N].
    pub(super) fn shared(&self, to: usize, from: usize) -> f64 {
        let columns = &self.columns[from * self.nodes.len()..];
        let own = &self.listed[to];
        let along = own.nodes().iter().map(|&(node, weight)| {
            let column = &columns[self.places[node as usize] as usize];
            let along = column.iter().zip(own.normal.iter());
            weight * along.map(|(u, n)| f64::from(*u) * n).sum::<f64>()
        });
        along.sum()
    }
}
