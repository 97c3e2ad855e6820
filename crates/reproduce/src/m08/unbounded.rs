use nalgebra::{DMatrix, DVector};

/// The source's own iteration (6.16): Δp = −(JᵀJ + λ 1)⁻¹ Jᵀ r with one λ for all parameters and
/// steps, J from one perturbed run for each parameter, every step taken, no bounds. λ is in proportion to
/// the mean of the diagonal of JᵀJ, as the source does not say its size.
///
/// It ends when no parameter changes by more than the part `tolerance` of itself, when a run fails, or after
/// `iterations` steps. Its way begins with the start.
pub(super) fn unbounded_iteration(
    start: &[f64],
    samples: usize,
    damping: f64,
    tolerance: f64,
    iterations: usize,
    mut residuals: impl FnMut(&[f64], &mut [f64]) -> Option<()>,
) -> Vec<Vec<f64>> {
    const PERTURBATION: f64 = 1e-4;
    let mut way = vec![start.to_vec()];
    let mut run = |values: &[f64]| {
        let mut found = DVector::zeros(samples);
        residuals(values, found.as_mut_slice())?;
        found.iter().all(|r: &f64| r.is_finite()).then_some(found)
    };
    let mut step = |values: &[f64]| -> Option<DVector<f64>> {
        let here = run(values)?;
        let mut jacobian = DMatrix::zeros(samples, values.len());
        for i in 0..values.len() {
            let mut shifted = values.to_vec();
            shifted[i] *= 1.0 + PERTURBATION;
            let column = (run(&shifted)? - &here) / (shifted[i] - values[i]);
            jacobian.set_column(i, &column);
        }
        let mut normal = jacobian.tr_mul(&jacobian);
        let added = damping * normal.trace() / values.len() as f64;
        for i in 0..values.len() {
            normal[(i, i)] += added;
        }
        normal.lu().solve(&-jacobian.tr_mul(&here))
    };
    for _ in 0..iterations {
        let values = &way[way.len() - 1];
        let Some(change) = step(values) else {
            break;
        };
        let next: Vec<f64> = values.iter().zip(&change).map(|(p, d)| p + d).collect();
        let small = next
            .iter()
            .zip(&change)
            .all(|(p, d)| d.abs() <= tolerance * p.abs());
        way.push(next);
        if small {
            break;
        }
    }
    way
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The source's iteration finds the exact answer from near by, and ends when a run fails.
    #[test]
    fn the_unbounded_iteration_converges_from_near() {
        let decay = |p: &[f64], residuals: &mut [f64]| {
            for (i, residual) in residuals.iter_mut().enumerate() {
                let x = 0.5 * i as f64;
                *residual = p[0] * (-x / p[1]).exp() - 2.0 * (-x / 3.0).exp();
            }
            Some(())
        };
        let near = unbounded_iteration(&[2.5, 2.5], 20, 1e-3, 1e-6, 100, decay);
        assert!(near.len() < 100);
        let last = &near[near.len() - 1];
        assert!(
            (last[0] - 2.0).abs() < 1e-5 && (last[1] - 3.0).abs() < 1e-5,
            "{last:?}"
        );
        let failed = unbounded_iteration(&[2.5, 2.5], 20, 1e-3, 1e-6, 100, |_, _| None);
        assert_eq!(failed.len(), 1);
    }
}
