use palpate_characterize::clean::SegmentKind;
use palpate_characterize::lumped::{FittedPiece, PieceLoading};
use palpate_characterize::{CleanRecording, FittedRecording, FittedRelaxation};

use super::super::finished::Studied;
use super::{DrawnCurve, DrawnFit, DrawnRecording, DrawnRelaxation, LEVEL, key};
use crate::plot::thinned_indices;

/// The recordings of a specimen.
pub(crate) fn drawn(studied: &Studied) -> Vec<DrawnRecording> {
    let mut fitted = studied
        .found
        .fitted(&studied.recordings, LEVEL)
        .into_iter()
        .peekable();
    let is_piece = !studied.found.uniaxial.is_empty();
    let recordings = studied.recordings.iter().zip(&studied.files).enumerate();
    let each = recordings.map(|(place, (recording, file))| {
        let own = fitted.next_if(|fitted| fitted.place == place);
        DrawnRecording {
            file: file.display().to_string(),
            digest: studied.digests[place].clone(),
            fitted: own.and_then(|own| drawn_fit(recording, &own, is_piece, thinned_indices)),
            ..alone(recording)
        }
    });
    each.collect()
}

fn alone(recording: &CleanRecording) -> DrawnRecording {
    let chosen = thinned_indices(&recording.time, &recording.depth, &recording.force);
    let handling = &recording.handling;
    let contact = handling.contact;
    let last = recording.time.len().saturating_sub(1);
    let segments = recording.segments.iter().map(|own| {
        let span = [own.first, own.end].map(|sample| recording.time[sample.min(last)]);
        (kind(own.kind), span)
    });
    DrawnRecording {
        file: String::new(),
        digest: String::new(),
        samples: recording.time.len(),
        rate_hz: handling.sampling.rate_hz,
        cutoff_hz: handling.cutoff_hz,
        contact: (contact.time_s, contact.depth_m, contact.depth_error_m),
        segments: segments.collect(),
        time: some(&recording.time, &chosen),
        depth: some(&recording.depth, &chosen),
        force: some(&recording.force, &chosen),
        filtered_force: some(&recording.filtered_force, &chosen),
        fitted: None,
    }
}

fn some(values: &[f64], chosen: &[usize]) -> Vec<f64> {
    chosen.iter().map(|&sample| values[sample]).collect()
}

fn kind(kind: SegmentKind) -> String {
    match kind {
        SegmentKind::Ramp => "ramp".to_owned(),
        SegmentKind::Hold => "hold".to_owned(),
        SegmentKind::Retreat => "retreat".to_owned(),
        SegmentKind::Sine(frequency) => format!("sine of {frequency:.3} Hz"),
        SegmentKind::Chirp(from, to) => format!("chirp from {from:.3} to {to:.3} Hz"),
    }
}

/// The fit of each recording of a specimen, with its file, at every sample.
pub(crate) fn all_samples(studied: &Studied) -> Vec<(String, DrawnFit)> {
    let fitted = studied.found.fitted(&studied.recordings, LEVEL).into_iter();
    let is_piece = !studied.found.uniaxial.is_empty();
    let every = |time: &[f64], _: &[f64], _: &[f64]| (0..time.len()).collect();
    let each = fitted.filter_map(|own| {
        let file = studied.files[own.place].display().to_string();
        let drawn = drawn_fit(&studied.recordings[own.place], &own, is_piece, every)?;
        Some((file, drawn))
    });
    each.collect()
}

/// A recording with its fit, at the samples that `select` chooses from time, course and measured values.
fn drawn_fit(
    recording: &CleanRecording,
    fitted: &FittedRecording,
    is_piece: bool,
    select: impl Fn(&[f64], &[f64], &[f64]) -> Vec<usize>,
) -> Option<DrawnFit> {
    let of = |values: &[f64]| values.get(fitted.samples.clone()).map(<[f64]>::to_vec);
    let time = of(&recording.time)?;
    let (course, measured) = match is_piece {
        true => FittedPiece::of(recording)
            .ok()
            .map(|own| (own.stretches, own.stresses))?,
        false => (of(&recording.depth)?, of(&recording.force)?),
    };
    let chosen = select(&time, &course, &measured);
    let laws = fitted.laws.iter().map(|law| DrawnCurve {
        law: key(law.law),
        values: some(&law.values, &chosen),
        reach: some(&law.reach, &chosen),
    });
    let loading = is_piece.then(|| PieceLoading::of(&recording.header));
    Some(DrawnFit {
        test: loading.map(|own| own.test),
        fibre_axis_angle_deg: loading.and_then(|own| own.fibre_axis_angle_deg),
        laws: laws.collect(),
        relaxation: fitted
            .relaxation
            .as_ref()
            .map(|own| relaxation(own, &time, &chosen)),
        time: some(&time, &chosen),
        course: some(&course, &chosen),
        measured: some(&measured, &chosen),
        is_piece,
    })
}

fn relaxation(own: &FittedRelaxation, time: &[f64], chosen: &[usize]) -> DrawnRelaxation {
    let first = time.len() - own.of_step.len();
    let after = chosen.iter().filter(|&&sample| sample >= first);
    DrawnRelaxation {
        measured: some(&own.measured, chosen),
        fitted: some(&own.fitted, chosen),
        of_step: after
            .map(|&sample| (time[sample], own.of_step[sample - first]))
            .collect(),
    }
}
