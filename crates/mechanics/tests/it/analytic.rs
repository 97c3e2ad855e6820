//! Closed forms of contact and of relaxation.

use palpate_mechanics::contact::{Friction, Tip, half_space_stiffness, hertz_force};
use palpate_mechanics::{ForceHistory, PronySeries, TipLaw, Vec3};

use crate::contacts::tissue;

#[test]
fn flat_tip_is_linear_in_depth() {
    let law = tissue(0.3);
    let tip = Tip::Flat { radius: 2e-3 };
    for bond in [Friction::Frictionless, Friction::Bonded] {
        let stiffness = half_space_stiffness(&law, 2e-3, bond);
        let tissue = TipLaw::linear(tip, bond, law);
        for depth in [0.0, 1e-4, 1e-3, 8e-3] {
            let found = tissue.normal_force(depth, stiffness);
            assert_eq!(found.force, stiffness * depth);
        }
        assert_eq!(tissue.normal_force(-1e-3, stiffness).force, 0.0);
        assert_eq!(tip.contact_radius(1e-3), 2e-3);
    }
    // (6.1) by hand: 2 × 2 mm × 10 kPa / 0.91.
    let slip = half_space_stiffness(&law, 2e-3, Friction::Frictionless);
    assert!((slip - 40.0 / 0.91).abs() < 1e-12);
    // 4 G a ln(3 − 4ν)/(1 − 2ν) by hand, G = 10 kPa / 2.6.
    let stick = half_space_stiffness(&law, 2e-3, Friction::Bonded);
    assert!((stick - 80.0 / 2.6 * 1.8f64.ln() / 0.4).abs() < 1e-12);
}

/// Judge: Hertz, whose force is the integral of the stiffness of the growing flat contact.
#[test]
fn sphere_is_hertz() {
    let law = tissue(0.45);
    let tip = Tip::Sphere { radius: 5e-3 };
    let depth = 1e-3;
    // 4/3 × 10 kPa / 0.7975 × √5 mm × 1 mm^1.5 by hand.
    let by_hand = 4.0 / 3.0 * 1e4 / 0.7975 * (5e-3f64).sqrt() * 1e-3f64.powf(1.5);
    let hertz = hertz_force(&law, 5e-3, depth);
    assert!((hertz / by_hand - 1.0).abs() < 1e-14);
    let steps = 1_000;
    let integral: f64 = (0..steps)
        .map(|k| {
            let here = depth * (f64::from(k) + 0.5) / f64::from(steps);
            half_space_stiffness(&law, tip.contact_radius(here), Friction::Frictionless)
        })
        .sum::<f64>()
        * depth
        / f64::from(steps);
    // The midpoint rule for a square root that starts at zero: 0.08 n^-1.5.
    assert!((integral / hertz - 1.0).abs() < 1e-5, "{integral} {hertz}");
    let tissue = TipLaw::linear(tip, Friction::Frictionless, law);
    let shallow = 1e-5;
    let half_space =
        half_space_stiffness(&law, tip.contact_radius(shallow), Friction::Frictionless);
    let met = tissue.normal_force(shallow, half_space).force;
    // A five-hundredth of the radius deep: points of the surface are carried inward, 0.3 (1 − 2ν) a/ρ.
    assert!((met / hertz_force(&law, 5e-3, shallow) - 1.0).abs() < 0.003);
    assert_eq!(tissue.normal_force(0.0, 1.0).force, 0.0);
}

fn liver() -> PronySeries {
    PronySeries::new(&[(0.2866, 1.537), (0.2022, 6.090)]).unwrap()
}

/// Judge: a jump relaxes as G(t), whatever the steps.
#[test]
fn step_relaxes_as_the_series() {
    let series = liver();
    let mut history = ForceHistory::default();
    let mut force = history.advance(&series, Vec3::x(), 0.0);
    assert_eq!(force.x, 1.0);
    let mut time = 0.0;
    for step in [0.005, 0.1, 1.0, 10.0] {
        for _ in 0..5 {
            force = history.advance(&series, Vec3::x(), step);
            time += step;
            // Rounding over twenty steps.
            assert!((force.x - series.relaxation(time)).abs() < 1e-13);
        }
    }
}

/// Judge: the closed integral ∫ G(t − s) ds of a ramp of unit rate.
#[test]
fn ramp_is_the_closed_integral() {
    let series = liver();
    let mut history = ForceHistory::default();
    let step = 0.005;
    for k in 1..=400 {
        let time = f64::from(k) * step;
        let force = history.advance(&series, Vec3::x() * time, step);
        let closed = time
            - [(0.2866, 1.537), (0.2022, 6.090)]
                .iter()
                .map(|(g, tau)| g * (time + tau * (-time / tau as &f64).exp_m1()))
                .sum::<f64>();
        // Rounding over four hundred steps.
        assert!((force.x - closed).abs() < 1e-12, "{time}");
    }
}
