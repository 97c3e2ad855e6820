use super::description::PATIENT_AXES;
use super::warp::{MILLIMETRE, bell, step};
use super::{AnchorPlane, OrganDescription};
use crate::Vec3;

pub(super) fn description() -> OrganDescription {
    OrganDescription {
        summary: "The spleen: flattened, domed towards the diaphragm, hollow towards the stomach \
                  and kidney, with two notches in its upper border.",
        axes: PATIENT_AXES,
        origin: "inside, near the middle",
        lengths: "114 mm along the tenth rib, from the back and top to the front and bottom; \
                  78 mm wide, 40 mm thick; the dome faces left, back and up",
        fixed: "the rim of the hollow side, where the ligaments to stomach and kidney are: what \
               lies more than 8 mm from the origin towards the hollow side",
        extent: Vec3::new(0.0699, 0.0977, 0.0882),
        volume: 201.1e-6,
    }
}

pub(super) fn anchor() -> Vec<AnchorPlane> {
    let [_, _, dome] = directions();
    vec![AnchorPlane {
        point: -0.008 * dome,
        normal: dome,
    }]
}

/// Along the rib to the front, across it downward, and out through the dome.
fn directions() -> [Vec3; 3] {
    let forward = Vec3::new(0.45, -0.72, -0.52).normalize();
    let outward = Vec3::new(0.8, 0.45, 0.4);
    let dome = (outward - forward * outward.dot(&forward)).normalize();
    [forward, dome.cross(&forward), dome]
}

/// The point of the surface [m] for a point of the unit sphere [-]: a flat ellipsoid bent around
/// the stomach.
pub(super) fn shape(unit: &Vec3) -> Vec3 {
    let (front, down, dome) = (unit.x, unit.y, unit.z);
    let along = 57.0 * front;
    let mut across = (37.0 + 5.0 * front) * down * (1.0 + 0.12 * front * front);
    let mut out = 23.0 * dome * (1.1 - 0.1 * dome * dome);
    let hollow_side = step(-dome / 0.35);
    out += 8.0 * bell((along + 2.0) / 34.0) * bell((across + 2.0) / 16.0) * hollow_side;
    across += 5.0 * bell((front - 0.42) / 0.12) * step((-down - 0.68) / 0.18);
    across += 3.0 * bell((front - 0.02) / 0.10) * step((-down - 0.78) / 0.16);
    out += 7.0 - 13.0 * (along / 57.0).powi(2) - 9.0 * (across / 38.0).powi(2);
    let [forward, downward, outward] = directions();
    MILLIMETRE * (along * forward + across * downward + out * outward)
}
