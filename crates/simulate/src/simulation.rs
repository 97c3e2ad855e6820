use std::ops::ControlFlow;
use std::sync::Arc;

use palpate_files::scene::{
    Enhancement, EstimatedInclusion, HandOver, Layer, ModelKind, ResponseMethod,
};
use palpate_files::{Scene, SessionHeader};
use palpate_geometry::{AabbTree, Surface, TriangleMesh};
use palpate_mechanics::inclusion::InclusionField;
use palpate_mechanics::{LinearElastic, Material};

use crate::cutting::{CuttingModel, cuts};
use crate::digest::SceneDigest;
use crate::global::{GlobalModel, GlobalProblem, ResponseOrigin, surround};
use crate::neighbour::Neighbour;
use crate::nonlinear::{ContactBodies, NonlinearOrgan, SoftBody};
use crate::regions::{InclusionTable, RegionTissue, Regions};
use crate::tool::{Tool, settings, typical_radius};
use crate::{
    Error, Progress, Resources, Work, estimated_inclusions, organ, target, tip_laws, trocar,
};

/// An organ and the tools that may touch it. Built once, never changed.
#[derive(Debug, Clone)]
pub struct Simulation {
    pub(crate) surface: Surface,
    pub(crate) tree: AabbTree,
    /// The material at the surface.
    pub(crate) material: Material,
    pub(crate) tools: Vec<Tool>,
    /// The organ-scale model, if the scene has one.
    pub(crate) global: Option<GlobalModel>,
    /// The nonlinear model, if the scene has one.
    pub(crate) nonlinear: Option<Arc<NonlinearOrgan>>,
    /// The cutting model, if anything can cut.
    pub(crate) cutting: Option<CuttingModel>,
    /// The rigid neighbours that stop tools.
    pub(crate) neighbours: Vec<Neighbour>,
    /// Inclusions with a tissue that the model does not solve.
    unsolved: InclusionField,
    /// All inclusions whose effect is estimated.
    pub(crate) estimated: Arc<InclusionField>,
    /// The organ's tissue at rest, below its layers.
    tissue_at_rest: LinearElastic,
    /// Length of the edges of a typical triangle [m].
    pub(crate) typical_edge: f64,
    pub(crate) organ_radius: f64,
    pub(crate) step: f64,
    kind: ModelKind,
    hand_over: HandOver,
    force_scale: f64,
    pub(crate) scene_digest: SceneDigest,
    /// The seed of the variant; 0 for a scene of fixed numbers.
    seed: u64,
    warnings: Vec<String>,
}

impl Simulation {
    /// Reads the files of `scene` and makes the models. For an organ-scale model this takes from seconds to minutes,
    /// and seconds for most nonlinear laws: see [`Self::prepare`].
    ///
    /// # Errors
    /// When a file is missing or invalid, a mesh encloses no solid, or the scene refers to something that does not
    /// exist.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        let go_on = &mut |_| ControlFlow::Continue(());
        Self::prepare(scene, &Resources::default(), go_on)
    }

    /// As [`Self::new`], with `resources`; `on_progress` receives the progress of long work, and may cancel it.
    ///
    /// # Errors
    /// As [`Self::new`], and when it is cancelled.
    pub fn prepare(
        scene: &Scene,
        resources: &Resources,
        on_progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<Self, Error> {
        if scene.draws.is_some() {
            return Err(Error::NotDrawn);
        }
        let (surface, mut warnings) = organ::read_organ(&scene.organ.shape)?;
        let (tissue, material) = organ::read_tissue(&scene.organ.tissue)?;
        warnings.extend_from_slice(&scene.warnings);
        warnings.extend(material.warnings.iter().cloned());
        let tree = AabbTree::new(surface.mesh());
        for tool in &scene.tools {
            trocar::check(tool, &surface, &tree)?;
        }
        target::check_line(scene, &surface, &tree)?;
        let kind = scene.model.kind;
        let is_nonlinear = kind == ModelKind::Nonlinear;
        let layers: &[Layer] = match kind {
            ModelKind::Local => &[],
            ModelKind::Hybrid | ModelKind::Nonlinear => &scene.organ.layers,
        };
        let is_of_one_tissue = is_of_one_tissue(scene);
        let inclusions = &scene.organ.inclusions;
        let regions = Regions::read(layers, inclusions, &surface, &tree, &tissue, &material)?;
        warnings.extend_from_slice(&regions.warnings);
        warnings.extend(simplifications(scene, &regions));
        let mut enclosed: Vec<Surface> = regions.enclosed().cloned().collect();
        let law = |region: &RegionTissue| match kind {
            ModelKind::Nonlinear => region.law,
            ModelKind::Local | ModelKind::Hybrid => region.material.at_rest,
        };
        let (unsolved, mut effective) = match is_of_one_tissue {
            true => {
                let inclusions = regions.inclusions(law, &regions.tissues[0]);
                let tissues = regions.of_inclusions().cloned().collect();
                (inclusions, tissues)
            }
            false => (InclusionField::default(), Vec::new()),
        };
        let is_solved = is_nonlinear || !(is_of_one_tissue || regions.are_alike());
        let regions = is_solved.then_some(regions);
        let (mut soft, more) = match is_nonlinear {
            true => SoftBody::all(scene)?,
            false => Default::default(),
        };
        warnings.extend(more);
        enclosed.extend(
            soft.iter()
                .flat_map(|body| body.regions.enclosed().cloned()),
        );
        let organ_surface = surface;
        let (surface, tree) = match &soft[..] {
            [] => (organ_surface.clone(), tree),
            bodies => {
                let own = std::iter::once(&organ_surface);
                let all: Vec<_> = own.chain(bodies.iter().map(|body| &body.surface)).collect();
                let misplaced = |fault| Error::Misplaced { fault };
                let surface = Surface::merged(&all).map_err(misplaced)?;
                let tree = AabbTree::new(surface.mesh());
                (surface, tree)
            }
        };
        let touched = scene.tools.iter().map(|tool| match &regions {
            Some(regions) => regions.touched(typical_radius(&tool.tip)),
            None => Ok((tissue.clone(), material.clone())),
        });
        let touched = touched.collect::<Result<Vec<_>, _>>()?;
        let settings = settings(&scene.model.local);
        let mut tools = scene
            .tools
            .iter()
            .zip(&touched)
            .map(|(tool, (_, own))| Tool::new(tool, settings, &own.at_rest, &surface, &tree))
            .collect::<Result<Vec<_>, _>>()?;
        let of_soft = soft.iter().map(|body| (&body.surface, &body.regions));
        let bodies = regions
            .iter()
            .map(|own| (&organ_surface, own))
            .chain(of_soft);
        let bodies: Vec<_> = bodies
            .map(|(of, own)| (of, own.inclusions(law, own.at_surface())))
            .collect();
        for tool in &mut tools {
            tool.inclusions = InclusionTable::new(tool.tip, &bodies);
        }
        let surface_material = match &regions {
            Some(regions) => regions.at_surface().material.clone(),
            None => material.clone(),
        };
        let estimated = estimated_inclusions::field(
            &scene.organ.estimated_inclusions,
            &surface,
            &tree,
            &material.at_rest,
            surface_material.at_rest.youngs_modulus(),
        )?;
        let global = match kind {
            ModelKind::Local | ModelKind::Nonlinear => None,
            ModelKind::Hybrid => {
                let regions = regions.as_ref();
                let law = &surface_material.at_rest;
                let problem = GlobalProblem::new(scene, &surface, law, regions)?;
                let (global, more) = problem.solve(scene, &surface, resources, on_progress)?;
                warnings.extend(more);
                tools
                    .iter_mut()
                    .try_for_each(|tool| global.apply_to_tip(tool, regions))?;
                Some(global)
            }
        };
        let of_regions = regions.iter().flat_map(Regions::without_organ);
        let bending = soft.iter().flat_map(|body| body.regions.all());
        effective.extend(of_regions.chain(bending).cloned());
        let neighbours = Neighbour::all(scene, &tools)?;
        target::check_touch(
            &scene.task.goal,
            neighbours.iter().map(|body| &body.surface),
        )?;
        if !neighbours.is_empty() {
            warnings.push(match is_nonlinear {
                true => "neighbours that collide keep their shape: they stop the tips of tools and the organ, with their \
                         `friction`; shafts pass through them"
                    .to_owned(),
                false => "neighbours that collide keep their shape: they stop the tips of tools; shafts and the organ pass \
                          through them: `model.kind = \"nonlinear\"` keeps the organ out"
                    .to_owned(),
            });
        }
        for body in &mut soft {
            let at_step = &mut |part| {
                let work = Work::ForceOverDepth;
                // It cannot be cancelled, and takes seconds.
                let _ = on_progress(Progress { work, part });
            };
            warnings.extend(body.prepare_tips(scene, &tools, at_step)?);
        }
        warnings.extend(tip_laws::stiffen(&mut tools, &touched, &mut |part| {
            let work = Work::ForceOverDepth;
            // It cannot be cancelled, and takes seconds.
            let _ = on_progress(Progress { work, part });
        })?);
        if let Some(regions) = &regions {
            tools.iter_mut().for_each(|tool| regions.apply_to_tip(tool));
        }
        let nonlinear = match regions {
            Some(regions) if is_nonlinear => {
                let bodies = ContactBodies {
                    tools: &tools,
                    soft: &soft,
                    neighbours: &neighbours,
                };
                let (organ, more) = NonlinearOrgan::new(
                    scene,
                    &surface,
                    &tree,
                    &organ_surface,
                    regions,
                    bodies,
                    on_progress,
                )?;
                warnings.extend(more);
                Some(Arc::new(organ))
            }
            _ => None,
        };
        if kind == ModelKind::Local {
            let (law, memory) = (&material.at_rest, resources.memory);
            match surround(&mut tools, scene, &surface, law, memory) {
                Ok(warning) => warnings.extend(warning),
                Err(error) => warnings.push(format!(
                    "the organ's size is felt as that of a hemisphere of its volume, for boundary elements have no \
                     answer: {error}"
                )),
            }
        }
        let cutting = CuttingModel::new(scene, &surface)?;
        warnings.extend(cutting.iter().filter_map(CuttingModel::warning));
        if scene.model.gravity_m_per_s2.is_some() && nonlinear.is_none() {
            warnings.push(
                "only the nonlinear model has weight; `model.gravity_m_per_s2` changes nothing here"
                    .to_owned(),
            );
        }
        if scene.organ.self_contact && nonlinear.is_none() {
            warnings.push(
                "only the nonlinear model has parts that touch; `organ.self_contact` changes nothing here"
                    .to_owned(),
            );
        }
        Ok(Self {
            organ_radius: radius_of_hemisphere(&organ_surface),
            scene_digest: SceneDigest::of(
                scene,
                &organ_surface,
                &tissue,
                &effective,
                &enclosed,
                neighbours
                    .iter()
                    .map(|body| (&body.surface, Some(body)))
                    .chain(soft.iter().map(|body| (&body.surface, None))),
            ),
            seed: scene.variant.as_ref().map_or(0, |own| own.seed),
            step: scene.model.step_s,
            kind,
            hand_over: scene.model.hand_over,
            force_scale: scene.model.force_scale,
            typical_edge: typical_edge(&surface),
            estimated: Arc::new(estimated.joined(&unsolved)),
            unsolved,
            tissue_at_rest: material.at_rest,
            cutting,
            neighbours,
            surface,
            tree,
            material: surface_material,
            tools,
            global,
            nonlinear,
            warnings,
        })
    }

    /// The inclusions whose effect is estimated: `inclusions`, and those that the model does not solve.
    pub(crate) fn estimate(
        &self,
        inclusions: &[EstimatedInclusion],
    ) -> Result<InclusionField, Error> {
        let unit = self.material.at_rest.youngs_modulus();
        let law = &self.tissue_at_rest;
        let field = estimated_inclusions::field(inclusions, &self.surface, &self.tree, law, unit)?;
        Ok(field.joined(&self.unsolved))
    }

    /// The untouched surface and its boxes: at rest, or as the organ hangs under its weight.
    pub(crate) fn untouched(&self) -> (&TriangleMesh, &AabbTree) {
        let organ = self.nonlinear.as_deref();
        organ
            .and_then(NonlinearOrgan::hangs)
            .unwrap_or((self.surface.mesh(), &self.tree))
    }

    /// Whether cuts change the forces.
    pub(crate) fn forces_follow_cuts(&self) -> bool {
        self.cutting
            .as_ref()
            .is_some_and(|model| model.changes_force)
    }

    /// The organ at rest.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// The depths of the lower faces of the layers that a cut can open, from outside [m]; for an organ without layers
    /// the depth of the cut. Empty if nothing cuts.
    pub fn cut_depths(&self) -> Vec<f64> {
        let layers = self.cutting.iter().flat_map(|model| &model.layers);
        layers.map(|layer| layer.bottom).collect()
    }

    /// The names of the layers that can be opened, from outside.
    pub fn layer_names(&self) -> &[String] {
        self.cutting.as_ref().map_or(&[], |model| &model.names)
    }

    /// Whether the organ has layers that can be opened.
    pub fn is_layered(&self) -> bool {
        self.cutting.as_ref().is_some_and(|model| model.is_layered)
    }

    /// The gape of a cut [m]; none if nothing cuts.
    pub fn cut_width(&self) -> Option<f64> {
        self.cutting.as_ref().map(|model| model.width)
    }

    /// The tools in the scene's order.
    pub fn tools(&self) -> &[Tool] {
        &self.tools
    }

    /// The prepared organ-scale model, if the scene has one.
    pub fn response(&self) -> Option<&ResponseOrigin> {
        self.global.as_ref().map(|global| &global.origin)
    }

    /// How the organ-scale model is displayed around its contacts, if the scene has one.
    pub fn enhancement(&self) -> Option<&Enhancement> {
        let global = self.global.as_ref()?;
        Some(global.enhancement.settings())
    }

    /// Whether the displayed surface has a mesh of its own, finer than the mechanical one.
    pub fn is_carried(&self) -> bool {
        let global = self.global.as_ref();
        global.is_some_and(|global| global.enhancement.has_finer_display())
    }

    /// Length of a step [s].
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The hand-over of forces to the servo loop between two steps.
    pub fn hand_over(&self) -> HandOver {
        self.hand_over
    }

    /// Scale factor of every force that a device displays [-].
    pub fn force_scale(&self) -> f64 {
        self.force_scale
    }

    /// Warnings about this scene, as sentences.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The header of a session of this scene.
    pub fn session_header(&self) -> SessionHeader {
        SessionHeader {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scene_digest: self.scene_digest.canonical.clone(),
            model: self.kind,
            step_s: self.step,
            seed: self.seed,
            force_scale: self.force_scale,
        }
    }
}

/// Whether the scene's method supports only one tissue.
fn is_of_one_tissue(scene: &Scene) -> bool {
    match scene.model.kind {
        ModelKind::Local => true,
        ModelKind::Hybrid => scene.model.response == ResponseMethod::BoundaryElements,
        ModelKind::Nonlinear => false,
    }
}

/// Warnings about parts of an organ that a model ignores or simplifies.
fn simplifications(scene: &Scene, regions: &Regions) -> Vec<String> {
    let organ = &scene.organ;
    let is_hybrid = scene.model.kind == ModelKind::Hybrid;
    let ignores = is_of_one_tissue(scene);
    let model = match is_hybrid {
        true => "a response by boundary elements is of one tissue (`model.response`):",
        false => "the local model is of one tissue:",
    };
    let mut warnings = Vec::new();
    if ignores && !organ.layers.is_empty() {
        warnings.push(format!(
            "{model} layers are cut, seen and perforated each by itself, and to a touch the organ answers as its own tissue"
        ));
    }
    if ignores && !organ.inclusions.is_empty() {
        warnings.push(format!(
            "{model} the effect of inclusions on a force is estimated, as of Eshelby's inclusions in a half-space"
        ));
    }
    if is_hybrid && !ignores && !regions.are_alike() {
        if !regions.relax_alike() {
            warnings.push(
                "the hybrid model relaxes everywhere as the tissue at the surface does; the nonlinear model has the relaxation \
                 of each tissue"
                    .to_owned(),
            );
        }
        if scene.tools.iter().any(|tool| cuts(tool.kind)) {
            warnings.push(
                "a cut changes the forces of the hybrid model as in one tissue, that at the surface".to_owned(),
            );
        }
    }
    warnings
}

/// Radius of the hemisphere with the volume V of a body: R³ = 3 V / (2 π) [m].
pub(crate) fn radius_of_hemisphere(surface: &Surface) -> f64 {
    (1.5 * surface.mesh().volume() / std::f64::consts::PI).cbrt()
}

/// The edge of the regular triangle of mean area [m].
fn typical_edge(surface: &Surface) -> f64 {
    let mesh = surface.mesh();
    let mean = mesh.area() / mesh.triangles().len() as f64;
    (mean * 4.0 / 3_f64.sqrt()).sqrt()
}
