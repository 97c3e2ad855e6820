//! Comparison of the stimulus in the header with the recorded depth.

use palpate_files::recording::StimulusKind;

use super::swing::Sine;
use super::{CleanRecording, Segment, SegmentKind};

/// A number of the header may differ from what is seen by this part [-].
const ALIKE: f64 = 0.1;
/// Depth [m] and frequency [Hz] beyond which the source's measurements do not go.
const DEEPEST: f64 = 0.01;
const FASTEST: f64 = 8.0;

pub(super) fn add_warnings(clean: &CleanRecording, warnings: &mut Vec<String>) {
    warn_of_kind(clean, warnings);
    let mut compare = |what: &str, said: Option<f64>, seen: Option<f64>, slack: f64| {
        let (Some(said), Some(seen)) = (said, seen) else {
            return;
        };
        if (said - seen).abs() > (ALIKE * said.abs()).max(slack) {
            warnings.push(format!(
                "`{what}` is {said}, but the samples show {seen:.4}"
            ));
        }
    };
    let header = &clean.header;
    let usual = 1.0 / clean.handling.sampling.rate_hz;
    let first =
        |wanted: fn(&SegmentKind) -> bool| clean.segments.iter().find(|own| wanted(&own.kind));
    let ramp = first(|kind| *kind == SegmentKind::Ramp);
    compare(
        "ramp_s",
        header.ramp_s,
        ramp.map(|own| clean.duration(own)),
        3.0 * usual,
    );
    compare(
        "sample_rate_hz",
        header.sample_rate_hz,
        Some(1.0 / usual),
        0.0,
    );
    if let Some(swing) = first(|kind| matches!(kind, SegmentKind::Sine(_) | SegmentKind::Chirp(..)))
    {
        let [middle, amplitude] = middle_and_amplitude(clean, swing);
        let (begins, ends) = match swing.kind {
            SegmentKind::Chirp(begins, ends) => (Some(begins), Some(ends)),
            SegmentKind::Sine(only) => (Some(only), None),
            _ => (None, None),
        };
        compare("amplitude_m", header.amplitude_m, Some(amplitude), 0.0);
        compare(
            "pre_indentation_m",
            header.pre_indentation_m,
            Some(middle),
            0.0,
        );
        compare("frequency_hz", header.frequency_hz, begins, 0.0);
        compare("end_frequency_hz", header.end_frequency_hz, ends, 0.0);
    } else if let Some(hold) = first(|kind| *kind == SegmentKind::Hold) {
        let depths = &clean.depth[hold.first..hold.end];
        let mean = depths.iter().sum::<f64>() / depths.len() as f64;
        compare("amplitude_m", header.amplitude_m, Some(mean), 0.0);
    }
    warn_of_extent(clean, warnings);
}

fn warn_of_kind(clean: &CleanRecording, warnings: &mut Vec<String>) {
    let shows =
        |wanted: fn(&SegmentKind) -> bool| clean.segments.iter().any(|own| wanted(&own.kind));
    let swings = shows(|kind| matches!(kind, SegmentKind::Sine(_)));
    let sweeps = shows(|kind| matches!(kind, SegmentKind::Chirp(..)));
    let (is_so, looks) = match clean.header.stimulus {
        Some(StimulusKind::Sine) => (swings, "no steady swing"),
        Some(StimulusKind::ChirpLinear | StimulusKind::ChirpExponential) => {
            (sweeps, "no swing of changing frequency")
        }
        Some(StimulusKind::RampAndHold) => (
            shows(|kind| *kind == SegmentKind::Hold) && !swings && !sweeps,
            "no ramp with a hold alone",
        ),
        _ => return,
    };
    if let Some(stimulus) = clean.header.stimulus.filter(|_| !is_so) {
        warnings.push(format!(
            "`stimulus` is {stimulus}, but the depth shows {looks}"
        ));
    }
}

/// Depths and frequencies for which the source has nothing to compare with.
fn warn_of_extent(clean: &CleanRecording, warnings: &mut Vec<String>) {
    let deepest = clean.depth.iter().copied().fold(0.0, f64::max);
    if deepest > DEEPEST && !clean.is_piece() {
        warnings.push(format!(
            "the depth goes to {:.1} mm, beyond 10 mm",
            1e3 * deepest
        ));
    }
    let fastest = clean.segments.iter().map(|own| match own.kind {
        SegmentKind::Sine(frequency) => frequency,
        SegmentKind::Chirp(first, last) => first.max(last),
        _ => 0.0,
    });
    let fastest = fastest.fold(0.0, f64::max);
    if fastest > FASTEST {
        warnings.push(format!("the stimulus goes to {fastest:.1} Hz, beyond 8 Hz"));
    }
}

/// Depth around which the indenter swings and how far [m].
fn middle_and_amplitude(clean: &CleanRecording, swing: &Segment) -> [f64; 2] {
    let samples = swing.first..swing.end;
    let depth = &clean.depth[samples.clone()];
    if let SegmentKind::Sine(frequency) = swing.kind
        && let Some(sine) = Sine::fit(&clean.time[samples], depth, frequency)
    {
        return [sine.mean, sine.amplitude()];
    }
    let low = depth.iter().copied().fold(f64::INFINITY, f64::min);
    let high = depth.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [0.5 * (low + high), 0.5 * (high - low)]
}
