//! Decrease of the force during a hold.
//!
//! *Steady* is the mean of the last tenth of the hold, whatever its length; no curve is drawn beyond
//! the end. When the hold is too short for that to be steady the force still falls, and a warning says
//! by how much. *Peak* is the largest force of the ramp before the hold and of the hold. The force
//! has *settled* at the first time after which it stays within 10 % of steady; that is read from the
//! filtered force, all else from the force as measured.
//!
//! *How we know*: `relaxation::…`, against Prony series.
//!
//! *Limits*: the peak is the largest of noisy samples, above the truth by two or three deviations of
//! their noise.

use crate::CleanRecording;
use crate::clean::{Segment, SegmentKind};

/// Part of the hold that is taken as steady, at its end [-].
const STEADY: f64 = 0.1;
/// How near to steady is settled [-].
const SETTLED: f64 = 0.1;
/// How much the force may fall over the last third of a hold to be called steady [-].
const STILL: f64 = 0.03;

/// A depth at which the indenter stayed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hold {
    /// When it began [s], from first contact.
    pub start_s: f64,
    /// How long it lasted [s].
    pub duration_s: f64,
    /// Mean depth over its last tenth [m].
    pub depth_m: f64,
    /// Mean force over its last tenth [N].
    pub steady_n: f64,
    /// How much the force still fell over its last third, over the steady force [-].
    pub still_falling: f64,
}

/// Relaxation in a hold.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Relaxation {
    /// The largest force of the hold and the ramp before it [N].
    pub peak_n: f64,
    /// Mean force over the last tenth of the hold [N].
    pub steady_n: f64,
    /// Steady over peak [-].
    pub ratio: f64,
    /// The first time after which force stays within 10 % of steady [s], from first contact.
    pub settle_s: f64,
    /// When the hold began [s], from first contact.
    #[serde(skip)]
    pub hold_start_s: f64,
    /// How long it lasted [s].
    pub hold_s: f64,
}

/// Every hold of a recording.
pub(crate) fn holds(recording: &CleanRecording, warnings: &mut Vec<String>) -> Vec<Hold> {
    let segments = recording.segments.iter();
    let holds: Vec<_> = segments
        .filter(|own| own.kind == SegmentKind::Hold)
        .map(|own| hold(recording, own))
        .collect();
    for hold in &holds {
        if hold.still_falling > STILL {
            warnings.push(format!(
                "the hold at {:.2} mm ends before the force is steady: it still fell by {:.0} % over its last third, \
                 so the steady force is an upper bound; hold for longer",
                1e3 * hold.depth_m,
                1e2 * hold.still_falling
            ));
        }
    }
    holds
}

/// Relaxation in the longest hold.
pub(super) fn longest(
    recording: &CleanRecording,
    warnings: &mut Vec<String>,
) -> Option<Relaxation> {
    let segments = &recording.segments;
    let duration = |own: &usize| recording.duration(&segments[*own]);
    let Some(place) = (0..segments.len())
        .filter(|own| segments[*own].kind == SegmentKind::Hold)
        .max_by(|a, b| duration(a).total_cmp(&duration(b)))
    else {
        warnings.push("the indenter never stays, so there is no relaxation to tell".to_owned());
        return None;
    };
    let own = segments[place];
    let Hold {
        steady_n,
        start_s,
        duration_s,
        ..
    } = hold(recording, &own);
    let before = place.checked_sub(1).map(|before| segments[before]);
    let rise = before.filter(|before| before.kind == SegmentKind::Ramp);
    let first = rise.map_or(own.first, |ramp| ramp.first);
    let forces = &recording.force[first..own.end];
    let peak_n = forces.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if peak_n <= 0.0 || steady_n <= 0.0 {
        warnings.push("the force of the hold is not above that before contact, so there is no relaxation to tell".to_owned());
        return None;
    }
    let is_off = |force: &f64| (force - steady_n).abs() > SETTLED * steady_n.abs();
    let filtered = &recording.filtered_force[own.first..own.end];
    let settled = own.first + filtered.iter().rposition(is_off).map_or(0, |last| last + 1);
    Some(Relaxation {
        peak_n,
        steady_n,
        ratio: steady_n / peak_n,
        settle_s: recording.time[settled.min(own.end - 1)],
        hold_start_s: start_s,
        hold_s: duration_s,
    })
}

fn hold(recording: &CleanRecording, own: &Segment) -> Hold {
    let time = &recording.time;
    let (start, end) = (time[own.first], time[own.end - 1]);
    let since = |share: f64| {
        let from = end - share * (end - start);
        own.first + time[own.first..own.end].partition_point(|t| *t < from)
    };
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let last = since(STEADY)..own.end;
    let third = since(1.0 / 3.0)..since(1.0 / 3.0 - STEADY).max(since(1.0 / 3.0) + 1);
    let steady_n = mean(&recording.force[last.clone()]);
    let fell = mean(&recording.force[third.start..third.end.min(own.end)]) - steady_n;
    Hold {
        start_s: start,
        duration_s: end - start,
        depth_m: mean(&recording.depth[last]),
        steady_n,
        still_falling: if steady_n > 0.0 { fell / steady_n } else { 0.0 },
    }
}
