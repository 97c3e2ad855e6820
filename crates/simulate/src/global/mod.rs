//! The organ-scale model: the response of the surface to forces anywhere on it, prepared once (section 4.2).
//!
//! ```text
//! shown surface ──simplify──▶ mechanical surface ─────solved once─────▶ SurfaceResponse ◀──▶ stored file
//!       ▲                                                                     │
//!       └───────── carried by the displacements of its triangles ◀────────────┘ forces of the tips
//! ```
//!
//! A coarse mesh is enough for the mechanics, since the tip has its own law ([`TipLaw`]) and the organ around it only
//! adds compliance; the fine mesh is for display.
//!
//! Boundary elements solve for the response, or, where walls are too thin for them (`crate::walls`) or the scene asks
//! for them, finite elements condensed to the surface. Only these have layers and inclusions, which then cost nothing
//! in a step.
//!
//! The display refines the triangles around a contact ([`EnhancedSurface`]) from the displacement field of a step
//! ([`OrganField`]).
//!
//! *How we know*: `hybrid::…`, `enhanced::…`, `thin_walls::…`, `large_organs::…`.
//!
//! *Limits*: the organ around a tip responds as at small strain; nothing of it moves through its anchor. A tip does not
//! resist a rotation of the organ under it.
//!
//! [`TipLaw`]: palpate_mechanics::TipLaw

mod deform;
mod enhanced_surface;
mod grasp_selection;
mod grasped_part;
mod key;
mod mechanical_surface;
mod method;
mod organ_slit;
mod press;
mod solve;
mod surroundings;

use std::ops::ControlFlow;
use std::path::PathBuf;

use nalgebra::Matrix3;
use palpate_files::Scene;
use palpate_files::scene::{Organ, Smoothing};
use palpate_geometry::{AabbTree, Surface, TriangleId, Vec3};
use palpate_mechanics::LinearElastic;
use palpate_mechanics::enhance::{EmbeddedDisplayPoints, EnhancementModel, Press, SurfaceField};
use palpate_mechanics::finite_elements::condensed::RegionLaws;
use palpate_mechanics::regions::RegionMap;
use palpate_mechanics::surface_response::{SurfaceResponse, TipField};

use crate::regions::Regions;
use crate::tool::Tool;
use crate::walls::Walls;
use crate::{Error, Progress, Resources, fixed_region};
pub use enhanced_surface::{EnhancedSurface, OrganField};
use grasp_selection::Candidate;
use grasped_part::GraspWorkspace;
use key::Ingredients;
use method::{MAX_TETRAHEDRA, Method};
use organ_slit::OrganSlit;
use solve::Found;
pub(crate) use surroundings::surround;

/// The organ-scale model.
#[derive(Debug, Clone)]
pub(crate) struct GlobalModel {
    /// The response of the mechanical surface.
    pub(crate) response: SurfaceResponse,
    pub(crate) origin: ResponseOrigin,
    /// How displacements of its triangles are interpolated on it, and on the displayed surface.
    pub(crate) enhancement: EnhancementModel,
    /// The displayed vertices.
    pub(crate) carrier: EmbeddedDisplayPoints,
    /// The boxes around the mechanical surface.
    pub(crate) tree: AabbTree,
}

/// The prepared organ-scale response, and its origin.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ResponseOrigin {
    /// The method of solution, in words.
    pub method: &'static str,
    /// Triangles that carry the mechanics.
    pub triangles: usize,
    /// Those of them that can be touched.
    pub touchable: usize,
    /// Its memory [byte].
    pub bytes: usize,
    /// The file that stores it.
    pub file: Option<PathBuf>,
    /// Whether it was read from that file.
    pub was_cached: bool,
}

/// Scratch of the organ-scale model in a step.
#[derive(Debug)]
pub(crate) struct GlobalWorkspace {
    /// Compliance [m/N] of tool i to a force on tool j, at i tools + j.
    between: Vec<Matrix3<f64>>,
    held: GraspWorkspace,
    /// The effect of cuts on it, if the mechanics follow them.
    slit: Option<OrganSlit>,
    between_jaws: Vec<Candidate>,
    /// Displacements of triangles [m], three numbers each.
    sums: Vec<f32>,
    field: SurfaceField,
    presses: Vec<Press>,
    /// Displacements of the displayed vertices [m].
    shown: Vec<Vec3>,
}

impl GlobalModel {
    /// Computes the compliance that the organ adds to a tool's tip, at every contact location.
    pub(crate) fn apply_to_tip(
        &self,
        tool: &mut Tool,
        regions: Option<&Regions>,
    ) -> Result<(), Error> {
        let surface = self.enhancement.interpolation().surface();
        let (response, radius) = (&self.response, tool.typical_radius);
        tool.field = Some(match regions {
            None => TipField::new(response, surface, radius)?,
            Some(regions) => {
                let yields = |load| regions.yields_to_load(load);
                TipField::on_layers(response, surface, radius, yields)?
            }
        });
        Ok(())
    }

    /// Scratch for this number of tools on an organ with or without cuts.
    pub(crate) fn workspace(&self, tools: usize, is_cut: bool) -> GlobalWorkspace {
        let triangles = self.response.parts().triangles;
        GlobalWorkspace {
            between: vec![Matrix3::zeros(); tools * tools],
            held: GraspWorkspace::new(tools),
            slit: is_cut.then(|| OrganSlit::new(&self.response, tools)),
            between_jaws: Vec::with_capacity(self.response.touchable().len()),
            sums: vec![0.0; 3 * triangles],
            field: SurfaceField::with_capacity(self.enhancement.interpolation(), tools),
            presses: Vec::with_capacity(tools),
            shown: vec![Vec3::zeros(); self.carrier.places().len()],
        }
    }
}

/// The inputs of an organ-scale response.
pub(crate) struct GlobalProblem<'a> {
    surface: Surface,
    poissons_ratio: f64,
    regions: Option<OrganRegions<'a>>,
    fixed: Vec<TriangleId>,
    touchable: Vec<TriangleId>,
    walls: Walls,
    /// Finite-element settings to try, the best first; if empty, boundary elements are used.
    finite: Vec<Method>,
    pub(crate) warnings: Vec<String>,
}

/// The tissues of an organ with several.
struct OrganRegions<'a> {
    map: &'a RegionMap,
    /// With moduli relative to that at the surface.
    laws: Vec<LinearElastic>,
}

impl<'a> OrganRegions<'a> {
    fn new(regions: &'a Regions) -> Result<Self, Error> {
        let unit = regions.at_surface().material.at_rest.youngs_modulus();
        let laws = regions.tissues.iter().map(|region| {
            let law = &region.material.at_rest;
            LinearElastic::new(law.youngs_modulus() / unit, law.poissons_ratio())
        });
        Ok(Self {
            map: &regions.map,
            laws: laws.collect::<Result<_, _>>()?,
        })
    }
}

impl<'a> GlobalProblem<'a> {
    /// The inputs for the organ of `scene`, displayed as `shown`, with `law` at its surface, and elsewhere with those
    /// of its `regions`.
    pub(crate) fn new(
        scene: &Scene,
        shown: &Surface,
        law: &LinearElastic,
        regions: Option<&'a Regions>,
    ) -> Result<Self, Error> {
        let wanted = scene.model.mechanical_triangles;
        let (surface, warnings) = mechanical_surface::mechanical_surface(shown, wanted)?;
        let (fixed, touchable) = sort(&scene.organ, &surface);
        if touchable.is_empty() {
            return Err(Error::NothingTouchable);
        }
        let walls = Walls::new(&surface, &touchable);
        Ok(Self {
            finite: Method::finite(
                scene.model.response,
                regions.is_some(),
                &surface,
                &walls,
                MAX_TETRAHEDRA,
            ),
            regions: regions.map(OrganRegions::new).transpose()?,
            walls,
            surface,
            poissons_ratio: law.poissons_ratio(),
            fixed,
            touchable,
            warnings,
        })
    }

    /// The model, with warnings.
    pub(crate) fn solve(
        self,
        scene: &Scene,
        shown: &Surface,
        resources: &Resources,
        on_progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<(GlobalModel, Vec<String>), Error> {
        let (method, found) = self.response(resources, on_progress)?;
        let parts = found.response.parts();
        let origin = ResponseOrigin {
            method: method.words(),
            triangles: parts.triangles,
            touchable: parts.touchable.len(),
            bytes: size_of_val(parts.displacements.as_slice()),
            file: found.file,
            was_cached: found.was_cached,
        };
        let same = self.surface.mesh() == shown.mesh();
        let tree = AabbTree::new(self.surface.mesh());
        let mut settings = scene.model.enhancement;
        if !same && settings.smoothing == Smoothing::None {
            // A fine surface would show the facets of the coarse one.
            settings.smoothing = Smoothing::MovingLeastSquares;
        }
        let enhancement = match same {
            true => EnhancementModel::new(self.surface, settings)?,
            false => EnhancementModel::with_display_mesh(shown.clone(), self.surface, settings)?,
        };
        let model = GlobalModel {
            response: found.response,
            origin,
            carrier: enhancement.carrier(),
            enhancement,
            tree,
        };
        Ok((model, [self.warnings, found.warnings].concat()))
    }

    /// By finite elements if they are requested and possible, else by boundary elements.
    fn response(
        &self,
        resources: &Resources,
        on_progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<(Method, Found), Error> {
        let mut missed = None;
        for &method in &self.finite {
            match solve::response(&self.ingredients(method), resources, on_progress) {
                Ok(found) => return Ok((method, found)),
                Err(error @ Error::Model(palpate_mechanics::Error::Cancelled)) => {
                    return Err(error);
                }
                Err(error) => missed = Some(error),
            }
        }
        if let Some(error) = missed.take_if(|_| self.regions.is_some()) {
            // Boundary elements would ignore them.
            return Err(error);
        }
        let method = Method::BoundaryElements;
        let mut found = solve::response(&self.ingredients(method), resources, on_progress)?;
        found.warnings.extend(missed.map(|error| {
            format!(
                "the organ is solved by boundary elements, for finite elements have none: {error}"
            )
        }));
        found
            .warnings
            .extend(self.walls.warning(&self.walls.instead()));
        Ok((method, found))
    }

    fn ingredients(&self, method: Method) -> Ingredients<'_> {
        Ingredients {
            method,
            surface: &self.surface,
            poissons_ratio: self.poissons_ratio,
            fixed: &self.fixed,
            touchable: &self.touchable,
            regions: self.regions.as_ref().map(|own| RegionLaws {
                map: own.map,
                laws: &own.laws,
            }),
        }
    }
}

/// The fixed triangles, and the touchable ones.
fn sort(organ: &Organ, surface: &Surface) -> (Vec<TriangleId>, Vec<TriangleId>) {
    let anchor = fixed_region(&organ.shape, organ.anchor.as_ref());
    let mesh = surface.mesh();
    let (fixed, free): (Vec<_>, Vec<_>) = mesh
        .triangle_ids()
        .partition(|&triangle| anchor.contains(centroid(surface, triangle)));
    let within = |&triangle: &TriangleId| {
        let region = organ.touchable.as_ref();
        region.is_none_or(|region| region.contains(centroid(surface, triangle)))
    };
    let touchable = free.into_iter().filter(within).collect();
    (fixed, touchable)
}

fn centroid(surface: &Surface, triangle: TriangleId) -> [f64; 3] {
    let [a, b, c] = surface.mesh().positions(triangle);
    ((a + b + c) / 3.0).into()
}
