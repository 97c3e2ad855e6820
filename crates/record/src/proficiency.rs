//! Proficiency by the experts' standard [Gallagher 2005]. A measure is proficient if it is not worse than the experts'
//! mean by more than one standard deviation. A trainee is proficient in a task if, in [`IN_A_ROW`] attempts, as large a
//! part of the measures is proficient as in the experts' own attempts on average. Out of twenty measures someone at the
//! experts' level misses three by chance, so nobody would ever pass all.

use crate::{Attempt, Better, Spread};

/// Number of successive proficient attempts that make a trainee proficient: a single one may be luck.
pub const IN_A_ROW: usize = 2;

/// The experts' level in one measure.
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

/// The experts' level in a task.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Standards {
    /// Number of experts' attempts.
    pub attempts: usize,
    /// In the order of their measures.
    pub each: Vec<Standard>,
    /// The mean part of the measures in which the experts' own attempts are proficient [-]; none if no standard
    /// applies.
    pub share: Option<f64>,
}

/// An attempt compared with the standards.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// As [`Standards::each`].
    pub measures: Vec<Judged>,
    /// Whether the attempt is proficient: not failed, and in as large a part of the measures as the experts'. A measure
    /// that every expert has counts as missed if the attempt lacks it. None if no standard applies.
    pub proficient: Option<bool>,
}

/// A measure compared with its standard.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judged {
    /// The attempt's value; none if it lacks the measure.
    pub value: Option<f64>,
    /// Whether that is proficient; none if undetermined.
    pub proficient: Option<bool>,
}

impl Standard {
    /// Whether a value is proficient; none if a single attempt gives no deviation.
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
    /// The standards from experts' attempts at one task.
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

    /// Compares an attempt with the standards.
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
            // A measure that all experts have is required; one that only some have is optional.
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

/// The proficient part of the measures with a verdict [-].
fn share(measures: &[Judged]) -> Option<f64> {
    let verdicts: Vec<bool> = measures.iter().filter_map(|own| own.proficient).collect();
    let proficient = verdicts.iter().filter(|is| **is).count();
    (!verdicts.is_empty()).then(|| proficient as f64 / verdicts.len() as f64)
}

/// The attempt, counted from one, at which a trainee became proficient, from the verdicts on the attempts in order;
/// none if never.
pub fn proficient_since(judgements: &[Judgement]) -> Option<usize> {
    let proficient = |own: &Judgement| own.proficient == Some(true);
    let mut windows = judgements.windows(IN_A_ROW);
    let first = windows.position(|row| row.iter().all(proficient))?;
    Some(first + IN_A_ROW)
}
