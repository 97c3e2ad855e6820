//! Contacts to try, on meshes and without, and random numbers.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Matrix3, Vector3};
use palpate_geometry::{AabbTree, NodeId, Organ, PatchField, Surface, TriangleId, TriangleMesh};
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_spheres::{
    FiniteSphereModel, FiniteSphereSettings, LocalContact, Surroundings,
};
use palpate_mechanics::{LinearElastic, Vec3};

/// Radius of the hemisphere [m].
pub(crate) const RADIUS: f64 = 0.05;

/// A soft tissue [Pa].
pub(crate) const MODULUS: f64 = 1e4;

/// `full` tries when `PALPATE_FULL=1`, else a tenth.
pub(crate) fn tries(full: usize) -> usize {
    if std::env::var_os("PALPATE_FULL").is_some_and(|value| value == "1") {
        full
    } else {
        full.div_ceil(10)
    }
}

pub(crate) fn tissue(poissons_ratio: f64) -> LinearElastic {
    LinearElastic::new(MODULUS, poissons_ratio).unwrap()
}

pub(crate) fn model(
    settings: FiniteSphereSettings,
    poissons_ratio: f64,
    bond: Friction,
) -> FiniteSphereModel {
    FiniteSphereModel::new(settings, &tissue(poissons_ratio), bond).unwrap()
}

/// A contact on nothing but a curvature [1/m].
pub(crate) fn bare_contact(curvature: Vector3<f64>, radius: f64, organ: f64) -> LocalContact {
    LocalContact {
        point: Vec3::zeros(),
        frame: Matrix3::identity(),
        curvature,
        triangle: TriangleId(0),
        radius,
        surroundings: Surroundings::Hemisphere { radius: organ },
        thickness: organ,
    }
}

pub(crate) fn organ(organ: Organ, triangles: usize) -> Surface {
    Surface::new(organ.surface_mesh(triangles).unwrap()).unwrap()
}

/// The contact of a tip of `radius` [m] where `surface` is nearest to `near` [m], as a simulation finds
/// it: nearest point, averaged normal and curvature, radius of a hemisphere of the same volume.
pub(crate) fn contact_near(
    surface: &Surface,
    model: &FiniteSphereModel,
    near: &Vec3,
    radius: f64,
) -> LocalContact {
    let tree = AabbTree::new(surface.mesh());
    let field = PatchField::new(surface, 2.0 * model.spacing(radius));
    let nearest = tree.nearest(surface.mesh(), near);
    let patch = field.at(surface, nearest.triangle, &nearest.on.barycentric);
    let corners = surface.mesh().positions(nearest.triangle);
    let along = corners[1] - corners[0];
    let first = (along - patch.normal * patch.normal.dot(&along)).normalize();
    let second = patch.normal.cross(&first);
    let in_frame = |a: &Vec3, b: &Vec3| a.dot(&(patch.curvature * b));
    LocalContact {
        point: nearest.on.position,
        frame: Matrix3::from_columns(&[first, second, patch.normal]),
        curvature: Vector3::new(
            in_frame(&first, &first),
            in_frame(&first, &second),
            in_frame(&second, &second),
        ),
        triangle: nearest.triangle,
        radius,
        surroundings: Surroundings::Hemisphere {
            radius: (1.5 * surface.mesh().volume() / PI).cbrt(),
        },
        thickness: (1.5 * surface.mesh().volume() / PI).cbrt(),
    }
}

/// The hemisphere again, from parallels and meridians with shaken nodes: not one vertex, edge or
/// valence in common with the built-in one.
pub(crate) fn shaken_hemisphere(rows: usize, around: usize) -> Surface {
    let mut random = Random(7);
    let mut vertices = vec![Vec3::z() * RADIUS];
    for row in 1..=rows {
        let inner = row < rows;
        for k in 0..around {
            let mut shake = || {
                if inner {
                    0.5 * (random.unit() - 0.5)
                } else {
                    0.0
                }
            };
            let polar = FRAC_PI_2 * (row as f64 + shake()) / rows as f64;
            let turn = TAU * (k as f64 + shake()) / around as f64;
            let height = if inner { polar.cos() } else { 0.0 };
            let across = if inner { polar.sin() } else { 1.0 };
            vertices.push(RADIUS * Vec3::new(across * turn.cos(), across * turn.sin(), height));
        }
    }
    let base = NodeId(vertices.len() as u32);
    vertices.push(Vec3::zeros());
    let node = |row: usize, k: usize| NodeId((1 + (row - 1) * around + k % around) as u32);
    let mut triangles = Vec::new();
    for k in 0..around {
        triangles.push([NodeId(0), node(1, k), node(1, k + 1)]);
        triangles.push([base, node(rows, k + 1), node(rows, k)]);
        for row in 1..rows {
            let [a, b] = [node(row, k), node(row, k + 1)];
            let [c, d] = [node(row + 1, k), node(row + 1, k + 1)];
            triangles.push([a, c, d]);
            triangles.push([a, d, b]);
        }
    }
    Surface::new(TriangleMesh::new(vertices, triangles).unwrap()).unwrap()
}

/// A seeded generator of random numbers [Knuth's MMIX constants].
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Even in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Even in [-1, 1).
    pub(crate) fn sign(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    pub(crate) fn vector(&mut self) -> Vec3 {
        Vec3::new(self.sign(), self.sign(), self.sign())
    }

    /// Curvatures [1/m] whose larger principal one, times `spacing` [m], is below `steepest`.
    pub(crate) fn curvature(&mut self, spacing: f64, steepest: f64) -> Vector3<f64> {
        let (one, other) = (self.sign(), self.sign());
        let (sine, cosine) = (TAU * self.unit()).sin_cos();
        let mixed = Vector3::new(
            one * cosine * cosine + other * sine * sine,
            (one - other) * sine * cosine,
            one * sine * sine + other * cosine * cosine,
        );
        mixed * (steepest / spacing)
    }
}
