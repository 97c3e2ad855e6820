use palpate_files::Recording;

use super::noise;

/// The samples with depth growing into the tissue and force growing as it is pressed.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Oriented {
    pub(super) time: Vec<f64>,
    pub(super) depth: Vec<f64>,
    pub(super) force: Vec<f64>,
    /// Factors on depth and force, 1 or −1 [-].
    pub(super) signs: [f64; 2],
}

/// Part of the way from which the indenter counts as being where it went [-].
const THERE: f64 = 0.8;

impl Oriented {
    /// Turns the signs of another program's depth and force where they are the other way round.
    pub(super) fn new(recording: &Recording, warnings: &mut Vec<String>) -> Self {
        let (depth, force) = (recording.depth_m(), recording.force_n());
        let signs = if recording.is_foreign() {
            signs(depth, force)
        } else {
            [1.0, 1.0]
        };
        for (sign, what) in signs.iter().zip(["depth", "force"]) {
            if *sign < 0.0 {
                warnings.push(format!(
                    "the {what} fell as the indenter pressed, so its sign was turned"
                ));
            }
        }
        let times = |values: &[f64], sign: f64| values.iter().map(|value| sign * value).collect();
        Self {
            time: recording.time_s().to_vec(),
            depth: times(depth, signs[0]),
            force: times(force, signs[1]),
            signs,
        }
    }
}

/// Signs of the way and of the force where the indenter is farthest from its start.
fn signs(depth: &[f64], force: &[f64]) -> [f64; 2] {
    let first = |values: &[f64]| noise::median(&values[..values.len().min(3)]);
    let (from, before) = (first(depth), first(force));
    let farthest = depth.iter().map(|d| (d - from).abs()).fold(0.0, f64::max);
    let is_there = |d: &f64| (d - from).abs() >= THERE * farthest && farthest > 0.0;
    let there = |values: &[f64]| -> Vec<f64> {
        let both = depth.iter().zip(values);
        both.filter(|(d, _)| is_there(d))
            .map(|(_, value)| *value)
            .collect()
    };
    let way = noise::median(&there(depth)) - from;
    let rise = noise::median(&there(force)) - before;
    [way, rise].map(|change| if change < 0.0 { -1.0 } else { 1.0 })
}
