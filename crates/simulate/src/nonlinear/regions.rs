//! Materials of the elements of an organ with several tissues.
//!
//! Tetrahedra do not cross the walls of cavities. An element that several tissues share has the mean of the bounds of Voigt and
//! Reuss (`Moduli::mixed`), and relaxes as the tissue that has most of it.

use palpate_geometry::{TetrahedronMesh, Vec3};
use palpate_mechanics::nonlinear::Moduli;
use palpate_mechanics::{LinearElastic, PronySeries};

use crate::regions::{RegionTissue, Regions};

/// The tissues of an element are sampled at the centroids of its parts, this many along an edge.
const PARTS: usize = 6;

/// Number of edges within an inclusion, in its smallest radius, the same with cavities, and the growth of edges away
/// from it [-].
const OF_RADIUS: f64 = 0.6;
const OF_WALL: f64 = 0.45;
const GROWTH: f64 = 0.25;

/// Sample points along a path through a wall.
const STEPS: u32 = 6;

/// The materials of the elements.
#[derive(Debug, Clone, Default)]
pub(super) struct Elements {
    pub(super) moduli: Vec<Moduli<f64>>,
    /// The tissue by which each element relaxes.
    pub(super) numbers: Vec<usize>,
    /// [kg/m³]
    pub(super) densities: Vec<f64>,
    /// Warnings.
    pub(super) warnings: Vec<String>,
}

impl Elements {
    /// Copies those of another body.
    pub(super) fn extend(&mut self, other: Self) {
        self.moduli.extend(other.moduli);
        self.numbers.extend(other.numbers);
        self.densities.extend(other.densities);
    }

    /// The same, whose tissues relax as the series after so many do.
    pub(super) fn numbered_from(mut self, series: usize) -> Self {
        self.numbers.iter_mut().for_each(|number| *number += series);
        self
    }
}

impl Regions {
    /// The mean of Young's modulus from `place` on along a `path` [m], relative to that at the surface [-].
    pub(super) fn stiffness_through(&self, place: &Vec3, path: &Vec3) -> f64 {
        let surface = self.at_rest().youngs_modulus();
        if self.tissues.len() == 1 {
            return 1.0;
        }
        let each = (0..STEPS).map(|step| {
            let on = place + path * ((f64::from(step) + 0.5) / f64::from(STEPS));
            self.tissues[self.tissue_at(&on)].law.youngs_modulus()
        });
        each.sum::<f64>() / f64::from(STEPS) / surface
    }

    /// That at rest, as the elements take it.
    pub(super) fn at_rest(&self) -> &LinearElastic {
        &self.at_surface().law
    }

    /// Relaxation of each tissue.
    pub(super) fn series(&self) -> Vec<PronySeries> {
        let series = self.tissues.iter();
        series.map(|region| region.material.prony.clone()).collect()
    }

    /// The largest Poisson's ratio of the elements [-].
    pub(super) fn largest_ratio(&self) -> f64 {
        let ratios = self
            .tissues
            .iter()
            .map(|region| region.law.poissons_ratio());
        ratios.fold(-1.0, f64::max)
    }

    /// The materials of each element of `mesh`.
    pub(super) fn of_elements(&self, mesh: &TetrahedronMesh) -> Elements {
        let count = mesh.tetrahedra().len();
        let density = |region: &RegionTissue| region.tissue.density_kg_m3.value;
        if let [only] = &self.tissues[..] {
            return Elements {
                moduli: vec![only.moduli; count],
                numbers: vec![0; count],
                densities: vec![density(only); count],
                warnings: Vec::new(),
            };
        }
        let places = parts();
        let mut elements = Elements::default();
        let mut found = vec![false; self.tissues.len()];
        for own in &self.cavities {
            found[own.number] = true;
        }
        for element in 0..count {
            let corners = mesh.positions(element);
            let mut shares = vec![0.0; self.tissues.len()];
            for barycentric in &places {
                let place = corners.iter().zip(barycentric);
                let place: Vec3 = place.map(|(corner, part)| corner * *part).sum();
                shares[self.tissue_at(&place)] += 1.0 / places.len() as f64;
            }
            let each = || self.tissues.iter().zip(&shares);
            let mixed = Moduli::mixed(each().map(|(region, share)| (region.moduli, *share)));
            let most = (0..shares.len()).max_by(|a, b| shares[*a].total_cmp(&shares[*b]));
            elements.moduli.push(mixed);
            elements.numbers.push(most.unwrap_or(0));
            let weights = each().map(|(region, share)| share * density(region));
            elements.densities.push(weights.sum());
            for (found, share) in found.iter_mut().zip(&shares) {
                *found |= *share > 0.0;
            }
        }
        let missing = self
            .names
            .iter()
            .zip(&found[1..])
            .filter(|(_, found)| !**found);
        elements.warnings.extend(missing.map(|(name, _)| {
            format!(
                "{name:?} is in no element of the nonlinear model: the organ has no place as deep, or `model.nodes` is too \
                 small for it"
            )
        }));
        elements
    }

    pub(super) fn has_inclusions(&self) -> bool {
        self.tissues.len() > 1 + self.layers
    }

    /// The edge length that the inclusions require at `place` [m].
    pub(super) fn longest_edge(&self, place: &Vec3) -> f64 {
        let of_radius = match self.cavities.is_empty() {
            true => OF_RADIUS,
            false => OF_WALL,
        };
        self.map.longest_edge_at_shapes(place, of_radius, GROWTH)
    }
}

/// Barycentric coordinates of points spread evenly over a tetrahedron.
fn parts() -> Vec<[f64; 4]> {
    let step = 1.0 / PARTS as f64;
    let at = |n: usize| (n as f64 + 0.25) * step;
    let mut places = Vec::new();
    for i in 0..PARTS {
        for j in 0..PARTS - i {
            for k in 0..PARTS - i - j {
                let [x, y, z] = [i, j, k].map(at);
                places.push([1.0 - x - y - z, x, y, z]);
            }
        }
    }
    places
}
