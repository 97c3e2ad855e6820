use palpate_characterize::CleanRecording;
use palpate_characterize::analyze::Sinusoid;

use super::swing::{NOTE, ORGANS, Organ};
use crate::Error;
use crate::row::Value;
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const FIGURE_5_15: Item = Item {
    name: "figure-5-15",
    title: "response to a swing of 2 Hz: force over time and over depth",
    seconds: 2.3,
    run,
};

const FREQUENCY: f64 = 2.0;

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let (mut loops, mut widths, mut courses) = (Vec::new(), Vec::new(), Vec::new());
    for (color, name) in ORGANS.into_iter().enumerate() {
        let Some(organ) = Organ::printed(name)? else {
            rows.add_missing(name, "N", "no law is printed");
            continue;
        };
        let (recording, found) = organ.swung(FREQUENCY)?;
        let Some(found) = found else {
            rows.add_missing(name, "N", "no swing is seen in the recording");
            continue;
        };
        add(rows, name, &found);
        let drawn = |points| Series {
            name: name.to_owned(),
            points,
            style: Style::Line,
            color,
        };
        let [over_depth, over_time] = one_period(&recording, &found);
        widths.push(drawn(without_line(&over_depth)));
        loops.push(drawn(over_depth));
        courses.push(drawn(over_time));
    }
    let plot = |[x_label, y_label]: [&str; 2], series| Plot {
        title: "Response to a swing of 2 Hz about 2 mm".to_owned(),
        x_label: x_label.to_owned(),
        y_label: y_label.to_owned(),
        series,
        ..Plot::default()
    };
    let note = "the last period but one, after the filter; the area is what is lost in it";
    let labels = ["depth [mm]", "force [mN]"];
    rows.add_figure(None, &plot(labels, loops), note)?;
    let wide = "the same less the line through it, which leaves the loops wide enough to be seen";
    let labels = ["depth [mm]", "force less the line through it [mN]"];
    rows.add_figure(Some("width"), &plot(labels, widths), wide)?;
    let labels = ["time [s]", "force [mN]"];
    rows.add_figure(Some("time"), &plot(labels, courses), note)
}

/// Points less the line that comes nearest to them.
fn without_line(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let [x, y] = [mean(|point| point.0), mean(|point| point.1)];
    let products = points.iter().map(|point| (point.0 - x) * (point.1 - y));
    let squares = points.iter().map(|point| (point.0 - x).powi(2));
    let slope = products.sum::<f64>() / squares.sum::<f64>();
    let less = |point: &(f64, f64)| (point.0, point.1 - y - slope * (point.0 - x));
    points.iter().map(less).collect()
}

fn add(rows: &mut Rows<'_>, name: &str, found: &Sinusoid) {
    let numbers = [
        ("stiffness", found.stiffness_n_per_m, "N/m"),
        ("phase", found.phase_rad, "rad"),
        ("hysteresis", found.hysteresis_j, "J"),
    ];
    for (word, ours, unit) in numbers {
        rows.add(&format!("{name}/{word}"), Value::own(ours, unit), NOTE);
    }
}

/// Filtered force [mN] over depth [mm] and over time [s] in the last period but one: the filter has no neighbours
/// at the end.
fn one_period(recording: &CleanRecording, found: &Sinusoid) -> [Vec<(f64, f64)>; 2] {
    let period = 1.0 / found.frequency_hz;
    let start = recording.time[found.end - 1] - 2.0 * period;
    // Whatever the last digits of the times are.
    let within = |&i: &usize| (-1e-6..=period + 1e-6).contains(&(recording.time[i] - start));
    let last: Vec<usize> = (found.first..found.end).filter(within).collect();
    let force = |i: usize| 1e3 * recording.filtered_force[i];
    let over_depth = |&i: &usize| (1e3 * recording.depth[i], force(i));
    let over_time = |&i: &usize| (recording.time[i] - start, force(i));
    [
        last.iter().map(over_depth).collect(),
        last.iter().map(over_time).collect(),
    ]
}
