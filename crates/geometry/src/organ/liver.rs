use super::description::PATIENT_AXES;
use super::warp::{MILLIMETRE, bell, ramp, step};
use super::{AnchorPlane, OrganDescription};
use crate::Vec3;

pub(super) fn description() -> OrganDescription {
    OrganDescription {
        summary: "The liver: a wedge with a bulky right lobe, domed above and in front, hollow \
                  below and behind, and a thin left lobe.",
        axes: PATIENT_AXES,
        origin: "inside the right lobe, near the middle of the organ",
        lengths: "190 mm from right to left, 150 mm from front to back, 162 mm high; the lower \
                  margin is rounded and notched by the round ligament near x = 38 mm",
        fixed: "the top and back, where ligaments hang it from the diaphragm: what lies more than \
               60 mm from the origin along (0, 0.6, 0.8)",
        extent: Vec3::new(0.1907, 0.1493, 0.1622),
        volume: 1.583e-3,
    }
}

pub(super) fn anchor() -> Vec<AnchorPlane> {
    let hung = Vec3::new(0.0, 0.6, 0.8);
    vec![AnchorPlane {
        point: 0.06 * hung,
        normal: -hung,
    }]
}

/// The point of the surface [m] for a point of the unit sphere [-]: a ball pushed in from below,
/// behind and the left, and tapered to the left.
pub(super) fn shape(unit: &Vec3) -> Vec3 {
    let hollow_side = Vec3::new(0.55, 0.45, -0.70).normalize();
    // The back of the right lobe stays thick.
    let right_back = unit.dot(&Vec3::new(-0.75, 0.65, 0.1).normalize());
    let push = 1.3 - 0.45 * step((right_back - 0.3) / 0.35);
    // A soft start of the push is what rounds the margin.
    let softness = 0.24;
    let depth = softness * ramp((unit.dot(&hollow_side) - 0.26) / softness);
    let dome = unit - push * depth * hollow_side;
    // The left lobe is thinner, lies further forward and keeps its top high.
    let left = step((dome.x - 0.2) / 0.5);
    let x = 104.0 * dome.x;
    let mut y = 82.0 * ((1.0 - 0.36 * left) * dome.y - 0.30 * left);
    let mut z = 98.0 * ((1.0 - 0.5 * left) * dome.z + 0.33 * left);
    // Room for the spine and the great vessels.
    y -= 20.0 * bell((x - 22.0) / 32.0) * step((dome.y - 0.15) / 0.3);
    // The notch of the round ligament, in the lower margin.
    let lower_front = step((-unit.z - 0.05) / 0.15) * step((-unit.y - 0.1) / 0.3);
    z += 7.0 * bell((x - 30.0) / 9.0) * lower_front;
    MILLIMETRE * Vec3::new(x + 8.0, y, z)
}
