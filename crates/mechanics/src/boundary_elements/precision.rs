use faer::traits::RealField;

/// The number type of a large matrix: `f32`, or `f64` for tests.
pub trait Precision: RealField + Copy + Into<f64> + Send + Sync + 'static {
    /// The nearest one to `value`.
    fn of(value: f64) -> Self;
}

impl Precision for f32 {
    fn of(value: f64) -> Self {
        value as Self
    }
}

impl Precision for f64 {
    fn of(value: f64) -> Self {
        value
    }
}
