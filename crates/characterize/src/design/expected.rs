use super::{Guess, Instrument, Presses};
use crate::Error;
use crate::inverse::{Body, Correlations, Curves, Indentation, LawData, UnitCurve, expected_law};
use crate::viscoelastic::{RelaxationRecord, expected_relaxation};

/// A parameter as a characterization is expected to state it.
#[derive(Debug, Clone, PartialEq)]
pub struct ExpectedParameter {
    /// Its name: a key of the law, or `g_1`, `tau_1_s` and so on.
    pub name: String,
    /// Its value in the guess [unit of its name].
    pub value: f64,
    /// Its standard error [unit of its name].
    pub standard_error: f64,
    /// The t [-] of its interval of 95 %.
    pub quantile: f64,
}

impl ExpectedParameter {
    /// Half of the interval of 95 % over the value [-].
    pub fn reach(&self) -> f64 {
        self.quantile * self.standard_error / self.value.abs()
    }
}

/// Samples of a ramp, and of a hold at ever longer times.
const RAMP: usize = 24;
const HOLD: usize = 48;

/// One guess under a flat punch that it sticks to, whose curve is known for every radius: force is a² f(d/a).
#[derive(Debug, Clone)]
pub struct ExpectedCurve {
    guess: Guess,
    /// Of an indenter of unit radius.
    curve: UnitCurve,
}

impl ExpectedCurve {
    /// Of `guess`, pressed to `deepest` radii [-]; runs finite elements where the force is not tabulated.
    ///
    /// # Errors
    /// When no equilibrium is found down to there.
    pub fn new(guess: Guess, deepest: f64) -> Result<Self, Error> {
        let body = Body::under_punch(1.0);
        let curve = Curves::new(body, guess.law, deepest).of(f64::INFINITY, &guess.shape)?;
        Ok(Self { guess, curve })
    }

    /// The guess.
    pub fn guess(&self) -> &Guess {
        &self.guess
    }

    /// The same curve with another modulus and relaxation.
    pub fn with(&self, guess: Guess) -> Self {
        Self {
            guess,
            ..self.clone()
        }
    }

    /// The elastic force [N] at `depth` [m] under an indenter of `radius` [m].
    pub fn force(&self, radius: f64, depth: f64) -> f64 {
        self.guess.modulus * radius * radius * self.curve.force.force(depth / radius)
    }

    /// How well each parameter is expected to be known, and the correlations of those of which there are some.
    ///
    /// # Errors
    /// When nothing is pressed.
    pub fn expected(
        &self,
        presses: &Presses,
        instrument: &Instrument,
    ) -> Result<(Vec<ExpectedParameter>, Correlations), Error> {
        let curve = self.curve.scaled(presses.radius);
        let deepest = presses.deepest();
        let Guess {
            law,
            modulus,
            shape,
            series,
        } = &self.guess;
        let (time, shares) = samples(presses, instrument.rate);
        let down = |depth: f64| -> Vec<f64> {
            let part = time.iter().map(|t| (t / presses.ramp).min(1.0));
            part.map(|part| depth * part).collect()
        };
        let depths: Vec<Vec<f64>> = presses.depths.iter().map(|depth| down(*depth)).collect();
        let forces: Vec<Vec<f64>> = depths
            .iter()
            .map(|depth| {
                curve
                    .force
                    .scaled(1.0, *modulus)
                    .relaxed(series, &time, depth)
            })
            .collect();
        let each = depths.iter().zip(&forces);
        let indentations: Vec<Indentation<'_>> = each
            .map(|(depth, force)| Indentation {
                zeros: instrument.zeros,
                ..Indentation::new(&time, depth, force)
            })
            .collect();
        let weights: Vec<f64> = depths.iter().flat_map(|_| &shares).copied().collect();
        let of_noise = |noise: f64| -> Vec<f64> { weights.iter().map(|w| w / noise).collect() };
        let curves = Curves::new(Body::under_punch(presses.radius), *law, deepest);
        let data = LawData {
            indentations: &indentations,
            series,
        };
        let (errors, correlations) =
            expected_law(&curves, &curve, *modulus, data, &of_noise(instrument.noise));
        let own = law.parameters(*modulus, shape);
        let mut all: Vec<ExpectedParameter> = own
            .iter()
            .zip(errors)
            .map(
                |(parameter, (standard_error, quantile))| ExpectedParameter {
                    quantile,
                    name: parameter.name.to_owned(),
                    value: parameter.value,
                    standard_error,
                },
            )
            .collect();
        if !series.terms().is_empty() {
            let largest = forces.iter().flatten().copied().fold(0.0, f64::max);
            let shape = |depth: f64| curve.force.force(depth);
            let records = indentations.iter().filter_map(|each| {
                let course =
                    RelaxationRecord::new(each.time, each.depth, each.force, largest, shape)?;
                Some(course.with_zeros(each.depth, each.zeros, largest, shape))
            });
            let records: Vec<RelaxationRecord> = records.collect();
            let size = |depth: &f64| modulus * curve.force.force(*depth) / largest;
            let sizes: Vec<f64> = presses.depths.iter().map(size).collect();
            let weights = of_noise(instrument.noise / largest);
            let found = expected_relaxation(&records, series, &sizes, &weights)?;
            for (place, (terms, quantiles)) in (1..).zip(found.terms.iter().zip(&found.quantiles)) {
                let names = [format!("g_{place}"), format!("tau_{place}_s")];
                for ((name, known), quantile) in names.into_iter().zip(terms).zip(quantiles) {
                    all.push(ExpectedParameter {
                        name,
                        quantile: *quantile,
                        value: known.value,
                        standard_error: known.standard_error.unwrap_or(f64::INFINITY),
                    });
                }
            }
        }
        Ok((all, correlations))
    }
}

/// Times [s] of a press, and the roots of how many samples of `rate` [Hz] each stands for [-].
fn samples(presses: &Presses, rate: f64) -> (Vec<f64>, Vec<f64>) {
    let (ramp, hold) = (presses.ramp, presses.hold);
    let step = ramp / RAMP as f64;
    let mut time: Vec<f64> = (0..=RAMP).map(|i| step * i as f64).collect();
    let first = step.min(hold / HOLD as f64);
    let later = (0..HOLD).map(|i| first * (hold / first).powf(i as f64 / (HOLD - 1) as f64));
    time.extend(later.map(|after| ramp + after));
    let last = time.len() - 1;
    let share = |i: usize| {
        let [before, after] = [i.saturating_sub(1), (i + 1).min(last)].map(|place| time[place]);
        (0.5 * (after - before) * rate).sqrt()
    };
    let shares = (0..time.len()).map(share).collect();
    (time, shares)
}
