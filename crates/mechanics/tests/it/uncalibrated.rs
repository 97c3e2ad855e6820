//! The finite spheres without calibration, under a flat tip that slips.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector, Vector3};
use palpate_mechanics::Vec3;
use palpate_mechanics::contact::{Bond, half_space_stiffness};
use palpate_mechanics::finite_elements::hemisphere::{self, HemisphereProblem, Patch};
use palpate_mechanics::finite_spheres::{
    Calibration, FiniteSphereModel, FiniteSphereSettings, Integration, LocalContact,
};

use crate::contacts::{bare_contact, model, tissue};

/// Radius of the tip [m].
const TIP: f64 = 2e-3;

const RATIOS: [f64; 3] = [0.3, 0.45, 0.49];

fn settings(particles: usize, calibration: Calibration) -> FiniteSphereSettings {
    FiniteSphereSettings {
        particles,
        calibration,
        ..FiniteSphereSettings::default()
    }
}

fn contact(curvature: [f64; 3], thickness: f64) -> LocalContact {
    LocalContact {
        thickness: thickness * TIP,
        ..bare_contact(Vector3::from(curvature) / TIP, TIP, f64::INFINITY)
    }
}

fn stiffness(model: &FiniteSphereModel, contact: &LocalContact) -> f64 {
    model.respond(contact, &mut model.workspace()).stiffness[(2, 2)]
}

/// A flat punch without friction on a bonded slab `thickness` tip radii thick, in half-spaces: the
/// Fredholm equation of [Hayes et al. 1972]. By Nyström with 48 Gauss points; 400 in the transform.
fn slab(nu: f64, thickness: f64) -> f64 {
    let k = 3.0 - 4.0 * nu;
    // One minus the ratio of the slab's compliance to the half-space's at wave number x/thickness.
    let missing = |x: f64| {
        let e = (-2.0 * x).exp();
        let slab = (k * (1.0 - e * e) - 4.0 * x * e)
            / (k * (1.0 + e * e) + (1.0 + k * k + 4.0 * x * x) * e);
        1.0 - slab
    };
    let waves = gauss(400, 40.0);
    let kernel = |distance: f64| {
        let terms = waves
            .iter()
            .map(|(x, w)| (x * distance / thickness).cos() * missing(*x) * w);
        terms.sum::<f64>() / thickness
    };
    let points = gauss(48, 1.0);
    let system = DMatrix::from_fn(48, 48, |i, j| {
        let (t, s, weight) = (points[i].0, points[j].0, points[j].1);
        let own = if i == j { 1.0 } else { 0.0 };
        own - weight * (kernel(t - s) + kernel(t + s)) / PI
    });
    let solution = system.lu().solve(&DVector::repeat(48, 1.0)).unwrap();
    points.iter().zip(&solution).map(|((_, w), p)| w * p).sum()
}

/// Gauss and Legendre on [0, length], from the eigenvalues of Jacobi's matrix [Golub and Welsch 1969].
fn gauss(count: usize, length: f64) -> Vec<(f64, f64)> {
    let jacobi = DMatrix::from_fn(count, count, |i, j| match i.abs_diff(j) {
        1 => {
            let n = i.max(j) as f64;
            n / (4.0 * n * n - 1.0).sqrt()
        }
        _ => 0.0,
    });
    let eigen = jacobi.symmetric_eigen();
    let pairs = eigen.eigenvalues.iter().enumerate();
    pairs
        .map(|(k, x)| {
            let weight = eigen.eigenvectors[(0, k)].powi(2);
            (0.5 * length * (x + 1.0), length * weight)
        })
        .collect()
}

/// Stiffness of a hemisphere of 25 tip radii, held at its base, in half-spaces.
fn hemisphere_in_half_spaces(nu: f64) -> f64 {
    let law = tissue(nu);
    let problem = HemisphereProblem {
        radius: 25.0 * TIP,
        patch_radius: TIP,
        patch: Patch::Slip,
        law,
        depth: 1.0,
    };
    let found = hemisphere::solve(&problem, 3e-3, |_| {}).unwrap();
    found.answer.force / half_space_stiffness(&law, TIP, Bond::Slip)
}

struct Shape {
    name: &'static str,
    contact: LocalContact,
    in_half_spaces: fn(f64) -> f64,
}

/// Bodies whose stiffness another method gives.
fn judged_shapes() -> [Shape; 4] {
    [
        Shape {
            name: "half-space",
            contact: contact([0.0; 3], f64::INFINITY),
            in_half_spaces: |_| 1.0,
        },
        Shape {
            name: "slab of 3 radii",
            contact: contact([0.0; 3], 3.0),
            in_half_spaces: |nu| slab(nu, 3.0),
        },
        Shape {
            name: "slab of 6 radii",
            contact: contact([0.0; 3], 6.0),
            in_half_spaces: |nu| slab(nu, 6.0),
        },
        Shape {
            name: "hemisphere of 25 radii",
            contact: contact([0.04, 0.0, 0.04], 25.0),
            in_half_spaces: hemisphere_in_half_spaces,
        },
    ]
}

/// Prints and answers the errors [-], one row for each shape and ν, one column for each number.
fn errors(particles: &[usize], calibration: Calibration) -> Vec<(String, Vec<f64>)> {
    let shapes = judged_shapes();
    let mut rows: Vec<_> = Vec::new();
    for nu in RATIOS {
        let models: Vec<_> = particles
            .iter()
            .map(|&count| model(settings(count, calibration), nu, Bond::Slip))
            .collect();
        let half_space = half_space_stiffness(&tissue(nu), TIP, Bond::Slip);
        for shape in &shapes {
            let exact = half_space * (shape.in_half_spaces)(nu);
            let off = |model| stiffness(model, &shape.contact) / exact - 1.0;
            let row: Vec<_> = models.iter().map(off).collect();
            let percent: Vec<_> = row.iter().map(|e| format!("{:+.2}", 100.0 * e)).collect();
            println!("| {} | {nu} | {} |", shape.name, percent.join(" | "));
            rows.push((format!("{}, nu {nu}", shape.name), row));
        }
    }
    rows
}

/// Judges: the half-space's closed form, the slab's integral equation, finite elements of the hemisphere.
/// The bound is what 34 particles are asked for.
#[test]
fn thirty_four_uncalibrated_particles_are_within_ten_percent() {
    for (name, row) in errors(&[34], Calibration::None) {
        assert!(row[0].abs() < 0.10, "{name}: {row:?}");
    }
}

/// As above, with the bounds of more particles; prints the table of docs/theory/finite_spheres.md.
#[test]
#[ignore = "slow: 300 particles, minutes"]
fn uncalibrated_force_improves_with_particles() {
    let bounds = [0.10, 0.05, 0.02];
    for (name, row) in errors(&[34, 93, 300], Calibration::None) {
        for (error, bound) in row.iter().zip(bounds) {
            assert!(error.abs() < bound, "{name}: {row:?}");
        }
    }
    println!("particles alone:");
    for (name, row) in errors(&[20, 34, 93, 300], Calibration::ParticlesAlone) {
        assert!(row[3] < row[1] && row[1] < row[0], "{name}: {row:?}");
    }
}

/// A cylinder and a saddle have no other method's answer here: the judge is the same model with 300
/// particles, so this shows convergence, not truth. On the saddle 34 particles fail, nine times too stiff.
#[test]
#[ignore = "by hand: 300 particles, minutes; fails on the saddle with 34 particles, of which scenes warn"]
fn cylinder_and_saddle_converge_with_particles() {
    for nu in RATIOS {
        let models = [34, 93, 300].map(|n| model(settings(n, Calibration::None), nu, Bond::Slip));
        for (name, curvature) in [
            ("cylinder", [0.1, 0.0, 0.0]),
            ("saddle", [0.05, 0.0, -0.05]),
        ] {
            let found = models
                .each_ref()
                .map(|m| stiffness(m, &contact(curvature, 10.0)));
            let off = [0, 1].map(|k| found[k] / found[2] - 1.0);
            println!(
                "| {name} | {nu} | {:+.2} | {:+.2} |",
                100.0 * off[0],
                100.0 * off[1]
            );
            assert!(
                off[0].abs() < 0.10 && off[1].abs() < 0.05,
                "{name} {nu}: {off:?}"
            );
        }
    }
}

/// Judge: the profile of a rigid punch, (2/π) asin(a/r). 5 % of the depth beyond the tip's edge.
#[test]
fn uncalibrated_profile_is_the_punch_on_a_half_space() {
    for nu in [0.3, 0.49] {
        let model = model(settings(34, Calibration::None), nu, Bond::Slip);
        let contact = contact([0.0; 3], f64::INFINITY);
        let mut workspace = model.workspace();
        let response = model.respond(&contact, &mut workspace);
        let tip = Vec3::new(0.0, 0.0, -1.0);
        for k in 0..60 {
            let r = 1.0 + 0.3 * f64::from(k);
            let x = Vec3::new(0.6 * r, 0.8 * r, 0.0) * TIP;
            let moved = model.displacement((&contact, &response), &mut workspace, &tip, &x);
            let exact = -(1.0 / r).asin() * 2.0 / PI;
            assert!(
                (moved.z - exact).abs() < 0.05,
                "{nu}, {r}: {} {exact}",
                moved.z
            );
        }
    }
}

/// The curvature's frame is no matter: a cylinder turned by a quarter of a turn has the same force, up to
/// the particles, whose rings are not round.
#[test]
fn uncalibrated_stiffness_does_not_know_the_frame() {
    let model = model(settings(34, Calibration::None), 0.3, Bond::Slip);
    let one = stiffness(&model, &contact([0.1, 0.0, 0.0], 10.0));
    let other = stiffness(&model, &contact([0.0, 0.0, 0.1], 10.0));
    println!("turned cylinder {:+.4}", other / one - 1.0);
    assert!((other / one - 1.0).abs() < 0.01);
}

/// Finer integration moves the force by less than a tenth of what 34 particles may be off.
#[test]
fn uncalibrated_integration_is_fine_enough() {
    for nu in [0.3, 0.49] {
        let fine = FiniteSphereSettings {
            integration: Integration::Fine,
            ..settings(34, Calibration::None)
        };
        let contact = contact([0.0; 3], 6.0);
        let standard = model(settings(34, Calibration::None), nu, Bond::Slip);
        let off =
            stiffness(&standard, &contact) / stiffness(&model(fine, nu, Bond::Slip), &contact);
        println!("nu {nu}: standard over fine {off:.5}");
        assert!((off - 1.0).abs() < 0.01, "{nu}: {off}");
    }
}
