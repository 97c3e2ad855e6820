use super::printed::{ORGANS, Printed};
use crate::Error;
use crate::row::Value;
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const FIGURE_5_14: Item = Item {
    name: "figure-5-14",
    title: "static responses of four organs",
    seconds: 0.18,
    run,
};

const NOTE: &str = "power of the depth with which the mean of table 5-1 grows from the first depth to the last, 1 for a \
    linear response; the source calls the esophagus more linear than the other organs, and the liver's power is as near to 1";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut series = Vec::new();
    for (color, organ) in ORGANS.into_iter().enumerate() {
        let printed = Printed::all(organ);
        if let [first, .., last] = printed.as_slice() {
            let depths = f64::from(last.depth_mm) / f64::from(first.depth_mm);
            let power = (last.mean / first.mean).ln() / depths.ln();
            rows.add(&format!("power/{organ}"), Value::own(power, "1"), NOTE);
        }
        series.extend(of_means(organ, color));
    }
    let plot = Plot {
        title: "Static force of the pig's organs, in vivo".to_owned(),
        x_label: "depth [mm]".to_owned(),
        y_label: "force [mN]".to_owned(),
        series,
        ..Plot::default()
    };
    let note =
        "means of table 5-1, with bars from the least to the largest where those can be right";
    rows.add_figure(None, &plot, note)
}

/// The means of `organ`, and a bar for each row without a misprint.
pub(super) fn of_means(organ: &str, color: usize) -> Vec<Series> {
    let printed = Printed::all(organ);
    let at = |row: &Printed, force: f64| (f64::from(row.depth_mm), 1e3 * force);
    let means = Series {
        name: organ.to_owned(),
        points: printed.iter().map(|row| at(row, row.mean)).collect(),
        style: Style::LineWithDots,
        color,
    };
    let bars = printed.iter().filter(|row| !row.suspect).map(|row| Series {
        name: String::new(),
        points: vec![at(row, row.min), at(row, row.max)],
        style: Style::Line,
        color,
    });
    [means].into_iter().chain(bars).collect()
}
