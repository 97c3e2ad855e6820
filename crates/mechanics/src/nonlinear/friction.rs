//! Forces of tools and contacts with Coulomb's friction.
//!
//! With a guess of which points slide, and with what forces along the surface, the rest is a problem of complementarity: a
//! point that sticks is bilateral in both directions. From its solution a few sweeps of projected Gauss-Seidel over all
//! rows [Jean 1999] determine which points slide and with what forces; this is repeated until nothing changes, at most
//! [`MAX_TRIALS`] times. Then the forces along the surface are cut to the cone, which they never leave.

use super::complementarity::Kind;
use super::constraints::Constraints;
use super::contact::{FrictionState, FrictionalContact};
use super::state::{ContactHistory, NonlinearState};
use crate::Vec3;

/// Problems of complementarity to solve: a few are the rule.
const MAX_TRIALS: usize = 12;

/// Sweeps after each of them: each costs as much as a product with the matrix.
const SWEEPS: usize = 10;

/// How near the cone a force slides, over its radius [-]: rounding.
const ON_CONE: f64 = 1e-12;

/// Change of a force that slides, over the cone's radius [-], below which it stands.
const STANDS: f64 = 1e-3;

impl Constraints {
    /// The kind of each row at the beginning of a step: contacts that slid still do.
    pub(super) fn begin_kinds(&mut self, state: &NonlinearState) {
        let (first, normals) = (self.bilateral(), self.contacts.normals());
        let kinds = &mut self.problem.kinds;
        kinds[..first].fill(Kind::Bilateral);
        kinds[first..first + normals].fill(Kind::Unilateral);
        for contact in &self.contacts.frictional {
            let slot = self.contacts.listed[contact.normal].slot;
            let kind = match state.friction_state_at(slot).slides {
                true => Kind::Open,
                false => Kind::Bilateral,
            };
            kinds[first + contact.along..][..2].fill(kind);
        }
    }

    /// Forces that correct the violation at constant kinds; the changes go to `t`.
    pub(super) fn solve_forces(&mut self) {
        let (count, first) = (self.count(), self.bilateral());
        for row in 0..count {
            let carried =
                (first..count).map(|column| self.problem.get(row, column) * self.force[column]);
            self.known[row] = self.violation[row] - carried.sum::<f64>();
            self.slid[row] = match self.problem.kinds[row] {
                Kind::Open => self.force[row],
                Kind::Bilateral | Kind::Unilateral => 0.0,
            };
        }
        for row in first..first + self.contacts.normals() {
            self.problem.active[row] = self.force[row] > 0.0;
        }
        for _ in 0..MAX_TRIALS {
            for row in 0..count {
                self.problem.q[row] = self.known[row] + self.slid_displacement(row);
            }
            self.problem.solve(count);
            if !self.slide() {
                break;
            }
        }
        self.keep_cones();
        for row in 0..count {
            let before = if row < first { 0.0 } else { self.force[row] };
            self.t[row] = self.problem.x[row] - before;
            self.force[row] += self.t[row];
        }
    }

    /// The rows of a contact with friction: along its normal, and the first of the two along the surface.
    fn rows(&self, contact: &FrictionalContact) -> (usize, usize) {
        let first = self.bilateral();
        (first + contact.normal, first + contact.along)
    }

    /// Displacement of a row by the sliding forces [m].
    fn slid_displacement(&self, row: usize) -> f64 {
        let frictional = self.contacts.frictional.iter();
        frictional
            .map(|contact| {
                let (_, along) = self.rows(contact);
                self.problem.get(row, along) * self.slid[along]
                    + self.problem.get(row, along + 1) * self.slid[along + 1]
            })
            .sum()
    }

    /// Finds the sliding points and their forces by sweeps from the last solution. Returns whether anything changed.
    fn slide(&mut self) -> bool {
        if self.contacts.frictional.is_empty() {
            return false;
        }
        let (count, first) = (self.count(), self.bilateral());
        let normals = first + self.contacts.normals();
        for row in normals..count {
            if self.problem.kinds[row] == Kind::Open {
                self.problem.x[row] = self.slid[row];
            }
        }
        self.problem.q[..count].copy_from_slice(&self.known[..count]);
        for _ in 0..SWEEPS {
            for row in 0..normals {
                self.problem.relax(row, count);
                if row >= first {
                    self.problem.x[row] = self.problem.x[row].max(0.0);
                }
            }
            for number in 0..self.contacts.frictional.len() {
                let contact = self.contacts.frictional[number];
                let (_, along) = self.rows(&contact);
                self.problem.relax_pair(along, count);
                self.cut_to_cone(&contact);
            }
        }
        let mut changes = false;
        for number in 0..self.contacts.frictional.len() {
            let contact = self.contacts.frictional[number];
            let (normal, along) = self.rows(&contact);
            let limit = contact.friction * self.problem.x[normal];
            let next = [self.problem.x[along], self.problem.x[along + 1]];
            let slides = next[0].hypot(next[1]) >= limit * (1.0 - ON_CONE);
            let kind = match slides {
                true => Kind::Open,
                false => Kind::Bilateral,
            };
            let next = if slides { next } else { [0.0; 2] };
            let own = &mut self.slid[along..along + 2];
            let change = (next[0] - own[0]).hypot(next[1] - own[1]);
            changes |= self.problem.kinds[along] != kind || change > STANDS * limit;
            own.copy_from_slice(&next);
            self.problem.kinds[along..along + 2].fill(kind);
        }
        changes
    }

    /// Copies the sliding forces into the solution, and limits all forces along the surface to their
    /// cones.
    fn keep_cones(&mut self) {
        for number in 0..self.contacts.frictional.len() {
            let contact = self.contacts.frictional[number];
            let (_, along) = self.rows(&contact);
            if self.problem.kinds[along] == Kind::Open {
                self.problem.x[along..along + 2].copy_from_slice(&self.slid[along..along + 2]);
            }
            self.cut_to_cone(&contact);
        }
    }

    fn cut_to_cone(&mut self, contact: &FrictionalContact) {
        let (normal, along) = self.rows(contact);
        let limit = contact.friction * self.problem.x[normal].max(0.0);
        let x = &mut self.problem.x[along..along + 2];
        let size = x[0].hypot(x[1]);
        if size > limit {
            x.iter_mut().for_each(|force| *force *= limit / size);
        }
    }

    /// Stores the contact forces and the anchors of sticking points in `state`.
    pub(super) fn store_contacts(&mut self, state: &mut NonlinearState) {
        let first = self.bilateral();
        self.new_contacts.clear();
        let normals = &self.contacts.listed[..self.contacts.normals()];
        for (number, contact) in normals.iter().enumerate() {
            if self.force[first + number] > 0.0 {
                let begun = FrictionState {
                    anchor: match contact.is_between {
                        false => contact.displacement(&state.displacements),
                        true => Vec3::zeros(),
                    },
                    ..FrictionState::default()
                };
                let mut frictional = self.contacts.frictional.iter();
                let friction_state = match frictional.find(|contact| contact.normal == number) {
                    Some(contact) => self.friction_state(contact, state),
                    None => begun,
                };
                self.new_contacts.push(ContactHistory {
                    slot: contact.slot,
                    force: self.force[first + number],
                    friction_state,
                });
            }
        }
        state.pressed.fill(0.0);
        state.friction_states.fill(FrictionState::default());
        state.on_tools.fill(ContactHistory::default());
        let mut on_tools = state.on_tools.iter_mut();
        for history in self.new_contacts.drain(..) {
            if let Some(pressed) = state.pressed.get_mut(history.slot) {
                *pressed = history.force;
                state.friction_states[history.slot] = history.friction_state;
            } else if let Some(own) = on_tools.next() {
                *own = history;
            }
        }
    }

    fn friction_state(&self, contact: &FrictionalContact, state: &NonlinearState) -> FrictionState {
        let (_, along) = self.rows(contact);
        let [first, second] = [0, 1].map(|k| &self.contacts.listed[contact.along + k]);
        let force = first.normal * self.force[along] + second.normal * self.force[along + 1];
        let slides = self.problem.kinds[along] == Kind::Open;
        let lag = first.compliance * force;
        let anchor = match (first.is_between, slides) {
            (false, true) => first.displacement(&state.displacements) + lag,
            (false, false) => first.anchor(state),
            (true, true) => lag,
            (true, false) => {
                let lags = [first, second].map(|own| own.normal * -own.gap(&state.displacements));
                lags[0] + lags[1]
            }
        };
        FrictionState {
            force,
            anchor,
            slides,
        }
    }
}
