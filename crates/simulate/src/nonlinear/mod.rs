//! The whole organ at large deformation: `model.kind = "nonlinear"`.
//!
//! ```text
//! surface ──fill, coarsen──▶ quadratic tetrahedra ──factors at rest──▶ NonlinearModel
//!                                                                          │
//! tips, jaws ──touch: loads, couplings──▶ one step of Newton's method ◀────┘
//!                                               │
//!                          forces ◀─────────────┴──▶ shape: the surface that is seen
//! ```
//!
//! A tip loads the surface around the place that it touches, wide enough for the elements to resolve it, and is in
//! series with what such a load leaves out of its own law, as with the hybrid model ([`TipField`]). Here it is so about
//! the present state: place, normal and frame go with the organ, and what the organ yields is solved anew in every step.
//! Jaws hold as a bonded flat tip of their faces' area does, and pull.
//!
//! *How we know*: `nonlinear::…`.
//!
//! Layers and inclusions are tissues of their own elements (`regions`).
//!
//! Neighbours that collide keep the organ out (`neighbours`); those that bend, and further organs, are pieces of the body
//! (`soft`).
//!
//! Shafts are in contact with what bends (`shafts`).
//!
//! *Limits*: quasi-static. A body that is nearly incompressible is taken with a Poisson's ratio of 0.49.
//!
//! [`TipField`]: palpate_mechanics::surface_response::TipField

mod anchor;
mod hold;
mod mesh_warnings;
mod neighbours;
mod regions;
mod shafts;
mod shape;
mod soft;
mod target;
mod touch;

use anchor::Anchor;
use mesh_warnings::mesh_warnings;
use neighbours::{Candidates, Skin};
use regions::Elements;
pub(crate) use regions::Regions;
pub(crate) use shafts::Pushed;
use shafts::{Pierced, ShaftMotion, ShaftSkin};
pub(crate) use soft::SoftBody;
use soft::{Merged, Piece, touching};
pub(crate) use touch::Moved;

use std::ops::ControlFlow;

use nalgebra::Rotation3;
use palpate_files::Scene;
use palpate_geometry::{
    AabbTree, FillSettings, NodeId, Surface, TetrahedronError, TetrahedronMesh, TriangleMesh, Vec3,
    coarsen, fill, refine_to,
};
use palpate_mechanics::contact::{Tip, hertz_force};
use palpate_mechanics::nonlinear::{
    EmbeddedPoints, NonlinearModel, NonlinearState, SpreadLoad, TouchingBoundary, Workspace,
};
use palpate_mechanics::{ForceHistory, LinearElastic};

use crate::grip::Swept;
use crate::neighbour::Neighbour;
use crate::preparation::{Progress, Work, tell};
use crate::shaft::Shaft;
use crate::tool::Tool;
use crate::walls::Thickness;
use crate::{Error, held_region};

/// About so many nodes, if the scene does not say.
const NODES: usize = 1_500;

/// Tetrahedra of the first filling for each node that is wanted, and by how much they become more where walls are lost.
const TETRAHEDRA_PER_NODE: usize = 8;
const MORE: usize = 3;

/// Part of the time to make it that the tetrahedra take [-].
const FILLED: f64 = 0.5;

/// Edges that are made coarser, in those that are wanted [-].
const OF_EDGE: f64 = 0.6;

/// Where a body is thinner than so many edges, they are shorter in proportion [-], by a factor of [`MOST_GRADED`] at most: rims and
/// lobes bend within their thickness. With twice as much grading the bulk becomes too coarse for a tip. A body that is a wall of
/// one element is not graded, nor are neighbours, whose short edges at a rim fold where a stiffer organ presses them.
const THIN: f64 = 3.0;
const MOST_GRADED: f64 = 3.0;

/// Fillings to try.
const FILLINGS: usize = 5;

/// Iterations in a step: below, and from this Poisson's ratio [-] on more (`docs/theory/large_deformation.md`).
const ITERATIONS: (usize, usize) = (4, 6);
/// The same where the body touches itself: bodies push one another until they are in equilibrium.
const ITERATIONS_TOUCHING: usize = 8;
const NEARLY_INCOMPRESSIBLE: f64 = 0.46;

/// R of a load over the touching area's radius [-]: it then yields less than the tip itself.
const REACH_IN_RADII: f64 = 1.7;

/// An organ that bends. Built once.
#[derive(Debug, Clone)]
pub(crate) struct NonlinearOrgan {
    pub(crate) model: NonlinearModel,
    /// The organ, then the neighbours that bend.
    pieces: Vec<Piece>,
    shown: EmbeddedPoints,
    skin: Skin,
    shaft_skin: ShaftSkin,
    /// How they touch one another, if anything does.
    touching: Option<TouchingBoundary>,
    /// The shown surface as the organ hangs under its weight, if it has any.
    hangs: Option<(TriangleMesh, AabbTree)>,
    iterations: usize,
    /// Of its bounds, across [m]: nothing of it goes farther.
    size: f64,
}

/// Where the organ is, and what the tools do to it.
#[derive(Debug, Clone)]
pub(crate) struct Body {
    state: NonlinearState,
    /// Whether it has come back to rest since it was touched.
    is_at_rest: bool,
    /// Per tool.
    loads: Vec<SpreadLoad>,
    /// Which piece each tool touched last.
    on: Vec<usize>,
    /// Which tools act on it; those that have let go, for so many steps more at most.
    is_loaded: Vec<bool>,
    lets_go: Vec<u32>,
    /// Elastic forces of the tools in the past, and how what they load was turned then.
    histories: Vec<ForceHistory>,
    turns: Vec<Rotation3<f64>>,
    /// Where the shaft of each tool is, and how far it may go before it may touch the body at rest [m].
    shafts: Vec<Option<Shaft>>,
    clear_of_shafts: Vec<f64>,
    pierced: Vec<Pierced>,
}

/// Scratch of its part in a step.
#[derive(Debug)]
pub(crate) struct NonlinearWorkspace {
    solver: Workspace,
    targets: Vec<Option<target::Target>>,
    shafts: Vec<Option<ShaftMotion>>,
    candidates: Candidates,
    /// Displacements of the shown vertices [m].
    shown: Vec<Vec3>,
}

/// What is beside the organ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Beside<'a> {
    /// The tools that may touch it.
    pub(crate) tools: &'a [Tool],
    /// The neighbours that bend.
    pub(crate) soft: &'a [SoftBody],
    /// The rigid ones that keep it out.
    pub(crate) neighbours: &'a [Neighbour],
}

impl NonlinearOrgan {
    /// That of the organ of `scene` with this surface and its tissues, which is seen as `shown` together with the neighbours
    /// that bend; with warnings.
    pub(crate) fn new(
        scene: &Scene,
        (shown, tree): (&Surface, &AabbTree),
        (surface, regions): (&Surface, Regions),
        beside: Beside<'_>,
        watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<(Self, Vec<String>), Error> {
        tell(watch, Progress::begin(Work::Tetrahedra))?;
        let Beside {
            tools,
            soft,
            neighbours,
        } = beside;
        let nodes = scene.model.nodes.unwrap_or(NODES);
        let organ = tetrahedra(surface, nodes, &regions, grading(surface, nodes))?;
        let mut series = regions.series();
        let own = regions.of_elements(&organ);
        let filled = soft
            .iter()
            .map(|body| tetrahedra(&body.surface, body.nodes, &body.regions, |_| 1.0));
        let filled = filled.collect::<Result<Vec<_>, _>>()?;
        let anchor = held_region(&scene.organ.shape, scene.organ.anchor.as_ref());
        let anchor = Anchor::new(surface, |place| anchor.holds((*place).into()));
        let mut of_meshes = mesh_warnings(surface, nodes, &organ, &anchor);
        let of_soft = soft
            .iter()
            .map(|body| Anchor::new(&body.surface, |place| body.holds(place)));
        let of_soft: Vec<_> = of_soft.collect();
        for ((body, mesh), anchor) in soft.iter().zip(&filled).zip(&of_soft) {
            of_meshes.extend(mesh_warnings(&body.surface, body.nodes, mesh, anchor));
        }
        let mut elements = own;
        for (body, mesh) in soft.iter().zip(&filled) {
            elements.extend(body.regions.of_elements(mesh), series.len());
            series.extend(body.regions.series());
        }
        let merged = Merged::new(organ, filled)?;
        let Elements {
            moduli,
            numbers,
            densities,
            mut warnings,
        } = elements;
        warnings.extend(of_meshes);
        warnings.extend(regions.warnings.iter().cloned());
        let is_fixed = |tetrahedron: usize, place: &Vec3| {
            let number = merged.pieces[tetrahedron].checked_sub(1);
            match number {
                None => anchor.fixes(place),
                Some(number) => of_soft[number as usize].fixes(place),
            }
        };
        let (work, part) = (Work::Factors, FILLED);
        tell(watch, Progress { work, part })?;
        let mut model = NonlinearModel::on_boundary(&merged.mesh, &moduli, is_fixed)?
            .relaxing(&series, &numbers)?;
        if let Some(gravity) = scene.model.gravity_m_per_s2 {
            model = model.under_gravity(&densities, &gravity.into())?;
        }
        let mut embedded = EmbeddedPoints::default();
        let mut vertices = shown.mesh().vertices();
        let surfaces = std::iter::once(surface).chain(soft.iter().map(|body| &body.surface));
        for (surface, range) in surfaces.zip(&merged.ranges) {
            let (own, others) = vertices.split_at(surface.mesh().vertices().len());
            embedded.extend(model.embed(own, range.clone())?);
            vertices = others;
        }
        let hangs = scene.model.gravity_m_per_s2.map(|_| {
            let rest = NonlinearState::at_rest(&model, 0);
            let mut mesh = shown.mesh().clone();
            let moved = embedded.displacements(&rest);
            for (number, (from, by)) in shown.mesh().vertices().iter().zip(moved).enumerate() {
                mesh.move_vertex(NodeId(number as u32), from + by);
            }
            let tree = AabbTree::new(&mesh);
            (mesh, tree)
        });
        let (low, high) = shown.mesh().bounds();
        let ratios = soft.iter().map(|body| body.regions.largest_ratio());
        let ratio = ratios.fold(regions.largest_ratio(), f64::max);
        let pieces = Piece::all((surface, regions), soft, tools);
        let organ = Self {
            shaft_skin: ShaftSkin::new(&model, (shown, tree), &pieces),
            size: (high - low).norm(),
            shown: embedded,
            skin: Skin::new(&model, (shown, tree), neighbours),
            hangs,
            iterations: match ratio < NEARLY_INCOMPRESSIBLE {
                true => ITERATIONS.0,
                false => ITERATIONS.1,
            },
            pieces,
            touching: touching(scene, &model, (&merged, soft))?,
            model,
        };
        Ok((organ, warnings))
    }

    /// The shown surface and its boxes as the organ hangs under its weight, if it has any.
    pub(crate) fn hangs(&self) -> Option<(&TriangleMesh, &AabbTree)> {
        self.hangs.as_ref().map(|(mesh, tree)| (mesh, tree))
    }

    /// The organ at rest, which so many tools may touch.
    pub(crate) fn at_rest(&self, tools: usize) -> Body {
        Body {
            state: NonlinearState::at_rest(&self.model, tools),
            is_at_rest: true,
            loads: vec![self.model.spread_load(); tools],
            on: vec![0; tools],
            is_loaded: vec![false; tools],
            lets_go: vec![0; tools],
            histories: vec![ForceHistory::default(); tools],
            turns: vec![Rotation3::identity(); tools],
            shafts: vec![None; tools],
            clear_of_shafts: vec![0.0; tools],
            pierced: vec![0; tools],
        }
    }

    pub(crate) fn workspace(&self, tools: usize) -> NonlinearWorkspace {
        NonlinearWorkspace {
            solver: self.model.workspace(tools),
            targets: vec![None; tools],
            shafts: vec![None; tools],
            candidates: Candidates::new(self, tools),
            shown: vec![Vec3::zeros(); self.shown.len()],
        }
    }

    /// Radius of the load of a tool's tip [m] under so much force [N] on tissue of `law`.
    fn reach(tool: &Tool, law: &LinearElastic, force: f64) -> f64 {
        let touching = match tool.tip {
            Tip::Flat { radius } => radius,
            Tip::Sphere { radius } => {
                // The inverse of Hertz's law. How deep it is in all says nothing: a thin wall bends away.
                let depth = (force / hertz_force(law, radius, 1.0)).powf(2.0 / 3.0);
                tool.tip.contact_radius(depth)
            }
        };
        REACH_IN_RADII * touching
    }
}

/// Radius of a disc with the area of a jaw's face [m].
fn jaws_radius(tool: &Tool) -> Option<f64> {
    let face = Swept::face(&tool.jaws?);
    Some((face / std::f64::consts::PI).sqrt())
}

/// A filling of about `wanted` tetrahedra, or of more where walls are lost. Where it has other holes than `surface`, as
/// across a thin wall, one finer filling is tried.
fn filled(surface: &Surface, mut wanted: usize) -> Result<TetrahedronMesh, TetrahedronError> {
    let of = |wanted| fill(surface, &FillSettings::with_about(surface, wanted));
    let mut filling = of(wanted);
    for _ in 1..FILLINGS {
        if filling.is_ok() {
            break;
        }
        wanted *= MORE;
        filling = of(wanted);
    }
    let is_faithful = |mesh: &TetrahedronMesh| has_topology_of(surface, mesh);
    if filling.as_ref().is_ok_and(|mesh| !is_faithful(mesh)) {
        let finer = of(MORE * wanted);
        if finer.as_ref().is_ok_and(is_faithful) {
            return finer;
        }
    }
    filling
}

/// Whether the boundary of `filling` is a closed surface with the Euler characteristic of `surface`.
fn has_topology_of(surface: &Surface, filling: &TetrahedronMesh) -> bool {
    let euler = |of: &Surface| {
        let mesh = of.mesh();
        2 * mesh.vertices().len() as i64 - mesh.triangles().len() as i64
    };
    filling
        .boundary_surface()
        .is_ok_and(|boundary| euler(&boundary) == euler(surface))
}

/// By what factor edges are shorter where the body within `surface` is thin, if it has so many nodes [-].
fn grading(surface: &Surface, nodes: usize) -> impl Fn(&Vec3) -> f64 {
    let edge = FillSettings::with_about(surface, nodes).edge;
    let thickness = Thickness::new(surface);
    let is_wall = thickness.typical() < edge;
    move |place| match is_wall {
        true => 1.0,
        false => (THIN * edge / thickness.at(place)).clamp(1.0, MOST_GRADED),
    }
}

/// About so many nodes in the body within `surface`: a filling that has all of its walls, made coarser; its edges are shorter
/// at inclusions, and by the factor `finer` [-].
fn tetrahedra(
    surface: &Surface,
    nodes: usize,
    regions: &Regions,
    finer: impl Fn(&Vec3) -> f64,
) -> Result<TetrahedronMesh, Error> {
    let edge = FillSettings::with_about(surface, nodes).edge;
    let longest = |place: &Vec3| regions.longest_edge(place).min(edge);
    let mut filling = filled(surface, TETRAHEDRA_PER_NODE * nodes);
    if regions.has_inclusions() {
        filling = filling
            .and_then(|coarse| refine_to(&coarse, Some(surface), |place| OF_EDGE * longest(place)));
    }
    let detail = |place: &Vec3| finer(place) * edge / longest(place);
    let mesh = filling.and_then(|fine| coarsen(&fine, surface, nodes, detail));
    mesh.map_err(|error| palpate_mechanics::Error::from(error).into())
}
