use super::description::PATIENT_AXES;
use super::warp::{MILLIMETRE, bezier};
use super::{AnchorPlane, OrganDescription};
use crate::Vec3;

/// The middle line from the fundus to the pylorus [mm].
const MIDDLE_LINE: [Vec3; 6] = [
    Vec3::new(22.0, 26.0, 56.0),
    Vec3::new(44.0, 20.0, 34.0),
    Vec3::new(54.0, 2.0, -20.0),
    Vec3::new(20.0, -26.0, -68.0),
    Vec3::new(-22.0, -22.0, -46.0),
    Vec3::new(-56.0, -2.0, -14.0),
];
/// Radius along it [mm], before it is rounded off at both ends.
const GIRTH: [f64; 6] = [43.5, 38.0, 17.0, 9.0, 20.0, 31.0];
/// Where the esophagus enters [mm].
const CARDIA: Vec3 = Vec3::new(15.0, 22.0, 33.0);

pub(super) fn description() -> OrganDescription {
    OrganDescription {
        summary: "The stomach, moderately filled and closed at both ends: fundus, body and antrum \
                  in the shape of a J, with the stump of the esophagus at the cardia.",
        axes: PATIENT_AXES,
        origin: "between the body and the antrum, in the hollow of the J",
        lengths: "about 270 mm along the greater curve, 170 mm along the lesser; fundus and \
                  body 58 mm wide, antrum 37 mm; the cardia is near (2, 23, 43) mm, the pylorus \
                  near (-56, -2, -14) mm",
        fixed: "the top, where fundus and esophagus hang from the diaphragm: z > 40 mm; and the \
               pylorus: x < -45 mm",
        extent: Vec3::new(0.1254, 0.0749, 0.1222),
        volume: 0.254e-3,
    }
}

pub(super) fn anchor() -> Vec<AnchorPlane> {
    vec![
        AnchorPlane {
            point: Vec3::new(0.0, 0.0, 0.04),
            normal: -Vec3::z(),
        },
        AnchorPlane {
            point: Vec3::new(-0.045, 0.0, 0.0),
            normal: Vec3::x(),
        },
    ]
}

/// The point of the surface [m] for a point of the unit sphere [-]: circles around the middle
/// line, drawn out at the cardia.
pub(super) fn shape(unit: &Vec3) -> Vec3 {
    let t = 0.5 * (1.0 - unit.z);
    let steps: [Vec3; 5] = std::array::from_fn(|i| MIDDLE_LINE[i + 1] - MIDDLE_LINE[i]);
    let along = bezier(&steps, t).normalize();
    let across = Vec3::new(0.3, 1.0, 0.25).cross(&along).normalize();
    let forward = along.cross(&across);
    // Somewhat flattened from front to back.
    let around = 0.92 * unit.y * forward - 1.08 * unit.x * across;
    let sac = bezier(&MIDDLE_LINE, t) + bezier(&GIRTH, t) * around;
    let from_cardia = (sac - CARDIA).norm() / 14.0;
    let stump = 16.0 * (-from_cardia.powi(4)).exp();
    MILLIMETRE * (sac + stump * Vec3::new(-0.8, 0.05, 0.6))
}
