//! The same answer as another library, bounds included. Judge: basin's Levenberg-Marquardt method, which
//! treats bounds by the scaling of Coleman and Li and stays inside them.

use std::convert::Infallible;

use basin::{BoundedLevenbergMarquardt, Executor};
use nalgebra::{DMatrix, DVector};
use palpate_characterize::fit::{Parameter, Settings, Stop, least_squares_with_jacobian};

/// y = p₀ + p₁ e^(−t/p₂) at forty times, less a curve that it cannot follow.
struct Decay {
    lower: DVector<f64>,
    upper: DVector<f64>,
}

const COUNT: usize = 40;

fn residuals(p: &[f64], r: &mut [f64], jacobian: &mut DMatrix<f64>) -> Option<()> {
    for i in 0..COUNT {
        let t = 0.25 * i as f64;
        let fallen = (-t / p[2]).exp();
        let measured = 0.5 + 0.3 * (-t / 0.8).exp() + 0.2 * (-t / 6.0).exp();
        r[i] = p[0] + p[1] * fallen - measured;
        jacobian[(i, 0)] = 1.0;
        jacobian[(i, 1)] = fallen;
        jacobian[(i, 2)] = p[1] * fallen * t / (p[2] * p[2]);
    }
    Some(())
}

impl Decay {
    fn evaluate(&self, p: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let (mut r, mut jacobian) = (DVector::zeros(COUNT), DMatrix::zeros(COUNT, 3));
        residuals(p.as_slice(), r.as_mut_slice(), &mut jacobian).expect("defined everywhere");
        (r, jacobian)
    }
}

impl basin::Constraints for Decay {
    type Set = basin::ConstraintSet<basin::BoxBounds<DVector<f64>>>;
    fn constraints(&self) -> <Self::Set as basin::ConstraintDescription>::Borrowed<'_> {
        let bounds = basin::BoxBounds::new(Some(&self.lower), Some(&self.upper));
        basin::ConstraintSet::new().with_bounds(bounds)
    }
}

impl basin::CostFunction for Decay {
    type Param = DVector<f64>;
    type Output = f64;
    type Error = Infallible;
    fn cost(&self, p: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(0.5 * self.evaluate(p).0.norm_squared())
    }
}

impl basin::Residual for Decay {
    type Param = DVector<f64>;
    type Output = DVector<f64>;
    type Error = Infallible;
    fn residual(&self, p: &DVector<f64>) -> Result<DVector<f64>, Infallible> {
        Ok(self.evaluate(p).0)
    }
}

impl basin::Jacobian for Decay {
    type Jacobian = DMatrix<f64>;
    fn jacobian(&self, p: &DVector<f64>) -> Result<DMatrix<f64>, Infallible> {
        Ok(self.evaluate(p).1)
    }
}

/// With room both find the same, to the gradient at which the other one stops. Where a bound holds a parameter
/// back the other one stops short of it; ours is then not worse.
#[test]
fn another_library_finds_the_same() {
    let cases = [
        ([0.0, 0.0, 0.1], [2.0, 2.0, 50.0]),
        ([0.0, 0.0, 0.1], [2.0, 2.0, 1.2]),
        ([0.62, 0.0, 0.1], [2.0, 0.25, 50.0]),
    ];
    for (lower, upper) in cases {
        let start = [1.0, 0.2, 0.5];
        let parameters: Vec<_> = (0..3)
            .map(|i| Parameter::new(format!("p{i}"), start[i]).within(lower[i], upper[i]))
            .collect();
        let settings = Settings::default();
        let ours = least_squares_with_jacobian(&parameters, COUNT, &settings, residuals).unwrap();
        assert_eq!(ours.stop, Stop::Converged);
        let [lower, upper] = [lower, upper].map(|bound| DVector::from_row_slice(&bound));
        let method = BoundedLevenbergMarquardt::<DVector<f64>, DMatrix<f64>>::new()
            .with_absolute_scaled_gradient_tolerance(Some(1e-12));
        let start = DVector::from_row_slice(&start);
        let theirs = Executor::from_start(Decay { lower, upper }, method, start)
            .max_iter(500)
            .run()
            .unwrap();
        if ours.chosen().len() == 3 {
            for (ours, theirs) in ours.parameters.iter().zip(theirs.param().iter()) {
                assert!(
                    (ours.value / theirs - 1.0).abs() < 1e-6,
                    "{ours:?}, theirs {theirs}"
                );
            }
        }
        let cost = 0.5 * ours.sum_of_squares();
        let rounding = 1.0 + 1e-12;
        assert!(cost <= theirs.cost() * rounding, "{cost} {}", theirs.cost());
    }
}
