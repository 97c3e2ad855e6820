use palpate_characterize::lumped::{DepthHistory, fit_kelvin};
use palpate_mechanics::{IndentationCurve, PronySeries};

use crate::Error;
use crate::published::{EQUATION_6_3 as PUBLISHED, TABLE_6_3};
use crate::row::Value;
use crate::virtual_rig::{ramp_and_hold, recorded};
use crate::{Item, Rows};

pub(crate) const EQUATION_6_3: Item = Item {
    name: "equation-6-3",
    title: "Kelvin's law of the liver",
    seconds: 0.18,
    run,
};

/// Depth of the virtual recording [m]; the source names none, and the law is linear.
const DEPTH: f64 = 6e-3;

/// The printed k₁, k₂ [N/mm] and b [N s/mm].
pub(super) fn printed() -> Result<[f64; 3], Error> {
    let cell = |column| {
        let missing = || Error::failed("the printed Kelvin law cannot be read; please report this");
        PUBLISHED.first(column).ok_or_else(missing)
    };
    Ok([
        cell("k1_n_per_mm")?,
        cell("k2_n_per_mm")?,
        cell("b_n_s_per_mm")?,
    ])
}

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let [k1, k2, b] = printed()?;
    add_signs(rows, [k1, k2]);
    let series = PronySeries::new(&[(1.0 - k2 / k1, b / k1)])?;
    let course = ramp_and_hold(DEPTH);
    let curve = IndentationCurve::through(&[DEPTH], &[1e3 * k1 * DEPTH]);
    let felt = curve.relaxed(&series, &course.times, &course.depths);
    let recording = recorded(("liver", 0), &course, &felt, 1)?;
    for (history, prefix) in [(DepthHistory::Recorded, ""), (DepthHistory::Step, "step/")] {
        let columns = (&recording.time, &recording.depth, &recording.force);
        let found = fit_kelvin(columns.0, columns.1, columns.2, history)?.kelvin;
        let how = match history {
            DepthHistory::Recorded => {
                "refitted from a virtual recording of (6.3) with its signs mended, a ramp of 0.5 s to 6 mm and a hold until \
                 40 s with noise of 0.225 mN; b is that of the time constant b/k1 of 16.25 s, the only reading that \
                 settles in about 40 s: spring beside spring and damper, as the text says, would need 130 s"
            }
            DepthHistory::Step => {
                "the same if the ramp is taken for a step; the source finds the difference negligible, and so it is for a \
                 ramp that is short against 16 s"
            }
        };
        let error = found.b_n_s_per_m.standard_error.unwrap_or(0.0);
        let note = format!("{how}; standard error of b {:.4} N s/mm", 1e-3 * error);
        let numbers = [
            ("k1", k1, 1e-3 * found.k1_n_per_m.value, "N/mm"),
            ("k2", k2, 1e-3 * found.k2_n_per_m.value, "N/mm"),
            ("b", b, 1e-3 * found.b_n_s_per_m.value, "N s/mm"),
        ];
        for (word, published, ours, unit) in numbers {
            let value = Value::beside(Some(published), ours, unit);
            rows.add_pipeline_only(&format!("{prefix}{word}"), value, note.clone());
        }
    }
    Ok(())
}

/// What the printed form does, and what the source's own terms of the same organ say.
fn add_signs(rows: &mut Rows<'_>, [k1, k2]: [f64; 2]) {
    let note = "G after long over G at once; ours: (6.3) exactly as printed, k1/k2, which rises, while the text says that it \
                falls and its parameters fall from k1 to k2";
    let value = Value::beside(Some(k2 / k1), k1 / k2, "1");
    rows.add("printed_form/left", value, note);
    let terms = ["g1", "g2"].map(|g| TABLE_6_3.value("liver", g));
    let left = terms.into_iter().flatten().fold(1.0, |left, g| left - g);
    let note = "part of the force that is left; published: k2/k1; ours: 1 - g1 - g2 of table 6-3, for the same organ: the \
                source contradicts itself";
    rows.add("left", Value::beside(Some(k2 / k1), left, "1"), note);
}
