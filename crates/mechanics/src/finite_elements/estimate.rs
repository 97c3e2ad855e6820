//! How far an answer is from the true one, by the same problem on halved elements.
//!
//! If errors fall as hᵖ, the error on the fine mesh is the change from the coarse one over 2ᵖ − 1. The
//! order p is the caller's knowledge: 1 where an edge makes stress infinite, more where all is smooth.
//!
//! *How we know*: `estimates::…` compare with closed forms and finer meshes.
//!
//! *Limits*: knows nothing of what all the meshes share.

use crate::Error;

/// An answer and its doubt.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimated<T> {
    /// The answer on the finest mesh.
    pub answer: T,
    /// Relative error of its values [-], the largest over them.
    pub error: f64,
}

/// What is being solved, for those who wait.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Part of the present stage that is done [-].
    pub part: f64,
    /// The mesh being solved: how often its elements were halved.
    pub halvings: u32,
}

/// Solves on ever finer meshes until the error is at most `accuracy` [-] or elements were halved `most`
/// times. `solve` answers for a number of halvings with the answer and the values [any unit] that
/// `accuracy` is asked of; errors are taken to fall with the power `order` of the element size.
///
/// # Errors
/// Those of `solve`.
pub fn refine<T>(
    accuracy: f64,
    order: f64,
    most: u32,
    mut solve: impl FnMut(u32) -> Result<(T, Vec<f64>), Error>,
) -> Result<Estimated<T>, Error> {
    let parts: Vec<usize> = (0..=most.max(1)).map(|halvings| 1 << halvings).collect();
    refine_through(&parts, accuracy, order, |parts| solve(parts.ilog2()))
}

/// As [`refine`], on meshes whose elements are `parts` times smaller along each edge than those of one
/// mesh: two or more ascending numbers.
///
/// # Errors
/// Those of `solve`.
pub fn refine_through<T>(
    parts: &[usize],
    accuracy: f64,
    order: f64,
    mut solve: impl FnMut(usize) -> Result<(T, Vec<f64>), Error>,
) -> Result<Estimated<T>, Error> {
    let (mut answer, mut coarse) = solve(parts[0])?;
    let mut error = f64::INFINITY;
    for pair in parts.windows(2) {
        let (next, fine) = solve(pair[1])?;
        let ratio = pair[1] as f64 / pair[0] as f64;
        error = largest_change(&coarse, &fine) / (ratio.powf(order) - 1.0);
        (answer, coarse) = (next, fine);
        if error <= accuracy {
            break;
        }
    }
    Ok(Estimated { answer, error })
}

/// Largest relative change of the values [-].
fn largest_change(coarse: &[f64], fine: &[f64]) -> f64 {
    let change = |(c, f): (&f64, &f64)| if c == f { 0.0 } else { ((f - c) / f).abs() };
    coarse.iter().zip(fine).map(change).fold(0.0, f64::max)
}
