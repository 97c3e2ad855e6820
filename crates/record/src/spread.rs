/// A number over several attempts.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Spread {
    /// In the number's unit.
    pub mean: f64,
    /// Of one attempt, in the number's unit; none for a single one.
    pub standard_deviation: Option<f64>,
    /// How many.
    #[serde(rename = "n")]
    pub count: usize,
}

impl Spread {
    /// Of values; none of no value.
    pub fn of(values: &[f64]) -> Option<Self> {
        let count = values.len();
        let mean = values.iter().sum::<f64>() / count as f64;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        (count > 0).then(|| Self {
            mean,
            standard_deviation: (count > 1).then(|| (squares / (count - 1) as f64).sqrt()),
            count,
        })
    }
}
