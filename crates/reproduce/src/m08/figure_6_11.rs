use palpate_characterize::inverse::CandidateLaw;
use palpate_jobs::plot::{Series, Style};
use palpate_mechanics::IndentationCurve;

use super::block::{ORGANS, printed};
use crate::Error;
use crate::published::{cell, prony};
use crate::row::Rows;
use crate::virtual_rig::{END, elastic, ramp_and_hold, recorded};

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for (organ, depth_mm) in ORGANS {
        let alone = printed(CandidateLaw::NeoHookean, organ, "final")?[0];
        let both = printed(CandidateLaw::MooneyRivlin, organ, "final")?;
        let mean = cell(&format!("table-5-1 {organ} {depth_mm} mean_n"))?;
        let sum = both[0] + both[1];
        let shape = [both[1] / sum];
        let laws = [
            (
                "neo-Hookean",
                elastic(CandidateLaw::NeoHookean, alone, &[])?,
            ),
            (
                "Mooney-Rivlin",
                elastic(CandidateLaw::MooneyRivlin, sum, &shape)?,
            ),
        ];
        let series = add(rows, organ, depth_mm, mean, &laws)?;
        rows.figure(organ).with("depth", depth_mm).draw(series)?;
    }
    Ok(())
}

/// Rows of the steady forces, and the curves with the measured `mean` [N].
fn add(
    rows: &mut Rows<'_>,
    organ: &str,
    depth_mm: u32,
    mean: f64,
    laws: &[(&str, IndentationCurve)],
) -> Result<Vec<Series>, Error> {
    let course = ramp_and_hold(1e-3 * f64::from(depth_mm));
    let series = prony(organ, depth_mm)?;
    let mut drawn = Vec::new();
    for (color, (name, curve)) in laws.iter().enumerate() {
        let forces = curve.relaxed(&series, &course.times, &course.depths);
        let seen = recorded(organ, color, &course, &forces, color as u64)?;
        let each = seen.time.iter().zip(&seen.force).step_by(50);
        let dots = each.map(|(t, f)| (*t, 1e3 * f)).collect();
        let recording = format!("{name}, virtual recording");
        drawn.push(Series::new(recording, dots, Style::Dots, color));
        let each = course.times.iter().zip(&forces);
        let line = each.map(|(t, f)| (*t, 1e3 * f)).collect();
        drawn.push(Series::new(*name, line, Style::Line, color));
        let word = name.to_lowercase().replace('-', "_");
        rows.row(&format!("{organ}/{word}/steady"))
            .with("depth", depth_mm)
            .is(forces.last().copied());
    }
    let level = vec![(0.0, 1e3 * mean), (END, 1e3 * mean)];
    let name = "steady mean of table 5-1";
    drawn.push(Series::new(name, level, Style::DashedLine, 5));
    Ok(drawn)
}
