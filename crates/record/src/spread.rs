/// Statistics of a number over several attempts.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Spread {
    /// Mean, in the number's unit.
    pub mean: f64,
    /// Standard deviation of one attempt, in the number's unit; none for a single one.
    pub standard_deviation: Option<f64>,
    /// Number of attempts.
    #[serde(rename = "n")]
    pub count: usize,
}

impl Spread {
    /// The statistics of values; none without values.
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
