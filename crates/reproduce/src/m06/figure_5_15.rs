use palpate_characterize::CleanRecording;
use palpate_characterize::analyze::Sinusoid;

use super::swing::{ORGANS, Organ};
use crate::Error;
use crate::row::Rows;
use palpate_jobs::plot::{Series, Style};

const FREQUENCY: f64 = 2.0;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let (mut loops, mut widths, mut courses) = (Vec::new(), Vec::new(), Vec::new());
    for (color, name) in ORGANS.into_iter().enumerate() {
        let (recording, found) = Organ::printed(name)?.swung(FREQUENCY)?;
        let Some(found) = found else {
            rows.row(&format!("{name}/stiffness"))
                .missing("no swing is seen in the recording");
            continue;
        };
        rows.add(&format!("{name}/stiffness"), found.stiffness_n_per_m);
        rows.add(&format!("{name}/phase"), found.phase_rad);
        rows.add(&format!("{name}/hysteresis"), found.hysteresis_j);
        let drawn = |points| Series::new(name, points, Style::Line, color);
        let [over_depth, over_time] = one_period(&recording, &found);
        widths.push(drawn(without_line(&over_depth)));
        loops.push(drawn(over_depth));
        courses.push(drawn(over_time));
    }
    rows.figure("").draw(loops)?;
    rows.figure("width").draw(widths)?;
    rows.figure("time").draw(courses)
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
