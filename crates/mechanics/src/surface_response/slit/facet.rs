use nalgebra::Matrix3;
use palpate_geometry::{AabbTree, Surface, TriangleId};

use super::super::response::SurfaceResponse;
use super::gradient::Gradient;
use crate::boundary_elements::Precision;
use crate::{Error, Vec3};

/// A slit deeper than this part of what lies under it cuts a wall [-].
const OF_A_WALL: f64 = 0.4;

/// A slit deeper than this part of a wall goes through [-].
const THROUGH: f64 = 0.98;

/// Ends nearer than this part of a length belong together [-].
const TOGETHER: f64 = 0.35;

/// Offsets of the rays that measure the thickness of a wall, in edges [-].
const BESIDE: [[f64; 2]; 4] = [[0.0, 0.0], [0.037, 0.021], [-0.029, 0.041], [0.011, -0.043]];

/// A straight piece of a slit, as requested.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlitFacet {
    /// The middle of its edge on the surface at rest [m].
    pub middle: Vec3,
    /// Along the slit; its part along the normal does not count [-].
    pub along: Vec3,
    /// Outward normal of the surface [-].
    pub normal: Vec3,
    /// Length along the slit [m].
    pub length: f64,
    /// Depth into the body [m]; infinite, or more than a wall has, goes through.
    pub depth: f64,
}

/// The organ that is cut.
#[derive(Debug)]
pub struct CutBody<'a, T> {
    /// The surface at rest that the response is of.
    pub surface: &'a Surface,
    /// Its boxes.
    pub tree: &'a AabbTree,
    /// Its response to forces, uncut.
    pub response: &'a SurfaceResponse<T>,
}

/// The geometry that a facet cuts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum CrackGeometry {
    /// A solid, to a depth that is small relative to it [m].
    Solid { depth: f64 },
    /// A wall of a thickness [m], to a part of it [-]; one is through.
    Wall { thickness: f64, part: f64 },
}

/// A facet on the surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Facet {
    /// Columns: across, to the right of the way (n); along (s); outward (z).
    pub(super) frame: Matrix3<f64>,
    pub(super) middle: Vec3,
    pub(super) length: f64,
    pub(super) geometry: CrackGeometry,
    /// Triangles at its middle: on the surface, and on the other side of a wall.
    pub(super) outer: TriangleId,
    pub(super) inner: Option<TriangleId>,
    /// Curvature of the wall's middle across the facet [1/m].
    pub(super) curvature: f64,
    /// Its first row.
    pub(super) first: usize,
}

impl Facet {
    /// The requested facet on the surface of a body.
    pub(super) fn new<T: Precision>(
        body: &CutBody<'_, T>,
        asked: &SlitFacet,
        first: usize,
    ) -> Result<Self, Error> {
        let fault = |fault: &'static str| Error::InvalidSlit { fault };
        let lengths = asked.length > 0.0 && asked.length.is_finite() && asked.depth > 0.0;
        if !lengths || !asked.middle.iter().all(|x| x.is_finite()) {
            return Err(fault("a facet has no length, depth or place"));
        }
        let outward = unit(&asked.normal).ok_or(fault("a facet has no normal"))?;
        let flat = asked.along - outward * outward.dot(&asked.along);
        let along = unit(&flat).ok_or(fault("a facet has no direction along the surface"))?;
        let mesh = body.surface.mesh();
        let nearest = body.tree.nearest(mesh, &asked.middle);
        if nearest.distance > asked.length.max(edge(body.surface, nearest.triangle)) {
            return Err(fault("a facet lies off the surface"));
        }
        if mesh.area_vector(nearest.triangle).dot(&outward) <= 0.0 {
            return Err(fault("a facet's normal points into the body"));
        }
        let middle = nearest.on.position;
        let (geometry, inner) = crack_geometry(body, &middle, &outward, asked);
        Ok(Self {
            frame: Matrix3::from_columns(&[along.cross(&outward), along, outward]),
            middle,
            length: asked.length,
            geometry,
            outer: nearest.triangle,
            inner,
            curvature: 0.0,
            first,
        })
    }

    /// Learns how the wall bends from its outer surface.
    pub(super) fn bend(&mut self, outer: &Gradient) {
        if let CrackGeometry::Wall { thickness, .. } = self.geometry {
            let rest = (1.0 - 0.5 * thickness * outer.curvature).max(0.5);
            self.curvature = (outer.curvature / rest).clamp(-1.0 / thickness, 1.0 / thickness);
        }
    }

    /// How many rows it has.
    pub(super) fn modes(&self) -> usize {
        match self.geometry {
            CrackGeometry::Solid { .. } => 3,
            CrackGeometry::Wall { .. } => 5,
        }
    }

    pub(super) fn rows(&self) -> std::ops::Range<usize> {
        self.first..self.first + self.modes()
    }

    pub(super) fn ends(&self) -> [Vec3; 2] {
        let half = self.frame.column(1) * (0.5 * self.length);
        [self.middle - half, self.middle + half]
    }

    /// Which of its ends meet an end of another.
    pub(super) fn meets(&self, other: &Self) -> [bool; 2] {
        let near = TOGETHER * self.length.min(other.length);
        let there = other.ends();
        self.ends()
            .map(|end| there.iter().any(|other| (other - end).norm() < near))
    }

    /// Depth of the slit in a solid, or the thickness of the wall [m].
    pub(super) fn depth(&self) -> f64 {
        match self.geometry {
            CrackGeometry::Solid { depth } => depth,
            CrackGeometry::Wall { thickness, .. } => thickness,
        }
    }
}

fn unit(vector: &Vec3) -> Option<Vec3> {
    let unit = vector.try_normalize(0.0)?;
    unit.iter().all(|x| x.is_finite()).then_some(unit)
}

/// Longest edge of a triangle [m].
fn edge(surface: &Surface, triangle: TriangleId) -> f64 {
    let [a, b, c] = surface.mesh().positions(triangle);
    (b - a).norm().max((c - b).norm()).max((a - c).norm())
}

fn crack_geometry<T: Precision>(
    body: &CutBody<'_, T>,
    middle: &Vec3,
    outward: &Vec3,
    asked: &SlitFacet,
) -> (CrackGeometry, Option<TriangleId>) {
    let mesh = body.surface.mesh();
    let (low, high) = mesh.bounds();
    let reach = (high - low).norm();
    let size = edge(body.surface, body.tree.nearest(mesh, middle).triangle);
    // The triangle at the middle is not the other side.
    let skip = 1e-3 * size;
    let along = asked.along.cross(outward);
    let along = unit(&along).unwrap_or_default();
    let across = along.cross(outward);
    // A ray that meets an edge may pass between its triangles; a shifted one does not.
    let hit = BESIDE.into_iter().find_map(|[p, q]| {
        let from = middle - outward * skip + (along * p + across * q) * size;
        let hit = body.tree.cast(mesh, &from, &-outward, reach);
        hit.filter(|hit| mesh.area_vector(hit.triangle).dot(outward) < 0.0)
    });
    match hit {
        Some(hit) if asked.depth > OF_A_WALL * (hit.distance + skip) => {
            let thickness = hit.distance + skip;
            let part = asked.depth / thickness;
            let part = if part > THROUGH { 1.0 } else { part };
            (CrackGeometry::Wall { thickness, part }, Some(hit.triangle))
        }
        _ => {
            let depth = asked.depth.min(reach);
            (CrackGeometry::Solid { depth }, None)
        }
    }
}
