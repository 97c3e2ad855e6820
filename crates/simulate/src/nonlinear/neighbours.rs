//! Contact of the organ with neighbours, with Coulomb friction: rigid bodies, and with them bodies that bend (`soft`).
//!
//! Each point of the boundary that is inside a neighbour at rest keeps its distance from it: where an organ grows
//! through a neighbour, nothing pushes it out. Points deeper than [`GROWN_IN`] are not in contact with it: they would
//! not leave through the nearest surface.
//!
//! *How we know*: `nonlinear_neighbours::…`.

use palpate_geometry::{AabbTree, Surface, TriangleId, Vec3};
use palpate_mechanics::nonlinear::{
    Against, MAX_CONTACTS, NonlinearModel, NonlinearState, TouchingSearch, UnilateralContact,
};
use palpate_mechanics::{Limit, Reached};

use super::NonlinearOrgan;
use super::shafts::ShaftMotion;
use crate::neighbour::Neighbour;
use crate::state::ToolState;

/// A point is a candidate for contact within this distance plus the motion of the step [m]. One that moves farther is a
/// candidate in the next step.
const NEAR: f64 = 0.3e-3;

/// Upper bound of the motion of a step [m]: hardly any part of an organ moves farther.
const MAX_MOTION: f64 = 2e-3;

/// The sides of cuts lie on each other at rest: a point is a candidate from this depth in the other side on [m], and then as
/// long as it bears.
const SHUT: f64 = 1e-5;

/// Points deeper in a neighbour at rest are not in contact with it [m].
const GROWN_IN: f64 = 2e-3;

/// The motions in a step, or in a part of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepMotion<'a> {
    pub(super) shafts: &'a [Option<ShaftMotion>],
    /// The start and end of each shaft's motion, as fractions of its step [-].
    pub(super) parts: [f64; 2],
    /// Largest motion of the tools [m].
    pub(super) travel: f64,
}

/// The points of the boundary, for contact with neighbours.
#[derive(Debug, Clone)]
pub(super) struct Skin {
    /// At rest, on the displayed surface, which coarse faces cut short [m].
    places: Vec<Vec3>,
    /// Signed distance of the points to each neighbour at rest, negative inside [m]; −∞ without contact.
    overlaps: Vec<Vec<f64>>,
}

impl Skin {
    pub(super) fn new(
        model: &NonlinearModel,
        shown: &Surface,
        tree: &AabbTree,
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
            let places = places.iter().zip(points).enumerate();
            let depths = places.map(|(number, (place, point))| {
                // A neighbour in a cavity is ignored.
                if !model.is_outer(number) {
                    return f64::NEG_INFINITY;
                }
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

/// The position of a point when its distance was last computed [m], and that distance, which bounds the present one.
/// The nearest triangle then makes the next search faster and changes no result.
#[derive(Debug, Clone, Copy)]
struct LastDistance {
    place: Vec3,
    distance: f64,
    nearest: Option<TriangleId>,
}

/// The contacts that may be active in a step. Scratch.
#[derive(Debug)]
pub(super) struct Candidates {
    last_distances: Vec<LastDistance>,
    found: Vec<(f64, UnilateralContact)>,
    pub(super) contacts: Vec<UnilateralContact>,
    /// Number of such points beyond those that a step takes.
    left_out: usize,
    touching: Option<TouchingSearch>,
    /// Depth of a point in the body itself that contact no longer pushes out [m].
    lost: f64,
}

impl Candidates {
    pub(super) fn new(organ: &NonlinearOrgan, tools: usize) -> Self {
        let points = organ.model.boundary_points().len();
        let initial = LastDistance {
            place: Vec3::zeros(),
            distance: f64::NEG_INFINITY,
            nearest: None,
        };
        let count = organ.skin.neighbours() * points;
        let touching = organ.touching.as_ref().map(TouchingSearch::new);
        let beside = if touching.is_some() { points } else { 0 };
        let on_shafts = tools * organ.model.tool_points().len();
        Self {
            last_distances: vec![initial; count],
            found: Vec::with_capacity(count + beside + on_shafts),
            contacts: Vec::with_capacity(MAX_CONTACTS),
            left_out: 0,
            touching,
            lost: 0.0,
        }
    }

    /// Finds the candidates of a step from `state`; the deepest ones if there are too many.
    pub(super) fn find(
        &mut self,
        organ: &NonlinearOrgan,
        neighbours: &[Neighbour],
        motion: StepMotion<'_>,
        state: &NonlinearState,
    ) {
        let near = NEAR + (motion.travel + state.last_motion()).min(MAX_MOTION);
        let (points, skin) = (organ.model.boundary_points(), &organ.skin);
        self.found.clear();
        if let (Some(search), Some(boundary)) = (&mut self.touching, &organ.touching) {
            let found = &mut self.found;
            self.lost = search.find(boundary, &organ.model, state, |own| {
                let bears = state.force_between(own.contact.point) > 0.0;
                if !own.is_in_slit || bears || own.gap < -SHUT {
                    found.push((own.gap, own.contact));
                }
            });
        }
        let bodies = neighbours.iter().zip(&skin.overlaps);
        for ((neighbour, overlap), last_distances) in
            bodies.zip(self.last_distances.chunks_mut(points.len()))
        {
            for (number, (point, last)) in points.iter().zip(last_distances).enumerate() {
                let moved = point.displacement(&state.displacements);
                let place = skin.places[number] + moved;
                let allowed = overlap[number];
                let is_active = state.contact_force(number as u32) > 0.0;
                let least = last.distance - (place - last.place).norm();
                if least - allowed > near && !is_active {
                    continue;
                }
                let nearest = neighbour.nearest(&place, last.nearest);
                let normal = nearest.normal;
                *last = LastDistance {
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
                        against: Against::Fixed,
                    };
                    self.found.push((gap, contact));
                }
            }
        }
        for shaft in motion.shafts.iter().flatten() {
            let found = &mut self.found;
            organ.meet_shaft(shaft, motion.parts, state, |gap, contact| {
                found.push((gap, contact));
            });
        }
        self.left_out = self.found.len().saturating_sub(MAX_CONTACTS);
        if self.left_out > 0 {
            self.found
                .select_nth_unstable_by(MAX_CONTACTS, |a, b| a.0.total_cmp(&b.0));
            self.found.truncate(MAX_CONTACTS);
        }
        self.contacts.clear();
        self.contacts
            .extend(self.found.iter().map(|(_, contact)| *contact));
    }

    /// Whether parts of the body may touch one another in the step.
    pub(super) fn has_self_contact(&self) -> bool {
        self.contacts
            .iter()
            .any(|own| matches!(own.against, Against::Boundary(_)))
    }

    /// Whether the body may touch shafts in the step.
    pub(super) fn touches_shafts(&self) -> bool {
        let mut contacts = self.contacts.iter();
        contacts.any(|own| matches!(own.against, Against::Tool { .. }))
    }

    /// Reports points that were left out, under a tool in contact.
    pub(super) fn report(&self, tool: &mut ToolState) {
        if self.left_out > 0 {
            let reached = Reached {
                unbounded: (MAX_CONTACTS + self.left_out) as f64,
                used: MAX_CONTACTS as f64,
            };
            tool.limited.add(Limit::NeighbourContacts, reached);
        }
        if self.lost > 0.0 {
            let reached = Reached {
                unbounded: self.lost,
                used: 0.0,
            };
            tool.limited.add(Limit::LostContact, reached);
        }
    }
}
