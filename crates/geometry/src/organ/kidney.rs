use super::description::PATIENT_AXES;
use super::warp::{MILLIMETRE, bell, step, turned};
use super::{AnchorPlane, OrganDescription};
use crate::Vec3;

pub(super) fn description() -> OrganDescription {
    OrganDescription {
        summary: "The left kidney: a bean with the hilum on its inner side.",
        axes: PATIENT_AXES,
        origin: "inside, near the middle",
        lengths: "108 mm from pole to pole, 60 mm wide, 45 mm thick; the upper pole leans 12 \
                  degrees to the middle and 10 degrees to the back; the hilum faces -x",
        fixed: "the back, where it rests on the muscles: y > 10 mm",
        extent: Vec3::new(0.0651, 0.0485, 0.1053),
        volume: 149.0e-6,
    }
}

pub(super) fn anchor() -> Vec<AnchorPlane> {
    vec![AnchorPlane {
        point: Vec3::new(0.0, 0.01, 0.0),
        normal: -Vec3::y(),
    }]
}

/// The point of the surface [m] for a point of the unit sphere [-]: an ellipsoid with blunt poles
/// that lean to the middle, dented at the hilum.
pub(super) fn shape(unit: &Vec3) -> Vec3 {
    let (side, back, up) = (unit.x, unit.y, unit.z);
    let upper_is_larger = 1.0 + 0.07 * up;
    let lean = 9.0 * up * up;
    let x = 29.0 * side * (1.0 + 0.2 * up * up) * upper_is_larger - lean;
    let y = 22.5 * back * (1.0 + 0.08 * up * up) * upper_is_larger;
    let z = 54.0 * up;
    // Narrower than the kidney is thick, so that the hilum has lips.
    let on_inner_side = step((-side - 0.35) / 0.35);
    let dent = 12.0 * bell((z + 1.0) / 16.0) * bell((y + 2.0) / 13.0) * on_inner_side;
    let upright = Vec3::new(x + dent, y, z);
    let leaning = turned(upright, 0, 2, 12f64.to_radians());
    let tilted = turned(leaning, 1, 2, -10f64.to_radians());
    MILLIMETRE * (tilted + Vec3::new(4.0, 0.0, 0.0))
}
