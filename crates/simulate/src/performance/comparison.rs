//! A score compared with experts.

use super::{Better, Measure, Score};

/// The experts' level in one measure.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Standard {
    /// The measure.
    #[serde(skip)]
    pub key: String,
    /// Over the experts' sessions.
    pub mean: f64,
    /// Of a session [the measure's unit]; none for a single one.
    pub standard_deviation: Option<f64>,
    /// Number of sessions.
    #[serde(rename = "sessions")]
    pub count: usize,
}

/// A measure compared with its standard.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Comparison {
    /// The reached value.
    #[serde(skip)]
    pub measure: Measure,
    /// The experts' level.
    #[serde(flatten)]
    pub standard: Standard,
    /// Value over the experts' mean [-]; none where that is zero.
    pub ratio: Option<f64>,
    /// Whether it is proficient: not worse than the experts' mean by more than their standard deviation
    /// [Gallagher 2005]; none where a single session gives no deviation.
    pub proficient: Option<bool>,
}

impl Standard {
    /// From experts' scores: the standard of each of their measures, in the order of the first.
    pub fn of(experts: &[Score]) -> Vec<Self> {
        let lists: Vec<Vec<Measure>> = experts.iter().map(Score::measures).collect();
        let mut keys: Vec<&str> = Vec::new();
        for measure in lists.iter().flatten() {
            if !keys.contains(&measure.key.as_str()) {
                keys.push(&measure.key);
            }
        }
        let standard = |key: &str| {
            let own = lists.iter().flatten().filter(|measure| measure.key == key);
            let values: Vec<f64> = own.map(|measure| measure.value).collect();
            let count = values.len();
            let mean = values.iter().sum::<f64>() / count as f64;
            let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
            Self {
                key: key.to_owned(),
                mean,
                standard_deviation: (count > 1).then(|| (squares / (count - 1) as f64).sqrt()),
                count,
            }
        };
        keys.into_iter().map(standard).collect()
    }
}

/// The measures of a score that have a standard, compared with it.
pub fn compare(score: &Score, standards: &[Standard]) -> Vec<Comparison> {
    let beside = |measure: Measure| {
        let standard = standards
            .iter()
            .find(|standard| standard.key == measure.key)?
            .clone();
        let worse = match measure.better {
            Better::Less => measure.value - standard.mean,
            Better::More => standard.mean - measure.value,
            Better::Neither => (measure.value - standard.mean).abs(),
        };
        Some(Comparison {
            ratio: (standard.mean != 0.0).then(|| measure.value / standard.mean),
            proficient: standard
                .standard_deviation
                .map(|deviation| worse <= deviation),
            measure,
            standard,
        })
    };
    score.measures().into_iter().filter_map(beside).collect()
}
