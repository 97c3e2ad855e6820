//! The tissue that all jaws hold of one organ: triangles with prescribed displacements.
//!
//! With Ξ_hh the compliance of the held parts (triangles, or several with the mean of their displacements), d their
//! displacements and c those due to the tips, the forces on them are f = E Ξ_hh⁻¹ (d − c) (4.7). Ξ_hh is symmetric and
//! positive definite; Cholesky's method factors it when the held parts change, and a step only substitutes back.
//! `press` eliminates them from the equations of the tips. A tool feels −Σ f of its own parts, and has the stiffness S
//! = E Σ Ξ_hh⁻¹ over its own.
//!
//! Held parts reduce the compliance W of a tip's load by less than W itself: W − Tᵀ E Ξ_hh⁻¹ T is positive definite in
//! every elastic organ. Collocation on a few large triangles violates that, even if tip and jaws share no triangle
//! (`random_scenes::…`: the root of the largest eigenvalue of W⁻¹ Tᵀ E Ξ_hh⁻¹ T is 1.2 to 2.4 there, with a thousandth
//! of the tip's load or none on the held parts), and a tip would move against its force. There T is reduced, so that
//! this root is [`MAX_CARRIED`], and [`Limit::Carried`] reports it.
//!
//! [`Limit::Carried`]: palpate_mechanics::Limit::Carried
//!
//! *How we know*: `grip::agreement::…`: the same elements anew, finite elements, a tube pulled at both sides;
//! `grip::energy::a_closed_way_gives_no_energy`.
//!
//! *Limits*: S ignores the compliance of tips next to the jaws. A few constant triangles lack the peak of traction at
//! the edge of a patch: six are 11 % too soft on every mesh, sixteen parts 2 %. Where triangles are larger than the
//! jaws, the held area is as large as they are.

use nalgebra::Matrix3;
use palpate_geometry::Vec3;
use palpate_mechanics::Reached;
use palpate_mechanics::surface_response::TouchId;

use super::press::MAX_CARRIED;
use super::{GlobalModel, GlobalWorkspace};
use crate::grip::{GraspedTriangle, MAX_PARTS, MAX_TRIANGLES};
use crate::simulation::Simulation;
use crate::state::ToolState;

/// A pivot smaller than this part of its diagonal is rounding [-]: influences have 24 bits.
const MIN_PIVOT: f64 = 1e-6;

/// The equations of the held parts. They are set up again when the held parts change.
#[derive(Debug)]
pub(super) struct GraspWorkspace {
    /// For each part, its tool and the end index of its triangles.
    owners: Vec<(usize, usize)>,
    triangles: Vec<GraspedTriangle>,
    is_solved: bool,
    /// Version of the slit in the equations.
    slit: u64,
    /// The rows of the lower half of Ξ_hh [1/m], then of its factor.
    matrix: Vec<f64>,
    right: Vec<f64>,
    /// Forces on the held parts [N].
    forces: Vec<Vec3>,
    /// Compliance [m/N] of part k to a force on tip i, at k tools + i.
    to_tips: Vec<Matrix3<f64>>,
    /// Reduction of the displacement of tip i under a force on tip j by the held parts [m/N], at i tools + j.
    fixes: Vec<Matrix3<f64>>,
    /// Where the coupling of a tip with the held parts exceeded its bound, by how much.
    bounded: Vec<Option<Reached>>,
    /// Σ Ξ_hh⁻¹ over each tool's parts [m].
    stiffness: Vec<Matrix3<f64>>,
}

impl GraspWorkspace {
    pub(super) fn new(tools: usize) -> Self {
        let most = tools * MAX_PARTS;
        Self {
            owners: Vec::with_capacity(most),
            triangles: Vec::with_capacity(tools * MAX_TRIANGLES),
            is_solved: false,
            slit: 0,
            matrix: vec![0.0; 9 * most * most],
            right: vec![0.0; 3 * most],
            forces: vec![Vec3::zeros(); most],
            to_tips: vec![Matrix3::zeros(); most * tools],
            fixes: vec![Matrix3::zeros(); tools * tools],
            bounded: vec![None; tools],
            stiffness: vec![Matrix3::zeros(); tools],
        }
    }

    /// Number of parts with a valid solution: none if their equations have no solution.
    fn answered(&self) -> usize {
        if self.is_solved { self.owners.len() } else { 0 }
    }

    /// Held triangles with their tools and forces [N].
    pub(super) fn forces(&self) -> impl Iterator<Item = (usize, TouchId, Vec3)> {
        (0..self.answered()).flat_map(move |k| {
            let triangles = self.part(k).iter();
            triangles.map(move |one| (self.owners[k].0, one.touch, self.forces[k] * one.weight))
        })
    }

    /// Displacement [m] of the tip of tool `number`, one of so many, due to the forces on the held parts.
    pub(super) fn tip_displacement(&self, number: usize, tools: usize) -> Vec3 {
        let forces = self.forces.iter().take(self.answered()).enumerate();
        forces
            .map(|(k, force)| self.to_tips[k * tools + number].tr_mul(force))
            .sum()
    }

    /// Reduction of the compliance [m/N] of tip `moved` to a force on tip `loaded`, of so many tools, by the held
    /// parts.
    pub(super) fn reduction(&self, moved: usize, loaded: usize, tools: usize) -> Matrix3<f64> {
        self.fixes[moved * tools + loaded]
    }

    /// The bound that acted on the coupling of a tip with the held parts, if it did.
    pub(super) fn bounded(&self, number: usize) -> Option<Reached> {
        self.bounded[number]
    }

    /// Bounds the coupling of a tip, one of so many tools, with the held parts. `yields` is the compliance of its load
    /// without held parts [m/N]: held parts reduce it by less than all of it.
    fn bound(&mut self, number: usize, tools: usize, yields: &Matrix3<f64>) {
        let coupling = coupling(&self.reduction(number, number, tools), yields);
        if coupling <= MAX_CARRIED {
            return;
        }
        self.bounded[number] = Some(Reached {
            unbounded: coupling,
            used: MAX_CARRIED,
        });
        let part = MAX_CARRIED / coupling;
        for k in 0..self.owners.len() {
            self.to_tips[k * tools + number] *= part;
        }
        for other in 0..tools {
            self.fixes[number * tools + other] *= part;
            self.fixes[other * tools + number] *= part;
        }
    }

    /// Computes the coupling for all tips of an organ of Young's modulus `modulus` [Pa].
    fn fix(&mut self, tools: usize, modulus: f64) {
        self.fixes.fill(Matrix3::zeros());
        if !self.is_solved {
            return;
        }
        let parts = self.owners.len();
        let size = 3 * parts;
        for loaded in 0..tools {
            for axis in 0..3 {
                let right = &mut self.right[..size];
                for (k, three) in right.chunks_exact_mut(3).enumerate() {
                    let moved = self.to_tips[k * tools + loaded].column(axis) * modulus;
                    three.copy_from_slice(moved.as_slice());
                }
                substitute(&self.matrix[..size * size], right);
                for tip in 0..tools {
                    let forces = right.chunks_exact(3).enumerate();
                    let by: Vec3 = forces
                        .map(|(k, three)| {
                            let force = Vec3::from_column_slice(three);
                            self.to_tips[k * tools + tip].tr_mul(&force)
                        })
                        .sum();
                    self.fixes[tip * tools + loaded].set_column(axis, &by);
                }
            }
        }
    }

    /// Forces on the parts, in their order [N].
    pub(super) fn forces_on_parts(&self) -> impl Iterator<Item = (usize, Vec3)> {
        let forces = self.forces.iter().take(self.answered());
        forces.copied().enumerate()
    }

    /// The triangles of part `k`.
    fn part(&self, k: usize) -> &[GraspedTriangle] {
        let start = k.checked_sub(1).map_or(0, |before| self.owners[before].1);
        &self.triangles[start..self.owners[k].1]
    }

    /// Whether the equations match the parts that `tools` hold.
    fn is_of(&self, tools: &[ToolState]) -> bool {
        let mut k = 0;
        for (number, tool) in tools.iter().enumerate() {
            for (_, triangles) in tool
                .grip
                .patch()
                .into_iter()
                .flat_map(|patch| patch.parts())
            {
                let same = k < self.owners.len()
                    && self.owners[k].0 == number
                    && self.part(k) == triangles;
                if !same {
                    return false;
                }
                k += 1;
            }
        }
        k == self.owners.len()
    }

    /// Displacement of part `i` from a unit force on part `j`, times E [1/m], before they are factored.
    fn block(&self, i: usize, j: usize) -> Matrix3<f64> {
        let size = 3 * self.owners.len();
        let (row, column) = (3 * i.max(j), 3 * i.min(j));
        let block = Matrix3::from_fn(|a, b| self.matrix[size * (row + a) + column + b]);
        if i < j { block.transpose() } else { block }
    }

    /// Displacements times E of the parts of tool `number` [N/m], in their order, when they bear `force` [N] by their
    /// `shares` [-] in addition to the parts of other tools, whose forces are those of the last equations. Call before
    /// the factorization.
    pub(super) fn borne<'a>(
        &'a self,
        number: usize,
        force: Vec3,
        shares: impl Iterator<Item = f64> + Clone + 'a,
    ) -> impl Iterator<Item = Vec3> + 'a {
        let of_tool = move |k: &usize| self.owners[*k].0 == number;
        let all = 0..self.owners.len();
        all.clone().filter(of_tool).map(move |moved| {
            let own = all.clone().filter(of_tool).zip(shares.clone());
            let own = own.map(|(k, share)| self.block(moved, k) * force * share);
            let others = all.clone().filter(|k| !of_tool(k)).zip(&self.forces);
            let others = others.map(|(k, force)| self.block(moved, k) * force);
            own.sum::<Vec3>() + others.sum::<Vec3>()
        })
    }

    /// Factors the matrix for this number of tools, if possible.
    pub(super) fn factor(&mut self, tools: usize) {
        let size = 3 * self.owners.len();
        let matrix = &mut self.matrix[..size * size];
        self.is_solved = cholesky(matrix, size);
        self.stiffness.fill(Matrix3::zeros());
        if !self.is_solved {
            return;
        }
        for number in 0..tools {
            for axis in 0..3 {
                let right = &mut self.right[..size];
                for (three, (tool, _)) in right.chunks_exact_mut(3).zip(&self.owners) {
                    three.fill(0.0);
                    three[axis] = f64::from(u8::from(*tool == number));
                }
                substitute(matrix, right);
                let column: Vec3 = right
                    .chunks_exact(3)
                    .zip(&self.owners)
                    .filter(|(_, (tool, _))| *tool == number)
                    .map(|(three, _)| Vec3::from_column_slice(three))
                    .sum();
                self.stiffness[number].set_column(axis, &column);
            }
        }
    }

    /// Takes over the parts that `tools` hold.
    fn fill(&mut self, tools: &[ToolState]) {
        self.owners.clear();
        self.triangles.clear();
        for (number, tool) in tools.iter().enumerate() {
            for (_, triangles) in tool
                .grip
                .patch()
                .into_iter()
                .flat_map(|patch| patch.parts())
            {
                self.triangles.extend_from_slice(triangles);
                self.owners.push((number, self.triangles.len()));
            }
        }
    }
}

impl GlobalModel {
    /// Prepares the equations of the parts that `tools` hold, if necessary; returns whether they have a solution, if
    /// anything is held.
    pub(super) fn prepare_grasps(
        &self,
        simulation: &Simulation,
        tools: &[ToolState],
        workspace: &mut GlobalWorkspace,
    ) -> bool {
        let softness = 1.0 / simulation.material.at_rest.youngs_modulus();
        let version = workspace.slit.as_ref().map_or(0, |slit| slit.version);
        if workspace.held.slit != version || !workspace.held.is_of(tools) {
            self.assemble(tools, workspace);
            workspace.held.factor(tools.len());
        }
        let GlobalWorkspace { held, slit, .. } = workspace;
        for k in 0..held.owners.len() {
            for (number, tool) in simulation.tools.iter().enumerate() {
                let mut sum = Matrix3::zeros();
                if let Some(load) = self.load(tool, &tools[number]) {
                    for share in load.shares() {
                        for one in held.part(k) {
                            let compliance = self.response.compliance(one.touch, share.triangle);
                            sum += compliance * (one.weight * share.weight);
                        }
                    }
                }
                if let Some(slit) = slit {
                    sum += slit.part_by_tip(k, number);
                }
                held.to_tips[k * tools.len() + number] = sum * softness;
            }
        }
        held.fix(tools.len(), 1.0 / softness);
        held.bounded.fill(None);
        for (number, tool) in simulation.tools.iter().enumerate() {
            if let Some(load) = self.load(tool, &tools[number]).filter(|_| held.is_solved) {
                let more = slit.as_ref().map(|slit| slit.further(number));
                let yields = self.response.between(&load, &load) + more.unwrap_or_default();
                held.bound(number, tools.len(), &(yields * softness));
            }
        }
        held.is_solved
    }

    /// Displacement of one held part from a unit force on another, times E [1/m].
    pub(super) fn between_parts(
        &self,
        moved: &[GraspedTriangle],
        loaded: &[GraspedTriangle],
    ) -> Matrix3<f64> {
        let mut sum = Matrix3::zeros();
        for here in moved {
            for there in loaded {
                let compliance = self.response.compliance(here.touch, there.touch);
                sum += compliance * (here.weight * there.weight);
            }
        }
        sum
    }

    /// Sets up the equations of the parts that `tools` hold, to be factored next.
    pub(super) fn assemble(&self, tools: &[ToolState], workspace: &mut GlobalWorkspace) {
        let GlobalWorkspace { held, slit, .. } = workspace;
        held.fill(tools);
        held.is_solved = false;
        held.slit = slit.as_ref().map_or(0, |slit| slit.version);
        if let Some(slit) = slit {
            for k in 0..held.owners.len() {
                slit.put_part(&self.response, k, held.part(k));
            }
        }
        let size = 3 * held.owners.len();
        for i in 0..held.owners.len() {
            for j in 0..=i {
                let mut block = self.between_parts(held.part(i), held.part(j));
                if let Some(slit) = slit {
                    block += slit.between_parts(i, j);
                }
                for a in 0..3 {
                    for b in 0..3 {
                        held.matrix[size * (3 * i + a) + 3 * j + b] = block[(a, b)];
                    }
                }
            }
        }
    }

    /// The forces on all held parts, in addition to those of the tips.
    pub(super) fn solve_grasped_forces(
        &self,
        simulation: &Simulation,
        tools: &mut [ToolState],
        workspace: &mut GlobalWorkspace,
    ) {
        let modulus = simulation.material.at_rest.youngs_modulus();
        let held = &mut workspace.held;
        let size = 3 * held.owners.len();
        let right = &mut held.right[..size];
        let mut k = 0;
        for tool in tools.iter() {
            let Some(hold) = &tool.grip.grasp else {
                continue;
            };
            for (part, _) in hold.patch().into_iter().flat_map(|patch| patch.parts()) {
                let mut by = hold.carried(&part.at) - part.rest;
                for (number, tip) in tools.iter().enumerate() {
                    if tip.contact.is_some() {
                        by += held.to_tips[k * tools.len() + number] * tip.elastic;
                    }
                }
                right[3 * k..3 * k + 3].copy_from_slice((by * modulus).as_slice());
                k += 1;
            }
        }
        substitute(&held.matrix[..size * size], right);
        for (force, three) in held.forces.iter_mut().zip(right.chunks_exact(3)) {
            *force = Vec3::from_column_slice(three);
        }
        for (number, state) in tools.iter_mut().enumerate() {
            if !state.is_grasping() {
                continue;
            }
            let own = held.owners.iter().zip(&held.forces);
            let own = own.filter(|((tool, _), _)| *tool == number);
            state.elastic = -own.map(|(_, force)| force).sum::<Vec3>();
            state.stiffness = held.stiffness[number] * modulus;
        }
    }
}

/// The coupling of a tip with the held parts [-]: the root of the largest part of its compliance `yields` [m/N] that
/// the held parts remove, which is `fixes`. In an elastic organ it is less than one.
fn coupling(fixes: &Matrix3<f64>, yields: &Matrix3<f64>) -> f64 {
    if *fixes == Matrix3::zeros() {
        return 0.0;
    }
    let inverse = yields.cholesky().and_then(|root| root.l().try_inverse());
    inverse.map_or(f64::INFINITY, |inverse| {
        let part = inverse * fixes * inverse.transpose();
        part.symmetric_eigenvalues().max().max(0.0).sqrt()
    })
}

/// Replaces the lower half of a matrix by its Cholesky factor; false if it has none.
fn cholesky(matrix: &mut [f64], size: usize) -> bool {
    for i in 0..size {
        let (above, row) = matrix.split_at_mut(size * i);
        let row = &mut row[..size];
        let diagonal = row[i];
        for j in 0..i {
            let before = &above[size * j..size * j + j + 1];
            let known: f64 = (0..j).map(|k| row[k] * before[k]).sum();
            row[j] = (row[j] - known) / before[j];
        }
        let known: f64 = row[..i].iter().map(|value| value * value).sum();
        let pivot = diagonal - known;
        if pivot <= MIN_PIVOT * diagonal || !pivot.is_finite() {
            return false;
        }
        row[i] = pivot.sqrt();
    }
    true
}

/// Replaces `right` by the solution with the Cholesky `factor`.
fn substitute(factor: &[f64], right: &mut [f64]) {
    let size = right.len();
    for i in 0..size {
        let row = &factor[size * i..size * i + i + 1];
        let known: f64 = (0..i).map(|k| row[k] * right[k]).sum();
        right[i] = (right[i] - known) / row[i];
    }
    for i in (0..size).rev() {
        right[i] /= factor[size * i + i];
        for k in 0..i {
            right[k] -= factor[size * i + k] * right[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the definition, for held parts that remove a quarter of a tip's compliance along one axis, and all of it
    /// along none. And no tip is coupled more closely than possible: the remaining compliance is positive.
    #[test]
    fn held_parts_take_less_than_a_tip_yields() {
        let yields = Matrix3::new(3.0, 0.5, 0.2, 0.5, 2.0, -0.4, 0.2, -0.4, 1.0);
        let along = yields * Vec3::new(0.3, -0.2, 0.9);
        let largest = along.dot(&(yields.cholesky().unwrap().inverse() * along));
        let quarter = along * along.transpose() * (0.25 / largest);
        assert!((coupling(&quarter, &yields) - 0.5).abs() < 1e-12);
        assert_eq!(coupling(&Matrix3::zeros(), &yields), 0.0);
        assert_eq!(coupling(&quarter, &-yields), f64::INFINITY);
        let mut held = GraspWorkspace::new(2);
        held.fixes = vec![quarter * 16.0, quarter, quarter.transpose(), quarter * 2.0];
        held.bound(0, 2, &yields);
        held.bound(1, 2, &yields);
        assert!((held.bounded(0).unwrap().unbounded - 2.0).abs() < 1e-12);
        assert!(held.bounded(1).is_none());
        let left = yields - held.reduction(0, 0, 2);
        assert!(left.symmetric_eigenvalues().min() > 0.0);
        assert!((coupling(&held.reduction(0, 0, 2), &yields) - MAX_CARRIED).abs() < 1e-12);
        let other = held.reduction(0, 1, 2) - quarter * (0.5 * MAX_CARRIED);
        assert!(
            other.norm() < 1e-12 && held.reduction(0, 1, 2) == held.reduction(1, 0, 2).transpose()
        );
    }

    /// Judge: the product. And no factor for a matrix that is not positive definite.
    #[test]
    fn a_factor_solves_its_equations() {
        let matrix = [4.0, 0.0, 0.0, 1.0, 3.0, 0.0, -1.0, 0.5, 2.0];
        let mut factor = matrix;
        assert!(cholesky(&mut factor, 3));
        let mut right = [1.0, -2.0, 0.5];
        substitute(&factor, &mut right);
        let at = |i: usize, j: usize| matrix[3 * i.max(j) + i.min(j)];
        for (i, expected) in [1.0, -2.0, 0.5].into_iter().enumerate() {
            let found: f64 = (0..3).map(|j| at(i, j) * right[j]).sum();
            assert!((found - expected).abs() < 1e-14);
        }
        assert!(!cholesky(&mut [1.0, 0.0, 2.0, 1.0], 2));
        assert!(!cholesky(&mut [f64::NAN], 1));
    }
}
