//! The whole organ: how its surface answers forces anywhere on it, prepared once (section 4.2).
//!
//! ```text
//! shown surface ──simplify──▶ mechanical surface ─────solved once─────▶ SurfaceResponse ◀──▶ stored file
//!       ▲                                                                     │
//!       └───────── carried by the displacements of its triangles ◀────────────┘ forces of the tips
//! ```
//!
//! A coarse mesh is enough for the mechanics, since the tip has its own law ([`TipLaw`]) and the organ
//! around it only yields further; the fine one is what is seen.
//!
//! Boundary elements solve for it, or, where walls are too thin for them (`crate::walls`) or the scene asks for
//! them, finite elements condensed to the surface. These alone have layers and inclusions, which then cost nothing in a step.
//!
//! Finer triangles around a contact are made by who looks at it ([`EnhancedSurface`]), of what a step tells
//! ([`OrganField`]).
//!
//! *How we know*: `hybrid::…`, `enhanced::…`, `thin_walls::…`, `large_organs::…`.
//!
//! *Limits*: the organ around a tip answers as at small strain; nothing of it moves through its anchor. A tip does not
//! resist that the organ turns under it.
//!
//! [`TipLaw`]: palpate_mechanics::TipLaw

mod deform;
mod enhanced_surface;
mod held;
mod key;
mod mechanical_surface;
mod method;
mod organ_slit;
mod press;
mod solve;
mod surroundings;
mod take_hold;

use std::ops::ControlFlow;
use std::path::PathBuf;

use nalgebra::Matrix3;
use palpate_files::Scene;
use palpate_files::scene::{Organ, Smoothing};
use palpate_geometry::{AabbTree, Surface, TriangleId, Vec3};
use palpate_mechanics::LinearElastic;
use palpate_mechanics::enhance::{Carrier, EnhancementModel, Press, SurfaceField};
use palpate_mechanics::finite_elements::condensed::RegionLaws;
use palpate_mechanics::regions::RegionMap;
use palpate_mechanics::surface_response::{SurfaceResponse, TipField};

use crate::regions::Regions;
use crate::tool::Tool;
use crate::walls::Walls;
use crate::{Error, Progress, Resources, held_region};
pub use enhanced_surface::{EnhancedSurface, OrganField};
use held::HeldWorkspace;
use key::Ingredients;
use method::{MOST_TETRAHEDRA, Method};
use organ_slit::OrganSlit;
use solve::Found;
pub(crate) use surroundings::surround;
use take_hold::Candidate;

/// How the whole organ answers.
#[derive(Debug, Clone)]
pub(crate) struct GlobalModel {
    /// Of the mechanical surface.
    pub(crate) response: SurfaceResponse,
    pub(crate) origin: ResponseOrigin,
    /// How displacements of its triangles are spread over it, and to the shown surface.
    pub(crate) enhancement: EnhancementModel,
    /// The vertices that are shown.
    pub(crate) carrier: Carrier,
    /// Around the mechanical surface.
    pub(crate) tree: AabbTree,
}

/// What was prepared of the whole organ, and where it came from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ResponseOrigin {
    /// How it was solved, in words.
    pub method: &'static str,
    /// Triangles that carry the mechanics.
    pub triangles: usize,
    /// Those of them that can be touched.
    pub touchable: usize,
    /// Memory that it takes [byte].
    pub bytes: usize,
    /// The file that keeps it.
    pub file: Option<PathBuf>,
    /// Whether it was read from there.
    pub was_kept: bool,
}

/// Scratch of the whole organ's part in a step.
#[derive(Debug)]
pub(crate) struct GlobalWorkspace {
    /// Compliance [m/N] of tool i to a force on tool j, at i tools + j.
    between: Vec<Matrix3<f64>>,
    held: HeldWorkspace,
    /// What cuts do to it, where the mechanics follow them.
    slit: Option<OrganSlit>,
    between_jaws: Vec<Candidate>,
    /// Displacements of triangles [m], three numbers each.
    sums: Vec<f32>,
    field: SurfaceField,
    presses: Vec<Press>,
    /// Displacements of the shown vertices [m].
    shown: Vec<Vec3>,
}

impl GlobalModel {
    /// Finds what the organ adds to a tool's tip, wherever it touches.
    pub(crate) fn lie_under(
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

    /// Scratch for so many tools on an organ that is cut or not.
    pub(crate) fn workspace(&self, tools: usize, is_cut: bool) -> GlobalWorkspace {
        let triangles = self.response.parts().triangles;
        GlobalWorkspace {
            between: vec![Matrix3::zeros(); tools * tools],
            held: HeldWorkspace::new(tools),
            slit: is_cut.then(|| OrganSlit::new(&self.response, tools)),
            between_jaws: Vec::with_capacity(self.response.touchable().len()),
            sums: vec![0.0; 3 * triangles],
            field: SurfaceField::with_room(self.enhancement.interpolation(), tools),
            presses: Vec::with_capacity(tools),
            shown: vec![Vec3::zeros(); self.carrier.places().len()],
        }
    }
}

/// What a whole organ's response is made from.
pub(crate) struct GlobalProblem<'a> {
    surface: Surface,
    poissons_ratio: f64,
    regions: Option<OrganRegions<'a>>,
    held: Vec<TriangleId>,
    touchable: Vec<TriangleId>,
    walls: Walls,
    /// Finite elements to try, the best first; without any, boundary elements are meant.
    finite: Vec<Method>,
    pub(crate) warnings: Vec<String>,
}

/// The tissues of an organ of several.
struct OrganRegions<'a> {
    map: &'a RegionMap,
    /// With moduli in parts of that at the surface.
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
    /// That of the organ of `scene`, which is seen as `shown`, of `law` at its surface, and elsewhere of that of its `regions`.
    pub(crate) fn new(
        scene: &Scene,
        shown: &Surface,
        law: &LinearElastic,
        regions: Option<&'a Regions>,
    ) -> Result<Self, Error> {
        let wanted = scene.model.mechanical_triangles;
        let (surface, warnings) = mechanical_surface::mechanical_surface(shown, wanted)?;
        let (held, touchable) = sort(&scene.organ, &surface);
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
                MOST_TETRAHEDRA,
            ),
            regions: regions.map(OrganRegions::new).transpose()?,
            walls,
            surface,
            poissons_ratio: law.poissons_ratio(),
            held,
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
        watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<(GlobalModel, Vec<String>), Error> {
        let (method, found) = self.response(resources, watch)?;
        let parts = found.response.parts();
        let origin = ResponseOrigin {
            method: method.words(),
            triangles: parts.triangles,
            touchable: parts.touchable.len(),
            bytes: size_of_val(parts.displacements.as_slice()),
            file: found.file,
            was_kept: found.was_kept,
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
            false => EnhancementModel::carrying(shown.clone(), self.surface, settings)?,
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

    /// By finite elements where they are wanted and can be, else by boundary elements.
    fn response(
        &self,
        resources: &Resources,
        watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<(Method, Found), Error> {
        let mut missed = None;
        for &method in &self.finite {
            match solve::response(&self.ingredients(method), resources, watch) {
                Ok(found) => return Ok((method, found)),
                Err(error @ Error::Model(palpate_mechanics::Error::BrokenOff)) => {
                    return Err(error);
                }
                Err(error) => missed = Some(error),
            }
        }
        if let Some(error) = missed.take_if(|_| self.regions.is_some()) {
            // Boundary elements would not feel them.
            return Err(error);
        }
        let method = Method::BoundaryElements;
        let mut found = solve::response(&self.ingredients(method), resources, watch)?;
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
            held: &self.held,
            touchable: &self.touchable,
            regions: self.regions.as_ref().map(|own| RegionLaws {
                map: own.map,
                laws: &own.laws,
            }),
        }
    }
}

/// The triangles that are held, and those that can be touched.
fn sort(organ: &Organ, surface: &Surface) -> (Vec<TriangleId>, Vec<TriangleId>) {
    let anchor = held_region(&organ.shape, organ.anchor.as_ref());
    let mesh = surface.mesh();
    let (held, free): (Vec<_>, Vec<_>) = mesh
        .triangle_ids()
        .partition(|&triangle| anchor.holds(centroid(surface, triangle)));
    let within = |&triangle: &TriangleId| {
        let region = organ.touchable.as_ref();
        region.is_none_or(|region| region.holds(centroid(surface, triangle)))
    };
    let touchable = free.into_iter().filter(within).collect();
    (held, touchable)
}

fn centroid(surface: &Surface, triangle: TriangleId) -> [f64; 3] {
    let [a, b, c] = surface.mesh().positions(triangle);
    ((a + b + c) / 3.0).into()
}
