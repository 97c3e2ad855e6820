//! The limit of a force's rate of rise.

use crate::Vec3;

/// The force [N] nearest to `wanted` that rises by at most `rise` [N] over the last one: it is within
/// `rise` of some force along `last` that is not larger than it. So it falls at once, and a force that
/// turns about falls to zero and rises from there.
pub fn limit_rise(last: &Vec3, commanded: &Vec3, rise: f64) -> Vec3 {
    let fallen = reduced_towards(last, commanded);
    let risen = commanded - fallen;
    let size = risen.norm();
    if size <= rise {
        return *commanded;
    }
    fallen + risen * (rise / size)
}

/// The force between zero and `last` that is nearest to `wanted`.
pub fn reduced_towards(last: &Vec3, commanded: &Vec3) -> Vec3 {
    let square = last.norm_squared();
    if square == 0.0 {
        return Vec3::zeros();
    }
    last * (commanded.dot(last) / square).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_rises_slowly_falls_at_once_and_turns_by_way_of_zero() {
        let (one, none) = (Vec3::x(), Vec3::zeros());
        assert_eq!(limit_rise(&none, &one, 0.4), one * 0.4);
        assert_eq!(limit_rise(&one, &(one * 0.2), 0.4), one * 0.2);
        assert_eq!(limit_rise(&one, &none, 0.4), none);
        assert_eq!(limit_rise(&one, &-one, 0.4), -one * 0.4);
        // The component along the last force stays: 1 N to the right, and 0.4 N of the 2 N upward.
        let up = limit_rise(&one, &(one + Vec3::y() * 2.0), 0.4);
        assert!((up - Vec3::new(1.0, 0.4, 0.0)).norm() < 1e-15);
    }
}
