use palpate_characterize::CleanRecording;
use palpate_characterize::clean::SegmentKind;
use palpate_characterize::design::{ExpectedCurve, Instrument, Presses};
use palpate_characterize::inverse::{CandidateLaw, ZeroErrors};
use palpate_files::Tissue;
use palpate_files::recording::IndenterShape;

use super::{BARE, DEEPEST, Start, guess};
use crate::characterize::{Choice, Specimen, characterize};
use crate::{Error, ProgressCallback, Recordings};

/// The tissue of first recordings, with their noise, from a fit of them.
pub(super) fn of_recordings(
    recordings: &Recordings,
    law: Option<CandidateLaw>,
    watch: &dyn ProgressCallback,
) -> Result<Start, Error> {
    let choice = Choice {
        law,
        draws: 0,
        ..Choice::default()
    };
    let mut found = characterize(recordings, choice, None, watch)?;
    let [specimen] = found.answer.specimens.as_slice() else {
        return Err(Error::input(format!(
            "there are {} specimens, and a protocol is designed for one; name the recordings of one",
            found.answer.specimens.len()
        )));
    };
    let text = found.tissues.swap_remove(0)?;
    let tissue = Tissue::parse(&text, "the tissue that was found")?;
    let (read, _) = recordings.read(|_| ())?;
    let cleaned: Vec<&CleanRecording> = read.iter().map(|own| &own.clean).collect();
    let before = presses(&cleaned)?;
    let guess = guess(&tissue)?;
    let own = ExpectedCurve::new(guess.clone(), DEEPEST.max(before.deepest() / before.radius))?;
    let instrument = noise_as_found(&own, specimen, &before, instrument(&cleaned))?;
    Ok(Start {
        factors: factors(specimen),
        guess,
        tissue,
        before,
        instrument,
    })
}

/// The presses of the recordings: the depths, and the mean durations of ramps and holds.
fn presses(recordings: &[&CleanRecording]) -> Result<Presses, Error> {
    let first = recordings
        .first()
        .ok_or_else(|| Error::input("there is no recording; name one"))?;
    let header = &first.header;
    if !matches!(header.indenter_shape, None | Some(IndenterShape::Flat)) {
        return Err(Error::input(
            "the indenter is no flat punch, and the rig presses with one; name recordings under a flat punch",
        ));
    }
    let radius = header.indenter_radius_m.ok_or_else(|| {
        Error::input(
            "the recordings do not state `indenter_radius_m`; add --set indenter_radius_m=METRES",
        )
    })?;
    let (mut depths, mut ramps, mut holds) = (Vec::new(), 0.0, 0.0);
    for recording in recordings {
        let hold = recording
            .segments
            .iter()
            .find(|own| own.kind == SegmentKind::Hold)
            .ok_or_else(|| {
                Error::input(
                    "a recording has no hold; name recordings that go to a depth and stay there",
                )
            })?;
        let last = recording.time.len() - 1;
        let [begin, end] = [hold.first, hold.end].map(|place| recording.time[place.min(last)]);
        let held_depths = &recording.depth[hold.first..hold.end];
        depths.push(held_depths.iter().sum::<f64>() / held_depths.len().max(1) as f64);
        ramps += begin.max(1e-3);
        holds += end - begin;
    }
    let count = depths.len() as f64;
    depths.sort_by(f64::total_cmp);
    Ok(Presses {
        radius,
        depths,
        ramp: ramps / count,
        hold: holds / count,
    })
}

/// Noise from one sample to the next, and the uncertainty of the zeros.
fn instrument(recordings: &[&CleanRecording]) -> Instrument {
    let (mut squares, mut count) = (0.0, 0.0);
    let mut zeros = ZeroErrors::default();
    for recording in recordings {
        let steps = recording.force.windows(2).map(|pair| pair[1] - pair[0]);
        squares += steps.map(|step| 0.5 * step * step).sum::<f64>();
        count += recording.force.len() as f64;
        let own = ZeroErrors::of(recording);
        zeros.depth = zeros.depth.max(own.depth);
        zeros.motion = zeros.motion.max(own.motion);
        zeros.force = zeros.force.max(own.force);
        let mut steps = recording
            .depth
            .windows(2)
            .map(|pair| (pair[1] - pair[0]).abs());
        let least = steps
            .by_ref()
            .filter(|step| *step > 0.0)
            .fold(f64::INFINITY, f64::min);
        let moves = recording.depth.windows(2).filter(|pair| pair[0] != pair[1]);
        // Of an encoder, whose value stays most of the time while the indenter moves.
        if least.is_finite() && 4 * moves.count() < recording.depth.len() {
            zeros.depth = zeros.depth.hypot(least / 12.0_f64.sqrt());
        }
    }
    Instrument {
        noise: (squares / f64::max(count, 1.0)).sqrt(),
        rate: recordings[0].handling.sampling.rate_hz,
        zeros,
    }
}

/// Intervals of `specimen` and those expected for the same presses: one factor scales noise and zeros until the two
/// agree in the geometric mean, because correlated noise matters more than that between two samples.
fn noise_as_found(
    own: &ExpectedCurve,
    specimen: &Specimen,
    presses: &Presses,
    instrument: Instrument,
) -> Result<Instrument, Error> {
    let found = found_reaches(specimen);
    let of = |factor: f64| Instrument {
        noise: factor * instrument.noise,
        zeros: ZeroErrors {
            depth: factor * instrument.zeros.depth,
            motion: factor * instrument.zeros.motion,
            force: factor * instrument.zeros.force,
        },
        ..instrument
    };
    let [mut low, mut high] = [1e-2_f64, 1e3];
    for _ in 0..30 {
        let middle = (low * high).sqrt();
        let (expected, ..) = own.expected(presses, &of(middle))?;
        let each = expected.iter().filter_map(|one| {
            let (_, found) = found.iter().find(|(name, _)| *name == one.name)?;
            Some((one.reach() / found).ln())
        });
        match each.sum::<f64>() < 0.0 {
            true => low = middle,
            false => high = middle,
        }
    }
    Ok(of((low * high).sqrt()))
}

/// Half of each fitted interval, over the value [-].
fn found_reaches(specimen: &Specimen) -> Vec<(String, f64)> {
    let law = specimen.preferred().into_iter();
    let law = law.flat_map(|(_, law)| law.parameters.iter());
    let mut all: Vec<_> = law.map(|(name, known)| (name.clone(), known)).collect();
    if let Some(relaxation) = &specimen.relaxation {
        let g = (1..).zip(&relaxation.g);
        all.extend(g.map(|(place, known)| (format!("g_{place}"), known)));
        let tau = (1..).zip(&relaxation.tau_s);
        all.extend(tau.map(|(place, known)| (format!("tau_{place}_s"), known)));
    }
    let reach = all.into_iter().filter_map(|(name, known)| {
        let [low, high] = known.interval_95?;
        Some((name, 0.5 * (high - low) / known.value.abs()))
    });
    reach.filter(|(_, reach)| *reach > 0.0).collect()
}

/// Uncertainty factors of moduli and times: the widest of their intervals, at most that of a bare guess.
fn factors(specimen: &Specimen) -> [f64; 2] {
    let reaches = found_reaches(specimen);
    let widest = |is: &dyn Fn(&str) -> bool| {
        let own = reaches.iter().filter(|(name, _)| is(name));
        own.map(|(_, reach)| 1.0 + reach)
            .fold(1.05, f64::max)
            .min(BARE)
    };
    [
        widest(&|name| name.ends_with("_pa")),
        widest(&|name| name.starts_with("tau_")),
    ]
}
