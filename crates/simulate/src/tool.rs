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
    /// Its kind.
    pub kind: ToolKind,
    /// Its tip.
    pub tip: Tip,
    /// Whether the surface can slide along the tip.
    pub tip_friction: Friction,
    /// Coulomb friction coefficient of a tip that sticks [-]; none if it never slides.
    pub friction: Option<f64>,
    /// Its display mesh in its own frame [m], if it differs from that of its kind.
    pub display_mesh: Option<Arc<TriangleMesh>>,
    /// The force of the tissue on it.
    pub(crate) law: TipLaw,
    /// Its jaws, if it can hold tissue.
    pub jaws: Option<scene::Jaws>,
    /// Where it passes through the abdominal wall [m].
    pub trocar: Option<Vec3>,
    /// The forces of the abdominal wall on its hand, and the mapping from hand to tip.
    pub fulcrum: Option<Trocar>,
    pub(crate) model: FiniteSphereModel,
    /// The organ's normals and curvatures, averaged over this tip.
    pub(crate) patches: PatchField,
    pub(crate) placement: Placement,
    /// The compliance that the organ-scale model adds under this tip, if there is one.
    pub(crate) field: Option<TipField>,
    /// The effect of inclusions on this tip, relative to that on its load.
    pub(crate) inclusions: InclusionTable,
    /// The organ's compliance beyond a half-space under this tip at each vertex [1/m], for the local model; none if
    /// unknown.
    pub(crate) structural_compliance: Option<Arc<[Matrix3<f64>]>>,
    /// Typical radius of the contact area [m].
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
            display_mesh: display_mesh(tool)?,
            tip,
            tip_friction: bond,
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
            patches: PatchField::new(surface, model.fixed_radius(typical)),
            placement: settings.placement,
            field: None,
            inclusions: InclusionTable::default(),
            structural_compliance: None,
            typical_radius: typical,
            model,
        })
    }

    /// Distance from the tool's reference point (the centre of a flat face, or of a sphere) down to its first point of
    /// contact [m].
    pub(crate) fn overhang(&self) -> f64 {
        match self.tip {
            Tip::Flat { .. } => 0.0,
            Tip::Sphere { radius } => radius,
        }
    }

    /// Whether its tip can slide along the surface.
    pub(crate) fn slides(&self) -> bool {
        self.tip_friction == Friction::Frictionless || self.friction.is_some()
    }

    /// Radius of the contact area [m] under this force [N] on tissue of this law.
    pub(crate) fn touching_radius(&self, law: &LinearElastic, force: f64) -> f64 {
        match self.tip {
            Tip::Flat { radius } => radius,
            Tip::Sphere { radius } => {
                // The inverse of Hertz's law. The total depth does not determine it: a thin wall bends away.
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

/// Typical radius of the contact area [m].
pub(crate) fn typical_radius(tip: &scene::Tip) -> f64 {
    match tip.shape {
        scene::TipShape::Flat => tip.radius_m,
        // At a depth of a quarter of the radius the contact radius is half the radius.
        scene::TipShape::Sphere => 0.5 * tip.radius_m,
    }
}

/// The display mesh of a tool from its file, if it has one.
fn display_mesh(tool: &scene::Tool) -> Result<Option<Arc<TriangleMesh>>, Error> {
    let Some(mesh) = &tool.mesh else {
        return Ok(None);
    };
    let imported = read_mesh(&mesh.path, mesh.unit.map(length_unit))?;
    Ok(Some(Arc::new(imported.mesh)))
}

/// The settings of the local model for a scene's words.
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
