use std::collections::BTreeSet;
use std::sync::Arc;

use palpate_geometry::NodeId;

use super::super::cavity::Cavity;
use super::super::estimate::{Estimated, Meshes, Progress, Quantity, refine};
use super::super::mesh::ElementMesh;
use super::super::model::{FiniteElementModel, FiniteElementWorkspace, Formulation};
use super::super::rigid_tool::{ContactSurface, Contacts, RigidTool};
use super::answer::SolidAnswer;
use super::cavities::SolidMesh;
use super::error::SolidError;
use super::frame::{Conditions, Frame};
use super::grading::MeshContext;
use super::loads::{self, BoundaryLoads};
use super::mesh::{Face, faces};
use super::problem::{Body, RegionContent, SolidProblem, SolidRegion};
use super::solve::{ToolIncrement, equilibrium};
use super::supports::PrescribedNodes;
use crate::contact::FrictionLaw;
use crate::{Error, FibreError, Law, Vec3};

/// More unknowns than these are refused: their factors would have about ten gigabytes.
const MAX_UNKNOWNS: usize = 600_000;

/// The last mesh is solved when the one before had at most so many unknowns, since it has about two and a
/// half times as many.
const MAX_BEFORE_LAST: usize = 150_000;

/// Stress is infinite along the edges of patch and anchor, as the root of the distance, and elsewhere
/// elements follow so that errors fall alike.
const MESHES: Meshes<'static> = Meshes {
    sizes: &[8.0, 4.0, 2.0, 1.0],
    order: 1.0,
};

/// The force of a patch and the displacement of the body, to the relative `accuracy` [-] if four meshes give it; on a
/// body too large for the last the remaining error is stated too.
///
/// # Errors
/// When the problem is none (no anchor, neither a patch nor a load, a load on no part of the body), too large for the
/// memory, or cannot be followed to its end.
pub fn solve(
    problem: &SolidProblem,
    accuracy: f64,
    progress: &mut dyn FnMut(Progress),
) -> Result<Estimated<SolidAnswer>, Error> {
    problem.check()?;
    let context = MeshContext::new(problem)?;
    let mut unknowns = 0;
    refine(&MESHES, accuracy, |mesh| {
        if unknowns > MAX_BEFORE_LAST {
            return Ok(None);
        }
        let answer = problem.solve_on(&context, mesh, progress)?;
        unknowns = answer.unknowns;
        let mut quantities = vec![Quantity::new(
            "displacement of the body",
            vec![answer.mean_displacement],
        )];
        if problem.patch.is_some() {
            quantities.push(Quantity::new("force", vec![answer.force_along]));
        }
        if !problem.tools.is_empty() {
            let forces = (0..problem.tools.len()).map(|tool| answer.force_on_tool(tool));
            quantities.push(Quantity::new("force of the tools", forces.collect()));
        }
        if !answer.points.is_empty() {
            let squares = answer.points.iter().map(Vec3::norm_squared);
            let mean = squares.sum::<f64>() / answer.points.len() as f64;
            quantities.push(Quantity::new(
                "displacement of the points",
                vec![mean.sqrt()],
            ));
        }
        // Zero has no relative error.
        let pressures = answer.cavities.iter().map(|cavity| cavity.pressure);
        let pressures: Vec<_> = pressures.filter(|pressure| *pressure != 0.0).collect();
        if !pressures.is_empty() {
            quantities.push(Quantity::new("pressure of the cavities", pressures));
        }
        if !answer.cavities.is_empty() {
            // Flat sides cut off a part of both volumes.
            let growths = answer.cavities.iter();
            let growths = growths.map(|cavity| cavity.volume / cavity.volume_at_rest);
            quantities.push(Quantity::new("growth of the cavities", growths.collect()));
        }
        Ok(Some((answer, quantities)))
    })
}

/// The same on one mesh, whose elements at the edges of patch and anchor were halved `halvings` times, or
/// doubled where that is −1.
///
/// # Errors
/// See [`solve`].
pub fn solve_at(
    problem: &SolidProblem,
    halvings: i32,
    progress: &mut dyn FnMut(Progress),
) -> Result<SolidAnswer, Error> {
    problem.check()?;
    let context = MeshContext::new(problem)?;
    problem.solve_on(&context, (halvings + 1).max(0) as usize, progress)
}

impl SolidProblem {
    fn solve_on(
        &self,
        context: &MeshContext<'_>,
        mesh: usize,
        progress: &mut dyn FnMut(Progress),
    ) -> Result<SolidAnswer, Error> {
        progress(Progress { part: 0.0, mesh });
        let graded = context.mesh(mesh as i32 - 1)?;
        let missing = context.missing(&graded.mesh);
        let crossing = graded.crossing;
        let solid = SolidMesh::new(self, graded.mesh)?;
        let tetrahedra = &solid.mesh;
        let corners = tetrahedra.vertices().len();
        let unknowns = 4 * corners + 3 * tetrahedra.edges().len();
        if unknowns > MAX_UNKNOWNS {
            return Err(Error::TooManyUnknowns {
                unknowns,
                most: MAX_UNKNOWNS,
            });
        }
        let prescribed = PrescribedNodes::new(self, tetrahedra, &solid.outer, context.center())?;
        let on_surface = BoundaryLoads::new(&self.loads.on_surface, tetrahedra, &solid.outer)?;
        let places = loads::places(&self.points, tetrahedra, &faces(tetrahedra))?;
        let frame = Frame::new(self.patch.as_ref());
        let elements = frame.mesh_in_frame(ElementMesh::from_tetrahedra(tetrahedra));
        let regions: Vec<u32> = (0..tetrahedra.tetrahedra().len())
            .map(|number| tetrahedra.region(number))
            .collect();
        let laws = std::iter::once(&self.law);
        // A cavity has no element that would take its law.
        let laws = laws.chain(
            self.regions
                .iter()
                .map(|region| region.law().unwrap_or(&self.law)),
        );
        let laws: Vec<_> = laws.cloned().collect();
        let mut model =
            FiniteElementModel::with_regions(elements, &laws, &regions, Formulation::Mixed)?;
        if let Some(fibres) = &self.fibres {
            model =
                model.in_frames(|place| frame.fibres_in_frame(&fibres.at(&frame.in_scene(place))));
        }
        let fluids: Vec<_> = solid.fluids().collect();
        let is_under_pressure = fluids.iter().any(|(_, pressure)| *pressure != 0.0);
        // The fluids' volumes are found first.
        let begin = if is_under_pressure { 0.5 } else { 0.0 };
        let growths = match is_under_pressure {
            true => growths(&model, &frame, &prescribed, &fluids, &mut |part| {
                let part = begin * part;
                progress(Progress { part, mesh });
            })?,
            false => Vec::new(),
        };
        let tools: Vec<RigidTool> = self
            .tools
            .iter()
            .map(|tool| frame.tool_in_frame(tool))
            .collect();
        let rest = tetrahedra.vertices();
        let surface = ContactSurface::new(
            solid.outer.iter().map(|face| face.nodes),
            &model.mesh.nodes,
            |node| {
                let mut met = self.tools.iter().zip(context.footprints.iter());
                met.any(|(tool, footprint)| footprint.may_touch(tool, &rest[node]))
            },
        );
        let fluids = fluids.into_iter().map(|(wall, _)| wall.clone()).collect();
        let model = model.with_couplings(fluids, surface.couplings())?;
        let contacts = (!tools.is_empty()).then(|| Contacts::new(&surface, &tools));
        let mut workspace = FiniteElementWorkspace::new(&model)?;
        let mut load = match &self.loads.weight {
            Some(weight) => {
                let gravity = frame.in_frame(&weight.gravity);
                model.body_load(|element, _| {
                    let number = regions[element] as usize;
                    let region = number.checked_sub(1).and_then(|at| self.regions.get(at));
                    region
                        .and_then(SolidRegion::density)
                        .unwrap_or(weight.density)
                        * gravity
                })
            }
            None => vec![0.0; model.size()],
        };
        for (node, force) in on_surface.forces {
            for (axis, force) in frame.in_frame(&force).iter().enumerate() {
                load[3 * node + axis] += force;
            }
        }
        let conditions = Conditions {
            frame: &frame,
            prescribed: &prescribed,
            load: &load,
            pressures: &solid.pressures().collect::<Vec<_>>(),
            pressed: &on_surface.pressures,
            growths: &growths,
        };
        let solved = equilibrium(&model, &conditions, contacts, &mut workspace, &mut |part| {
            let part = begin + (1.0 - begin) * part;
            progress(Progress { part, mesh });
        })?;
        let state = solved.state;
        let along = self.patch.map(|patch| patch.displacement);
        let mut answer = SolidAnswer::new(&model, &state, &workspace, &conditions, along.as_ref());
        let moved = |place: &loads::Place| {
            let parts = place.iter();
            parts
                .map(|(node, part)| *part * answer.fields.displacements[*node])
                .sum()
        };
        answer.cavities = solid.answers(&model, &state);
        answer.points = places.iter().map(moved).collect();
        answer.fields.surface = solid.surface();
        if let Some(contacts) = &solved.contacts {
            answer.warnings = self.passed_through(&surface, &solid.outer, &answer);
            answer
                .fields
                .set_contact_pressures(&surface, &contacts.pressures());
            let increments = solved.increments.into_iter();
            let back = increments.map(|ToolIncrement { along, loads }| ToolIncrement {
                along,
                loads: loads.iter().map(|load| frame.load_in_scene(load)).collect(),
            });
            answer.tools = back.collect();
        }
        answer.fields.regions = regions;
        if let Some(fibres) = &self.fibres {
            answer.fields.set_fibres(fibres);
        }
        if let (Some(patch), Some(center)) = (&self.patch, context.center()) {
            let moments = prescribed.moved.iter().map(|&node| {
                let arm = frame.in_scene(&model.mesh.nodes[node]) - center;
                arm.cross(&frame.in_scene(&workspace.reaction(&model, node)))
            });
            let moment: Vec3 = moments.sum();
            answer.warnings.extend(patch.pulls(&answer.force, &moment));
        }
        answer.warnings.extend(context.warnings.iter().cloned());
        answer.warnings.extend(graded.warnings);
        answer.warnings.extend(missing);
        if crossing > 0 {
            answer.warnings.push(format!(
                "{crossing} edges of the mesh cross the edge of the patch, whose area is {:.3e} m²",
                answer.patch_area
            ));
        }
        Ok(answer)
    }

    /// A warning where tissue that was not expected to touch a tool is inside of it.
    fn passed_through(
        &self,
        surface: &ContactSurface,
        outer: &[Face],
        answer: &SolidAnswer,
    ) -> Vec<String> {
        let expected: BTreeSet<usize> = surface.nodes().collect();
        let corners = outer.iter().flat_map(|face| face.corners);
        let corners: BTreeSet<usize> = corners.map(NodeId::index).collect();
        let fields = &answer.fields;
        let others = corners.difference(&expected);
        let others: Vec<Vec3> = others
            .map(|&node| fields.positions[node] + fields.displacements[node])
            .collect();
        let mut warnings = Vec::new();
        for (number, tool) in self.tools.iter().enumerate() {
            let end = tool.position(tool.path.len() as f64);
            let depths = others
                .iter()
                .map(|at| -tool.signed_distance(at, &end).distance);
            let deepest = depths.fold(0.0, f64::max);
            if deepest > 0.0 {
                warnings.push(format!(
                    "tissue is {deepest:.1e} m inside of tool {}: it came from too far to be met; begin its path nearer to that \
                     tissue",
                    number + 1
                ));
            }
        }
        warnings
    }

    fn check_tools(&self) -> Result<(), SolidError> {
        for (tool, own) in self.tools.iter().enumerate() {
            let places = own.path.iter();
            let is_path = places
                .clone()
                .all(|place| place.iter().all(|x| x.is_finite()));
            if own.path.len() < 2 || !is_path {
                return Err(SolidError::NoPath { tool });
            }
            if !own.shape.exists() {
                return Err(SolidError::NoShape {
                    tool,
                    shape: own.shape,
                });
            }
            if let FrictionLaw::Coulomb(coefficient) = own.friction
                && !(coefficient >= 0.0 && coefficient.is_finite())
            {
                return Err(SolidError::NoFriction { tool, coefficient });
            }
        }
        Ok(())
    }

    fn check(&self) -> Result<(), Error> {
        let (low, high) = self.body.bounds();
        let extent = (high - low).max();
        let length = |name: &'static str, found: f64| {
            if found > 0.0 && found.is_finite() {
                Ok(())
            } else {
                Err(Error::NotALength { name, found })
            }
        };
        if let Some(patch) = &self.patch {
            let displacement = patch.displacement.norm();
            length("the radius of the patch", patch.radius)?;
            length("the displacement of the patch", displacement)?;
            if displacement > extent {
                return Err(Error::DisplacementBeyondBody {
                    displacement,
                    extent,
                });
            }
        }
        let presses = |region: &SolidRegion| matches!(&region.content, RegionContent::Cavity(content) if content.own_pressure() != 0.0);
        let is_pressed = self.regions.iter().any(presses);
        let is_moved = self.patch.is_some() || !self.tools.is_empty();
        self.loads.check(is_moved || is_pressed)?;
        self.check_tools()?;
        if self.loads.weight.is_some() {
            let densities = self.regions.iter().filter_map(SolidRegion::density);
            loads::check_densities(densities)?;
        }
        if self.anchor.is_empty() {
            return Err(Error::NothingFixed);
        }
        let laws = self.regions.iter().filter_map(SolidRegion::law);
        let mut laws = std::iter::once(&self.law).chain(laws);
        if laws.any(|law| law.has_fibres()) && self.fibres.is_none() {
            let model = "a solid without `fibres`";
            return Err(FibreError::NoDirection { model }.into());
        }
        Ok(())
    }
}

/// By how much the cavities of a body that nothing else loads grow under the pressures of their `fluids` [m³].
fn growths(
    model: &FiniteElementModel,
    frame: &Frame,
    prescribed: &PrescribedNodes,
    fluids: &[(&Cavity, f64)],
    at_part: &mut dyn FnMut(f64),
) -> Result<Vec<f64>, Error> {
    let conditions = Conditions {
        frame: &frame.without_patch(),
        prescribed,
        load: &vec![0.0; model.size()],
        pressures: fluids,
        pressed: &[],
        growths: &[],
    };
    let mut workspace = FiniteElementWorkspace::new(model)?;
    let state = equilibrium(model, &conditions, None, &mut workspace, at_part)?.state;
    let walls = fluids.iter().map(|(wall, _)| wall);
    Ok(walls
        .map(|wall| wall.growth(model, &state.unknowns))
        .collect())
}

impl SolidRegion {
    /// Its law, if it is of a tissue.
    fn law(&self) -> Option<&Arc<dyn Law>> {
        match &self.content {
            RegionContent::Tissue { law, .. } => Some(law),
            RegionContent::Cavity(_) => None,
        }
    }

    fn density(&self) -> Option<f64> {
        match self.content {
            RegionContent::Tissue { density, .. } => Some(density),
            RegionContent::Cavity(_) => None,
        }
    }
}

impl Body {
    /// Lowest and highest coordinates [m].
    pub fn bounds(&self) -> (Vec3, Vec3) {
        match self {
            Self::Surface(surface) => surface.mesh().bounds(),
            Self::Volume(mesh) => {
                let none = Vec3::repeat(f64::INFINITY);
                let vertices = mesh.vertices().iter();
                vertices.fold((none, -none), |(low, high), v| (low.inf(v), high.sup(v)))
            }
        }
    }
}
