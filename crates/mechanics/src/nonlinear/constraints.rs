//! The conditions of a step and their forces: those of tools and of fluids in cavities, which hold, and those of contacts, which are active or open,
//! stick or slide (`friction`).
//!
//! The active contacts are found once in a step, with the forces of the tools, by the compliance of the body at rest, turned with
//! the body ([`Complementarity`]); the conjugate gradients are projected onto these conditions. Forces and active contacts are
//! found once more at the end, without moving the body. Active contacts have columns of Z, up to
//! [`MAX_COLUMNS`]; with more of them, each projection takes a solution by the factors instead, which costs as much as
//! some ten columns.

use nalgebra::Matrix3;

use super::cavities::WallsInStep;
use super::complementarity::Complementarity;
use super::contact::{Contacts, MAX_CONTACTS, ROWS, UnilateralContact};
use super::coupling::{Coupling, Rows, influence};
use super::model::NonlinearModel;
use super::state::{ContactHistory, NonlinearState};
use crate::Vec3;

/// Columns of Z of contacts: with more of them, four projections cost less by solutions.
const MAX_COLUMNS: usize = 64;

/// The body with the rotations of its nodes, which turn the factors.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turned<'a> {
    pub(super) model: &'a NonlinearModel,
    pub(super) rotations: &'a [[f32; 9]],
}

/// Conditions of a step.
#[derive(Debug, Clone, Copy)]
pub struct Conditions<'a> {
    /// Those of tools, one each; none of a tool that touches nothing.
    pub couplings: &'a [Option<Coupling<'a>>],
    /// Half-spaces that points of the boundary stay out of; those beyond the first [`MAX_CONTACTS`] are left out.
    pub contacts: &'a [UnilateralContact],
}

impl<'a> Conditions<'a> {
    /// Those of tools alone.
    pub fn of_tools(couplings: &'a [Option<Coupling<'a>>]) -> Self {
        Self {
            couplings,
            contacts: &[],
        }
    }
}

/// All conditions of a step: rows of tools, of fluids, then of contacts.
#[derive(Debug, Clone)]
pub(super) struct Constraints {
    pub(super) tools: Rows,
    pub(super) walls: WallsInStep,
    pub(super) contacts: Contacts,
    pub(super) problem: Complementarity,
    /// Forces, the direction of the iterations, and a change of either [N].
    pub(super) force: Vec<f64>,
    direction: Vec<f64>,
    pub(super) t: Vec<f64>,
    /// Violation of the conditions [m].
    pub(super) violation: Vec<f64>,
    /// Their violation without any contact force [m].
    pub(super) known: Vec<f64>,
    /// Forces in the rows that slide [N]; zero in the others.
    pub(super) slid: Vec<f64>,
    pub(super) new_contacts: Vec<ContactHistory>,
    /// The contacts that have columns of Z, and these; three values a node [m/N].
    with_columns: Vec<usize>,
    columns: Vec<f32>,
    /// Forces on all nodes, and what they displace.
    load: Vec<f32>,
    displaced: Vec<f32>,
    scratch: Vec<f32>,
}

impl Constraints {
    pub(super) fn new(model: &NonlinearModel, tools: usize) -> Self {
        let rows = 3 * tools + model.walls.len() + ROWS * MAX_CONTACTS;
        let size = 3 * model.nodes().len();
        Self {
            tools: Rows::new(model, tools),
            walls: WallsInStep::new(model),
            contacts: Contacts::new(model.nodes().len()),
            problem: Complementarity::new(rows),
            force: vec![0.0; rows],
            direction: vec![0.0; rows],
            t: vec![0.0; rows],
            violation: vec![0.0; rows],
            known: vec![0.0; rows],
            slid: vec![0.0; rows],
            new_contacts: Vec::with_capacity(MAX_CONTACTS),
            with_columns: Vec::with_capacity(MAX_COLUMNS),
            columns: vec![0.0; MAX_COLUMNS * size],
            load: vec![0.0; size],
            displaced: vec![0.0; size],
            scratch: vec![0.0; model.rest.scratch()],
        }
    }

    pub(super) fn count(&self) -> usize {
        self.bilateral() + self.contacts.listed.len()
    }

    /// How many rows come before those of contacts.
    pub(super) fn bilateral(&self) -> usize {
        self.tools.rows.len() + self.walls.fluids.len()
    }

    /// Takes the conditions of a step, and S of all of them.
    #[inline(always)]
    pub(super) fn prepare(
        &mut self,
        body: Turned<'_>,
        conditions: Conditions<'_>,
        state: &NonlinearState,
    ) {
        let Conditions {
            couplings,
            contacts,
        } = conditions;
        self.tools.list(couplings);
        self.tools.prepare(body, couplings);
        self.contacts.prepare(body, contacts, state);
        let pressures = state.cavities.iter().map(|history| history.pressure);
        self.walls.prepare(body, pressures, &mut self.scratch);
        let (tools, first) = (self.tools.rows.len(), self.bilateral());
        for i in 0..tools {
            for j in 0..tools {
                *self.problem.at(i, j) =
                    self.tools.own[(i, j)] + self.tools.shared(couplings, i, j);
            }
        }
        for row in tools..first {
            for other in 0..=row {
                let shared = self.walls.along(row - tools, self.influence(other));
                *self.problem.at(row, other) = shared;
                *self.problem.at(other, row) = shared;
            }
            let pressure = state.cavities[self.walls.fluids[row - tools]].pressure;
            self.force[row] = pressure * self.walls.area(body.model, row - tools);
        }
        for (number, contact) in self.contacts.listed.iter().enumerate() {
            let row = first + number;
            for other in 0..first {
                let shared = contact.along(self.influence(other));
                *self.problem.at(row, other) = shared;
                *self.problem.at(other, row) = shared;
            }
            for other in 0..=number {
                let shared = self.contacts.shared(number, other);
                *self.problem.at(row, first + other) = shared;
                *self.problem.at(first + other, row) = shared;
            }
            *self.problem.at(row, row) += contact.compliance;
            self.force[row] = if number < self.contacts.normals() {
                state.pressed_at(contact.slot)
            } else {
                contact
                    .normal
                    .dot(&state.friction_state_at(contact.slot).force)
            };
        }
        self.begin_kinds(state);
        for (force, row) in self.force.iter_mut().zip(&self.tools.rows) {
            *force = state.tools[row.tool].force.dot(&row.direction);
        }
        self.direction.fill(0.0);
    }

    /// A column of Z of a tool or a fluid [m/N].
    fn influence(&self, row: usize) -> &[f32] {
        match row.checked_sub(self.tools.rows.len()) {
            None => self.tools.influence(row),
            Some(fluid) => self.walls.influence(fluid),
        }
    }

    /// Changes the displacements `guess` [m] by Z t, so that every condition holds: the `change` [m].
    #[inline(always)]
    pub(super) fn carry(
        &mut self,
        body: Turned<'_>,
        couplings: &[Option<Coupling<'_>>],
        guess: &[f64],
        change: &mut [f32],
    ) {
        for (number, row) in self.tools.rows.iter().enumerate() {
            if let Some(coupling) = &couplings[row.tool] {
                let mut left = coupling.displacement - coupling.offset;
                for &(node, weight) in coupling.nodes {
                    let u = &guess[3 * node as usize..][..3];
                    left -= weight * Vec3::new(u[0], u[1], u[2]);
                }
                let own = self.tools.own_displacement(number, &self.force);
                self.violation[number] = own - left.dot(&row.direction);
            }
        }
        let (tools, first) = (self.tools.rows.len(), self.bilateral());
        for row in tools..first {
            self.violation[row] = self.walls.violation(body.model, row - tools);
        }
        for (number, contact) in self.contacts.listed.iter().enumerate() {
            let own = contact.compliance * self.force[first + number];
            self.violation[first + number] = contact.gap(guess) + own;
        }
        self.solve_forces();
        self.find_columns(body);
        change.fill(0.0);
        self.add_displacement(body, change);
    }

    /// Projects `z`, the preconditioned `residual`, onto the conditions.
    #[inline(always)]
    pub(super) fn project(&mut self, body: Turned<'_>, residual: &[f32], z: &mut [f32]) {
        self.project_bilateral(residual);
        let first = self.bilateral();
        for (violation, contact) in self.violation[first..]
            .iter_mut()
            .zip(&self.contacts.listed)
        {
            *violation = contact.along(z);
        }
        let count = self.count();
        self.problem
            .solve_active(&self.violation, &mut self.t[..count]);
        self.t[..count].iter_mut().for_each(|t| *t = -*t);
        self.add_displacement(body, z);
    }

    /// How far the `residual` [N] would move the rows of tools and fluids [m].
    #[inline(always)]
    fn project_bilateral(&mut self, residual: &[f32]) {
        self.tools.project(residual, &mut self.violation);
        let fluids = &mut self.violation[self.tools.rows.len()..];
        self.walls.project(residual, fluids);
    }

    /// The next direction: the last projection, and `beta` [-] times the direction before. Returns its energy in the own
    /// compliances of the conditions, twice [J].
    pub(super) fn update_direction(&mut self, beta: f64) -> f64 {
        let (count, first) = (self.count(), self.bilateral());
        for (direction, t) in self.direction.iter_mut().zip(&self.t[..count]) {
            *direction = beta * *direction + t;
        }
        let contacts = self.contacts.listed.iter().zip(&self.direction[first..]);
        let own = contacts.map(|(contact, direction)| contact.compliance * direction * direction);
        self.tools.own_curvature(&self.direction) + own.sum::<f64>()
    }

    /// Changes the forces by `length` [-] times the direction, and the `residual` [N] by as much.
    #[inline(always)]
    pub(super) fn step_along(
        &mut self,
        couplings: &[Option<Coupling<'_>>],
        length: f64,
        residual: &mut [f32],
    ) {
        let count = self.count();
        for row in 0..count {
            self.t[row] = length * self.direction[row];
            self.force[row] += self.t[row];
        }
        self.add(couplings, &self.t, residual);
    }

    /// Adds all forces to those on the nodes [N].
    #[inline(always)]
    pub(super) fn add_load(&self, couplings: &[Option<Coupling<'_>>], load: &mut [f32]) {
        self.add(couplings, &self.force, load);
    }

    /// Finds the forces that leave the least of the `residual` [N] at the `displacements` [m].
    #[inline(always)]
    pub(super) fn finish(&mut self, body: Turned<'_>, residual: &[f32], displacements: &[f64]) {
        self.project_bilateral(residual);
        if !self.contacts.listed.is_empty() {
            let Turned { model, rotations } = body;
            model
                .rest
                .apply(rotations, residual, &mut self.displaced, &mut self.scratch);
        }
        let first = self.bilateral();
        for (number, contact) in self.contacts.listed.iter().enumerate() {
            self.violation[first + number] = contact.gap(displacements)
                + contact.along(&self.displaced)
                + contact.compliance * self.force[first + number];
        }
        self.solve_forces();
    }

    /// Stores the forces in `state`.
    pub(super) fn store(
        &mut self,
        model: &NonlinearModel,
        couplings: &[Option<Coupling<'_>>],
        state: &mut NonlinearState,
    ) {
        for (coupling, history) in couplings.iter().zip(&mut state.tools) {
            history.force = Vec3::zeros();
            history.is_coupled = coupling.is_some();
        }
        for (row, force) in self.tools.rows.iter().zip(&self.force) {
            state.tools[row.tool].force += *force * row.direction;
        }
        for (coupling, history) in couplings.iter().zip(&mut state.tools) {
            history.load.fill(0.0);
            for &(node, weight) in coupling.iter().flat_map(|coupling| coupling.nodes) {
                let load = &mut history.load[3 * node as usize..][..3];
                for (load, force) in load.iter_mut().zip(history.force.iter()) {
                    *load = (weight * force) as f32;
                }
            }
        }
        let fluids = &self.force[self.tools.rows.len()..];
        for (fluid, (number, force)) in self.walls.fluids.iter().zip(fluids).enumerate() {
            state.cavities[*number].pressure = force / self.walls.area(model, fluid);
        }
        self.store_contacts(state);
    }

    /// Σ a (S⁻¹ a)ᵀ over the rows in contact that do not slide [N/m], with a the vector that `motion` has for a contact's number
    /// and a direction.
    pub(super) fn stiffness(
        &mut self,
        motion: impl Fn(usize, &Vec3) -> Vec3 + Clone,
    ) -> Matrix3<f64> {
        let (count, first) = (self.count(), self.bilateral());
        let normals = self.contacts.normals();
        let frictional = self.contacts.frictional.iter();
        let along = frictional.flat_map(|contact| {
            [
                (contact.normal, contact.along),
                (contact.normal, contact.along + 1),
            ]
        });
        let rows = (0..normals).map(|row| (row, row)).chain(along);
        let rows = rows.map(|(contact, row)| {
            let direction = &self.contacts.listed[row].normal;
            (first + row, motion(contact, direction))
        });
        let mut sum = Matrix3::zeros();
        for axis in 0..3 {
            self.violation[..count].fill(0.0);
            for (row, motion) in rows.clone() {
                self.violation[row] = motion[axis];
            }
            self.problem
                .solve_active(&self.violation, &mut self.t[..count]);
            for (row, motion) in rows.clone() {
                for of in 0..3 {
                    sum[(of, axis)] += motion[of] * self.t[row];
                }
            }
        }
        sum
    }

    /// Finds the columns of Z of the contacts that are active, or were before, if these are few enough.
    #[inline(always)]
    fn find_columns(&mut self, body: Turned<'_>) {
        self.with_columns.clear();
        let (first, size) = (self.bilateral(), self.load.len());
        let is_used = |row: usize| self.t[row] != 0.0 || self.problem.is_free(row);
        let used = (first..self.count()).filter(|&row| is_used(row));
        if used.clone().count() <= MAX_COLUMNS {
            self.with_columns.extend(used.map(|row| row - first));
        }
        let columns = self.columns.chunks_exact_mut(size);
        for (column, &number) in columns.zip(&self.with_columns) {
            let contact = &self.contacts.listed[number];
            influence(body, contact.nodes(), &[contact.normal], column);
        }
    }

    /// x ← x + Z t.
    #[inline(always)]
    fn add_displacement(&mut self, body: Turned<'_>, x: &mut [f32]) {
        self.tools.add_influence(&self.t, x);
        let fluids = &self.t[self.tools.rows.len()..];
        self.walls.add_influence(fluids, x);
        let first = self.bilateral();
        if !self.with_columns.is_empty() {
            let columns = self.columns.chunks_exact(self.load.len());
            for (column, &number) in columns.zip(&self.with_columns) {
                let t = self.t[first + number] as f32;
                for (x, z) in x.iter_mut().zip(column) {
                    *x += t * z;
                }
            }
            return;
        }
        if self.t[first..self.count()].iter().all(|t| *t == 0.0) {
            return;
        }
        self.load.fill(0.0);
        let forces = &self.t[first..];
        for (contact, force) in self.contacts.listed.iter().zip(forces) {
            contact.add(*force, &mut self.load);
        }
        let Turned { model, rotations } = body;
        let (displaced, scratch) = (&mut self.displaced, &mut self.scratch);
        model.rest.apply(rotations, &self.load, displaced, scratch);
        for (x, displaced) in x.iter_mut().zip(&self.displaced) {
            *x += displaced;
        }
    }

    #[inline(always)]
    fn add(&self, couplings: &[Option<Coupling<'_>>], forces: &[f64], load: &mut [f32]) {
        self.tools.add_load(couplings, forces, load);
        self.walls.add_load(&forces[self.tools.rows.len()..], load);
        let forces = &forces[self.bilateral()..];
        for (contact, force) in self.contacts.listed.iter().zip(forces) {
            contact.add(*force, load);
        }
    }
}
