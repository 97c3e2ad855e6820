//! The source's own placement (section 3.4, figure 3-6): directions from the centroid of the contact
//! triangle to its vertices, points along them projected on the organ along the triangle's normal,
//! stored for every triangle.
//!
//! The figure shows the rings without numbers. Here the template's rings are turned and stretched in
//! azimuth until three of their directions are those to the vertices; surface particles are projected,
//! those below keep the template's place.

use palpate_geometry::{AabbTree, Surface, TriangleId};

use super::layout::{CapShape, Layout, Place};
use crate::Vec3;

/// Steepest height over distance that a projected particle may have; steeper ones missed the organ's
/// near side.
const STEEPEST: f64 = 0.75;

/// Heights of the surface particles over the plane of each triangle.
#[derive(Debug, Clone)]
pub(super) struct SourcePlacement {
    /// Per triangle, the azimuths of the second and third vertex seen from the centroid [rad].
    directions: Vec<[f32; 2]>,
    /// Per triangle and surface particle [h]; NaN where the projection missed.
    heights: Vec<f32>,
    surface_places: Vec<usize>,
}

impl SourcePlacement {
    pub(super) fn new(surface: &Surface, tree: &AabbTree, layout: &Layout, spacing: f64) -> Self {
        let surface_places: Vec<_> = (0..layout.places.len())
            .filter(|&i| i > 0 && layout.places[i].fraction == 1.0)
            .collect();
        let mut placement = Self {
            directions: Vec::new(),
            heights: Vec::new(),
            surface_places,
        };
        for triangle in surface.mesh().triangle_ids() {
            placement.project(surface, tree, layout, triangle, spacing);
        }
        placement
    }

    fn project(
        &mut self,
        surface: &Surface,
        tree: &AabbTree,
        layout: &Layout,
        triangle: TriangleId,
        spacing: f64,
    ) {
        let frame = TriangleFrame::new(surface, triangle);
        self.directions.push(frame.directions);
        for &index in &self.surface_places {
            let place = &layout.places[index];
            let (sine, cosine) = warp(place.azimuth, frame.directions).sin_cos();
            let reach = place.radius * spacing;
            let foot = frame.centroid + (frame.first * cosine + frame.second * sine) * reach;
            let mesh = surface.mesh();
            let up = tree.cast(mesh, &foot, &frame.normal, reach);
            let down = tree.cast(mesh, &foot, &-frame.normal, reach);
            let height = match (up, down) {
                (Some(up), Some(down)) if up.distance < down.distance => up.distance,
                (_, Some(down)) => -down.distance,
                (Some(up), None) => up.distance,
                (None, None) => f64::NAN,
            };
            self.heights.push((height / spacing) as f32);
        }
    }

    /// Puts the particles of a contact on `triangle` into `positions` [h].
    pub(super) fn place(
        &self,
        triangle: TriangleId,
        layout: &Layout,
        cap: CapShape,
        positions: &mut Vec<Vec3>,
    ) {
        let directions = self.directions[triangle.index()];
        positions.clear();
        positions.extend(layout.places.iter().map(|place| {
            cap.position(&Place {
                azimuth: warp(place.azimuth, directions),
                ..*place
            })
        }));
        let count = self.surface_places.len();
        let heights = &self.heights[triangle.index() * count..][..count];
        for (&index, &height) in self.surface_places.iter().zip(heights) {
            let place = &layout.places[index];
            if f64::from(height).abs() <= STEEPEST * place.radius {
                let (sine, cosine) = warp(place.azimuth, directions).sin_cos();
                let (x, y) = (place.radius * cosine, place.radius * sine);
                positions[index] = Vec3::new(x, y, f64::from(height));
            }
        }
    }
}

struct TriangleFrame {
    centroid: Vec3,
    first: Vec3,
    second: Vec3,
    normal: Vec3,
    directions: [f32; 2],
}

impl TriangleFrame {
    fn new(surface: &Surface, triangle: TriangleId) -> Self {
        let corners = surface.mesh().positions(triangle);
        let normal = surface.mesh().area_vector(triangle).normalize();
        let centroid = (corners[0] + corners[1] + corners[2]) / 3.0;
        let first = (corners[0] - centroid).normalize();
        let second = normal.cross(&first);
        let azimuth = |corner: &Vec3| {
            let to_corner = corner - centroid;
            let angle = to_corner.dot(&second).atan2(to_corner.dot(&first));
            angle.rem_euclid(std::f64::consts::TAU) as f32
        };
        let directions = [azimuth(&corners[1]), azimuth(&corners[2])];
        Self {
            centroid,
            first,
            second,
            normal,
            directions,
        }
    }
}

/// The tangent from the centroid of `triangle` to its first vertex: the source's frame.
pub fn first_direction(surface: &Surface, triangle: TriangleId) -> Vec3 {
    TriangleFrame::new(surface, triangle).first
}

/// Takes the thirds of a turn to the directions of the three vertices, linearly between.
fn warp(azimuth: f64, directions: [f32; 2]) -> f64 {
    let turn = std::f64::consts::TAU;
    let knots = [
        0.0,
        f64::from(directions[0]),
        f64::from(directions[1]),
        turn,
    ];
    let along = azimuth.rem_euclid(turn) / (turn / 3.0);
    let third = (along.floor() as usize).min(2);
    knots[third] + (along - third as f64) * (knots[third + 1] - knots[third])
}
