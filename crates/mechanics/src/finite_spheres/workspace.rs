use super::layout::{CapShape, Layout};
use super::model::{LocalContact, Response};
use super::quadrature::Quadrature;
use super::settings::{FiniteSphereSettings, Form, Solver};
use super::shape_function::ShapeFunctions;
use super::solution::{Partition, Solution, Solved};
use super::strong_form::StrongForm;
use super::uncalibrated::UncalibratedWorkspace;
use super::weak_form::{self, WeakForm};
use crate::linear::gmres::Gmres;
use crate::{LinearElastic, Reached};

/// Scratch of a [`super::FiniteSphereModel`]. Its loss changes no result; a step allocates nothing.
pub struct FiniteSphereWorkspace {
    pub(super) solution: Solution,
    pub(super) functions: ShapeFunctions,
    equations: Equations,
    gmres: Option<(Gmres, f64)>,
    cap: CapShape,
    solved: Solved,
    /// The last contact that was solved, and the answer.
    pub(super) answered: Option<(LocalContact, Response)>,
    /// Of a model that is not calibrated.
    pub(super) uncalibrated: Option<Box<UncalibratedWorkspace>>,
}

enum Equations {
    Weak(Box<WeakForm>),
    Strong(Box<StrongForm>),
}

impl FiniteSphereWorkspace {
    pub(super) fn new(
        settings: &FiniteSphereSettings,
        layout: &Layout,
        quadrature: &Quadrature,
    ) -> Self {
        let count = layout.places.len();
        let (equations, unknowns) = match settings.form {
            Form::Weak => {
                let weak = WeakForm::new(Partition::new(layout), quadrature.count());
                let unknowns = weak.free_unknowns();
                (Equations::Weak(Box::new(weak)), unknowns)
            }
            Form::Strong => (
                Equations::Strong(Box::new(StrongForm::new(layout))),
                3 * count,
            ),
        };
        let gmres = match settings.solver {
            Solver::Direct => None,
            Solver::Gmres { tolerance } => Some((Gmres::new(unknowns, 3), tolerance)),
        };
        Self {
            solution: Solution::new(count),
            functions: ShapeFunctions::with_capacity(count),
            equations,
            gmres,
            cap: CapShape::FLAT,
            solved: Solved::Directly,
            answered: None,
            uncalibrated: None,
        }
    }

    /// Iterations of the last solution; zero when it was direct.
    pub fn iterations(&self) -> usize {
        match self.solved {
            Solved::Iteratively(iterations) => iterations,
            Solved::Directly | Solved::InPlaceOfIterations(_) => 0,
        }
    }

    /// Where iterations did not reach their tolerance in the last solution: both [-].
    pub(super) fn not_converged(&self) -> Option<Reached> {
        match (self.solved, &self.gmres) {
            (Solved::InPlaceOfIterations(unbounded), Some((_, used))) => Some(Reached {
                unbounded,
                used: *used,
            }),
            _ => None,
        }
    }

    /// Places the particles on the template under a surface of shape `cap`.
    pub(super) fn place(&mut self, layout: &Layout, cap: CapShape) {
        self.cap = cap;
        self.solution.place(layout, cap, self.support());
    }

    /// Takes over the positions that `fill` writes.
    pub(super) fn place_with(&mut self, cap: CapShape, fill: impl FnOnce(&mut Vec<crate::Vec3>)) {
        self.cap = cap;
        let support = self.support();
        fill(&mut self.solution.particles.positions);
        self.solution.particles.size_spheres(support);
    }

    pub(super) fn assemble(&mut self, quadrature: &Quadrature, law: &LinearElastic) {
        match &mut self.equations {
            Equations::Weak(form) => form.assemble(&self.solution, quadrature, self.cap, law),
            Equations::Strong(form) => form.assemble(&self.solution, quadrature, self.cap, law),
        }
    }

    pub(super) fn solve(&mut self) {
        let gmres = self.gmres.as_mut().map(|(gmres, goal)| (gmres, *goal));
        self.solved = match &mut self.equations {
            Equations::Weak(form) => form.solve(&mut self.solution, gmres),
            Equations::Strong(form) => form.solve(&mut self.solution, gmres),
        };
    }

    fn support(&self) -> f64 {
        match &self.equations {
            Equations::Weak(_) => weak_form::SUPPORT,
            Equations::Strong(form) => form.support(),
        }
    }
}
