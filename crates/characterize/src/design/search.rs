use super::expected::{ExpectedCurve, ExpectedParameter};
use super::{Instrument, Limits, Presses};
use crate::Error;

/// The optimality criterion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Criterion {
    /// The interval of the worst parameter, at the worst guess.
    Minimax,
    /// The determinant of the covariance, in the mean of the guesses.
    Determinant,
}

/// A protocol that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct OptimizedProtocol {
    /// The protocol.
    pub presses: Presses,
    /// Its expected parameters at the first guess.
    pub expected: Vec<ExpectedParameter>,
    /// The interval of the worst parameter wanted at the worst guess, half of it over the value [-].
    pub worst: f64,
    /// How many protocols were compared.
    pub compared: usize,
}

/// Deepest presses over the limit [-], the least over the deepest [-], and ramps over the quickest [-].
const DEEPEST: [f64; 7] = [1.0, 0.85, 0.7, 0.55, 0.4, 0.3, 0.2];
const LEAST: [f64; 5] = [0.1, 0.2, 0.35, 0.5, 0.75];
const RAMPS: [f64; 5] = [1.0, 2.0, 4.0, 8.0, 16.0];
/// Part of a press that is a ramp, at most [-].
const RAMP: f64 = 0.25;
/// Most radii that a depth is trusted to [-]: beyond, elements decide what tissue does at the edge of a punch.
pub(super) const MAX_RADII: f64 = 5.5;

/// The protocol within `limits` from which the parameters `wanted` are expected to be known best, of tissue as any of
/// `guesses`; `at_part` receives the part that is done [-].
///
/// # Errors
/// When a parameter is not one of the guesses, or no protocol keeps within the limits.
pub fn design(
    guesses: &[ExpectedCurve],
    instrument: &Instrument,
    limits: &Limits,
    wanted: &[String],
    criterion: Criterion,
    at_part: &mut dyn FnMut(f64),
) -> Result<OptimizedProtocol, Error> {
    let all = candidates(limits);
    let mut best: Option<(f64, f64, Presses)> = None;
    let mut compared = 0;
    for (place, presses) in all.iter().enumerate() {
        at_part(place as f64 / all.len() as f64);
        let strongest = guesses
            .iter()
            .map(|one| one.force(presses.radius, presses.deepest()));
        if strongest.fold(0.0, f64::max) > limits.force {
            continue;
        }
        compared += 1;
        let most = best.as_ref().map_or(f64::INFINITY, |own| own.0);
        if let Some((score, worst)) = score(guesses, presses, instrument, wanted, criterion, most)?
        {
            best = Some((score, worst, presses.clone()));
        }
    }
    let (_, worst, presses) = best.ok_or(Error::NoDesign)?;
    let first = guesses.first().ok_or(Error::NoDesign)?;
    Ok(OptimizedProtocol {
        expected: first.expected(&presses, instrument)?.0,
        presses,
        worst,
        compared,
    })
}

/// The score of a protocol and its worst interval; none where it is not below `most`.
fn score(
    guesses: &[ExpectedCurve],
    presses: &Presses,
    instrument: &Instrument,
    wanted: &[String],
    criterion: Criterion,
    most: f64,
) -> Result<Option<(f64, f64)>, Error> {
    let (mut worst, mut sum) = (0.0_f64, 0.0);
    for guess in guesses {
        let (found, correlations) = guess.expected(presses, instrument)?;
        let mut chosen = Vec::new();
        for name in wanted {
            let own = found.iter().find(|own| own.name == *name);
            let own = own.ok_or_else(|| Error::NotInGuess {
                name: name.clone(),
                known: found.iter().map(|own| own.name.clone()).collect(),
            })?;
            worst = worst.max(own.reach());
            sum += own.reach().ln();
            chosen.extend(correlations.names.iter().position(|known| known == name));
        }
        // Of the covariance of logarithms: the errors, and how they go together.
        let shared = correlations
            .matrix
            .select_rows(&chosen)
            .select_columns(&chosen);
        sum += 0.5 * shared.determinant().max(f64::MIN_POSITIVE).ln();
        if criterion == Criterion::Minimax && (!worst.is_finite() || worst >= most) {
            return Ok(None);
        }
    }
    let score = match criterion {
        Criterion::Minimax => worst,
        Criterion::Determinant => sum / guesses.len() as f64,
    };
    Ok((score < most).then_some((score, worst)))
}

fn candidates(limits: &Limits) -> Vec<Presses> {
    let mut all = Vec::new();
    for &radius in &limits.radii {
        for count in 1..=limits.presses {
            let whole = (limits.time / count as f64).min(limits.press);
            let least = match count {
                1 => &[1.0][..],
                _ => &LEAST[..],
            };
            for (part, least) in DEEPEST
                .iter()
                .flat_map(|part| least.iter().map(move |l| (part, l)))
            {
                let deepest = part * limits.depth.min(MAX_RADII * radius);
                let step = (1.0 - least) / (count.max(2) - 1) as f64;
                let depths: Vec<f64> = (0..count)
                    .map(|i| deepest * (1.0 - step * (count - 1 - i) as f64))
                    .collect();
                let ramps = RAMPS.iter().map(|times| times * deepest / limits.speed);
                for ramp in ramps.take_while(|ramp| *ramp <= RAMP * whole) {
                    all.push(Presses {
                        radius,
                        depths: depths.clone(),
                        ramp,
                        hold: whole - ramp,
                    });
                }
            }
        }
    }
    all
}
