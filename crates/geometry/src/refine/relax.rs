//! Vertices move to improve the flattest tetrahedra; those of the boundary move along the surface.
//!
//! Bisection halves angles; a short search around each vertex of a flat tetrahedron recovers most of
//! that. The result is the same on every run: directions are fixed, and a move is accepted only when
//! the worst angle around the vertex grows.

use super::bisection::Bisection;
use super::shell::{SearchedSurface, dihedral_quality};
use crate::Vec3;

/// Tetrahedra with a lower quality than this are improved [rad].
pub(crate) const FLAT: f64 = 0.25;

/// Sweeps over all flat tetrahedra.
pub(crate) const SWEEPS: usize = 6;

/// Steps of the search, as parts of the shortest edge at the vertex [-].
const STEPS: [f64; 4] = [0.3, 0.15, 0.07, 0.03];

/// Without a surface the boundary stays.
pub(super) fn relax(bisection: &mut Bisection, searched: Option<&SearchedSurface<'_>>) {
    let on_boundary = bisection.on_boundary();
    // A vertex between regions would change their shapes.
    let between = bisection.between_regions();
    for _ in 0..SWEEPS {
        let mut nodes: Vec<u32> = (0..bisection.len() as u32)
            .filter(|&t| dihedral_quality(&bisection.positions(t)) < FLAT)
            .flat_map(|t| bisection.nodes(t))
            .filter(|&node| searched.is_some() || !on_boundary[node as usize])
            .filter(|&node| !between[node as usize])
            .collect();
        nodes.sort_unstable();
        nodes.dedup();
        let mut any = false;
        for node in nodes {
            let searched = searched.filter(|_| on_boundary[node as usize]);
            any |= open(bisection, node, searched);
        }
        if !any {
            break;
        }
    }
}

/// Moves one vertex to a better place nearby. Returns whether there was one.
fn open(bisection: &mut Bisection, node: u32, searched: Option<&SearchedSurface<'_>>) -> bool {
    let star: Vec<[u32; 4]> = bisection.around[node as usize]
        .iter()
        .map(|&t| bisection.nodes(t))
        .collect();
    let start = bisection.vertices[node as usize];
    open_around(&mut bisection.vertices, node, &star, |target| {
        searched.map_or(target, |searched| searched.slide(&start, &target))
    })
}

/// Moves `node` to improve the flattest of the tetrahedra around it, `star`; `onto` projects candidate places. Returns whether
/// there was a better one.
pub(crate) fn open_around(
    vertices: &mut [Vec3],
    node: u32,
    star: &[[u32; 4]],
    onto: impl Fn(Vec3) -> Vec3,
) -> bool {
    let start = vertices[node as usize];
    let worst = |vertices: &[Vec3]| {
        star.iter()
            .map(|nodes| dihedral_quality(&nodes.map(|n| vertices[n as usize])))
            .fold(f64::INFINITY, f64::min)
    };
    let others = star.iter().flatten().filter(|&&other| other != node);
    let reach = others
        .map(|&other| (vertices[other as usize] - start).norm())
        .fold(f64::INFINITY, f64::min);
    let mut best = (worst(vertices), start);
    for step in STEPS {
        let from = best.1;
        for direction in directions() {
            let target = onto(from + direction * (step * reach));
            vertices[node as usize] = target;
            let open = worst(vertices);
            if open > best.0 + 1e-6 {
                best = (open, target);
            }
        }
    }
    vertices[node as usize] = best.1;
    best.1 != start
}

/// To the faces and the corners of a cube.
fn directions() -> impl Iterator<Item = Vec3> {
    let along = (0..3).flat_map(|k| [-1.0, 1.0].map(|s| Vec3::ith(k, s)));
    let across = (0..8u8).map(|bits| {
        let sign = |k: u8| if bits >> k & 1 == 0 { -1.0 } else { 1.0 };
        Vec3::new(sign(0), sign(1), sign(2)) / 3f64.sqrt()
    });
    along.chain(across)
}
