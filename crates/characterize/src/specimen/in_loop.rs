//! The law of one specimen with full viscoelastic runs of finite elements in the loop of the fit (6.15).
//!
//! A fit takes force for the product of an elastic force and G(t). For the tissue that was found, a full run with
//! internal variables and an elastic one on the same mesh say by which factor the product is off at each time; the
//! measured force is divided by it and fitted again, until the tissue stays. Then the full run is as near to the measured
//! force as the product to the divided one. Relaxation is sought with the elastic force of the law. A round takes two runs for each recording, and none for a derivative; errors
//! of the mesh are in both runs and leave the factor.
//!
//! *How we know*: `in_loop::…`: full runs of known tissue on another mesh, off the table's grid.
//!
//! *Limits*: solid specimens; a recording that moves all the time takes a run of as many steps, and is refused.

use palpate_mechanics::finite_elements::indentation::{IndentationRun, IndentationSettings};
use palpate_mechanics::{IndentationCurve, PronySeries};

use super::{Characterization, CharacterizeSettings, Pressed, records, sought};
use crate::Error;
use crate::fit::Draws;
use crate::inverse::{Body, CandidateLaw, Curves, LawDescription};
use crate::viscoelastic::{Relaxation, relaxation};

/// Rounds at most.
const ROUNDS: usize = 12;
/// Change of every parameter below which the tissue stays, over the sum of a law's moduli [-]: less than elements are off.
const SETTLED: f64 = 2e-3;
/// Steps of depth that a run takes, at least, and parts of the time since the depth last changed.
const STEPS: f64 = 24.0;
const PART: f64 = 0.15;
/// A change of depth between two samples below which the indenter rests, over the largest depth [-].
const RESTS: f64 = 1e-3;
/// Samples of a run at most: some minutes.
const MAX_SAMPLES: usize = 400;
/// Least depth of a factor, over the largest [-]: before it there is hardly a force.
const MIN_DEPTH: f64 = 0.05;
/// Halvings of the way to a shape whose run finds no equilibrium, at most.
const HALVINGS: usize = 4;

/// Fits the law again, with full runs in the loop; `at_step` receives the current step. Where that fails, the law's
/// entry holds the reason.
pub(super) fn refine(
    found: &mut Characterization,
    pressed: &[Pressed],
    body: Result<Body, Error>,
    settings: &CharacterizeSettings,
    at_step: &mut dyn FnMut(&'static str),
) {
    let Some(&law) = settings.laws.first() else {
        return;
    };
    let refined = body.and_then(|body| {
        let deepest = pressed.iter().map(Pressed::deepest).fold(0.0, f64::max);
        let specimen = Specimen {
            pressed,
            body,
            law,
            deepest,
        };
        specimen.refined(found, settings, at_step)
    });
    let refined = refined.map(|(relaxation, description)| {
        found.relaxation = Ok(relaxation);
        description
    });
    found.laws = vec![(law, refined)];
}

/// What is refined.
struct Specimen<'a> {
    pressed: &'a [Pressed],
    body: Body,
    law: CandidateLaw,
    /// [m]
    deepest: f64,
}

/// A tissue that was found.
#[derive(Debug, Clone)]
struct Tissue {
    modulus: f64,
    shape: Vec<f64>,
    series: PronySeries,
}

impl Tissue {
    fn of(relaxation: &Relaxation, law: &LawDescription) -> Self {
        Self {
            modulus: law.found.modulus(),
            shape: law.found.shape().to_vec(),
            series: relaxation.series.clone(),
        }
    }

    /// Whether it is `other` but for less than elements are off.
    fn is_like(&self, other: &Self) -> bool {
        (self.modulus / other.modulus - 1.0).abs() <= SETTLED
            && (self.shape.iter().zip(&other.shape)).all(|(a, b)| (a - b).abs() <= SETTLED)
    }
}

impl Specimen<'_> {
    fn refined(
        &self,
        found: &Characterization,
        settings: &CharacterizeSettings,
        at_step: &mut dyn FnMut(&'static str),
    ) -> Result<(Relaxation, LawDescription), Error> {
        let (_, first) = found.laws.first().ok_or(Error::NoContactForce)?;
        let first = first.as_ref().map_err(Clone::clone)?;
        let relaxing = found.relaxation.as_ref().map_err(Clone::clone)?;
        let mut tissue = Tissue::of(relaxing, first);
        let mut curves = Curves::new(self.body, self.law, self.deepest).in_loop();
        let mut solves = 0;
        let places: Vec<Vec<usize>> = self
            .pressed
            .iter()
            .map(run_samples)
            .collect::<Result<_, _>>()?;
        for _ in 0..ROUNDS {
            at_step("finite elements");
            let mut divided = self.pressed.to_vec();
            let (factors, of) = self.factors(&tissue, &places)?;
            solves += 2 * factors.len();
            for (pressed, factor) in divided.iter_mut().zip(&factors) {
                divide(pressed, factor);
            }
            // The law's own elastic force, where a first fit takes that of neo-Hookean tissue.
            let elastic = curves.of(f64::INFINITY, &of.shape)?;
            let records = records(&divided, Some(&elastic));
            let mut relaxing = relaxation(&records, settings.relaxation)?;
            let mut law = |draws: Option<Draws>| sought(&mut curves, &divided, &relaxing, draws);
            let description = law(None)?;
            let next = Tissue::of(&relaxing, &description);
            if next.is_like(&of) {
                let mut description = match settings.draws {
                    None => description,
                    draws => law(draws)?,
                };
                let law = &mut description.found;
                law.solves = solves + curves.solve_count();
                multiply(&mut law.forces, &factors);
                let with_force = self.pressed.iter().zip(&factors);
                let with_force = with_force.filter(|(pressed, _)| pressed.has_force());
                let with_force_factors: Vec<_> =
                    with_force.map(|(_, factor)| factor.clone()).collect();
                multiply(&mut relaxing.forces, &with_force_factors);
                return Ok((relaxing, description));
            }
            tissue = next;
        }
        Err(Error::LoopDoesNotSettle { rounds: ROUNDS })
    }

    /// Factors of each recording for the tissue, or for the nearest that has an equilibrium on the way to the shape that
    /// every fit begins with; and that tissue.
    fn factors(
        &self,
        tissue: &Tissue,
        places: &[Vec<usize>],
    ) -> Result<(Vec<Vec<f64>>, Tissue), Error> {
        let begin = self.law.start();
        let mut of = tissue.clone();
        let mut halvings = 0;
        loop {
            let each = self.pressed.iter().zip(places);
            let factors = each.map(|(pressed, places)| self.factor(&of, pressed, places));
            match factors.collect::<Result<Vec<_>, _>>() {
                Err(Error::NotSolved { .. }) if halvings < HALVINGS => {
                    halvings += 1;
                    for (shape, begin) in of.shape.iter_mut().zip(&begin) {
                        *shape = 0.5 * (*shape + begin);
                    }
                }
                factors => return Ok((factors?, of)),
            }
        }
    }

    /// The force of a full run over the product of the elastic force on the same mesh and G(t), at each sample of
    /// `pressed` [-]; runs go through those at `places`.
    fn factor(
        &self,
        tissue: &Tissue,
        pressed: &Pressed,
        places: &[usize],
    ) -> Result<Vec<f64>, Error> {
        let times: Vec<f64> = places
            .iter()
            .map(|&i| pressed.time[i] - pressed.time[0])
            .collect();
        let depths: Vec<f64> = places.iter().map(|&i| pressed.depth[i]).collect();
        let mut ascending = depths.clone();
        ascending.sort_by(f64::total_cmp);
        let elastic = self.run(tissue, &PronySeries::default(), &ascending, &ascending)?;
        let full = self.run(tissue, &tissue.series, &times, &depths)?;
        let product = IndentationCurve::through(&ascending, &elastic);
        let product = product.relaxed(&tissue.series, &times, &depths);
        let factor = depths.iter().zip(full.iter().zip(product));
        let factor: Vec<f64> = factor
            .map(|(depth, (full, product))| {
                let has_force = *depth >= MIN_DEPTH * self.deepest && product > 0.0;
                if has_force { full / product } else { 1.0 }
            })
            .collect();
        Ok(at_samples(pressed, places, &factor))
    }

    /// Forces [N] of a run through depths [m] at times [s].
    fn run(
        &self,
        tissue: &Tissue,
        prony: &PronySeries,
        times: &[f64],
        depths: &[f64],
    ) -> Result<Vec<f64>, Error> {
        let Body::Block { block, indenter } = self.body else {
            return Err(Error::NoLoop);
        };
        let mut run = IndentationRun::new(&IndentationSettings {
            block,
            indenter,
            law: self.law.of(tissue.modulus, &tissue.shape)?,
            prony: prony.clone(),
            deepest: self.deepest,
            halvings: 0,
        })?;
        let press = |(&time, &depth): (&f64, &f64)| {
            let point = run.press(time, depth, |_| ());
            let point = point.map_err(|why| Error::of_law(self.law.name(), self.deepest, why))?;
            Ok(point.force)
        };
        times.iter().zip(depths).map(press).collect()
    }
}

/// The samples of a run: where the depth has moved by a step, where it begins or ceases to move, and
/// at ever longer times of a hold.
fn run_samples(pressed: &Pressed) -> Result<Vec<usize>, Error> {
    let (time, depth) = (&pressed.time, &pressed.depth);
    let deepest = pressed.deepest();
    let moves = |place: usize| {
        place + 1 < depth.len() && (depth[place + 1] - depth[place]).abs() > RESTS * deepest
    };
    let (mut kept, mut moved) = (vec![0], 0);
    for place in 1..time.len() {
        let before = kept[kept.len() - 1];
        let is_step = (depth[place] - depth[before]).abs() >= deepest / STEPS;
        let turns = moves(place - 1) != moves(place);
        if moves(place - 1) {
            moved = place;
        }
        let rests =
            !moves(place) && time[place] - time[before] >= PART * (time[place] - time[moved]);
        if is_step || turns || rests || place + 1 == time.len() {
            kept.push(place);
        }
    }
    if kept.len() > MAX_SAMPLES {
        return Err(Error::LoopMovesTooLong {
            samples: kept.len(),
            most: MAX_SAMPLES,
        });
    }
    Ok(kept)
}

/// What is known at `places`, at every sample: linear over time in between.
fn at_samples(pressed: &Pressed, places: &[usize], values: &[f64]) -> Vec<f64> {
    let time = &pressed.time;
    let mut next = 0;
    let mut at = |sample: usize| {
        while next + 1 < places.len() && places[next] < sample {
            next += 1;
        }
        let before = next.saturating_sub(1);
        let [from, to] = [before, next].map(|place| time[places[place]]);
        let part = if to > from {
            (time[sample] - from) / (to - from)
        } else {
            1.0
        };
        values[before] + part * (values[next] - values[before])
    };
    (0..time.len()).map(&mut at).collect()
}

/// Forces of the product become those of the full runs.
fn multiply(forces: &mut [Vec<f64>], factors: &[Vec<f64>]) {
    let each = forces.iter_mut().zip(factors);
    for (force, by) in each.flat_map(|(forces, factor)| forces.iter_mut().zip(factor)) {
        *force *= by;
    }
}

fn divide(pressed: &mut Pressed, factor: &[f64]) {
    let largest = |force: &[f64]| force.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let before = largest(&pressed.force);
    pressed
        .force
        .iter_mut()
        .zip(factor)
        .for_each(|(force, by)| *force /= by);
    // Of the filtered force, which is divided alike.
    pressed.largest *= largest(&pressed.force) / before;
}
