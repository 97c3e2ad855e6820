mod contact_update;
mod frictional_contact;
mod press;
mod supports;

pub use frictional_contact::{ContactNode, FrictionalContact};

use std::sync::Arc;

use super::super::continuation::{Reached, Steps, extrapolated};
use super::super::model::{
    FiniteElementModel, FiniteElementState, FiniteElementWorkspace, Formulation,
};
use super::super::newton::{self, Failure, SolverControls};
use super::super::relaxation::{RelaxationHistory, RelaxationStep};
use super::super::snap::equilibrate_downhill;
use super::super::supports::Supports;
use super::base::ElasticBase;
use super::contact::{ContactStatus, Place};
use super::indenter::{Indenter, IndenterShape};
use super::mesh::{Base, Block, Body};
use super::sensitivities::{Sensitivities, SensitivityParameter};
use crate::material::law::Law;
use crate::{Error, FibreError, PronySeries, Strain};
use press::SearchMethod;

/// An indentation to be solved on one mesh.
#[derive(Debug, Clone)]
pub struct IndentationSettings {
    /// The tissue.
    pub block: Block,
    /// The indenter.
    pub indenter: Indenter,
    /// Its instantaneous law; with [`Strain::Small`] the side does not touch.
    pub law: Arc<dyn Law>,
    /// Its relaxation; no terms for an elastic tissue.
    pub prony: PronySeries,
    /// Depth [m] that the mesh is made for: the contact of a sphere or a cone grows up to it.
    pub deepest: f64,
    /// How often every element of the usual mesh is halved; −1 doubles it.
    pub halvings: i32,
}

/// The force on the indenter at a depth.
#[derive(Debug, Clone, PartialEq)]
pub struct IndentationPoint {
    /// Time since the indenter first touched [s].
    pub time: f64,
    /// Depth [m].
    pub depth: f64,
    /// Force on the tissue [N].
    pub force: f64,
    /// Strain energy of the elastic law [J].
    pub energy: f64,
    /// Change of the force with each parameter of the law [N per unit], and with the logarithm of the stiffness of an
    /// elastic base [N], where requested.
    pub sensitivities: Vec<f64>,
    /// How the indenter touches, with Coulomb friction.
    pub friction: Option<FrictionalContact>,
}

/// An indentation in progress.
#[derive(Debug)]
pub struct IndentationRun {
    pub(super) model: FiniteElementModel,
    pub(super) workspace: FiniteElementWorkspace,
    indenter: Indenter,
    /// The law of the tissue, and that of an elastic base.
    laws: Vec<Arc<dyn Law>>,
    /// Radius of the contact at the depth that the mesh is made for [m]: the scale of steps.
    scale: f64,
    prony: PronySeries,
    /// Nodes of the surface that can touch, from the axis outward.
    pub(super) top: Vec<usize>,
    /// Supports apart from the indenter: bottom and axis.
    rest: Vec<Option<f64>>,
    pub(super) now: ConvergedIncrement,
    /// The previous increment, from which the next is predicted.
    before: Option<ConvergedIncrement>,
    /// Step lengths [m].
    steps: Steps,
    /// Whether a part of the indenter has Coulomb friction.
    has_friction: bool,
    /// Whether the depth never decreased.
    only_deeper: bool,
}

/// An equilibrium at a depth.
#[derive(Debug, Clone)]
pub(super) struct ConvergedIncrement {
    pub(super) time: f64,
    pub(super) depth: f64,
    pub(super) state: FiniteElementState,
    /// Contact of each node of the top.
    pub(super) statuses: Vec<ContactStatus>,
    history: Option<RelaxationHistory>,
    pub(super) slopes: Option<Sensitivities>,
}

/// Steps in radii of the contact [-]: the first, the longest, the shortest before giving up.
const FIRST_STEP: f64 = 0.1;
const LONGEST_STEP: f64 = 0.5;
const SHORTEST_STEP: f64 = 1e-3;
/// Rounds of Newton's method and changes of contact at one depth.
const MAX_CHANGES: usize = 24;
/// The same with Coulomb friction, where nodes stick and slip too.
const MAX_CHANGES_WITH_FRICTION: usize = 60;
/// Longest step with Coulomb friction, in parts of the depth that the mesh is made for [-]: slip depends on the way, and
/// backward differences of it have an error of the first power of the step.
const FRICTION_STEP: f64 = 1.0 / 32.0;
/// Enough to see which nodes touch without friction.
const ROUGH: SolverControls = SolverControls {
    tolerance: 1e-3,
    ..SolverControls::ATTEMPT
};
/// From there to equilibrium, without a further solution where that is reached.
const FINISH: SolverControls = SolverControls {
    least: 0,
    ..SolverControls::ATTEMPT
};
/// Solutions of the linear system after which steps grow, and above which they shrink.
const LITTLE_EFFORT: usize = 6;
const MUCH_EFFORT: usize = 12;

impl ConvergedIncrement {
    fn reached(&self) -> Reached<'_> {
        Reached {
            place: self.depth,
            unknowns: &self.state.unknowns,
        }
    }
}

impl IndentationRun {
    /// An indenter that just touches.
    ///
    /// # Errors
    /// When the block is smaller than the indenter, or see [`FiniteElementModel::new`].
    pub fn new(settings: &IndentationSettings) -> Result<Self, Error> {
        settings.block.check(&settings.indenter)?;
        Self::in_body(Body::block(settings), settings, None)
    }

    /// An indenter that just touches a layer, which is the block, on an elastic base. Both relax alike.
    ///
    /// # Errors
    /// As [`Self::new`], and when the base has no thickness or no stiffness.
    pub fn on_base(settings: &IndentationSettings, base: ElasticBase) -> Result<Self, Error> {
        settings.block.check(&settings.indenter)?;
        let below = Block {
            height: base.thickness,
            ..settings.block
        };
        below.check(&settings.indenter)?;
        let law = base.law(settings.law.as_ref())?;
        let body = Body::on_base(settings, base.thickness);
        Self::in_body(body, settings, Some(law))
    }

    /// A flat punch that just touches a block whose elements shrink towards its edge, with `parts` of them along half
    /// the width of the rings there; the halvings of `settings` are not used.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(super) fn around_edge(settings: &IndentationSettings, parts: usize) -> Result<Self, Error> {
        settings.block.check(&settings.indenter)?;
        Self::in_body(Body::around_edge(settings, parts), settings, None)
    }

    /// An indenter that just touches the pole of a hemisphere, which is as high as the block and stands in its place.
    ///
    /// # Errors
    /// When it is smaller than the indenter, or see [`FiniteElementModel::new`].
    pub fn on_hemisphere(settings: &IndentationSettings) -> Result<Self, Error> {
        let within = Block {
            radius: settings.block.height,
            ..settings.block
        };
        within.check(&settings.indenter)?;
        Self::in_body(Body::hemisphere(settings), settings, None)
    }

    fn in_body(
        body: Body,
        settings: &IndentationSettings,
        base: Option<Arc<dyn Law>>,
    ) -> Result<Self, Error> {
        let indenter = settings.indenter;
        indenter.check()?;
        let top = body.top;
        if settings.law.has_fibres() {
            let model = "an axisymmetric indentation";
            return Err(FibreError::NoDirection { model }.into());
        }
        let laws: Vec<_> = [settings.law.clone()].into_iter().chain(base).collect();
        let (mesh, formulation) = (body.mesh, Formulation::Mixed);
        let model = FiniteElementModel::with_regions(mesh, &laws, &body.regions, formulation)?;
        let glued = match settings.block.base {
            Base::Bonded => body.bottom.clone(),
            Base::Lubricated => Vec::new(),
        };
        let rest = Supports::none(&model)
            .fix(&model, glued, 0, 0.0)
            .fix(&model, body.bottom, 1, 0.0)
            .fix(&model, body.axis, 0, 0.0)
            .prescribed;
        let scale = indenter.scale(settings.deepest);
        let statuses = top
            .iter()
            .map(|&node| {
                let rest = model.mesh().nodes[node];
                indenter.first_touch(Place {
                    radius: rest.x,
                    above: rest.y,
                })
            })
            .collect();
        let relaxes = !settings.prony.terms().is_empty();
        let has_friction = indenter.coefficients().next().is_some();
        let longest = match has_friction && settings.deepest > 0.0 {
            true => FRICTION_STEP * settings.deepest,
            false => LONGEST_STEP * scale,
        };
        Ok(Self {
            workspace: FiniteElementWorkspace::new(&model)?,
            indenter,
            laws,
            scale,
            prony: settings.prony.clone(),
            top,
            rest,
            now: ConvergedIncrement {
                time: 0.0,
                depth: 0.0,
                state: FiniteElementState::at_rest(&model),
                statuses,
                history: relaxes.then(|| RelaxationHistory::at_rest(&model, &settings.prony)),
                slopes: None,
            },
            before: None,
            steps: Steps {
                next: longest.min(FIRST_STEP * scale),
                longest,
                shortest: (SHORTEST_STEP * scale).min(SHORTEST_STEP / LONGEST_STEP * longest),
                easy: LITTLE_EFFORT,
                hard: MUCH_EFFORT,
            },
            has_friction,
            only_deeper: true,
            model,
        })
    }

    /// Answers also for the change of force with the law's parameters, from now on. Only at rest, and
    /// for an elastic tissue; with Coulomb friction they stay empty.
    pub fn with_sensitivities(mut self) -> Self {
        let mut sought = Vec::new();
        for (region, law) in self.laws.iter().enumerate() {
            let known = law.parameters().into_iter().enumerate();
            let of_law = known.map(|(parameter, (_, value))| SensitivityParameter {
                law: law.clone(),
                parameter,
                unit: if region == 0 { 1.0 } else { value },
            });
            // The first parameter of a base is its modulus.
            sought.extend(of_law.take(if region == 0 { usize::MAX } else { 1 }));
        }
        self.now.slopes = (!self.has_friction).then(|| Sensitivities::at_rest(&self.model, sought));
        self
    }

    /// The body.
    pub fn model(&self) -> &FiniteElementModel {
        &self.model
    }

    /// Its state.
    pub fn state(&self) -> &FiniteElementState {
        &self.now.state
    }

    /// Whether nothing depends on the way: small strain and a contact that does not grow.
    fn is_linear(&self) -> bool {
        self.model.law.volume().strain == Strain::Small
            && matches!(self.indenter.shape, IndenterShape::Flat { .. })
    }

    /// The force on the indenter now.
    pub fn point(&mut self) -> IndentationPoint {
        let step = self.last_relaxation();
        let supports = self.supports(&self.now.statuses, self.now.depth, step.as_ref());
        let assembled = newton::assemble(
            &self.model,
            &supports,
            &self.now.state.unknowns,
            &mut self.workspace,
        );
        debug_assert!(assembled.is_ok(), "an equilibrium was found here");
        let activated = || {
            let each = self.top.iter().zip(&self.now.statuses);
            each.filter(|(_, status)| **status != ContactStatus::Free)
                .map(|(node, _)| 2 * node + 1)
        };
        IndentationPoint {
            time: self.now.time,
            depth: self.now.depth,
            // Not −Σ, which is −0 at rest.
            force: 0.0
                - activated()
                    .map(|row| self.workspace.residual[row])
                    .sum::<f64>(),
            energy: self.workspace.energy,
            sensitivities: self.now.slopes.as_ref().map_or_else(Vec::new, |slopes| {
                slopes.force(&self.model, &self.now.state, &self.workspace, activated)
            }),
            friction: self.has_friction.then(|| self.frictional_contact()),
        }
    }

    /// The relaxation step that led to where the body stands.
    fn last_relaxation(&self) -> Option<RelaxationStep> {
        let before = self.before.as_ref()?;
        let history = before.history.as_ref()?;
        Some(history.step(&self.prony, self.now.time - before.time))
    }

    /// An equilibrium at `depth` and `time`, contacts included, and the number of solutions it took.
    fn increment_at(
        &mut self,
        time: f64,
        depth: f64,
        way: SearchMethod,
    ) -> Result<(ConvergedIncrement, usize), Failure> {
        let duration = time - self.now.time;
        let relaxing = self
            .now
            .history
            .as_ref()
            .map(|m| m.step(&self.prony, duration));
        let mut statuses = self.now.statuses.clone();
        let mut slopes = self.now.slopes.clone();
        let mut state = self.predict(depth, relaxing.as_ref())?;
        let mut taken = 0;
        // A node that sticks stays where it was activated, so that place must be exact.
        let first = if self.slides() {
            ROUGH
        } else {
            SolverControls::ATTEMPT
        };
        let mut controls = first;
        let mut released = vec![false; statuses.len()];
        let most = match self.has_friction {
            true => MAX_CHANGES_WITH_FRICTION,
            false => MAX_CHANGES,
        };
        for _ in 0..most {
            let supports = self.supports(&statuses, depth, relaxing.as_ref());
            let before = (way == SearchMethod::Downhill).then(|| state.clone());
            let workspace = &mut self.workspace;
            let done = newton::correct(controls, &self.model, &supports, &mut state, workspace);
            let unstable = relaxing.is_none()
                && workspace.factors.negative_eigenvalues() > self.model.pressures();
            let done = done.and_then(|done| match unstable && done.iterations > 0 {
                true => Err(Failure::NotConverged),
                false => Ok(done),
            });
            let done = match (done, before) {
                (Err(_), Some(before)) => {
                    state = before;
                    equilibrate_downhill(&self.model, &supports, &mut state, workspace)?
                }
                (done, _) => done?,
            };
            taken += done.iterations;
            if let Some(slopes) = &mut slopes {
                slopes.solve(&self.model, &supports, &state, &mut self.workspace)?;
            }
            if self.update_statuses(depth, &state, &mut statuses, &mut released, slopes.as_mut())? {
                controls = first;
                continue;
            }
            if controls.tolerance == ROUGH.tolerance {
                controls = FINISH;
                continue;
            }
            let mut history = self.now.history.clone();
            if let Some(history) = &mut history {
                history.advance(&self.model, &self.prony, duration, &state);
            }
            self.note_places(&mut statuses, depth, &state);
            let increment = ConvergedIncrement {
                time,
                depth,
                state,
                statuses,
                history,
                slopes,
            };
            return Ok((increment, taken));
        }
        Err(Failure::NotConverged)
    }

    /// The body at `depth` if it went on as before; its residual and tangent are assembled.
    fn predict(
        &mut self,
        depth: f64,
        relaxing: Option<&RelaxationStep>,
    ) -> Result<FiniteElementState, Failure> {
        let supports = self.supports(&self.now.statuses, depth, relaxing);
        let workspace = &mut self.workspace;
        let mut state = self.now.state.clone();
        if let Some(before) = &self.before {
            let travelled = self.now.depth - before.depth;
            let ahead = (depth - self.now.depth) / travelled;
            if travelled != 0.0 && ahead > 0.0 {
                state.unknowns = extrapolated(self.now.reached(), Some(before.reached()), depth);
                if newton::assemble(&self.model, &supports, &state.unknowns, workspace).is_ok() {
                    return Ok(state);
                }
                state = self.now.state.clone();
            }
        }
        newton::assemble(&self.model, &supports, &state.unknowns, workspace)?;
        Ok(state)
    }
}
