use palpate_files::scene::{HandOver, ModelKind};
use palpate_files::{Scene, SessionHeader};
use palpate_geometry::{AabbTree, Surface};
use palpate_mechanics::Material;

use crate::tool::{Tool, settings};
use crate::{Error, digest, organ, tip_laws};

/// An organ and the tools that may touch it. Built once, never changed.
#[derive(Debug, Clone)]
pub struct Simulation {
    pub(crate) surface: Surface,
    pub(crate) tree: AabbTree,
    pub(crate) material: Material,
    pub(crate) tools: Vec<Tool>,
    pub(crate) organ_radius: f64,
    pub(crate) step: f64,
    hand_over: HandOver,
    force_scale: f64,
    scene_digest: String,
    doubts: Vec<String>,
}

impl Simulation {
    /// Reads what `scene` names and makes the models. For most nonlinear laws this takes seconds: see
    /// [`Self::prepare`].
    ///
    /// # Errors
    /// When a file is missing or wrong, a mesh bounds no solid, or the scene asks for what is not there.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        Self::prepare(scene, &mut |_| ())
    }

    /// As [`Self::new`]; `at_step` hears which part [-] of the tissue's force over depth is done, if it
    /// has to be found first.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn prepare(scene: &Scene, at_step: &mut dyn FnMut(f64)) -> Result<Self, Error> {
        if scene.model.kind == ModelKind::Hybrid {
            return Err(Error::HybridModel);
        }
        let (surface, mut doubts) = organ::read_organ(&scene.organ.shape)?;
        let tissue = scene.organ.tissue.read()?;
        let material = Material::from_tissue(&tissue)?;
        doubts.extend(material.doubts.iter().cloned());
        let tree = AabbTree::new(surface.mesh());
        let settings = settings(&scene.model.local);
        let mut tools = scene
            .tools
            .iter()
            .map(|tool| Tool::new(tool, settings, &material.at_rest, (&surface, &tree)))
            .collect::<Result<Vec<_>, _>>()?;
        doubts.extend(tip_laws::stiffen(
            &mut tools,
            (&tissue, &material),
            at_step,
        )?);
        if tools.iter().any(|tool| tool.model.is_extrapolated()) {
            doubts.push(format!(
                "Poisson's ratio {:.3} is beyond the {} that the local model is calibrated for; its \
                 force is the one there, times the ratio of the half-spaces",
                material.at_rest.poissons_ratio(),
                palpate_mechanics::finite_spheres::LARGEST_CALIBRATED_RATIO,
            ));
        }
        if !scene.organ.layers.is_empty() {
            doubts.push("layers are read, but not felt yet".to_owned());
        }
        Ok(Self {
            // A hemisphere of the organ's volume V has R³ = 3 V / (2 π).
            organ_radius: (1.5 * surface.mesh().volume() / std::f64::consts::PI).cbrt(),
            scene_digest: digest::digest(scene, &surface, &tissue),
            step: scene.model.step_s,
            hand_over: scene.model.hand_over,
            force_scale: scene.model.force_scale,
            surface,
            tree,
            material,
            tools,
            doubts,
        })
    }

    /// The organ at rest.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// The tools in the scene's order.
    pub fn tools(&self) -> &[Tool] {
        &self.tools
    }

    /// Length of a step [s].
    pub fn step(&self) -> f64 {
        self.step
    }

    /// What is handed over to the servo loop between two steps.
    pub fn hand_over(&self) -> HandOver {
        self.hand_over
    }

    /// Factor on every force that is felt [-].
    pub fn force_scale(&self) -> f64 {
        self.force_scale
    }

    /// Plain sentences on what deserves doubt in this scene.
    pub fn doubts(&self) -> &[String] {
        &self.doubts
    }

    /// What stands at the head of a session of this scene.
    pub fn session_header(&self) -> SessionHeader {
        SessionHeader {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scene_digest: self.scene_digest.clone(),
            model: ModelKind::Local,
            step_s: self.step,
            seed: 0,
            force_scale: self.force_scale,
        }
    }
}
