use super::bisection::Bisection;
use super::relax::relax;
use super::shell::{Shell, move_if_sound};
use crate::mesh::tetrahedra::{OPPOSITE, six_fold_volume};
use crate::proximity::closest_on_triangle;
use crate::{Surface, TetrahedronError, TetrahedronMesh, Vec3};

/// Angles below this are not made by moving a vertex [rad].
const FLOOR: f64 = 0.26;

/// Rounds of bisection: three halve all edges, and no mesh of a body is finer than 2⁻³⁰ of it.
const MOST_ROUNDS: usize = 100;

/// Times that vertices inside are moved.
const MOST_RELAXED: usize = 2;

/// A ball in which tetrahedra are to be small.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Focus {
    /// Its centre [m].
    pub center: Vec3,
    /// Its radius [m].
    pub radius: f64,
    /// The longest edge that a tetrahedron may have that touches it [m].
    pub edge: f64,
}

/// Bisects tetrahedra until those that touch the ball have no edge longer than `focus.edge`. Away
/// from it they grow by themselves. New vertices of the boundary move onto `surface`, if it is given;
/// without one the boundary keeps its shape. A ball between the mesh and its surface refines what is
/// nearest to it.
///
/// # Errors
/// When radius or edge is not a positive length, there come more tetrahedra than
/// [`TetrahedronMesh::MOST_TETRAHEDRA`], or the edge is not reached.
pub fn refine_near(
    mesh: &TetrahedronMesh,
    surface: Option<&Surface>,
    focus: &Focus,
) -> Result<TetrahedronMesh, TetrahedronError> {
    for (what, found) in [
        ("the radius of the ball", focus.radius),
        ("the edge to refine to", focus.edge),
    ] {
        if !found.is_finite() || found <= 0.0 {
            return Err(TetrahedronError::NotALength { what, found });
        }
    }
    let center = center_in(mesh, focus);
    refine(mesh, surface, |longest, positions| {
        longest > focus.edge && is_within(positions, &center, focus.radius)
    })
    .map_err(|error| match error {
        TetrahedronError::TooMany { expected, most, .. } => TetrahedronError::TooMany {
            expected,
            edge_m: focus.edge,
            most,
        },
        other => other,
    })
}

/// Bisects tetrahedra until none has an edge longer than what `longest_edge` [m] says at any of its
/// corners [m] or at their centroid; otherwise as [`refine_near`].
///
/// # Errors
/// When there come more tetrahedra than [`TetrahedronMesh::MOST_TETRAHEDRA`], or the edge is not
/// reached, as when the edge that is asked for somewhere is no positive length.
pub fn refine_to(
    mesh: &TetrahedronMesh,
    surface: Option<&Surface>,
    longest_edge: impl Fn(&Vec3) -> f64,
) -> Result<TetrahedronMesh, TetrahedronError> {
    refine(mesh, surface, |longest, positions| {
        let [a, b, c, d] = positions;
        let centroid = 0.25 * (a + b + c + d);
        longest > longest_edge(&centroid) || positions.iter().any(|p| longest > longest_edge(p))
    })
}

/// Bisects tetrahedra that are `too_long`, by their longest edge [m] and their corners [m].
fn refine(
    mesh: &TetrahedronMesh,
    surface: Option<&Surface>,
    too_long: impl Fn(f64, &[Vec3; 4]) -> bool,
) -> Result<TetrahedronMesh, TetrahedronError> {
    let shell = surface.map(Shell::new);
    let mut bisection = Bisection::new(mesh);
    let mut off_surface = Vec::new();
    let (mut rounds, mut relaxed) = (0, 0);
    loop {
        let chosen: Vec<u32> = (0..bisection.len() as u32)
            .filter(|&t| too_long(bisection.longest_edge(t), &bisection.positions(t)))
            .collect();
        if chosen.is_empty() {
            // A vertex that moves may make an edge too long again.
            if relaxed == MOST_RELAXED {
                break;
            }
            relax(&mut bisection, shell.as_ref());
            relaxed += 1;
            continue;
        }
        if rounds == MOST_ROUNDS {
            let edges = chosen.iter().map(|&t| bisection.longest_edge(t));
            let edge_m = edges.fold(0.0, f64::max);
            return Err(TetrahedronError::NotRefined { rounds, edge_m });
        }
        rounds += 1;
        bisection.bisect(&chosen);
        if bisection.len() > TetrahedronMesh::MOST_TETRAHEDRA {
            return Err(TetrahedronError::TooMany {
                expected: bisection.len() as f64,
                edge_m: chosen
                    .iter()
                    .map(|&t| 0.5 * bisection.longest_edge(t))
                    .fold(f64::INFINITY, f64::min),
                most: TetrahedronMesh::MOST_TETRAHEDRA,
            });
        }
        if let Some(shell) = &shell {
            off_surface.append(&mut bisection.new_on_boundary);
            off_surface.retain(|&node| !pull(&mut bisection, shell, node));
        }
    }
    bisection.into_mesh()
}

/// Moves a vertex onto the surface. Whether it is there.
fn pull(bisection: &mut Bisection, shell: &Shell<'_>, node: u32) -> bool {
    let target = shell.nearest(&bisection.vertices[node as usize]);
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
    move_if_sound(vertices, star.iter().copied(), node, target, FLOOR)
}

/// The centre of the ball, or where the ball lies between the mesh and its surface, the point of the
/// mesh nearest to it [m].
fn center_in(mesh: &TetrahedronMesh, focus: &Focus) -> Vec3 {
    let all = || (0..mesh.tetrahedra().len()).map(|t| mesh.positions(t));
    let mut nearest = (f64::INFINITY, focus.center);
    if all().any(|positions| is_within(&positions, &focus.center, focus.radius)) {
        return focus.center;
    }
    for face in all().flat_map(|positions| faces_of(&positions)) {
        let point = closest_on_triangle(&face, &focus.center).position;
        let distance = (point - focus.center).norm();
        if distance < nearest.0 {
            nearest = (distance, point);
        }
    }
    nearest.1
}

/// Whether a tetrahedron has a point within `reach` of `center` [m].
fn is_within(positions: &[Vec3; 4], center: &Vec3, reach: f64) -> bool {
    let [a, b, c, d] = positions;
    let (low, high) = (a.inf(b).inf(c).inf(d), a.sup(b).sup(c).sup(d));
    let outside = (low - center).sup(&(center - high)).sup(&Vec3::zeros());
    if outside.norm() > reach {
        return false;
    }
    let faces = faces_of(positions);
    let near = faces.iter().any(|face| {
        let nearest = closest_on_triangle(face, center).position;
        (nearest - center).norm() <= reach
    });
    near || faces
        .iter()
        .all(|[p, q, r]| six_fold_volume(&[*center, *p, *q, *r]) >= 0.0)
}

/// The faces of a positive tetrahedron, counter-clockwise seen from outside.
fn faces_of(positions: &[Vec3; 4]) -> [[Vec3; 3]; 4] {
    OPPOSITE.map(|face| face.map(|k| positions[k]))
}
