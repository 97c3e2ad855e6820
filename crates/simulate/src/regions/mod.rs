//! The tissues of an organ: layers, inclusions and the surrounding tissue, with the geometry of
//! `palpate_mechanics::regions`.
//!
//! The surface compliance under a tip, and under the load that represents it in a mesh, is that of a layered half-space
//! (`palpate_mechanics::layered`).

mod inclusion_table;
mod places;

pub(crate) use inclusion_table::{InclusionTable, TipExchange};
pub use places::read_inclusion;

use palpate_files::Tissue;
use palpate_files::scene::{CavityContent, Inclusion, Layer, PartContent, TissueChoice};
use palpate_files::tissue::LawName;
use palpate_geometry::{AabbTree, Surface, Vec3};
use palpate_mechanics::contact::Tip;
use palpate_mechanics::inclusion::InclusionField;
use palpate_mechanics::layered::{LayeredHalfSpace, LoadShape};
use palpate_mechanics::nonlinear::Moduli;
use palpate_mechanics::regions::RegionMap;
use palpate_mechanics::{LinearElastic, Material};

use crate::Error;
use crate::organ::read_tissue;
use crate::tool::Tool;

/// Largest Poisson's ratio in the nonlinear model [-]: volume is preserved to the percent, and a few iterations
/// suffice.
const LARGEST_RATIO: f64 = 0.49;

/// Radii [m] for which the layers are solved: the first one, and the ratio of successive ones.
const MIN_RADIUS: f64 = 1e-4;
const FACTOR: f64 = 1.2;
const RADII: usize = 45;

/// Contact areas of a sphere for which the layers are solved: the least relative to its radius, and the ratio of
/// successive ones [-].
const MIN_AREA: f64 = 3e-3;
const AREA_FACTOR: f64 = 1.12;
const AREAS: i32 = 62;

/// A tissue of the organ.
#[derive(Debug, Clone)]
pub(crate) struct RegionTissue {
    pub(crate) tissue: Tissue,
    pub(crate) material: Material,
    /// In the nonlinear model.
    pub(crate) moduli: Moduli<f64>,
    /// At rest, in the nonlinear model.
    pub(crate) law: LinearElastic,
}

/// A cavity of the organ.
#[derive(Debug, Clone)]
pub(crate) struct RegionCavity {
    /// Its number in the map.
    pub(crate) number: usize,
    pub(crate) name: String,
    pub(crate) content: CavityContent,
}

/// The tissue of every point.
#[derive(Debug, Clone)]
pub(crate) struct Regions {
    /// Of the organ, of the layers from outside, of the inclusions. That of a cavity has no element.
    pub(crate) tissues: Vec<RegionTissue>,
    pub(crate) cavities: Vec<RegionCavity>,
    pub(crate) layers: usize,
    /// Names of layers and inclusions.
    pub(crate) names: Vec<String>,
    pub(crate) map: RegionMap,
    layered: LayeredHalfSpace,
    /// Compliance of the layers to a flat tip and to a load of each radius, relative to their outermost tissue [-].
    punch: Vec<[f64; 2]>,
    load: Vec<[f64; 2]>,
    /// Warnings about the tissues, and about their simplification in the nonlinear model.
    pub(crate) warnings: Vec<String>,
    pub(crate) nonlinear_warnings: Vec<String>,
}

impl Regions {
    /// The `layers` and `inclusions` of the body within `surface` with the bounding-box tree `tree`; the rest has one
    /// tissue.
    ///
    /// # Errors
    /// When a file cannot be read, or a layer or a shape does not fit into the body.
    pub(crate) fn read(
        layers: &[Layer],
        inclusions: &[Inclusion],
        surface: &Surface,
        tree: &AabbTree,
        tissue: &Tissue,
        material: &Material,
    ) -> Result<Self, Error> {
        let (map, mut warnings) = places::read_regions(layers, inclusions, surface, tree)?;
        let mut read = |choice: &TissueChoice| {
            let (tissue, material) = read_tissue(choice)?;
            warnings.extend(material.warnings.iter().cloned());
            Ok::<_, Error>((tissue, material))
        };
        let mut nonlinear_warnings = Vec::new();
        let mut region =
            |tissue, material| RegionTissue::new(tissue, material, &mut nonlinear_warnings);
        let mut tissues = vec![region(tissue.clone(), material.clone())?];
        for layer in layers {
            let (tissue, material) = read(&layer.tissue)?;
            tissues.push(region(tissue, material)?);
        }
        let mut cavities = Vec::new();
        for inclusion in inclusions {
            let number = tissues.len();
            tissues.push(match &inclusion.content {
                PartContent::Tissue(choice) => {
                    let (tissue, material) = read(choice)?;
                    region(tissue, material)?
                }
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
        for warnings in [&mut warnings, &mut nonlinear_warnings] {
            warnings.sort();
            warnings.dedup();
        }
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
                .map(|n| layered.compliance_ratios(shape, MIN_RADIUS * FACTOR.powi(n as i32)))
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
            layered,
            tissues,
            cavities,
            warnings,
            nonlinear_warnings,
        })
    }

    /// The region of a place [m], as if cavities were filled.
    pub(crate) fn tissue_at(&self, place: &Vec3) -> usize {
        let is_tissue = |number: usize| self.cavities.iter().all(|own| own.number != number);
        self.map
            .region_below(|number| is_tissue(*number) && self.map.height(*number, place) <= 0.0)
    }

    /// Whether all of it has the same law.
    pub(crate) fn are_alike(&self) -> bool {
        let first = &self.tissues[0].tissue.elasticity;
        let mut others = self.without_organ();
        self.cavities.is_empty() && others.all(|tissue| tissue.elasticity == *first)
    }

    /// Whether all of it relaxes in the same way.
    pub(crate) fn relax_alike(&self) -> bool {
        let mut others = self.tissues.iter();
        let surface = &self.at_surface().material.prony;
        others.all(|region| region.material.prony == *surface)
    }

    /// The tissues: of the organ, of the layers from outside, of the inclusions.
    pub(crate) fn all(&self) -> impl Iterator<Item = &Tissue> {
        self.tissues.iter().map(|region| &region.tissue)
    }

    /// The closed surfaces of inclusions.
    pub(crate) fn enclosed(&self) -> impl Iterator<Item = &Surface> {
        self.map.enclosed()
    }

    /// The tissues of layers and inclusions, without that of the organ.
    pub(crate) fn without_organ(&self) -> impl Iterator<Item = &Tissue> {
        self.tissues[1..].iter().map(|region| &region.tissue)
    }

    /// The tissues of inclusions.
    pub(crate) fn of_inclusions(&self) -> impl Iterator<Item = &Tissue> {
        let inclusions = &self.tissues[1 + self.layers..];
        inclusions.iter().map(|region| &region.tissue)
    }

    /// The outermost tissue.
    pub(crate) fn at_surface(&self) -> &RegionTissue {
        &self.tissues[usize::from(self.layers > 0)]
    }

    /// Compliance of the layers to a flat tip of this radius [m], relative to the tissue at the surface: along the
    /// surface, and along its normal [-].
    pub(crate) fn yields_to_tip(&self, radius: f64) -> [f64; 2] {
        interpolate(&self.punch, radius)
    }

    /// The same for a load.
    pub(crate) fn yields_to_load(&self, radius: f64) -> [f64; 2] {
        interpolate(&self.load, radius)
    }

    /// The effect of the inclusions, and cavities, on loads on the tissue around them, with the `law` of each tissue,
    /// for compliances that are scaled to Young's modulus of the tissue `unit`.
    pub(crate) fn inclusions(
        &self,
        law: impl Fn(&RegionTissue) -> LinearElastic,
        unit: &RegionTissue,
    ) -> InclusionField {
        let around = law(&self.tissues[0]);
        let moduli = self.tissues.iter().enumerate().map(|(number, region)| {
            let cavity = self.cavities.iter().find(|own| own.number == number);
            match cavity.map(|own| own.content) {
                None => [law(region).bulk_modulus(), law(region).shear_modulus()],
                Some(CavityContent::Pressure(_)) => [0.0; 2],
                Some(CavityContent::Fluid(_)) => [around.bulk_modulus(), 0.0],
            }
        });
        let moduli: Vec<_> = moduli.collect();
        InclusionField::new(&self.map, &around, &moduli, law(unit).youngs_modulus())
    }

    /// Applies the layers to the tip of a tool, whose law is that for a flat tip of its typical radius: the contact
    /// area of a sphere grows, and with it the effect of the layers.
    pub(crate) fn apply_to_tip(&self, tool: &mut Tool) {
        let Tip::Sphere { radius } = tool.tip else {
            return;
        };
        if self.layers == 0 {
            return;
        }
        let touched = self.yields_to_tip(tool.typical_radius)[1];
        tool.law = tool.law.on_layers((0..AREAS).map(|n| {
            let area = radius * MIN_AREA * AREA_FACTOR.powi(n);
            let [deeper, stronger] = self.layered.under_sphere(area);
            (area, [deeper, touched * stronger])
        }));
    }

    /// The effective tissue under a tip of this radius [m]: the tissue at the surface, with the stiffness of the
    /// layers.
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
    fn new(tissue: Tissue, material: Material, warnings: &mut Vec<String>) -> Result<Self, Error> {
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
    let at = (radius / MIN_RADIUS).ln() / FACTOR.ln();
    let at = at.clamp(0.0, last as f64);
    let low = (at as usize).min(last.saturating_sub(1));
    let part = at - low as f64;
    let [from, to] = [table[low], table[(low + 1).min(last)]];
    [0, 1].map(|axis| (1.0 - part) * from[axis] + part * to[axis])
}
