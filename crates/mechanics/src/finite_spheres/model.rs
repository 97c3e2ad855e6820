use nalgebra::{Matrix3, Vector3};
use palpate_geometry::{AabbTree, Surface, TriangleId};

use super::exterior::{self, Calibration, LARGEST_CALIBRATED_RATIO};
use super::field::{SHOWN, Spread, smooth_fall as fade};
use super::layout::{CapShape, Layout};
use super::quadrature::Quadrature;
use super::reuse::ReuseTable;
use super::settings::{
    Assembly, Calibration as Fit, FiniteSphereSettings, Form, Placement, Solver,
};
use super::solution::Solution;
use super::source_placement::SourcePlacement;
use super::uncalibrated::Uncalibrated;
use super::workspace::FiniteSphereWorkspace;
use crate::contact::{Friction, half_space_stiffness, half_space_tangential_stiffness};
use crate::{Error, Limit, Limits, LinearElastic, Reached, Vec3};

/// The local model of one tissue under one kind of tip. Built once, never changed.
#[derive(Debug, Clone)]
pub struct FiniteSphereModel {
    settings: FiniteSphereSettings,
    bond: Friction,
    /// The law that is solved for: the tissue's, at a Poisson's ratio that is calibrated.
    law: LinearElastic,
    /// Factors of the answer for the tissue's own ratio [-], tangential and normal.
    ratio_of_half_spaces: [f64; 2],
    layout: Layout,
    quadrature: Quadrature,
    calibration: Calibration,
    reuse: Option<ReuseTable>,
    source: Option<SourcePlacement>,
    /// The uncalibrated model, which replaces the calibrated shells if nothing is fitted.
    uncalibrated: Option<Uncalibrated>,
}

/// Without calibration the organ's curvature is that within this distance, and what is shown of its
/// displacement fades out from the second to the third [tip radii]: at 12 radii 5 % of the depth are left.
const UNCALIBRATED_RADII: [f64; 3] = [4.0, 8.0, 16.0];

/// The contact of a tip with an organ, and the organ's shape there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalContact {
    /// The contact point at rest [m].
    pub point: Vec3,
    /// Columns: two unit tangents and the outward normal, right-handed [-].
    pub frame: Matrix3<f64>,
    /// κ₁₁, κ₁₂, κ₂₂ [1/m] along the tangents, positive where the organ bulges out.
    pub curvature: Vector3<f64>,
    /// The triangle of the contact point (for the source's placement).
    pub triangle: TriangleId,
    /// Radius of the touching area [m].
    pub radius: f64,
    /// The organ beyond the particles.
    pub surroundings: Surroundings,
    /// Distance along the inward normal to the fixed base of the organ [m], infinite for a half-space; asked
    /// for without calibration only.
    pub thickness: f64,
}

impl LocalContact {
    /// Mean curvature of the surface under the tip [1/m], positive where it bulges out.
    pub fn mean_curvature(&self) -> f64 {
        0.5 * (self.curvature.x + self.curvature.z)
    }
}

/// The organ beyond the particles around a tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Surroundings {
    /// A hemisphere that is fixed at its base, of this radius [m]; infinite for a half-space. The particles answer to
    /// a contact that is flatter or rounder than it, too strongly: this is the source's case, of a tip at the pole.
    Hemisphere {
        /// Its radius [m].
        radius: f64,
    },
    /// Structural compliance, that of the organ less that of a half-space, times Young's modulus [1/m], in the
    /// contact's frame; symmetric. It includes the curvature.
    Known(Matrix3<f64>),
}

/// Response of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// Stiffness [N/m] in the contact's frame; the tangents do not couple to the normal, and a tip that
    /// slips has none of them.
    pub stiffness: Matrix3<f64>,
    /// Bounds that changed it.
    pub limits: Limits,
    share: [f64; 2],
    spacing: f64,
}

impl FiniteSphereModel {
    /// The model for a tissue `law` under tips with the bond `bond`.
    ///
    /// # Errors
    /// When the number of particles is out of range, they do not determine a displacement, or a setting or
    /// a tip that sticks is asked for that the model without calibration does not have.
    pub fn new(
        settings: FiniteSphereSettings,
        law: &LinearElastic,
        bond: Friction,
    ) -> Result<Self, Error> {
        check_uncalibrated(&settings, bond)?;
        let layout = Layout::new(settings.particles)?;
        let quadrature = Quadrature::new(settings.integration, layout.shells);
        let solved = LinearElastic::new(
            law.youngs_modulus(),
            law.poissons_ratio().min(LARGEST_CALIBRATED_RATIO),
        )?;
        let mut workspace = FiniteSphereWorkspace::new(&settings, &layout, &quadrature);
        let shells = layout.shells;
        let calibration = Calibration::new(solved, bond, settings.form, shells, |cap| {
            workspace.place(&layout, cap);
            workspace.assemble(&quadrature, &solved);
            workspace.solve();
            workspace.solution.stiffness
        });
        let mut model = Self {
            settings,
            bond,
            ratio_of_half_spaces: [
                half_space_tangential_stiffness(law, 1.0)
                    / half_space_tangential_stiffness(&solved, 1.0),
                half_space_stiffness(law, 1.0, bond) / half_space_stiffness(&solved, 1.0, bond),
            ],
            law: solved,
            layout,
            quadrature,
            calibration,
            reuse: None,
            source: None,
            uncalibrated: None,
        };
        if settings.calibration != Fit::Fitted {
            let enriched = settings.calibration == Fit::None;
            let uncalibrated =
                Uncalibrated::new(&model.layout, settings.integration, law, enriched);
            model.uncalibrated = Some(uncalibrated);
            return Ok(model);
        }
        // α < 0, NaN or a tip wider than the shells: the equations do not hold a displacement.
        let alpha = model.calibration.radius_in_spacings;
        if !(alpha > 0.05 && alpha < 1.5) {
            return Err(model.undetermined());
        }
        if settings.assembly == Assembly::Reused {
            model.fill_reuse_table(&mut workspace);
        }
        Ok(model)
    }

    /// Projects the particles of every triangle, for the source's placement under a tip of `radius` [m];
    /// with the template this does nothing.
    pub fn precompute_placement(&mut self, surface: &Surface, tree: &AabbTree, radius: f64) {
        if self.settings.placement == Placement::Source {
            let spacing = self.spacing(radius);
            let placement = SourcePlacement::new(surface, tree, &self.layout, spacing);
            self.source = Some(placement);
        }
    }

    /// An organ of which only the volume is known, that of a hemisphere of `radius` [m]: it reduces the
    /// half-space's compliance as that hemisphere does, fixed at its base.
    pub fn by_volume(&self, radius: f64) -> Surroundings {
        let law = &self.law;
        let taken = exterior::constants(law.poissons_ratio()).organ_size / radius;
        let own = half_space_stiffness(law, 1.0, self.bond) / law.youngs_modulus();
        let [_, ratio] = self.ratio_of_half_spaces;
        let mut structural = Matrix3::zeros();
        structural[(2, 2)] = -taken / (own * ratio);
        Surroundings::Known(structural)
    }

    /// Fresh scratch for this model.
    pub fn workspace(&self) -> FiniteSphereWorkspace {
        let mut workspace =
            FiniteSphereWorkspace::new(&self.settings, &self.layout, &self.quadrature);
        let own = self.uncalibrated.as_ref().map(Uncalibrated::workspace);
        workspace.uncalibrated = own.map(Box::new);
        workspace
    }

    /// Distance between shells [m] for a touching area of `radius` [m]: h = a/α.
    pub fn spacing(&self, radius: f64) -> f64 {
        radius / self.calibration.radius_in_spacings
    }

    /// Radius of the fixed shell [m] for a touching area of `radius` [m].
    pub fn fixed_radius(&self, radius: f64) -> f64 {
        match self.uncalibrated {
            Some(_) => UNCALIBRATED_RADII[0] * radius,
            None => self.spacing(radius) * self.layout.shells as f64,
        }
    }

    /// Beyond this distance [m] from the contact nothing is shown to move.
    pub fn shown_radius(&self, radius: f64) -> f64 {
        match self.uncalibrated {
            Some(_) => UNCALIBRATED_RADII[2] * radius,
            None => SHOWN * self.fixed_radius(radius),
        }
    }

    /// Number of integration points.
    pub fn integration_points(&self) -> usize {
        match &self.uncalibrated {
            Some(own) => own.integration_points(),
            None => self.quadrature.count(),
        }
    }

    /// α = a/h [-], from the half-space (see the table in `exterior`).
    pub fn radius_in_spacings(&self) -> f64 {
        self.calibration.radius_in_spacings
    }

    /// Places the particles of `contact`, solves, and answers its stiffness. The contact that `workspace`, of this model
    /// alone, answered last is not solved again: a flat tip that sticks keeps its contact until it lets go.
    pub fn respond(
        &self,
        contact: &LocalContact,
        workspace: &mut FiniteSphereWorkspace,
    ) -> Response {
        if let Some((last, response)) = workspace.answered
            && last == *contact
        {
            return response;
        }
        let spacing = self.spacing(contact.radius);
        let response = match &self.reuse {
            Some(table) => {
                let cap = CapShape::new(contact.curvature * spacing, self.layout.shells);
                table.interpolate(cap, &mut workspace.solution);
                self.correct(contact, &workspace.solution)
            }
            None => {
                self.assemble(contact, workspace);
                self.solve(contact, workspace)
            }
        };
        workspace.answered = Some((*contact, response));
        response
    }

    /// The first half of [`Self::respond`], for measuring its parts: places the particles and makes the
    /// equations.
    pub fn assemble(&self, contact: &LocalContact, workspace: &mut FiniteSphereWorkspace) {
        workspace.answered = None;
        if let (Some(own), Some(scratch)) = (&self.uncalibrated, &mut workspace.uncalibrated) {
            return own.assemble(contact, scratch);
        }
        let spacing = self.spacing(contact.radius);
        let cap = CapShape::new(contact.curvature * spacing, self.layout.shells);
        match &self.source {
            Some(source) => workspace.place_with(cap, |positions| {
                source.place(contact.triangle, &self.layout, cap, positions);
            }),
            None => workspace.place(&self.layout, cap),
        }
        workspace.assemble(&self.quadrature, &self.law);
    }

    /// The second half of [`Self::respond`]: solves what [`Self::assemble`] made.
    pub fn solve(&self, contact: &LocalContact, workspace: &mut FiniteSphereWorkspace) -> Response {
        if let (Some(own), Some(scratch)) = (&self.uncalibrated, &mut workspace.uncalibrated) {
            let mut stiffness = Matrix3::zeros();
            stiffness[(2, 2)] = own.solve(contact.radius, scratch);
            return Response {
                stiffness,
                limits: Limits::NONE,
                share: [0.0; 2],
                spacing: contact.radius,
            };
        }
        workspace.solve();
        let mut response = self.correct(contact, &workspace.solution);
        if let Some(reached) = workspace.not_converged() {
            response.limits.add(Limit::Residual, reached);
        }
        response
    }

    /// Displacement [m] of the organ's point `x` [m] when the tip of a contact has moved by `tip` [m];
    /// `response` must be the last that `workspace` was used for.
    pub fn displacement(
        &self,
        contact: &LocalContact,
        response: &Response,
        workspace: &mut FiniteSphereWorkspace,
        tip: &Vec3,
        x: &Vec3,
    ) -> Vec3 {
        let mut tip = contact.frame.tr_mul(tip);
        if self.bond == Friction::Frictionless {
            (tip.x, tip.y) = (0.0, 0.0);
        }
        if let (Some(own), Some(scratch)) = (&self.uncalibrated, &mut workspace.uncalibrated) {
            let local = contact.frame.tr_mul(&(x - contact.point)) / contact.radius;
            let [_, from, to] = UNCALIBRATED_RADII;
            let shown = fade((local.norm() - from) / (to - from));
            // A unit depth is a displacement of −1 along the normal.
            return contact.frame * own.displacement(scratch, &local) * (-tip.z * shown);
        }
        let spread = Spread {
            tip,
            share: response.share,
            radius_in_spacings: self.calibration.radius_in_spacings,
            shells: self.layout.shells as f64,
            form: self.settings.form,
            cap: CapShape::new(contact.curvature * response.spacing, self.layout.shells),
        };
        let local = contact.frame.tr_mul(&(x - contact.point)) / response.spacing;
        let FiniteSphereWorkspace {
            solution,
            functions,
            ..
        } = workspace;
        contact.frame * spread.at(solution, functions, &local)
    }

    fn correct(&self, contact: &LocalContact, solution: &Solution) -> Response {
        let spacing = self.spacing(contact.radius);
        let [tangential, normal] = self.ratio_of_half_spaces;
        let mut surroundings = contact.surroundings;
        if let Surroundings::Known(structural) = &mut surroundings {
            // What is multiplied again below.
            structural[(2, 2)] *= normal;
            structural
                .fixed_view_mut::<2, 2>(0, 0)
                .scale_mut(tangential);
        }
        let corrected = self
            .calibration
            .correct(&solution.stiffness, spacing, &surroundings);
        let mut stiffness = corrected.stiffness * tangential;
        stiffness[(2, 2)] = corrected.stiffness[(2, 2)] * normal;
        let mut limits = corrected.limits;
        if let Some(reached) = self.flattened(contact) {
            limits.add(Limit::Curvature, reached);
        }
        Response {
            stiffness,
            limits,
            share: corrected.share,
            spacing,
        }
    }

    /// How far the surface of a contact was made gentler, if it was.
    fn flattened(&self, contact: &LocalContact) -> Option<Reached> {
        let in_spacings = contact.curvature * self.spacing(contact.radius);
        let factor = CapShape::gentler(&in_spacings, self.layout.shells);
        let unbounded = CapShape::largest_principal(&contact.curvature);
        let used = unbounded * factor;
        (factor < 1.0).then_some(Reached { unbounded, used })
    }

    fn fill_reuse_table(&mut self, workspace: &mut FiniteSphereWorkspace) {
        let mut scratch = Solution::new(self.layout.places.len());
        let table = ReuseTable::new(self.layout.shells, &mut scratch, |cap, solution| {
            workspace.place(&self.layout, cap);
            workspace.assemble(&self.quadrature, &self.law);
            workspace.solve();
            solution.clone_from(&workspace.solution);
        });
        self.reuse = Some(table);
    }

    fn undetermined(&self) -> Error {
        Error::Undetermined {
            particles: self.settings.particles,
            form: match self.settings.form {
                Form::Weak => "weak",
                Form::Strong => "strong",
            },
            poissons_ratio: self.law.poissons_ratio(),
        }
    }
}

/// What the model without calibration does not have.
fn check_uncalibrated(settings: &FiniteSphereSettings, bond: Friction) -> Result<(), Error> {
    let asked = match settings {
        FiniteSphereSettings {
            calibration: Fit::Fitted,
            ..
        } => return Ok(()),
        _ if bond == Friction::Bonded => "a tip that sticks",
        FiniteSphereSettings {
            form: Form::Strong, ..
        } => "the strong form",
        FiniteSphereSettings {
            placement: Placement::Source,
            ..
        } => "the source's placement",
        FiniteSphereSettings {
            assembly: Assembly::Reused,
            ..
        } => "reused equations",
        FiniteSphereSettings {
            solver: Solver::Gmres { .. },
            ..
        } => "GMRES",
        _ => return Ok(()),
    };
    Err(Error::NotWithoutCalibration { asked })
}
