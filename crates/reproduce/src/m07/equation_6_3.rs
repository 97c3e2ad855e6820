use palpate_characterize::lumped::{DepthHistory, fit_kelvin};
use palpate_mechanics::{IndentationCurve, PronySeries};

use crate::Error;
use crate::published::cell;
use crate::row::Rows;
use crate::virtual_rig::{ramp_and_hold, recorded};

/// Depth of the virtual recording [m]; the source names none, and the law is linear.
const DEPTH: f64 = 6e-3;

/// The printed k₁, k₂ [N/mm] and b [N s/mm].
pub(super) fn printed() -> Result<[f64; 3], Error> {
    Ok([
        cell("equation-6-3 k1_n_per_mm")?,
        cell("equation-6-3 k2_n_per_mm")?,
        cell("equation-6-3 b_n_s_per_mm")?,
    ])
}

/// What the printed form does, what the source's own terms of the same organ say, and the law found again.
pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let [k1, k2, b] = printed()?;
    rows.row("printed_form/left").published(k2 / k1).is(k1 / k2);
    let left = 1.0 - cell("table-6-3 liver g1")? - cell("table-6-3 liver g2")?;
    rows.row("left").published(k2 / k1).is(left);
    let series = PronySeries::new(&[(1.0 - k2 / k1, b / k1)])?;
    let course = ramp_and_hold(DEPTH);
    let curve = IndentationCurve::through(&[DEPTH], &[1e3 * k1 * DEPTH]);
    let forces = curve.relaxed(&series, &course.times, &course.depths);
    let recording = recorded("liver", 0, &course, &forces, 1)?;
    for (history, prefix) in [(DepthHistory::Recorded, ""), (DepthHistory::Step, "step/")] {
        let columns = (&recording.time, &recording.depth, &recording.force);
        let found = fit_kelvin(columns.0, columns.1, columns.2, history)?.kelvin;
        let error = found.b_n_s_per_m.standard_error.unwrap_or(0.0);
        for (word, ours) in [
            ("k1", found.k1_n_per_m.value),
            ("k2", found.k2_n_per_m.value),
            ("b", found.b_n_s_per_m.value),
        ] {
            rows.row(&format!("{prefix}{word}"))
                .with("ramp", prefix)
                .with("error", format!("{:.4}", 1e-3 * error))
                .is(1e-3 * ours);
        }
    }
    Ok(())
}
