use palpate_characterize::CleanRecording;
use palpate_characterize::inverse::CandidateLaw;
use palpate_characterize::lumped::{DepthHistory, fit_kelvin};
use palpate_mechanics::finite_elements::indentation::History;
use palpate_mechanics::{IndentationCurve, PronySeries};

use super::equation_6_3::printed;
use crate::Error;
use crate::published::{cell, prony};
use crate::row::Rows;
use crate::virtual_rig::{elastic, ramp_and_hold, recorded};
use palpate_jobs::plot::{Series, Style};

/// Depth of table 6-4 for this organ.
const DEPTH: f64 = 6e-3;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let c10 = cell("table-6-4 liver final_c10_pa")?;
    let course = ramp_and_hold(DEPTH);
    let curve = elastic(CandidateLaw::NeoHookean, c10, &[])?;
    let forces = curve.relaxed(&prony("liver", 6)?, &course.times, &course.depths);
    let recording = recorded("liver", 0, &course, &forces, 1)?;
    let columns = (&recording.time, &recording.depth, &recording.force);
    let found = fit_kelvin(columns.0, columns.1, columns.2, DepthHistory::Recorded)?;
    let own = [
        found.kelvin.k1_n_per_m,
        found.kelvin.k2_n_per_m,
        found.kelvin.b_n_s_per_m,
    ];
    let own = own.map(|each| 1e-3 * each.value);
    let printed = printed()?;
    for (word, ours) in ["k1", "k2", "b"].into_iter().zip(own) {
        rows.add(word, ours);
    }
    let series = drawn(&recording, &course, [own, printed])?;
    rows.figure("").draw(series)
}

/// The recording, and Kelvin's law as found and as printed.
fn drawn(
    recording: &CleanRecording,
    course: &History,
    [own, printed]: [[f64; 3]; 2],
) -> Result<Vec<Series>, Error> {
    let line = |[k1, k2, b]: [f64; 3]| -> Result<Vec<(f64, f64)>, Error> {
        let series = PronySeries::new(&[(1.0 - k2 / k1, b / k1)])?;
        let curve = IndentationCurve::through(&[DEPTH], &[1e3 * k1 * DEPTH]);
        let forces = curve.relaxed(&series, &course.times, &course.depths);
        let each = course.times.iter().zip(forces);
        Ok(each.map(|(t, f)| (*t, 1e3 * f)).collect())
    };
    let each = recording.time.iter().zip(&recording.force).step_by(50);
    let dots = each.map(|(t, f)| (*t, 1e3 * f)).collect();
    let as_printed = "Kelvin's law as printed, signs corrected";
    let recorded = "virtual recording, tables 6-3 and 6-4";
    Ok(vec![
        Series::new(recorded, dots, Style::Dots, 0),
        Series::new("Kelvin's law through it", line(own)?, Style::Line, 1),
        Series::new(as_printed, line(printed)?, Style::DashedLine, 2),
    ])
}
