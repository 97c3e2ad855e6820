use palpate_mechanics::PronySeries;

use super::springs::{DEPTHS_MM, ORGANS, forces, printed};
use crate::Error;
use crate::m06::Printed;
use crate::published::prony;
use crate::row::Value;
use crate::virtual_rig::ramp_and_hold;
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const FIGURE_6_5: Item = Item {
    name: "figure-6-5",
    title: "force of the printed springs under several depths",
    seconds: 0.21,
    run,
};

const NOTE: &str = "published: mean of table 5-1; ours: force of (6.4) with the parameters of table 6-2, ramp of 0.5 s, at 40 s, when \
    the relaxing springs still hold a part; the source's curves and its ramp carry no numbers";

const PEAK_NOTE: &str = "largest over steady force; published: 1/(1 - g1 - g2) of table 6-3 for the same organ and depth; ours: the \
    printed springs; the first relaxing spring is several times too strong for the source's own relaxation, and its curves, which the \
    text finds close, cannot come from these parameters at such a ramp";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for organ in ORGANS {
        let Some(values) = printed(organ) else {
            rows.add_missing(organ, "N", "the row of table 6-2 cannot be read");
            continue;
        };
        let mut series = Vec::new();
        let mut measured = Vec::new();
        let own = Printed::all(organ);
        let depths = own.iter().filter(|row| DEPTHS_MM.contains(&row.depth_mm));
        for (color, row) in depths.enumerate() {
            let course = ramp_and_hold(1e-3 * f64::from(row.depth_mm));
            let Some(forces) = forces(values, &course) else {
                rows.add_missing(organ, "N", "a spring is faster than 1 kHz");
                return Ok(());
            };
            let last = course.times.len() - 1;
            let value = Value::beside(Some(row.mean), forces[last], "N");
            rows.add(&format!("{organ}/{}_mm", row.depth_mm), value, NOTE);
            if (organ, row.depth_mm) == ("liver", 6) {
                add_peak(rows, &prony(organ, row.depth_mm)?, &forces);
            }
            measured.push((course.times[last], 1e3 * row.mean));
            let each = course.times.iter().zip(&forces);
            series.push(Series {
                name: format!("{} mm", row.depth_mm),
                points: each.map(|(t, f)| (*t, 1e3 * f)).collect(),
                style: Style::Line,
                color,
            });
        }
        series.push(Series {
            name: "means of table 5-1".to_owned(),
            points: measured,
            style: Style::Dots,
            color: 5,
        });
        let plot = Plot {
            title: format!("Force of the printed springs, {organ}"),
            x_label: "time [s]".to_owned(),
            y_label: "force [mN]".to_owned(),
            series,
            ..Plot::default()
        };
        rows.add_figure(Some(organ), &plot, NOTE)?;
    }
    Ok(())
}

fn add_peak(rows: &mut Rows<'_>, series: &PronySeries, forces: &[f64]) {
    let peak = forces.iter().copied().fold(0.0, f64::max);
    let steady = forces.last().copied().unwrap_or(0.0);
    let left = series.relaxation(f64::INFINITY);
    let value = Value::beside(Some(1.0 / left), peak / steady, "1");
    rows.add("liver/6_mm/peak_over_steady", value, PEAK_NOTE);
}
