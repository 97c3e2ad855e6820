use std::collections::VecDeque;

use palpate_geometry::{CutSurface, NodeId, Vec3};

/// Passes that spread an opening over the neighbouring triangles.
const PASSES: usize = 100;

/// Display displacement of each vertex of `cut` when it gapes up to `width` [m]: a slit is widest in its middle, like
/// an ellipse. Its surroundings move along, less and less up to the width of the slit away: each vertex as the mean of
/// its neighbours, so that no triangle folds over.
pub fn gape(cut: &CutSurface, width: f64) -> Vec<Vec3> {
    let mut gape = Gape::default();
    gape.follow(cut, width);
    gape.displacements
}

/// The same with its buffers, which are reused in the next step of a cut.
#[derive(Debug, Clone, Default)]
pub(super) struct Gape {
    /// Displacement of each vertex [m].
    displacements: Vec<Vec3>,
    /// The ends of the open edges.
    rims: Vec<[NodeId; 2]>,
    /// The vertices of these, ascending.
    on_rim: Vec<NodeId>,
    /// Distance along the rim to the nearest end of a slit [m]; infinite off the rims and on loops.
    from_end: Vec<f64>,
    /// The neighbours of all vertices, one vertex after the other, and where each vertex's begin.
    around: Vec<NodeId>,
    begins: Vec<usize>,
    /// The vertex of a rim from which each vertex was reached.
    source: Vec<Option<NodeId>>,
    waiting: VecDeque<NodeId>,
    /// Vertices near a rim that are on none.
    free: Vec<NodeId>,
}

impl Gape {
    /// Buffers for a surface of this number of vertices and triangles.
    pub(super) fn with_capacity(vertices: usize, triangles: usize) -> Self {
        Self {
            displacements: Vec::with_capacity(vertices),
            rims: Vec::with_capacity(triangles),
            on_rim: Vec::with_capacity(2 * triangles),
            from_end: Vec::with_capacity(vertices),
            around: Vec::with_capacity(6 * triangles),
            begins: Vec::with_capacity(vertices + 1),
            source: Vec::with_capacity(vertices),
            waiting: VecDeque::with_capacity(vertices),
            free: Vec::with_capacity(vertices),
        }
    }

    /// Resets all displacements.
    pub(super) fn clear(&mut self) {
        self.displacements.clear();
    }

    /// Displacement of each vertex [m].
    pub(super) fn displacements(&self) -> &[Vec3] {
        &self.displacements
    }

    /// Updates to `cut`, which gapes up to `width` [m].
    pub(super) fn follow(&mut self, cut: &CutSurface, width: f64) {
        self.find_rims(cut);
        self.measure_rims(cut);
        let lengths = self.on_rim.iter().map(|node| self.from_end[node.index()]);
        let half = lengths.fold(0.0, f64::max).max(1e-12);
        self.displacements.clear();
        self.displacements
            .resize(cut.mesh().vertices().len(), Vec3::zeros());
        for node in &self.on_rim {
            let part = 1.0 - self.from_end[node.index()] / half;
            let open = (1.0 - part * part).max(0.0).sqrt();
            self.displacements[node.index()] = 0.5 * width * open * cut.opening(*node);
        }
        self.find_neighbours(cut);
        self.find_free(cut, 1.5 * width);
        for _ in 0..PASSES {
            for node in &self.free {
                let around = &self.around[self.begins[node.index()]..self.begins[node.index() + 1]];
                let sum: Vec3 = around
                    .iter()
                    .map(|other| self.displacements[other.index()])
                    .sum();
                self.displacements[node.index()] = sum / around.len() as f64;
            }
        }
    }

    fn find_rims(&mut self, cut: &CutSurface) {
        self.rims.clear();
        self.on_rim.clear();
        for triangle in cut.mesh().triangle_ids() {
            let corners = cut.mesh().corners(triangle);
            for (edge, side) in cut.sides(triangle).into_iter().enumerate() {
                if side.is_some() {
                    let ends = [corners[edge], corners[(edge + 1) % 3]];
                    self.rims.push(ends);
                    self.on_rim.extend(ends);
                }
            }
        }
        self.on_rim.sort_unstable();
        self.on_rim.dedup();
    }

    fn measure_rims(&mut self, cut: &CutSurface) {
        let vertices = cut.mesh().vertices();
        self.from_end.clear();
        self.from_end.resize(vertices.len(), f64::INFINITY);
        for node in &self.on_rim {
            if cut.opening(*node) == Vec3::zeros() {
                self.from_end[node.index()] = 0.0;
            }
        }
        // At most as many rounds as a rim is long; rims are short.
        for _ in 0..self.on_rim.len() {
            let mut changed = false;
            for [a, b] in &self.rims {
                let length = (vertices[a.index()] - vertices[b.index()]).norm();
                for (from, to) in [(a, b), (b, a)] {
                    let distance = self.from_end[from.index()] + length;
                    if distance < self.from_end[to.index()] {
                        self.from_end[to.index()] = distance;
                        changed = true;
                    }
                }
            }
            if !changed {
                break;
            }
        }
        // A loop without an end is fully open.
        let known = self.on_rim.iter().map(|node| self.from_end[node.index()]);
        let longest = known
            .filter(|distance| distance.is_finite())
            .fold(0.0, f64::max);
        for node in &self.on_rim {
            let distance = &mut self.from_end[node.index()];
            if distance.is_infinite() {
                *distance = longest.max(1e-9);
            }
        }
    }

    fn find_neighbours(&mut self, cut: &CutSurface) {
        let mesh = cut.mesh();
        let count = mesh.vertices().len();
        self.begins.clear();
        self.begins.resize(count + 1, 0);
        for corner in mesh.triangles().iter().flatten() {
            self.begins[corner.index() + 1] += 2;
        }
        for k in 0..count {
            self.begins[k + 1] += self.begins[k];
        }
        self.around.clear();
        self.around.resize(self.begins[count], NodeId(0));
        for corners in mesh.triangles() {
            for k in 0..3 {
                let next = &mut self.begins[corners[k].index()];
                self.around[*next] = corners[(k + 1) % 3];
                self.around[*next + 1] = corners[(k + 2) % 3];
                *next += 2;
            }
        }
        // Each one has reached the start of the next.
        self.begins.copy_within(0..count, 1);
        self.begins[0] = 0;
    }

    /// The vertices that are on no rim, within `reach` [m] of one.
    fn find_free(&mut self, cut: &CutSurface, reach: f64) {
        let vertices = cut.mesh().vertices();
        self.source.clear();
        self.source.resize(vertices.len(), None);
        self.waiting.clear();
        self.free.clear();
        for node in &self.on_rim {
            self.source[node.index()] = Some(*node);
            self.waiting.push_back(*node);
        }
        while let Some(node) = self.waiting.pop_front() {
            let Some(from) = self.source[node.index()] else {
                continue;
            };
            for next in &self.around[self.begins[node.index()]..self.begins[node.index() + 1]] {
                let near = (vertices[next.index()] - vertices[from.index()]).norm() < reach;
                if near && self.source[next.index()].is_none() {
                    self.source[next.index()] = Some(from);
                    self.free.push(*next);
                    self.waiting.push_back(*next);
                }
            }
        }
    }
}
