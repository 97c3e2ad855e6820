//! The stiffness of a tip is the slope of its force: central differences, whose error falls with the square
//! of the step.

use nalgebra::Matrix3;
use palpate_mechanics::contact::{
    Friction, Tip, half_space_stiffness, half_space_tangential_stiffness,
};
use palpate_mechanics::finite_elements::indentation::Stiffening;
use palpate_mechanics::{Limit, Material, TipLaw, Vec3};

use crate::contacts::tissue;

/// At this depth, and at the parts of it that the tip itself takes in a softer organ, away from the knots of
/// the stored curves, whose second derivatives jump there [m].
const DEPTH: f64 = 0.32 * RADIUS;
const RADIUS: f64 = 5e-3;
const TIPS: [Tip; 2] = [Tip::Flat { radius: RADIUS }, Tip::Sphere { radius: RADIUS }];
const BONDS: [Friction; 2] = [Friction::Bonded, Friction::Frictionless];

fn neo_hookean() -> Material {
    let text =
        "format = 1\n[tissue]\ndensity_kg_m3 = 1000.0\nlaw = \"neo_hookean\"\nc10_pa = 1000.0";
    let tissue = palpate_files::Tissue::parse(text, "tissue.toml").unwrap();
    Material::from_tissue(&tissue).unwrap()
}

/// Linear and neo-Hookean tissue under every kind of tip.
fn laws() -> impl Iterator<Item = (TipLaw, Tip, Friction)> {
    let soft = neo_hookean();
    TIPS.into_iter()
        .flat_map(|tip| BONDS.map(|bond| (tip, bond)))
        .flat_map(move |(tip, bond)| {
            let curve = Stiffening::neo_hookean(tip, bond);
            [
                TipLaw::linear(tip, bond, soft.at_rest),
                TipLaw::stiffening(tip, bond, &soft, curve),
            ]
            .map(|law| (law, tip, bond))
        })
}

/// Stiffness of the half-space at `depth` [m], normal and tangential [N/m].
fn half_space(tip: Tip, bond: Friction, depth: f64) -> [f64; 2] {
    let law = neo_hookean().at_rest;
    let radius = tip.contact_radius(depth);
    [
        half_space_stiffness(&law, radius, bond),
        half_space_tangential_stiffness(&law, radius),
    ]
}

/// Checks `slope` against central differences of `force`: of order two, where the force is curved enough to
/// show it over rounding.
fn check_slope(what: &str, slope: &Vec3, step: f64, force: impl Fn(f64) -> Vec3) {
    let scale = slope.norm().max(force(0.0).norm() / DEPTH);
    let error = |step: f64| {
        let difference = (force(step) - force(-step)) / (2.0 * step);
        (difference - slope).norm() / scale
    };
    let (coarse, fine) = (error(step), error(0.5 * step));
    assert!(fine < 1e-3, "{what}: {fine}");
    if coarse > 1e-6 {
        let order = (coarse / fine).log2();
        assert!(
            (order - 2.0).abs() < 0.1,
            "{what}: observed order {order} ({coarse}, {fine})"
        );
    }
}

/// Structural compliances in units of the half-space's, from 2.5 times its stiffness to half of it.
const OF_HALF_SPACE: [f64; 6] = [-0.6, -0.4, -0.2, 0.0, 0.3, 1.0];

#[test]
fn normal_stiffness_is_the_slope_of_the_force() {
    for (law, tip, bond) in laws() {
        for part in OF_HALF_SPACE {
            let compliance = part / half_space(tip, bond, DEPTH)[0];
            let at = |more: f64| law.normal_force_in_series(DEPTH + more, compliance);
            let slope = Vec3::new(0.0, 0.0, at(0.0).stiffness);
            check_slope(
                &format!("{tip:?} {bond:?} {part}"),
                &slope,
                0.01 * DEPTH,
                |more| Vec3::new(0.0, 0.0, at(more).force),
            );
            let step = 1e-3 / half_space(tip, bond, DEPTH)[0];
            // At zero one form passes into the other.
            if part != 0.0 {
                let with = |more: f64| law.normal_force_in_series(DEPTH, compliance + more).force;
                let change = (with(step) - with(-step)) / (2.0 * step);
                // Second order in a step of a thousandth.
                assert!((change / at(0.0).by_compliance - 1.0).abs() < 1e-5);
            }
        }
    }
}

/// Symmetric, and coupled as at a place that is not like a half-space; in units of its compliances.
fn compliance(tip: Tip, bond: Friction, scale: f64) -> Matrix3<f64> {
    let [normal, tangential] = half_space(tip, bond, DEPTH);
    let unit = 1.0 / normal.min(tangential);
    Matrix3::new(0.8, 0.15, 0.1, 0.15, 0.5, -0.2, 0.1, -0.2, 0.7) * (scale * unit)
}

#[test]
fn coupled_stiffness_is_the_slope_of_the_force() {
    for (law, tip, bond) in laws() {
        for scale in [-0.5, -0.2, 0.3, 1.0] {
            let compliance = compliance(tip, bond, scale);
            let displacement = Vec3::new(0.1, -0.06, -1.0) * DEPTH;
            let found = law.force_in_series(&displacement, &compliance);
            assert!(found.limits.is_empty());
            for axis in 0..3 {
                let slope = -found.stiffness.column(axis).into_owned();
                let what = format!("{tip:?} {bond:?} {scale} axis {axis}");
                check_slope(&what, &slope, 0.01 * DEPTH, |more| {
                    let moved = displacement + Vec3::ith(axis, more);
                    law.force_in_series(&moved, &compliance).force
                });
            }
        }
    }
}

/// The local model gives stiffnesses; what it adds to the half-space is held.
#[test]
fn stiffness_with_a_local_model_is_the_slope_of_the_force() {
    for (law, tip, bond) in laws() {
        for part in [-0.5, -0.2, 0.3] {
            let added = compliance(tip, bond, part);
            // The tangents do not couple to the normal there.
            let stiffness = |depth: f64| {
                let [normal, tangential] = half_space(tip, bond, depth);
                let own = Vec3::new(1.0 / tangential, 1.0 / tangential, 1.0 / normal);
                let mut all = added + Matrix3::from_diagonal(&own);
                for along in 0..2 {
                    all[(along, 2)] = 0.0;
                    all[(2, along)] = 0.0;
                }
                let mut stiffness = all.try_inverse().unwrap();
                if bond == Friction::Frictionless {
                    stiffness.fixed_view_mut::<2, 2>(0, 0).fill(0.0);
                }
                stiffness
            };
            let displacement = Vec3::new(0.1, -0.06, -1.0) * DEPTH;
            let at = |moved: &Vec3| law.force(moved, &stiffness(-moved.z));
            let found = at(&displacement).stiffness;
            for axis in 0..3 {
                let slope = -found.column(axis).into_owned();
                let what = format!("{tip:?} {bond:?} {part} axis {axis}");
                check_slope(&what, &slope, 0.01 * DEPTH, |more| {
                    at(&(displacement + Vec3::ith(axis, more))).force
                });
            }
        }
    }
}

/// Force and stiffness pass through the half-space without a jump: what two organs differ by, one a little
/// stiffer than it and one a little softer, falls with the difference of their compliances.
#[test]
fn force_and_stiffness_are_continuous_at_the_half_space() {
    for (law, tip, bond) in laws() {
        let displacement = Vec3::new(0.1, -0.06, -1.0) * DEPTH;
        let at = |scale: f64| law.force_in_series(&displacement, &compliance(tip, bond, scale));
        let there = at(0.0);
        let gap = |scale: f64| {
            [scale, -scale]
                .map(|scale| {
                    let here = at(scale);
                    let force = (here.force - there.force).norm() / there.force.norm();
                    let stiffness = here.stiffness - there.stiffness;
                    force.max(stiffness.norm() / there.stiffness.norm())
                })
                .into_iter()
                .fold(0.0, f64::max)
        };
        let order = (gap(1e-3) / gap(1e-4)).log10();
        assert!((order - 1.0).abs() < 0.02, "{tip:?} {bond:?}: {order}");
    }
}

/// k₁ [N/m] of the half-space that the law has of a stiffer organ: F₀/d, half as much again under a sphere.
fn slope_at_depth(law: &TipLaw, tip: Tip) -> f64 {
    let exponent = match tip {
        Tip::Flat { .. } => 1.0,
        Tip::Sphere { .. } => 1.5,
    };
    exponent * law.normal_force_in_series(DEPTH, 0.0).force / DEPTH
}

/// Judge: q F₀ by hand, with q = 1/(1 + c k₁) and k₁ ∝ F₀/d.
#[test]
fn sphere_in_a_stiffer_organ_stiffens_with_its_touching_area() {
    let law = tissue(0.45);
    let tip = Tip::Sphere { radius: RADIUS };
    let sphere = TipLaw::linear(tip, Friction::Frictionless, law);
    let half_space = slope_at_depth(&sphere, tip);
    let exponent_at = |compliance: f64| {
        let found = sphere.normal_force_in_series(DEPTH, compliance);
        found.stiffness * DEPTH / found.force
    };
    for times in [1.25, 1.67, 2.5] {
        let product = 1.0 / times - 1.0;
        // d ln F/d ln d = n − (n − 1) c k₁ q with n = d ln F₀/d ln d.
        let exponent = exponent_at(0.0);
        let expected = exponent - (exponent - 1.0) * product * times;
        let found = exponent_at(product / half_space);
        assert!((found / expected - 1.0).abs() < 1e-12);
    }
}

/// A bounded stiffness says so, with what it would have been; and not a number stays none.
#[test]
fn a_bounded_stiffness_is_told() {
    for (law, tip, bond) in laws() {
        let [_, tangential] = half_space(tip, bond, DEPTH);
        let normal = slope_at_depth(&law, tip);
        let inward = Vec3::new(0.01, 0.0, -1.0) * DEPTH;
        for (product, asked) in [(-0.96, 25.0), (-1.2, f64::INFINITY)] {
            let diagonal = Vec3::new(product / tangential, 0.0, product / normal);
            let found = law.force_in_series(&inward, &Matrix3::from_diagonal(&diagonal));
            let told = found.limits.reached(Limit::TipStiffness).unwrap();
            // Rounding of 1/(1 − 0.96).
            assert!(told.unbounded == asked || (told.unbounded / asked - 1.0).abs() < 1e-12);
            assert_eq!(told.used, 20.0);
            let along = found.limits.reached(Limit::TipShearStiffness);
            assert_eq!(along.is_some(), bond == Friction::Bonded);
            assert!(found.force.z > 0.0 && found.stiffness[(2, 2)] > 0.0);
        }
        let unknown = law.force_in_series(&inward, &Matrix3::repeat(f64::NAN));
        assert!(unknown.force.z.is_nan());
    }
}
