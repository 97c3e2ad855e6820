//! Self-contact of the boundary of a body: between its pieces, and between folds of a piece.
//!
//! Faces are taken as smooth: the middle of each edge lies off it at rest, by an eighth of the change of the normals along
//! the edge, and goes and turns with the body. So the surface is quadratic, and its normals are means over the faces
//! around each node, quadratic between nodes. Edges that are sharp at rest stay so.
//!
//! Of two pieces, the points of the finer one stay out of the other; a piece that touches itself has both sides stay out
//! of one another. Of the sides of a slit, whose faces lie on each other at rest, the points of one stay out of the other.
//!
//! The walls of cavities belong to the boundary.
//!
//! A place does not touch the body around it at rest: neither what lies behind the surface there and nearer
//! than [`APART`], nor what is nearer than that along the surface. It does touch what faces it across a gap.

use std::collections::HashMap;

use palpate_geometry::{NodeId, SHARP_EDGE, TetrahedronMesh, TriangleMesh};

use super::boundary::shape_on_face;
use super::contact::{AT, NODES};
use super::model::{NonlinearModel, nodes};
use super::state::NonlinearState;
use super::touching_search::TouchingSearch;
use crate::finite_elements::Mismatch;
use crate::finite_elements::solid::{Face, faces};
use crate::{Error, Vec3};

/// Nearer than so many mean edges at rest, a piece does not touch itself, but across a gap [-].
const APART: f64 = 2.0;

/// Cosine of the angle between the line of two places and their normals, below which they do not face each other at rest [-].
const FACES: f64 = 0.5;

/// Cosine of the angle between two sides of a slit at rest, above which they do not touch [-].
const SIDES: f64 = -0.5;

/// Part of the change of the normals along an edge by which its middle lies off it [-].
const BULGE: f64 = 0.125;

/// Triangles that a face is searched as, each of three of its nodes.
pub(super) const PARTS: usize = 4;
pub(super) const PART_NODES: [[usize; 3]; PARTS] = [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]];

/// Barycentric coordinates of its nodes.
pub(super) const NODE_PLACES: [[f64; 3]; NODES] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.5, 0.5, 0.0],
    [0.0, 0.5, 0.5],
    [0.5, 0.0, 0.5],
];

/// The node between the ends of the edge opposite to each corner.
const OPPOSITE: [usize; 3] = [4, 5, 3];

pub(super) const NOWHERE: u32 = u32::MAX;

/// The boundary of a body as it touches itself.
#[derive(Debug, Clone)]
pub struct TouchingBoundary {
    /// Those of the body.
    pub(super) nodes: Vec<u32>,
    /// Offset of each from its edge at rest [m]; zero at corners.
    pub(super) bulges: Vec<Vec3>,
    /// At rest, as triangles.
    pub(super) rest: TriangleMesh,
    pub(super) faces: Vec<TouchingFace>,
    /// The number of each face among all of the body's boundary.
    numbers: Vec<u32>,
    /// Faces around a node of a face, with the node's number there and the weights of their normals
    /// [-].
    pub(super) around: Vec<(u32, u8, f64)>,
    pub(super) pieces: usize,
    /// μ of each pair of pieces [-]; none where they do not touch.
    friction: Vec<Option<f64>>,
    /// μ between the sides of slits [-], if they touch.
    in_slits: Option<f64>,
    /// How deep each point of the boundary may lie in the boundary: as deep as at rest, as a negative distance [m].
    pub(super) allowed: Vec<f64>,
    /// Mean length of its edges [m], of all and of each piece.
    pub(super) edge: f64,
    edges: Vec<f64>,
    parts: Vec<Part>,
    /// Outward normal of each point at rest, and where it is.
    points: Vec<(Vec3, Vec3)>,
}

#[derive(Debug, Clone)]
pub(super) struct TouchingFace {
    /// Their places in the list of nodes.
    pub(super) nodes: [u32; NODES],
    pub(super) piece: usize,
    /// Of a side of a slit.
    side: Option<Side>,
    /// For each node, which part of `around` is around it.
    pub(super) around: [[u32; 2]; NODES],
    /// Face beyond the edge opposite to each corner, where the edge is smooth.
    pub(super) across: [u32; 3],
}

/// The sides of a slit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    /// Its points stay out of the other.
    Points,
    Surface,
}

/// A triangle of a face at rest.
#[derive(Debug, Clone)]
struct Part {
    middle: Vec3,
    normal: Vec3,
}

impl TouchingBoundary {
    /// That of `model`, whose tetrahedra belong to these `pieces`, which share no nodes. `friction` gives the coefficient
    /// with which two pieces, or one with itself, touch [-], and none where they do not; `in_slits` that of the sides of
    /// slits. It has the faces that may touch, and is none where there is no such face.
    ///
    /// # Errors
    /// When there is not one piece for each tetrahedron.
    pub fn new(
        model: &NonlinearModel,
        pieces: &[u32],
        friction: impl Fn(usize, usize) -> Option<f64>,
        in_slits: Option<f64>,
    ) -> Result<Option<Self>, Error> {
        let mesh = model.mesh();
        if pieces.len() != mesh.tetrahedra().len() {
            return Err(Mismatch::WrongLength {
                what: "the list of the elements' pieces",
                found: pieces.len(),
                expected: mesh.tetrahedra().len(),
            }
            .into());
        }
        let count = pieces.iter().max().map_or(0, |most| *most as usize + 1);
        let pairs = (0..count * count).map(|pair| friction(pair % count, pair / count));
        let friction: Vec<Option<f64>> = pairs.collect();
        let all = faces(mesh);
        let piece_of = |face: &Face| pieces[face.tetrahedron] as usize;
        let sides = match in_slits {
            Some(_) => sides(mesh, &all, piece_of),
            None => vec![None; all.len()],
        };
        let may_touch = |number: &usize| {
            let own = piece_of(&all[*number]) * count;
            sides[*number].is_some() || friction[own..own + count].iter().any(Option::is_some)
        };
        let selected: Vec<usize> = (0..all.len()).filter(may_touch).collect();
        if selected.is_empty() {
            return Ok(None);
        }
        let list: Vec<Face> = selected.iter().map(|number| all[*number]).collect();
        let nodes = nodes(&list);
        let number = |node: usize| nodes.binary_search(&(node as u32)).unwrap_or(0);
        let numbers: Vec<[usize; NODES]> = list.iter().map(|face| face.nodes.map(number)).collect();
        let flat: Vec<Vec3> = list.iter().map(|face| flat_normal(mesh, face)).collect();
        let mut owners = vec![Vec::new(); nodes.len()];
        for (face, own) in numbers.iter().enumerate() {
            for (place, &node) in own.iter().enumerate() {
                owners[node].push((face, place));
            }
        }
        let mut around = Vec::new();
        let smooth = numbers.iter().enumerate().map(|(face, own)| {
            let is_smooth = |other: &usize| flat[face].dot(&flat[*other]) >= SHARP_EDGE;
            let lists = own.map(|node| {
                let first = around.len() as u32;
                let neighbours = owners[node].iter().filter(|(other, _)| is_smooth(other));
                around.extend(neighbours.map(|&(other, place)| {
                    let weight = angle(mesh, &list[other], place);
                    (other as u32, place as u8, weight)
                }));
                [first, around.len() as u32]
            });
            let beyond = OPPOSITE.map(|middle| {
                let mut others = owners[own[middle]].iter().map(|&(other, _)| other);
                let other = others.find(|other| *other != face && is_smooth(other));
                other.map_or(NOWHERE, |other| other as u32)
            });
            TouchingFace {
                nodes: own.map(|node| node as u32),
                piece: piece_of(&list[face]),
                side: sides[selected[face]],
                around: lists,
                across: beyond,
            }
        });
        let faces: Vec<TouchingFace> = smooth.collect();
        let mut places: Vec<Vec3> = nodes
            .iter()
            .map(|&node| model.nodes()[node as usize])
            .collect();
        let bulges = bulges(&faces, &around, &flat, &places);
        for (place, bulge) in places.iter_mut().zip(&bulges) {
            *place += bulge;
        }
        let parts = faces.iter().flat_map(|face| {
            PART_NODES.map(|part| part.map(|k| palpate_geometry::NodeId(face.nodes[k])))
        });
        let rest = TriangleMesh::new(places, parts.collect()).map_err(|_| Error::NoElements)?;
        let (mut edges, mut each) = (vec![0.0; count], vec![0_u32; count]);
        for (face, own) in list.iter().zip(&faces) {
            let [a, b, c] = face.corners.map(|node| mesh.vertices()[node.index()]);
            edges[own.piece] += (b - a).norm() + (c - b).norm() + (a - c).norm();
            each[own.piece] += 3;
        }
        let edge = edges.iter().sum::<f64>() / (3 * list.len()) as f64;
        for (sum, number) in edges.iter_mut().zip(each) {
            *sum /= f64::from(number.max(1));
        }
        let mut boundary = Self {
            edge,
            edges,
            parts: rest
                .triangle_ids()
                .map(|part| Part {
                    middle: rest.positions(part).iter().sum::<Vec3>() / 3.0,
                    normal: rest.area_vector(part).normalize(),
                })
                .collect(),
            points: Vec::new(),
            allowed: vec![0.0; POINTS * list.len()],
            numbers: selected.iter().map(|number| *number as u32).collect(),
            friction,
            in_slits,
            pieces: count,
            nodes,
            bulges,
            rest,
            faces,
            around,
        };
        let points = (0..POINTS * list.len()).map(|point| {
            let own = &model.boundary_points()[boundary.point(point)];
            (flat[point / POINTS], own.place)
        });
        boundary.points = points.collect();
        boundary.find_overlaps(model);
        Ok(Some(boundary))
    }

    /// Whether one of its points that touches a face does so across a slit.
    pub(super) fn is_in_slit(&self, point: usize, face: usize) -> bool {
        self.faces[point / POINTS].side.is_some() && self.faces[face].side.is_some()
    }

    /// The number of one of its points among those of the model's boundary.
    pub(super) fn point(&self, own: usize) -> usize {
        POINTS * self.numbers[own / POINTS] as usize + own % POINTS
    }

    /// Whether a face of one piece may touch the other.
    pub(super) fn touches(&self, own: usize, other: usize) -> bool {
        let in_slits = self.in_slits.filter(|_| own == other);
        self.friction[own * self.pieces + other]
            .or(in_slits)
            .is_some()
    }

    /// Where it overlaps at rest it may stay so.
    fn find_overlaps(&mut self, model: &NonlinearModel) {
        let rest = NonlinearState::at_rest(model, 0);
        let mut allowed = vec![0.0_f64; self.allowed.len()];
        TouchingSearch::new(self).find_all(self, model, &rest, |found| {
            allowed[found.point] = found.distance.min(0.0);
        });
        self.allowed = allowed;
    }

    /// Whether a point of the boundary may touch a triangle of a face, and with what friction [-].
    pub(super) fn pair(&self, point: usize, part: usize) -> Option<f64> {
        let (own, other) = (&self.faces[point / POINTS], &self.faces[part / PARTS]);
        let shares = || own.nodes.iter().any(|node| other.nodes.contains(node));
        if let (Some(side), Some(_)) = (own.side, other.side) {
            let across = self.points[point].0.dot(&self.parts[part].normal) < SIDES;
            let meets = own.piece == other.piece && across && side == Side::Points && !shares();
            return self.in_slits.filter(|_| meets);
        }
        let friction = self.friction[own.piece * self.pieces + other.piece]?;
        if own.piece != other.piece {
            let [fine, coarse] = [own.piece, other.piece].map(|piece| (self.edges[piece], piece));
            return (fine < coarse).then_some(friction);
        }
        let (normal, place) = &self.points[point];
        let Part {
            middle,
            normal: opposite,
        } = &self.parts[part];
        let apart = middle - place;
        let distance = apart.norm();
        if distance > APART * self.edge {
            return Some(friction);
        }
        let facing = normal.dot(&apart).min(-opposite.dot(&apart));
        (facing > FACES * distance && !shares()).then_some(friction)
    }
}

/// Points of the boundary on each face.
pub(super) const POINTS: usize = AT.len();

/// Which faces lie on others of their piece at rest: those of slits.
fn sides(
    mesh: &TetrahedronMesh,
    faces: &[Face],
    piece_of: impl Fn(&Face) -> usize,
) -> Vec<Option<Side>> {
    let key = |corners: &[NodeId; 3]| {
        let mut places = corners.map(|node| {
            // Zero has two signs.
            let place = mesh.vertices()[node.index()].map(|x| (x + 0.0).to_bits());
            [place.x, place.y, place.z]
        });
        places.sort_unstable();
        places
    };
    let mut sides = vec![None; faces.len()];
    let mut first = HashMap::with_capacity(faces.len());
    for (number, face) in faces.iter().enumerate() {
        if let Some(other) = first.insert((piece_of(face), key(&face.corners)), number) {
            sides[other] = Some(Side::Points);
            sides[number] = Some(Side::Surface);
        }
    }
    sides
}

fn flat_normal(mesh: &TetrahedronMesh, face: &Face) -> Vec3 {
    let [a, b, c] = face.corners.map(|node| mesh.vertices()[node.index()]);
    (b - a).cross(&(c - a)).normalize()
}

/// Angle of a face at one of its nodes [rad].
fn angle(mesh: &TetrahedronMesh, face: &Face, node: usize) -> f64 {
    if node >= 3 {
        return std::f64::consts::PI;
    }
    let place = |k: usize| mesh.vertices()[face.corners[k % 3].index()];
    let here = place(node);
    (place(node + 1) - here).angle(&(place(node + 2) - here))
}

/// Offsets of the middles of edges from them.
fn bulges(
    faces: &[TouchingFace],
    around: &[(u32, u8, f64)],
    flat: &[Vec3],
    places: &[Vec3],
) -> Vec<Vec3> {
    let normal = |face: &TouchingFace, node: usize| -> Vec3 {
        let [from, to] = face.around[node].map(|at| at as usize);
        let each = around[from..to].iter();
        let sum: Vec3 = each
            .map(|&(other, _, weight)| weight * flat[other as usize])
            .sum();
        sum.normalize()
    };
    let mut bulges = vec![Vec3::zeros(); places.len()];
    for face in faces {
        for (corner, &middle) in OPPOSITE.iter().enumerate() {
            if face.across[corner] == NOWHERE {
                continue;
            }
            let [from, to] = [(corner + 1) % 3, (corner + 2) % 3];
            let along = places[face.nodes[to] as usize] - places[face.nodes[from] as usize];
            let turn = normal(face, to) - normal(face, from);
            // Half from the face on either side.
            let height = 0.5 * BULGE * turn.dot(&along);
            bulges[face.nodes[middle] as usize] += height * normal(face, middle);
        }
    }
    bulges
}

/// A place on the six nodes of a face: the weights, and how they change with the first two barycentric coordinates.
pub(super) fn slopes_on_face([u, v, w]: [f64; 3]) -> [[f64; NODES]; 2] {
    [
        [
            4.0 * u - 1.0,
            0.0,
            1.0 - 4.0 * w,
            4.0 * v,
            -4.0 * v,
            4.0 * (w - u),
        ],
        [
            0.0,
            4.0 * v - 1.0,
            1.0 - 4.0 * w,
            4.0 * u,
            4.0 * (w - v),
            -4.0 * u,
        ],
    ]
}

/// The weighted sum over the nodes of a face.
pub(super) fn on_face(values: &[Vec3; NODES], weights: &[f64; NODES]) -> Vec3 {
    values
        .iter()
        .zip(weights)
        .map(|(value, weight)| value * *weight)
        .sum()
}

/// Shape functions at a point of the boundary, by its number.
pub(super) fn shape_at_point(point: usize) -> [f64; NODES] {
    shape_on_face(AT[point % POINTS])
}
