use nalgebra::Matrix3;

use super::constraints::{Conditions, Constraints, Turned};
use super::coupling::Coupling;
use super::drag::Drag;
use super::kernel::{self, Deformed};
use super::model::NonlinearModel;
use super::predictor;
use super::relaxation::{Relaxation, StepShares};
use super::rotation;
use super::state::NonlinearState;
use crate::Vec3;

/// Part of the slope at the beginning of a step that may be left at its end before the step is shortened [-].
const SLOPE_LEFT: f64 = 0.3;

/// A residual that releases so many times less energy than the first is rounding, in numbers of single precision [-].
const RESOLVED: f64 = 1e14;

/// Conjugate gradients go on, up to [`MAX_TIMES`] as many, until they have reduced the residual's energy so many times [-].
/// Thin walls need it: the residual that is left makes the organ too stiff within a step, and the force under a tip
/// oscillates with a growing amplitude.
const REDUCED: f64 = 1e3;
const MAX_TIMES: usize = 2;

/// Settings of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepSettings {
    /// Conjugate gradients; where they converge slowly, up to twice as many [-].
    pub iterations: usize,
    /// Time since the last step [s], in which tissue relaxes; zero is a jump.
    pub elapsed: f64,
}

/// The result of a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Advance {
    /// Energy that the residual of the first iteration would release, over that of the last [-]: far above one where the
    /// iterations converge.
    pub reduction: f64,
    /// Whether the step was shortened because the force against it had grown.
    pub was_limited: bool,
    /// Whether the stiffness was not positive along a direction, which ended the iterations.
    pub was_unstable: bool,
    /// Whether no finite displacements were found: the body was then reset to rest.
    pub was_reset: bool,
    /// Whether an element is inside out; for a body that does not relax this is checked only where the step was
    /// unstable.
    pub is_inverted: bool,
}

impl Advance {
    /// Whether the step found no equilibrium and its forces are meaningless: the stiffness is not positive, and elements are
    /// inverted.
    pub fn has_no_equilibrium(&self) -> bool {
        self.was_reset || (self.was_unstable && self.is_inverted)
    }
}

/// Scratch of a step; dropping it changes nothing.
#[derive(Debug, Clone)]
pub struct Workspace {
    deformed: Vec<Deformed<f32>>,
    shares: Option<StepShares>,
    /// See [`Drag::rate`].
    rate: f32,
    forces: Vec<f32>,
    gradients: Vec<[f32; 9]>,
    guess: Vec<f64>,
    constraints: Constraints,
    residual: Vec<f32>,
    /// Change of the displacements in this step [m].
    change: Vec<f32>,
    z: Vec<f32>,
    direction: Vec<f32>,
    product: Vec<f32>,
    scratch: Vec<f32>,
}

impl Workspace {
    pub(super) fn new(model: &NonlinearModel, tools: usize) -> Self {
        let nodes = model.nodes().len();
        let vector = || vec![0.0_f32; 3 * nodes];
        Self {
            deformed: vec![Deformed::default(); model.packs.len()],
            shares: model.relaxation.as_ref().map(Relaxation::shares),
            rate: 0.0,
            forces: vector(),
            gradients: vec![[0.0; 9]; nodes],
            guess: vec![0.0; 3 * nodes],
            constraints: Constraints::new(model, tools),
            residual: vector(),
            change: vector(),
            z: vector(),
            direction: vector(),
            product: vector(),
            scratch: vec![0.0; model.rest.scratch()],
        }
    }
}

impl Workspace {
    /// Stiffness of the contacts of the last step against a small displacement x of the bodies behind them [N/m], where
    /// contact number i moves by `motion(i, d) · x` along a direction d: its normal, and where it sticks along the surface.
    pub fn contact_stiffness(
        &mut self,
        motion: impl Fn(usize, &Vec3) -> Vec3 + Clone,
    ) -> Matrix3<f64> {
        self.constraints.stiffness(motion)
    }
}

/// Moves the body to satisfy the `conditions`: one step of Newton's method, whose linear system is solved by
/// conjugate gradients.
///
/// # Panics
/// When `state` or `workspace` are those of another model or fewer tools, a contact has no point, or a tool loads a node that
/// can move and cannot be loaded.
pub fn advance(
    model: &NonlinearModel,
    conditions: Conditions<'_>,
    pace: StepSettings,
    state: &mut NonlinearState,
    workspace: &mut Workspace,
) -> Advance {
    pulp::Arch::new().dispatch(Step {
        model,
        conditions,
        pace,
        state,
        workspace,
    })
}

/// A step, compiled for the vector instructions of the processor. A closure would be called through a shim, which is
/// compiled without them.
struct Step<'a> {
    model: &'a NonlinearModel,
    conditions: Conditions<'a>,
    pace: StepSettings,
    state: &'a mut NonlinearState,
    workspace: &'a mut Workspace,
}

impl pulp::WithSimd for Step<'_> {
    type Output = Advance;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Advance {
        let Self {
            model,
            conditions,
            pace,
            state,
            workspace,
        } = self;
        step(model, conditions, pace, state, workspace)
    }
}

#[inline(always)]
fn step(
    model: &NonlinearModel,
    conditions: Conditions<'_>,
    pace: StepSettings,
    state: &mut NonlinearState,
    workspace: &mut Workspace,
) -> Advance {
    let couplings = conditions.couplings;
    state.fade(couplings);
    workspace.begin(model, pace.elapsed, state);
    let is_continued = predictor::predict(model, conditions, state, &mut workspace.guess);
    let mut advance = solve(model, conditions, pace.iterations, state, workspace);
    if advance.was_unstable && is_continued {
        predictor::stay(state, &mut workspace.guess);
        advance = solve(model, conditions, pace.iterations, state, workspace);
    }
    workspace.bound(model.farthest, &mut advance);
    advance.was_limited |= workspace.take(model, couplings, state);
    let body = Turned {
        model,
        rotations: &state.rotations,
    };
    let (residual, displacements) = (&workspace.residual, &state.displacements);
    workspace.constraints.finish(body, residual, displacements);
    workspace.constraints.store(model, couplings, state);
    advance.is_inverted = workspace.end(model, advance.was_limited, state);
    if advance.was_unstable && !model.relaxes() {
        advance.is_inverted = kernel::are_inverted(&workspace.deformed);
    }
    state.is_smooth = !advance.was_limited && !advance.was_unstable;
    advance.was_reset = !state.is_finite();
    if advance.was_reset {
        state.reset(model);
    }
    advance
}

/// Finds the change from the guess that satisfies the conditions.
#[inline(always)]
fn solve(
    model: &NonlinearModel,
    conditions: Conditions<'_>,
    iterations: usize,
    state: &mut NonlinearState,
    workspace: &mut Workspace,
) -> Advance {
    workspace.deform(model, GuessOrEnd::Guess, state);
    workspace.rotate(model, state);
    let body = Turned {
        model,
        rotations: &state.rotations,
    };
    workspace.constraints.prepare(body, conditions, state);
    workspace.carry(body, conditions.couplings);
    workspace.iterate(body, conditions.couplings, iterations)
}

enum GuessOrEnd {
    Guess,
    End,
}

impl Workspace {
    /// Finds the rotations of the nodes where the body is in `state`.
    pub(super) fn turn(&mut self, model: &NonlinearModel, state: &mut NonlinearState) {
        self.deform(model, GuessOrEnd::End, state);
        self.rotate(model, state);
    }

    #[inline(always)]
    fn begin(&mut self, model: &NonlinearModel, elapsed: f64, state: &NonlinearState) {
        self.rate = Drag::rate(elapsed);
        if let (Some(relaxation), Some(shares)) = (&model.relaxation, &mut self.shares) {
            relaxation.begin(elapsed, &state.stress, shares, &mut self.deformed);
        }
    }

    /// Stores the stress. Returns whether an element is inside out.
    #[inline(always)]
    fn end(
        &mut self,
        model: &NonlinearModel,
        was_shortened: bool,
        state: &mut NonlinearState,
    ) -> bool {
        if was_shortened && model.relaxes() {
            self.deform(model, GuessOrEnd::End, state);
        }
        match (&model.relaxation, &self.shares) {
            (Some(relaxation), Some(shares)) => {
                relaxation.end(&model.packs, &self.deformed, shares, &mut state.stress)
            }
            _ => false,
        }
    }

    #[inline(always)]
    fn deform(&mut self, model: &NonlinearModel, at: GuessOrEnd, state: &NonlinearState) {
        let (u, before) = match at {
            GuessOrEnd::Guess => (&self.guess, &state.displacements),
            GuessOrEnd::End => (&state.displacements, &state.before),
        };
        self.forces.fill(0.0);
        kernel::forces(&model.packs, u, &mut self.deformed, &mut self.forces);
        let drag = &model.drag;
        drag.add_forces(self.rate, u, before, &mut self.forces);
        self.constraints.walls.deform(model, u, &mut self.forces);
        for (force, weight) in self.forces.iter_mut().zip(&model.weight) {
            *force -= weight;
        }
        if state.fades > 0 {
            for (force, load) in self.forces.iter_mut().zip(&state.fading) {
                *force -= load;
            }
        }
    }

    #[inline(always)]
    fn rotate(&mut self, model: &NonlinearModel, state: &mut NonlinearState) {
        rotation::add_gradients(&model.packs, &self.deformed, &mut self.gradients);
        rotation::rotate(
            &self.gradients,
            &model.inverse_volumes,
            &mut state.rotations,
        );
    }

    /// Moves the body so that every condition holds, and finds the residual.
    #[inline(always)]
    fn carry(&mut self, body: Turned<'_>, couplings: &[Option<Coupling<'_>>]) {
        self.constraints
            .carry(body, couplings, &self.guess, &mut self.change);
        self.multiply(body.model, true);
        let forces = self.forces.iter().zip(&self.product);
        for (r, (force, product)) in self.residual.iter_mut().zip(forces) {
            *r = -force - product;
        }
        self.constraints.add_load(couplings, &mut self.residual);
    }

    /// The product of the stiffness with the change, or else with the direction.
    #[inline(always)]
    fn multiply(&mut self, model: &NonlinearModel, with_change: bool) {
        let vector = if with_change {
            &self.change
        } else {
            &self.direction
        };
        self.product.fill(0.0);
        kernel::products(&model.packs, &self.deformed, vector, &mut self.product);
        let walls = &self.constraints.walls;
        walls.add_product(model, vector, &mut self.product);
        let drag = &model.drag;
        drag.add_product(self.rate, vector, &mut self.product);
    }

    #[inline(always)]
    fn iterate(
        &mut self,
        body: Turned<'_>,
        couplings: &[Option<Coupling<'_>>],
        iterations: usize,
    ) -> Advance {
        let Turned { model, rotations } = body;
        let mut advance = Advance::default();
        let (mut released, mut first) = (0.0, 0.0);
        let most = MAX_TIMES * iterations;
        for iteration in 0..most {
            // By the last known residual: the present one would cost a solution.
            if iteration >= iterations && first >= REDUCED * released {
                break;
            }
            model
                .rest
                .apply(rotations, &self.residual, &mut self.z, &mut self.scratch);
            self.constraints.project(body, &self.residual, &mut self.z);
            let now = dot(&self.residual, &self.z);
            if iteration == 0 {
                first = now;
            }
            if now <= 0.0 || !now.is_finite() || first > RESOLVED * now {
                break;
            }
            let beta = if iteration == 0 { 0.0 } else { now / released };
            released = now;
            for (direction, z) in self.direction.iter_mut().zip(&self.z) {
                *direction = z + beta as f32 * *direction;
            }
            let own = self.constraints.update_direction(beta);
            self.multiply(model, false);
            let curvature = dot(&self.direction, &self.product) + own;
            advance.was_unstable = curvature <= 0.0;
            let length = match advance.was_unstable {
                false => now / curvature,
                // Downhill all the same, as far as the stiffness at rest has it.
                true if iteration == 0 => 1.0,
                true => break,
            };
            let along = self.direction.iter().zip(&self.product);
            for ((change, r), (direction, product)) in
                self.change.iter_mut().zip(&mut self.residual).zip(along)
            {
                *change += length as f32 * direction;
                *r -= length as f32 * product;
            }
            self.constraints
                .step_along(couplings, length, &mut self.residual);
            if advance.was_unstable {
                break;
            }
        }
        advance.reduction = if released > 0.0 {
            first / released
        } else {
            1.0
        };
        advance
    }

    /// Shortens a change that moves a node too far for what is linear about it.
    fn bound(&mut self, farthest: f32, advance: &mut Advance) {
        let largest = self
            .change
            .iter()
            .fold(0.0_f32, |most, by| most.max(by.abs()));
        if largest > farthest {
            let part = farthest / largest;
            self.change.iter_mut().for_each(|by| *by *= part);
            advance.was_limited = true;
        }
    }

    /// Applies the change, or the part along which the energy falls. Returns whether that was less
    /// than all.
    #[inline(always)]
    fn take(
        &mut self,
        model: &NonlinearModel,
        couplings: &[Option<Coupling<'_>>],
        state: &mut NonlinearState,
    ) -> bool {
        let slope = self.slope(couplings);
        std::mem::swap(&mut state.earlier, &mut state.before);
        std::mem::swap(&mut state.before, &mut state.displacements);
        let guess = self.guess.iter().zip(&self.change);
        for (now, (guess, change)) in state.displacements.iter_mut().zip(guess) {
            *now = guess + f64::from(*change);
        }
        self.deform(model, GuessOrEnd::End, state);
        let end = self.slope(couplings);
        let is_short = end.is_finite() && end <= SLOPE_LEFT * slope.abs();
        if is_short || slope >= 0.0 {
            return false;
        }
        let part = if end.is_finite() {
            slope / (slope - end)
        } else {
            0.0
        };
        let guess = self.guess.iter().zip(&self.change);
        for (now, (guess, change)) in state.displacements.iter_mut().zip(guess) {
            *now = guess + part * f64::from(*change);
        }
        true
    }

    /// Slope of the energy along the change, with the forces of tools and contacts as they are [J].
    #[inline(always)]
    fn slope(&mut self, couplings: &[Option<Coupling<'_>>]) -> f64 {
        self.product.fill(0.0);
        self.constraints.add_load(couplings, &mut self.product);
        dot(&self.forces, &self.change) - dot(&self.product, &self.change)
    }
}

/// xᵀ y.
#[inline(always)]
pub(super) fn dot(x: &[f32], y: &[f32]) -> f64 {
    const SUMS: usize = 8;
    let mut sums = [0.0_f32; SUMS];
    let (many, rest) = x.as_chunks::<SUMS>();
    let (others, last) = y.as_chunks::<SUMS>();
    for (x, y) in many.iter().zip(others) {
        for (sum, (x, y)) in sums.iter_mut().zip(x.iter().zip(y)) {
            *sum += x * y;
        }
    }
    let tail: f32 = rest.iter().zip(last).map(|(x, y)| x * y).sum();
    let sum: f64 = sums.iter().map(|&sum| f64::from(sum)).sum();
    sum + f64::from(tail)
}
