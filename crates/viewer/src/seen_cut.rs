//! A cut as it is seen: the surface with its openings, the walls of the slits, and the layer below.
//!
//! Openings are holes in the outer surface. Below them lies the inner layer: the uncut surface within
//! [`AROUND`] of a slit, moved inward along its normals by the thickness of what was cut. From each open
//! edge a wall goes down to it, in which muscle fibres run along the organ above and around it below
//! (section 7.1). Triangles are made when the cut has changed, places with every picture.
//!
//! *How we know*: `golden::a_cut_looks_as_it_did`, `agreement::a_slit_shows_what_is_under_it`.
//!
//! *Limits*: the inner layer is not moved by the opening, and on a wall thinner than two layers it is the
//! outer side's alone; a slit wider than twice [`AROUND`] shows its end.

use std::collections::VecDeque;

use nalgebra::Vector3;
use palpate_geometry::{AabbTree, NodeId, Origin, Surface, TriangleId, Vec3};
use palpate_simulate::interactive::OpenedSnapshot;

use crate::Gpu;
use crate::render::{Body, Fibres, Tint};

/// The inner layer is there within this distance of a slit, in thicknesses of the layer above [-].
const AROUND: f64 = 6.0;

/// Rows of a wall from the rim down.
const ROWS: usize = 3;

/// The wall ends this much below the inner layer [-].
const BELOW: f32 = 1.15;

/// How open the rim and the foot of a wall are to light from all sides [-].
const OPEN: (f32, f32) = (1.0, 0.35);

/// How open the inner layer is [-].
const UNDER: f32 = 0.8;

/// A cut organ on the adapter.
pub(crate) struct SeenCut {
    version: u64,
    /// Thickness of what is cut [m].
    thickness: f32,
    /// Around the uncut surface at rest.
    tree: AabbTree,
    /// Where each vertex was before any cut.
    origins: Vec<Origin>,
    outer: Body,
    wall: Body,
    inner: Body,
    /// The vertices of the uncut surface that the inner layer has, the number there of each vertex, and its
    /// triangles.
    inner_nodes: Vec<NodeId>,
    number: Vec<Option<NodeId>>,
    inner_triangles: Vec<[NodeId; 3]>,
    /// The vertices of the cut surface that a wall hangs from.
    wall_nodes: Vec<NodeId>,
    /// Unit normals of the uncut surface as it is now, per vertex of the inner layer [-].
    normals: Vec<Vector3<f32>>,
    /// Scratch.
    below: Vec<[f32; 3]>,
}

impl SeenCut {
    /// A surface that is not cut yet, of which a layer of `thickness` [m] will be.
    pub(crate) fn new(gpu: &Gpu, surface: &Surface, thickness: f64, tint: Tint) -> Self {
        let fibres = Fibres::along(surface.mesh());
        Self {
            version: 0,
            thickness: thickness as f32,
            tree: AabbTree::new(surface.mesh()),
            origins: Vec::new(),
            outer: Body::empty(gpu, tint),
            wall: Body::empty(gpu, Tint::MUSCLE_CUT).with_fibres(fibres),
            inner: Body::empty(gpu, Tint::MUCOSA),
            inner_nodes: Vec::new(),
            number: Vec::new(),
            inner_triangles: Vec::new(),
            wall_nodes: Vec::new(),
            below: Vec::new(),
            normals: Vec::new(),
        }
    }

    /// What is drawn.
    pub(crate) fn bodies(&self) -> [&Body; 3] {
        [&self.outer, &self.wall, &self.inner]
    }

    /// Takes over `opening`, with the uncut surface's vertices at `moved` [m]; `open` is how open each of
    /// them is to light from all sides [-].
    pub(crate) fn follow(
        &mut self,
        gpu: &Gpu,
        opening: &OpenedSnapshot,
        (surface, moved): (&Surface, &[[f32; 3]]),
        open: &[f32],
    ) {
        if self.version != opening.version {
            self.version = opening.version;
            self.make(gpu, opening, surface, open);
        }
        self.outer.deform(gpu, &opening.places);
        self.deform_inner(gpu, moved);
        self.deform_wall(gpu, opening, surface);
    }

    fn make(&mut self, gpu: &Gpu, opening: &OpenedSnapshot, surface: &Surface, open: &[f32]) {
        let rest: Vec<Vec3> = opening.rest.iter().map(double).collect();
        let triangles = numbered(&opening.triangles);
        self.origins.clear();
        for place in &rest {
            let nearest = self.tree.nearest(surface.mesh(), place);
            self.origins.push(Origin {
                triangle: nearest.triangle,
                barycentric: nearest.on.barycentric,
            });
        }
        let mixed: Vec<f32> = self
            .origins
            .iter()
            .map(|origin| {
                let corners = surface.mesh().corners(origin.triangle);
                let parts = corners.iter().zip(origin.barycentric);
                parts
                    .map(|(node, part)| open[node.index()] * part as f32)
                    .sum()
            })
            .collect();
        self.outer.replace(gpu, (&rest, &triangles), &mixed);
        self.make_wall(gpu, opening, &rest);
        self.make_inner(gpu, surface);
    }

    /// A column of vertices below each vertex of a rim.
    fn make_wall(&mut self, gpu: &Gpu, opening: &OpenedSnapshot, rest: &[Vec3]) {
        let rims: Vec<[NodeId; 2]> = numbered(&opening.rims);
        self.wall_nodes.clear();
        self.wall_nodes.extend(rims.iter().flatten());
        self.wall_nodes.sort_unstable();
        self.wall_nodes.dedup();
        let (mut vertices, mut open) = (Vec::new(), Vec::new());
        for node in &self.wall_nodes {
            for row in 0..=ROWS {
                vertices.push(rest[node.index()]);
                open.push(OPEN.0 + (OPEN.1 - OPEN.0) * row as f32 / ROWS as f32);
            }
        }
        let column = |node: &NodeId| {
            let column = self.wall_nodes.binary_search(node);
            column.expect("each end of a rim has a column") * (ROWS + 1)
        };
        let mut triangles = Vec::with_capacity(2 * ROWS * rims.len());
        for [from, to] in &rims {
            let (from, to) = (column(from), column(to));
            for row in 0..ROWS {
                let [a, b] = [from + row, to + row].map(|k| NodeId(k as u32));
                let [c, d] = [a, b].map(|above| NodeId(above.0 + 1));
                // Seen from within the slit, which lies to the right of the edge.
                triangles.extend([[b, a, c], [b, c, d]]);
            }
        }
        self.wall.replace(gpu, (&vertices, &triangles), &open);
    }

    /// The triangles of the uncut surface around the slits.
    fn make_inner(&mut self, gpu: &Gpu, surface: &Surface) {
        let mesh = surface.mesh();
        let reach = AROUND * f64::from(self.thickness);
        self.number.clear();
        self.number.resize(mesh.vertices().len(), None);
        self.inner_nodes.clear();
        self.inner_triangles.clear();
        for triangle in triangles_near(surface, self.starts(), reach) {
            let corners = mesh.corners(triangle).map(|node| {
                *self.number[node.index()].get_or_insert_with(|| {
                    self.inner_nodes.push(node);
                    NodeId(self.inner_nodes.len() as u32 - 1)
                })
            });
            self.inner_triangles.push(corners);
        }
        let nodes = self.inner_nodes.iter();
        let rest: Vec<Vec3> = nodes.map(|node| mesh.vertices()[node.index()]).collect();
        let open = vec![UNDER; rest.len()];
        self.inner
            .replace(gpu, (&rest, &self.inner_triangles), &open);
    }

    /// The triangles of the uncut surface that a rim passes through.
    fn starts(&self) -> impl Iterator<Item = TriangleId> {
        let on_rim = |node: &NodeId| self.origins[node.index()].triangle;
        self.wall_nodes.iter().map(on_rim)
    }

    fn deform_inner(&mut self, gpu: &Gpu, moved: &[[f32; 3]]) {
        let at = |node: NodeId| Vector3::from(moved[self.inner_nodes[node.index()].index()]);
        self.normals.clear();
        self.normals
            .resize(self.inner_nodes.len(), Vector3::zeros());
        for corners in &self.inner_triangles {
            let [a, b, c] = corners.map(at);
            let normal = (b - a).cross(&(c - a));
            for corner in corners {
                self.normals[corner.index()] += normal;
            }
        }
        self.below.clear();
        for (node, normal) in self.inner_nodes.iter().zip(&mut self.normals) {
            *normal = normal.try_normalize(0.0).unwrap_or_else(Vector3::z);
            let place = Vector3::from(moved[node.index()]) - self.thickness * *normal;
            self.below.push(place.into());
        }
        self.inner.deform(gpu, &self.below);
    }

    /// Walls go down along the normals of the uncut surface: slivers beside a cut have normals of their own.
    fn deform_wall(&mut self, gpu: &Gpu, opening: &OpenedSnapshot, surface: &Surface) {
        self.below.clear();
        for node in &self.wall_nodes {
            let origin = &self.origins[node.index()];
            let corners = surface.mesh().corners(origin.triangle);
            let mut normal = Vector3::zeros();
            for (corner, part) in corners.iter().zip(origin.barycentric) {
                let own = self.number[corner.index()].map(|own| self.normals[own.index()]);
                normal += own.unwrap_or_default() * part as f32;
            }
            let normal = normal.try_normalize(0.0).unwrap_or_else(Vector3::z);
            let place = Vector3::from(opening.places[node.index()]);
            for row in 0..=ROWS {
                let depth = BELOW * self.thickness * row as f32 / ROWS as f32;
                self.below.push((place - depth * normal).into());
            }
        }
        self.wall.deform(gpu, &self.below);
    }
}

/// The triangles of `surface` that are reached from those of `starts` within `reach` [m] of them.
fn triangles_near(
    surface: &Surface,
    starts: impl Iterator<Item = TriangleId>,
    reach: f64,
) -> Vec<TriangleId> {
    let mesh = surface.mesh();
    let middle = |triangle| mesh.positions(triangle).iter().sum::<Vec3>() / 3.0;
    let mut from = vec![None; mesh.triangles().len()];
    let mut waiting = VecDeque::new();
    for start in starts {
        if from[start.index()].is_none() {
            from[start.index()] = Some(middle(start));
            waiting.push_back(start);
        }
    }
    let mut found = Vec::new();
    while let Some(triangle) = waiting.pop_front() {
        found.push(triangle);
        let source = from[triangle.index()];
        for next in surface.adjacency().across(triangle).into_iter().flatten() {
            let near = source.is_some_and(|source| (middle(next) - source).norm() < reach);
            if near && from[next.index()].is_none() {
                from[next.index()] = source;
                waiting.push_back(next);
            }
        }
    }
    found
}

fn numbered<const N: usize>(corners: &[[u32; N]]) -> Vec<[NodeId; N]> {
    corners.iter().map(|corners| corners.map(NodeId)).collect()
}

fn double(place: &[f32; 3]) -> Vec3 {
    Vec3::from(place.map(f64::from))
}
