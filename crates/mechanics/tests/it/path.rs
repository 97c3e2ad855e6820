//! Paths of equilibria, beyond their limit points.

use std::sync::Arc;

use nalgebra::Matrix3;
use palpate_mechanics::finite_elements::{
    Cavity, ElementMesh, FiniteElementModel, Formulation, Path, Supports,
};
use palpate_mechanics::{Exponential, Law};

/// Pressure [Pa] of an incompressible tube in plane strain whose inner radius is `now` [m]:
/// p = ∫ (σ_θ − σ_r) dr/r with r² − R² the same for all R, by Simpson's rule.
pub(crate) fn closed_form(law: &dyn Law, inner: f64, outer: f64, now: f64) -> f64 {
    let spread = now * now - inner * inner;
    let integrand = |rest: f64| {
        let r = (rest * rest + spread).sqrt();
        let stretch = r / rest;
        let f = Matrix3::from_diagonal(&[1.0 / stretch, stretch, 1.0].into());
        let stress = law.distortion_stress(&f) * f.transpose();
        // dr/r = R dR/r².
        (stress[(1, 1)] - stress[(0, 0)]) * rest / (r * r)
    };
    let (count, width) = (200, outer - inner);
    let h = width / f64::from(count);
    (0..=count)
        .map(|i| {
            let weight = match i {
                0 => 1.0,
                i if i == count => 1.0,
                i if i % 2 == 1 => 4.0,
                _ => 2.0,
            };
            weight * h / 3.0 * integrand(inner + f64::from(i) * h)
        })
        .sum()
}

/// A tube of a softening law in plane strain: the closed form up to its maximum and beyond, the load of
/// the maximum, and the number of ways to leave an equilibrium on either side of it.
#[test]
fn a_softening_tube_is_followed_beyond_its_limit() {
    let (inner, outer, height) = (0.005, 0.0075, 0.0005);
    let law = Exponential::incompressible(1000.0, -0.25).unwrap();
    let columns: Vec<f64> = (0..=8)
        .map(|i| inner + (outer - inner) * f64::from(i) / 8.0)
        .collect();
    let mesh = ElementMesh::grid(&columns, &[0.0, height], |r, z| [r, z]);
    let model = FiniteElementModel::new(mesh, Arc::new(law), Formulation::Mixed).unwrap();
    let wall = model.mesh().nodes_where(|x| x.x == inner);
    let cavity = Cavity {
        sides: vec![wall.iter().map(|&n| n as u32).collect()],
    };
    let all = 0..model.mesh().nodes.len();
    let supports = Supports::none(&model)
        .fix(&model, all, 1, 0.0)
        .press(&cavity, 100.0);
    let mut path = Path::new(&model, supports, 0.1).unwrap();
    let at = |state: &palpate_mechanics::finite_elements::FiniteElementState| {
        inner + state.displacement(&model, wall[0]).x
    };
    let pressure = |radius: f64| closed_form(&law, inner, outer, radius);
    let highest = (500..2000)
        .map(|i| pressure(f64::from(i) * 1e-5))
        .fold(0.0, f64::max);
    let mut found = None;
    let mut beyond = 0;
    while at(&path.now().state) < 0.018 {
        let point = path.advance().unwrap();
        let (radius, p) = (at(&point.state), 100.0 * point.factor);
        let exact = pressure(radius);
        println!(
            "{radius:.5} {p:.4} {exact:.4} {} {:.1}",
            point.unstable, point.slope
        );
        // Eight quadratic elements: far below a thousandth.
        assert!((p - exact).abs() < 1e-3 * exact, "{p} against {exact}");
        assert_eq!(point.unstable, usize::from(point.slope < 0.0));
        beyond += point.unstable;
        if let Some(limit) = path.limit().unwrap() {
            assert!(found.replace(100.0 * limit.factor).is_none());
        }
    }
    let found = found.unwrap();
    println!("limit {found}, closed form {highest}");
    // The tolerance of the limit is 1e-5, of the mesh less than 1e-4.
    assert!((found / highest - 1.0).abs() < 1e-4);
    assert!(beyond > 3);
}
