use std::collections::BTreeMap;

use palpate_characterize::fit::pooled_mean;
use serde::Serialize;

use super::answer::Specimen;

/// A number over the subjects of an organ in one condition.
#[derive(Debug, Serialize)]
pub struct Pooled {
    /// The organ; none where no file states it.
    pub organ: Option<String>,
    /// The condition; none where no file states it.
    pub condition: Option<String>,
    /// The pooled quantity: `neo_hookean.c10_pa`, `mean_elastic_modulus`, `relaxation.sum_of_g`.
    pub quantity: String,
    /// Subjects: each counts once, by the mean of its specimens; a specimen without a subject is one.
    pub n: usize,
    /// Specimens.
    pub specimens: usize,
    /// Over subjects.
    pub mean: f64,
    /// Between subjects; null for one.
    pub standard_deviation: Option<f64>,
    /// 95 % confidence interval of the population mean, by Student's distribution; null for one.
    pub interval_95: Option<[f64; 2]>,
}

/// Of intervals [-].
const LEVEL: f64 = 0.95;

/// The group of a pooled value: organ, condition and quantity.
type Key = (Option<String>, Option<String>, String);

/// Every parameter of every law, the mean modulus and the relaxing fraction, over the subjects that have it, by organ
/// and condition: `liver.in_vivo.neo_hookean.c10_pa`. The name omits an organ or condition that no file states.
pub(crate) fn of(specimens: &[Specimen]) -> BTreeMap<String, Pooled> {
    let mut values: BTreeMap<Key, Vec<(Option<&str>, f64)>> = BTreeMap::new();
    for specimen in specimens {
        let mut add = |quantity: String, value: f64| {
            let key = (specimen.organ.clone(), specimen.condition.clone(), quantity);
            let own = values.entry(key).or_default();
            own.push((specimen.subject.as_deref(), value));
        };
        for (law, found) in specimen.laws() {
            for (name, known) in &found.parameters {
                add(format!("{law}.{name}"), known.value);
            }
        }
        if let Some(modulus) = &specimen.lumped.mean_elastic_modulus {
            add("mean_elastic_modulus".to_owned(), modulus.value);
        }
        let contact = [
            ("linear_elastic", &specimen.lumped.linear_elastic),
            ("adhesion", &specimen.lumped.adhesion),
        ];
        for (fit, found) in contact {
            for key in ["youngs_modulus_pa", "work_of_adhesion_j_per_m2"] {
                if let Some(known) = found.as_ref().and_then(|found| found.get(key)) {
                    add(format!("{fit}.{key}"), known.value);
                }
            }
        }
        if let Some(relaxation) = &specimen.relaxation {
            let total = relaxation.g.iter().map(|g| g.value).sum();
            add("relaxation.sum_of_g".to_owned(), total);
        }
    }
    values.into_iter().filter_map(pooled).collect()
}

fn pooled(
    ((organ, condition, quantity), values): (Key, Vec<(Option<&str>, f64)>),
) -> Option<(String, Pooled)> {
    let subjects = of_subjects(&values);
    let found = pooled_mean(&subjects, LEVEL)?;
    let named = [organ.as_deref(), condition.as_deref(), Some(&*quantity)];
    let named: Vec<&str> = named.into_iter().flatten().collect();
    let name = named.join(".");
    let pooled = Pooled {
        n: subjects.len(),
        specimens: values.len(),
        mean: found.mean,
        standard_deviation: found.deviation,
        interval_95: found.interval,
        organ,
        condition,
        quantity,
    };
    Some((name, pooled))
}

/// One value for each subject, the mean of its own, in the order in which they come; each of no subject is one.
fn of_subjects(values: &[(Option<&str>, f64)]) -> Vec<f64> {
    let mut groups: Vec<(Option<&str>, Vec<f64>)> = Vec::new();
    for &(subject, value) in values {
        let own = groups
            .iter_mut()
            .find(|(of, _)| subject.is_some() && *of == subject);
        match own {
            Some((_, own)) => own.push(value),
            None => groups.push((subject, vec![value])),
        }
    }
    let mean = |own: Vec<f64>| own.iter().sum::<f64>() / own.len() as f64;
    groups.into_iter().map(|(_, own)| mean(own)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two sites of one animal count as one animal; a specimen without a subject counts as one.
    #[test]
    fn a_subject_counts_once() {
        let values = [
            (Some("A"), 1.0),
            (None, 7.0),
            (Some("B"), 5.0),
            (Some("A"), 3.0),
            (None, 9.0),
        ];
        assert_eq!(of_subjects(&values), [2.0, 7.0, 5.0, 9.0]);
    }
}
