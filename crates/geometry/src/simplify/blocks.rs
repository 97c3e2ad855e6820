//! Large meshes are first simplified in blocks: on all cores, and each in memory that is near.
//!
//! Planes divide space into boxes with about as many vertices each. Only a vertex all of whose triangles have their
//! corners in one box is free, and it stays in that box. Boxes are convex, so that triangles of different ones stay apart;
//! those that reach from one into another do not change.

use std::ops::ControlFlow;

use super::SimplifySettings;
use super::collapse::collapse_within;
use super::net::Net;
use crate::{NodeId, TriangleId, TriangleMesh, Vec3, collect_on_all_cores, cores};

/// Triangles of a block, about: what is known of them fits into the cache of a core.
const BLOCK: usize = 60_000;
/// How many times more triangles are left than are asked for [-], so that the end, which sees all of them, decides where
/// they are.
const LEFT: usize = 2;
/// A mesh with fewer times as many triangles than are to be left, or than a block has, is not divided [-].
const WORTHWHILE: usize = 2;

/// A part of space, without its sides.
struct Block {
    low: Vec3,
    high: Vec3,
}

/// The remaining triangles of a block: their corners, by the numbers of the whole, and the positions of these
/// [m].
struct Left {
    triangles: Vec<[NodeId; 3]>,
    vertices: Vec<(NodeId, Vec3)>,
}

/// `mesh` with several times as many triangles as asked for; none where it is too small for that. `progress` receives the
/// fraction of the work done [-], and may cancel.
pub(super) fn simplify_in_blocks(
    mesh: &TriangleMesh,
    settings: &SimplifySettings,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> ControlFlow<(), Option<TriangleMesh>> {
    let count = mesh.triangles().len();
    let left = LEFT * settings.triangles;
    if count < WORTHWHILE * left || count < WORTHWHILE * BLOCK {
        return ControlFlow::Continue(None);
    }
    let mut owners = vec![0; mesh.vertices().len()];
    let blocks = divide(mesh, &mut owners);
    let owner_of = |corners: &[NodeId; 3]| {
        let [a, b, c] = corners.map(|node| owners[node.index()]);
        (a == b && b == c).then_some(a)
    };
    let numbers: Vec<usize> = (0..blocks.len()).collect();
    let mut vertices = mesh.vertices().to_vec();
    let mut triangles: Vec<_> = mesh.triangles().to_vec();
    triangles.retain(|corners| owner_of(corners).is_none());
    for some in numbers.chunks(cores()) {
        progress(some[0] as f64 / blocks.len() as f64)?;
        let found = collect_on_all_cores(some, |_, &number| {
            let own = |corners: &[NodeId; 3]| owner_of(corners) == Some(number);
            blocks[number].simplify(mesh, own, left as f64 / count as f64, settings)
        });
        for part in found {
            triangles.extend(part.triangles);
            for (node, position) in part.vertices {
                vertices[node.index()] = position;
            }
        }
    }
    ControlFlow::Continue(Some(TriangleMesh::part_of(&vertices, &triangles).0))
}

/// Blocks of about as many vertices, and which of them has each of the vertices.
fn divide(mesh: &TriangleMesh, owners: &mut [usize]) -> Vec<Block> {
    let all = (0..mesh.vertices().len()).collect();
    let space = Block {
        low: Vec3::repeat(f64::NEG_INFINITY),
        high: Vec3::repeat(f64::INFINITY),
    };
    let mut blocks = Vec::new();
    let mut open: Vec<(Block, Vec<usize>, usize)> =
        vec![(space, all, mesh.triangles().len().div_ceil(BLOCK))];
    while let Some((block, mut inside, parts)) = open.pop() {
        let places = inside.iter().map(|&v| mesh.vertices()[v]);
        let (low, high) = places.fold((block.high, block.low), |(low, high), place| {
            (place.inf(&low), place.sup(&high))
        });
        let axis = (high - low).imax();
        let along = |v: usize| mesh.vertices()[v][axis];
        let half = inside.len() * (parts / 2) / parts;
        let (_, &mut at, _) =
            inside.select_nth_unstable_by(half, |&a, &b| along(a).total_cmp(&along(b)));
        let plane = along(at);
        let (below, above): (Vec<_>, Vec<_>) = inside.iter().partition(|&&v| along(v) < plane);
        if parts < 2 || below.is_empty() {
            for v in inside {
                owners[v] = blocks.len();
            }
            blocks.push(block);
            continue;
        }
        let [mut lower, mut upper] = [block.high, block.low];
        lower[axis] = plane;
        upper[axis] = plane;
        let halves = [
            (
                Block {
                    low: upper,
                    high: block.high,
                },
                above,
                parts - parts / 2,
            ),
            (
                Block {
                    low: block.low,
                    high: lower,
                },
                below,
                parts / 2,
            ),
        ];
        open.extend(halves);
    }
    blocks
}

impl Block {
    /// Simplifies the triangles for which `own` is true, all in this block, to `part` of their number [-]. The triangles around
    /// them stay as they are, and nothing passes through them.
    fn simplify(
        &self,
        mesh: &TriangleMesh,
        own: impl Fn(&[NodeId; 3]) -> bool,
        part: f64,
        settings: &SimplifySettings,
    ) -> Left {
        let near = |triangle: &TriangleId| {
            let [a, b, c] = mesh.positions(*triangle);
            let [low, high] = [a.inf(&b).inf(&c), a.sup(&b).sup(&c)];
            (0..3).all(|k| low[k] <= self.high[k] && high[k] >= self.low[k])
        };
        let near = mesh.triangle_ids().filter(near);
        let near: Vec<_> = near.map(|triangle| mesh.corners(triangle)).collect();
        let (piece, originals) = TriangleMesh::part_of(mesh.vertices(), &near);
        let mut net = Net::new(&piece);
        let mut owned = 0;
        for (triangle, corners) in near.iter().enumerate() {
            if own(corners) {
                owned += 1;
            } else {
                net.pin(triangle as u32);
            }
        }
        let own_left = (part * owned as f64).ceil() as usize;
        let settings = SimplifySettings {
            triangles: piece.triangles().len() - owned + own_left,
            ..*settings
        };
        collapse_within(&mut net, &settings, [self.low, self.high]);
        let original = |v: u32| originals[v as usize];
        let left = net.triangles().map(|t| net.corners(t));
        let triangles: Vec<_> = left
            .filter(|corners| own(&corners.map(original)))
            .map(|corners| corners.map(original))
            .collect();
        let vertices = (0..).zip(&net.positions);
        Left {
            triangles,
            vertices: vertices
                .filter(|&(v, _)| !net.is_pinned(v) && !net.around(v).is_empty())
                .map(|(v, &position)| (original(v), position))
                .collect(),
        }
    }
}
