//! Stress on the surface from the displacements of triangles: a plane through them by weighted least squares,
//! and Hooke's law with no traction on the surface.

use nalgebra::Matrix3;
use palpate_geometry::{Surface, TriangleId};

use super::super::response::{SurfaceResponse, TouchId};
use super::facet::{CrackGeometry, Facet};
use crate::Vec3;
use crate::boundary_elements::Precision;

/// Radius of the triangles that are taken, in lengths √(2 A) of one; and in a wall, whose faces do not resolve its
/// bending nearer to a force, in thicknesses, whichever is more [-].
const REACH: f64 = 1.8;
const IN_WALLS: f64 = 1.5;

/// Of so many that lie in it,
const MAX_FOUND: usize = 160;
/// so many are taken at most.
pub(super) const MOST: usize = 16;

/// Weights of a triangle's displacement in σ_nn and σ_ns over E at a place [1/m].
#[derive(Debug, Clone, Copy)]
pub(super) struct Stress {
    touch: TouchId,
    pub(super) centroid: Vec3,
    pub(super) across: Vec3,
    pub(super) along: Vec3,
}

/// Stress at a place of the surface.
#[derive(Debug)]
pub(super) struct Gradient {
    found: Vec<TriangleId>,
    weights: Vec<f64>,
    pub(super) parts: Vec<Stress>,
    /// Length √(2 A) of its triangles [m].
    pub(super) size: f64,
    /// Its reach [m].
    pub(super) reach: f64,
    /// Curvature of the surface across the facet [1/m].
    pub(super) curvature: f64,
}

impl Gradient {
    pub(super) fn new() -> Self {
        Self {
            found: Vec::with_capacity(MAX_FOUND),
            weights: Vec::with_capacity(MOST),
            parts: Vec::with_capacity(MOST),
            size: 0.0,
            reach: 0.0,
            curvature: 0.0,
        }
    }

    /// For the stress at `place` [m] near the triangle `start`, on planes across a facet; nothing where the
    /// triangles do not determine it.
    pub(super) fn prepare<T: Precision>(
        &mut self,
        surface: &Surface,
        response: &SurfaceResponse<T>,
        start: TriangleId,
        place: &Vec3,
        facet: &Facet,
    ) {
        self.parts.clear();
        self.weights.clear();
        self.curvature = 0.0;
        let mesh = surface.mesh();
        let outward = mesh.area_vector(start).normalize();
        let near = surface.adjacency().edge_neighborhood(start);
        let areas = near.map(|id| mesh.area_vector(id).norm());
        let (sum, count) = areas.fold((mesh.area_vector(start).norm(), 1.0), |(sum, n), area| {
            (sum + area, n + 1.0)
        });
        self.size = f64::sqrt(2.0 * sum / count);
        let in_wall = match facet.geometry {
            CrackGeometry::Solid { .. } => 0.0,
            CrackGeometry::Wall { thickness, .. } => IN_WALLS * thickness,
        };
        self.reach = in_wall.max(REACH * self.size);
        around(surface, start, place, &outward, self.reach, &mut self.found);
        let [n, s] = [0, 1].map(|k| facet.frame.column(k).into_owned());
        let mut moments = Matrix3::zeros();
        let taken = self.found.len().min(MOST);
        for number in 0..taken {
            let triangle = self.found[number * self.found.len() / taken];
            let Some(touch) = response.find(triangle) else {
                continue;
            };
            let touched = &response.touchable()[touch.index()];
            let away = touched.centroid - place;
            let fade = 1.0 - away.norm_squared() / (self.reach * self.reach);
            let weight = touched.area * fade.max(0.0).powi(2);
            let basis = Vec3::new(1.0, away.dot(&n) / self.reach, away.dot(&s) / self.reach);
            moments += basis * basis.transpose() * weight;
            self.weights.push(weight);
            self.parts.push(Stress {
                touch,
                centroid: touched.centroid,
                across: basis,
                along: Vec3::zeros(),
            });
        }
        let scale = moments[(0, 0)];
        let solvable = moments.symmetric_eigenvalues().min() > 1e-3 * scale;
        let Some(inverse) = moments.try_inverse().filter(|_| solvable) else {
            self.parts.clear();
            return;
        };
        let nu = response.parts().poissons_ratio;
        let (plane, shear) = (1.0 / (1.0 - nu * nu), 0.5 / (1.0 + nu));
        for (part, weight) in self.parts.iter_mut().zip(&self.weights) {
            let slopes = inverse * part.across * (*weight / self.reach);
            let normal = response.touchable()[part.touch.index()].normal;
            self.curvature += slopes.y * normal.dot(&n);
            part.across = (n * slopes.y + s * (nu * slopes.z)) * plane;
            part.along = (s * slopes.y + n * slopes.z) * shear;
        }
    }

    /// Puts σ_nn and σ_ns of a unit force on each triangle, along each axis, into two rows.
    pub(super) fn stress<T: Precision>(
        &self,
        response: &SurfaceResponse<T>,
        across: &mut [T],
        along: &mut [T],
    ) {
        across.fill(T::of(0.0));
        along.fill(T::of(0.0));
        let rows = 3 * response.parts().triangles;
        for part in &self.parts {
            let columns =
                &response.parts().displacements[3 * rows * part.touch.index()..][..3 * rows];
            let (x, rest) = columns.split_at(rows);
            let (y, z) = rest.split_at(rows);
            let [ax, ay, az] = [part.across.x, part.across.y, part.across.z].map(T::of);
            let [bx, by, bz] = [part.along.x, part.along.y, part.along.z].map(T::of);
            let places = across.iter_mut().zip(along.iter_mut());
            for (((place, &x), &y), &z) in places.zip(x).zip(y).zip(z) {
                *place.0 += ax * x + ay * y + az * z;
                *place.1 += bx * x + by * y + bz * z;
            }
        }
    }
}

/// The triangles within `reach` [m] of a place that hang together with `start` and face as it does, from near
/// to far in steps over corners; no more than the list has room for.
pub(super) fn around(
    surface: &Surface,
    start: TriangleId,
    place: &Vec3,
    outward: &Vec3,
    reach: f64,
    found: &mut Vec<TriangleId>,
) {
    let (mesh, adjacency) = (surface.mesh(), surface.adjacency());
    let belongs = |triangle: TriangleId| {
        let centroid = mesh.positions(triangle).iter().sum::<Vec3>() / 3.0;
        let area = mesh.area_vector(triangle);
        (centroid - place).norm() < reach && area.dot(outward) > 0.5 * area.norm()
    };
    found.clear();
    found.push(start);
    let mut next = 0;
    while let Some(&triangle) = found.get(next) {
        next += 1;
        for node in mesh.corners(triangle) {
            for &other in adjacency.around(node) {
                if found.len() < found.capacity() && belongs(other) && !found.contains(&other) {
                    found.push(other);
                }
            }
        }
    }
}
