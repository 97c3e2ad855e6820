use palpate_characterize::CleanRecording;
use palpate_characterize::inverse::SoughtLaw;
use palpate_characterize::lumped::{DepthHistory, fit_kelvin};
use palpate_mechanics::finite_elements::indentation::History;
use palpate_mechanics::{IndentationCurve, PronySeries};

use super::equation_6_3::printed;
use crate::Error;
use crate::published::{TABLE_6_4, prony};
use crate::row::Value;
use crate::virtual_rig::{elastic, ramp_and_hold, recorded};
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const FIGURE_6_4: Item = Item {
    name: "figure-6-4",
    title: "force on the liver and Kelvin's law",
    seconds: 0.32,
    run,
};

/// Depth of table 6-4 for this organ.
const DEPTH: f64 = 6e-3;

const NOTE: &str = "published: (6.3); ours: Kelvin's law fitted to a virtual recording of the liver as tables 6-3 and 6-4 print \
    it, at 6 mm; k1 and k2 show again that the source's two laws of one organ do not agree";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let Some(c10) = TABLE_6_4.value("liver", "final_c10_pa") else {
        rows.add_missing("k1", "N/mm", "table 6-4 cannot be read");
        return Ok(());
    };
    let course = ramp_and_hold(DEPTH);
    let curve = elastic(SoughtLaw::NeoHookean, (c10, 0.0))?;
    let felt = curve.relaxed(&prony("liver", 6)?, &course.times, &course.depths);
    let recording = recorded(("liver", 0), &course, &felt, 1)?;
    let columns = (&recording.time, &recording.depth, &recording.force);
    let found = fit_kelvin(columns.0, columns.1, columns.2, DepthHistory::Recorded)?;
    let own = [
        found.kelvin.k1_n_per_m,
        found.kelvin.k2_n_per_m,
        found.kelvin.b_n_s_per_m,
    ];
    let own = own.map(|each| 1e-3 * each.value);
    let printed = printed()?;
    let names = [("k1", "N/mm"), ("k2", "N/mm"), ("b", "N s/mm")];
    for (place, (word, unit)) in names.into_iter().enumerate() {
        let value = Value::beside(Some(printed[place]), own[place], unit);
        rows.add(word, value, NOTE);
    }
    let plot = drawn(&recording, &course, [own, printed])?;
    rows.add_figure(None, &plot, "one time constant misses the fast part of two")
}

/// The recording, and Kelvin's law as found and as printed.
fn drawn(
    recording: &CleanRecording,
    course: &History,
    [own, printed]: [[f64; 3]; 2],
) -> Result<Plot, Error> {
    let line = |[k1, k2, b]: [f64; 3]| -> Result<Vec<(f64, f64)>, Error> {
        let series = PronySeries::new(&[(1.0 - k2 / k1, b / k1)])?;
        let curve = IndentationCurve::through(&[DEPTH], &[1e3 * k1 * DEPTH]);
        let forces = curve.relaxed(&series, &course.times, &course.depths);
        let each = course.times.iter().zip(forces);
        Ok(each.map(|(t, f)| (*t, 1e3 * f)).collect())
    };
    let each = recording.time.iter().zip(&recording.force).step_by(50);
    let dots = each.map(|(t, f)| (*t, 1e3 * f)).collect();
    let as_printed = "Kelvin's law as printed, signs mended";
    Ok(Plot {
        title: "Force on the pig's liver at 6 mm".to_owned(),
        x_label: "time [s]".to_owned(),
        y_label: "force [mN]".to_owned(),
        series: vec![
            Series::new(
                "virtual recording, tables 6-3 and 6-4",
                dots,
                Style::Dots,
                0,
            ),
            Series::new("Kelvin's law through it", line(own)?, Style::Line, 1),
            Series::new(as_printed, line(printed)?, Style::DashedLine, 2),
        ],
        ..Plot::default()
    })
}
