//! The boundary that tools can touch: around each of its corners a mean over the faces that meet there.
//!
//! A pressure that is linear between the corners of quadratic faces does not lock, which one at every node or at every point of
//! integration does. With N the linear shape function of a corner, its mean of f is ∫ N f dA / ∫ N dA over the faces at rest.

use std::collections::BTreeMap;

use super::super::cavity::{TRIANGLE, triangle_point};
use crate::Vec3;

/// Corners of a boundary of quadratic tetrahedra that tools can touch.
#[derive(Debug, Clone, Default)]
pub(in super::super) struct ContactSurface {
    pub(super) corners: Vec<ContactCorner>,
}

/// A corner of the boundary.
#[derive(Debug, Clone, Default)]
pub(super) struct ContactCorner {
    /// Its node.
    pub(super) node: u32,
    /// Nodes of the faces that meet there, ascending.
    pub(super) nodes: Vec<u32>,
    /// Points of these faces.
    pub(super) points: Vec<ContactPoint>,
    /// ∫ N dA [m²].
    pub(super) area: f64,
}

/// A point of integration on a face.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactPoint {
    /// Its weight in the mean of the corner [-].
    pub(super) weight: f64,
    /// The nodes of the face as places in [`ContactCorner::nodes`], and their shape functions [-].
    pub(super) nodes: [usize; 6],
    pub(super) shares: [f64; 6],
}

impl ContactSurface {
    /// The corners for which `can_touch` is true, of `faces`: three corners, then the middles of 01, 12, 20, at `nodes` [m].
    pub(in super::super) fn new(
        faces: impl Iterator<Item = [usize; 6]>,
        nodes: &[Vec3],
        can_touch: impl Fn(usize) -> bool,
    ) -> Self {
        let mut around: BTreeMap<usize, Vec<([usize; 6], usize)>> = BTreeMap::new();
        for face in faces {
            for corner in (0..3).filter(|&corner| can_touch(face[corner])) {
                around.entry(face[corner]).or_default().push((face, corner));
            }
        }
        let corners = around.into_iter();
        let corners = corners.map(|(node, faces)| ContactCorner::new(node, &faces, nodes));
        Self {
            corners: corners.collect(),
        }
    }

    /// Nodes whose displacements a contact at one corner couples.
    pub(in super::super) fn couplings(&self) -> impl Iterator<Item = &[u32]> {
        self.corners.iter().map(|corner| corner.nodes.as_slice())
    }

    /// The nodes of its corners, in the order of [`super::Contacts`].
    pub(in super::super) fn nodes(&self) -> impl Iterator<Item = usize> + '_ {
        self.corners.iter().map(|corner| corner.node as usize)
    }
}

impl ContactCorner {
    /// Of the faces around a node, each with the number of the corner that is there.
    fn new(node: usize, faces: &[([usize; 6], usize)], positions: &[Vec3]) -> Self {
        let mut nodes: Vec<u32> = faces
            .iter()
            .flat_map(|(face, _)| face.map(|n| n as u32))
            .collect();
        nodes.sort_unstable();
        nodes.dedup();
        let mut points = Vec::with_capacity(TRIANGLE.len() * faces.len());
        let mut area = 0.0;
        for (face, corner) in faces {
            let [a, b, c] = [face[0], face[1], face[2]].map(|n| positions[n]);
            let double = (b - a).cross(&(c - a)).norm();
            let places = face.map(|n| nodes.partition_point(|other| *other < n as u32));
            for ([x, y], weight) in TRIANGLE {
                let point = triangle_point(([x, y], weight));
                let weight = double * weight * [1.0 - x - y, x, y][*corner];
                area += weight;
                points.push(ContactPoint {
                    weight,
                    nodes: places,
                    shares: point.value,
                });
            }
        }
        for point in &mut points {
            point.weight /= area;
        }
        Self {
            node: node as u32,
            nodes,
            points,
            area,
        }
    }

    /// Positions of its nodes with these displacements [m].
    pub(super) fn places(&self, positions: &[Vec3], unknowns: &[f64]) -> Vec<Vec3> {
        let each = self.nodes.iter().map(|&node| {
            let moved = &unknowns[3 * node as usize..][..3];
            positions[node as usize] + Vec3::from_column_slice(moved)
        });
        each.collect()
    }
}

impl ContactPoint {
    /// Its position when the nodes of its corner are at these `places` [m].
    pub(super) fn position(&self, places: &[Vec3]) -> Vec3 {
        let each = self.nodes.iter().zip(self.shares);
        each.map(|(&node, share)| share * places[node]).sum()
    }

    /// The outward normal of its face [-], flat between the corners.
    pub(super) fn normal(&self, places: &[Vec3]) -> Vec3 {
        let [a, b, c] = [0, 1, 2].map(|corner| places[self.nodes[corner]]);
        let normal = (b - a).cross(&(c - a)).try_normalize(0.0);
        normal.unwrap_or_default()
    }
}
