//! The law of one specimen with full viscoelastic runs of finite elements in the loop (6.15).
//!
//! The fit takes force for the product of an elastic force and G(t). A full run with internal variables says by which
//! factor that is off at each time, for the tissue that was found; the measured force is divided by it and fitted
//! again, until the tissue stays. There the full run is as near to the measured force as the product to the divided one.
//! So a round takes one run for each recording, and no run for a derivative.
//!
//! *How we know*: `in_loop::…`: full runs of known tissue, off the table's grid.
//!
//! *Limits*: solid specimens; a recording that moves all the time takes a run of as many steps, and is refused.

use std::ops::Range;

use palpate_mechanics::PronySeries;
use palpate_mechanics::finite_elements::indentation::{IndentationRun, IndentationSettings};

use super::{Characterization, CharacterizeSettings, Pressed, body, characterize};
use crate::inverse::{Body, Curves, SoughtLaw};
use crate::{CleanRecording, Error};

/// Rounds at most.
const ROUNDS: usize = 5;
/// Change of every parameter below which the tissue stays [-]: less than the elements are off.
const SETTLED: f64 = 2e-3;
/// Steps of depth that a run takes, at least, and parts of the time since the depth last changed.
const STEPS: f64 = 24.0;
const PART: f64 = 0.15;
/// A change of depth between two samples below which the indenter rests, over the largest depth [-].
const RESTS: f64 = 1e-3;
/// Samples of a run at most: some minutes.
const MOST_SAMPLES: usize = 400;
/// Depth from which a factor is taken, over the largest [-]: before it there is hardly a force.
const FELT: f64 = 0.05;

/// Characterizes one specimen by `law`, with full runs of finite elements in the loop; `at_step` hears what is being
/// done.
///
/// # Errors
/// When the law or the relaxation is not found, the organ is hollow, a recording moves for too long, or a run finds
/// no equilibrium.
pub fn characterize_in_loop(
    recordings: &[CleanRecording],
    law: SoughtLaw,
    settings: &CharacterizeSettings,
    at_step: &mut dyn FnMut(&'static str),
) -> Result<Characterization, Error> {
    let quick = CharacterizeSettings {
        laws: vec![law],
        draws: None,
        ..settings.clone()
    };
    let last = CharacterizeSettings {
        draws: settings.draws,
        ..quick.clone()
    };
    let mut found = characterize(recordings, &quick, at_step);
    let mut solves = 0;
    for _ in 0..ROUNDS {
        let before = Tissue::of(&found)?;
        at_step("finite elements");
        let mut divided = recordings.to_vec();
        for recording in &mut divided {
            solves += divide(recording, (law, &before), recordings)?;
        }
        found = characterize(&divided, &quick, at_step);
        if Tissue::of(&found)?.is_like(&before) {
            let mut found = characterize(&divided, &last, at_step);
            for (_, law) in &mut found.laws {
                if let Ok(law) = law {
                    law.found.solves += solves;
                }
            }
            return Ok(found);
        }
    }
    Err(Error::LoopDoesNotSettle { rounds: ROUNDS })
}

/// What a run needs of what was found.
struct Tissue {
    modulus: f64,
    shape: f64,
    series: PronySeries,
    parameters: Vec<f64>,
}

impl Tissue {
    fn of(found: &Characterization) -> Result<Self, Error> {
        let relaxation = found.relaxation.as_ref().map_err(Clone::clone)?;
        let (_, law) = found.laws.first().ok_or(Error::NothingFelt)?;
        let law = law.as_ref().map_err(Clone::clone)?;
        let own = law.parameters.iter().map(|(_, known)| known.value);
        Ok(Self {
            modulus: law.found.modulus(),
            shape: law.found.shape(),
            series: relaxation.series.clone(),
            parameters: own.collect(),
        })
    }

    /// Whether it has the parameters of `other`, as far as they matter: of two moduli against their sum.
    fn is_like(&self, other: &Self) -> bool {
        let size: f64 = self.parameters.iter().map(|value| value.abs()).sum();
        let each = self.parameters.iter().zip(&other.parameters);
        let mut off = each.map(|(own, other)| (own - other).abs());
        off.all(|off| off <= SETTLED * size)
    }
}

/// Divides the force of `recording` by what the product of an elastic force and G(t) is off for `tissue`; answers the
/// number of runs.
fn divide(
    recording: &mut CleanRecording,
    (law, tissue): (SoughtLaw, &Tissue),
    all: &[CleanRecording],
) -> Result<usize, Error> {
    let (Some(samples), Some(pressed)) = (Pressed::samples(recording), Pressed::of(recording))
    else {
        return Ok(0);
    };
    if !pressed.is_felt() {
        return Ok(0);
    }
    let deepest = all.iter().filter_map(Pressed::of);
    let deepest = deepest.map(|own| own.deepest()).fold(0.0, f64::max);
    let body = body(all, deepest)?;
    let Body::Block { block, indenter } = body else {
        return Err(Error::LoopOfTube);
    };
    let kept = kept(&pressed)?;
    let mut run = IndentationRun::new(&IndentationSettings {
        block,
        indenter,
        law: law.of(tissue.modulus, tissue.shape)?,
        prony: tissue.series.clone(),
        deepest,
        halvings: 0,
    })?;
    let mut curves = Curves::new(body, law, deepest);
    let curve = curves.of(f64::INFINITY, tissue.shape)?;
    let elastic = curve.force.scaled(1.0, tissue.modulus);
    let of = |values: &[f64]| -> Vec<f64> { kept.iter().map(|&place| values[place]).collect() };
    let product = elastic.relaxed(&tissue.series, &of(&pressed.time), &of(&pressed.depth));
    let mut factors = Vec::with_capacity(kept.len());
    for (&place, product) in kept.iter().zip(product) {
        let depth = pressed.depth[place];
        let time = pressed.time[place] - pressed.time[0];
        let point = run.press(time, depth, |_| ());
        let point = point.map_err(|why| Error::of_law(law.name(), deepest, why))?;
        let full = point.force * curves.mesh_correction(depth)?;
        let is_felt = depth >= FELT * deepest && product > 0.0;
        factors.push((
            pressed.time[place],
            if is_felt { full / product } else { 1.0 },
        ));
    }
    scale(recording, samples, &factors);
    Ok(1 + curves.solves())
}

/// The samples that a run goes through: where the depth has gone on by a step, where it begins or ceases to move, and
/// at ever longer times of a hold.
fn kept(pressed: &Pressed) -> Result<Vec<usize>, Error> {
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
    if kept.len() > MOST_SAMPLES {
        return Err(Error::LoopMovesTooLong {
            samples: kept.len(),
            most: MOST_SAMPLES,
        });
    }
    Ok(kept)
}

/// Divides the forces of `samples` by the factor of their times, linear between those that are known.
fn scale(recording: &mut CleanRecording, samples: Range<usize>, factors: &[(f64, f64)]) {
    let mut next = 0;
    for place in samples {
        let time = recording.time[place];
        while next + 1 < factors.len() && factors[next].0 < time {
            next += 1;
        }
        let (to, after) = factors[next];
        let (from, before) = factors[next.saturating_sub(1)];
        let part = if to > from {
            (time - from) / (to - from)
        } else {
            1.0
        };
        let factor = before + part * (after - before);
        recording.force[place] /= factor;
        recording.filtered_force[place] /= factor;
    }
}
