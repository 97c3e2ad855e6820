//! Newton's method with a line search, at given supports and loads.
//!
//! The size of a residual is that of the energy its correction would release, with the diagonal for the
//! stiffness: η² = Σ rᵤ²/Kᵤᵤ + Σ rₚ² μ/Mₚₚ. It is compared with the same sum over the reactions, so
//! that the tolerance is relative and has no unit.

use super::assembly::{self, PRESSURE_REGULARIZATION};
use super::friction;
use super::line_search::LineSearch;
use super::model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace};
use super::rigid_tool::MeridianDistance;
use super::supports::{Sliding, Supports};
use crate::linear::gmres::{Krylov, solve_by_products};

/// Why an equilibrium was not found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Failure {
    /// An element turned inside out.
    #[error("an element turned inside out")]
    Inverted,
    /// The body is free to move without force, or stands exactly at a limit point.
    #[error("the body can move without force")]
    Singular,
    /// The iteration did not end.
    #[error("the iteration did not end")]
    NotConverged,
}

/// An equilibrium that was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Equilibrium {
    /// Solutions of the linear system.
    pub iterations: usize,
}

/// Controls of the nonlinear solver.
#[derive(Debug, Clone, Copy)]
pub(super) struct SolverControls {
    /// Fewest solutions of the linear system.
    pub(super) least: usize,
    /// Most solutions of the linear system.
    pub(super) iterations: usize,
    /// η of the residual over η of the reactions [-]; the force is then good to about its square.
    pub(super) tolerance: f64,
    /// Shortest part of a step that is tried when the residual does not fall [-].
    pub(super) shortest: f64,
    /// Whether the shortest step is taken although the residual does not fall. This often fails,
    /// and is rarely the only way.
    pub(super) accept_larger_residual: bool,
}

impl SolverControls {
    /// The full effort.
    pub(super) const FULL: Self = Self {
        least: 1,
        iterations: 25,
        tolerance: 1e-7,
        shortest: 1.0 / 16.0,
        accept_larger_residual: true,
    };
    /// For an attempt that a shorter one may follow.
    pub(super) const ATTEMPT: Self = Self {
        iterations: 10,
        shortest: 1.0 / 4.0,
        accept_larger_residual: false,
        ..Self::FULL
    };
}

/// Forces of tools below this part of the largest so far are as good as none [-].
const LEFT: f64 = 1e-3;
/// Residual that is left of a step with earlier factors [-]; the next step of Newton's method takes it.
const INEXACT: f64 = 1e-3;
/// Solutions with earlier factors that are tried. New ones take as long as twenty to sixty of them.
const KRYLOV: Krylov = Krylov {
    space: 30,
    cycles: 1,
};
/// They serve again after so many or fewer.
const FEW: usize = 5;
/// Rounding error of a sum [-], relative to its terms.
const ROUNDING: f64 = 1e-13;

/// Brings `state` into equilibrium with `supports`. On failure `state` is the last iterate.
///
/// # Errors
/// See [`Failure`]; a smaller change of the supports may then succeed.
pub(super) fn equilibrate(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    state: &mut FiniteElementState,
    workspace: &mut FiniteElementWorkspace,
) -> Result<Equilibrium, Failure> {
    assemble(model, supports, &state.unknowns, workspace)?;
    correct(SolverControls::FULL, model, supports, state, workspace)
}

/// [`equilibrate`] with these `controls`, from a `state` whose residual and tangent are assembled.
pub(super) fn correct(
    controls: SolverControls,
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    state: &mut FiniteElementState,
    workspace: &mut FiniteElementWorkspace,
) -> Result<Equilibrium, Failure> {
    if supports.leave_free(model) {
        return Err(Failure::Singular);
    }
    let mut iterations = 0;
    loop {
        let gap = prescribe(model, supports, &state.unknowns, workspace);
        let mut size = size_of_residual(model, supports, workspace);
        if supports.contacts.is_some() {
            workspace.largest_reactions = size.reactions.max(workspace.largest_reactions);
            size.reactions = size
                .reactions
                .max(LEFT * LEFT * workspace.largest_reactions);
        }
        if gap == 0.0 && iterations >= controls.least && size.is_small(controls.tolerance) {
            return Ok(Equilibrium { iterations });
        }
        if iterations == controls.iterations {
            return Err(Failure::NotConverged);
        }
        solve(model, supports, workspace)?;
        iterations += 1;
        let search = LineSearch {
            model,
            supports,
            controls,
            before: (gap == 0.0).then_some(size.free),
        };
        search.advance(state, workspace)?;
    }
}

/// Residual and tangent at `unknowns`, loads included.
pub(super) fn assemble(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    unknowns: &[f64],
    workspace: &mut FiniteElementWorkspace,
) -> Result<(), Failure> {
    assembly::assemble(model, unknowns, supports.relaxing, workspace)
        .map_err(|_| Failure::Inverted)?;
    supports.add_pressures(model, unknowns, -1.0, &mut workspace.residual);
    for (cavity, pressure) in &supports.pressures {
        cavity.add_curvature(model, unknowns, -pressure, &mut workspace.tangent);
    }
    for (faces, pressure) in &supports.pressed {
        faces.add_tangent(model, unknowns, -pressure, &mut workspace.tangent);
    }
    if let Some(contacts) = supports.contacts {
        contacts.assemble(
            model,
            unknowns,
            &mut workspace.residual,
            &mut workspace.tangent,
        );
    }
    for ((fluid, number), growth) in model.fluids().zip(supports.growths()) {
        fluid.add_constraint(model, unknowns, number, workspace);
        workspace.residual[number] += growth;
    }
    if let Some((load, times)) = supports.dead_load {
        for (residual, load) in workspace.residual.iter_mut().zip(load) {
            *residual -= times * load;
        }
    }
    Ok(())
}

/// Sizes of the residual on free unknowns, and of the reactions on prescribed ones [J].
pub(super) struct Size {
    pub(super) free: f64,
    pub(super) reactions: f64,
    /// Size of the terms that cancel in it: a body that is turned has no other residual than rounding.
    terms: f64,
}

impl Size {
    pub(super) fn is_small(&self, tolerance: f64) -> bool {
        self.free <= (tolerance * tolerance * self.reactions).max(ROUNDING * ROUNDING * self.terms)
            || self.free < 1e-40
    }
}

pub(super) fn size_of_residual(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    workspace: &FiniteElementWorkspace,
) -> Size {
    let mut size = Size {
        free: 0.0,
        reactions: 0.0,
        terms: 0.0,
    };
    let diagonal = |i: usize| workspace.tangent[model.pattern.range(i).start];
    let mut slides = vec![false; supports.prescribed.len()];
    for contact in &supports.sliding {
        slides[2 * contact.node..2 * contact.node + 2].fill(true);
    }
    for (i, prescribed) in supports.prescribed.iter().enumerate() {
        let part = workspace.residual[i].powi(2) / diagonal(i).abs();
        size.terms += diagonal(i).abs() * workspace.trial[i].powi(2);
        if prescribed.is_some() {
            size.reactions += part;
        } else if !slides[i] {
            size.free += part;
        }
    }
    for contact in &supports.sliding {
        let place = signed_distance(model, contact, &workspace.trial);
        let n = place.normal;
        let rows = [2 * contact.node, 2 * contact.node + 1];
        let [normal, tangential] = place.components(rows.map(|row| workspace.residual[row]));
        let across = tangential - contact.force_ratio * normal;
        let [stiff_r, stiff_z] = rows.map(|row| diagonal(row).abs());
        let along_normal = n[0] * n[0] * stiff_r + n[1] * n[1] * stiff_z;
        let along_surface = n[1] * n[1] * stiff_r + n[0] * n[0] * stiff_z;
        size.free += across * across / along_surface;
        size.reactions += normal * normal / along_normal;
    }
    let contacts = supports.contacts;
    if !supports.pressures.is_empty() || !supports.pressed.is_empty() || contacts.is_some() {
        let mut load = vec![0.0; model.size()];
        supports.add_pressures(model, &workspace.trial, 1.0, &mut load);
        if let Some(contacts) = contacts {
            contacts.add_forces(model, &workspace.trial, 1.0, &mut load);
        }
        size.reactions += (0..model.displacements())
            .map(|i| load[i].powi(2) / diagonal(i).abs())
            .sum::<f64>();
    }
    let softest =
        1.0 / model.law.volume().bulk_modulus + PRESSURE_REGULARIZATION / model.shear_modulus;
    for (fluid, number) in model.fluids() {
        let volume = fluid.volume_at_rest(model);
        size.free += workspace.residual[number].powi(2) * model.shear_modulus / volume;
    }
    for i in model.displacements()..model.size() - model.fluids().len() {
        // M = diagonal / compressibility.
        let mass = diagonal(i).abs() / softest;
        size.free += workspace.residual[i].powi(2) * model.shear_modulus / mass;
    }
    size
}

/// Puts the corrections that the supports ask for into the step, zero elsewhere; keeps `unknowns` as
/// the trial. Answers the largest of them [m].
pub(super) fn prescribe(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    unknowns: &[f64],
    workspace: &mut FiniteElementWorkspace,
) -> f64 {
    workspace.trial.copy_from_slice(unknowns);
    workspace.step.fill(0.0);
    let mut gap: f64 = 0.0;
    let mut extent: f64 = 0.0;
    for (i, prescribed) in supports.prescribed.iter().enumerate() {
        if let Some(target) = prescribed {
            workspace.step[i] = target - unknowns[i];
            gap = gap.max(workspace.step[i].abs());
            extent = extent.max(target.abs());
        }
    }
    for contact in &supports.sliding {
        let correction = -signed_distance(model, contact, unknowns).distance;
        workspace.step[2 * contact.node] = correction;
        gap = gap.max(correction.abs());
        extent = extent.max(contact.surface.size());
    }
    // Rounding is no gap.
    if gap <= 1e-13 * extent { 0.0 } else { gap }
}

/// Solves for the step, with the supports' corrections already in it.
pub(super) fn solve(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    workspace: &mut FiniteElementWorkspace,
) -> Result<(), Failure> {
    workspace.supported.copy_from_slice(&workspace.tangent);
    let mut right: Vec<f64> = workspace.residual.iter().map(|r| -r).collect();
    turn(model, supports, workspace, &mut right);
    friction::balance(supports, &mut right);
    let is_prescribed = prescribed_rows(model, supports);
    eliminate(model, &is_prescribed, workspace, &mut right);
    if supports.contacts.is_some() && solve_with_last_factors(model, workspace, &right) {
        return Ok(());
    }
    factor(model, workspace)?;
    workspace.factors_serve = true;
    friction::solve(model, supports, workspace, &mut right)?;
    if right.iter().any(|x| !x.is_finite()) {
        return Err(Failure::Singular);
    }
    workspace.step.copy_from_slice(&right);
    Ok(())
}

/// The same by GMRES, with the factors of an earlier tangent: tools press a few places more or fewer, and little else has changed.
/// Whether that found the step.
fn solve_with_last_factors(
    model: &FiniteElementModel,
    workspace: &mut FiniteElementWorkspace,
    right: &[f64],
) -> bool {
    if !workspace.factors_serve {
        return false;
    }
    let (factors, supported) = (&mut workspace.factors, &workspace.supported);
    let mut first = right.to_vec();
    factors.solve(&mut first);
    let mut image = vec![0.0; right.len()];
    let found = solve_by_products(&first, KRYLOV, INEXACT, &mut |x, product| {
        model.pattern.multiply(supported, x, &mut image);
        factors.solve(&mut image);
        for (product, image) in product.iter_mut().zip(&image) {
            *product += image;
        }
    });
    workspace.factors_serve = matches!(found, Ok((_, iterations)) if iterations <= FEW);
    if let Ok((step, _)) = &found {
        workspace.step.copy_from_slice(step);
    }
    found.is_ok()
}

/// Turns the unknowns of all sliding nodes into one along the surface's normal and one across, in the
/// supported matrix and in `right`.
pub(super) fn turn(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    workspace: &mut FiniteElementWorkspace,
    right: &mut [f64],
) {
    for contact in &supports.sliding {
        turn_node(model, contact, workspace, right);
    }
}

/// Turns a solution of the turned system back.
pub(super) fn turn_back(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    workspace: &FiniteElementWorkspace,
    solution: &mut [f64],
) {
    for contact in &supports.sliding {
        let n = signed_distance(model, contact, &workspace.trial).normal;
        let node = 2 * contact.node;
        let (normal, along) = (solution[node], solution[node + 1]);
        solution[node] = n[0] * normal - n[1] * along;
        solution[node + 1] = n[1] * normal + n[0] * along;
    }
}

pub(super) fn factor(
    model: &FiniteElementModel,
    workspace: &mut FiniteElementWorkspace,
) -> Result<(), Failure> {
    workspace
        .factors
        .factor(&model.pattern, &workspace.supported)
        .map_err(|_| Failure::Singular)
}

/// Rows of prescribed unknowns: prescribed displacements and the normal component of sliding nodes.
pub(super) fn prescribed_rows(model: &FiniteElementModel, supports: &Supports<'_>) -> Vec<bool> {
    let mut is_prescribed = vec![false; model.size()];
    for (row, prescribed) in is_prescribed.iter_mut().zip(&supports.prescribed) {
        *row = prescribed.is_some();
    }
    for contact in &supports.sliding {
        is_prescribed[2 * contact.node] = true;
    }
    is_prescribed
}

/// Eliminates the prescribed rows from the supported matrix; their values in the step go to the
/// right side.
pub(super) fn eliminate(
    model: &FiniteElementModel,
    is_prescribed: &[bool],
    workspace: &mut FiniteElementWorkspace,
    right: &mut [f64],
) {
    let (pattern, step) = (&model.pattern, &workspace.step);
    for column in 0..pattern.size() {
        let range = pattern.range(column);
        for (&row, place) in pattern.rows(column).iter().zip(range) {
            let value = &mut workspace.supported[place];
            if row == column {
                if is_prescribed[row] {
                    // Of the size of its neighbours, so that the factors stay balanced.
                    *value = value.abs().max(model.shear_modulus * 1e-12);
                }
            } else if is_prescribed[row] || is_prescribed[column] {
                if !is_prescribed[column] {
                    right[column] -= *value * step[row];
                }
                if !is_prescribed[row] {
                    right[row] -= *value * step[column];
                }
                *value = 0.0;
            }
        }
    }
    for row in (0..pattern.size()).filter(|&row| is_prescribed[row]) {
        right[row] = workspace.supported[pattern.range(row).start] * step[row];
    }
}

/// Signed distance of a sliding node to its surface.
pub(super) fn signed_distance(
    model: &FiniteElementModel,
    contact: &Sliding,
    unknowns: &[f64],
) -> MeridianDistance {
    let place = &model.mesh.nodes[contact.node];
    contact.surface.signed_distance(
        place.x + unknowns[2 * contact.node],
        place.y + unknowns[2 * contact.node + 1],
    )
}

/// Turns the two unknowns of a sliding node into one along the surface's normal and one across, and adds
/// what the turning of the normal does to the contact's force.
fn turn_node(
    model: &FiniteElementModel,
    contact: &Sliding,
    workspace: &mut FiniteElementWorkspace,
    right: &mut [f64],
) {
    let MeridianDistance {
        normal: n,
        curvature,
        ..
    } = signed_distance(model, contact, &workspace.trial);
    let first = 2 * contact.node;
    let rotate = |a: f64, b: f64| (n[0] * a + n[1] * b, -n[1] * a + n[0] * b);
    (right[first], right[first + 1]) = rotate(right[first], right[first + 1]);
    let (pattern, values) = (&model.pattern, &mut workspace.supported);
    // The node's own block: Qᵀ K Q.
    let at = pattern.range(first).start;
    let below = pattern.index(first + 1, first);
    let end = pattern.range(first + 1).start;
    let (a, b, c) = (values[at], values[below], values[end]);
    values[at] = n[0] * n[0] * a + 2.0 * n[0] * n[1] * b + n[1] * n[1] * c;
    values[below] = n[0] * n[1] * (c - a) + (n[0] * n[0] - n[1] * n[1]) * b;
    values[end] = n[1] * n[1] * a - 2.0 * n[0] * n[1] * b + n[0] * n[0] * c;
    // Rows below the block: both columns have the same ones.
    for &row in pattern.rows(first).iter().filter(|&&row| row > first + 1) {
        let (left, next) = (pattern.index(row, first), pattern.index(row, first + 1));
        (values[left], values[next]) = rotate(values[left], values[next]);
    }
    // Columns before it.
    for column in 0..first {
        if let Ok(place) = pattern.rows(column).binary_search(&first) {
            let left = pattern.range(column).start + place;
            (values[left], values[left + 1]) = rotate(values[left], values[left + 1]);
        }
    }
    let force = &workspace.residual[first..first + 2];
    let normal_force = n[0] * force[0] + n[1] * force[1];
    values[end] -= normal_force * curvature;
}
