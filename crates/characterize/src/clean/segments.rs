//! Segments of the stimulus, found in the depth.
//!
//! A part that swings evenly is a sine or a chirp ([`swing`](super::swing)). Every other part is approximated
//! by the fewest straight lines that stay within 1.5 % of the travel of it (the depth's noise allowed
//! for); a line that goes nowhere is a hold.
//!
//! *How we know*: `segments::…`, on made-up stimuli with known corners.
//!
//! *Limits*: a stimulus that changes its frequency in steps and without a pause is read as ramps and
//! retreats.

use std::ops::Range;

use super::{Segment, SegmentKind, noise, swing};

/// How far from a straight line the depth may lie, in parts of its travel [-].
const STRAIGHT: f64 = 0.015;
/// How far it must turn to swing, in parts of its travel [-].
const SWINGING: f64 = 0.03;
/// What noise may do, in its standard deviations [-].
const NOISY: f64 = 5.0;
/// What an encoder may do, in its steps [-].
const STEPS: f64 = 2.0;

/// The segments of `depth` [m] at `time` [s] from the sample `from` on. A rest out of the tissue is
/// none.
pub(crate) fn find(time: &[f64], depth: &[f64], from: usize) -> Vec<Segment> {
    let low = depth[from..].iter().copied().fold(f64::INFINITY, f64::min);
    let high = depth[from..]
        .iter()
        .copied()
        .fold(f64::NEG_INFINITY, f64::max);
    // One that starts in contact has travelled all the way to there.
    let travel = (high - low).max(high);
    let trembling = (NOISY * noise::deviation(depth)).max(STEPS * noise::step(depth));
    let scales = Scales {
        straight: (STRAIGHT * travel).max(trembling),
        swinging: (SWINGING * travel).max(2.0 * trembling),
    };
    let mut segments = Vec::new();
    scales.divide(time, depth, from..depth.len(), &mut segments);
    segments
}

struct Scales {
    straight: f64,
    swinging: f64,
}

impl Scales {
    fn divide(&self, time: &[f64], depth: &[f64], part: Range<usize>, found: &mut Vec<Segment>) {
        let within = swing::find(&time[part.clone()], &depth[part.clone()], self.swinging);
        let Some(swing) = within else {
            self.draw(time, depth, part, found);
            return;
        };
        let [first, end] = [swing.samples.start, swing.samples.end].map(|own| own + part.start);
        let [one, other] = swing.frequencies;
        let kind = if one == other {
            SegmentKind::Sine(one)
        } else {
            SegmentKind::Chirp(one, other)
        };
        self.divide(time, depth, part.start..first, found);
        found.push(Segment { kind, first, end });
        self.divide(time, depth, end..part.end, found);
    }

    /// Draws a part by straight lines.
    fn draw(&self, time: &[f64], depth: &[f64], part: Range<usize>, found: &mut Vec<Segment>) {
        if part.is_empty() {
            return;
        }
        let corners = corners(time, depth, part.clone(), self.straight);
        let before = found.len();
        for pair in corners.windows(2) {
            let way = depth[pair[1]] - depth[pair[0]];
            let kind = if way > 2.0 * self.straight {
                SegmentKind::Ramp
            } else if way < -2.0 * self.straight {
                SegmentKind::Retreat
            } else {
                SegmentKind::Hold
            };
            match found[before..].last_mut() {
                Some(last) if last.kind == kind => last.end = pair[1],
                _ => found.push(Segment {
                    kind,
                    first: pair[0],
                    end: pair[1],
                }),
            }
        }
        if let Some(last) = found[before..].last_mut() {
            last.end = part.end;
        }
        let out = 2.0 * self.straight;
        found.retain(|own| {
            let rests = own.kind == SegmentKind::Hold;
            !(rests && depth[own.first..own.end].iter().all(|d| *d <= out))
        });
    }
}

/// The samples at which the line is broken [Douglas and Peucker 1973], the ends included.
fn corners(time: &[f64], depth: &[f64], part: Range<usize>, tolerance: f64) -> Vec<usize> {
    let mut corners = vec![part.start, part.end - 1];
    let mut open = vec![(part.start, part.end - 1)];
    while let Some((first, last)) = open.pop() {
        let slope = (depth[last] - depth[first]) / (time[last] - time[first]);
        let away = |sample: usize| {
            (depth[sample] - depth[first] - slope * (time[sample] - time[first])).abs()
        };
        let farthest = (first + 1..last).max_by(|a, b| away(*a).total_cmp(&away(*b)));
        if let Some(corner) = farthest.filter(|corner| away(*corner) > tolerance) {
            corners.push(corner);
            open.extend([(first, corner), (corner, last)]);
        }
    }
    corners.sort_unstable();
    corners
}
