//! Forces between the answers of a model. What a hand-over costs is measured by the `reproduce` of the crate `palpate`.

use palpate_servo::{AffineForce, Extrapolator, HandOver, Vec3};

const KINDS: [HandOver; 3] = [HandOver::Hold, HandOver::Linear, HandOver::LocalModel];

/// A model that falls silent lets the force fall to nothing.
#[test]
fn a_stale_model_fades_to_zero() {
    for kind in KINDS {
        let mut extrapolator = Extrapolator::new(kind, 5e-3, 1e-3);
        let pressed = AffineForce {
            normal: Vec3::z(),
            ..AffineForce::new(
                0.0,
                Vec3::zeros(),
                Vec3::z(),
                -50.0 * nalgebra::Matrix3::identity(),
            )
        };
        extrapolator.receive(&pressed);
        let mut last = f64::INFINITY;
        for tick in 11..22 {
            let force = extrapolator
                .force(f64::from(tick) * 1e-3, &Vec3::zeros())
                .norm();
            assert!(force < last || force == 0.0, "{kind:?}, {tick} ms: {force}");
            last = force;
        }
        assert_eq!(last, 0.0, "{kind:?}");
    }
}
