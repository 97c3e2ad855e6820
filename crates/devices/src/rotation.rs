use nalgebra::{Matrix3, Rotation3, UnitQuaternion};
use palpate_servo::Vec3;

/// The rotation closest to three `columns` that are nearly unit and perpendicular, as libraries give them; none if they
/// are far from a rotation.
pub(crate) fn rotation(columns: [Vec3; 3]) -> Option<UnitQuaternion<f64>> {
    let z = columns[2].try_normalize(0.5)?;
    let x = (columns[0] - z * z.dot(&columns[0])).try_normalize(0.5)?;
    let y = z.cross(&x);
    let is_near = y.dot(&columns[1]) > 0.5;
    let matrix = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, z]));
    is_near.then(|| UnitQuaternion::from_rotation_matrix(&matrix))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_that_is_a_little_off_is_put_right() {
        let turn = UnitQuaternion::from_euler_angles(0.4, 1.1, -0.3);
        let columns = [Vec3::x(), Vec3::y(), Vec3::z()].map(|axis| turn * axis);
        let off = columns.map(|column| column * 1.001 + Vec3::new(1e-4, -2e-4, 1e-4));
        // As far off as the columns were.
        assert!(rotation(off).unwrap().angle_to(&turn) < 1e-3);
        assert_eq!(rotation([columns[1], columns[0], columns[2]]), None);
        assert_eq!(rotation([Vec3::zeros(); 3]), None);
        assert_eq!(rotation([Vec3::repeat(f64::NAN); 3]), None);
    }
}
