//! The structural compliance of the whole organ under a tip that touches it anywhere.
//!
//! The force on one moved triangle depends on its size, not on that of the tip. So a tip loads the
//! triangles around it smoothly, with weights w that sum to one, and its displacement is their mean with
//! the same weights: c = wᵀ Ξ w is energy-consistent and resolved by the mesh. A load like this on a
//! half-space yields by a closed form c_self, the tip itself by another one (its law), and
//!
//! ```text
//! d = d_tip(F) + c_ext F/E,   c_ext = wᵀ Ξ w − c_self
//! c_self = (1 + ν)/π ((1 − ν) J 1 + ν M),   J = Σ w w′ ⟨1/r⟩,   M = Σ w w′ ⟨t tᵀ/r³⟩
//! ```
//!
//! with ⟨⟩ the mean over the loaded triangle, and over the moved one where the response is of means, and t
//! the tangential part of r [Johnson 1985]. What couples normal and tangent is odd in r and falls out of
//! the sum.
//! c_ext hardly depends on the weights. They are (1 − (r/R)²)² times area and cosine, about each vertex,
//! with R = max(1.7 a, 2.2 √(2 A)); between vertices loads and c_ext go over linearly, so that a slide has
//! no steps. R > 1.69 a makes c_self less than the compliance of the tip at every ν, and the tips of several
//! tools together create no energy.
//!
//! On layers c_self is that of the load on a layered half-space, c_self times what its shape yields more there.
//!
//! Fixed triangles keep their weight and do not move, Ξ = 0. Triangles that were not prepared move as on
//! a half-space: their terms cancel in both sums.
//!
//! *How we know*: `tip_field::a_tip_on_a_hemisphere_feels_finite_elements`, `real_kidney_under_a_tip`,
//! `a_slide_has_no_steps`, `several_tips_take_work`; what else was tried: `docs/theory/boundary_elements.md`.
//!
//! *Limits*: on the anchor a tip is as stiff as its load there, not rigid; two tips nearer than R to each
//! other interact through spread forces.

use std::f64::consts::PI;

use nalgebra::Matrix3;
use palpate_geometry::{NodeId, Surface, TriangleId, on_all_cores};

use super::parts::Sampling;
use super::response::{SurfaceResponse, TouchId};
use crate::boundary_elements::{Panel, Place, Precision, Source};
use crate::{Error, Vec3};

/// Radius of the spread load in radii of the tip, and in lengths √(2 A) of the triangles there, whichever
/// is more.
const REACH_IN_RADII: f64 = 1.7;
const REACH_IN_SIZES: f64 = 2.2;

/// Triangles farther apart than this many of their lengths see each other as points.
const FAR: f64 = 5.0;

/// Nearer than this, its mean over a triangle is not its value at the centroid; a hundredth beyond.
const NEAR: f64 = 2.0;

/// Centroids of the four equal parts of a triangle, as barycentric coordinates [-].
const QUARTERS: [[f64; 3]; 4] = [
    [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
    [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0],
    [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
    [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
];

/// A share of a force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// The triangle that bears it.
    pub triangle: TouchId,
    /// Its part of the force [-].
    pub weight: f64,
}

/// An organ under a tip, wherever it can be touched.
#[derive(Debug, Clone, PartialEq)]
pub struct TipField {
    radius: f64,
    vertices: Vec<VertexLoad>,
}

/// A tip over one vertex.
#[derive(Debug, Clone, PartialEq, Default)]
struct VertexLoad {
    /// Of those that can be touched, ascending.
    shares: Vec<Share>,
    /// c_ext [1/m].
    structural: Matrix3<f64>,
    /// R [m].
    reach: f64,
    /// Compliance of the layers for the load over that of their outermost tissue: along the surface and along its normal
    /// [-].
    yields: [f64; 2],
    /// The free triangles on this side of the organ within twice that, and a triangle more; with what they
    /// see of the load, Σ w ⟨1/r⟩ [1/m].
    around: Vec<(TriangleId, f32)>,
}

/// The load of a tip at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipLoad<'a> {
    corners: [(&'a VertexLoad, f64); 3],
}

impl TipField {
    /// Of a tip whose touching area has the `radius` [m], on the `surface` that `response` is of. On all
    /// cores.
    ///
    /// # Errors
    /// When the response is that of another surface, or the radius is no length.
    pub fn new<T: Precision>(
        response: &SurfaceResponse<T>,
        surface: &Surface,
        radius: f64,
    ) -> Result<Self, Error> {
        Self::on_layers(response, surface, radius, |_| [1.0; 2])
    }

    /// The same on an organ whose layers yield more than their outermost tissue: to a load of each radius [m] along the
    /// surface and along its normal, by the factors [-] of `yields` ([`LayeredHalfSpace::compliance_ratios`]).
    ///
    /// # Errors
    /// As [`Self::new`].
    ///
    /// [`LayeredHalfSpace::compliance_ratios`]: crate::layered::LayeredHalfSpace::compliance_ratios
    pub fn on_layers<T: Precision>(
        response: &SurfaceResponse<T>,
        surface: &Surface,
        radius: f64,
        yields: impl Fn(f64) -> [f64; 2] + Sync,
    ) -> Result<Self, Error> {
        let triangles = [surface.mesh().triangles().len(), response.parts().triangles];
        if triangles[0] != triangles[1] {
            return Err(Error::OtherSurface {
                surface: triangles[0],
                response: triangles[1],
            });
        }
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(Error::NotALength {
                name: "the radius of the tip",
                found: radius,
            });
        }
        let mut vertices = vec![VertexLoad::default(); surface.mesh().vertices().len()];
        on_all_cores(vertices.iter_mut().enumerate(), |(vertex, load)| {
            let spread = Spread::about(surface, NodeId(vertex as u32), radius);
            load.shares = spread.shares(response);
            load.yields = yields(spread.reach);
            load.structural = structural_compliance(response, surface, &spread, load.yields);
            load.around = seen_from(response, surface, &spread, &load.shares);
            load.reach = spread.reach;
        });
        Ok(Self { radius, vertices })
    }

    /// The load of a tip at the point of `triangle` with the weights `barycentric` [-].
    pub fn at(
        &self,
        surface: &Surface,
        triangle: TriangleId,
        barycentric: &[f64; 3],
    ) -> TipLoad<'_> {
        let nodes = surface.mesh().corners(triangle);
        TipLoad {
            corners: [0, 1, 2].map(|k| (&self.vertices[nodes[k].index()], barycentric[k])),
        }
    }
}

impl TipLoad<'_> {
    /// c_ext [1/m], over E a compliance: that of the organ under a force on the tip less that of a
    /// half-space; symmetric.
    pub fn structural_compliance(&self) -> Matrix3<f64> {
        self.corners
            .iter()
            .map(|(load, weight)| load.structural * *weight)
            .sum()
    }

    /// R, the radius of the load [m].
    pub fn reach(&self) -> f64 {
        let corners = self.corners.iter();
        corners.map(|(load, weight)| load.reach * weight).sum()
    }

    /// Compliance of the layers for it over that of their outermost tissue: along the surface and along its normal
    /// [-].
    pub(super) fn compliance_ratios(&self) -> [f64; 2] {
        [0, 1].map(|axis| {
            let corners = self.corners.iter();
            corners.map(|(load, part)| load.yields[axis] * part).sum()
        })
    }

    /// The free triangles within twice that: of each vertex its part, with what they see of its load [1/m].
    pub(super) fn around(&self) -> impl Iterator<Item = (TriangleId, f64, f64)> {
        let corners = self.corners.iter();
        corners.flat_map(|(load, part)| {
            let around = load.around.iter();
            around.map(|&(triangle, inverse)| (triangle, *part, f64::from(inverse)))
        })
    }

    /// Triangles that bear the force, ascending: less than all of it near triangles that are fixed
    /// or were not prepared.
    pub fn shares(&self) -> impl Iterator<Item = Share> {
        let mut next = [0; 3];
        std::iter::from_fn(move || {
            let heads = [0, 1, 2].map(|k| self.corners[k].0.shares.get(next[k]));
            let triangle = heads.iter().flatten().map(|share| share.triangle).min()?;
            let mut weight = 0.0;
            for (k, head) in heads.into_iter().enumerate() {
                if let Some(share) = head.filter(|share| share.triangle == triangle) {
                    weight += share.weight * self.corners[k].1;
                    next[k] += 1;
                }
            }
            Some(Share { triangle, weight })
        })
    }
}

impl<T: Precision> SurfaceResponse<T> {
    /// Displacement of one tip from a unit force on another, times E [1/m].
    pub fn between(&self, moved: &TipLoad<'_>, loaded: &TipLoad<'_>) -> Matrix3<f64> {
        let mut sum = Matrix3::zeros();
        for there in loaded.shares() {
            for here in moved.shares() {
                let compliance = self.compliance(here.triangle, there.triangle);
                sum += compliance * (here.weight * there.weight);
            }
        }
        sum
    }

    /// Adds to `field`, three numbers for each triangle, the displacements times E [N/m] from `force` [N] on
    /// a tip.
    pub fn add_field_of_tip(&self, load: &TipLoad<'_>, force: &Vec3, field: &mut [T]) {
        let shares = load.shares();
        self.add_fields(
            shares.map(|share| (share.triangle, force * share.weight)),
            field,
        );
    }
}

/// The triangles about a vertex that a tip loads.
struct Spread {
    vertex: NodeId,
    normal: Vec3,
    /// Of the triangles at the vertex, and R [m].
    size: f64,
    reach: f64,
    /// Weights that sum to one.
    weights: Vec<(TriangleId, f64)>,
}

impl Spread {
    fn about(surface: &Surface, vertex: NodeId, radius: f64) -> Self {
        let (mesh, around) = (surface.mesh(), surface.adjacency().around(vertex));
        let area: f64 = around.iter().map(|&t| mesh.area_vector(t).norm()).sum();
        let size = (2.0 * area / around.len() as f64).sqrt();
        let reach = (REACH_IN_RADII * radius).max(REACH_IN_SIZES * size);
        let mut spread = Self {
            vertex,
            normal: surface.vertex_normals()[vertex.index()],
            size,
            reach,
            weights: Vec::new(),
        };
        let weight = |triangle| {
            let near = 1.0 - spread.distance(surface, triangle).powi(2) / reach.powi(2);
            let facing = mesh.area_vector(triangle).dot(&spread.normal);
            (triangle, near.powi(2) * facing)
        };
        let near = spread.around(surface, reach).into_iter();
        let mut weights: Vec<_> = near.map(weight).collect();
        let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
        for (_, weight) in &mut weights {
            *weight /= sum;
        }
        spread.weights = weights;
        spread
    }

    /// Of a triangle's centroid from the vertex [m].
    fn distance(&self, surface: &Surface, triangle: TriangleId) -> f64 {
        let mesh = surface.mesh();
        let centroid = mesh.positions(triangle).iter().sum::<Vec3>() / 3.0;
        (centroid - mesh.vertices()[self.vertex.index()]).norm()
    }

    /// The triangles within `reach` [m] that hang together with the vertex and face as it does, ascending.
    fn around(&self, surface: &Surface, reach: f64) -> Vec<TriangleId> {
        let (mesh, adjacency) = (surface.mesh(), surface.adjacency());
        let belongs = |&triangle: &TriangleId| {
            mesh.area_vector(triangle).dot(&self.normal) > 0.0
                && self.distance(surface, triangle) < reach
        };
        let mut found: Vec<_> = adjacency.around(self.vertex).to_vec();
        found.retain(belongs);
        let mut next = 0;
        while let Some(&triangle) = found.get(next) {
            next += 1;
            for node in mesh.corners(triangle) {
                for other in adjacency.around(node) {
                    if !found.contains(other) && belongs(other) {
                        found.push(*other);
                    }
                }
            }
        }
        found.sort();
        found
    }

    /// Shares of the touchable triangles.
    fn shares<T: Precision>(&self, response: &SurfaceResponse<T>) -> Vec<Share> {
        let touchable = |&(triangle, weight): &(TriangleId, f64)| {
            let triangle = response.find(triangle)?;
            Some(Share { triangle, weight })
        };
        self.weights.iter().filter_map(touchable).collect()
    }
}

/// The free triangles around a load, with Σ w ⟨1/r⟩ [1/m].
fn seen_from<T: Precision>(
    response: &SurfaceResponse<T>,
    surface: &Surface,
    spread: &Spread,
    shares: &[Share],
) -> Vec<(TriangleId, f32)> {
    let (mesh, sampling) = (surface.mesh(), response.parts().sampling);
    let source = |share: &Share| {
        let triangle = response.touchable()[share.triangle.index()].triangle;
        Some((share.weight, Panel::new(mesh.positions(triangle))?))
    };
    let sources: Vec<_> = shares.iter().filter_map(source).collect();
    let sees = |triangle: TriangleId| {
        let target = Panel::new(mesh.positions(triangle))?;
        let terms = sources.iter();
        let terms = terms.map(|(weight, from)| weight * mean_inverse(from, &target, sampling));
        Some((triangle, terms.sum::<f64>() as f32))
    };
    let around = spread.around(surface, 2.0 * spread.reach + spread.size);
    let free = around.into_iter().filter(|&id| !response.is_fixed(id));
    free.filter_map(sees).collect()
}

/// wᵀ Ξ w − c_self [1/m], on layers that yield more than their outermost tissue along and across the surface [-].
fn structural_compliance<T: Precision>(
    response: &SurfaceResponse<T>,
    surface: &Surface,
    spread: &Spread,
    [more_along, more_across]: [f64; 2],
) -> Matrix3<f64> {
    let parts = response.parts();
    let nu = parts.poissons_ratio;
    let tangents = Matrix3::identity() - spread.normal * spread.normal.transpose();
    let known = |&(triangle, weight): &(TriangleId, f64)| {
        let touched = response.find(triangle);
        if touched.is_none() && !response.is_fixed(triangle) {
            return None;
        }
        let panel = Panel::new(surface.mesh().positions(triangle))?;
        Some((touched, weight, panel))
    };
    let known: Vec<_> = spread.weights.iter().filter_map(known).collect();
    let (mut inverse, mut along, mut yields) = (0.0, Matrix3::zeros(), Matrix3::zeros());
    for (loaded, there, source) in &known {
        for (moved, here, target) in &known {
            let weight = there * here;
            let (inverses, alongs) = mean_distances(source, target, parts.sampling);
            inverse += weight * inverses;
            along += weight * alongs;
            if let (Some(moved), Some(loaded)) = (*moved, *loaded) {
                yields += weight * response.influence(moved, loaded);
            }
        }
    }
    let along = tangents * along * tangents;
    let normals = spread.normal * spread.normal.transpose();
    let across = normals * (more_across * (1.0 - nu) * inverse);
    let along = (tangents * ((1.0 - nu) * inverse) + along * nu) * more_along;
    let own = (across + along) * ((1.0 + nu) / PI);
    let structural = yields - own;
    0.5 * (structural + structural.transpose())
}

/// Mean of 1/r over `source`, seen from `target`, another panel or the same [1/m].
fn mean_inverse(source: &Panel, target: &Panel, sampling: Sampling) -> f64 {
    let distance = (source.centroid - target.centroid).norm();
    // A fraction of a hundredth off.
    if distance > NEAR * (2.0 * source.area).sqrt() {
        return 1.0 / distance;
    }
    mean_distances(source, target, sampling).0
}

/// Means of 1/r and r rᵀ/r³ over `source`, seen from `target`, another panel or the same [1/m].
fn mean_distances(source: &Panel, target: &Panel, sampling: Sampling) -> (f64, Matrix3<f64>) {
    let r = source.centroid - target.centroid;
    let (distance, size) = (r.norm(), (2.0 * source.area).sqrt());
    if distance > FAR * size {
        return (1.0 / distance, r * r.transpose() / distance.powi(3));
    }
    let place = if distance == 0.0 {
        Place::OnPanel
    } else {
        Place::Elsewhere
    };
    let panel = Source::new(source);
    let (inverse, along) = if sampling == Sampling::Means && distance < NEAR * size {
        let [a, b, c] = target.corners;
        let seen = QUARTERS.map(|[u, v, w]| panel.distances(&(a * u + b * v + c * w), place));
        let sum = |sum: (f64, Matrix3<f64>), one: &(f64, _)| (sum.0 + one.0, sum.1 + one.1);
        let (inverse, along) = seen.iter().fold((0.0, Matrix3::zeros()), sum);
        (0.25 * inverse, 0.25 * along)
    } else {
        panel.distances(&target.centroid, place)
    };
    (inverse / source.area, along / source.area)
}
