use std::sync::Arc;

use nalgebra::Matrix3;
use palpate_files::scene::{self, ToolKind};
use palpate_geometry::{AabbTree, PatchField, Surface, TriangleMesh, Vec3, read_mesh};
use palpate_mechanics::contact::{Friction, Tip, hertz_force};
use palpate_mechanics::finite_spheres::{
    Calibration, FiniteSphereModel, FiniteSphereSettings, Integration, Placement, Solver,
};
use palpate_mechanics::surface_response::TipField;
use palpate_mechanics::{LinearElastic, TipLaw};

use crate::Error;
use crate::organ::length_unit;
use crate::regions::InclusionTable;

use crate::trocar::Trocar;

/// A tool of the scene with the model of the tissue under its tip.
#[derive(Debug, Clone)]
pub struct Tool {
    /// Its name in scene, motion and session.
    pub name: String,
    /// What it can do.
    pub kind: ToolKind,
    /// The end that touches.
    pub tip: Tip,
    /// Whether the surface can run along the tip.
    pub bond: Friction,
    /// Coulomb's coefficient of a tip that sticks [-]; none where it never slides.
    pub friction: Option<f64>,
    /// What it looks like in its own frame [m], if not as its kind does.
    pub look: Option<Arc<TriangleMesh>>,
    /// The force of the tissue on it.
    pub(crate) law: TipLaw,
    /// Its jaws, if it can hold tissue.
    pub jaws: Option<scene::Jaws>,
    /// Where it passes through the abdominal wall [m].
    pub trocar: Option<Vec3>,
    /// What its hand feels there, and how it moves the tip.
    pub fulcrum: Option<Trocar>,
    pub(crate) model: FiniteSphereModel,
    /// The organ's normals and curvatures as this tip feels them.
    pub(crate) patches: PatchField,
    pub(crate) placement: Placement,
    /// What the whole organ adds under this tip, if there is a model of it.
    pub(crate) field: Option<TipField>,
    /// What inclusions are to this tip, beside what they are to its load.
    pub(crate) inclusions: InclusionTable,
    /// What the organ yields beyond a half-space under this tip at each vertex [1/m], for the local model; none where
    /// that is not known.
    pub(crate) further: Option<Arc<[Matrix3<f64>]>>,
    /// Radius of the touching area that stands for all [m].
    pub(crate) typical_radius: f64,
}

/// Residual to which GMRES solves; forces then agree with the direct solution to eight digits.
const GMRES_TOLERANCE: f64 = 1e-10;

impl Tool {
    pub(crate) fn new(
        tool: &scene::Tool,
        settings: FiniteSphereSettings,
        law: &LinearElastic,
        surface: &Surface,
        tree: &AabbTree,
    ) -> Result<Self, Error> {
        let bond = match tool.tip.contact {
            scene::TipContact::Stick => Friction::Bonded,
            scene::TipContact::Slip => Friction::Frictionless,
        };
        let (radius, typical) = (tool.tip.radius_m, typical_radius(&tool.tip));
        let tip = match tool.tip.shape {
            scene::TipShape::Flat => Tip::Flat { radius },
            scene::TipShape::Sphere => Tip::Sphere { radius },
        };
        let mut model = FiniteSphereModel::new(settings, law, bond)?;
        model.precompute_placement(surface, tree, typical);
        Ok(Self {
            name: tool.name.clone(),
            kind: tool.kind,
            look: look(tool)?,
            tip,
            bond,
            friction: tool.tip.friction,
            law: TipLaw::linear(tip, bond, *law),
            jaws: tool.jaws.filter(|_| tool.kind == scene::ToolKind::Grasper),
            trocar: tool.trocar_m.map(Vec3::from),
            fulcrum: tool.trocar_m.map(|place| {
                let (low, high) = surface.mesh().bounds();
                Trocar {
                    friction: tool.trocar_friction_n,
                    stiffness: tool.trocar_stiffness_n_per_m,
                    ..Trocar::new(Vec3::from(place), &(0.5 * (low + high)))
                }
            }),
            patches: PatchField::new(surface, model.held_radius(typical)),
            placement: settings.placement,
            field: None,
            inclusions: InclusionTable::default(),
            further: None,
            typical_radius: typical,
            model,
        })
    }

    /// The distance from the tool's reference point (the centre of a flat face, or of a sphere) down to
    /// where it touches first [m].
    pub(crate) fn overhang(&self) -> f64 {
        match self.tip {
            Tip::Flat { .. } => 0.0,
            Tip::Sphere { radius } => radius,
        }
    }

    /// Whether its tip can move along the surface.
    pub(crate) fn slides(&self) -> bool {
        self.bond == Friction::Frictionless || self.friction.is_some()
    }

    /// Radius of the area that touches [m] under so much force [N] on tissue of this law.
    pub(crate) fn touching_radius(&self, law: &LinearElastic, force: f64) -> f64 {
        match self.tip {
            Tip::Flat { radius } => radius,
            Tip::Sphere { radius } => {
                // The inverse of Hertz's law. How deep it is in all says nothing: a thin wall bends away.
                let depth = (force / hertz_force(law, radius, 1.0)).powf(2.0 / 3.0);
                self.tip.contact_radius(depth)
            }
        }
    }

    /// Radius of the shaft [m]: that of the tip.
    pub(crate) fn shaft_radius(&self) -> f64 {
        match self.tip {
            Tip::Flat { radius } | Tip::Sphere { radius } => radius,
        }
    }
}

/// Radius of the touching area that stands for all [m].
pub(crate) fn typical_radius(tip: &scene::Tip) -> f64 {
    match tip.shape {
        scene::TipShape::Flat => tip.radius_m,
        // Half the radius touches at a quarter of the radius in depth.
        scene::TipShape::Sphere => 0.5 * tip.radius_m,
    }
}

/// What a tool looks like by its file, if it has one.
fn look(tool: &scene::Tool) -> Result<Option<Arc<TriangleMesh>>, Error> {
    let Some(mesh) = &tool.mesh else {
        return Ok(None);
    };
    let imported = read_mesh(&mesh.path, mesh.unit.map(length_unit))?;
    Ok(Some(Arc::new(imported.mesh)))
}

/// The settings of the local model that a scene's words stand for.
pub(crate) fn settings(local: &scene::LocalSettings) -> FiniteSphereSettings {
    FiniteSphereSettings {
        particles: local.particles,
        form: local.form,
        placement: local.placement,
        solver: match local.solver {
            scene::Solver::Direct => Solver::Direct,
            scene::Solver::Gmres => Solver::Gmres {
                tolerance: GMRES_TOLERANCE,
            },
        },
        assembly: local.assembly,
        calibration: match local.calibration {
            scene::Calibration::Fitted => Calibration::Fitted,
            scene::Calibration::None => Calibration::None,
        },
        integration: match local.integration_points {
            scene::IntegrationPoints::Few => Integration::Coarse,
            scene::IntegrationPoints::Standard => Integration::Standard,
            scene::IntegrationPoints::Many => Integration::Fine,
        },
    }
}
