use nalgebra::DVector;

use super::coupling::{Coupling, Rows};
use super::kernel::{self, Deformed};
use super::model::NonlinearModel;
use super::relaxation::{Relaxation, StepShares};
use super::rotation;
use super::state::NonlinearState;
use crate::Vec3;

/// Part of the slope at the beginning of a step that may be left at its end before the step is shortened [-].
const SLOPE_LEFT: f64 = 0.3;

/// Largest factor with which the last displacement is continued, or gone back [-].
const MOST_CONTINUED: f64 = 1.5;

/// How a step is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// Conjugate gradients [-].
    pub iterations: usize,
    /// Time since the last step [s], in which tissue relaxes; zero is a jump.
    pub elapsed: f64,
}

/// How a step went.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Advance {
    /// Energy that the residual of the first iteration would release, over that of the last [-]: far above one where the
    /// iterations converge.
    pub reduction: f64,
    /// Whether the step was shortened because the force against it had grown.
    pub was_shortened: bool,
    /// Whether the stiffness was not positive along a direction, which ended the iterations.
    pub was_unstable: bool,
    /// Whether no finite displacements were found, which put the body back to rest.
    pub was_reset: bool,
    /// Whether an element of a body that relaxes is inside out.
    pub is_inverted: bool,
}

/// Scratch of a step; dropping it changes nothing.
#[derive(Debug, Clone)]
pub struct Workspace {
    deformed: Vec<Deformed<f32>>,
    shares: Option<StepShares>,
    forces: Vec<f32>,
    gradients: Vec<[f32; 9]>,
    guess: Vec<f64>,
    rows: Rows,
    residual: Vec<f32>,
    /// Change of the displacements in this step [m].
    change: Vec<f32>,
    z: Vec<f32>,
    direction: Vec<f32>,
    product: Vec<f32>,
    scratch: Vec<f32>,
    small: Small,
}

/// Vectors with a number a row.
#[derive(Debug, Clone)]
struct Small {
    force: DVector<f64>,
    jump: DVector<f64>,
    t: DVector<f64>,
    projected: DVector<f64>,
    direction: DVector<f64>,
}

impl Workspace {
    pub(super) fn new(model: &NonlinearModel, tools: usize) -> Self {
        let (nodes, rows) = (model.nodes().len(), 3 * tools);
        let vector = || vec![0.0_f32; 3 * nodes];
        let small = || DVector::zeros(rows);
        Self {
            deformed: vec![Deformed::default(); model.packs.len()],
            shares: model.relaxation.as_ref().map(Relaxation::shares),
            forces: vector(),
            gradients: vec![[0.0; 9]; nodes],
            guess: vec![0.0; 3 * nodes],
            rows: Rows::new(model, tools),
            residual: vector(),
            change: vector(),
            z: vector(),
            direction: vector(),
            product: vector(),
            scratch: vec![0.0; model.rest.scratch()],
            small: Small {
                force: small(),
                jump: small(),
                t: small(),
                projected: small(),
                direction: small(),
            },
        }
    }
}

/// Takes the body to where `couplings`, one a tool, move it: one step of Newton's method, whose linear system is
/// solved by conjugate gradients.
///
/// # Panics
/// When `state` or `workspace` are those of another model or fewer tools.
pub fn advance(
    model: &NonlinearModel,
    couplings: &[Option<Coupling<'_>>],
    pace: Pace,
    state: &mut NonlinearState,
    workspace: &mut Workspace,
) -> Advance {
    pulp::Arch::new().dispatch(
        #[inline(always)]
        || step(model, couplings, pace, state, workspace),
    )
}

#[inline(always)]
fn step(
    model: &NonlinearModel,
    couplings: &[Option<Coupling<'_>>],
    pace: Pace,
    state: &mut NonlinearState,
    workspace: &mut Workspace,
) -> Advance {
    state.fade(couplings);
    workspace.begin(model, pace.elapsed, state);
    guess(couplings, state, workspace);
    workspace.deform(model, GuessOrEnd::Guess, state);
    workspace.rotate(model, state);
    workspace.rows.list(couplings);
    workspace.rows.prepare(model, couplings, &state.rotations);
    workspace.carry(model, couplings, state);
    let mut advance = workspace.iterate(model, couplings, &state.rotations, pace.iterations);
    workspace.bound(model.farthest, &mut advance);
    advance.was_shortened |= workspace.take(model, couplings, state);
    workspace.finish_forces();
    workspace.remember(couplings, state);
    advance.is_inverted = workspace.end(model, advance.was_shortened, state);
    state.is_smooth = !advance.was_shortened && !advance.was_unstable;
    advance.was_reset = !state.is_finite();
    if advance.was_reset {
        state.reset(model);
    }
    advance
}

enum GuessOrEnd {
    Guess,
    End,
}

/// Continues the last displacement as far as the tools continue their paths.
fn guess(
    couplings: &[Option<Coupling<'_>>],
    state: &mut NonlinearState,
    workspace: &mut Workspace,
) {
    let (mut along, mut length, mut all_known) = (0.0, 0.0, true);
    for (coupling, memory) in couplings.iter().zip(&state.tools) {
        all_known &= coupling.is_some() == memory.is_coupled;
        if let Some(coupling) = coupling {
            let last = state.last_advance(coupling.nodes);
            along += coupling.advance.dot(&last);
            length += last.norm_squared();
        }
    }
    let part = if all_known && state.is_smooth && length > 0.0 {
        (along / length).clamp(-MOST_CONTINUED, MOST_CONTINUED)
    } else {
        0.0
    };
    let now = state.displacements.iter().zip(&state.before);
    for (guess, (now, before)) in workspace.guess.iter_mut().zip(now) {
        *guess = now + part * (now - before);
    }
    for (coupling, memory) in couplings.iter().zip(&mut state.tools) {
        let force = match coupling {
            Some(_) => memory.force + part * (memory.force - memory.force_in_series),
            None => Vec3::zeros(),
        };
        memory.force_in_series = memory.force;
        memory.force = force;
    }
}

impl Workspace {
    #[inline(always)]
    fn begin(&mut self, model: &NonlinearModel, elapsed: f64, state: &NonlinearState) {
        if let (Some(relaxation), Some(shares)) = (&model.relaxation, &mut self.shares) {
            relaxation.begin(elapsed, &state.stress, shares, &mut self.deformed);
        }
    }

    /// Remembers the stress; whether an element is inside out.
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
        let u = match at {
            GuessOrEnd::Guess => &self.guess,
            GuessOrEnd::End => &state.displacements,
        };
        self.forces.fill(0.0);
        kernel::forces(&model.packs, u, &mut self.deformed, &mut self.forces);
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

    /// Moves the body by Z t so that every tool's condition holds, and finds what is then left of the forces.
    #[inline(always)]
    fn carry(
        &mut self,
        model: &NonlinearModel,
        couplings: &[Option<Coupling<'_>>],
        state: &NonlinearState,
    ) {
        for (number, row) in self.rows.rows.iter().enumerate() {
            let force = state.tools[row.tool].force;
            self.small.force[number] = force.dot(&row.direction);
            if let Some(coupling) = &couplings[row.tool] {
                let mut left =
                    coupling.displacement - coupling.offset - coupling.compliance * force;
                for &(node, weight) in coupling.nodes {
                    let u = &self.guess[3 * node as usize..][..3];
                    left -= weight * Vec3::new(u[0], u[1], u[2]);
                }
                self.small.jump[number] = left.dot(&row.direction);
            }
        }
        self.rows.solve(&self.small.jump, &mut self.small.t);
        self.small.force += &self.small.t;
        self.change.fill(0.0);
        self.rows.add_influence(&self.small.t, &mut self.change);
        self.multiply(model, true);
        let forces = self.forces.iter().zip(&self.product);
        for (r, (force, product)) in self.residual.iter_mut().zip(forces) {
            *r = -force - product;
        }
        self.rows
            .add_load(couplings, &self.small.force, &mut self.residual);
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
    }

    #[inline(always)]
    fn iterate(
        &mut self,
        model: &NonlinearModel,
        couplings: &[Option<Coupling<'_>>],
        rotations: &[[f32; 9]],
        iterations: usize,
    ) -> Advance {
        let mut advance = Advance::default();
        let (mut released, mut first) = (0.0, 0.0);
        for iteration in 0..iterations {
            model
                .rest
                .apply(rotations, &self.residual, &mut self.z, &mut self.scratch);
            self.rows.project(&self.residual, &mut self.small.projected);
            self.rows.solve(&self.small.projected, &mut self.small.t);
            self.small.t.neg_mut();
            self.rows.add_influence(&self.small.t, &mut self.z);
            let now = dot(&self.residual, &self.z);
            if iteration == 0 {
                first = now;
            }
            if now <= 0.0 || !now.is_finite() {
                break;
            }
            let kept = if iteration == 0 { 0.0 } else { now / released };
            released = now;
            for (direction, z) in self.direction.iter_mut().zip(&self.z) {
                *direction = z + kept as f32 * *direction;
            }
            self.small.direction *= kept;
            self.small.direction += &self.small.t;
            self.multiply(model, false);
            let own = self.rows.own_curvature(&self.small.direction);
            let curvature = dot(&self.direction, &self.product) + own;
            advance.was_unstable = curvature <= 0.0;
            let length = match advance.was_unstable {
                false => now / curvature,
                // Downhill all the same, as far as the stiffness at rest has it.
                true if iteration == 0 => 1.0,
                true => break,
            };
            self.small.force.axpy(length, &self.small.direction, 1.0);
            let along = self.direction.iter().zip(&self.product);
            for ((change, r), (direction, product)) in
                self.change.iter_mut().zip(&mut self.residual).zip(along)
            {
                *change += length as f32 * direction;
                *r -= length as f32 * product;
            }
            self.small.projected.copy_from(&self.small.direction);
            self.small.projected *= length;
            self.rows
                .add_load(couplings, &self.small.projected, &mut self.residual);
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
            advance.was_shortened = true;
        }
    }

    /// The forces of the tools that leave the least of the residual.
    #[inline(always)]
    fn finish_forces(&mut self) {
        self.rows.project(&self.residual, &mut self.small.projected);
        self.rows.solve(&self.small.projected, &mut self.small.t);
        self.small.force -= &self.small.t;
    }

    /// Takes the change, or as much of it as the energy goes down for; whether that was less than all.
    #[inline(always)]
    fn take(
        &mut self,
        model: &NonlinearModel,
        couplings: &[Option<Coupling<'_>>],
        state: &mut NonlinearState,
    ) -> bool {
        let slope = self.slope(couplings);
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

    /// Slope of the energy along the change, with the forces of the tools as they are [J].
    #[inline(always)]
    fn slope(&mut self, couplings: &[Option<Coupling<'_>>]) -> f64 {
        self.product.fill(0.0);
        self.rows
            .add_load(couplings, &self.small.force, &mut self.product);
        dot(&self.forces, &self.change) - dot(&self.product, &self.change)
    }

    fn remember(&self, couplings: &[Option<Coupling<'_>>], state: &mut NonlinearState) {
        for (coupling, memory) in couplings.iter().zip(&mut state.tools) {
            memory.force = Vec3::zeros();
            memory.is_coupled = coupling.is_some();
        }
        for (number, row) in self.rows.rows.iter().enumerate() {
            state.tools[row.tool].force += self.small.force[number] * row.direction;
        }
        for (coupling, memory) in couplings.iter().zip(&mut state.tools) {
            memory.load.fill(0.0);
            for &(node, weight) in coupling.iter().flat_map(|coupling| coupling.nodes) {
                let load = &mut memory.load[3 * node as usize..][..3];
                for (load, force) in load.iter_mut().zip(memory.force.iter()) {
                    *load = (weight * force) as f32;
                }
            }
        }
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
