use std::collections::BTreeMap;

use palpate_characterize::fit::{Draws, bootstrap_subjects};
use serde::Serialize;

use super::answer::Specimen;

/// A number over the specimens of an organ.
#[derive(Debug, Serialize)]
pub struct Pooled {
    /// Specimens.
    pub n: usize,
    /// Over them.
    pub mean: f64,
    /// Between specimens; null for one.
    pub standard_deviation: Option<f64>,
    /// What holds the mean with a probability of 95 %, by drawing specimens anew; null for one.
    pub interval_95: Option<[f64; 2]>,
}

/// How often specimens are drawn anew.
const DRAWS: Draws = Draws {
    count: 2000,
    seed: 1,
};

/// Every parameter of every law, the mean modulus and what relaxes, over the specimens that have it, by
/// organ: `liver.neo_hookean.c10_pa`. Of specimens that name no organ, without one.
pub(crate) fn of(specimens: &[Specimen]) -> BTreeMap<String, Pooled> {
    let mut values: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for specimen in specimens {
        let mut add = |key: String, value: f64| {
            let organ = specimen.organ.as_ref();
            let key = organ.map_or(key.clone(), |organ| format!("{organ}.{key}"));
            values.entry(key).or_default().push(value);
        };
        for (law, found) in specimen.laws() {
            for (name, known) in &found.parameters {
                add(format!("{law}.{name}"), known.value);
            }
        }
        if let Some(modulus) = &specimen.mean_elastic_modulus {
            add("mean_elastic_modulus".to_owned(), modulus.value);
        }
        if let Some(relaxation) = &specimen.relaxation {
            let total = relaxation.g.iter().map(|g| g.value).sum();
            add("relaxation.sum_of_g".to_owned(), total);
        }
    }
    let pooled = |(key, values): (String, Vec<f64>)| {
        let mean = bootstrap_subjects(&values, 0.95, DRAWS)?;
        let several = values.len() > 1;
        let pooled = Pooled {
            n: values.len(),
            mean: mean.mean,
            standard_deviation: several.then_some(mean.deviation),
            interval_95: several.then_some(mean.interval),
        };
        Some((key, pooled))
    };
    values.into_iter().filter_map(pooled).collect()
}
