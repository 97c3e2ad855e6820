use palpate_characterize::Characterization;
use palpate_characterize::fit::Fit;
use palpate_characterize::inverse::{CandidateLaw, LawDescription};
use palpate_characterize::lumped::UniaxialFit;

use super::{DrawnLaw, key};

/// The fitted laws, with the iterations of each fit.
pub(crate) fn drawn(found: &Characterization) -> Vec<DrawnLaw> {
    let pressed = found.laws.iter().filter_map(|(_, law)| law.as_ref().ok());
    let pulled = found
        .uniaxial
        .iter()
        .filter_map(|(_, law)| law.as_ref().ok());
    let all = pressed.map(of_indentation).chain(pulled.map(of_piece));
    all.collect()
}

fn of_indentation(law: &LawDescription) -> DrawnLaw {
    let fit = &law.found.fit;
    // The fit moves a modulus and shapes.
    let own = |values: &[f64]| {
        let sought = law.found.law;
        let each = sought.parameters(values[0], &values[1..sought.count()]);
        each.iter().map(|parameter| parameter.value).collect()
    };
    let way = fit.iterations.iter().map(|step| own(&step.values));
    described(law.found.law, fit, way.collect())
}

fn of_piece(law: &UniaxialFit) -> DrawnLaw {
    let way = law.fit.iterations.iter().map(|step| step.values.clone());
    described(law.law, &law.fit, way.collect())
}

fn described(law: CandidateLaw, fit: &Fit, iterations: Vec<Vec<f64>>) -> DrawnLaw {
    let steps = fit.iterations.iter();
    DrawnLaw {
        law: key(law),
        names: law.names().into_iter().map(str::to_owned).collect(),
        iterations,
        sums_of_squares: steps.map(|step| step.sum_of_squares).collect(),
    }
}
