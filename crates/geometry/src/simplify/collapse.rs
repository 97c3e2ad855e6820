use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;
use std::ops::ControlFlow;

use super::SimplifySettings;
use super::guard::{Demands, Guard, NewTriangle, double_area};
use super::net::Net;
use super::quadric::Quadric;
use crate::{SHARP_EDGE, Vec3};

/// Weight of the planes that stand on borders and sharp edges relative to the surface [-].
const EDGE_WEIGHT: f64 = 5.0;

/// Demands on a collapse, and the cost factor of the next, weaker ones [-]. Self-intersection is
/// the last resort.
const DEMANDS: [(Demands, f64); 4] = [
    (demands(0.5, 0.7, true), 100.0),
    (demands(0.3, 0.5, true), 100.0),
    (demands(0.0, 0.2, true), 1e15),
    (demands(0.0, 0.2, false), f64::INFINITY),
];

const fn demands(shape: f64, turn: f64, apart: bool) -> Demands {
    Demands { shape, turn, apart }
}

/// Edges that are looked at between two calls of `progress`.
const BETWEEN_CALLS: usize = 1000;

/// Collapses edges, cheapest first, until no more triangles are left than asked for or nothing can
/// go; the sooner the larger the `sizes` at their ends, if there are some. Returns which vertices stand on borders and
/// sharp edges. `progress` receives the fraction of the surplus triangles removed [-], and may
/// cancel.
pub(super) fn collapse(
    net: &mut Net,
    settings: &SimplifySettings,
    sizes: Option<&[f64]>,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> ControlFlow<(), Vec<bool>> {
    let mut run = Run::new(net, settings);
    if let Some(sizes) = sizes {
        run.weights = sizes.iter().map(|size| size.powi(-4)).collect();
    }
    run.all(settings.triangles, progress)?;
    ControlFlow::Continue(run.on_crease)
}

/// The same for a part of a mesh, of which no vertex leaves the space between two corners [m]; nothing passes through
/// something, whatever is left.
pub(super) fn collapse_within(net: &mut Net, settings: &SimplifySettings, space: [Vec3; 2]) {
    let mut run = Run::new(net, settings);
    run.space = Some(space);
    // Nobody cancels it.
    let _ = run.all(settings.triangles, &mut |_| ControlFlow::Continue(()));
}

struct Run<'a> {
    net: &'a mut Net,
    guard: Guard,
    /// Where quadrics are measured from, for the sake of their digits [m].
    origin: Vec3,
    quadrics: Vec<Quadric>,
    /// Area of the original that a vertex stands for [m²].
    areas: Vec<f64>,
    /// Weight of a cost at a vertex [-]: costs are the fourth powers of lengths.
    weights: Vec<f64>,
    /// On a border or a sharp edge.
    on_crease: Vec<bool>,
    /// Raised whenever a vertex or its surroundings change.
    ages: Vec<u32>,
    /// Whether a triangle at a vertex has changed since the edges were queued last.
    changed: Vec<bool>,
    has_border: bool,
    queue: BinaryHeap<Reverse<Candidate>>,
    evenness: f64,
    /// The box that bounds moving vertices, by two corners [m].
    space: Option<[Vec3; 2]>,
}

/// An edge that may be collapsed. The queue has millions of them, so it is small.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    /// Squared distance over an area, and what unevenness adds [m⁴].
    cost: f64,
    edge: [u32; 2],
    age: u32,
    /// Which of the demands it meets, as far as is known.
    rank: u8,
}

impl<'a> Run<'a> {
    fn new(net: &'a mut Net, settings: &SimplifySettings) -> Self {
        let vertices = net.positions.len();
        let mut run = Self {
            guard: Guard::new(net),
            origin: net.positions[net.corners(0)[0] as usize],
            quadrics: vec![Quadric::zero(); vertices],
            areas: vec![0.0; vertices],
            weights: vec![1.0; vertices],
            on_crease: net.on_border.clone(),
            ages: vec![0; vertices],
            changed: vec![false; vertices],
            has_border: net.on_border.contains(&true),
            queue: BinaryHeap::new(),
            evenness: settings.evenness,
            space: None,
            net,
        };
        run.add_faces();
        run.add_creases();
        run
    }

    /// The planes of the triangles.
    fn add_faces(&mut self) {
        for triangle in self.net.triangles() {
            let corners = self.net.placed(triangle);
            let double = double_area(&corners);
            let area = 0.5 * double.norm();
            let Some(normal) = double.try_normalize(0.0) else {
                continue;
            };
            let plane = Quadric::of_plane(&(corners[0] - self.origin), &normal, area / 3.0);
            for v in self.net.corners(triangle) {
                self.quadrics[v as usize] = self.quadrics[v as usize].plus(&plane);
                self.areas[v as usize] += area / 3.0;
            }
        }
    }

    /// Planes that stand upright on the triangles at borders and sharp edges.
    fn add_creases(&mut self) {
        for [a, b] in self.net.edges() {
            let adjacent: Vec<u32> = self.net.at_edge(a, b).collect();
            let normals = adjacent.iter().map(|&t| double_area(&self.net.placed(t)));
            let normals: Vec<_> = normals.filter_map(|n| n.try_normalize(0.0)).collect();
            if let [one, other] = normals[..]
                && one.dot(&other) > SHARP_EDGE
            {
                continue;
            }
            let start = self.net.positions[a as usize] - self.origin;
            let along = self.net.positions[b as usize] - self.origin - start;
            for normal in normals {
                let Some(upright) = along.cross(&normal).try_normalize(0.0) else {
                    continue;
                };
                let weight = EDGE_WEIGHT * along.norm_squared();
                let plane = Quadric::of_plane(&start, &upright, weight);
                for v in [a, b] {
                    self.quadrics[v as usize] = self.quadrics[v as usize].plus(&plane);
                    self.on_crease[v as usize] = true;
                }
            }
        }
    }

    /// Collapses until `target` triangles are left or nothing can go.
    fn all(
        &mut self,
        target: usize,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let first = self.net.live();
        let mut report = |live: usize| progress((first - live) as f64 / (first - target) as f64);
        self.queue_all();
        loop {
            let before = self.net.live();
            self.work(target, &mut report)?;
            if self.net.live() <= target || self.net.live() == before {
                return ControlFlow::Continue(());
            }
            // A collapse makes others possible that were refused before.
            self.queue_changed();
        }
    }

    fn queue_all(&mut self) {
        let edges = self.net.edges();
        let all = edges.into_iter().map(|edge| Reverse(self.candidate(edge)));
        self.queue = all.collect();
    }

    /// Queues the edges of which something changed. What refuses an edge in the end, with all demands but the least
    /// given up, are the triangles at its ends and how many there are at their common neighbours; as long as these are
    /// what they were, the edge would be refused again.
    fn queue_changed(&mut self) {
        let net = &*self.net;
        let near = net.triangles().filter(|&triangle| {
            let corners = net.corners(triangle);
            corners.iter().any(|&v| self.changed[v as usize])
        });
        let sides = near.flat_map(|triangle| {
            let [a, b, c] = net.corners(triangle);
            [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)])
        });
        let mut edges: Vec<_> = sides.collect();
        edges.sort_unstable();
        edges.dedup();
        self.changed.fill(false);
        let all = edges.into_iter().map(|edge| Reverse(self.candidate(edge)));
        self.queue = all.collect();
    }

    fn candidate(&self, edge: [u32; 2]) -> Candidate {
        Candidate {
            cost: self.best(edge).0,
            edge,
            age: self.age(edge),
            rank: 0,
        }
    }

    fn age(&self, edge: [u32; 2]) -> u32 {
        let [a, b] = edge.map(|v| self.ages[v as usize]);
        a + b
    }

    /// The least cost of collapsing an edge [m⁴], and the position [m] that has it.
    fn best(&self, edge: [u32; 2]) -> (f64, Vec3) {
        let [a, b] = edge.map(|v| v as usize);
        let [start, end] = [a, b].map(|v| self.net.positions[v] - self.origin);
        let quadric = self.quadrics[a].plus(&self.quadrics[b]);
        let least = quadric.least_near(&(0.5 * (start + end)));
        let cheapest = |one: Vec3, other: Vec3| {
            if quadric.at(&one) < quadric.at(&other) {
                one
            } else {
                other
            }
        };
        let at = match (self.on_crease[a], self.on_crease[b]) {
            (true, false) => start,
            (false, true) => end,
            (false, false) => least,
            // A corner is where it is, to the last digit.
            (true, true) => cheapest(start, cheapest(end, least)),
        };
        let uneven = (self.areas[a] + self.areas[b]) * (end - start).norm_squared();
        let weight = self.weights[a].max(self.weights[b]);
        let cost = (quadric.at(&at) + self.evenness * uneven) * weight;
        (cost, at + self.origin)
    }

    fn work(
        &mut self,
        target: usize,
        report: &mut dyn FnMut(usize) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut looked_at = 0;
        while self.net.live() > target
            && let Some(Reverse(candidate)) = self.queue.pop()
        {
            if looked_at % BETWEEN_CALLS == 0 {
                report(self.net.live())?;
            }
            looked_at += 1;
            let [a, b] = candidate.edge;
            if candidate.age != self.age(candidate.edge) || !self.net.can_collapse(a, b) {
                continue;
            }
            let position = self.best(candidate.edge).1;
            let (demands, dearer) = self.demands()[usize::from(candidate.rank)];
            let too_many = self.net.live() == target + 1 && self.takes_one_too_many(&candidate);
            if !too_many && self.is_admitted(candidate.edge, &position, demands) {
                self.collapse(candidate.edge, position);
            } else if usize::from(candidate.rank) + 1 < self.demands().len() {
                self.queue.push(Reverse(Candidate {
                    cost: dearer * candidate.cost,
                    rank: candidate.rank + 1,
                    ..candidate
                }));
            }
        }
        ControlFlow::Continue(())
    }

    /// Where one triangle shall go, two would: while there are borders, one of theirs can go alone.
    fn takes_one_too_many(&self, candidate: &Candidate) -> bool {
        let [a, b] = candidate.edge;
        usize::from(candidate.rank) + 1 < self.demands().len()
            && self.net.at_edge(a, b).count() == 2
            && self.has_border
    }

    /// In a part of a mesh nothing passes through something.
    fn demands(&self) -> &'static [(Demands, f64)] {
        match self.space {
            Some(_) => &DEMANDS[..DEMANDS.len() - 1],
            None => &DEMANDS,
        }
    }

    fn is_admitted(&mut self, edge: [u32; 2], position: &Vec3, demands: Demands) -> bool {
        if let Some([low, high]) = &self.space
            && !(0..3).all(|k| low[k] < position[k] && position[k] < high[k])
        {
            return false;
        }
        let [a, b] = edge;
        let ours = self.net.around(a).iter();
        let theirs = self.net.around(b).iter();
        let theirs = theirs.filter(|&&t| !self.net.corners(t).contains(&a));
        let old: Vec<u32> = ours.chain(theirs).copied().collect();
        let left = old.iter().filter(|&&t| {
            let corners = self.net.corners(t);
            !(corners.contains(&a) && corners.contains(&b))
        });
        let new: Vec<NewTriangle> = left.map(|&t| self.moved(t, edge, position)).collect();
        // The last piece of something that branches must not vanish.
        !new.is_empty() && self.guard.admits(self.net, &old, &new, demands)
    }

    /// A triangle at one end of the edge after the collapse.
    fn moved(&self, triangle: u32, edge: [u32; 2], position: &Vec3) -> NewTriangle {
        let nodes = self.net.corners(triangle);
        let before = self.net.placed(triangle);
        let is_end = nodes.map(|v| edge.contains(&v));
        let pick = |k: usize| {
            if is_end[k] { *position } else { before[k] }
        };
        let name = |k: usize| {
            if is_end[k] { edge[0] } else { nodes[k] }
        };
        NewTriangle {
            nodes: [0, 1, 2].map(name),
            corners: [0, 1, 2].map(pick),
            before: double_area(&before),
        }
    }

    fn collapse(&mut self, edge: [u32; 2], position: Vec3) {
        let [kept, gone] = edge;
        let [a, b] = edge.map(|v| v as usize);
        self.net.collapse(kept, gone, position);
        self.quadrics[a] = self.quadrics[a].plus(&self.quadrics[b]);
        self.areas[a] += self.areas[b];
        self.weights[a] = self.weights[a].max(self.weights[b]);
        self.on_crease[a] |= self.on_crease[b];
        // A removed one must never look current again.
        self.ages[b] = u32::MAX / 2;
        for &triangle in self.net.around(kept) {
            self.guard.note(triangle, &self.net.placed(triangle));
        }
        self.guard.coarsen_grid(self.net);
        let ring = self.net.neighbors(kept);
        self.ages[a] += 1;
        self.changed[a] = true;
        for &v in &ring {
            self.changed[v as usize] = true;
            let edge = [kept.min(v), kept.max(v)];
            self.queue.push(Reverse(self.candidate(edge)));
        }
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_cost = self.cost.total_cmp(&other.cost);
        by_cost.then(self.edge.cmp(&other.edge))
    }
}
