//! Stresses and strains along the elastic path of an indentation, and the work of one on the other.

use nalgebra::Matrix3;

use super::super::assembly;
use super::super::model::{FiniteElementModel, FiniteElementState};
use crate::HereditaryFactor;
use crate::hereditary::FactorSample;

/// What is kept at each depth.
#[derive(Debug, Clone, Default)]
pub(super) struct ElasticPath {
    places: Vec<Place>,
}

#[derive(Debug, Clone)]
struct Place {
    /// [m]
    depth: f64,
    /// [N]
    force: f64,
    /// At the points of integration [Pa].
    stress: Vec<Matrix3<f64>>,
    /// At the points of integration [-].
    strain: Vec<Matrix3<f64>>,
}

impl ElasticPath {
    /// One more equilibrium, deeper than those before.
    pub(super) fn add(
        &mut self,
        model: &FiniteElementModel,
        state: &FiniteElementState,
        [depth, force]: [f64; 2],
    ) {
        if self.places.last().is_some_and(|last| last.depth >= depth) || depth <= 0.0 {
            return;
        }
        self.places.push(Place {
            depth,
            force,
            stress: assembly::elastic_stresses(model, &state.unknowns),
            strain: assembly::strains(model, &state.unknowns),
        });
    }

    /// κ of (d, d′), from the work of each stress on each change of strain.
    pub(super) fn factor(&self, model: &FiniteElementModel) -> HereditaryFactor {
        let samples = self.samples(model);
        let deepest = self.places.last().map_or(1.0, |last| last.depth);
        HereditaryFactor::nearest(deepest, &samples)
    }

    fn samples(&self, model: &FiniteElementModel) -> Vec<FactorSample> {
        let weights = &model.mapping.weights;
        let mut samples = Vec::new();
        for earlier in self.places.iter().filter(|place| place.force > 0.0) {
            let work = |strain: &[Matrix3<f64>]| {
                let each = weights.iter().zip(&earlier.stress).zip(strain);
                each.map(|((weight, s), e)| weight * s.dot(e)).sum::<f64>()
            };
            let (mut depth, mut before) = (0.0, 0.0);
            for later in &self.places {
                let after = work(&later.strain);
                let step = later.depth - depth;
                samples.push(FactorSample {
                    later: [depth, later.depth],
                    earlier: earlier.depth,
                    mean: (after - before) / (step * earlier.force),
                    // As it counts in the force at the later depth.
                    weight: (earlier.force / later.force).min(1.0).powi(2) * step,
                });
                (depth, before) = (later.depth, after);
            }
        }
        samples
    }
}
