use std::collections::BTreeMap;

use palpate_characterize::fit::{Draws, bootstrap_subjects};
use serde::Serialize;

use super::Studied;

/// A number over the specimens of an organ.
#[derive(Debug, Serialize)]
pub(super) struct Pooled {
    n: usize,
    mean: f64,
    /// Between specimens; zero for one.
    standard_deviation: f64,
    /// What holds the mean with a probability of 95 %, by drawing specimens anew.
    interval_95: [f64; 2],
}

/// How often specimens are drawn anew.
const DRAWS: Draws = Draws {
    count: 2000,
    seed: 1,
};

/// Every parameter of every law and of the relaxation, over the specimens that have it, by organ:
/// `liver.neo_hookean.c10_pa`. Of specimens that name no organ, without one.
pub(super) fn of(studied: &[Studied]) -> BTreeMap<String, Pooled> {
    let mut values: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for studied in studied {
        let organ = studied.recordings[0].header.organ.as_deref();
        let mut add = |key: String, value: f64| {
            let key = organ.map_or(key.clone(), |organ| format!("{organ}.{key}"));
            values.entry(key).or_default().push(value);
        };
        for (law, found) in &studied.found.laws {
            for (name, estimate) in found.iter().flat_map(|law| &law.parameters) {
                add(format!("{}.{name}", law.name().word()), estimate.value);
            }
        }
        let terms = studied
            .found
            .relaxation
            .iter()
            .flat_map(|found| &found.terms);
        let total: f64 = terms.map(|[g, _]| g.value).sum();
        if studied.found.relaxation.is_ok() {
            add("relaxation.sum_of_g".to_owned(), total);
        }
    }
    let pooled = |(key, values): (String, Vec<f64>)| {
        let mean = bootstrap_subjects(&values, 0.95, DRAWS)?;
        let pooled = Pooled {
            n: values.len(),
            mean: mean.mean,
            standard_deviation: mean.deviation,
            interval_95: mean.interval,
        };
        Some((key, pooled))
    };
    values.into_iter().filter_map(pooled).collect()
}
