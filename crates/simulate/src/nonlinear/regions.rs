//! The tissues of an organ: layers, inclusions and what is around them, where `palpate_mechanics::regions` says.
//!
//! Tetrahedra do not cross the walls of cavities. An element that several tissues share has the mean of the bounds of Voigt and Reuss (`Moduli::mixed`), and relaxes as
//! the tissue that has most of it.
//!
//! A tip is smaller than an element. What it meets, and what its load leaves out of the elements, are those of a layered
//! half-space (`palpate_mechanics::layered`).

use palpate_files::Tissue;
use palpate_files::scene::{CavityContent, Inclusion, Layer, PartContent, TissueChoice};
use palpate_files::tissue::LawName;
use palpate_geometry::{Surface, TetrahedronMesh, Vec3};
use palpate_mechanics::layered::{LayeredHalfSpace, LoadShape};
use palpate_mechanics::nonlinear::Moduli;
use palpate_mechanics::regions::RegionMap;
use palpate_mechanics::{LinearElastic, Material, PronySeries};

use crate::Error;
use crate::organ::read_tissue;

/// A larger Poisson's ratio is taken as this [-]: volume is kept to the percent, and a few iterations suffice.
const LARGEST_RATIO: f64 = 0.49;

/// An element is asked for its tissues at the centroids of its parts, so many along an edge.
const PARTS: usize = 6;

/// Edges in an inclusion, in its smallest radius, those where there are cavities, and by how much they grow away from it [-].
const OF_RADIUS: f64 = 0.6;
const OF_WALL: f64 = 0.45;
const GROWTH: f64 = 0.25;

/// Radii [m] for which the layers are solved: from one, each by this factor larger than the one before.
const LEAST_RADIUS: f64 = 1e-4;
const FACTOR: f64 = 1.2;

/// Places on a way through a wall.
const STEPS: u32 = 6;
const RADII: usize = 45;

/// A tissue of the organ.
#[derive(Debug, Clone)]
pub(crate) struct RegionTissue {
    pub(crate) tissue: Tissue,
    pub(crate) material: Material,
    /// As the elements take it.
    moduli: Moduli<f64>,
    /// At rest, as the elements take it.
    law: LinearElastic,
}

/// A cavity of the organ.
#[derive(Debug, Clone)]
pub(crate) struct RegionCavity {
    /// Its number in the map.
    pub(super) number: usize,
    pub(crate) name: String,
    pub(super) content: CavityContent,
}

/// Where which tissue is.
#[derive(Debug, Clone)]
pub(crate) struct Regions {
    /// Of the organ, of the layers from outside, of the inclusions. That of a cavity has no element.
    tissues: Vec<RegionTissue>,
    pub(super) cavities: Vec<RegionCavity>,
    layers: usize,
    /// Names of layers and inclusions.
    names: Vec<String>,
    pub(super) map: RegionMap,
    /// How much more than their outermost tissue the layers yield to a flat tip and to a load of each radius [-].
    punch: Vec<[f64; 2]>,
    load: Vec<[f64; 2]>,
    pub(crate) warnings: Vec<String>,
}

/// What the elements are made of.
#[derive(Debug, Clone, Default)]
pub(super) struct Elements {
    pub(super) moduli: Vec<Moduli<f64>>,
    /// The tissue that each relaxes as.
    pub(super) numbers: Vec<usize>,
    /// [kg/m³]
    pub(super) densities: Vec<f64>,
    /// Warnings.
    pub(super) warnings: Vec<String>,
}

impl Elements {
    /// Takes those of another body.
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
    /// The `layers` and `inclusions` of a body where `map` says, which is otherwise of one tissue.
    pub(crate) fn new(
        layers: &[Layer],
        inclusions: &[Inclusion],
        map: RegionMap,
        (tissue, material): (&Tissue, &Material),
    ) -> Result<Self, Error> {
        let mut warnings = Vec::new();
        let own = (tissue.clone(), material.clone());
        let mut tissues = vec![RegionTissue::new(own, &mut warnings)?];
        for layer in layers {
            tissues.push(RegionTissue::read(&layer.tissue, &mut warnings)?);
        }
        let mut cavities = Vec::new();
        for inclusion in inclusions {
            let number = tissues.len();
            tissues.push(match &inclusion.content {
                PartContent::Tissue(tissue) => RegionTissue::read(tissue, &mut warnings)?,
                PartContent::Cavity(content) => {
                    cavities.push(RegionCavity {
                        number,
                        name: inclusion.name.clone(),
                        content: *content,
                    });
                    tissues[0].clone()
                }
            });
        }
        warnings.sort();
        warnings.dedup();
        let layered = LayeredHalfSpace {
            layers: layers
                .iter()
                .zip(&tissues[1..])
                .map(|(layer, region)| (layer.thickness_m, region.law))
                .collect(),
            base: tissues[0].law,
        };
        let yields = |shape| -> Vec<[f64; 2]> {
            let radii = (0..RADII).filter(|_| !layers.is_empty());
            radii
                .map(|n| layered.yields(shape, LEAST_RADIUS * FACTOR.powi(n as i32)))
                .collect()
        };
        let names = layers.iter().map(|layer| &layer.name);
        let names = names.chain(inclusions.iter().map(|inclusion| &inclusion.name));
        Ok(Self {
            layers: layers.len(),
            names: names.cloned().collect(),
            map,
            punch: yields(LoadShape::Punch),
            load: yields(LoadShape::Bump),
            tissues,
            cavities,
            warnings,
        })
    }

    /// The region of a place [m], as if cavities were filled.
    fn tissue_at(&self, place: &Vec3) -> usize {
        let is_tissue = |number: usize| self.cavities.iter().all(|own| own.number != number);
        self.map
            .region_below(|number| is_tissue(*number) && self.map.height(*number, place) <= 0.0)
    }

    /// The mean of Young's modulus from `place` on along a `way` [m], over that at the surface [-].
    pub(super) fn stiffness_through(&self, place: &Vec3, way: &Vec3) -> f64 {
        let surface = self.at_rest().youngs_modulus();
        if self.tissues.len() == 1 {
            return 1.0;
        }
        let each = (0..STEPS).map(|step| {
            let on = place + way * ((f64::from(step) + 0.5) / f64::from(STEPS));
            self.tissues[self.tissue_at(&on)].law.youngs_modulus()
        });
        each.sum::<f64>() / f64::from(STEPS) / surface
    }

    /// The tissues: of the organ, of the layers from outside, of the inclusions.
    pub(crate) fn all(&self) -> impl Iterator<Item = &Tissue> {
        self.tissues.iter().map(|region| &region.tissue)
    }

    /// The closed surfaces of inclusions.
    pub(crate) fn enclosed(&self) -> impl Iterator<Item = &Surface> {
        self.map.enclosed()
    }

    /// Layers and inclusions: with what tissue, beside that of the organ.
    pub(crate) fn beside(&self) -> impl Iterator<Item = &Tissue> {
        self.tissues[1..].iter().map(|region| &region.tissue)
    }

    /// What lies at the outer surface.
    pub(crate) fn at_surface(&self) -> &RegionTissue {
        &self.tissues[usize::from(self.layers > 0)]
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

    /// What each element of `mesh` is made of.
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

    /// The edges that the inclusions ask for at `place` [m].
    pub(super) fn longest_edge(&self, place: &Vec3) -> f64 {
        let of_radius = match self.cavities.is_empty() {
            true => OF_RADIUS,
            false => OF_WALL,
        };
        self.map.longest_edge_at_shapes(place, of_radius, GROWTH)
    }

    /// How much more than the tissue at the surface the layers yield to a flat tip of this radius [m]: along the surface, and
    /// along its normal [-].
    pub(super) fn yields_to_tip(&self, radius: f64) -> [f64; 2] {
        interpolate(&self.punch, radius)
    }

    /// The same for a load.
    pub(super) fn yields_to_load(&self, radius: f64) -> [f64; 2] {
        interpolate(&self.load, radius)
    }

    /// What a tip of this radius [m] meets: the tissue at the surface, as stiff as the layers are to it.
    pub(crate) fn touched(&self, radius: f64) -> Result<(Tissue, Material), Error> {
        let RegionTissue {
            tissue, material, ..
        } = self.at_surface();
        if self.layers == 0 {
            return Ok((tissue.clone(), material.clone()));
        }
        let factor = 1.0 / self.yields_to_tip(radius)[1];
        let mut tissue = tissue.clone();
        tissue.elasticity = tissue.elasticity.times(factor);
        let material = Material::from_tissue(&tissue)?;
        Ok((tissue, material))
    }
}

impl RegionTissue {
    fn read(choice: &TissueChoice, warnings: &mut Vec<String>) -> Result<Self, Error> {
        let (tissue, material) = read_tissue(choice)?;
        warnings.extend(material.warnings.iter().cloned());
        Self::new((tissue, material), warnings)
    }

    fn new(
        (tissue, material): (Tissue, Material),
        warnings: &mut Vec<String>,
    ) -> Result<Self, Error> {
        let given = material.at_rest.poissons_ratio();
        let ratio = given.min(LARGEST_RATIO);
        let shear = material.at_rest.shear_modulus();
        if ratio < given {
            warnings.push(format!(
                "Poisson's ratio {given:.4} is taken as {LARGEST_RATIO} around the tips, with the same shear modulus: the \
                 nonlinear model keeps volume to the percent"
            ));
        }
        let law = tissue.elasticity.law();
        let (c10, c01) = match (law, tissue.elasticity.values().as_slice()) {
            (LawName::MooneyRivlin, &[c10, c01]) => (c10, c01),
            (LawName::Linear | LawName::NeoHookean, _) => (0.5 * shear, 0.0),
            _ => {
                warnings.push(format!(
                    "the organ around the tips answers as neo-Hookean tissue of the same modulus at rest; the tips \
                     themselves meet the {} law",
                    law.row().title
                ));
                (0.5 * shear, 0.0)
            }
        };
        Ok(Self {
            moduli: Moduli::mooney_rivlin(c10, c01, ratio)?,
            law: LinearElastic::new(2.0 * shear * (1.0 + ratio), ratio)?,
            tissue,
            material,
        })
    }
}

/// At a radius [m]; one of nothing.
fn interpolate(table: &[[f64; 2]], radius: f64) -> [f64; 2] {
    let Some(last) = table.len().checked_sub(1) else {
        return [1.0; 2];
    };
    let at = (radius / LEAST_RADIUS).ln() / FACTOR.ln();
    let at = at.clamp(0.0, last as f64);
    let low = (at as usize).min(last.saturating_sub(1));
    let part = at - low as f64;
    let [from, to] = [table[low], table[(low + 1).min(last)]];
    [0, 1].map(|axis| (1.0 - part) * from[axis] + part * to[axis])
}

/// Barycentric coordinates of places spread evenly over a tetrahedron.
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
