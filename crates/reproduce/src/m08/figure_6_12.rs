use super::block::published;
use super::figure_6_8::measured;
use crate::Error;
use crate::published::cell;
use crate::row::Rows;
use palpate_jobs::plot::{Series, Style};

const ORGAN: &str = "liver";

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut series = vec![measured(ORGAN, 3)];
    for (color, set) in published(rows)?.iter().enumerate() {
        if set.organ != ORGAN {
            continue;
        }
        let curve = |factor: f64| {
            let points = (0..=80).map(|i| 0.1 * f64::from(i));
            let force = |depth: f64| 1e3 * factor * set.curve.force(1e-3 * depth);
            points.map(|depth| (depth, force(depth))).collect()
        };
        let name = set.law.replace('_', "-");
        let last = format!("{name}, final parameters");
        series.push(Series::new(last, curve(1.0), Style::Line, color));
        if let [c10] = set.parameters.as_slice() {
            let initial = cell("table-6-4 liver initial_c10_pa")?;
            let points = curve(initial / c10);
            let first = format!("{name}, C10 = {initial} Pa as the figure's caption");
            series.push(Series::new(first, points, Style::DashedLine, color));
        }
    }
    rows.figure("").draw(series)
}
