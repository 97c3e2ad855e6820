//! The display mesh of a cut: the surface with its openings, the walls of the slits, and the layers below.
//!
//! Openings are holes in the outer surface. Below them lie the inner layers: each is the uncut surface within
//! [`AROUND`] of a slit, moved inward along its normals by the thickness of what lies above it. From each open
//! edge a wall goes down to the first of them. Openings of an inner layer are left out by the shader, where the
//! session's cuts go through that layer and nowhere else; below the innermost one lies the dark lumen.
//! Muscle fibres run along the organ in the outermost layer and around it in the next (section 7.1). Triangles are
//! made when the cut has changed, places with every picture.
//!
//! *How we know*: `golden::a_cut_looks_as_it_did`.
//!
//! Where the simulation knows what lies below the surface, as the nonlinear model does, inner layers and the feet of walls are there.
//!
//! *Limits*: elsewhere an inner layer is not moved by the opening, and on a wall thinner than two layers it is the
//! outer side's alone; a slit wider than twice [`AROUND`] shows its end. An opening of an inner layer has a cut
//! face of a constant width instead of a wall, and the last 128 straight parts of the cuts through it are drawn.

use std::collections::VecDeque;

use nalgebra::Vector3;
use palpate_geometry::{AabbTree, NodeId, Origin, Surface, TriangleId, Vec3};
use palpate_simulate::Simulation;
use palpate_simulate::interactive::{OpenedPart, OpenedSnapshot};

use crate::Gpu;
use crate::render::openings::{openings, punctures};
use crate::render::{Body, FibreRun, Fibres, Tint};

/// The inner layer is there within this distance of a slit, in thicknesses of the layer above [-].
const AROUND: f64 = 6.0;

/// Rows of a wall from the rim down.
const ROWS: usize = 3;

/// The wall ends this much below the inner layer [-].
const BELOW: f32 = 1.15;

/// How open the rim and the foot of a wall are to light from all sides [-].
const OPEN: (f32, f32) = (1.0, 0.35);

/// How open the inner layers are [-].
const UNDER: f32 = 0.8;

/// An opening of a layer is this part of that of the layer above wide, so that both are seen [-].
const NARROWER: f32 = 0.72;

/// Layers that cuts go through.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CutLayers {
    /// Depths of the lower faces, from outside [m].
    depths: Vec<f64>,
    /// Whether these are layers of an organ.
    is_layered: bool,
    /// How far a cut gapes [m].
    width: f64,
}

impl CutLayers {
    /// Those of `simulation`, or one of this `depth` and `width` [m] where nothing cuts.
    pub(crate) fn of(simulation: &Simulation, depth: f64, width: f64) -> Self {
        let mut depths = simulation.cut_depths();
        if depths.is_empty() {
            depths.push(depth);
        }
        Self {
            depths,
            is_layered: simulation.is_layered(),
            width: simulation.cut_width().unwrap_or(width),
        }
    }
}

/// A layer below the outermost, or the lumen.
struct InnerLayer {
    /// Thickness of what lies above it [m].
    depth: f32,
    body: Body,
}

/// A cut organ on the adapter.
pub(crate) struct DisplayedCut {
    version: u64,
    /// Thickness of the outermost layer [m].
    thickness: f32,
    /// Thickness of all that can be cut [m].
    deepest: f64,
    /// How far a cut gapes [m].
    width: f32,
    /// The openings of the layers that are drawn.
    parts: Vec<OpenedPart>,
    /// Around the uncut surface at rest.
    tree: AabbTree,
    /// Where each vertex was before any cut.
    origins: Vec<Origin>,
    outer: Body,
    wall: Body,
    inner: Vec<InnerLayer>,
    /// The vertices of the uncut surface that the inner layers have, the number there of each vertex, and its
    /// triangles.
    inner_nodes: Vec<NodeId>,
    number: Vec<Option<NodeId>>,
    inner_triangles: Vec<[NodeId; 3]>,
    /// The vertices of the cut surface that a wall hangs from.
    wall_nodes: Vec<NodeId>,
    /// Unit normals of the uncut surface as it is now, per vertex of the inner layers [-].
    normals: Vec<Vector3<f32>>,
    /// Where each vertex is among those below which more is known than the surface.
    known: Vec<Option<usize>>,
    /// Scratch.
    below: Vec<[f32; 3]>,
}

impl DisplayedCut {
    /// A surface that is not cut yet, of which `layers` will be.
    pub(crate) fn new(gpu: &Gpu, surface: &Surface, layers: &CutLayers, tint: Tint) -> Self {
        let fibres = Fibres::along(surface.mesh());
        let run = match layers.is_layered {
            true => FibreRun::Along,
            false => FibreRun::ByDepth,
        };
        Self {
            version: 0,
            thickness: layers.depths[0] as f32,
            deepest: layers.depths.iter().copied().fold(0.0, f64::max),
            width: layers.width as f32,
            parts: Vec::new(),
            tree: AabbTree::new(surface.mesh()),
            origins: Vec::new(),
            outer: Body::empty(gpu, tint),
            wall: Body::empty(gpu, Tint::MUSCLE_CUT).with_fibres(fibres.running(run)),
            inner: inner_layers(gpu, layers, fibres),
            inner_nodes: Vec::new(),
            number: Vec::new(),
            inner_triangles: Vec::new(),
            wall_nodes: Vec::new(),
            below: Vec::new(),
            known: Vec::new(),
            normals: Vec::new(),
        }
    }

    /// The bodies to draw.
    pub(crate) fn bodies(&self) -> impl Iterator<Item = &Body> {
        let inner = self.inner.iter().map(|layer| &layer.body);
        [&self.outer, &self.wall].into_iter().chain(inner)
    }

    /// Takes over `opening`, with the uncut surface's vertices at `moved` [m]; `open` is how open each of
    /// them is to light from all sides [-].
    pub(crate) fn follow(
        &mut self,
        gpu: &Gpu,
        opening: &OpenedSnapshot,
        surface: &Surface,
        moved: &[[f32; 3]],
        open: &[f32],
    ) {
        let is_other = self.parts != opening.parts;
        if is_other {
            self.parts.clone_from(&opening.parts);
            self.outer.open(punctures(&self.parts, self.width));
            let mut width = self.width;
            for (number, layer) in self.inner.iter_mut().enumerate() {
                width *= NARROWER;
                layer.body.open(openings(&self.parts, number + 1, width));
            }
        }
        if self.version != opening.version {
            self.version = opening.version;
            self.make(gpu, opening, surface, open);
        }
        self.outer.deform(gpu, &opening.places);
        self.find_known(opening);
        self.deform_inner(gpu, opening, moved);
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
        self.outer.replace(gpu, &rest, &triangles, &mixed);
        self.make_wall(gpu, opening, &rest);
        self.make_inner(gpu, opening, surface);
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
        self.wall.replace(gpu, &vertices, &triangles, &open);
    }

    /// The triangles of the uncut surface around the slits.
    fn make_inner(&mut self, gpu: &Gpu, opening: &OpenedSnapshot, surface: &Surface) {
        let mesh = surface.mesh();
        let reach = AROUND * self.deepest;
        self.number.clear();
        self.number.resize(mesh.vertices().len(), None);
        self.inner_nodes.clear();
        self.inner_triangles.clear();
        let starts: Vec<TriangleId> = self.starts(surface).collect();
        let piece = |node: NodeId| opening.detached.get(node.index());
        for triangle in triangles_near(surface, starts.into_iter(), reach) {
            let corners = mesh.corners(triangle);
            let [a, b, c] = corners.map(piece);
            if a != b || b != c {
                // It would join a detached piece to the rest.
                continue;
            }
            let corners = corners.map(|node| {
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
        for layer in &mut self.inner {
            layer.body.replace(gpu, &rest, &self.inner_triangles, &open);
        }
    }

    /// The triangles of the uncut surface that a rim passes through, or that are punctured.
    fn starts(&self, surface: &Surface) -> impl Iterator<Item = TriangleId> {
        let on_rim = |node: &NodeId| self.origins[node.index()].triangle;
        let begun = self.parts.iter().filter(|part| part.begins);
        let pierced = begun.map(|part| {
            let place = double(&part.ends[0]);
            self.tree.nearest(surface.mesh(), &place).triangle
        });
        self.wall_nodes.iter().map(on_rim).chain(pierced)
    }

    /// Finds the vertices below which more is known than the surface.
    fn find_known(&mut self, opening: &OpenedSnapshot) {
        self.known.clear();
        self.known.resize(opening.places.len(), None);
        for (place, &vertex) in opening.around.iter().enumerate() {
            // Of an opening that is gone since.
            if let Some(known) = self.known.get_mut(vertex as usize) {
                *known = Some(place);
            }
        }
    }

    fn deform_inner(&mut self, gpu: &Gpu, opening: &OpenedSnapshot, moved: &[[f32; 3]]) {
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
        for normal in &mut self.normals {
            *normal = normal.try_normalize(0.0).unwrap_or_else(Vector3::z);
        }
        let layers = opening.below.chunks(opening.around.len().max(1));
        let layers = layers.map(Some).chain(std::iter::repeat(None));
        for (layer, below) in self.inner.iter_mut().zip(layers) {
            self.below.clear();
            for (node, normal) in self.inner_nodes.iter().zip(&self.normals) {
                let known = self.known[node.index()].and_then(|known| below?.get(known));
                let inwards = || Vector3::from(moved[node.index()]) - layer.depth * *normal;
                self.below
                    .push(known.copied().unwrap_or_else(|| inwards().into()));
            }
            layer.body.deform(gpu, &self.below);
        }
    }

    /// Walls go down to what is known to lie below, or along the normals of the uncut surface: slivers beside a cut have normals of
    /// their own.
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
            // The outermost layer comes first.
            let known = self.known[node.index()].and_then(|known| opening.below.get(known));
            let down = match known {
                Some(foot) => Vector3::from(*foot) - place,
                None => -self.thickness * normal,
            };
            for row in 0..=ROWS {
                let part = BELOW * row as f32 / ROWS as f32;
                self.below.push((place + part * down).into());
            }
        }
        self.wall.deform(gpu, &self.below);
    }
}

/// Layers below the outermost one: the other layers, the innermost one as mucosa, and the lumen below them.
fn inner_layers(gpu: &Gpu, layers: &CutLayers, fibres: Fibres) -> Vec<InnerLayer> {
    let count = layers.depths.len();
    let depths = layers.depths.iter().enumerate();
    depths
        .map(|(above, depth)| {
            let body = match above + 2 {
                _ if !layers.is_layered => Body::empty(gpu, Tint::MUCOSA),
                number if number > count => Body::empty(gpu, Tint::LUMEN),
                number if number == count => Body::empty(gpu, Tint::MUCOSA),
                number => {
                    let run = match number % 2 {
                        0 => FibreRun::Around,
                        _ => FibreRun::Along,
                    };
                    Body::empty(gpu, Tint::MUSCLE_UNDER).with_fibres(fibres.running(run))
                }
            };
            InnerLayer {
                depth: *depth as f32,
                body,
            }
        })
        .collect()
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
