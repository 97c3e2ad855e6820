use std::collections::BTreeMap;
use std::fmt::Write;

use palpate_characterize::design::{Criterion, ExpectedParameter, OptimizedProtocol, Presses};
use palpate_files::quantity::{quantity, without_unit};
use serde::Serialize;

use crate::VERSION;

/// The machine-readable answer.
#[derive(Debug, Serialize)]
pub struct Answer {
    palpate: &'static str,
    /// The optimized criterion: `minimax` or `d_optimal`.
    pub criterion: &'static str,
    /// The presses without a design.
    pub before: PressesAnswer,
    /// The designed presses.
    pub designed: PressesAnswer,
    /// The expected uncertainty of each parameter.
    pub parameters: BTreeMap<String, ParameterEstimate>,
    /// The interval of the worst parameter at the worst guess: half of it over the value [-].
    pub worst: f64,
    /// The number of compared protocols.
    pub compared: usize,
    /// Warnings.
    pub warnings: Vec<String>,
}

/// Presses, each a ramp and a hold.
#[derive(Debug, Serialize)]
pub struct PressesAnswer {
    /// [m]
    pub indenter_radius_m: f64,
    /// [m]
    pub depths_m: Vec<f64>,
    /// [s]
    pub ramp_s: f64,
    /// [s]
    pub hold_s: f64,
    /// Of all, without the rest between them [s].
    pub time_s: f64,
}

/// A parameter, in the unit of its name.
#[derive(Debug, Serialize)]
pub struct ParameterEstimate {
    /// The guessed value.
    pub value: f64,
    /// Whether the protocol is optimized for it.
    pub wanted: bool,
    /// The expected 95 % interval without a design.
    pub interval_95_before: Option<[f64; 2]>,
    /// The expected 95 % interval with the design.
    pub interval_95_expected: Option<[f64; 2]>,
}

impl From<&Presses> for PressesAnswer {
    fn from(presses: &Presses) -> Self {
        Self {
            indenter_radius_m: presses.radius,
            depths_m: presses.depths.clone(),
            ramp_s: presses.ramp,
            hold_s: presses.hold,
            time_s: presses.duration(),
        }
    }
}

impl Answer {
    pub(super) fn new(
        presses: &Presses,
        before: &[ExpectedParameter],
        found: &OptimizedProtocol,
        criterion: Criterion,
        wanted: &[String],
    ) -> Self {
        let estimate = |own: &ExpectedParameter| {
            let earlier = before.iter().find(|earlier| earlier.name == own.name);
            let estimate = ParameterEstimate {
                value: own.value,
                wanted: wanted.contains(&own.name),
                interval_95_before: earlier.and_then(interval),
                interval_95_expected: interval(own),
            };
            (own.name.clone(), estimate)
        };
        let warnings = vec![
            "intervals are expected to first order around the guess, of noise and steps of depth as stated or recorded; \
             a heart, breath or a specimen that is not large beside the indenter widens them"
                .to_owned(),
        ];
        Self {
            palpate: VERSION,
            criterion: match criterion {
                Criterion::Minimax => "minimax",
                Criterion::Determinant => "d_optimal",
            },
            before: presses.into(),
            designed: (&found.presses).into(),
            parameters: found.expected.iter().map(estimate).collect(),
            worst: found.worst,
            compared: found.compared,
            warnings,
        }
    }

    /// The expected uncertainties, a line for each parameter.
    pub fn lines(&self) -> Vec<String> {
        let reach = |own: &Option<[f64; 2]>, value: f64| {
            own.map_or("unknown".to_owned(), |[low, high]| {
                format!("± {:.1} %", 50.0 * (high - low) / value.abs())
            })
        };
        let each = self.parameters.iter().map(|(name, estimate)| {
            let unit = &name[without_unit(name).len()..];
            format!(
                "{:<8} {:>12}   before {:>9}   expected {:>9}{}",
                without_unit(name),
                quantity(unit, estimate.value, None),
                reach(&estimate.interval_95_before, estimate.value),
                reach(&estimate.interval_95_expected, estimate.value),
                if estimate.wanted { "   wanted" } else { "" }
            )
        });
        each.collect()
    }

    /// The same as comments of a protocol.
    pub(super) fn comments(&self) -> String {
        let mut text = "# Intervals of 95 %, half over the value:\n".to_owned();
        for line in self.lines() {
            // Writing to a string does not fail.
            let _ = writeln!(text, "#   {}", line.trim_end());
        }
        text
    }
}

fn interval(own: &ExpectedParameter) -> Option<[f64; 2]> {
    let reach = own.reach() * own.value.abs();
    reach
        .is_finite()
        .then_some([own.value - reach, own.value + reach])
}
