use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::cube::nearest_square;
use super::{AnchorPlane, OrganDescription};
use crate::{MeshError, NodeId, TriangleMesh, Vec3};

const RADIUS: f64 = 0.05;

pub(super) fn description() -> OrganDescription {
    OrganDescription {
        summary: "Half a ball, for comparison with closed forms.",
        axes: "z along the axis, pole at +z",
        origin: "the centre of the base",
        lengths: "radius 50 mm; the base is the plane z = 0",
        fixed: "the base, z = 0",
        extent: Vec3::new(2.0 * RADIUS, 2.0 * RADIUS, RADIUS),
        volume: 2.0 / 3.0 * PI * RADIUS.powi(3),
    }
}

pub(super) fn anchor() -> Vec<AnchorPlane> {
    vec![AnchorPlane {
        // Just above the base: below the centroid of any triangle of the dome.
        point: Vec3::new(0.0, 0.0, 1e-6),
        normal: Vec3::z(),
    }]
}

/// Dome and base from the same net: ring i around the centre has 6 i vertices, so that triangles
/// are alike everywhere. With k rings each has 6 k² triangles; they share the rim.
pub(super) fn surface_mesh(triangles: usize) -> Result<TriangleMesh, MeshError> {
    let rings = nearest_square(triangles, 12, 2);
    let mut vertices = net_points(rings, |fraction, angle| {
        let (polar_sine, polar_cosine) = (FRAC_PI_2 * fraction).sin_cos();
        let height = if fraction < 1.0 { polar_cosine } else { 0.0 };
        RADIUS * Vec3::new(polar_sine * angle.cos(), polar_sine * angle.sin(), height)
    });
    let mut faces = net_triangles(rings);
    let rim_start = first_of_ring(rings);
    let dome_size = vertices.len() as u32;
    let base = net_points(rings, |fraction, angle| {
        RADIUS * fraction * Vec3::new(angle.cos(), angle.sin(), 0.0)
    });
    vertices.extend(&base[..rim_start as usize]);
    let on_base = |node: NodeId| match node.0 < rim_start {
        true => NodeId(node.0 + dome_size),
        false => node,
    };
    let flipped: Vec<_> = faces
        .iter()
        .map(|&[a, b, c]| [a, c, b].map(on_base))
        .collect();
    faces.extend(flipped);
    TriangleMesh::new(vertices, faces)
}

/// Number of the first vertex of `ring`; the centre is ring 0.
fn first_of_ring(ring: usize) -> u32 {
    match ring {
        0 => 0,
        _ => (1 + 3 * ring * (ring - 1)) as u32,
    }
}

/// The vertices of a net of `rings` rings; `place` gets the fraction of the way from the centre to
/// the rim and the angle around.
fn net_points(rings: usize, place: impl Fn(f64, f64) -> Vec3) -> Vec<Vec3> {
    let mut points = vec![place(0.0, 0.0)];
    for ring in 1..=rings {
        let fraction = ring as f64 / rings as f64;
        let angles = (0..6 * ring).map(|step| TAU * step as f64 / (6 * ring) as f64);
        points.extend(angles.map(|angle| place(fraction, angle)));
    }
    points
}

/// Its triangles, counter-clockwise: six sectors, each a triangular lattice.
fn net_triangles(rings: usize) -> Vec<[NodeId; 3]> {
    let node = |ring: usize, step: usize| {
        let around = if ring == 0 { 0 } else { step % (6 * ring) };
        NodeId(first_of_ring(ring) + around as u32)
    };
    let mut triangles = Vec::with_capacity(12 * rings * rings);
    for ring in 1..=rings {
        for sector in 0..6 {
            let outer = |step| node(ring, sector * ring + step);
            let inner = |step| node(ring - 1, sector * (ring - 1) + step);
            for step in 0..ring {
                triangles.push([outer(step), outer(step + 1), inner(step)]);
                if step + 1 < ring {
                    triangles.push([inner(step), outer(step + 1), inner(step + 1)]);
                }
            }
        }
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dome_vertices_are_on_the_sphere_and_the_base_is_flat() {
        let mesh = surface_mesh(1_000).unwrap();
        assert_eq!(mesh.vertices()[0], Vec3::new(0.0, 0.0, RADIUS));
        for vertex in mesh.vertices() {
            let on_sphere = (vertex.norm() - RADIUS).abs() < 1e-15;
            assert!(on_sphere || vertex.z == 0.0, "{vertex}");
        }
    }

    #[test]
    fn only_the_base_is_held() {
        let mesh = surface_mesh(70_000).unwrap();
        let plane = anchor()[0];
        for triangle in mesh.triangle_ids() {
            let centroid = mesh.positions(triangle).iter().sum::<Vec3>() / 3.0;
            assert_eq!(plane.contains(&centroid), centroid.z == 0.0);
        }
    }
}
