use palpate_mechanics::PronySeries;

use super::model::{Model, RelaxationRecord, terms};
use super::relaxation::{Relaxation, described, fitted, starts, terms_of, values_of};
use crate::Error;
use crate::fit::{Fit, Parameter, correlated_uncertainty, simplest, with_systematic};

/// The relaxation of a running press: of two terms where it can distinguish them, else of one.
#[derive(Debug, Clone)]
pub(crate) struct PressedRelaxation {
    /// The one that the information criterion prefers.
    pub(crate) relaxation: Relaxation,
    /// Where one term takes the place of two: the series of two.
    pub(crate) two_terms: Option<PronySeries>,
    /// The fits with one term and with two, from which the next ones start.
    fits: [Fit; 2],
}

/// Shortest time of a term, in parts of the time in which the indenter comes down [-]: what is faster relaxes while the
/// force still rises, where the first contact is as good an explanation.
const SHORTEST: f64 = 0.2;
/// Part of the largest depth at which the indenter has come down [-].
const DOWN: f64 = 0.95;

impl PressedRelaxation {
    /// Of `record`, sought from where the fits `before` it ended; without them, or when `afresh`, from everywhere too.
    ///
    /// # Errors
    /// When there is too little of it.
    pub(crate) fn of(
        record: &RelaxationRecord,
        before: Option<&Self>,
        afresh: bool,
    ) -> Result<Self, Error> {
        let records = std::slice::from_ref(record);
        let afresh = afresh || before.is_none();
        let start = |count: usize| before.map(|own| &own.fits[count - 1]);
        let one = sought(records, 1, None, start(1), afresh)?;
        let two = sought(records, 2, Some(&one), start(2), afresh)?;
        // One on its bound does not make the others better known.
        let known = |fit: &Fit| {
            let free = fit.unbounded();
            let noise = correlated_uncertainty(&free, &[record.time.len()]);
            let terms = terms_of(fit, records);
            let model = Model { records, terms };
            let samples = noise.effective_samples;
            (
                with_systematic(noise, &free, &model.systematic(&values_of(fit))),
                samples,
            )
        };
        let (of_two, samples) = known(&two);
        let is_two = two.chosen().len() == two.free() && simplest(&[&one, &two], samples).0 == 1;
        let series = PronySeries::new(&terms(&values_of(&two), 2));
        let (fit, uncertainty) = match is_two {
            true => (two.clone(), of_two),
            false => (one.clone(), known(&one).0),
        };
        Ok(Self {
            relaxation: described(records, fit, uncertainty, Vec::new())?,
            two_terms: series.ok().filter(|_| !is_two),
            fits: [one, two],
        })
    }
}

/// The fit of so many terms, from where one `before` it ended and, `afresh`, from everywhere and from that of one `fewer`.
fn sought(
    records: &[RelaxationRecord],
    count: usize,
    fewer: Option<&Fit>,
    before: Option<&Fit>,
    afresh: bool,
) -> Result<Fit, Error> {
    let least = SHORTEST * records.iter().map(time_down).fold(0.0, f64::max);
    let bounded = |mut start: Vec<Parameter>| {
        for parameter in &mut start {
            if parameter.name.starts_with("log_tau") && least > 0.0 {
                parameter.lower = parameter.lower.max(least.ln()).min(parameter.upper - 1e-3);
            }
            parameter.value = parameter.value.clamp(parameter.lower, parameter.upper);
        }
        start
    };
    let mut tried = Vec::new();
    if let Some(before) = before {
        // Its bounds were those of a shorter record.
        let mut start = starts(records, count, None).swap_remove(0);
        for (own, other) in start.iter_mut().zip(&before.parameters) {
            own.value = other.value;
        }
        tried.push(start);
    }
    if afresh {
        tried.extend(starts(records, count, fewer));
    }
    let mut best: Option<Fit> = None;
    for start in tried {
        let fit = fitted(records, count, &bounded(start))?;
        let is_better = |best: &Fit| fit.sum_of_squares() < best.sum_of_squares();
        if best.as_ref().is_none_or(is_better) {
            best = Some(fit);
        }
    }
    best.ok_or(Error::NoContactForce)
}

/// The time in which the indenter comes down [s].
fn time_down(record: &RelaxationRecord) -> f64 {
    let down = record.shape.iter().position(|shape| *shape >= DOWN);
    down.map_or(0.0, |sample| record.time[sample] - record.time[0])
}
