//! The law of Holzapfel, Gasser and Ogden.
//!
//! Judges: the textbook's stresses by principal stretches [Gasser, Ogden and Holzapfel 2006], written again from the
//! invariants; other laws where fibres vanish or lose their direction; the integral of equilibrium over the wall of a tube.

use std::sync::Arc;

use nalgebra::{Matrix3, Rotation3};
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_elements::solid::solve_at;
use palpate_mechanics::finite_elements::tube::{Ends, Tube, TubeProblem, inflate};
use palpate_mechanics::finite_elements::uniaxial::stretched;
use palpate_mechanics::finite_elements::{ElementKind, Formulation, Supports};
use palpate_mechanics::{
    Error, FibreError, FibreField, FibreFrame, FibreSample, Fibres, HolzapfelGasserOgden, Law,
    NeoHookean, ReducedPolynomial, Vec3,
};

use crate::bodies::{Body, block, face};
use crate::contacts::Random;
use crate::every_law::{deformation, rotation, with_fibres};
use crate::solid::{at, cube, turned_cube};

/// The artery of the example in FEBio's manual, in pascals: c = 2 C10 = 7.64 kPa.
const ARTERY: [f64; 5] = [3820.0, 996_600.0, 524.6, 0.226, 49.98];

/// C10, k1, k2, dispersion and angle: stiff and soft fibres, one direction and two.
const LAWS: [[f64; 5]; 5] = [
    ARTERY,
    [1000.0, 3000.0, 1.5, 0.0, 0.0],
    [1000.0, 5000.0, 2.0, 0.1, 30.0],
    [1000.0, 500.0, 0.0, 0.3, 70.0],
    [1000.0, 2000.0, 1.0, 0.0, 90.0],
];

fn law(p: &[f64; 5]) -> HolzapfelGasserOgden {
    with_fibres(p, None).turned_to(FibreFrame::ALONG_AXES)
}

/// 2 dw/dE of a family [Pa] at the strain E = κ (I1 − 3) + (1 − 3 κ)(I4 − 1).
fn pull(p: &[f64; 5], first: f64, fourth: f64) -> f64 {
    let [_, k1, k2, kappa, _] = *p;
    let strain = kappa * (first - 3.0) + (1.0 - 3.0 * kappa) * (fourth - 1.0);
    if strain > 0.0 {
        2.0 * k1 * strain * (k2 * strain * strain).exp()
    } else {
        0.0
    }
}

/// Cauchy stresses [Pa] of these stretches along the axes, less the pressure.
fn by_stretches(p: &[f64; 5], stretches: [f64; 3]) -> [f64; 3] {
    let [c10, _, _, kappa, angle] = *p;
    let parts = [
        angle.to_radians().cos().powi(2),
        angle.to_radians().sin().powi(2),
        0.0,
    ];
    let squares = stretches.map(|l| l * l);
    let first = squares.iter().sum();
    let fourth = (0..3).map(|i| squares[i] * parts[i]).sum();
    let pull = pull(p, first, fourth);
    [0, 1, 2].map(|i| {
        let structure = kappa + (1.0 - 3.0 * kappa) * parts[i];
        squares[i] * (2.0 * c10 + 2.0 * pull * structure)
    })
}

/// Judge: both free sides have the same Cauchy stress by the closed form, and the nominal stress is its difference over λ.
#[test]
fn a_strip_is_pulled() {
    for p in &LAWS {
        for stretch in [0.7, 0.95, 1.0, 1.02, 1.05, 1.1] {
            let bar = stretched(&law(p), stretch).unwrap();
            let [wide, thick] = bar.lateral;
            assert!((stretch * wide * thick - 1.0).abs() < 1e-14);
            let [along, across, normal] = by_stretches(p, [stretch, wide, thick]);
            // The last digits of the stretches, in the stiffness of fibres.
            let stiffness = p[0] + p[1] * (1.0 + p[2]);
            let allowed = 1e-12 * (stiffness + along.abs());
            assert!(
                (across - normal).abs() < allowed,
                "{p:?} {stretch}: {across} {normal}"
            );
            let off = bar.nominal_stress - (along - normal) / stretch;
            assert!(off.abs() < allowed, "{p:?} {stretch}: {off}");
        }
    }
    // Fibres along the load, without dispersion: both sides are alike.
    let [c10, k1, k2, ..] = LAWS[1];
    for l in [0.6_f64, 0.9, 1.2, 1.5] {
        let bar = stretched(&law(&LAWS[1]), l).unwrap();
        let strain = (l * l - 1.0).max(0.0);
        let exact =
            2.0 * c10 * (l - l.powi(-2)) + 4.0 * k1 * l * strain * (k2 * strain.powi(2)).exp();
        assert!((bar.nominal_stress / exact - 1.0).abs() < 1e-12, "{l}");
        assert!((bar.lateral[0] - bar.lateral[1]).abs() < 1e-12);
    }
}

/// Judge: the law that keeps its volume, with an error that falls as 1/κ.
#[test]
fn a_compressible_strip_tends_to_the_incompressible_one() {
    let p = [1000.0, 5000.0, 2.0, 0.1, 30.0];
    for stretch in [0.8, 1.1, 1.3] {
        let limit = stretched(&law(&p), stretch).unwrap();
        let errors = [1e6, 1e7, 1e8].map(|bulk| {
            let law = with_fibres(&p, Some(bulk)).turned_to(FibreFrame::ALONG_AXES);
            let bar = stretched(&law, stretch).unwrap();
            // No side is under stress.
            let [wide, thick] = bar.lateral;
            let stress = law.stress(&Matrix3::from_diagonal(&[stretch, wide, thick].into()));
            let sides = stress[(1, 1)].abs().max(stress[(2, 2)].abs());
            assert!(sides < 1e-12 * bulk, "{bulk} {stretch}: {stress}");
            (bar.nominal_stress - limit.nominal_stress).abs()
        });
        // As 1/κ.
        assert!(
            errors.windows(2).all(|pair| pair[1] < 0.13 * pair[0]),
            "{errors:?}"
        );
    }
}

#[test]
fn a_sheet_is_stretched_two_ways_and_sheared() {
    for p in &LAWS {
        let law = law(p);
        for stretch in [0.9, 1.0, 1.02, 1.05_f64] {
            let stretches = [stretch, stretch, stretch.powi(-2)];
            let f = Matrix3::from_diagonal(&stretches.into());
            let cauchy = law.distortion_stress(&f) * f.transpose();
            let exact = by_stretches(p, stretches);
            for i in 0..2 {
                let (found, exact) = (cauchy[(i, i)] - cauchy[(2, 2)], exact[i] - exact[2]);
                let allowed = 1e-12 * (p[0] + p[1] + exact.abs());
                assert!(
                    (found - exact).abs() < allowed,
                    "{p:?} {stretch}: {found} {exact}"
                );
            }
        }
        let [c10, _, _, kappa, angle] = *p;
        for amount in [-0.05, 0.02, 0.05, 0.1] {
            let f = Matrix3::identity() + amount * Vec3::x() * Vec3::y().transpose();
            let found = (law.distortion_stress(&f) * f.transpose())[(0, 1)];
            let families = [1.0, -1.0].map(|side| {
                let (sin, cos) = (side * angle.to_radians()).sin_cos();
                let moved = [cos + amount * sin, sin];
                let fourth = moved[0].powi(2) + moved[1].powi(2);
                let structure = kappa * amount + (1.0 - 3.0 * kappa) * moved[0] * moved[1];
                pull(p, 3.0 + amount * amount, fourth) * structure
            });
            let exact = 2.0 * c10 * amount + families[0] + families[1];
            let allowed = 1e-12 * (p[0] + p[1] + exact.abs());
            assert!(
                (found - exact).abs() < allowed,
                "{p:?} {amount}: {found} {exact}"
            );
        }
    }
}

/// κ = 1/3 has no direction, and with k2 = 0 it is a reduced polynomial with C20 = k1/9; k1 = 0 is neo-Hookean.
#[test]
fn without_direction_or_fibres_it_is_another_law() {
    let mut random = Random(19);
    let (c10, k1) = (700.0, 900.0);
    let isotropic = with_fibres(&[c10, k1, 0.0, 1.0 / 3.0, 20.0], None);
    let polynomial = ReducedPolynomial::incompressible(&[c10, k1 / 9.0]).unwrap();
    let bare = with_fibres(&[c10, 0.0, 3.0, 0.1, 20.0], None);
    let plain = NeoHookean::incompressible(c10).unwrap();
    let stiffening = with_fibres(&[c10, k1, 4.0, 1.0 / 3.0, 20.0], None);
    for _ in 0..100 {
        let f = deformation(&mut random);
        let alike = |one: &dyn Law, other: &dyn Law| {
            let scale = 1e-13 * other.distortion_tangent(&f).norm();
            let energy = one.distortion_energy(&f) - other.distortion_energy(&f);
            assert!(energy.abs() < scale, "{energy}");
            let stress = one.distortion_stress(&f) - other.distortion_stress(&f);
            assert!(stress.norm() < scale, "{stress}");
            let tangent = one.distortion_tangent(&f) - other.distortion_tangent(&f);
            assert!(tangent.norm() < 10.0 * scale, "{tangent}");
        };
        alike(&isotropic, &polynomial);
        alike(&bare, &plain);
        // Exponential, but the same in every direction.
        let q = rotation(&mut random);
        let turned = stiffening.distortion_stress(&(f * q)) * q.transpose();
        let scale = stiffening.distortion_tangent(&f).norm();
        assert!((turned - stiffening.distortion_stress(&f)).norm() < 1e-13 * scale);
    }
}

/// A bar of distorted elements, its fibres in a frame: pulled along the reference axis, which is the second axis here.
#[test]
fn distorted_elements_stretch_a_bar_with_fibres() {
    let p = [1000.0, 5000.0, 2.0, 0.1, 30.0];
    let fibres = Arc::new(with_fibres(&p, None));
    let frame = FibreFrame::new(&Vec3::y(), &Vec3::z()).unwrap();
    for kind in [ElementKind::Hex27, ElementKind::Tet10] {
        let mut body = Body::new(block(kind, 2, 0.3), fibres.clone(), Formulation::Mixed);
        body.model = body.model.in_frames(|_| frame);
        let low = [0, 1, 2].map(|axis| face(body.model.mesh(), axis, 0.0));
        let top = face(body.model.mesh(), 1, 1.0);
        for stretch in [0.9, 1.1, 1.2, 1.3] {
            body.solve(|model| {
                let held = |supports: Supports<'static>, axis: usize| {
                    supports.fix(model, low[axis].iter().copied(), axis, 0.0)
                };
                held(held(held(Supports::none(model), 0), 1), 2).fix(
                    model,
                    top.iter().copied(),
                    1,
                    stretch - 1.0,
                )
            })
            .unwrap();
            let exact = stretched(&law(&p), stretch).unwrap();
            let found = body.force(&top, 1);
            // Newton's tolerance, over the pressure's reach.
            let off = (found / exact.nominal_stress - 1.0).abs();
            assert!(off < 1e-6, "{kind:?} {stretch}: {found} {exact:?}");
            let [wide, thick] = exact.lateral;
            let off = body.off(|x| Vec3::new(thick * x.x, stretch * x.y, wide * x.z));
            assert!(off < 1e-6, "{kind:?} {stretch}: {off}");
        }
    }
}

/// Pressure [Pa] of an endless tube in plane strain whose inner radius is `now`, from the stresses by stretches, by Gauss's
/// rule of three points on `parts` parts of the wall: p = ∫ (σ_θ − σ_r) dr/r.
fn pressure(p: &[f64; 5], inner: f64, outer: f64, now: f64, parts: u32) -> f64 {
    let spread = now * now - inner * inner;
    let width = (outer - inner) / f64::from(parts);
    let points = [(-0.6_f64.sqrt(), 5.0), (0.0, 8.0), (0.6_f64.sqrt(), 5.0)];
    let each = (0..parts).flat_map(|part| points.map(|point| (part, point)));
    each.map(|(part, (at, weight))| {
        let rest = inner + width * (f64::from(part) + 0.5 * (1.0 + at));
        let r = (rest * rest + spread).sqrt();
        let hoop = r / rest;
        // The circumference is the reference axis, the tube's axis the second.
        let [around, _, across] = by_stretches(p, [hoop, 1.0, 1.0 / hoop]);
        // dr/r = R dR/r².
        weight / 18.0 * width * (around - across) * rest / (r * r)
    })
    .sum()
}

/// Judge: the integral of equilibrium over the wall.
#[test]
fn a_thick_tube_follows_the_integral_of_equilibrium() {
    let (inner, outer) = (0.005, 0.0075);
    for (p, pressures) in [
        (&LAWS[2], &[100.0, 1000.0, 4000.0]),
        (&LAWS[3], &[50.0, 300.0, 600.0]),
        (&ARTERY, &[500.0, 5000.0, 20_000.0]),
    ] {
        let problem = TubeProblem {
            tube: Tube {
                length: 0.001,
                inner_radius: inner,
                outer_radius: outer,
            },
            law: Arc::new(law(p)),
            ends: Ends::Guided,
        };
        let found = inflate(&problem, pressures, 1e-3, &mut |_| {}).unwrap();
        for (asked, moved) in pressures.iter().zip(&found.answer.inner_displacements) {
            let now = inner + moved.unwrap();
            let [coarse, exact] = [32, 64].map(|parts| pressure(p, inner, outer, now, parts));
            println!("{p:?}: {asked} Pa, {now}, by the integral {exact}");
            assert!((coarse / exact - 1.0).abs() < 1e-6, "{coarse} {exact}");
            // 0.1 % of the displacement was asked for, times d ln p/d ln u of the integral.
            let more = pressure(p, inner, outer, inner + 1.001 * moved.unwrap(), 64);
            let allowed = 1.1 * (more / exact - 1.0);
            assert!((exact / asked - 1.0).abs() < allowed, "{asked} {exact}");
        }
    }
}

/// A solid that is turned with its fibres has the turned force, also where its patch slides askew, which is solved in a frame
/// of its own; and with its fibres as they were another one.
#[test]
#[ignore = "long"]
fn a_turned_solid_has_turned_fibres() {
    let law = Arc::new(with_fibres(&[1000.0, 20_000.0, 1.0, 0.05, 20.0], None));
    let turn = Rotation3::from_euler_angles(0.4, -0.7, 1.1);
    for friction in [Friction::Frictionless, Friction::Bonded] {
        let mut straight = cube(0.02, 0.3, friction);
        straight.patch.as_mut().unwrap().displacement = -0.004 * Vec3::z();
        straight.law = law.clone();
        let frame = FibreFrame::new(&Vec3::new(1.0, 0.0, 0.2), &Vec3::y()).unwrap();
        straight.fibres = Some(FibreField::constant(frame));
        let mut turned = turned_cube(&straight, &turn);
        let still = at(&turned, -1).force;
        turned.fibres = Some(FibreField::constant(frame.turned(&turn)));
        let (one, other) = (turn * at(&straight, -1).force, at(&turned, -1).force);
        let [off, apart] = [other, still].map(|force| (force - one).norm() / one.norm());
        println!("{friction:?}: {one}, {off} with turned fibres, {apart} without");
        // As of an isotropic cube: rounding decides which way some edges are cut.
        assert!(off < 0.005 && apart > 0.05, "{off} {apart}");
    }
}

#[test]
fn fields_have_their_directions() {
    let around = FibreField::around(Vec3::new(1.0, 0.0, 5.0), Vec3::new(0.0, 0.0, 2.0)).unwrap();
    let frame = around.at(&Vec3::new(1.0, 3.0, -2.0));
    assert!((frame.axis() - -Vec3::x()).norm() < 1e-15);
    assert!((frame.across() - Vec3::z()).norm() < 1e-15);
    // On the line any direction around it, but one of length one.
    let frame = around.at(&Vec3::new(1.0, 0.0, 0.0));
    assert!(frame.axis().z.abs() < 1e-15 && (frame.axis().norm() - 1.0).abs() < 1e-15);
    assert!(FibreField::around(Vec3::zeros(), Vec3::zeros()).is_none());
    assert!(FibreFrame::new(&Vec3::x(), &(-2.0 * Vec3::x())).is_none());
    assert!(FibreFrame::new(&Vec3::zeros(), &Vec3::x()).is_none());
    assert!(FibreFrame::new(&Vec3::new(f64::NAN, 1.0, 0.0), &Vec3::x()).is_none());
    let turn = Rotation3::new(Vec3::new(0.0, 0.0, std::f64::consts::FRAC_PI_2));
    assert!((FibreFrame::ALONG_AXES.turned(&turn).axis() - Vec3::y()).norm() < 1e-15);
    // The nearest of many places, by trying all.
    let mut random = Random(3);
    let samples: Vec<_> = (0..200)
        .map(|_| FibreSample {
            place: random.vector(),
            frame: FibreFrame::new(&random.vector(), &random.vector()).unwrap(),
        })
        .collect();
    let field = FibreField::nearest(samples.clone()).unwrap();
    for _ in 0..200 {
        let place = 1.5 * random.vector();
        let distance = |sample: &&FibreSample| (sample.place - place).norm();
        let nearest = samples
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        assert_eq!(field.at(&place), nearest.unwrap().frame);
    }
    assert!(FibreField::nearest(Vec::new()).is_none());
}

#[test]
fn bad_fibres_are_refused() {
    for p in [
        [0.0, 1.0, 1.0, 0.1, 30.0],
        [1.0, -1.0, 1.0, 0.1, 30.0],
        [1.0, 1.0, -1.0, 0.1, 30.0],
        [1.0, 1.0, 1.0, 0.34, 30.0],
        [1.0, 1.0, 1.0, -0.1, 30.0],
        [1.0, 1.0, 1.0, 0.1, 91.0],
        [1.0, f64::INFINITY, 1.0, 0.1, 30.0],
        [1.0, 1.0, f64::NAN, 0.1, 30.0],
    ] {
        let fibres = Fibres {
            k1: p[1],
            k2: p[2],
            dispersion: p[3],
            angle_deg: p[4],
        };
        let refused = HolzapfelGasserOgden::incompressible(p[0], fibres).unwrap_err();
        assert!(
            matches!(refused, Error::Fibres(FibreError::OutOfRange { .. })) && refused.is_input()
        );
    }
    let mut problem = cube(0.3, 0.3, Friction::Bonded);
    problem.law = Arc::new(law(&ARTERY));
    let refused = solve_at(&problem, -1, &mut |_| {}).unwrap_err().to_string();
    assert_eq!(
        refused,
        "the tissue has fibres, whose direction a solid without `fibres` does not know; give it an isotropic law, such as \
         neo_hookean"
    );
}
