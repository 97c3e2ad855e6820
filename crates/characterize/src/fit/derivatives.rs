//! Derivatives of the residuals: given, or by finite differences.

use nalgebra::{DMatrix, DVectorView};

use super::{Parameter, Settings};

/// Kind of finite differences. A difference never leaves the bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Differences {
    /// To one side: one evaluation for each parameter, half the digits of the residuals.
    Forward,
    /// To both sides where there is room: two evaluations, two thirds of the digits.
    Central,
}

/// Residuals and their derivatives, as a search asks for them.
pub(super) trait Problem {
    /// Residuals at these values; `None` where there are none.
    fn residuals(&mut self, values: &[f64], residuals: &mut [f64]) -> Option<()>;

    /// Derivatives at the values of the last residuals that were found, and how many evaluations they
    /// took; `None` where there are none.
    fn jacobian(
        &mut self,
        values: &[f64],
        residuals: &[f64],
        jacobian: &mut DMatrix<f64>,
    ) -> Option<usize>;
}

/// Residuals that bring their derivatives.
pub(super) struct Given<F> {
    function: F,
    last: DMatrix<f64>,
}

impl<F> Given<F> {
    pub(super) fn new(last: DMatrix<f64>, function: F) -> Self {
        Self { function, last }
    }
}

impl<F: FnMut(&[f64], &mut [f64], &mut DMatrix<f64>) -> Option<()>> Problem for Given<F> {
    fn residuals(&mut self, values: &[f64], residuals: &mut [f64]) -> Option<()> {
        (self.function)(values, residuals, &mut self.last)
    }

    fn jacobian(&mut self, _: &[f64], _: &[f64], jacobian: &mut DMatrix<f64>) -> Option<usize> {
        jacobian.copy_from(&self.last);
        Some(0)
    }
}

/// Residuals whose derivatives are differences.
pub(super) struct Differenced<'a, F> {
    function: F,
    parameters: &'a [Parameter],
    /// The step of a difference, relative to the size of a parameter.
    step: f64,
    central: bool,
    point_values: Vec<f64>,
    other_residuals: Vec<f64>,
}

impl<'a, F> Differenced<'a, F> {
    pub(super) fn new(parameters: &'a [Parameter], settings: &Settings, function: F) -> Self {
        let central = settings.differences == Differences::Central;
        Self {
            function,
            parameters,
            step: if central {
                settings.precision.cbrt()
            } else {
                settings.precision.sqrt()
            },
            central,
            point_values: Vec::new(),
            other_residuals: Vec::new(),
        }
    }
}

impl<F: FnMut(&[f64], &mut [f64]) -> Option<()>> Problem for Differenced<'_, F> {
    fn residuals(&mut self, values: &[f64], residuals: &mut [f64]) -> Option<()> {
        (self.function)(values, residuals)
    }

    fn jacobian(
        &mut self,
        values: &[f64],
        residuals: &[f64],
        jacobian: &mut DMatrix<f64>,
    ) -> Option<usize> {
        self.point_values.clear();
        self.point_values.extend_from_slice(values);
        self.other_residuals.resize(residuals.len(), 0.0);
        let mut evaluations = 0;
        let parameters = self.parameters;
        for (i, parameter) in parameters.iter().enumerate().filter(|(_, p)| !p.fixed) {
            let column = jacobian.column_mut(i);
            let column = column.data.into_slice_mut();
            evaluations += self.column(i, parameter, residuals, column)?;
            self.point_values[i] = values[i];
        }
        Some(evaluations)
    }
}

impl<F: FnMut(&[f64], &mut [f64]) -> Option<()>> Differenced<'_, F> {
    /// One column, by a difference between two of: ahead, behind, here.
    fn column(
        &mut self,
        i: usize,
        parameter: &Parameter,
        residuals: &[f64],
        column: &mut [f64],
    ) -> Option<usize> {
        let value = self.point_values[i];
        // Many parameters are wanted well below the size that they start with.
        let size = value.abs().max(1e-3 * parameter.scale);
        let room = (parameter.upper - value).max(value - parameter.lower);
        let step = (self.step * size).min(room);
        let inside = |point: &f64| (parameter.lower..=parameter.upper).contains(point);
        let points = [value + step, value - step].into_iter().filter(inside);
        let (mut evaluations, mut first) = (0, None);
        let mut other_residuals = std::mem::take(&mut self.other_residuals);
        for point in points {
            match first {
                None => first = self.evaluate(i, point, column).map(|()| point),
                Some(first) if self.central => {
                    if self.evaluate(i, point, &mut other_residuals).is_some() {
                        subtract(column, &other_residuals, first - point);
                        self.other_residuals = other_residuals;
                        return Some(evaluations + 1);
                    }
                }
                Some(_) => break,
            }
            evaluations += 1;
        }
        self.other_residuals = other_residuals;
        subtract(column, residuals, first? - value);
        Some(evaluations)
    }

    fn evaluate(&mut self, i: usize, value: f64, residuals: &mut [f64]) -> Option<()> {
        self.point_values[i] = value;
        (self.function)(&self.point_values, residuals)?;
        let sum = DVectorView::from_slice(residuals, residuals.len()).norm_squared();
        sum.is_finite().then_some(())
    }
}

fn subtract(column: &mut [f64], other: &[f64], width: f64) {
    for (value, other) in column.iter_mut().zip(other) {
        *value = (*value - other) / width;
    }
}
