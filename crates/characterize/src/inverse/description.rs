use nalgebra::DMatrix;
use palpate_files::Estimate;
use palpate_files::quantity::plain_quantity;

use super::forces::Indentation;
use super::law::{CandidateLaw, LawParameter, to_shape};
use super::law_fit::LawFit;
use super::repeated::Repeated;
use crate::Error;
use crate::fit::{
    Fit, Parameter, Uncertainty, correlated_uncertainty, misfit, missed, warnings, with_systematic,
};

/// A law that was found, in its own parameters, and how well they are known.
#[derive(Debug, Clone, PartialEq)]
pub struct LawDescription {
    /// The fit that found it.
    pub found: LawFit,
    /// Its parameters in the order of its keys, each with its name and its standard error: by noise, by the zeros
    /// of the recordings, by the elements and by the product of force and G(t).
    pub parameters: Vec<(&'static str, Estimate)>,
    /// Errors of the parameters by the elements and by the product of force and G(t) [unit of each]: a part
    /// of their errors.
    pub discretisation: Vec<f64>,
    /// Correlation of the first two parameters [-]; none of one alone.
    pub correlation: Option<f64>,
    /// Σ ε² [N²].
    pub sum_of_squares: f64,
    /// The part of the force that the law does not follow: its root mean square over the largest [-].
    pub misfit: f64,
    /// How well its own parameters are known, and those of the relaxation that it was found with.
    pub uncertainty: Uncertainty,
    /// Warnings.
    pub warnings: Vec<String>,
    /// Uncertainty by repeated fits, where they were asked for.
    pub repeated: Option<Result<Repeated, Error>>,
}

impl LawDescription {
    /// Of a fit to `indentations`.
    pub fn of(found: LawFit, indentations: &[Indentation<'_>]) -> Self {
        let lengths: Vec<usize> = indentations.iter().map(|each| each.time.len()).collect();
        let own = in_own_parameters(&found);
        let free = own.unbounded();
        let noise = correlated_uncertainty(&free, &lengths);
        let uncertainty = with_systematic(noise, &free, &found.systematic);
        let each = found.law.parameters(found.modulus(), found.shape());
        let known = |(place, parameter): (usize, &LawParameter)| {
            let is_estimate = !found.at_bound(place);
            let estimate = Estimate {
                value: parameter.value,
                standard_error: uncertainty.standard_error(place).filter(|_| is_estimate),
            };
            (parameter.name, estimate)
        };
        let largest = indentations
            .iter()
            .flat_map(|each| each.force)
            .copied()
            .fold(0.0, f64::max);
        let sum_of_squares = own.sum_of_squares();
        let misfit = misfit(&own, largest);
        let of_law = uncertainty.among(|place| place < each.len());
        let mut said = match found.at_edge(&of_law) {
            Some(edge) => vec![edge],
            None => warnings(&own, &of_law, None),
        };
        said.extend(missed(found.law.name().word(), "force", misfit));
        said.extend(found.other_minima_warning());
        let off = found.model_error();
        Self {
            parameters: each.iter().enumerate().map(known).collect(),
            discretisation: each.iter().map(|p| off * p.value.abs()).collect(),
            correlation: correlation(&uncertainty.of_all(own.parameters.len())[0], each.len()),
            sum_of_squares,
            misfit,
            uncertainty,
            warnings: said,
            repeated: None,
            found,
        }
    }
}

impl LawFit {
    /// Whether the law's own parameter at this place is none that was found, because its shape ended on a bound.
    fn at_bound(&self, place: usize) -> bool {
        let shape = &self.fit.parameters[place];
        place > 0 && !shape.fixed && shape.at_bound()
    }

    /// The sentence on two moduli that cannot be distinguished because the fit ended where one of them is none, or at the
    /// end of the shapes that are sought; none elsewhere. `known` is of the law's own parameters.
    fn at_edge(&self, known: &Uncertainty) -> Option<String> {
        if self.law != CandidateLaw::MooneyRivlin || !self.at_bound(1) {
            return None;
        }
        let error = known.covariance.sum().max(0.0).sqrt();
        Some(format!(
            "c10_pa and c01_pa are not identified: the fit ended at the edge of what is sought, where c01_pa is {} of \
             their sum, which is {}",
            self.shape()[0],
            plain_quantity("_pa", self.modulus(), Some(error))
        ))
    }
}

/// The same fit in the law's own parameters; what follows them is left as it is.
pub(super) fn in_own_parameters(found: &LawFit) -> Fit {
    let own = found.law.parameters(found.modulus(), found.shape());
    let mut fit = found.fit.clone();
    for (place, parameter) in own.iter().enumerate() {
        let [lower, upper] = match (found.at_bound(place), parameter.name.ends_with("_pa")) {
            // On its bound it is no estimate.
            (true, _) => [parameter.value; 2],
            (false, true) => [0.0, f64::INFINITY],
            (false, false) => [f64::NEG_INFINITY, f64::INFINITY],
        };
        let named = Parameter::new(parameter.name, parameter.value);
        fit.parameters[place] = named.within(lower, upper);
    }
    let columns = found.fit.jacobian.columns(0, own.len()) * to_shape(&own);
    fit.jacobian.columns_mut(0, own.len()).copy_from(&columns);
    fit
}

fn correlation(covariance: &DMatrix<f64>, count: usize) -> Option<f64> {
    if count < 2 {
        return None;
    }
    let size = (covariance[(0, 0)] * covariance[(1, 1)]).sqrt();
    (size > 0.0).then(|| covariance[(0, 1)] / size)
}
