//! The force on a tip over inclusions: their effect on its displacement depends on the contact area, and so on the
//! force.

use nalgebra::Matrix3;
use palpate_geometry::Vec3;
use palpate_mechanics::{Limit, LinearElastic, Reached, TipForce, TipLaw};

use crate::regions::TipExchange;
use crate::tool::Tool;

/// Iterations, of which most are never needed: each leaves a third of the change at most, if an inclusion makes the tip
/// no more than twice as stiff.
const MAX_ROUNDS: usize = 40;

/// Relative change of the force that ends the iterations [-].
const SETTLED: f64 = 1e-10;

impl Tool {
    /// The force of a tip with this `law` that is `displaced` [m] in series with the `compliance` [m/N] of an organ,
    /// both in the contact frame, `over` inclusions in tissue of a law; and the compliance including that of the
    /// inclusions.
    pub(crate) fn force_in_series(
        &self,
        law: &TipLaw,
        displaced: &Vec3,
        compliance: &Matrix3<f64>,
        over: Option<(TipExchange, &LinearElastic)>,
    ) -> (TipForce, Matrix3<f64>) {
        let Some((exchange, around)) = over else {
            return (law.force_in_series(displaced, compliance), *compliance);
        };
        let solve = |touching: f64| {
            let own = exchange.compliance(touching);
            let [more, growth] = own.map(|own| own / around.youngs_modulus());
            let mut all = *compliance;
            all[(2, 2)] += more;
            (law.force_in_series(displaced, &all), all, growth)
        };
        let mut found = solve(self.typical_radius);
        let mut change = 0.0;
        for _ in 0..MAX_ROUNDS {
            let before = found.0.force.z;
            found = solve(self.touching_radius(around, before.max(0.0)));
            change = (found.0.force.z - before).abs() / before.abs().max(f64::MIN_POSITIVE);
            if change <= SETTLED {
                break;
            }
        }
        let (mut answer, compliance, growth) = found;
        if change > SETTLED {
            let reached = Reached {
                unbounded: change,
                used: SETTLED,
            };
            answer.limits.add(Limit::Coupling, reached);
        }
        // The compliance changes with the force.
        let force = answer.force.z;
        if force > 0.0 {
            let by_force = answer.by_compliance * (growth / force);
            let along_normal = answer.stiffness.row(2) / (1.0 - by_force.z);
            answer.stiffness += by_force * along_normal;
        }
        (answer, compliance)
    }
}
