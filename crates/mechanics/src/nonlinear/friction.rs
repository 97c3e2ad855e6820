//! Forces of tools and contacts with Coulomb's friction.
//!
//! With a guess of which points slide, and with what forces along the surface, the rest is a problem of complementarity: a
//! point that sticks is bilateral in both directions. From its solution a few sweeps of projected Gauss-Seidel over all
//! rows [Jean 1999] say which points slide and with what forces; this is repeated until nothing changes, at most
//! [`MOST_TRIALS`] times. Then the forces along the surface are cut to the cone, which they never leave.

use super::complementarity::Kind;
use super::constraints::Constraints;
use super::contact::{Rub, Rubbed};
use super::state::{ContactMemory, NonlinearState};
use crate::Vec3;

/// Problems of complementarity to solve: a few are the rule.
const MOST_TRIALS: usize = 12;

/// Sweeps after each of them: each costs as much as a product with the matrix.
const SWEEPS: usize = 10;

/// How near the cone a force slides, over its radius [-]: rounding.
const ON_CONE: f64 = 1e-12;

/// Change of a force that slides, over the cone's radius [-], below which it stands.
const STANDS: f64 = 1e-3;

impl Constraints {
    /// What holds in each row at the beginning of a step: what slid before still does.
    pub(super) fn begin_kinds(&mut self, state: &NonlinearState) {
        let (first, normals) = (self.bilateral(), self.contacts.normals());
        let kinds = &mut self.problem.kinds;
        kinds[..first].fill(Kind::Bilateral);
        kinds[first..first + normals].fill(Kind::Unilateral);
        for rub in &self.contacts.rubs {
            let slot = self.contacts.listed[rub.normal].slot;
            let kind = match state.rubbed_at(slot).slides {
                true => Kind::Open,
                false => Kind::Bilateral,
            };
            kinds[first + rub.along..][..2].fill(kind);
        }
    }

    /// Forces for what the conditions lack where these do not change; the changes into `t`.
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
        for _ in 0..MOST_TRIALS {
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
    fn rows(&self, rub: &Rub) -> (usize, usize) {
        let first = self.bilateral();
        (first + rub.normal, first + rub.along)
    }

    /// What the forces that slide displace a row by [m].
    fn slid_displacement(&self, row: usize) -> f64 {
        let rubs = self.contacts.rubs.iter();
        rubs.map(|rub| {
            let (_, along) = self.rows(rub);
            self.problem.get(row, along) * self.slid[along]
                + self.problem.get(row, along + 1) * self.slid[along + 1]
        })
        .sum()
    }

    /// Which points slide, and with what forces, by sweeps from the last solution; whether that is anything else than before.
    fn slide(&mut self) -> bool {
        if self.contacts.rubs.is_empty() {
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
            for number in 0..self.contacts.rubs.len() {
                let rub = self.contacts.rubs[number];
                let (_, along) = self.rows(&rub);
                self.problem.relax_pair(along, count);
                self.cut_to_cone(&rub);
            }
        }
        let mut changes = false;
        for number in 0..self.contacts.rubs.len() {
            let rub = self.contacts.rubs[number];
            let (normal, along) = self.rows(&rub);
            let limit = rub.friction * self.problem.x[normal];
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

    /// Takes the forces that slide into the solution, and cuts all along the surface to their cones.
    fn keep_cones(&mut self) {
        for number in 0..self.contacts.rubs.len() {
            let rub = self.contacts.rubs[number];
            let (_, along) = self.rows(&rub);
            if self.problem.kinds[along] == Kind::Open {
                self.problem.x[along..along + 2].copy_from_slice(&self.slid[along..along + 2]);
            }
            self.cut_to_cone(&rub);
        }
    }

    fn cut_to_cone(&mut self, rub: &Rub) {
        let (normal, along) = self.rows(rub);
        let limit = rub.friction * self.problem.x[normal].max(0.0);
        let x = &mut self.problem.x[along..along + 2];
        let size = x[0].hypot(x[1]);
        if size > limit {
            x.iter_mut().for_each(|force| *force *= limit / size);
        }
    }

    /// Keeps the forces of contacts in `state`, and where their points stick.
    pub(super) fn remember_contacts(&mut self, state: &mut NonlinearState) {
        let first = self.bilateral();
        self.remembered.clear();
        let normals = &self.contacts.listed[..self.contacts.normals()];
        for (number, contact) in normals.iter().enumerate() {
            if self.force[first + number] > 0.0 {
                let begun = Rubbed {
                    anchor: match contact.is_between {
                        false => contact.displacement(&state.displacements),
                        true => Vec3::zeros(),
                    },
                    ..Rubbed::default()
                };
                let mut rubs = self.contacts.rubs.iter();
                let rubbed = match rubs.find(|rub| rub.normal == number) {
                    Some(rub) => self.rubbed(rub, state),
                    None => begun,
                };
                self.remembered.push(ContactMemory {
                    slot: contact.slot,
                    force: self.force[first + number],
                    rubbed,
                });
            }
        }
        state.pressed.fill(0.0);
        state.rubbed.fill(Rubbed::default());
        state.on_tools.fill(ContactMemory::default());
        let mut on_tools = state.on_tools.iter_mut();
        for memory in self.remembered.drain(..) {
            if let Some(pressed) = state.pressed.get_mut(memory.slot) {
                *pressed = memory.force;
                state.rubbed[memory.slot] = memory.rubbed;
            } else if let Some(own) = on_tools.next() {
                *own = memory;
            }
        }
    }

    fn rubbed(&self, rub: &Rub, state: &NonlinearState) -> Rubbed {
        let (_, along) = self.rows(rub);
        let [first, second] = [0, 1].map(|k| &self.contacts.listed[rub.along + k]);
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
        Rubbed {
            force,
            anchor,
            slides,
        }
    }
}
