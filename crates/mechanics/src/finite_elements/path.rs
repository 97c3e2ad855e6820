//! The path of equilibria of a body under a growing load, followed over its limit points by arc length.
//!
//! All loads are λ times those of one [`Supports`]. A point of the path has K u̇ = q λ̇, with q the load
//! of λ = 1, and |u̇| = 1 over the displacements. A step of length ℓ starts along u̇ and then solves
//!   r(u, λ) = 0,  |u − u₀|² = ℓ²  (over displacements) [Crisfield 1981]
//! by Newton's method; the second equation is linearised, a plane across the present step that turns
//! with it [Riks 1979; Ramm 1981]. The symmetric factors of K serve both −r and q, so nothing that is
//! exactly singular is ever factored but at a limit point itself, which no step meets to the last bit.
//! λ̇ = ±1/|K⁻¹ q|, its sign such that u̇ keeps its direction; where it falls through zero the load
//! has a maximum.
//!
//! *How we know*: `path::…` (a closed form beyond its maximum), `tube::…`.
//!
//! *Limits*: nothing may slide on a sphere. Bifurcations are counted ([`PathPoint::unstable`]) and passed, no branch is taken.

use super::mismatch::Mismatch;
use super::model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace};
use super::newton::{self, Failure};
use super::supports::Supports;
use crate::Error;

/// An equilibrium on a path.
#[derive(Debug, Clone)]
pub struct PathPoint {
    /// λ [-].
    pub factor: f64,
    /// The body.
    pub state: FiniteElementState,
    /// Ways in which the body would leave this equilibrium if it could: 0 where it is stable.
    pub unstable: usize,
    /// λ̇ [1/m], negative where the load falls.
    pub slope: f64,
    /// u̇ [-], with the rates of the pressures.
    direction: Vec<f64>,
}

/// A path that is being followed.
#[derive(Debug)]
pub struct Path<'a> {
    model: &'a FiniteElementModel,
    workspace: FiniteElementWorkspace,
    /// Loads of λ = 1.
    loads: Supports<'a>,
    before: Option<PathPoint>,
    now: PathPoint,
    arc: f64,
    /// Shortest and longest arc [m].
    arcs: [f64; 2],
}

const MAX_ITERATIONS: usize = 10;
/// Iterations that a step should take.
const EASY: f64 = 4.0;
/// Least cosine between the directions at both ends of a step [-].
const STRAIGHT: f64 = 0.8;
/// Relative accuracy of a limit point's λ [-].
const LIMIT_TOLERANCE: f64 = 1e-5;

impl<'a> Path<'a> {
    /// A path from rest. `loads` are those of λ = 1, the first step reaches about λ = `first` [-].
    ///
    /// # Errors
    /// When the loads are none of `model` or a node slides, the first step is none, there is no memory, or the body can
    /// move at rest without force.
    pub fn new(
        model: &'a FiniteElementModel,
        loads: Supports<'a>,
        first: f64,
    ) -> Result<Self, Error> {
        loads.check(model)?;
        if let Some(sliding) = loads.sliding.first() {
            return Err(Mismatch::CannotSlide { node: sliding.node }.into());
        }
        if !(first > 0.0 && first.is_finite()) {
            return Err(Mismatch::FirstStepOutOfRange { first }.into());
        }
        let mut path = Self {
            workspace: FiniteElementWorkspace::new(model)?,
            now: PathPoint {
                factor: 0.0,
                state: FiniteElementState::at_rest(model),
                unstable: 0,
                slope: 0.0,
                direction: vec![0.0; model.size()],
            },
            before: None,
            arc: 0.0,
            arcs: [0.0; 2],
            model,
            loads,
        };
        let (state, ahead) = (path.now.state.clone(), path.now.direction.clone());
        path.now = path
            .point(0.0, state, &ahead)
            .map_err(|failure| Error::NoPath {
                factor: 0.0,
                failure,
            })?;
        path.arc = first / path.now.slope;
        path.arcs = [1e-5 * path.arc, 1e2 * path.arc];
        Ok(path)
    }

    /// The last point.
    pub fn now(&self) -> &PathPoint {
        &self.now
    }

    /// The point before the last.
    pub fn before(&self) -> Option<&PathPoint> {
        self.before.as_ref()
    }

    /// Goes one step on.
    ///
    /// # Errors
    /// When even a short one fails.
    pub fn advance(&mut self) -> Result<&PathPoint, Error> {
        loop {
            let arc = self.arc;
            match self.step(arc) {
                Ok((next, iterations)) => {
                    let ease = (EASY / iterations as f64).sqrt().clamp(0.5, 1.5);
                    self.arc = (arc * ease).min(self.arcs[1]);
                    self.before = Some(std::mem::replace(&mut self.now, next));
                    return Ok(&self.now);
                }
                Err(_) if arc > self.arcs[0] => self.arc = 0.4 * arc,
                Err(failure) => {
                    return Err(Error::NoPath {
                        factor: self.now.factor,
                        failure,
                    });
                }
            }
        }
    }

    /// The limit point between the last two points, if the load has its maximum there.
    ///
    /// # Errors
    /// When an equilibrium between the two is not found.
    pub fn limit(&mut self) -> Result<Option<PathPoint>, Error> {
        let Some(from) = self.before.clone() else {
            return Ok(None);
        };
        if !(from.slope > 0.0 && self.now.slope <= 0.0) {
            return Ok(None);
        }
        let (mut low, mut high) = (from.clone(), self.now.clone());
        let place = |point: &PathPoint| self.distance(&from, point);
        let (mut start, mut end) = (0.0, place(&high));
        for _ in 0..30 {
            // The parabola with these slopes at both ends has its top here.
            let part = low.slope / (low.slope - high.slope);
            let reach = end - start;
            let up = low.factor + 0.5 * low.slope * part * reach;
            let down = high.factor - 0.5 * high.slope * (1.0 - part) * reach;
            if (up - down).abs() <= LIMIT_TOLERANCE * up.abs() {
                break;
            }
            let at = start + part.clamp(0.05, 0.95) * reach;
            let guess = blend(&low, &high, (at - start) / reach);
            let (point, _) = self
                .correct(&from, guess, at, &low.direction)
                .map_err(|failure| Error::NoPath {
                    factor: low.factor,
                    failure,
                })?;
            if point.slope > 0.0 {
                (low, start) = (point, at);
            } else {
                (high, end) = (point, at);
            }
        }
        Ok(Some(if low.factor > high.factor { low } else { high }))
    }

    /// The equilibrium at λ = `factor` between the points `low` and `high` of a path on which the load
    /// rises.
    ///
    /// # Errors
    /// When it is not found.
    pub fn between(
        &mut self,
        low: &PathPoint,
        high: &PathPoint,
        factor: f64,
    ) -> Result<PathPoint, Error> {
        let (mut low, mut high) = (low.clone(), high.clone());
        let mut failure = Failure::NotConverged;
        for _ in 0..20 {
            match self.try_between(&low, &high, factor) {
                Ok(found) => return Ok(found),
                Err(why) => failure = why,
            }
            let half = 0.5 * self.distance(&low, &high);
            let guess = blend(&low, &high, 0.5);
            let ahead = low.direction.clone();
            match self.correct(&low, guess, half, &ahead) {
                Ok((middle, _)) if middle.factor > factor => high = middle,
                Ok((middle, _)) => low = middle,
                Err(why) => {
                    failure = why;
                    break;
                }
            }
        }
        Err(Error::NoPath { factor, failure })
    }

    fn try_between(
        &mut self,
        low: &PathPoint,
        high: &PathPoint,
        factor: f64,
    ) -> Result<PathPoint, Failure> {
        let reach = self.distance(low, high);
        // The parabola that leaves `low` with its slope and meets `high`, solved for its place.
        let (rise, whole) = (factor - low.factor, high.factor - low.factor);
        let bend = whole - low.slope * reach;
        let slope = low.slope * reach;
        let part = 2.0 * rise / (slope + (slope * slope + 4.0 * bend * rise).max(0.0).sqrt());
        let (_, mut state) = blend(low, high, part.clamp(0.0, 1.0));
        let loads = scaled(&self.loads, factor);
        newton::equilibrate(self.model, &loads, &mut state, &mut self.workspace)?;
        let found = self.point(factor, state, &low.direction)?;
        if found.unstable > low.unstable.max(high.unstable)
            || self.distance(low, &found) > 1.01 * reach
        {
            return Err(Failure::NotConverged);
        }
        Ok(found)
    }

    fn distance(&self, one: &PathPoint, other: &PathPoint) -> f64 {
        let count = self.model.displacements();
        let pairs = one.state.unknowns.iter().zip(&other.state.unknowns);
        let square = |(a, b): (&f64, &f64)| (a - b).powi(2);
        pairs.take(count).map(square).sum::<f64>().sqrt()
    }

    fn step(&mut self, arc: f64) -> Result<(PathPoint, usize), Failure> {
        let from = self.now.clone();
        let mut guess = (from.factor + arc * from.slope, from.state.clone());
        for (x, d) in guess.1.unknowns.iter_mut().zip(&from.direction) {
            *x += arc * d;
        }
        let (point, iterations) = self.correct(&from, guess, arc, &from.direction)?;
        let straight: f64 = dot(
            &point.direction,
            &from.direction,
            self.model.displacements(),
        );
        if straight < STRAIGHT {
            return Err(Failure::NotConverged);
        }
        Ok((point, iterations))
    }

    /// The equilibrium at the distance `arc` of `from`, near `guess`, and the solutions it took.
    fn correct(
        &mut self,
        from: &PathPoint,
        guess: (f64, FiniteElementState),
        arc: f64,
        ahead: &[f64],
    ) -> Result<(PathPoint, usize), Failure> {
        let count = self.model.displacements();
        let (mut factor, mut state) = guess;
        for iteration in 1..=MAX_ITERATIONS {
            let loads = scaled(&self.loads, factor);
            newton::assemble(self.model, &loads, &state.unknowns, &mut self.workspace)?;
            self.workspace.trial.copy_from_slice(&state.unknowns);
            let size = newton::size_of_residual(self.model, &loads, &self.workspace);
            let along: Vec<f64> = state
                .unknowns
                .iter()
                .zip(&from.state.unknowns)
                .take(count)
                .map(|(x, old)| x - old)
                .collect();
            let gap = 0.5 * (dot(&along, &along, count) - arc * arc);
            if size.is_small(newton::SolverControls::FULL.tolerance)
                && gap.abs() <= 1e-8 * arc * arc
            {
                return Ok((self.point(factor, state, ahead)?, iteration));
            }
            let [relax, push] = self.solve(&loads, &state)?;
            let change = -(gap + dot(&along, &relax, count)) / dot(&along, &push, count);
            if !change.is_finite() {
                return Err(Failure::Singular);
            }
            factor += change;
            for ((x, r), q) in state.unknowns.iter_mut().zip(&relax).zip(&push) {
                *x += r + change * q;
            }
        }
        Err(Failure::NotConverged)
    }

    /// The equilibrium with all that belongs to it.
    fn point(
        &mut self,
        factor: f64,
        state: FiniteElementState,
        ahead: &[f64],
    ) -> Result<PathPoint, Failure> {
        let loads = scaled(&self.loads, factor);
        newton::assemble(self.model, &loads, &state.unknowns, &mut self.workspace)?;
        let [_, mut direction] = self.solve(&loads, &state)?;
        let count = self.model.displacements();
        let on = if dot(&direction, ahead, count) < 0.0 {
            -1.0
        } else {
            1.0
        };
        let slope = on / dot(&direction, &direction, count).sqrt();
        direction.iter_mut().for_each(|d| *d *= slope);
        let negative = self.workspace.factors.negative_eigenvalues();
        Ok(PathPoint {
            factor,
            state,
            unstable: negative.saturating_sub(self.model.pressures()),
            slope,
            direction,
        })
    }

    /// K⁻¹ (−r) and K⁻¹ q, with the supports' displacements in both.
    fn solve(
        &mut self,
        loads: &Supports<'_>,
        state: &FiniteElementState,
    ) -> Result<[Vec<f64>; 2], Failure> {
        let (model, workspace) = (self.model, &mut self.workspace);
        let mut relax: Vec<f64> = workspace.residual.iter().map(|r| -r).collect();
        let mut push = vec![0.0; model.size()];
        self.loads
            .add_pressures(model, &state.unknowns, 1.0, &mut push);
        for ((_, number), growth) in model.fluids().zip(self.loads.growths()) {
            push[number] -= growth;
        }
        if let Some((load, times)) = self.loads.dead_load {
            push.iter_mut().zip(load).for_each(|(q, b)| *q += times * b);
        }
        // Prescribed changes, their forces, then their own rows.
        let mut product = vec![0.0; model.size()];
        let mut prescribed = [vec![0.0; model.size()], vec![0.0; model.size()]];
        for (i, target) in loads.prescribed.iter().enumerate() {
            if let (Some(target), Some(full)) = (target, self.loads.prescribed[i]) {
                prescribed[0][i] = target - state.unknowns[i];
                prescribed[1][i] = full;
            }
        }
        for (right, prescribed) in [&mut relax, &mut push].into_iter().zip(&prescribed) {
            model
                .pattern
                .multiply(&workspace.tangent, prescribed, &mut product);
            right.iter_mut().zip(&product).for_each(|(b, p)| *b -= p);
        }
        workspace.supported.copy_from_slice(&workspace.tangent);
        workspace.step.fill(0.0);
        let is_prescribed = newton::prescribed_rows(model, loads);
        newton::eliminate(model, &is_prescribed, workspace, &mut product);
        newton::factor(model, workspace)?;
        for (right, prescribed) in [&mut relax, &mut push].into_iter().zip(&prescribed) {
            for row in (0..is_prescribed.len()).filter(|&row| is_prescribed[row]) {
                right[row] = workspace.supported[model.pattern.range(row).start] * prescribed[row];
            }
            workspace.factors.solve(right);
            if right.iter().any(|x| !x.is_finite()) {
                return Err(Failure::Singular);
            }
        }
        Ok([relax, push])
    }
}

fn dot(a: &[f64], b: &[f64], count: usize) -> f64 {
    a.iter().zip(b).take(count).map(|(a, b)| a * b).sum()
}

fn blend(low: &PathPoint, high: &PathPoint, part: f64) -> (f64, FiniteElementState) {
    let mut state = low.state.clone();
    for (x, y) in state.unknowns.iter_mut().zip(&high.state.unknowns) {
        *x += part * (y - *x);
    }
    (low.factor + part * (high.factor - low.factor), state)
}

/// `loads`, `factor` times.
fn scaled<'a>(loads: &Supports<'a>, factor: f64) -> Supports<'a> {
    let mut all = loads.clone();
    for target in all.prescribed.iter_mut().flatten() {
        *target *= factor;
    }
    let pressures = all.pressures.iter_mut().map(|(_, pressure)| pressure);
    for pressure in pressures.chain(all.pressed.iter_mut().map(|(_, pressure)| pressure)) {
        *pressure *= factor;
    }
    all.growths.iter_mut().for_each(|growth| *growth *= factor);
    if let Some((_, times)) = &mut all.dead_load {
        *times *= factor;
    }
    all
}
