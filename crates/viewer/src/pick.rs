use palpate_geometry::{AabbTree, Surface, Vec3};

use crate::Camera;

/// A place of the resting surface that the eye sees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Picked {
    /// The place [m].
    pub point: Vec3,
    /// Its outward normal, between those of the corners [-].
    pub normal: Vec3,
}

/// The surface point at a position of the picture: (0, 0) is its upper left corner and (1, 1) its lower right one.
/// `tree` is that of the surface's mesh.
pub fn pick(
    surface: &Surface,
    tree: &AabbTree,
    camera: &Camera,
    place: (f64, f64),
    aspect: f64,
) -> Option<Picked> {
    let mesh = surface.mesh();
    let direction = camera.ray(place, aspect);
    if !direction.iter().all(|c| c.is_finite()) {
        return None;
    }
    let hit = tree.cast(mesh, &camera.eye, &direction, f64::INFINITY)?;
    let point = camera.eye + direction * hit.distance;
    let [a, b, c] = mesh.positions(hit.triangle);
    let on = palpate_geometry::closest_on_triangle(&[a, b, c], &point);
    let corners = mesh.corners(hit.triangle);
    let mixed: Vec3 = (0..3)
        .map(|k| surface.vertex_normals()[corners[k].index()] * on.barycentric[k])
        .sum();
    let normal = mixed
        .try_normalize(1e-6)
        .unwrap_or_else(|| mesh.area_vector(hit.triangle).normalize());
    Some(Picked { point, normal })
}
