//! The discretization error of an answer, from the same problem on several meshes.
//!
//! Where errors fall as hᵖ, three meshes with elements of sizes h₁ < h₂ < h₃ show the order p. With the
//! changes δ₂₁ = f₁ − f₂ and δ₃₂ = f₂ − f₃,
//!   ‖δ₃₂‖/‖δ₂₁‖ = (h₃ᵖ − h₂ᵖ)/(h₂ᵖ − h₁ᵖ),
//! and the grid convergence index is the error of f₁ [Roache 1994],
//!   E = s |δ₂₁|/((h₂/h₁)ᵖ − 1).
//! The safety factor s is 1.25 where the order is observed and 3 where it is assumed [Roache 1997]. An
//! observed order above the expected one p₀ is not used: with a part of the error that falls faster, the
//! slower part is still to come. The order counts as observed where the changes have one sign and p is in
//! [p₀/2, p₁], p₁ being the smaller of 2 p₀ and that of (h₂/h₁)^p₁ − 1 = 3 ((h₂/h₁)^p₀ − 1): at p₁ the index
//! is 3.75 times the error or less, and at p₀/2 it is about that of two meshes. Elsewhere the error is
//! an upper figure, with a warning.
//!
//! *How we know*: `tests` (sequences with known limits), `orders::…` (closed forms, much finer meshes).
//!
//! *Limits*: does not see errors that all meshes share.

use std::fmt::Write as _;

use crate::Error;

/// An answer and its error.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimated<T> {
    /// The answer on the finest mesh.
    pub answer: T,
    /// Relative error of its values [-], the largest over them.
    pub error: f64,
    /// The order of convergence that the last three meshes show, of the value with the largest error [-];
    /// `None` where no order was observed.
    pub observed_order: Option<f64>,
    /// Why the error is an upper figure, where it is, in sentences.
    pub warnings: Vec<String>,
}

/// Progress of a solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Part of the present stage that is done [-].
    pub part: f64,
    /// The mesh being solved, from the coarsest, which is 0.
    pub mesh: usize,
}

/// A part of an answer whose error is estimated.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// Its name in messages.
    pub name: &'static str,
    /// Its values [any unit], as many on every mesh.
    pub values: Vec<f64>,
}

impl Quantity {
    /// Values [any unit], each with a relative error of its own.
    pub fn new(name: &'static str, values: Vec<f64>) -> Self {
        Self { name, values }
    }
}

/// The meshes of a problem.
#[derive(Debug, Clone, Copy)]
pub struct Meshes<'a> {
    /// Sizes of their elements, in any one unit, descending.
    pub sizes: &'a [f64],
    /// The power of the size with which errors fall in the end [-], by the theory of the problem.
    pub order: f64,
}

/// Safety factors [-] [Roache 1997].
const OBSERVED: f64 = 1.25;
const ASSUMED: f64 = 3.0;

/// Changes below this are the solver's tolerance, not the mesh's, and show no order [-].
const SOLVED_TO: f64 = 1e-6;

/// From this accuracy on, two meshes suffice where their error, with its safety factor, is within it [-].
const COARSE: f64 = 0.05;

/// Highest order that is distinguished [-].
const HIGHEST_ORDER: f64 = 16.0;

/// Solves on ever finer `meshes` until the error is at most `accuracy` [-]: on three of them at least, or
/// on two where little is asked for. `solve` gets the number of a mesh and returns the answer and its
/// quantities, or `None` where that mesh is beyond the machine. The first mesh may be too coarse for an
/// equilibrium; it is then left out. Where a mesh fails after two that did not, the answer is theirs,
/// with a warning.
///
/// # Errors
/// Those of `solve`, on the first two meshes.
pub fn refine<T>(
    meshes: &Meshes<'_>,
    accuracy: f64,
    mut solve: impl FnMut(usize) -> Result<Option<(T, Vec<Quantity>)>, Error>,
) -> Result<Estimated<T>, Error> {
    let mut found: Option<Estimated<T>> = None;
    let mut refused = None;
    let mut solved: Vec<Solved> = Vec::new();
    for (mesh, &size) in meshes.sizes.iter().enumerate() {
        let (answer, quantities) = match solve(mesh) {
            Ok(Some(solved)) => solved,
            Ok(None) => break,
            Err(_) if mesh == 0 && meshes.sizes.len() > 2 => continue,
            Err(error) if solved.len() < 2 => return Err(error),
            Err(error) => {
                refused = Some(error);
                break;
            }
        };
        solved.push(Solved { size, quantities });
        let estimate = estimate(&solved, meshes.order);
        let two_suffice = accuracy >= COARSE && solved.len() == 2;
        let done = estimate.error <= accuracy && (two_suffice || solved.len() > 2);
        found = Some(Estimated {
            answer,
            error: estimate.error,
            observed_order: estimate.observed_order,
            warnings: estimate.warnings,
        });
        if done {
            break;
        }
    }
    let mut found = found.ok_or(Error::NoElements)?;
    if let Some(error) = refused {
        found
            .warnings
            .push(format!("a finer mesh has no answer: {error}"));
    }
    Ok(found)
}

/// A mesh that was solved.
#[derive(Debug)]
struct Solved {
    size: f64,
    quantities: Vec<Quantity>,
}

/// Error estimate of the finest mesh.
#[derive(Debug)]
struct Estimate {
    error: f64,
    observed_order: Option<f64>,
    warnings: Vec<String>,
}

/// Of the last of `solved`: the largest over its quantities.
fn estimate(solved: &[Solved], expected: f64) -> Estimate {
    let count = solved.last().map_or(0, |last| last.quantities.len());
    let each: Vec<Index> = (0..count)
        .map(|place| Index::new(solved, place, expected))
        .collect();
    let worst = each.iter().max_by(|a, b| a.error.total_cmp(&b.error));
    let warnings = each.iter().filter_map(|index| index.warning(expected));
    Estimate {
        error: worst.map_or(f64::INFINITY, |index| index.error),
        observed_order: worst.and_then(|index| match index.order {
            ObservedOrder::Observed(order) => Some(order),
            _ => None,
        }),
        warnings: warnings.collect(),
    }
}

/// Observed order of a quantity on the last meshes.
#[derive(Debug, Clone, Copy, PartialEq)]
enum ObservedOrder {
    /// Not all meshes have it.
    Missing,
    /// One mesh shows nothing.
    OneMesh,
    /// Two do not either, and an order is assumed.
    TwoMeshes,
    /// Changes within the solver's tolerance.
    Solved,
    Observed(f64),
    /// Changes of both signs.
    Oscillates,
    /// Changes that do not shrink as those of half the expected order.
    Slow,
    /// Changes that shrink so fast that the last one is no measure.
    Fast(f64),
}

/// The error of one quantity.
#[derive(Debug)]
struct Index {
    name: &'static str,
    error: f64,
    order: ObservedOrder,
}

impl Index {
    fn new(solved: &[Solved], place: usize, expected: f64) -> Self {
        let last = &solved[solved.len() - 1].quantities[place];
        let name = last.name;
        let [Some(fine), Some(middle)] = [1, 2].map(|back| solved.len().checked_sub(back)) else {
            return Self {
                name,
                error: f64::INFINITY,
                order: ObservedOrder::OneMesh,
            };
        };
        let latest = &solved[solved.len().saturating_sub(3)..];
        let count = |mesh: &Solved| mesh.quantities[place].values.len();
        if latest.iter().any(|mesh| count(mesh) != last.values.len()) {
            return Self {
                name,
                error: 0.0,
                order: ObservedOrder::Missing,
            };
        }
        let (fine, middle) = (&solved[fine], &solved[middle]);
        let changes = |from: &Solved, to: &Solved| {
            Changes::between(&from.quantities[place], &to.quantities[place], last)
        };
        let last_change = changes(middle, fine);
        let ratio = middle.size / fine.size;
        let falls = |order: f64| ratio.powf(order) - 1.0;
        let assumed = ASSUMED * last_change.largest / falls(expected);
        let Some(coarse) = solved.len().checked_sub(3).map(|place| &solved[place]) else {
            let order = if last_change.largest <= SOLVED_TO {
                ObservedOrder::Solved
            } else {
                ObservedOrder::TwoMeshes
            };
            return Self {
                name,
                error: assumed,
                order,
            };
        };
        let first_change = changes(coarse, middle);
        let largest = last_change.largest.max(first_change.largest);
        let whole = changes(coarse, fine).largest.max(largest);
        let order = observe(
            [coarse.size, middle.size, fine.size],
            &first_change,
            &last_change,
            expected,
        );
        let error = match order {
            ObservedOrder::Observed(order) => {
                OBSERVED * last_change.largest / falls(order.min(expected))
            }
            ObservedOrder::Solved => ASSUMED * largest,
            ObservedOrder::Oscillates => OBSERVED * whole / falls(expected).min(1.0),
            ObservedOrder::Slow => ASSUMED * whole,
            // The first change, had it gone on falling with the expected order.
            ObservedOrder::Fast(_) => {
                let [h3, h2, h1] = [coarse, middle, fine].map(|mesh| mesh.size.powf(expected));
                assumed.max(OBSERVED * first_change.largest * h1 / (h3 - h2))
            }
            ObservedOrder::Missing | ObservedOrder::OneMesh | ObservedOrder::TwoMeshes => assumed,
        };
        Self { name, error, order }
    }

    /// Why the error is an upper figure.
    fn warning(&self, expected: f64) -> Option<String> {
        let mut text = String::new();
        let (name, percent) = (self.name, 100.0 * self.error);
        let written = match self.order {
            ObservedOrder::Observed(_) | ObservedOrder::Solved => return None,
            ObservedOrder::Missing => write!(
                text,
                "there is a {name} on some meshes and none on others; the estimated error leaves it out"
            ),
            ObservedOrder::OneMesh => write!(
                text,
                "the {name} was solved on one mesh, which shows no error"
            ),
            ObservedOrder::TwoMeshes => write!(
                text,
                "the error of the {name}, {percent:.2} %, is from two meshes: it assumes an order of \
                 convergence of {expected} and a safety factor of {ASSUMED}"
            ),
            ObservedOrder::Oscillates => write!(
                text,
                "the {name} goes up and down from mesh to mesh, so that no order of convergence is \
                 observed: its error, {percent:.2} %, comes from the largest difference between three meshes"
            ),
            ObservedOrder::Slow => write!(
                text,
                "the {name} hardly converges: its change from mesh to mesh does not shrink as it should; \
                 its error, {percent:.2} %, is {ASSUMED} times the largest difference between three \
                 meshes and may be larger"
            ),
            ObservedOrder::Fast(order) => write!(
                text,
                "the {name} seems to converge with order {order:.1} where {expected} is expected, which \
                 is chance on meshes as coarse as these: its error, {percent:.2} %, is an upper figure"
            ),
        };
        debug_assert!(written.is_ok(), "a string takes all");
        Some(text)
    }
}

/// Relative changes of a quantity from one mesh to another [-].
#[derive(Debug)]
struct Changes {
    each: Vec<f64>,
    largest: f64,
}

impl Changes {
    fn between(from: &Quantity, to: &Quantity, scale: &Quantity) -> Self {
        let values = from.values.iter().zip(&to.values).zip(&scale.values);
        let each: Vec<f64> = values
            .map(|((from, to), scale)| match to - from {
                0.0 => 0.0,
                change => change / scale.abs(),
            })
            .collect();
        // A change that is no number is not small.
        let largest = if each.iter().any(|change| change.is_nan()) {
            f64::INFINITY
        } else {
            each.iter().fold(0.0, |a: f64, b| a.max(b.abs()))
        };
        Self { each, largest }
    }
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Observed order from the changes between three meshes of these sizes, the coarsest first.
fn observe(sizes: [f64; 3], first: &Changes, last: &Changes, expected: f64) -> ObservedOrder {
    if first.largest.max(last.largest) <= SOLVED_TO {
        return ObservedOrder::Solved;
    }
    let both: f64 = first.each.iter().zip(&last.each).map(|(a, b)| a * b).sum();
    if both < 0.0 {
        return ObservedOrder::Oscillates;
    }
    let shrinks = norm(&first.each) / norm(&last.each);
    let would = |order: f64| {
        let [h3, h2, h1] = sizes.map(|size| (size / sizes[2]).powf(order));
        (h3 - h2) / (h2 - h1)
    };
    let ratio = sizes[1] / sizes[2];
    let highest = (1.0 + 3.0 * (ratio.powf(expected) - 1.0)).ln() / ratio.ln();
    let highest = highest.min(2.0 * expected);
    if shrinks.is_nan() || shrinks < would(0.5 * expected) {
        return ObservedOrder::Slow;
    }
    let (mut low, mut high) = (0.5 * expected, HIGHEST_ORDER);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if would(middle) < shrinks {
            low = middle;
        } else {
            high = middle;
        }
    }
    if low <= highest {
        ObservedOrder::Observed(low)
    } else {
        ObservedOrder::Fast(low)
    }
}

#[cfg(test)]
mod tests;
