//! Neighbours that the organ stays out of, with Coulomb's friction: rigid bodies, and with them what bends (`soft`).
//!
//! Each point of the boundary keeps the distance that it has from a neighbour at rest, as far as it lies within it there:
//! where an organ grows through a neighbour, nothing pushes it out. What lies deeper in it than [`GROWN_IN`] does not meet it
//! at all: its nearest surface says nothing of where it would go.
//!
//! *How we know*: `nonlinear_neighbours::…`.

use palpate_geometry::{AabbTree, Surface, TriangleId, Vec3};
use palpate_mechanics::nonlinear::{
    Against, MOST_CONTACTS, NonlinearModel, NonlinearState, TouchingSearch, UnilateralContact,
};
use palpate_mechanics::{Limit, Reached};

use super::NonlinearOrgan;
use super::shafts::ShaftMotion;
use crate::neighbour::Neighbour;
use crate::state::ToolState;

/// Points that are nearer than this and what a step goes may bear in it [m]; one that goes farther bears in the next.
const NEAR: f64 = 0.3e-3;

/// A step goes no farther than this [m]: no part of an organ goes much farther in one.
const FARTHEST: f64 = 2e-3;

/// Points that are so deep in a neighbour at rest do not meet it [m].
const GROWN_IN: f64 = 2e-3;

/// The points of the boundary as neighbours meet them.
#[derive(Debug, Clone)]
pub(super) struct Skin {
    /// At rest, on the shown surface, which coarse faces cut short [m].
    places: Vec<Vec3>,
    /// For each neighbour, how deep they lie in it at rest, as negative distances [m]; −∞ where they do not meet it.
    overlaps: Vec<Vec<f64>>,
}

impl Skin {
    pub(super) fn new(
        model: &NonlinearModel,
        (shown, tree): (&Surface, &AabbTree),
        neighbours: &[Neighbour],
    ) -> Self {
        let rest = NonlinearState::at_rest(model, 0);
        let points = model.boundary_points();
        let beside = if neighbours.is_empty() { &[] } else { points };
        let places: Vec<Vec3> = beside
            .iter()
            .map(|point| tree.nearest(shown.mesh(), &point.place).on.position)
            .collect();
        let overlap = |neighbour: &Neighbour| {
            let places = places.iter().zip(points);
            let depths = places.map(|(place, point)| {
                let place = place + point.displacement(&rest.displacements);
                match neighbour.nearest(&place, None).distance.min(0.0) {
                    deep if deep < -GROWN_IN => f64::NEG_INFINITY,
                    overlap => overlap,
                }
            });
            depths.collect()
        };
        Self {
            overlaps: neighbours.iter().map(overlap).collect(),
            places,
        }
    }

    pub(super) fn neighbours(&self) -> usize {
        self.overlaps.len()
    }
}

/// Where a point was when its distance was last sought [m], and that distance: a bound of what it is elsewhere. The
/// triangle that was nearest only makes the next search shorter.
#[derive(Debug, Clone, Copy)]
struct Known {
    place: Vec3,
    distance: f64,
    nearest: Option<TriangleId>,
}

/// The points that may bear in a step. Scratch.
#[derive(Debug)]
pub(super) struct Candidates {
    known: Vec<Known>,
    found: Vec<(f64, UnilateralContact)>,
    pub(super) contacts: Vec<UnilateralContact>,
    /// Such points beyond those that a step takes.
    left_out: usize,
    touching: Option<TouchingSearch>,
    /// How deep a point lies in the body itself that nothing pushes out any more [m].
    lost: f64,
}

impl Candidates {
    pub(super) fn new(organ: &NonlinearOrgan, tools: usize) -> Self {
        let points = organ.model.boundary_points().len();
        let unknown = Known {
            place: Vec3::zeros(),
            distance: f64::NEG_INFINITY,
            nearest: None,
        };
        let count = organ.skin.neighbours() * points;
        let touching = organ.touching.as_ref().map(TouchingSearch::new);
        let beside = if touching.is_some() { points } else { 0 };
        let on_shafts = tools * organ.model.tool_points().len();
        Self {
            known: vec![unknown; count],
            found: Vec::with_capacity(count + beside + on_shafts),
            contacts: Vec::with_capacity(MOST_CONTACTS),
            left_out: 0,
            touching,
            lost: 0.0,
        }
    }

    /// Finds them where the body is in `state`, and the shafts which go from one part of their ways to another [-], in a step in
    /// which the tools go a `way` [m]; those that are deepest if a step cannot take all.
    pub(super) fn find(
        &mut self,
        organ: &NonlinearOrgan,
        neighbours: &[Neighbour],
        (shafts, parts, way): (&[Option<ShaftMotion>], [f64; 2], f64),
        state: &NonlinearState,
    ) {
        let near = NEAR + (way + state.last_way()).min(FARTHEST);
        let (points, skin) = (organ.model.boundary_points(), &organ.skin);
        self.found.clear();
        if let (Some(search), Some(boundary)) = (&mut self.touching, &organ.touching) {
            let found = &mut self.found;
            self.lost = search.find(boundary, (&organ.model, state), |gap, contact| {
                found.push((gap, contact));
            });
        }
        let bodies = neighbours.iter().zip(&skin.overlaps);
        for ((neighbour, overlap), known) in bodies.zip(self.known.chunks_mut(points.len())) {
            for (number, (point, known)) in points.iter().zip(known).enumerate() {
                let moved = point.displacement(&state.displacements);
                let place = skin.places[number] + moved;
                let allowed = overlap[number];
                let bears = state.contact_force(number as u32) > 0.0;
                let least = known.distance - (place - known.place).norm();
                if least - allowed > near && !bears {
                    continue;
                }
                let nearest = neighbour.nearest(&place, known.nearest);
                let normal = nearest.normal;
                *known = Known {
                    place,
                    distance: nearest.distance,
                    nearest: Some(nearest.triangle),
                };
                let gap = nearest.distance - allowed;
                if gap < near {
                    let contact = UnilateralContact {
                        point: number as u32,
                        normal,
                        offset: gap - normal.dot(&moved),
                        friction: neighbour.friction,
                        against: Against::Still,
                    };
                    self.found.push((gap, contact));
                }
            }
        }
        for motion in shafts.iter().flatten() {
            let found = &mut self.found;
            organ.meet_shaft(motion, parts, state, |gap, contact| {
                found.push((gap, contact));
            });
        }
        self.left_out = self.found.len().saturating_sub(MOST_CONTACTS);
        if self.left_out > 0 {
            self.found
                .select_nth_unstable_by(MOST_CONTACTS, |a, b| a.0.total_cmp(&b.0));
            self.found.truncate(MOST_CONTACTS);
        }
        self.contacts.clear();
        self.contacts
            .extend(self.found.iter().map(|(_, contact)| *contact));
    }

    /// Whether places of the body may bear on one another in the step.
    pub(super) fn touches_itself(&self) -> bool {
        self.contacts
            .iter()
            .any(|own| matches!(own.against, Against::Boundary(_)))
    }

    /// Whether places of the body may bear on shafts in the step.
    pub(super) fn touches_shafts(&self) -> bool {
        let mut contacts = self.contacts.iter();
        contacts.any(|own| matches!(own.against, Against::Tool { .. }))
    }

    /// Reports points that were left out, under a tool that touches.
    pub(super) fn report(&self, tool: &mut ToolState) {
        if self.left_out > 0 {
            let reached = Reached {
                asked: (MOST_CONTACTS + self.left_out) as f64,
                used: MOST_CONTACTS as f64,
            };
            tool.limited.add(Limit::NeighbourContacts, reached);
        }
        if self.lost > 0.0 {
            let reached = Reached {
                asked: self.lost,
                used: 0.0,
            };
            tool.limited.add(Limit::LostContact, reached);
        }
    }
}
