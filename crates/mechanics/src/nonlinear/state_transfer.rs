//! Transfer of a state to other elements of the same body, such as those of a slit.

use std::collections::HashMap;

use super::contact::BoundaryPoint;
use super::elements::{NODES, POINTS};
use super::embedded::{EmbeddedPoints, InElements};
use super::model::NonlinearModel;
use super::state::{ContactHistory, NonlinearState};
use super::step::Workspace;
use crate::{Error, Vec3};

/// A node is looked for this part of the way to the middle of its element [-]: on the side of a slit that the element is on.
const INWARDS: f64 = 1e-4;

/// The transfer of states from one model to another: the same body at rest, in other elements.
#[derive(Debug)]
pub struct StateTransfer {
    /// The nodes of the other, in the elements of the first.
    nodes: EmbeddedPoints,
    /// Of each integration point of the other, element by element: the element and the point of the first nearest to it.
    stress: Vec<Option<(usize, usize)>>,
    /// Points of the boundary that both have: their numbers in the other and in the first.
    boundary: Vec<(usize, usize)>,
    /// Of each point that may touch tools in the first, the same in the other.
    tools: Vec<Option<usize>>,
}

impl StateTransfer {
    /// From states of `from` to those of `to`.
    ///
    /// # Errors
    /// When `from` has no elements.
    pub fn new(from: &NonlinearModel, to: &NonlinearModel) -> Result<Self, Error> {
        let all = 0..from.mesh().tetrahedra().len();
        let inside = InElements::new(from.mesh(), all.clone());
        let elements = 0..to.mesh().tetrahedra().len();
        let stress = match from.relaxes() && to.relaxes() {
            true => elements
                .flat_map(|element| (0..POINTS).map(move |point| (element, point)))
                .map(|(element, point)| {
                    inside.nearest_point(&integration_point(to, element, point))
                })
                .collect(),
            false => Vec::new(),
        };
        let mut tools = vec![None; from.tool_points().len()];
        for (own, other) in same_places(from.tool_points(), to.tool_points()) {
            tools[other] = Some(own);
        }
        Ok(Self {
            nodes: from.embed(&inner_places(to), all)?,
            stress,
            boundary: same_places(from.boundary_points(), to.boundary_points()),
            tools,
        })
    }

    /// Takes the body of `to` to where that of `from` is in the state `before`; it moves on from there, and contacts are known at
    /// the places of the boundary that both have. Nothing is allocated.
    ///
    /// # Panics
    /// When a state or the workspace is that of another model or of fewer tools.
    pub fn transfer(
        &self,
        from: &NonlinearModel,
        before: &NonlinearState,
        to: &NonlinearModel,
        state: &mut NonlinearState,
        workspace: &mut Workspace,
    ) {
        state.reset(to);
        let displacements = self.nodes.displacements(before);
        for (own, by) in state.displacements.chunks_exact_mut(3).zip(displacements) {
            own.copy_from_slice(by.as_slice());
        }
        state.stop();
        state.is_smooth = false;
        workspace.turn(to, state);
        if let (Some(own), Some(others)) = (&to.relaxation, &from.relaxation) {
            own.carry(
                others,
                &before.stress,
                &mut state.stress,
                |element, point| self.stress[POINTS * element + point],
            );
        }
        let [halves_before, halves] = [from, to].map(|model| model.boundary_points().len());
        for (own, other) in &self.boundary {
            for half in 0..2 {
                let [own, other] = [own + half * halves, other + half * halves_before];
                state.pressed[own] = before.pressed[other];
                state.friction_states[own] = before.friction_states[other];
            }
        }
        for (own, other) in state.cavities.iter_mut().zip(&before.cavities) {
            own.set_pressure(other.pressure);
        }
        for (own, other) in state.tools.iter_mut().zip(&before.tools) {
            own.is_coupled = other.is_coupled;
            (own.force, own.previous_force) = (other.force, other.previous_force);
        }
        let [points_before, points] = [from, to].map(|model| model.tool_points().len());
        let carried = before.on_tools.iter().filter_map(|history| {
            let number = history.slot.checked_sub(2 * halves_before)?;
            let (tool, point) = (number / points_before, number % points_before);
            let point = self.tools[point]?;
            let slot = 2 * halves + tool * points + point;
            (tool < before.tools.len()).then_some(ContactHistory { slot, ..*history })
        });
        for (own, carried) in state.on_tools.iter_mut().zip(carried) {
            *own = carried;
        }
    }
}

/// The nodes of a model, each a little inwards [m].
fn inner_places(model: &NonlinearModel) -> Vec<Vec3> {
    let mut places = model.nodes().to_vec();
    for (element, nodes) in model.elements().chunks_exact(NODES).enumerate() {
        let middle = model.mesh().positions(element).iter().sum::<Vec3>() / 4.0;
        for &node in nodes {
            let place = &model.nodes()[node as usize];
            places[node as usize] = place + INWARDS * (middle - place);
        }
    }
    places
}

/// Position of an integration point at rest [m].
fn integration_point(model: &NonlinearModel, element: usize, point: usize) -> Vec3 {
    let corners = model.mesh().positions(element);
    let shares = (0..4).map(|corner| match corner == point {
        true => super::elements::NEAR,
        false => super::elements::FAR,
    });
    shares
        .zip(corners)
        .map(|(share, corner)| share * corner)
        .sum()
}

/// The points of `now` that are points of `before`: the number of each in both. Places that a list has twice, on both sides of a slit,
/// are none of them.
fn same_places(before: &[BoundaryPoint], now: &[BoundaryPoint]) -> Vec<(usize, usize)> {
    let key = |point: &BoundaryPoint| <[f64; 3]>::from(point.place).map(f64::to_bits);
    let once = |points: &[BoundaryPoint]| {
        let mut numbers: HashMap<[u64; 3], Option<usize>> = HashMap::new();
        for (number, point) in points.iter().enumerate() {
            let known = numbers.entry(key(point));
            known
                .and_modify(|number| *number = None)
                .or_insert(Some(number));
        }
        numbers
    };
    let (known_before, known_now) = (once(before), once(now));
    let pairs = now.iter().filter_map(|point| {
        let [own, other] = [&known_now, &known_before].map(|known| known.get(&key(point)));
        Some(((*own?)?, (*other?)?))
    });
    pairs.collect()
}
