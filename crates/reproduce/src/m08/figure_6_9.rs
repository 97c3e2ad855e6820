use palpate_characterize::inverse::CandidateLaw;
use palpate_jobs::plot::Series;

use super::block::{ORGANS, moduli, printed, table};
use super::starts::{ALGORITHMS, Model, steps};
use crate::Error;
use crate::published::prony;
use crate::row::Rows;

/// Steps that the figures show.
const SHOWN: usize = 21;

/// Figure 6-9.
pub(crate) fn neo_hookean(rows: &mut Rows<'_>) -> Result<(), Error> {
    run(rows, CandidateLaw::NeoHookean, "neo-Hookean", &ORGANS)
}

/// Figure 6-10.
pub(crate) fn mooney_rivlin(rows: &mut Rows<'_>) -> Result<(), Error> {
    run(
        rows,
        CandidateLaw::MooneyRivlin,
        "Mooney-Rivlin",
        &ORGANS[1..],
    )
}

fn run(
    rows: &mut Rows<'_>,
    law: CandidateLaw,
    law_name: &str,
    organs: &[(&str, u32)],
) -> Result<(), Error> {
    let mut series = Vec::new();
    for (place, &(organ, depth_mm)) in organs.iter().enumerate() {
        let (start, truth) = (
            printed(law, organ, "initial")?,
            printed(law, organ, "final")?,
        );
        let depth = 1e-3 * f64::from(depth_mm);
        let model = Model::indented(law, depth, prony(organ, depth_mm)?);
        for (algorithm, word) in ALGORITHMS {
            let (way, ended) = model.way(algorithm, &truth, &start)?;
            rows.row(&format!("{organ}/{word}/steps"))
                .with("table", table(law))
                .with("remark", law_name)
                .is(ended.then(|| steps(&way, &truth) as f64));
            for (number, name) in moduli(law).iter().enumerate() {
                let each = way.iter().enumerate().take(SHOWN);
                let name = name.to_uppercase();
                let word = format!("{organ}, {name}, {}", word.replace('_', " "));
                let points = each.map(|(i, values)| (i as f64, values[number])).collect();
                let color = 2 * place + number;
                series.push(Series::new(word, points, algorithm.style(), color));
            }
        }
    }
    rows.figure("").with("law", law_name).draw(series)
}
