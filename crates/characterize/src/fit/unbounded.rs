use nalgebra::{DMatrix, DVector};

/// The way of the source's iteration.
#[derive(Debug, Clone, PartialEq)]
pub struct UnboundedWay {
    /// The parameters' values, beginning with the start.
    pub values: Vec<Vec<f64>>,
    /// Whether the last step changed no parameter by more than was asked for.
    pub converged: bool,
}

/// The source's own iteration (6.16), for comparison: Δp = −(JᵀJ + λ 1)⁻¹ Jᵀ r with one λ for all parameters and
/// steps, J from one perturbed run for each parameter, every step taken, no bounds. λ is in proportion to
/// the mean of the diagonal of JᵀJ, as the source does not say its size.
///
/// It ends when no parameter changes by more than the part `tolerance` of itself, when a run fails, or after
/// `iterations` steps.
pub fn unbounded_iteration(
    start: &[f64],
    samples: usize,
    (damping, tolerance, iterations): (f64, f64, usize),
    mut residuals: impl FnMut(&[f64], &mut [f64]) -> Option<()>,
) -> UnboundedWay {
    const PERTURBATION: f64 = 1e-4;
    let mut way = UnboundedWay {
        values: vec![start.to_vec()],
        converged: false,
    };
    let mut run = |values: &[f64]| {
        let mut found = DVector::zeros(samples);
        residuals(values, found.as_mut_slice())?;
        found.iter().all(|r: &f64| r.is_finite()).then_some(found)
    };
    let mut step = |values: &[f64]| -> Option<DVector<f64>> {
        let here = run(values)?;
        let mut jacobian = DMatrix::zeros(samples, values.len());
        for i in 0..values.len() {
            let mut beside = values.to_vec();
            beside[i] *= 1.0 + PERTURBATION;
            let column = (run(&beside)? - &here) / (beside[i] - values[i]);
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
        let values = &way.values[way.values.len() - 1];
        let Some(change) = step(values) else {
            break;
        };
        let next: Vec<f64> = values.iter().zip(&change).map(|(p, d)| p + d).collect();
        let small = next
            .iter()
            .zip(&change)
            .all(|(p, d)| d.abs() <= tolerance * p.abs());
        way.values.push(next);
        if small {
            way.converged = true;
            break;
        }
    }
    way
}
