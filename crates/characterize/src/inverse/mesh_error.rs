use super::tables;

/// By what forces of the coarsest mesh are to be multiplied at each depth [-], and what is left wrong then.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MeshError {
    pub(super) correction: Vec<f64>,
    pub(super) left: f64,
}

/// Power of the size of the elements with which errors fall, as in the reference.
const ORDER: f64 = 1.2;
/// The least that is left [-]: as of tabulated forces.
const MIN_REMAINING: f64 = tables::discretisation();

impl MeshError {
    /// From forces on two meshes, the second with every element halved.
    pub(super) fn of_two(coarse: &[(f64, Vec<f64>)], fine: &[(f64, Vec<f64>)]) -> Self {
        let limit = |coarse: f64, fine: f64| fine + (fine - coarse) / (2_f64.powf(ORDER) - 1.0);
        let each = coarse
            .iter()
            .zip(fine)
            .map(|((c, _), (f, _))| (*c, limit(*c, *f)));
        let forces: Vec<(f64, f64)> = each.collect();
        let correction = forces.iter().map(|(coarse, limit)| limit / coarse);
        let correction: Vec<f64> = correction.collect();
        // Shallow contacts of round indenters are smaller than elements, and their forces count as little in a fit.
        let most = forces
            .iter()
            .map(|(_, limit)| limit.abs())
            .fold(0.0, f64::max);
        let off = forces.iter().map(|(coarse, limit)| (limit - coarse).abs());
        let largest = off.fold(0.0, f64::max) / most;
        // The order is not seen from two meshes, so half of what is corrected stays in warning.
        let left = (0.5 * largest).max(MIN_REMAINING);
        Self { correction, left }
    }
}
