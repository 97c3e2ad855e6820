/// Thinner than this part of the size, the inside of a closed surface is no solid [-].
const RELATIVE: f64 = 0.004;

/// Thinner than this, it is a capsule rather than the wall of a hollow organ [m].
const LARGEST_WALL_M: f64 = 0.0015;

/// Whether a closed surface of this volume [m³] and area [m²] is a sheet with two sides, close
/// together, rather than a solid: its mean thickness 2 V / A is both a small part of its size and
/// below the wall of any hollow organ.
pub(super) fn is_double_wall(volume_m3: f64, area_m2: f64) -> bool {
    let thickness_m = 2.0 * volume_m3.abs() / area_m2;
    thickness_m < RELATIVE * area_m2.sqrt() && thickness_m < LARGEST_WALL_M
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tells_a_capsule_from_a_hollow_organ_and_a_plate() {
        // A liver capsule, an oesophagus with a wall of 3 mm, a plate of 10 x 10 cm by 1 mm.
        assert!(is_double_wall(74e-6, 0.195));
        assert!(!is_double_wall(26.2e-6, 0.0183));
        assert!(!is_double_wall(1e-5, 0.0204));
    }
}
