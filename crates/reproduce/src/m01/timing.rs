//! How long the two halves of a step of the local model take.

use std::time::Instant;

use palpate_mechanics::finite_spheres::{FiniteSphereModel, LocalContact};

use crate::machine::median;

/// Steps that are thrown away, until the processor runs at its speed.
const WARM_UP: usize = 50;

/// Steps that are measured; an odd number has a middle.
const STEPS: usize = 501;

/// Time that a model may take altogether [s]; a slow one is measured over fewer steps.
const LONGEST: f64 = 1.0;

/// Medians over many steps.
#[derive(Debug, Clone, Copy)]
pub(super) struct Timing {
    /// Of solving [s].
    pub(super) solution: f64,
    /// Of placing particles, making equations and solving [s].
    pub(super) total: f64,
    /// Iterations of the last solution; none when it was direct.
    pub(super) iterations: Option<usize>,
    /// How many were measured.
    pub(super) steps: usize,
}

/// Measures `model` at `contact`.
pub(super) fn measure(model: &FiniteSphereModel, contact: &LocalContact) -> Timing {
    let mut workspace = model.workspace();
    let mut solutions = Vec::with_capacity(STEPS);
    let mut totals = Vec::with_capacity(STEPS);
    let begin = Instant::now();
    for step in 0..WARM_UP + STEPS {
        let start = Instant::now();
        model.assemble(contact, &mut workspace);
        let assembled = Instant::now();
        std::hint::black_box(model.solve(contact, &mut workspace));
        let end = Instant::now();
        if step >= WARM_UP || begin.elapsed().as_secs_f64() > 0.1 * LONGEST {
            solutions.push((end - assembled).as_secs_f64());
            totals.push((end - start).as_secs_f64());
        }
        if begin.elapsed().as_secs_f64() > LONGEST && !totals.is_empty() {
            break;
        }
    }
    Timing {
        solution: median(&mut solutions),
        total: median(&mut totals),
        iterations: Some(workspace.iterations()).filter(|&iterations| iterations > 0),
        steps: totals.len(),
    }
}
