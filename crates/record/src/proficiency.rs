//! Who is as good as the experts [Gallagher 2005]: in a measure, who is not worse than their mean by more than
//! one standard deviation; in a task, who is so in as large a part of the measures as the experts themselves are on
//! average, in [`IN_A_ROW`] attempts. Of twenty measures somebody as good as they are misses three by chance, so
//! that nobody would ever be so in all.

use crate::{Attempt, Better, Spread};

/// So many proficient attempts in a row make a trainee proficient: a single one may be luck.
pub const IN_A_ROW: usize = 2;

/// What experts reach in one measure.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Standard {
    /// The measure.
    #[serde(rename = "measure")]
    pub key: String,
    /// Which is better.
    pub better: Better,
    /// Over the experts' attempts.
    #[serde(flatten)]
    pub spread: Spread,
}

/// What experts reach in a task.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Standards {
    /// How many attempts of experts.
    pub attempts: usize,
    /// In the order of their measures.
    pub each: Vec<Standard>,
    /// The part of the measures in which the experts' own attempts are proficient, on average [-]; none where no
    /// standard tells.
    pub share: Option<f64>,
}

/// An attempt beside the standards.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// As [`Standards::each`].
    pub measures: Vec<Judged>,
    /// Whether the attempt is proficient: not failed, and in as large a part of the measures as the experts'; one
    /// that every expert has counts as missed where it is not there. None where no standard tells.
    pub proficient: Option<bool>,
}

/// A measure beside its standard.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judged {
    /// What was reached; none where the attempt has no such measure.
    pub value: Option<f64>,
    /// Whether that is proficient; none where that cannot be told.
    pub proficient: Option<bool>,
}

impl Standard {
    /// Whether a value is proficient; none where a single attempt gives no deviation.
    pub fn is_met_by(&self, value: f64) -> Option<bool> {
        let Spread {
            mean,
            standard_deviation,
            ..
        } = self.spread;
        let worse = match self.better {
            Better::Less => value - mean,
            Better::More => mean - value,
            Better::Neither => (value - mean).abs(),
        };
        standard_deviation.map(|deviation| worse <= deviation)
    }
}

impl Standards {
    /// Of experts' attempts at one task.
    pub fn of(experts: &[&Attempt]) -> Self {
        let mut each: Vec<Standard> = Vec::new();
        for measure in experts.iter().flat_map(|attempt| &attempt.measures) {
            if each.iter().any(|standard| standard.key == measure.key) {
                continue;
            }
            let values = experts.iter().filter_map(|own| own.value(&measure.key));
            if let Some(spread) = Spread::of(&values.collect::<Vec<_>>()) {
                each.push(Standard {
                    key: measure.key.clone(),
                    better: measure.better,
                    spread,
                });
            }
        }
        let mut standards = Self {
            attempts: experts.len(),
            each,
            share: None,
        };
        let shares = experts.iter().map(|own| share(&standards.measures(own)));
        let shares: Vec<f64> = shares.flatten().collect();
        standards.share = Spread::of(&shares).map(|spread| spread.mean);
        standards
    }

    /// An attempt beside them.
    pub fn judge(&self, attempt: &Attempt) -> Judgement {
        let measures = self.measures(attempt);
        let own = share(&measures).zip(self.share);
        // Sums of the same parts differ in their last digits.
        let reached = own.map(|(own, experts)| own >= experts - 1e-9);
        Judgement {
            proficient: reached.map(|reached| reached && attempt.passed != Some(false)),
            measures,
        }
    }

    fn measures(&self, attempt: &Attempt) -> Vec<Judged> {
        let judged = |standard: &Standard| {
            let value = attempt.value(&standard.key);
            let has_deviation = standard.spread.standard_deviation.is_some();
            // What all experts do must be done; what one of them did may be left.
            let is_due = standard.spread.count == self.attempts && has_deviation;
            let proficient = match value {
                Some(value) => standard.is_met_by(value),
                None => is_due.then_some(false),
            };
            Judged { value, proficient }
        };
        self.each.iter().map(judged).collect()
    }
}

/// The part of the measures that are proficient, of those of which that can be told [-].
fn share(measures: &[Judged]) -> Option<f64> {
    let told: Vec<bool> = measures.iter().filter_map(|own| own.proficient).collect();
    let proficient = told.iter().filter(|is| **is).count();
    (!told.is_empty()).then(|| proficient as f64 / told.len() as f64)
}

/// The attempt, counted from one, with which somebody became proficient, by the judgements of their attempts in
/// order; none if they did not.
pub fn proficient_since(judgements: &[Judgement]) -> Option<usize> {
    let proficient = |own: &Judgement| own.proficient == Some(true);
    let mut windows = judgements.windows(IN_A_ROW);
    let first = windows.position(|row| row.iter().all(proficient))?;
    Some(first + IN_A_ROW)
}
