use super::description::PATIENT_AXES;
use super::{AnchorPlane, OrganDescription};
use crate::Vec3;

pub(super) fn description() -> OrganDescription {
    OrganDescription {
        summary: "The spleen.",
        axes: PATIENT_AXES,
        origin: "the middle",
        lengths: "see extent",
        held: "the back",
        extent: 2.0 * Vec3::new(0.037, 0.022, 0.055),
        volume: 1e-4,
    }
}

pub(super) fn anchor() -> Vec<AnchorPlane> {
    vec![AnchorPlane {
        point: Vec3::new(0.0, 0.01, 0.0),
        normal: -Vec3::y(),
    }]
}

/// The point of the surface [m] for a point of the unit sphere [-].
pub(super) fn shape(unit: &Vec3) -> Vec3 {
    Vec3::new(0.037, 0.022, 0.055).component_mul(unit)
}
