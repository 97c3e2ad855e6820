use palpate_characterize::inverse::SoughtLaw;
use palpate_mechanics::IndentationCurve;

use super::block::ORGANS;
use crate::Error;
use crate::published::{TABLE_5_1, TABLE_6_4, TABLE_6_5, prony};
use crate::row::Value;
use crate::virtual_rig::{END, elastic, ramp_and_hold, recorded};
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const FIGURE_6_11: Item = Item {
    name: "figure-6-11",
    title: "force over time of the published laws and the measured steady means",
    seconds: 0.21,
    run,
};

const NOTE: &str = "published: mean of table 5-1; ours: force at 40 s; the source's figure shows both on each other, and the printed numbers \
    do not";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for (organ, depth_mm) in ORGANS {
        let cells = [
            TABLE_6_4.value(organ, "final_c10_pa"),
            TABLE_6_5.value(organ, "final_c10_pa"),
            TABLE_6_5.value(organ, "final_c01_pa"),
            TABLE_5_1.value_of([organ, &depth_mm.to_string()], "mean_n"),
        ];
        let [Some(alone), Some(c10), Some(c01), Some(mean)] = cells else {
            rows.add_missing(organ, "N", "the source's tables cannot be read");
            continue;
        };
        let both = (c10 + c01, c01 / (c10 + c01));
        let laws = [
            ("neo-Hookean", elastic(SoughtLaw::NeoHookean, (alone, 0.0))?),
            ("Mooney-Rivlin", elastic(SoughtLaw::MooneyRivlin, both)?),
        ];
        let plot = add(rows, (organ, depth_mm), mean, &laws)?;
        let note = "moduli read as instantaneous, relaxation of table 6-3, by convolution; depths of tables 6-3 and 6-4, which the \
                    figure's caption swaps";
        rows.add_figure(Some(organ), &plot, note)?;
    }
    Ok(())
}

/// Rows of the steady forces, and the plot with the measured `mean` [N].
fn add(
    rows: &mut Rows<'_>,
    (organ, depth_mm): (&str, u32),
    mean: f64,
    laws: &[(&str, IndentationCurve)],
) -> Result<Plot, Error> {
    let course = ramp_and_hold(1e-3 * f64::from(depth_mm));
    let series = prony(organ, depth_mm)?;
    let mut drawn = Vec::new();
    for (color, (name, curve)) in laws.iter().enumerate() {
        let forces = curve.relaxed(&series, &course.times, &course.depths);
        let seen = recorded((organ, color), &course, &forces, color as u64)?;
        let each = seen.time.iter().zip(&seen.force).step_by(50);
        let dots = each.map(|(t, f)| (*t, 1e3 * f)).collect();
        drawn.push(Series::new(
            format!("{name}, virtual recording"),
            dots,
            Style::Dots,
            color,
        ));
        let each = course.times.iter().zip(&forces);
        let line = each.map(|(t, f)| (*t, 1e3 * f)).collect();
        drawn.push(Series::new(*name, line, Style::Line, color));
        let steady = Value {
            published: Some(mean),
            ours: forces.last().copied(),
            unit: "N",
        };
        let word = name.to_lowercase().replace('-', "_");
        rows.add(&format!("{organ}/{word}/steady"), steady, NOTE);
    }
    let level = vec![(0.0, 1e3 * mean), (END, 1e3 * mean)];
    drawn.push(Series::new(
        "steady mean of table 5-1",
        level,
        Style::DashedLine,
        5,
    ));
    Ok(Plot {
        title: format!("Force on the pig's {organ} at {depth_mm} mm, published laws"),
        x_label: "time [s]".to_owned(),
        y_label: "force [mN]".to_owned(),
        series: drawn,
        ..Plot::default()
    })
}
