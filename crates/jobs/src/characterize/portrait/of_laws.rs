use palpate_characterize::Characterization;
use palpate_characterize::fit::Fit;
use palpate_characterize::inverse::{Correlations, LawDescription, SoughtLaw};
use palpate_characterize::lumped::UniaxialFit;

use super::super::answer::correlations_of_piece;
use super::{DrawnLaw, key};

/// The laws that were found, with the way of each fit.
pub(crate) fn drawn(found: &Characterization) -> Vec<DrawnLaw> {
    let pressed = found.laws.iter().filter_map(|(_, law)| law.as_ref().ok());
    let pulled = found
        .uniaxial
        .iter()
        .filter_map(|(_, law)| law.as_ref().ok());
    let all = pressed.map(of_indentation).chain(pulled.map(of_piece));
    let criteria = found.criteria();
    let compared = all.map(|law| {
        let own = criteria.iter().find(|(of, _)| key(*of) == law.law);
        DrawnLaw {
            criterion: own.map_or(0.0, |(_, criterion)| *criterion),
            ..law
        }
    });
    compared.collect()
}

fn of_indentation(law: &LawDescription) -> DrawnLaw {
    let fit = &law.found.fit;
    // The fit moves a modulus and a shape.
    let own = |values: &[f64]| {
        let each = law.found.law.parameters(values[0], values[1]);
        each.iter().map(|parameter| parameter.value).collect()
    };
    let way = fit.iterations.iter().map(|step| own(&step.values));
    described(
        law.found.law,
        fit,
        way.collect(),
        (law.uncertainty.effective_samples, law.correlations()),
    )
}

fn of_piece(law: &UniaxialFit) -> DrawnLaw {
    let way = law.fit.iterations.iter().map(|step| step.values.clone());
    let known = (
        law.uncertainty.effective_samples,
        correlations_of_piece(law),
    );
    described(law.law, &law.fit, way.collect(), known)
}

fn described(
    law: SoughtLaw,
    fit: &Fit,
    iterations: Vec<Vec<f64>>,
    (effective_samples, correlations): (f64, Correlations),
) -> DrawnLaw {
    let names = law.parameters(1.0, 0.0);
    let rows = correlations.matrix.row_iter();
    DrawnLaw {
        law: key(law),
        names: names
            .iter()
            .map(|parameter| parameter.name.to_owned())
            .collect(),
        iterations,
        sums_of_squares: fit
            .iterations
            .iter()
            .map(|step| step.sum_of_squares)
            .collect(),
        criterion: 0.0,
        samples: fit.residuals.len(),
        effective_samples,
        correlations: rows.map(|row| row.iter().copied().collect()).collect(),
        correlated: correlations.names,
    }
}
