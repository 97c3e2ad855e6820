use std::f64::consts::TAU;

use nalgebra::Complex;

/// A ratio of two polynomials in s.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Transfer {
    /// Coefficients of s⁰, s¹ and so on, above the line.
    pub(super) above: Vec<f64>,
    /// The same below the line.
    pub(super) below: Vec<f64>,
}

impl Transfer {
    /// Its value at `frequency` [Hz].
    pub(super) fn at(&self, frequency: f64) -> Complex<f64> {
        let s = Complex::new(0.0, TAU * frequency);
        let value = |coefficients: &[f64]| {
            let terms = coefficients.iter().rev();
            terms.fold(Complex::new(0.0, 0.0), |sum, c| sum * s + c)
        };
        value(&self.above) / value(&self.below)
    }
}
