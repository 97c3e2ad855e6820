//! M2, touch: the error of forces displayed at 1 kHz and computed 60 or 200 times a second (3.4).
//!
//! A hand goes d = 3 + 4 sin(2π f t) mm into F = 0.020 d + 0.0046 d² (N, mm), which is within 0.04 N of the
//! kidney's means in table 5-1, and leaves it in every cycle. The source extrapolates forces to 1 kHz, which is taken as a line in time.

mod study;

use palpate_jobs::plot::{Series, Style};
use palpate_servo::HandOver;

use self::study::{HandOverCost, HandOverStudy};
use crate::Error;
use crate::row::Rows;

/// Rates of the model and of the hand [Hz]: the source's model, and one as slow as a display.
const CASES: [(f64, f64); 5] = [
    (200.0, 1.0),
    (200.0, 2.0),
    (200.0, 5.0),
    (60.0, 2.0),
    (60.0, 5.0),
];

/// The case that is drawn.
const DRAWN: (f64, f64) = (200.0, 2.0);

const KINDS: [(HandOver, &str); 3] = [
    (HandOver::Hold, "hold"),
    (HandOver::Linear, "linear"),
    (HandOver::LocalModel, "local_model"),
];

/// In N/m and N/m².
const KIDNEY: [f64; 2] = [20.0, 4600.0];
const MIDDLE: f64 = 3e-3;
const AMPLITUDE: f64 = 4e-3;

/// What is counted: name and number [%].
type Count = (&'static str, fn(&HandOverCost) -> f64);

const COUNTS: [Count; 3] = [
    ("error", |cost| cost.rms / cost.peak),
    ("largest_error", |cost| cost.max / cost.peak),
    ("energy", |cost| cost.energy / stored()),
];

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut drawn = Vec::new();
    for (what, count) in COUNTS {
        for (model, hand) in CASES {
            for (kind, name) in KINDS {
                let cost = cost(kind, model, hand)?;
                let row = format!("{what}/{name}/model_{model}_hz/hand_{hand}_hz");
                rows.add(&row, 100.0 * count(&cost));
                if what == "error" && (model, hand) == DRAWN {
                    drawn.push(errors(name, &cost, drawn.len()));
                }
            }
        }
    }
    let (model, hand) = DRAWN;
    let figure = rows.figure("").with("model", model).with("hand", hand);
    figure.draw(drawn)
}

/// Errors over two cycles of the hand, in percent of the peak force.
fn errors(name: &str, cost: &HandOverCost, color: usize) -> Series {
    let first = cost.course.first().map_or(0.0, |[time, ..]| *time);
    let shown = cost.course.iter();
    let shown = shown.take_while(|[time, ..]| time - first <= 2.0 / DRAWN.1);
    let points =
        shown.map(|[time, _, made, exact]| (time - first, 100.0 * (made - exact) / cost.peak));
    let name = name.replace('_', " ");
    Series::new(name, points.collect(), Style::Line, color)
}

fn cost(hand_over: HandOver, model: f64, hand: f64) -> Result<HandOverCost, Error> {
    let study = HandOverStudy {
        hand_over,
        model_period: 1.0 / model,
        period: 1e-3,
        middle: MIDDLE,
        amplitude: AMPLITUDE,
        frequency: hand,
        cycles: 20,
    };
    let cost = study.run(kidney);
    cost.map_err(Error::failed)
}

/// Force [N] and stiffness [N/m] at a depth [m].
fn kidney(depth: f64) -> (f64, f64) {
    let [first, second] = KIDNEY;
    (
        first * depth + second * depth * depth,
        first + 2.0 * second * depth,
    )
}

/// Energy stored at the deepest place [J].
fn stored() -> f64 {
    let deepest: f64 = MIDDLE + AMPLITUDE;
    let [first, second] = KIDNEY;
    first * deepest.powi(2) / 2.0 + second * deepest.powi(3) / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::published::cell;

    /// Judge: the published means, whose spread over animals is many times larger.
    #[test]
    fn the_kidney_is_that_of_the_table() {
        for depth_mm in [1, 2, 4, 5, 6, 8] {
            let mean = cell(&format!("table-5-1 kidney {depth_mm} mean_n")).unwrap();
            let (force, _) = kidney(1e-3 * f64::from(depth_mm));
            // Two digits that end at the mean of 8 mm; 0.039 N too low at 5 mm.
            assert!((force - mean).abs() < 0.04, "{depth_mm} mm: {force} {mean}");
        }
    }
}
