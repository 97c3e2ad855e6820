//! The direction of a shaft. A quaternion takes the tool's frame to the scene; the shaft runs along the tool's +z, away
//! from the tissue.

use nalgebra::{Quaternion, Unit, UnitQuaternion};
use palpate_geometry::Vec3;

/// Distance of two unit directions that are equal up to rounding [-].
const ROUNDING: f64 = 1e-12;

/// The orientation of a tool at `tip` [m] by the contract: with a trocar the shaft runs to it and a quaternion gives
/// the roll; else the quaternion; else the surface's outward normal, if there is contact; else upright.
pub(crate) fn orientation(
    tip: &Vec3,
    trocar: Option<&Vec3>,
    given: Option<[f64; 4]>,
    normal: Option<&Vec3>,
) -> UnitQuaternion<f64> {
    let given = given.map(|[x, y, z, w]| unit(Quaternion::new(w, x, y, z)));
    match (trocar.and_then(|t| (t - tip).try_normalize(1e-9)), given) {
        // A recorded orientation replays to the last bit.
        (Some(shaft), Some(given)) if (given * Vec3::z() - shaft).norm() < ROUNDING => given,
        (Some(shaft), roll) => {
            let roll = roll.map_or(UnitQuaternion::identity(), |q| twist_about_z(&q));
            from_z_to(&shaft) * roll
        }
        (None, Some(given)) => given,
        (None, None) => normal.map_or(UnitQuaternion::identity(), from_z_to),
    }
}

/// A quaternion that is a unit up to rounding stays unchanged.
fn unit(quaternion: Quaternion<f64>) -> UnitQuaternion<f64> {
    match (quaternion.norm_squared() - 1.0).abs() < ROUNDING {
        true => Unit::new_unchecked(quaternion),
        false => Unit::new_normalize(quaternion),
    }
}

/// The smallest rotation from +z to `direction`; half a turn about x when that is −z.
fn from_z_to(direction: &Vec3) -> UnitQuaternion<f64> {
    UnitQuaternion::rotation_between(&Vec3::z(), direction)
        .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vec3::x_axis(), std::f64::consts::PI))
}

/// The part of a rotation that turns about z.
fn twist_about_z(rotation: &UnitQuaternion<f64>) -> UnitQuaternion<f64> {
    let twist = Quaternion::new(rotation.w, 0.0, 0.0, rotation.k);
    Unit::try_new(twist, 1e-12).unwrap_or_else(UnitQuaternion::identity)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trocar_decides_and_a_quaternion_rolls() {
        let tip = Vec3::zeros();
        let trocar = Vec3::new(0.1, 0.0, 0.0);
        let quarter = std::f64::consts::FRAC_1_SQRT_2;
        let rolled = orientation(
            &tip,
            Some(&trocar),
            Some([0.0, 0.0, quarter, quarter]),
            None,
        );
        // Rounding.
        assert!((rolled * Vec3::z() - Vec3::x()).norm() < 1e-12);
        let again = orientation(&tip, Some(&trocar), Some(rolled.coords.into()), None);
        assert_eq!(again, rolled);
        let unrolled = orientation(&tip, Some(&trocar), None, None);
        let about_shaft = rolled * unrolled.inverse();
        let turned = about_shaft.angle();
        assert!((turned - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        let down = orientation(&tip, None, None, Some(&-Vec3::z()));
        assert!((down * Vec3::z() + Vec3::z()).norm() < 1e-12);
    }
}
