//! Interpolation between solved curves: a fit needs a dozen curves, finite elements give one in seconds.
//!
//! Of a law with one shape w, the logarithm of the force goes between two of them as the cubic that has its values and
//! slopes at both; beyond the last as the line there. The force of every law here grows steadily with the shape, that of
//! the exponential one about as its exponential. Of several shapes, with r_k the distance from those that were solved,
//! over the ranges in which they are sought, it is
//!   ln f = Σ W_k (ln f_k + ∇ln f_k · (w − w_k)), W_k ~ r_k⁻⁴,
//! which has its values and slopes too [Shepard 1968]. Near what was solved last, that is its tangent, so that solving at
//! the minimum and seeking again is the method of Gauss and Newton.
//!
//! *How we know*: a fit is ended by a curve that was solved at its own shape (`law_fit.rs`), and
//! `family::an_exponential_law_needs_few_runs`.
//!
//! *Limits*: all curves have the same depths.

use palpate_mechanics::IndentationCurve;

use super::curves::UnitCurve;
use super::law::ShapeRange;

/// Curves of one law; of one shape, by ascending shape.
#[derive(Debug, Clone)]
pub(super) struct Family {
    known: Vec<UnitCurve>,
    /// How far each shape reaches [-].
    ranges: Vec<f64>,
}

/// The logarithm of a force with its change with each shape.
type Logarithm = (f64, Vec<f64>);

impl Family {
    /// Of a law that is sought between these shapes.
    pub(super) fn of(shapes: &[ShapeRange], first: UnitCurve) -> Self {
        Self {
            known: vec![first],
            ranges: shapes.iter().map(|own| own.upper - own.lower).collect(),
        }
    }

    /// One more; one of known shapes is none.
    pub(super) fn add(&mut self, curve: UnitCurve) {
        let is_before = |own: &UnitCurve| own.shape.first() < curve.shape.first();
        let place = self.known.partition_point(is_before);
        if self.known.iter().all(|own| own.shape != curve.shape) {
            self.known.insert(place, curve);
        }
    }

    /// The known shapes next to `shape` [-].
    pub(super) fn nearest(&self, shape: &[f64]) -> &[f64] {
        let each = self.known.iter();
        let squares = |own: &UnitCurve| self.squared_distance(&own.shape, shape);
        let nearest = each.min_by(|a, b| squares(a).total_cmp(&squares(b)));
        nearest.map_or(&[], |own| &own.shape)
    }

    fn squared_distance(&self, one: &[f64], other: &[f64]) -> f64 {
        let each = one.iter().zip(other).zip(&self.ranges);
        each.map(|((one, other), range)| ((one - other) / range).powi(2))
            .sum()
    }

    /// The curve of these shapes [-].
    pub(super) fn at(&self, shape: &[f64]) -> UnitCurve {
        let (used, logarithms): (Vec<&UnitCurve>, Vec<Logarithm>) = match *shape {
            [shape] => self.between(shape),
            _ => self.blended(shape),
        };
        let depths: Vec<f64> = used[0].positive_points().map(|(depth, _)| depth).collect();
        let through = |of: &dyn Fn(&Logarithm) -> f64| {
            IndentationCurve::through(&depths, &logarithms.iter().map(of).collect::<Vec<_>>())
        };
        let of_shapes = (0..shape.len()).map(|place| through(&|(log, by)| log.exp() * by[place]));
        UnitCurve {
            shape: shape.to_vec(),
            force: through(&|(log, _)| log.exp()),
            by_shape: of_shapes.collect(),
            discretisation: used
                .iter()
                .map(|own| own.discretisation)
                .fold(0.0, f64::max),
            base: None,
        }
    }

    /// By the curves below and above the one shape.
    fn between(&self, shape: f64) -> (Vec<&UnitCurve>, Vec<Logarithm>) {
        let after = self.known.partition_point(|own| own.shape[0] < shape);
        let high = &self.known[after.min(self.known.len() - 1)];
        let low = &self.known[after.saturating_sub(1)];
        let each = low.logarithms().zip(high.logarithms());
        let each = each.map(|((one, by_one), (other, by_other))| {
            let ends = [[one, by_one[0]], [other, by_other[0]]];
            let places = [low.shape[0], high.shape[0]];
            let [log, slope] = match places[0] < places[1] {
                true => cubic(places, ends, shape),
                false => [one + (shape - places[0]) * by_one[0], by_one[0]],
            };
            (log, vec![slope])
        });
        let each = each.collect();
        (vec![low, high], each)
    }

    /// By all curves, the near ones above all.
    fn blended(&self, shape: &[f64]) -> (Vec<&UnitCurve>, Vec<Logarithm>) {
        let each = self.known.iter();
        let squares: Vec<f64> = each
            .map(|own| {
                self.squared_distance(&own.shape, shape)
                    .max(f64::MIN_POSITIVE.sqrt())
            })
            .collect();
        let nearest = squares.iter().copied().fold(f64::INFINITY, f64::min);
        let weights: Vec<f64> = squares.iter().map(|own| (nearest / own).powi(2)).collect();
        let whole: f64 = weights.iter().sum();
        // ∂ ln W_k of each before they are made to sum up to one.
        let change = |known: &UnitCurve, squared: f64, place: usize| {
            -4.0 * (shape[place] - known.shape[place]) / (self.ranges[place].powi(2) * squared)
        };
        let mut found: Vec<Logarithm> = Vec::new();
        let each = self.known.iter().zip(&squares).zip(&weights);
        let changes: Vec<f64> = (0..shape.len())
            .map(|place| {
                let each = each.clone();
                each.map(|((known, squared), weight)| {
                    weight / whole * change(known, *squared, place)
                })
                .sum()
            })
            .collect();
        for ((known, squared), weight) in each {
            let share = weight / whole;
            for (row, (log, by)) in known.logarithms().enumerate() {
                let ahead = by.iter().zip(shape).zip(&known.shape);
                let tangent = log + ahead.map(|((by, to), from)| by * (to - from)).sum::<f64>();
                if row == found.len() {
                    found.push((0.0, vec![0.0; shape.len()]));
                }
                let (value, slopes) = &mut found[row];
                *value += share * tangent;
                for (place, slope) in slopes.iter_mut().enumerate() {
                    let of_weight = change(known, *squared, place) - changes[place];
                    *slope += share * (by[place] + of_weight * tangent);
                }
            }
        }
        (self.known.iter().collect(), found)
    }
}

impl UnitCurve {
    /// Depths [m] with a positive force, and that force.
    fn positive_points(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.force.points().filter(|(_, force)| *force > 0.0)
    }

    /// The logarithm of each force that was found, with its change with each shape.
    fn logarithms(&self) -> impl Iterator<Item = Logarithm> + '_ {
        self.positive_points().map(|(depth, force)| {
            let by = self.by_shape.iter();
            (force.ln(), by.map(|by| by.force(depth) / force).collect())
        })
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

    const DEPTHS: [f64; 3] = [1e-3, 2e-3, 3e-3];
    const ONE: [ShapeRange; 1] = [ShapeRange {
        lower: 0.0,
        start: 0.5,
        upper: 3.0,
    }];

    /// A curve with these logarithms of the force at a depth, and their changes with the shapes.
    fn curve(shape: &[f64], log: impl Fn(f64) -> (f64, Vec<f64>)) -> UnitCurve {
        let through = |of: &dyn Fn(f64) -> f64| IndentationCurve::through(&DEPTHS, &DEPTHS.map(of));
        let by = (0..shape.len()).map(|place| through(&|d| log(d).0.exp() * log(d).1[place]));
        UnitCurve {
            shape: shape.to_vec(),
            force: through(&|d| log(d).0.exp()),
            by_shape: by.collect(),
            discretisation: 0.0,
            base: None,
        }
    }

    /// ln f is a cubic of the shape at each depth.
    fn cubic_curve(shape: f64) -> UnitCurve {
        curve(&[shape], |d| {
            let log = 100.0 * d * (1.0 + 0.5 * shape + 0.1 * shape.powi(3));
            (log, vec![100.0 * d * (0.5 + 0.3 * shape * shape)])
        })
    }

    fn close(a: f64, b: f64) -> bool {
        (a / b - 1.0).abs() < 1e-12
    }

    /// Judge: the one curve that is known, of a law that has no shape.
    #[test]
    fn a_law_without_a_shape_keeps_its_curve() {
        let known = curve(&[], |d| (100.0 * d, Vec::new()));
        let found = Family::of(&[], known.clone()).at(&[]);
        assert!(
            found.force.approximates(&known.force, 1e-14)
                && known.force.approximates(&found.force, 1e-14)
        );
        assert!(found.by_shape.is_empty());
    }

    /// Judge: a force whose logarithm is a cubic, which comes back exactly between two shapes; at known shapes it does
    /// beyond them too.
    #[test]
    fn a_cubic_comes_back() {
        let mut family = Family::of(&ONE, cubic_curve(2.0));
        family.add(cubic_curve(0.5));
        family.add(cubic_curve(2.0));
        assert_eq!(family.known.len(), 2);
        for shape in [0.5, 0.8, 1.7, 2.0] {
            let (found, truth) = (family.at(&[shape]), cubic_curve(shape));
            for depth in DEPTHS {
                assert!(
                    close(found.force.force(depth), truth.force.force(depth)),
                    "{shape}"
                );
                assert!(
                    close(
                        found.by_shape[0].force(depth),
                        truth.by_shape[0].force(depth)
                    ),
                    "{shape}"
                );
            }
        }
        assert_eq!(family.nearest(&[0.7]), [0.5]);
        let beyond = family.at(&[2.1]).force.force(2e-3) / cubic_curve(2.1).force.force(2e-3);
        assert!((beyond - 1.0).abs() < 0.01, "{beyond}");
    }

    /// Judge: at known shapes the curves there, with their slopes; in between central differences, right to the square
    /// of a step of 1e-5; and a force whose logarithm is linear in two shapes, which comes back everywhere.
    #[test]
    fn several_shapes_are_blended() {
        let ranges = [
            ONE[0],
            ShapeRange {
                upper: 10.0,
                ..ONE[0]
            },
        ];
        let of = |bent: f64| {
            move |[a, b]: [f64; 2]| {
                curve(&[a, b], |d| {
                    let log = 100.0 * d * (1.0 + 0.5 * a - 0.1 * b + bent * a * b);
                    let by = [0.5 + bent * b, bent * a - 0.1];
                    (log, by.map(|by| 100.0 * d * by).to_vec())
                })
            }
        };
        let places = [[0.5, 1.0], [2.0, 3.0], [1.0, 9.0]];
        let family = |bent: f64| {
            let mut family = Family::of(&ranges, of(bent)(places[0]));
            places[1..]
                .iter()
                .for_each(|&place| family.add(of(bent)(place)));
            family
        };
        let bent = family(0.02);
        for place in places {
            let (found, truth) = (bent.at(&place), of(0.02)(place));
            assert!(close(found.force.force(2e-3), truth.force.force(2e-3)));
            for (found, truth) in found.by_shape.iter().zip(&truth.by_shape) {
                assert!(close(found.force(2e-3), truth.force(2e-3)));
            }
        }
        assert_eq!(bent.nearest(&[1.9, 3.2]), places[1]);
        let at = [1.3, 4.0];
        for place in 0..2 {
            let moved = |by: f64| {
                let mut shape = at;
                shape[place] += by;
                bent.at(&shape).force.force(2e-3)
            };
            let slope = (moved(1e-5) - moved(-1e-5)) / 2e-5;
            let own = bent.at(&at).by_shape[place].force(2e-3);
            assert!((slope - own).abs() < 1e-7 * own.abs(), "{slope} {own}");
        }
        let (found, truth) = (family(0.0).at(&at), of(0.0)(at));
        assert!(close(found.force.force(3e-3), truth.force.force(3e-3)));
    }
}
