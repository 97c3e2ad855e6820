//! Boundary elements: the integrals, and solids whose solution is known.

use faer::Mat;
use faer::linalg::solvers::Solve;
use nalgebra::Matrix3;
use palpate_geometry::{Organ, Surface};
use palpate_mechanics::boundary_elements::{
    InfluenceMatrices, Influences, Kelvin, Panel, Place, integrate,
};
use palpate_mechanics::{LinearElastic, Vec3};

fn kelvin(nu: f64) -> Kelvin {
    Kelvin::new(&LinearElastic::new(1.0, nu).unwrap())
}

fn surface(organ: Organ, triangles: usize) -> Surface {
    Surface::new(organ.surface_mesh(triangles).unwrap()).unwrap()
}

fn influences(surface: &Surface, nu: f64) -> (Vec<Panel>, InfluenceMatrices) {
    let influences = Influences::new(surface, &LinearElastic::new(1.0, nu).unwrap()).unwrap();
    (influences.panels().to_vec(), influences.matrices())
}

/// Gauss-Legendre nodes and weights on (0, 1), by Newton's method.
fn gauss(count: usize) -> Vec<(f64, f64)> {
    let n = count as f64;
    let node = |k: usize| {
        let mut x = (std::f64::consts::PI * (k as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 0.0;
        for _ in 0..50 {
            let (mut before, mut here) = (1.0, x);
            for j in 2..=count {
                let j = j as f64;
                (before, here) = (here, ((2.0 * j - 1.0) * x * here - (j - 1.0) * before) / j);
            }
            slope = n * (x * here - before) / (x * x - 1.0);
            x -= here / slope;
        }
        (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(node).collect()
}

/// Judge: quadrature of Kelvin's kernels, 60 by 60 points on the collapsed square, for places around and
/// above a crooked triangle. Tolerance: the quadrature's, at the nearest place.
#[test]
fn closed_forms_are_the_integrals_of_the_kernels() {
    let kelvin = kelvin(0.3);
    let corners = [
        Vec3::new(0.1, 0.0, 0.2),
        Vec3::new(1.3, 0.2, -0.1),
        Vec3::new(0.2, 0.7, 0.4),
    ];
    let panel = Panel::new(corners).unwrap();
    let points = gauss(60);
    let [a, b, c] = corners;
    let flat = panel.centroid + (c - a) * 1.2;
    for x in [
        panel.centroid + panel.normal * 0.2,
        panel.centroid - panel.normal * 0.15,
        Vec3::new(2.0, -1.0, 0.5),
        flat,
    ] {
        let (mut u, mut t) = (Matrix3::zeros(), Matrix3::zeros());
        for (s, ws) in &points {
            for (r, wr) in &points {
                let y = a + (b - a) * *s * (1.0 - r) + (c - a) * *r;
                let weight = 2.0 * panel.area * ws * wr * (1.0 - r);
                u += kelvin.displacement(&(y - x)) * weight;
                t += kelvin.traction(&(y - x), &panel.normal) * weight;
            }
        }
        let found = integrate(&kelvin, &panel, &x, Place::Elsewhere);
        assert!((found.displacement - u).norm() < 1e-10 * u.norm(), "{x}");
        assert!((found.traction - t).norm() < 1e-10 * t.norm(), "{x}");
    }
}

/// Judge: the integral over the panel's three parts, whose common corner is the place: there the
/// displacement kernel is integrable by the collapsed square, and the traction kernel is odd but for its
/// principal value, which the parts' rotation by a half turn gives: compared with the limit from both sides.
#[test]
fn on_the_panel_it_is_the_mean_of_both_sides() {
    let kelvin = kelvin(0.3);
    let corners = [
        Vec3::new(0.0, 0.0, 0.0),
        Vec3::new(1.0, 0.1, 0.0),
        Vec3::new(0.3, 0.6, 0.2),
    ];
    let panel = Panel::new(corners).unwrap();
    let here = integrate(&kelvin, &panel, &panel.centroid, Place::OnPanel);
    let step = 1e-7;
    let [above, below] = [step, -step].map(|away| {
        let x = panel.centroid + panel.normal * away;
        integrate(&kelvin, &panel, &x, Place::Elsewhere)
    });
    let mean = (above.traction + below.traction) * 0.5;
    // Differences fall with the step.
    assert!((here.traction - mean).norm() < 1e-5);
    assert!((here.displacement - above.displacement).norm() < 1e-5 * here.displacement.norm());
    // The jump is the unit matrix: half of it stands on the diagonal.
    let jump = below.traction - above.traction;
    assert!((jump.abs() - Matrix3::identity()).norm() < 1e-5, "{jump}");
}

/// Judge: a solid that is moved or turned as a whole has no traction. Tolerance: rounding.
#[test]
fn rigid_motions_have_no_traction() {
    let surface = surface(Organ::Kidney, 400);
    let (low, high) = surface.mesh().bounds();
    let size = (high - low).norm();
    for nu in [0.0, 0.3, 0.4999] {
        let (panels, matrices) = influences(&surface, nu);
        for axis in 0..3 {
            let unit = Vec3::ith(axis, 1.0);
            let turned = |panel: &Panel| unit.cross(&panel.centroid) / size;
            for moved in [&|_: &Panel| unit, &turned as &dyn Fn(&Panel) -> Vec3] {
                let moved: Vec<_> = panels
                    .iter()
                    .flat_map(|panel| moved(panel).data.0[0])
                    .collect();
                for row in 0..3 * panels.len() {
                    let entries = moved.iter().enumerate();
                    let sum: f64 = entries.map(|(k, u)| matrices.traction[(row, k)] * u).sum();
                    assert!(sum.abs() < 1e-12, "{nu}: {sum}");
                }
            }
        }
    }
}

/// Displacements where tractions are given and tractions where displacements are: `held` says which.
fn solve(matrices: &InfluenceMatrices, known: &[Vec3], held: impl Fn(usize) -> bool) -> Vec<Vec3> {
    let size = 3 * known.len();
    let (u, t) = (&matrices.displacement, &matrices.traction);
    let system = Mat::from_fn(
        size,
        size,
        |i, j| {
            if held(j / 3) { -u[(i, j)] } else { t[(i, j)] }
        },
    );
    let right = Mat::from_fn(size, 1, |i, _| {
        (0..size)
            .map(|j| {
                let given = known[j / 3][j % 3];
                given * if held(j / 3) { -t[(i, j)] } else { u[(i, j)] }
            })
            .sum()
    });
    let found = system.partial_piv_lu().solve(right);
    (0..known.len())
        .map(|k| {
            Vec3::new(
                found[(3 * k, 0)],
                found[(3 * k + 1, 0)],
                found[(3 * k + 2, 0)],
            )
        })
        .collect()
}

/// Slope of log error over log size by least squares.
fn order(table: &[(f64, f64)]) -> f64 {
    let n = table.len() as f64;
    let mean =
        |part: fn(&(f64, f64)) -> f64| table.iter().map(|row| part(row).ln()).sum::<f64>() / n;
    let (x, y) = (mean(|row| row.0), mean(|row| row.1));
    let spread: f64 = table.iter().map(|row| (row.0.ln() - x).powi(2)).sum();
    let both: f64 = table
        .iter()
        .map(|row| (row.0.ln() - x) * (row.1.ln() - y))
        .sum();
    both / spread
}

fn relative(found: &[Vec3], exact: &[Vec3]) -> f64 {
    let squares = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>();
    let off = squares(&mut found.iter().zip(exact).map(|(a, b)| (a - b).norm_squared()));
    (off / squares(&mut exact.iter().map(Vec3::norm_squared))).sqrt()
}

/// Judge: a uniform strain. Constant elements do not hold it; their error falls with their size or faster.
#[test]
fn a_uniform_strain_is_met_with_the_first_order() {
    let nu = 0.3;
    let strain = Matrix3::new(0.3, 0.1, -0.2, 0.1, -0.1, 0.25, -0.2, 0.25, 0.2);
    let lame = nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
    let stress = Matrix3::identity() * (lame * strain.trace()) + strain / (1.0 + nu);
    let mut table = Vec::new();
    for triangles in [48, 192, 768] {
        let (panels, matrices) = influences(&surface(Organ::Cube, triangles), nu);
        let held = |k: usize| panels[k].normal.z < -0.5;
        let moved = |panel: &Panel| strain * panel.centroid;
        let pulled = |panel: &Panel| stress * panel.normal;
        let given = |(k, panel)| if held(k) { moved(panel) } else { pulled(panel) };
        let known: Vec<_> = panels.iter().enumerate().map(given).collect();
        let found = solve(&matrices, &known, held);
        let free = || panels.iter().enumerate().filter(|(k, _)| !held(*k));
        let exact: Vec<_> = free().map(|(_, panel)| moved(panel)).collect();
        let found: Vec<_> = free().map(|(k, _)| found[k]).collect();
        table.push((1.0 / (triangles as f64).sqrt(), relative(&found, &exact)));
    }
    let order = order(&table);
    assert!(order > 0.9, "{order}: {table:?}");
}

/// Judge: Kelvin's solution for a force outside; the surface's displacement is given, its traction found.
/// On a rounded body, for at a sharp edge the normal's leap takes half an order.
#[test]
#[ignore = "long"]
fn a_force_outside_is_felt_as_kelvin_says() {
    let nu = 0.45;
    let kelvin = kelvin(nu);
    let source = Vec3::new(0.02, 0.01, 0.09);
    let push = Vec3::new(0.3, -1.0, 0.5);
    let mut table = Vec::new();
    for triangles in [400, 800, 1600] {
        let (panels, matrices) = influences(&surface(Organ::Kidney, triangles), nu);
        let known: Vec<_> = panels
            .iter()
            .map(|panel| {
                kelvin
                    .displacement(&(panel.centroid - source))
                    .tr_mul(&push)
            })
            .collect();
        let found = solve(&matrices, &known, |_| true);
        let exact: Vec<_> = panels
            .iter()
            .map(|panel| {
                let r = panel.centroid - source;
                kelvin.traction(&r, &panel.normal).tr_mul(&push)
            })
            .collect();
        table.push((1.0 / (triangles as f64).sqrt(), relative(&found, &exact)));
    }
    let order = order(&table);
    assert!(order > 0.9, "{order}: {table:?}");
}
