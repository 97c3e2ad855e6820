//! Contact of tissue with the indenter, node by node.
//!
//! A node of the surface that would enter the indenter is activated: at the place where it entered (stick)
//! or on the surface that it entered through (slide). A node under tension is released, unless it belongs
//! to a face that cannot lose it.
//!
//! With Coulomb friction a node sticks while the tangential force |T| is at most μ N, and otherwise slips with |T| = μ N
//! from the place where it last stood: the closest-point return of plasticity, backward in time. It sticks again when
//! it would slip along its force.

use super::super::rigid_tool::{MeridianDistance, RigidShape};
use super::super::supports::RigidSurface;
use super::indenter::{Indenter, IndenterShape, Side};
use crate::contact::FrictionLaw;

/// Rounding of the mesh's own lines [-].
const ROUNDING: f64 = 1e-9;

/// A part of an indenter's surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// The flat face.
    Face,
    /// The side of a flat punch.
    Side,
    /// All of a sphere, a cone or a punch with a rounded edge.
    Round,
}

/// Contact of a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ContactStatus {
    /// None.
    Free,
    /// Stays where it is on the indenter.
    Stuck { part: Part, at: Place },
    /// Slides.
    Sliding { part: Part, slip: Slip },
}

/// How a node slides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slip {
    /// Tangential over normal force on the tissue [-]; 0 without friction.
    pub(super) force_ratio: f64,
    /// Its place at the last equilibrium, or where it entered since.
    pub(super) from: Place,
}

/// A place relative to the indenter: radius and height above its lowest point [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub(super) radius: f64,
    pub(super) above: f64,
}

/// Limits below which a node keeps its status.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tolerances {
    /// Force beyond the cone of friction [N].
    pub(super) force: f64,
    /// Slip along the force of friction [m].
    pub(super) slip: f64,
}

impl Part {
    /// The part that a free node meets.
    pub(super) fn of(shape: IndenterShape) -> Self {
        match shape {
            IndenterShape::Flat { .. } => Self::Side,
            IndenterShape::RoundedPunch { .. }
            | IndenterShape::Sphere
            | IndenterShape::Cone { .. } => Self::Round,
        }
    }
}

impl Indenter {
    /// The surface of a part when the lowest point is at `height` [m].
    pub(super) fn surface(&self, part: Part, height: f64) -> RigidSurface {
        match (part, self.shape) {
            (Part::Face, _) => RigidSurface::Plane { height },
            (
                Part::Round,
                IndenterShape::Cone {
                    half_angle,
                    apex_radius,
                },
            ) => RigidSurface::Revolved {
                shape: RigidShape::Cone {
                    half_angle,
                    apex_radius,
                },
                height,
            },
            (Part::Round, IndenterShape::RoundedPunch { edge_radius }) => RigidSurface::Revolved {
                shape: RigidShape::FlatPunch {
                    radius: self.radius,
                    edge_radius,
                },
                height,
            },
            (Part::Round, IndenterShape::Sphere | IndenterShape::Flat { .. }) => {
                RigidSurface::Revolved {
                    shape: RigidShape::Sphere {
                        radius: self.radius,
                    },
                    height: height + self.radius,
                }
            }
            (Part::Side, _) => RigidSurface::Cylinder {
                radius: self.radius,
            },
        }
    }

    /// The law of friction of a part.
    pub(super) fn friction(&self, part: Part) -> FrictionLaw {
        match (part, self.shape) {
            (
                Part::Side,
                IndenterShape::Flat {
                    side: Side::Touches(law),
                },
            ) => law,
            _ => self.face,
        }
    }

    /// Coulomb's coefficient of a part [-]; none where its friction is of another kind.
    fn coefficient(&self, part: Part) -> Option<f64> {
        match self.friction(part) {
            FrictionLaw::Coulomb(coefficient) => Some(coefficient),
            FrictionLaw::Bonded | FrictionLaw::Frictionless => None,
        }
    }

    /// Coulomb's coefficient that bounds the force on a node [-]: none on a sharp edge between a face and a side with
    /// friction: it is on both, and the node does not go around it.
    pub(super) fn coefficient_of(&self, status: ContactStatus) -> Option<f64> {
        let part = status.part()?;
        let on_edge = match status {
            ContactStatus::Stuck { at, .. } => at.radius >= self.radius * (1.0 - 1e-9),
            ContactStatus::Sliding { .. } | ContactStatus::Free => false,
        };
        let has_side = matches!(
            self.shape,
            IndenterShape::Flat {
                side: Side::Touches(FrictionLaw::Coulomb(_))
            }
        );
        match part == Part::Face && on_edge && has_side {
            true => None,
            false => self.coefficient(part),
        }
    }

    /// Coulomb's coefficients of what can touch [-].
    pub(super) fn coefficients(&self) -> impl Iterator<Item = f64> {
        [Part::Face, Part::of(self.shape)]
            .into_iter()
            .filter_map(|part| self.coefficient(part))
    }

    /// Signed distance of a place to a part.
    pub(super) fn signed_distance(&self, part: Part, place: Place) -> MeridianDistance {
        self.surface(part, 0.0)
            .signed_distance(place.radius, place.above)
    }

    /// Contact of a node of the untouched surface at `rest`.
    pub(super) fn first_touch(&self, rest: Place) -> ContactStatus {
        match self.shape {
            IndenterShape::Flat { .. } if rest.radius <= self.radius * (1.0 + ROUNDING) => {
                self.status_at(Part::Face, rest)
            }
            IndenterShape::RoundedPunch { edge_radius }
                if rest.radius <= (self.radius - edge_radius) * (1.0 + ROUNDING) =>
            {
                self.status_at(Part::Round, rest)
            }
            _ => ContactStatus::Free,
        }
    }

    /// Contact of a node that has come to a part.
    fn status_at(&self, part: Part, at: Place) -> ContactStatus {
        match self.friction(part) {
            FrictionLaw::Bonded | FrictionLaw::Coulomb(_) => ContactStatus::Stuck { part, at },
            FrictionLaw::Frictionless => ContactStatus::Sliding {
                part,
                slip: Slip {
                    force_ratio: 0.0,
                    from: at,
                },
            },
        }
    }

    /// How deep a place is inside the indenter [m]; negative outside it.
    pub(super) fn inside(&self, place: Place) -> f64 {
        match Part::of(self.shape) {
            Part::Side if place.above <= 0.0 => f64::NEG_INFINITY,
            part => -self.signed_distance(part, place).distance,
        }
    }

    /// The contact of a node that came from `then`, outside, to `now`, inside. The part of the way at
    /// which it came in is also answered [-].
    pub(super) fn activate(&self, then: Place, now: Place) -> (ContactStatus, f64) {
        if self.shape == (IndenterShape::Flat { side: Side::Absent }) {
            return (ContactStatus::Free, 0.0);
        }
        let part = Part::of(self.shape);
        if self.friction(part) == FrictionLaw::Frictionless {
            return (self.status_at(part, now), 1.0);
        }
        let (outside, inside) = (-self.inside(then), self.inside(now));
        let share = if outside > 0.0 && outside.is_finite() {
            outside / (outside + inside)
        } else {
            0.0
        };
        let between = |a: f64, b: f64| a + share * (b - a);
        let at = Place {
            radius: between(then.radius, now.radius),
            above: between(then.above, now.above),
        };
        (self.status_at(part, at), share)
    }

    /// Whether an active node is to be released: it is at `place` and the indenter acts on the tissue
    /// with `force` [N], (r, z).
    pub(super) fn is_released(&self, status: ContactStatus, place: Place, force: [f64; 2]) -> bool {
        let Some(part) = status.part().filter(|part| *part != Part::Face) else {
            return false;
        };
        let slides = matches!(status, ContactStatus::Sliding { .. });
        // A sharp apex stays where it has gone in.
        let is_sharp =
            matches!(self.shape, IndenterShape::Cone { apex_radius, .. } if apex_radius == 0.0);
        if is_sharp && place.radius == 0.0 {
            return false;
        }
        let [push, _] = self.signed_distance(part, place).components(force);
        push < 0.0 || (slides && part == Part::Side && place.above < 0.0)
    }

    /// The next status of an active node by the cone of friction, at `place` off the axis, where the indenter acts on
    /// it with `force` [N], (r, z); none where it keeps its status.
    pub(super) fn stick_or_slip(
        &self,
        status: ContactStatus,
        place: Place,
        force: [f64; 2],
        tolerances: Tolerances,
    ) -> Option<ContactStatus> {
        let part = status.part()?;
        let coefficient = self.coefficient_of(status)?;
        let found = self.signed_distance(part, place);
        let [normal, tangential] = found.components(force);
        match status {
            ContactStatus::Free => None,
            ContactStatus::Stuck { at, .. } => {
                let most = coefficient * normal.max(0.0) + tolerances.force;
                (tangential.abs() > most).then_some(ContactStatus::Sliding {
                    part,
                    slip: Slip {
                        force_ratio: coefficient.copysign(tangential),
                        from: at,
                    },
                })
            }
            ContactStatus::Sliding { slip, .. } => {
                let Slip { force_ratio, from } = slip;
                let moved = [place.radius - from.radius, place.above - from.above];
                let [_, along] = found.components(moved);
                let with_force = along * 1_f64.copysign(force_ratio) > tolerances.slip;
                with_force.then_some(ContactStatus::Stuck { part, at: from })
            }
        }
    }
}

impl ContactStatus {
    /// The part of the indenter that it is on.
    pub(super) fn part(&self) -> Option<Part> {
        match *self {
            Self::Free => None,
            Self::Stuck { part, .. } | Self::Sliding { part, .. } => Some(part),
        }
    }
}
