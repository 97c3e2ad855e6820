use super::bisection::{Bisection, Edge};
use super::relax::relax;
use super::shell::{SearchedSurface, move_if_valid};
use crate::memoized::Memoized;
use crate::{Surface, TetrahedronError, TetrahedronMesh, Vec3};

/// Angles below this are not made by moving a vertex [rad].
const FLOOR: f64 = 0.26;

/// Rounds of bisection: three halve all edges, and no mesh of a body is finer than 2⁻³⁰ of it.
const MAX_ROUNDS: usize = 100;

/// Times that vertices inside are moved.
const MAX_RELAXED: usize = 2;

/// Bisects tetrahedra until none has an edge longer than `longest_edge` [m] at any of its corners [m] or at their
/// centroid. Away from there they grow. New vertices of the boundary move onto `surface`, if it is given; without
/// one the boundary keeps its shape. Regions keep their shapes.
///
/// # Errors
/// When there come more tetrahedra than [`TetrahedronMesh::MAX_TETRAHEDRA`], or the edge is not
/// reached, as when the requested edge is no positive length somewhere.
pub fn refine_to(
    mesh: &TetrahedronMesh,
    surface: Option<&Surface>,
    longest_edge: impl Fn(&Vec3) -> f64,
) -> Result<TetrahedronMesh, TetrahedronError> {
    let longest_edge = Memoized::new(longest_edge);
    let too_long = |longest: f64, positions: &[Vec3; 4]| {
        let [a, b, c, d] = positions;
        let centroid = 0.25 * (a + b + c + d);
        longest > longest_edge.at(&centroid)
            || positions.iter().any(|p| longest > longest_edge.at(p))
    };
    let searched = surface.map(SearchedSurface::new);
    let mut bisection = Bisection::new(mesh);
    let mut off_surface = Vec::new();
    let (mut rounds, mut relaxed) = (0, 0);
    loop {
        let chosen: Vec<u32> = (0..bisection.len() as u32)
            .filter(|&t| too_long(bisection.longest_edge(t), &bisection.positions(t)))
            .collect();
        if chosen.is_empty() {
            // A vertex that moves may make an edge too long again.
            if relaxed == MAX_RELAXED {
                break;
            }
            relax(&mut bisection, searched.as_ref());
            relaxed += 1;
            continue;
        }
        if rounds == MAX_ROUNDS {
            let edges = chosen.iter().map(|&t| bisection.longest_edge(t));
            let edge_m = edges.fold(0.0, f64::max);
            return Err(TetrahedronError::NotRefined { rounds, edge_m });
        }
        rounds += 1;
        bisection.bisect(&chosen);
        if bisection.len() > TetrahedronMesh::MAX_TETRAHEDRA {
            return Err(TetrahedronError::TooMany {
                expected: bisection.len() as f64,
                edge_m: chosen
                    .iter()
                    .map(|&t| 0.5 * bisection.longest_edge(t))
                    .fold(f64::INFINITY, f64::min),
                most: TetrahedronMesh::MAX_TETRAHEDRA,
            });
        }
        if let Some(searched) = &searched {
            off_surface.append(&mut bisection.new_on_boundary);
            off_surface.retain(|&(node, edge)| !pull(&mut bisection, searched, node, edge));
        }
    }
    bisection.into_mesh()
}

/// Moves a vertex that halves an edge onto the surface. Returns whether it is there.
fn pull(bisection: &mut Bisection, searched: &SearchedSurface<'_>, node: u32, edge: Edge) -> bool {
    let [a, b] = edge.map(|end| &bisection.vertices[end as usize]);
    let target = searched.under_chord([a, b])(&bisection.vertices[node as usize]);
    let star: Vec<[u32; 4]> = bisection.around[node as usize]
        .iter()
        .map(|&t| bisection.nodes(t))
        .collect();
    let vertices = &mut bisection.vertices;
    // A leap over more than half an edge would make edges too long for their place.
    let here = vertices[node as usize];
    let shortest = star
        .iter()
        .flatten()
        .filter(|&&other| other != node)
        .map(|&other| (vertices[other as usize] - here).norm())
        .fold(f64::INFINITY, f64::min);
    if (target - here).norm() > 0.5 * shortest {
        return false;
    }
    move_if_valid(vertices, star.iter().copied(), node, target, FLOOR)
}
