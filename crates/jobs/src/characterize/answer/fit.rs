use std::collections::BTreeMap;

use nalgebra::DMatrix;
use palpate_characterize::Characterization;
use palpate_characterize::inverse::{CandidateLaw, Correlations, LawDescription};
use palpate_characterize::lumped::{PieceTest, UniaxialFit};
use serde::{Deserialize, Serialize};

use super::values::correlations_of_piece;

/// How a law was fitted: the basis of its values and errors.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct FitAnswer {
    /// Lower and upper bound of each fitted parameter; null: no bound.
    pub bounds: BTreeMap<String, [Option<f64>; 2]>,
    /// Of the parameters that have an error, and of the relaxation parameters used for the law.
    pub covariance: CovarianceAnswer,
    /// Samples that were fitted.
    pub samples: usize,
    /// Effective number of independent samples [-].
    pub effective_samples: f64,
    /// Akaike's, with the correction for few samples [-]; comparable between the laws of a specimen.
    pub information_criterion: Option<f64>,
    /// The instantaneous elastic force; null of a piece, whose stress is a closed form.
    pub elastic: Option<ElasticAnswer>,
    /// How the first piece was deformed; null of an indentation.
    pub test: Option<PieceTest>,
    /// The angle of its loading to the axis of its fibres [degrees]; null where it is not stated.
    #[serde(default)]
    pub fibre_axis_angle_deg: Option<f64>,
}

/// A covariance.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct CovarianceAnswer {
    /// By their keys; of the relaxation `g_1`, `tau_1_s` and so on.
    pub parameters: Vec<String>,
    /// Row by row [products of the units of their keys].
    pub matrix: Vec<Vec<f64>>,
}

/// An elastic force over depth: monotone cubics through these points, beyond them along the tangent.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct ElasticAnswer {
    /// Ascending [m].
    pub depth_m: Vec<f64>,
    /// [N]
    pub force_n: Vec<f64>,
    /// Change of the force with each parameter [N over its unit].
    pub sensitivities: BTreeMap<String, Vec<f64>>,
}

impl CovarianceAnswer {
    fn of(known: Correlations) -> Self {
        let rows = known.covariance.row_iter();
        Self {
            matrix: rows.map(|row| row.iter().copied().collect()).collect(),
            parameters: known.names,
        }
    }

    /// As a matrix with its names.
    pub fn correlations(&self) -> Correlations {
        let count = self.parameters.len();
        let covariance = DMatrix::from_fn(count, count, |row, column| self.matrix[row][column]);
        Correlations::of(self.parameters.clone(), &covariance)
    }
}

/// How each law was fitted, by its key.
pub(super) fn fits(found: &Characterization) -> BTreeMap<String, FitAnswer> {
    let criteria = found.criteria();
    let criterion = |law: CandidateLaw| {
        let own = criteria.iter().find(|(of, _)| *of == law);
        own.map(|(_, criterion)| *criterion)
    };
    let pressed = found.laws.iter().filter_map(|(law, own)| {
        let own = own.as_ref().ok()?;
        Some((*law, of_indentation(own)))
    });
    let pulled = found.uniaxial.iter().filter_map(|(law, own)| {
        let own = own.as_ref().ok()?;
        Some((*law, of_piece(own)))
    });
    let named = pressed.chain(pulled).map(|(law, fit)| {
        let information_criterion = criterion(law);
        let fit = FitAnswer {
            information_criterion,
            ..fit
        };
        (law.name().word().to_owned(), fit)
    });
    named.collect()
}

fn of_indentation(law: &LawDescription) -> FitAnswer {
    let elastic = law.elastic();
    let points = || elastic.force.points().skip(1);
    let by = elastic.sensitivities.iter().map(|(name, curve)| {
        let changes = points().map(|(depth, _)| curve.force(depth));
        (name.clone(), changes.collect())
    });
    let shapes = law.found.law.shapes();
    // Each parameter but the first belongs to a shape; those without a unit are it.
    let bounds = law.parameters.iter().enumerate().map(|(place, (name, _))| {
        let shape = shapes.get(place.wrapping_sub(1));
        let [least, largest] = match shape.filter(|_| !name.ends_with("_pa")) {
            Some(shape) => [Some(shape.lower), Some(shape.upper)],
            None => [Some(0.0), None],
        };
        ((*name).to_owned(), [least, largest])
    });
    FitAnswer {
        bounds: bounds.collect(),
        covariance: CovarianceAnswer::of(law.correlations()),
        samples: law.found.fit.residuals.len(),
        effective_samples: law.uncertainty.effective_samples,
        information_criterion: None,
        elastic: Some(ElasticAnswer {
            depth_m: points().map(|(depth, _)| depth).collect(),
            force_n: points().map(|(_, force)| force).collect(),
            sensitivities: by.collect(),
        }),
        test: None,
        fibre_axis_angle_deg: None,
    }
}

fn of_piece(law: &UniaxialFit) -> FitAnswer {
    let finite = |bound: f64| bound.is_finite().then_some(bound);
    let bounds = law.fit.parameters.iter();
    let bounds = bounds.map(|own| {
        let [lower, upper] = match own.fixed {
            true => [own.value; 2],
            false => [own.lower, own.upper],
        };
        (own.name.clone(), [lower, upper].map(finite))
    });
    let first = law.loadings.first().copied().unwrap_or_default();
    FitAnswer {
        bounds: bounds.collect(),
        covariance: CovarianceAnswer::of(correlations_of_piece(law)),
        samples: law.fit.residuals.len(),
        effective_samples: law.uncertainty.effective_samples,
        information_criterion: None,
        elastic: None,
        test: Some(first.test),
        fibre_axis_angle_deg: first.fibre_axis_angle_deg,
    }
}
