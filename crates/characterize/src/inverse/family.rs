//! Curves between the shapes that were solved: a fit needs a dozen, finite elements give one in seconds.
//!
//! Between two shapes w the logarithm of the force goes as the cubic that has its values and slopes at both;
//! beyond the last as the line there. The force of every law here grows steadily with the shape, that of the
//! exponential one about as its exponential.
//!
//! *How we know*: a fit is ended by a curve that was solved at its own shape (`law_fit.rs`), and
//! `family::an_exponential_law_needs_few_runs`.
//!
//! *Limits*: all curves have the same depths.

use palpate_mechanics::IndentationCurve;

use super::curves::UnitCurve;

/// Curves of one law, by ascending shape.
#[derive(Debug, Clone)]
pub(super) struct Family {
    known: Vec<UnitCurve>,
}

impl Family {
    pub(super) fn of(first: UnitCurve) -> Self {
        Self { known: vec![first] }
    }

    /// One more; one of a known shape is none.
    pub(super) fn add(&mut self, curve: UnitCurve) {
        let place = self.known.partition_point(|own| own.shape < curve.shape);
        if self
            .known
            .get(place)
            .is_none_or(|own| own.shape > curve.shape)
        {
            self.known.insert(place, curve);
        }
    }

    /// The known shape next to `shape` [-].
    pub(super) fn nearest(&self, shape: f64) -> f64 {
        let shapes = self.known.iter().map(|own| own.shape);
        let nearer = |a: f64, b: f64| match (b - shape).abs() < (a - shape).abs() {
            true => b,
            false => a,
        };
        shapes.reduce(nearer).unwrap_or(shape)
    }

    /// The curve of `shape` [-].
    pub(super) fn at(&self, shape: f64) -> UnitCurve {
        let after = self.known.partition_point(|own| own.shape < shape);
        let high = &self.known[after.min(self.known.len() - 1)];
        let low = &self.known[after.saturating_sub(1)];
        // It hardly changes with the shape.
        let nearer = match shape - low.shape < high.shape - shape {
            true => low,
            false => high,
        };
        let mut values = Vec::new();
        for ((depth, one), (_, other)) in low.logarithms().zip(high.logarithms()) {
            let [log, slope] = match low.shape < high.shape {
                true => cubic([low.shape, high.shape], [one, other], shape),
                false => [one[0] + (shape - low.shape) * one[1], one[1]],
            };
            values.push((depth, log.exp(), log.exp() * slope));
        }
        let depths: Vec<f64> = values.iter().map(|own| own.0).collect();
        let through = |of: fn(&(f64, f64, f64)) -> f64| {
            IndentationCurve::through(&depths, &values.iter().map(of).collect::<Vec<_>>())
        };
        UnitCurve {
            shape,
            force: through(|own| own.1).with_hereditary(*nearer.force.hereditary()),
            by_shape: through(|own| own.2),
            discretisation: low.discretisation.max(high.discretisation),
        }
    }
}

impl UnitCurve {
    /// Depths [m] at which a force was found, each with the logarithm of the force and its change with the shape.
    fn logarithms(&self) -> impl Iterator<Item = (f64, [f64; 2])> + '_ {
        let felt = self.force.points().filter(|(_, force)| *force > 0.0);
        // A law without a shape has no curve of changes, which is zero everywhere.
        felt.map(|(depth, force)| (depth, [force.ln(), self.by_shape.force(depth) / force]))
    }
}

/// Value and slope at `x` of the cubic with value and slope at two places.
fn cubic([a, b]: [f64; 2], [one, other]: [[f64; 2]; 2], x: f64) -> [f64; 2] {
    let width = b - a;
    let t = (x - a) / width;
    let rise = other[0] - one[0];
    let [first, last] = [width * one[1] - rise, rise - width * other[1]];
    let value = one[0] + t * (rise + (1.0 - t) * (first + t * (last - first)));
    let slope =
        rise + (1.0 - 2.0 * t) * (first + t * (last - first)) + t * (1.0 - t) * (last - first);
    [value, slope / width]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(shape: f64) -> UnitCurve {
        let depths = [1e-3, 2e-3, 3e-3];
        // ln f is a cubic of the shape at each depth.
        let log = |d: f64| 100.0 * d * (1.0 + 0.5 * shape + 0.1 * shape.powi(3));
        let slope = |d: f64| 100.0 * d * (0.5 + 0.3 * shape * shape);
        UnitCurve {
            shape,
            force: IndentationCurve::through(&depths, &depths.map(|d| log(d).exp())),
            by_shape: IndentationCurve::through(&depths, &depths.map(|d| slope(d) * log(d).exp())),
            discretisation: 0.0,
        }
    }

    /// Judge: the one curve that is known, of a law that has no shape.
    #[test]
    fn a_law_without_a_shape_keeps_its_curve() {
        let known = UnitCurve {
            by_shape: IndentationCurve::untouched(),
            ..curve(0.0)
        };
        let found = Family::of(known.clone()).at(0.0);
        assert!(
            found.force.is_like(&known.force, 1e-14) && known.force.is_like(&found.force, 1e-14)
        );
        assert_eq!(found.by_shape.force(2e-3), 0.0);
    }

    /// Judge: a force whose logarithm is a cubic, which comes back exactly between two shapes; at known shapes it does
    /// beyond them too.
    #[test]
    fn a_cubic_comes_back() {
        let mut family = Family::of(curve(2.0));
        family.add(curve(0.5));
        family.add(curve(2.0));
        assert_eq!(family.known.len(), 2);
        for shape in [0.5, 0.8, 1.7, 2.0] {
            let (found, truth) = (family.at(shape), curve(shape));
            for depth in [1e-3, 2e-3, 3e-3] {
                let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
                assert!(
                    close(found.force.force(depth), truth.force.force(depth)),
                    "{shape}"
                );
                assert!(
                    close(found.by_shape.force(depth), truth.by_shape.force(depth)),
                    "{shape}"
                );
            }
        }
        assert_eq!(family.nearest(0.7), 0.5);
        let beyond = family.at(2.1).force.force(2e-3) / curve(2.1).force.force(2e-3);
        assert!((beyond - 1.0).abs() < 0.01, "{beyond}");
    }
}
