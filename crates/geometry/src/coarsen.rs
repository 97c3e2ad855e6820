//! Fewer tetrahedra in the same body: edges collapse, the shortest first, until few enough nodes of quadratic elements
//! are left.
//!
//! A collapse must preserve the topology of the body: the links of the two ends meet in the link of their edge alone [Dey,
//! Edelsbrunner, Guha and Nekhayev 1999], no tetrahedron becomes flat, and no face of the boundary turns far. A vertex of the
//! boundary moves to the minimum of the squared distances to the planes that it represents [Garland and Heckbert 1997]. These
//! are the planes of the filled surface (`planes`), not of the filling, which cuts off sharp edges: so these are restored. In
//! the end the boundary moves along its normals to correct the volume that flat faces between few vertices lack or add.
//!
//! A wall needs no more than one element through its thickness, which no lattice gives ([`fill`](crate::fill)).
//!
//! *How we know*: `coarsen::…`.
//!
//! *Limits*: the number of nodes is a goal: where no edge may collapse, more are left.

mod net;
mod planes;

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::ControlFlow;

use self::net::Net;
use crate::memoized::Memoized;
use crate::mesh::tetrahedra::six_fold_volume;
use crate::{Surface, TetrahedronError, TetrahedronMesh, Vec3};

/// Volume over that of a regular tetrahedron with the same mean square edge [-]: none below this is made, unless an
/// adjacent one is worse.
const FLATTEST: f64 = 0.2;

/// Cosine of the angle by which a face of the boundary may turn at once [-].
const MAX_TURNED: f64 = 0.5;

/// Weight of a distance from the planes of the boundary relative to the same length of an edge [-].
const OFF_SURFACE: f64 = 5.0;

/// How often the vertices of the boundary go to their planes, before and after the collapses.
const SNAPS: usize = 3;

/// Stale entries are removed from the queue when it is so many times as long as after the last removal [-].
const STALE: usize = 2;

/// Nodes that are removed between two reports of progress.
const REPORTED: usize = 1_000;

/// Moves of the boundary; each reduces the error of the volume a hundred times.
const INFLATIONS: usize = 4;

/// A filling `mesh` of `surface` with about as many nodes of quadratic elements as `nodes`, its vertices and edges, and the volume
/// of the surface; where `detail` [-] at a place [m] is above one, its edges are shorter and its boundary is closer to the surface,
/// both by this factor.
///
/// # Errors
/// When the result is no mesh, which does not happen to a valid one.
pub fn coarsen(
    mesh: &TetrahedronMesh,
    surface: &Surface,
    nodes: usize,
    detail: impl Fn(&Vec3) -> f64,
) -> Result<TetrahedronMesh, TetrahedronError> {
    coarsen_with_progress(mesh, surface, nodes, detail, &mut |_| {
        ControlFlow::Continue(())
    })
}

/// The same. `progress` receives the fraction of the surplus nodes removed [-], and may cancel.
///
/// # Errors
/// As [`coarsen`], and when the work is cancelled.
pub fn coarsen_with_progress(
    mesh: &TetrahedronMesh,
    surface: &Surface,
    nodes: usize,
    detail: impl Fn(&Vec3) -> f64,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<TetrahedronMesh, TetrahedronError> {
    let mut net = Net::new(mesh, surface);
    for _ in 0..SNAPS {
        net.snap();
    }
    let detail = Memoized::new(detail);
    let collapsed = net.collapse_until(nodes, &|place| detail.at(place), progress);
    if collapsed.is_break() {
        return Err(TetrahedronError::Cancelled);
    }
    for _ in 0..SNAPS {
        net.snap();
    }
    for _ in 0..INFLATIONS {
        net.inflate(surface.mesh().volume());
    }
    net.into_mesh()
}

/// An edge in the queue: the square of its length with what else counts [m²], its ends and their versions.
type Entry = Reverse<(ordered::Length, [u32; 2], [u32; 2])>;

mod ordered {
    /// A finite number in its order.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub(super) struct Length(pub(super) f64);

    impl Eq for Length {}

    impl PartialOrd for Length {
        fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
            Some(self.cmp(other))
        }
    }

    impl Ord for Length {
        fn cmp(&self, other: &Self) -> std::cmp::Ordering {
            self.0.total_cmp(&other.0)
        }
    }
}

impl Net {
    fn collapse_until(
        &mut self,
        nodes: usize,
        detail: &dyn Fn(&Vec3) -> f64,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut queue = BinaryHeap::new();
        for vertex in 0..self.vertices.len() as u32 {
            let neighbours = self.neighbours(vertex).into_iter();
            queue.extend(
                neighbours
                    .filter(|&other| other > vertex)
                    .map(|other| self.entry([vertex, other], detail)),
            );
        }
        let mut most = STALE * queue.len();
        let begun = self.left.nodes();
        let mut reported = begun;
        while self.left.nodes() > nodes {
            if queue.len() > most {
                queue.retain(|Reverse((_, edge, versions))| self.versions_of(*edge) == *versions);
                most = STALE * queue.len();
            }
            if reported - self.left.nodes() >= REPORTED {
                reported = self.left.nodes();
                progress((begun - reported) as f64 / (begun - nodes) as f64)?;
            }
            let Some(Reverse((cost, edge, versions))) = queue.pop() else {
                break;
            };
            if self.versions_of(edge) != versions || !self.keeps_topology(edge) {
                continue;
            }
            let mut places = self.places(edge).into_iter();
            let Some(place) = places.find(|place| self.is_sound(edge, place)) else {
                continue;
            };
            let real = ordered::Length(self.cost(edge, &place, detail));
            if real > cost {
                // Its ends cannot go where they should: others come first.
                queue.push(Reverse((real, edge, versions)));
                continue;
            }
            self.collapse(edge, &place);
            let around = self.neighbours(edge[0]);
            for &other in &around {
                // Edges that could not collapse may now.
                self.versions[other as usize] += 1;
            }
            for vertex in around {
                let neighbours = self.neighbours(vertex).into_iter();
                queue.extend(neighbours.map(|other| self.entry([vertex, other], detail)));
            }
        }
        ControlFlow::Continue(())
    }

    fn entry(&self, edge: [u32; 2], detail: &dyn Fn(&Vec3) -> f64) -> Entry {
        let cost = self.cost(edge, &self.places(edge)[0], detail);
        Reverse((ordered::Length(cost), edge, self.versions_of(edge)))
    }

    fn versions_of(&self, edge: [u32; 2]) -> [u32; 2] {
        edge.map(|end| self.versions[end as usize])
    }

    /// Cost of a collapse of `edge` to `place` [m²].
    fn cost(&self, edge: [u32; 2], place: &Vec3, detail: &dyn Fn(&Vec3) -> f64) -> f64 {
        let [a, b] = edge.map(|end| end as usize);
        let [from, to] = [self.vertices[a], self.vertices[b]];
        let off = match self.is_boundary[a] && self.is_boundary[b] {
            true => self.off_surface(edge, place),
            false => 0.0,
        };
        let squared = (from - to).norm_squared() + OFF_SURFACE.powi(2) * off;
        squared * detail(&(0.5 * (from + to))).powi(2)
    }

    /// By how much the mean square of the distances to the planes that both ends stand for grows [m²].
    fn off_surface(&self, edge: [u32; 2], place: &Vec3) -> f64 {
        let [a, b] = edge.map(|end| end as usize);
        let now = edge.map(|end| self.quadrics[end as usize].at(&self.vertices[end as usize]));
        let then = self.quadrics[a].plus(&self.quadrics[b]).at(place);
        (then - now[0] - now[1]) / (self.areas[a] + self.areas[b])
    }

    /// Candidate places for the collapse of an edge, the best first.
    fn places(&self, edge: [u32; 2]) -> [Vec3; 3] {
        let [a, b] = edge.map(|end| end as usize);
        let [from, to] = [self.vertices[a], self.vertices[b]];
        let middle = 0.5 * (from + to);
        match [self.is_boundary[a], self.is_boundary[b]] {
            [true, false] => [from; 3],
            [false, true] => [to; 3],
            [false, false] => [middle, from, to],
            [true, true] => {
                let best = self.quadrics[a].plus(&self.quadrics[b]).least_near(&middle);
                [best, from, to]
            }
        }
    }

    /// Collapses `edge` into its first end, at `place`.
    fn collapse(&mut self, edge: [u32; 2], place: &Vec3) {
        let [a, b] = edge;
        self.vertices[a as usize] = *place;
        let gone: Vec<u32> = self.around[b as usize].clone();
        for t in gone {
            let nodes = self.tetrahedra[t as usize];
            if nodes.contains(&a) {
                for node in nodes {
                    self.around[node as usize].retain(|&other| other != t);
                }
                self.left.tetrahedra -= 1;
            } else {
                self.tetrahedra[t as usize] = nodes.map(|node| if node == b { a } else { node });
                self.around[a as usize].push(t);
            }
        }
        self.around[b as usize].clear();
        let [a, b] = edge.map(|end| end as usize);
        self.left.vertices -= 1;
        if self.is_boundary[a] && self.is_boundary[b] {
            self.left.boundary -= 1;
        }
        self.is_boundary[a] |= self.is_boundary[b];
        self.quadrics[a] = self.quadrics[a].plus(&self.quadrics[b]);
        self.areas[a] += self.areas[b];
        for end in [a, b] {
            self.versions[end] += 1;
        }
    }

    /// Whether the tetrahedra and the boundary around `edge` are well shaped when its ends are at `place`: both ends may be
    /// the same vertex.
    fn is_sound(&self, [a, b]: [u32; 2], place: &Vec3) -> bool {
        let is_gone = |nodes: &[u32]| a != b && nodes.contains(&a) && nodes.contains(&b);
        let now = |node: u32| self.vertices[node as usize];
        let then = |node: u32| {
            if node == a || node == b {
                *place
            } else {
                now(node)
            }
        };
        let (mut before, mut after) = (f64::INFINITY, f64::INFINITY);
        let around = [a, b].map(|end| self.around[end as usize].iter());
        for &t in around.into_iter().flatten() {
            let nodes = self.tetrahedra[t as usize];
            before = before.min(shape(&nodes.map(now)));
            if !is_gone(&nodes) {
                after = after.min(shape(&nodes.map(then)));
            }
        }
        if after < FLATTEST.min(before) {
            return false;
        }
        let faces = [a, b].map(|end| {
            let faces = self.boundary_at(end).into_iter();
            faces.map(move |[x, y]| [end, x, y])
        });
        faces
            .into_iter()
            .flatten()
            .filter(|face| !is_gone(face))
            .all(|face| {
                let normal = |[x, y, z]: [Vec3; 3]| (y - x).cross(&(z - x));
                let (old, new) = (normal(face.map(now)), normal(face.map(then)));
                old.dot(&new) > MAX_TURNED * old.norm() * new.norm()
            })
    }

    /// Moves each vertex of the boundary to the planes that it stands for, as far as the tetrahedra around it stay sound.
    fn snap(&mut self) {
        for vertex in 0..self.vertices.len() as u32 {
            let own = vertex as usize;
            if !self.is_boundary[own] || self.around[own].is_empty() {
                continue;
            }
            let before = self.vertices[own];
            let best = self.quadrics[own].least_near(&before);
            let parts = [1.0, 0.5, 0.25].map(|part| before + part * (best - before));
            let sound = parts
                .into_iter()
                .find(|place| self.is_sound([vertex; 2], place));
            if let Some(place) = sound {
                self.vertices[own] = place;
            }
        }
    }

    /// Moves the boundary outward, or inward, for the body to have the `volume` [m³].
    fn inflate(&mut self, volume: f64) {
        let mut normals = vec![Vec3::zeros(); self.vertices.len()];
        let (mut area, mut own) = (0.0, 0.0);
        for face in self.boundary() {
            let [a, b, c] = face.map(|node| self.vertices[node as usize]);
            let normal = 0.5 * (b - a).cross(&(c - a));
            area += normal.norm();
            own += a.dot(&normal) / 3.0;
            for node in face {
                normals[node as usize] += normal;
            }
        }
        let by = (volume - own) / area;
        for (vertex, normal) in normals.iter().enumerate() {
            let Some(outward) = normal.try_normalize(0.0) else {
                continue;
            };
            let before = self.vertices[vertex];
            self.vertices[vertex] += by * outward;
            let around = self.around[vertex].iter();
            let flat = around.map(|&t| {
                shape(&self.tetrahedra[t as usize].map(|node| self.vertices[node as usize]))
            });
            if flat.fold(f64::INFINITY, f64::min) < 0.5 * FLATTEST {
                self.vertices[vertex] = before;
            }
        }
    }
}

/// Volume over that of a regular tetrahedron with the same mean square edge [-].
fn shape(corners: &[Vec3; 4]) -> f64 {
    let [a, b, c, d] = corners;
    let edges = [b - a, c - a, d - a, c - b, d - b, d - c];
    let square = edges.iter().map(Vec3::norm_squared).sum::<f64>() / 6.0;
    std::f64::consts::SQRT_2 * six_fold_volume(corners) / square.powf(1.5)
}
