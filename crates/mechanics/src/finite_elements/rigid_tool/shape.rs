//! Shapes of rigid tools as signed distances: a convex core, and everything within a radius of it.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Matrix3, Rotation3};

use crate::Vec3;
use crate::contact::FrictionLaw;

/// The part of a rigid tool that meets tissue, in its own frame: the third axis points from the tissue into the tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RigidShape {
    /// A ball around the origin.
    Sphere {
        /// Its radius [m].
        radius: f64,
    },
    /// The flat end of a cylinder around the third axis, with its middle at the origin.
    FlatPunch {
        /// Radius of the cylinder [m].
        radius: f64,
        /// Radius to which its edge is rounded [m]; 0 is a sharp edge.
        edge_radius: f64,
    },
    /// A cone around the third axis that ends at the origin.
    Cone {
        /// Angle between its axis and its side [rad], above 0 and below π/2.
        half_angle: f64,
        /// Radius to which its apex is rounded [m]; 0 is a sharp apex.
        apex_radius: f64,
    },
    /// A cylinder along the first axis with half balls at its ends, around the origin.
    Cylinder {
        /// Its radius [m].
        radius: f64,
        /// Its length with the ends [m].
        length: f64,
    },
    /// A cuboid along the axes, around the origin, such as the jaw of a grasper.
    Bar {
        /// Its three lengths [m].
        lengths: [f64; 3],
        /// Radius to which its edges are rounded [m]; 0 is sharp ones.
        edge_radius: f64,
    },
    /// All that is above the first two axes: a plate that is larger than the body.
    Plate,
}

/// A rigid tool that moves along straight lines and does not turn.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidTool {
    /// Its shape.
    pub shape: RigidShape,
    /// From the axes of its shape to those of the body.
    pub orientation: Rotation3<f64>,
    /// Friction with tissue. Bonded tissue does not slip, but is released under tension.
    pub friction: FrictionLaw,
    /// Positions of the origin of its shape at the beginning, and at the end of each part of its path
    /// [m].
    pub path: Vec<Vec3>,
}

/// Signed distance of a point to a rigid shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in super::super) struct RigidDistance {
    /// Signed distance [m], positive outside.
    pub(in super::super) distance: f64,
    /// Its gradient [-].
    pub(in super::super) normal: Vec3,
    /// Its second derivative [1/m].
    pub(in super::super) curvature: Matrix3<f64>,
}

impl RigidShape {
    /// Whether its numbers are those of a shape.
    pub fn exists(&self) -> bool {
        let rounds = |edge: f64, half: f64| edge >= 0.0 && edge < half;
        match *self {
            Self::Sphere { radius } => radius > 0.0 && radius.is_finite(),
            Self::FlatPunch {
                radius,
                edge_radius,
            } => radius.is_finite() && rounds(edge_radius, radius),
            Self::Cone {
                half_angle,
                apex_radius,
            } => half_angle > 0.0 && half_angle < FRAC_PI_2 && rounds(apex_radius, f64::INFINITY),
            Self::Cylinder { radius, length } => {
                radius > 0.0 && length.is_finite() && length >= 2.0 * radius
            }
            Self::Bar {
                lengths,
                edge_radius,
            } => lengths
                .iter()
                .all(|length| length.is_finite() && rounds(edge_radius, 0.5 * length)),
            Self::Plate => true,
        }
    }

    /// A length of the touching part [m]; none of a plate.
    pub(in super::super) fn size(&self) -> f64 {
        match *self {
            Self::Sphere { radius }
            | Self::FlatPunch { radius, .. }
            | Self::Cylinder { radius, .. } => radius,
            Self::Bar { lengths, .. } => 0.5 * lengths.into_iter().fold(f64::INFINITY, f64::min),
            Self::Cone { .. } | Self::Plate => f64::INFINITY,
        }
    }

    /// Signed distance of a point of its frame.
    pub(in super::super) fn signed_distance(&self, point: &Vec3) -> RigidDistance {
        if let Some(meridian) = self.meridian(point.x.hypot(point.y), point.z) {
            return meridian.turned_about_axis(point);
        }
        match *self {
            Self::Cylinder { radius, length } => {
                let half = 0.5 * length - radius;
                let on_axis = Vec3::new(point.x.clamp(-half, half), 0.0, 0.0);
                let mut found = around(&(point - on_axis));
                if point.x.abs() < half {
                    found.curvature.fill_row(0, 0.0);
                    found.curvature.fill_column(0, 0.0);
                }
                found.rounded(radius)
            }
            Self::Bar {
                lengths,
                edge_radius,
            } => {
                let half = Vec3::from(lengths) / 2.0 - Vec3::repeat(edge_radius);
                let beyond = point.abs() - half;
                let sign = point.map(|x| 1_f64.copysign(x));
                let out = beyond.sup(&Vec3::zeros());
                let distance = out.norm();
                if distance > 0.0 {
                    let normal = out / distance;
                    let turns = Matrix3::from_diagonal(&out.map(|x| f64::from(u8::from(x > 0.0))));
                    let normal = normal.component_mul(&sign);
                    return RigidDistance {
                        distance,
                        normal,
                        curvature: (turns - normal * normal.transpose()) / distance,
                    }
                    .rounded(edge_radius);
                }
                let axis = beyond.imax();
                RigidDistance {
                    distance: beyond[axis],
                    normal: Vec3::ith(axis, sign[axis]),
                    curvature: Matrix3::zeros(),
                }
                .rounded(edge_radius)
            }
            Self::Sphere { .. } | Self::FlatPunch { .. } | Self::Cone { .. } | Self::Plate => {
                unreachable!("a body of revolution")
            }
        }
    }
}

impl RigidTool {
    /// Its position at this place of its path [m]: at its n-th end at n, on a straight line between two of
    /// them.
    pub(in super::super) fn position(&self, along: f64) -> Vec3 {
        let last = self.path.len().saturating_sub(1);
        let part = (along.max(0.0) as usize).min(last);
        let next = (part + 1).min(last);
        let share = (along - part as f64).clamp(0.0, 1.0);
        self.path[part].lerp(&self.path[next], share)
    }

    /// Signed distance of a `point` of the body to it at `position` [m].
    pub(in super::super) fn signed_distance(&self, point: &Vec3, position: &Vec3) -> RigidDistance {
        let found = self.shape.signed_distance(
            &self
                .orientation
                .inverse_transform_vector(&(point - position)),
        );
        let turn = self.orientation.matrix();
        RigidDistance {
            distance: found.distance,
            normal: turn * found.normal,
            curvature: turn * found.curvature * turn.transpose(),
        }
    }
}

impl RigidDistance {
    /// The distance to all within `radius` [m].
    fn rounded(self, radius: f64) -> Self {
        Self {
            distance: self.distance - radius,
            ..self
        }
    }
}

/// The distance to the origin.
fn around(point: &Vec3) -> RigidDistance {
    let distance = point.norm();
    let Some(normal) = point.try_normalize(f64::MIN_POSITIVE) else {
        return RigidDistance {
            distance,
            normal: -Vec3::z(),
            curvature: Matrix3::zeros(),
        };
    };
    RigidDistance {
        distance,
        normal,
        curvature: (Matrix3::identity() - normal * normal.transpose()) / distance,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [RigidShape; 8] = [
        RigidShape::Sphere { radius: 0.4 },
        RigidShape::FlatPunch {
            radius: 0.5,
            edge_radius: 0.2,
        },
        RigidShape::FlatPunch {
            radius: 0.5,
            edge_radius: 0.0,
        },
        RigidShape::Cone {
            half_angle: 0.7,
            apex_radius: 0.1,
        },
        RigidShape::Cylinder {
            radius: 0.3,
            length: 1.1,
        },
        RigidShape::Bar {
            lengths: [1.0, 0.8, 0.6],
            edge_radius: 0.1,
        },
        RigidShape::Bar {
            lengths: [1.0, 0.8, 0.6],
            edge_radius: 0.0,
        },
        RigidShape::Plate,
    ];

    /// Points that fill a cube of 3 evenly (by the additive recurrence of the plastic number).
    fn points() -> impl Iterator<Item = Vec3> {
        let ratio = [
            0.819_172_513_396_164,
            0.671_043_606_703_789,
            0.549_700_477_901_970,
        ];
        (1..4000).map(move |k| Vec3::from(ratio.map(|a| 3.0 * (a * f64::from(k)).fract() - 1.5)))
    }

    /// Judge: central differences; a signed distance has a gradient of length 1.
    #[test]
    fn gradient_and_curvature_are_derivatives_of_the_distance() {
        let step = 1e-5;
        for shape in SHAPES {
            let mut compared = 0;
            for point in points() {
                let at = |by: Vec3| shape.signed_distance(&(point + by));
                let here = at(Vec3::zeros());
                assert!((here.normal.norm() - 1.0).abs() < 1e-12, "{shape:?}");
                // Where two parts of the surface are as near there is no derivative.
                let turns = (0..3).any(|axis| {
                    let by = Vec3::ith(axis, 20.0 * step);
                    (at(by).normal - at(-by).normal).norm() > 0.05
                });
                let bends = (0..3).any(|axis| {
                    let by = Vec3::ith(axis, 2.0 * step);
                    (at(by).curvature - at(-by).curvature).norm() > 0.05
                });
                if turns || bends || here.curvature.norm() > 20.0 {
                    continue;
                }
                compared += 1;
                for axis in 0..3 {
                    let by = Vec3::ith(axis, step);
                    let slope = (at(by).distance - at(-by).distance) / (2.0 * step);
                    assert!(
                        (slope - here.normal[axis]).abs() < 1e-7,
                        "{shape:?} {point:?}"
                    );
                    let bend = (at(by).normal - at(-by).normal) / (2.0 * step);
                    let off = (bend - here.curvature.column(axis)).norm();
                    assert!(off < 1e-6, "{shape:?} {point:?} {off}");
                }
            }
            assert!(compared > 2500, "{shape:?}: {compared}");
        }
    }

    /// Judge: the same point is as far from the shape as the nearest of many points of its surface, which lie where the
    /// distance is zero.
    #[test]
    fn the_nearest_point_of_the_surface_is_as_far_as_the_distance() {
        for shape in SHAPES {
            for point in points() {
                let here = shape.signed_distance(&point);
                if here.distance < 0.0 {
                    continue;
                }
                let foot = shape.signed_distance(&(point - here.distance * here.normal));
                assert!(foot.distance.abs() < 1e-12, "{shape:?} {point:?}");
            }
        }
    }

    #[test]
    fn a_tool_moves_along_straight_lines_through_its_places() {
        let tool = RigidTool {
            shape: RigidShape::Plate,
            orientation: Rotation3::identity(),
            friction: FrictionLaw::Frictionless,
            path: vec![Vec3::zeros(), Vec3::z(), Vec3::z() + Vec3::x()],
        };
        for (along, place) in [
            (-1.0, Vec3::zeros()),
            (0.25, 0.25 * Vec3::z()),
            (1.5, Vec3::new(0.5, 0.0, 1.0)),
            (7.0, Vec3::new(1.0, 0.0, 1.0)),
        ] {
            assert_eq!(tool.position(along), place);
        }
    }
}
