//! Tests of fits and of what is said about their uncertainty.

mod agreement;
mod bands;
mod bounds;
mod certified;
mod coverage;
mod nist;
mod pooled;
mod repeated;
mod words;

use palpate_characterize::fit::Parameter;

/// Parameters without bounds, called b1, b2 and so on.
fn parameters(values: &[f64]) -> Vec<Parameter> {
    let named = |(i, &value)| Parameter::new(format!("b{}", i + 1), value);
    values.iter().enumerate().map(named).collect()
}
