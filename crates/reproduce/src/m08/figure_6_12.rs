use super::block::published;
use super::figure_6_8::measured_series;
use crate::Error;
use crate::published::TABLE_6_4;
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const FIGURE_6_12: Item = Item {
    name: "figure-6-12",
    title: "static force of the pig's liver and of the two laws",
    seconds: 180.0,
    run,
};

const ORGAN: &str = "liver";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut series = vec![measured_series(ORGAN, 3)];
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
        series.push(Series {
            name: format!("{name}, final parameters"),
            points: curve(1.0),
            style: Style::Line,
            color,
        });
        let initial = TABLE_6_4.value(ORGAN, "initial_c10_pa");
        if let ([c10], Some(initial)) = (set.parameters.as_slice(), initial) {
            series.push(Series {
                name: format!("{name}, C10 = {initial} Pa as the figure's caption"),
                points: curve(initial / c10),
                style: Style::DashedLine,
                color,
            });
        }
    }
    let plot = Plot {
        title: "Static force on the pig's liver".to_owned(),
        x_label: "depth [mm]".to_owned(),
        y_label: "force [mN]".to_owned(),
        series,
        ..Plot::default()
    };
    let note = "the source's figure plots the initial, not the final, neo-Hookean C10 (its caption says \
                198.23 Pa, table 6-4 ends at 452.92 Pa); both are drawn. Moduli as printed, taken as \
                those of the steady state";
    rows.add_figure(None, &plot, note)
}
