use palpate_characterize::lumped::{Contact, column_force, fit_column};

use crate::Error;
use crate::m06::Printed;
use crate::row::Rows;
use crate::virtual_rig::RADIUS;
use palpate_jobs::plot::{Series, Style};

const ORGANS: [&str; 2] = ["liver", "esophagus"];

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut series = Vec::new();
    for (color, organ) in ORGANS.into_iter().enumerate() {
        let printed = Printed::all(organ);
        let [depths, means] = Printed::columns(&printed);
        let found = fit_column(Contact::Flat(RADIUS), &depths, &means)?;
        let column = &found.column;
        for (word, ours) in [
            ("gamma", column.gamma_pa.value),
            ("alpha", column.alpha.value),
            ("misfit", found.misfit),
        ] {
            rows.row(&format!("{organ}/{word}"))
                .with("warnings", listed(&found.warnings))
                .is(ours);
        }
        let dots = depths.iter().zip(&means).map(|(d, f)| (1e3 * d, 1e3 * f));
        let name = format!("{organ}, table 5-1");
        series.push(Series::new(name, dots.collect(), Style::Dots, color));
        let line = (0..=80).filter_map(|i| {
            let depth = 0.1 * f64::from(i);
            let force = column_force(column, 1e-3 * depth).ok()?;
            Some((depth, 1e3 * force))
        });
        let name = format!("{organ}, Blatz's law");
        series.push(Series::new(name, line.collect(), Style::Line, color));
    }
    rows.figure("").draw(series)
}

/// The warnings of a fit at the end of a note.
pub(super) fn listed(warnings: &[String]) -> String {
    warnings
        .iter()
        .map(|warning| format!("; {warning}"))
        .collect()
}
