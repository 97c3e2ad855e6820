//! The state of a body between two steps: displacements, and history of its tools and contacts.

use nalgebra::{Matrix3, Rotation3};

use super::contact::{FrictionState, MAX_CONTACTS, UnilateralContact};
use super::coupling::Coupling;
use super::model::NonlinearModel;
use super::relaxation::{Relaxation, StressHistory};
use crate::Vec3;

/// Steps in which the force of a released tool fades: without that the body would spring back farther than a step
/// follows.
const FADES: u32 = 10;

const UNTURNED: [f32; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// A body between two steps.
#[derive(Debug, Clone, PartialEq)]
pub struct NonlinearState {
    /// Displacements of the nodes [m]; three a node.
    pub displacements: Vec<f64>,
    /// Those one step before, and two.
    pub(super) before: Vec<f64>,
    pub(super) earlier: Vec<f64>,
    /// Whether the last step can be continued.
    pub(super) is_smooth: bool,
    /// Rotations of the nodes in the last step, each column by column [-].
    pub(super) rotations: Vec<[f32; 9]>,
    pub(super) tools: Vec<ToolHistory>,
    pub(super) cavities: Vec<CavityHistory>,
    /// Contact force at each point of the boundary with fixed bodies [N], then with the boundary itself.
    pub(super) pressed: Vec<f64>,
    pub(super) friction_states: Vec<FrictionState>,
    /// The contacts with tools, then [`ContactHistory::default`]: few of very many points.
    pub(super) on_tools: Vec<ContactHistory>,
    /// Stress at the integration points in the past; none where nothing relaxes.
    pub(super) stress: Vec<StressHistory<f32>>,
    /// Forces on the nodes by released tools [N], and the steps in which they still act.
    pub(super) fading: Vec<f32>,
    pub(super) fades: u32,
}

/// History of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ContactHistory {
    pub(super) slot: usize,
    /// Force along the normal [N].
    pub(super) force: f64,
    pub(super) friction_state: FrictionState,
}

/// The slot of no contact.
const NO_SLOT: usize = usize::MAX;

impl ContactHistory {
    fn is_none(&self) -> bool {
        self.slot == NO_SLOT
    }
}

impl Default for ContactHistory {
    /// None.
    fn default() -> Self {
        Self {
            slot: NO_SLOT,
            force: 0.0,
            friction_state: FrictionState::default(),
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct ToolHistory {
    pub(super) is_coupled: bool,
    /// Its forces on the nodes [N].
    pub(super) load: Vec<f32>,
    pub(super) force: Vec3,
    pub(super) previous_force: Vec3,
}

/// The pressure in a cavity in the last step, and in the one before [Pa].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct CavityHistory {
    pub(super) pressure: f64,
    before: f64,
}

impl CavityHistory {
    /// Continues the last change by a `part` [-] of it.
    pub(super) fn continue_by(&mut self, part: f64) {
        let pressure = self.pressure + part * (self.pressure - self.before);
        (self.pressure, self.before) = (pressure, self.pressure);
    }

    /// Undoes that.
    pub(super) fn stay(&mut self) {
        self.pressure = self.before;
    }

    /// Sets a constant pressure [Pa].
    pub(super) fn set_pressure(&mut self, pressure: f64) {
        (self.pressure, self.before) = (pressure, pressure);
    }
}

impl NonlinearState {
    /// The body at rest, with `tools` tools.
    pub fn at_rest(model: &NonlinearModel, tools: usize) -> Self {
        let nodes = model.nodes().len();
        let size = 3 * nodes;
        let tool = ToolHistory {
            is_coupled: false,
            load: vec![0.0; size],
            force: Vec3::zeros(),
            previous_force: Vec3::zeros(),
        };
        let mut state = Self {
            displacements: vec![0.0; size],
            before: vec![0.0; size],
            earlier: vec![0.0; size],
            is_smooth: true,
            rotations: vec![UNTURNED; nodes],
            tools: vec![tool; tools],
            cavities: vec![CavityHistory::default(); model.walls.len()],
            pressed: vec![0.0; 2 * model.boundary_points().len()],
            friction_states: vec![FrictionState::default(); 2 * model.boundary_points().len()],
            on_tools: vec![ContactHistory::default(); MAX_CONTACTS],
            stress: model
                .relaxation
                .as_ref()
                .map_or_else(Vec::new, Relaxation::at_rest),
            fading: vec![0.0; size],
            fades: 0,
        };
        state.reset(model);
        state
    }

    /// Puts the body back to rest; nothing is allocated.
    ///
    /// # Panics
    /// When it is that of another model.
    pub fn reset(&mut self, model: &NonlinearModel) {
        if let Some(settled) = &model.settled {
            self.displacements.copy_from_slice(&settled.displacements);
            self.before.copy_from_slice(&settled.displacements);
            self.earlier.copy_from_slice(&settled.displacements);
            self.rotations.copy_from_slice(&settled.rotations);
            self.stress.copy_from_slice(&settled.stress);
            self.cavities.copy_from_slice(&settled.cavities);
        } else {
            self.displacements.fill(0.0);
            self.before.fill(0.0);
            self.earlier.fill(0.0);
            self.rotations.fill(UNTURNED);
            self.stress.fill(StressHistory::default());
            for (own, wall) in self.cavities.iter_mut().zip(&model.walls) {
                own.set_pressure(wall.content.own_pressure());
            }
        }
        self.fading.fill(0.0);
        self.pressed.fill(0.0);
        self.friction_states.fill(FrictionState::default());
        self.on_tools.fill(ContactHistory::default());
        self.fades = 0;
        self.is_smooth = true;
        for tool in &mut self.tools {
            tool.load.fill(0.0);
            tool.is_coupled = false;
            (tool.force, tool.previous_force) = (Vec3::zeros(), Vec3::zeros());
        }
    }

    /// The largest displacement of a node from rest along an axis [m], without free pieces.
    pub fn largest(&self, model: &NonlinearModel) -> f64 {
        match model.drag.count {
            0 => self.largest_of(model, |_| true),
            _ => self.largest_of(model, |node| model.drag.piece(node) == 0),
        }
    }

    fn largest_of(&self, model: &NonlinearModel, counts: impl Fn(u32) -> bool) -> f64 {
        let largest = |most: f64, off: f64| off.abs().max(most);
        let numbers = 0..self.displacements.len();
        let own = numbers.filter(|k| counts(*k as u32 / 3));
        match &model.settled {
            None => own.map(|k| self.displacements[k]).fold(0.0, largest),
            Some(settled) => own
                .map(|k| self.displacements[k] - settled.displacements[k])
                .fold(0.0, largest),
        }
    }

    /// Shrinks all displacements from rest to a `part` [-] of what they are, without those of free pieces; the next step
    /// then continues no motion.
    pub fn shrink(&mut self, model: &NonlinearModel, part: f64) {
        let settled = model.settled.as_ref();
        for (k, u) in self.displacements.iter_mut().enumerate() {
            if model.drag.piece(k as u32 / 3) == 0 {
                let rest = settled.map_or(0.0, |settled| settled.displacements[k]);
                *u = rest + part * (*u - rest);
            }
        }
        self.is_smooth = false;
    }

    /// Forgets the last motion.
    pub(super) fn stop(&mut self) {
        self.before.copy_from_slice(&self.displacements);
        self.earlier.copy_from_slice(&self.displacements);
        for own in &mut self.cavities {
            own.set_pressure(own.pressure);
        }
    }

    /// The pressure in a cavity after the last step [Pa].
    ///
    /// # Panics
    /// When there is no such cavity.
    pub fn cavity_pressure(&self, cavity: usize) -> f64 {
        self.cavities[cavity].pressure
    }

    /// Weighted mean of the displacements of `nodes` [m].
    pub fn mean_displacement(&self, nodes: &[(u32, f64)]) -> Vec3 {
        let nodes = nodes.iter();
        nodes
            .map(|&(node, weight)| {
                let u = &self.displacements[3 * node as usize..][..3];
                weight * Vec3::new(u[0], u[1], u[2])
            })
            .sum()
    }

    /// Largest motion of a node in the last step, along an axis [m].
    pub fn last_motion(&self) -> f64 {
        let each = self.displacements.iter().zip(&self.before);
        each.fold(0.0, |most, (now, before)| (now - before).abs().max(most))
    }

    /// The motion that a step continues.
    pub(super) fn motion(&self) -> Motion<'_> {
        let (from, steps) = match self.touches() {
            true => (&self.earlier, 2.0),
            false => (&self.before, 1.0),
        };
        Motion {
            from,
            to: &self.displacements,
            steps,
        }
    }

    /// Mean rotation of `nodes`.
    pub fn mean_rotation(&self, nodes: &[(u32, f64)]) -> Rotation3<f64> {
        let mut mean = Matrix3::zeros();
        for &(node, weight) in nodes {
            let q = &self.rotations[node as usize];
            mean += Matrix3::from_iterator(q.iter().map(|&entry| weight * f64::from(entry)));
        }
        Rotation3::from_matrix_eps(&mean, 1e-9, 20, Rotation3::identity())
    }

    /// Whether a body other than a tool touched the boundary in the last step.
    fn touches(&self) -> bool {
        self.pressed.iter().any(|force| *force > 0.0)
    }

    /// Whether there is friction at a point of the boundary.
    pub fn has_friction(&self) -> bool {
        let has_friction = |friction: &FrictionState| friction.force != Vec3::zeros();
        let mut on_tools = self.on_tools.iter().take_while(|own| !own.is_none());
        on_tools.any(|own| has_friction(&own.friction_state))
            || (self.touches() && self.friction_states.iter().any(has_friction))
    }

    /// Whether no node is displaced from rest by more than `most` [m] along any axis, and no force fades.
    pub fn is_within(&self, model: &NonlinearModel, most: f64) -> bool {
        self.fades == 0 && self.largest_of(model, |_| true) <= most
    }

    /// Contact force at a point of the boundary with fixed bodies [N], along its normal.
    ///
    /// # Panics
    /// When there is no such point.
    pub fn contact_force(&self, point: u32) -> f64 {
        self.pressed[point as usize]
    }

    /// The same with another place of the boundary, which takes the opposite force.
    ///
    /// # Panics
    /// When there is no such point.
    pub fn force_between(&self, point: u32) -> f64 {
        self.pressed[self.pressed.len() / 2 + point as usize]
    }

    /// Friction force at a point of the boundary against fixed bodies [N], on the body.
    ///
    /// # Panics
    /// When there is no such point.
    pub fn friction_force(&self, point: u32) -> Vec3 {
        self.friction_states[point as usize].force
    }

    /// The same against another place of the boundary, on the point.
    ///
    /// # Panics
    /// When there is no such point.
    pub fn friction_between(&self, point: u32) -> Vec3 {
        self.friction_states[self.friction_states.len() / 2 + point as usize].force
    }

    /// Force of a contact [N] along its normal after the last step.
    ///
    /// # Panics
    /// When it has no point of `model`, or the state is that of another.
    pub fn force_of(&self, model: &NonlinearModel, contact: &UnilateralContact) -> f64 {
        self.pressed_at(contact.slot(model))
    }

    /// Force of friction at a contact [N] on its point after the last step.
    ///
    /// # Panics
    /// When it has no point of `model`, or the state is that of another.
    pub fn friction_of(&self, model: &NonlinearModel, contact: &UnilateralContact) -> Vec3 {
        self.friction_state_at(contact.slot(model)).force
    }

    /// Whether any place of the boundary is a contact of its own with a tool: with a shaft, or a tip that a wall wraps.
    pub fn touches_tools(&self) -> bool {
        !self.on_tools[0].is_none()
    }

    pub(super) fn pressed_at(&self, slot: usize) -> f64 {
        match self.pressed.get(slot) {
            Some(force) => *force,
            None => self.on_tool(slot).force,
        }
    }

    pub(super) fn friction_state_at(&self, slot: usize) -> FrictionState {
        match self.friction_states.get(slot) {
            Some(state) => *state,
            None => self.on_tool(slot).friction_state,
        }
    }

    fn on_tool(&self, slot: usize) -> ContactHistory {
        let mut known = self.on_tools.iter().take_while(|own| !own.is_none());
        let own = known.find(|own| own.slot == slot);
        own.copied().unwrap_or_default()
    }

    /// Whether any place of the boundary is in contact with another.
    pub fn has_self_contact(&self) -> bool {
        self.pressed[self.pressed.len() / 2..]
            .iter()
            .any(|force| *force > 0.0)
    }

    /// Force of a tool on the body [N].
    ///
    /// # Panics
    /// When there is no such tool.
    pub fn force(&self, tool: usize) -> Vec3 {
        self.tools[tool].force
    }
}

/// The motion of the last step; in contact the mean of the last two, in which points that go to and fro do not count: continued,
/// they would do so ever farther.
#[derive(Debug, Clone, Copy)]
pub(super) struct Motion<'a> {
    pub(super) from: &'a [f64],
    pub(super) to: &'a [f64],
    pub(super) steps: f64,
}

impl Motion<'_> {
    /// That of the weighted mean of `nodes` [m].
    pub(super) fn of(&self, nodes: &[(u32, f64)]) -> Vec3 {
        let nodes = nodes.iter();
        nodes
            .map(|&(node, weight)| {
                let at = 3 * node as usize;
                let by = Vec3::from_fn(|axis, _| self.to[at + axis] - self.from[at + axis]);
                (weight / self.steps) * by
            })
            .sum()
    }
}

impl NonlinearState {
    /// Lets the forces of released tools fade, each step more.
    #[inline(always)]
    pub(super) fn fade(&mut self, couplings: &[Option<Coupling<'_>>]) {
        self.fades = self.fades.saturating_sub(1);
        let part = self.fades as f32 / (self.fades + 1) as f32;
        if part == 0.0 {
            self.fading.fill(0.0);
        } else {
            self.fading.iter_mut().for_each(|force| *force *= part);
        }
        for (coupling, history) in couplings.iter().zip(&mut self.tools) {
            if coupling.is_none() && history.is_coupled {
                self.fades = FADES;
                for (sum, force) in self.fading.iter_mut().zip(&history.load) {
                    *sum += force;
                }
            }
        }
    }

    pub(super) fn is_finite(&self) -> bool {
        let sum: f64 = self.displacements.iter().sum();
        let forces = self.tools.iter().flat_map(|tool| tool.force.iter());
        let pressures = self.cavities.iter().map(|own| own.pressure);
        sum.is_finite() && forces.chain(&[pressures.sum()]).sum::<f64>().is_finite()
    }
}
