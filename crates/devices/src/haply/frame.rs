//! The axes of a Haply device: x right, y away from the user, z up, zero on its mounting plate. Ours: x right, y up,
//! z toward the user, zero in the middle of its workspace.

use nalgebra::{Quaternion, UnitQuaternion};
use palpate_servo::Vec3;

/// The middle of the workspace in the device's axes [m], as the samples of its documents have it.
pub(crate) const MIDDLE: Vec3 = Vec3::new(0.0, -0.11, 0.175);

/// A vector of the device in our axes.
pub(crate) fn from_device_axes(vector: &Vec3) -> Vec3 {
    Vec3::new(vector.x, vector.z, -vector.y)
}

/// A vector of ours in the axes of the device.
pub(crate) fn to_device_axes(vector: &Vec3) -> Vec3 {
    Vec3::new(vector.x, -vector.z, vector.y)
}

/// A position of the device [m] in our axes, from our zero.
pub(crate) fn position_from_device(place: &Vec3) -> Vec3 {
    from_device_axes(&(place - MIDDLE))
}

/// The same rotation in our axes; none if it is not a rotation.
pub(crate) fn rotation_from_device([w, x, y, z]: [f64; 4]) -> Option<UnitQuaternion<f64>> {
    let axis = from_device_axes(&Vec3::new(x, y, z));
    let turn = Quaternion::from_parts(w, axis);
    let length = turn.norm();
    let is_turn = length.is_finite() && length > 1e-3;
    is_turn.then(|| UnitQuaternion::from_quaternion(turn))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_goes_there_and_back_and_up_is_up() {
        let place = Vec3::new(0.1, 0.2, -0.3);
        assert!((position_from_device(&(to_device_axes(&place) + MIDDLE)) - place).norm() < 1e-15);
        assert_eq!(from_device_axes(&Vec3::z()), Vec3::y());
        assert_eq!(from_device_axes(&-Vec3::y()), Vec3::z());
        // Right-handed both: x × y = z.
        let [x, y, z] = [Vec3::x(), Vec3::y(), Vec3::z()].map(|axis| from_device_axes(&axis));
        assert_eq!(x.cross(&y), z);
    }

    #[test]
    fn a_turn_turns_what_it_turned() {
        let turn = UnitQuaternion::from_axis_angle(&Vec3::z_axis(), 0.7);
        let mine = rotation_from_device([turn.w, turn.i, turn.j, turn.k]).unwrap();
        let arrow = Vec3::new(0.3, -0.2, 0.5);
        assert!(
            (mine * from_device_axes(&arrow) - from_device_axes(&(turn * arrow))).norm() < 1e-15
        );
        assert_eq!(rotation_from_device([0.0; 4]), None);
        assert_eq!(rotation_from_device([f64::MAX; 4]), None);
    }
}
