//! Hexahedra under a round punch.

use std::sync::Arc;

use palpate_mechanics::finite_elements::{
    Cavity, FiniteElementModel, FiniteElementState, FiniteElementWorkspace, Formulation,
    PunchedLines, Supports, equilibrate,
};
use palpate_mechanics::{Law, LinearElastic, NeoHookean, Vec3};

/// Places around a circle of radius one in a block of `size`.
fn lines(size: f64) -> PunchedLines {
    let mut beyond = vec![2.4];
    let mut next = 4.0;
    while beyond[beyond.len() - 1] + next < size {
        beyond.push(beyond[beyond.len() - 1] + next);
        next *= 2.5;
    }
    beyond.push(size);
    let mut depths = vec![0.0, 0.2, 0.5, 1.1, 2.3, 5.0, 13.0];
    depths.retain(|d| *d < 0.7 * size);
    depths.push(size);
    PunchedLines {
        around: 2,
        inside: vec![0.5, 0.8, 1.0],
        outside: vec![1.0, 1.2, 1.6, 2.4],
        beyond: [beyond.clone(), beyond],
        heights: depths.iter().rev().map(|d| -d).collect(),
    }
}

/// A homogeneous strain is found exactly, whatever the shape of the elements.
#[test]
fn patch_test() {
    let mut lines = lines(4.0);
    lines.heights = vec![-4.0, -2.0, 0.0];
    let laws: [Arc<dyn Law>; 2] = [
        Arc::new(LinearElastic::new(1e3, 0.3).unwrap()),
        Arc::new(NeoHookean::incompressible(1e3).unwrap()),
    ];
    for (law, stretch) in laws.into_iter().zip([1.001, 1.3]) {
        let body = lines.body(Vec3::new).unwrap();
        let model = FiniteElementModel::new(body.mesh, law.clone(), Formulation::Mixed).unwrap();
        let at = |keep: &dyn Fn(&Vec3) -> bool| model.mesh().nodes_where(keep);
        let pull = 4.0 * (stretch - 1.0);
        let supports = Supports::none(&model)
            .fix(&model, at(&|x| x.x == 0.0), 0, 0.0)
            .fix(&model, at(&|x| x.y == 0.0), 1, 0.0)
            .fix(&model, at(&|x| x.z == -4.0), 2, 0.0)
            .fix(&model, at(&|x| x.z == 0.0), 2, pull);
        let mut state = FiniteElementState::at_rest(&model);
        let mut workspace = FiniteElementWorkspace::new(&model).unwrap();
        equilibrate(&model, &supports, &mut state, &mut workspace).unwrap();
        let aside = if law.volume().bulk_modulus.is_infinite() {
            stretch.powf(-0.5) - 1.0
        } else {
            -0.3 * (stretch - 1.0)
        };
        for (node, place) in model.mesh().nodes.iter().enumerate() {
            let u = state.displacement(&model, node);
            let exact = Vec3::new(
                aside * place.x,
                aside * place.y,
                (stretch - 1.0) * (place.z + 4.0),
            );
            // Newton's tolerance.
            assert!((u - exact).norm() < 1e-6 * pull, "{place} {u} {exact}");
        }
        // Area of the quarter circle's nodes: all inside, none outside.
        assert!(
            body.face
                .iter()
                .all(|&n| model.mesh().nodes[n].xy().norm() < 1.0 + 1e-9)
        );
    }
}

/// Force [N] of a flat punch of radius one at a depth of one, on a block of ten radii and more.
fn punched(nu: f64, bonded: bool, size: f64) -> f64 {
    let body = lines(size).body(Vec3::new).unwrap();
    let law = Arc::new(LinearElastic::new(1.0, nu).unwrap());
    let model = FiniteElementModel::new(body.mesh, law, Formulation::Mixed).unwrap();
    let at = |keep: &dyn Fn(&Vec3) -> bool| model.mesh().nodes_where(keep);
    let face = || body.face.iter().copied();
    let bottom = at(&|x| x.z == -size);
    let mut supports = Supports::none(&model);
    if bonded {
        supports = supports
            .fix(&model, face(), 0, 0.0)
            .fix(&model, face(), 1, 0.0);
    }
    let supports = supports
        .fix(&model, at(&|x| x.x == 0.0), 0, 0.0)
        .fix(&model, at(&|x| x.y == 0.0), 1, 0.0)
        .fix(&model, bottom.iter().copied(), 2, 0.0)
        .fix(&model, face(), 2, -1.0);
    let mut state = FiniteElementState::at_rest(&model);
    let start = std::time::Instant::now();
    let mut workspace = FiniteElementWorkspace::new(&model).unwrap();
    equilibrate(&model, &supports, &mut state, &mut workspace).unwrap();
    println!(
        "{} unknowns, {} numbers in the factors, {:?}",
        model.size(),
        workspace.factor_entries(),
        start.elapsed()
    );
    face().map(|n| -4.0 * workspace.reaction(&model, n).z).sum()
}

/// The half-space: 2 a E/(1 − ν²) without friction, 4 G a ln(3 − 4 ν)/(1 − 2 ν) bonded.
#[test]
fn a_punched_block_is_as_stiff_as_a_half_space() {
    for (nu, bonded) in [
        (0.3_f64, false),
        (0.3, true),
        (0.4999, false),
        (0.4999, true),
    ] {
        let exact: f64 = if bonded {
            2.0 / (1.0 + nu) * (3.0 - 4.0 * nu).ln() / (1.0 - 2.0 * nu)
        } else {
            2.0 / (1.0 - nu * nu)
        };
        let force = punched(nu, bonded, 40.0);
        println!(
            "nu = {nu}, bonded {bonded}: {force}, {exact}, {:.4}",
            force / exact
        );
        // The size adds a/size, the elements of 0.2 a at the edge about 2 %.
        assert!((force / exact - 1.0).abs() < 0.03);
    }
}

/// A quarter of a ring under pressure between two rigid plates: Lamé's cylinder.
#[test]
fn pressed_ring_is_lames() {
    let (inner, outer, height, nu) = (1.0, 1.5, 0.5, 0.3);
    let lines = PunchedLines {
        around: 1,
        inside: vec![0.05, 0.1],
        outside: vec![0.1, 0.2],
        beyond: [vec![0.2, 0.6, 1.0], vec![0.2, height]],
        heights: vec![1.0, 1.2, outer],
    };
    let bent = |x: f64, z: f64, r: f64| {
        let angle = x * std::f64::consts::FRAC_PI_2;
        Vec3::new(r * angle.cos(), r * angle.sin(), z)
    };
    let body = lines.body(bent).unwrap();
    let law = Arc::new(LinearElastic::new(1.0, nu).unwrap());
    let cavity = Cavity {
        sides: body.lower_sides,
    };
    let model = FiniteElementModel::new(body.mesh, law, Formulation::Mixed).unwrap();
    let at = |axis: usize, place: f64| {
        model
            .mesh()
            .nodes_where(|x| (x[axis] - place).abs() < 1e-12)
    };
    let lame = |r: f64| {
        (1.0 + nu) * 0.01 * inner * inner / (outer * outer - inner * inner)
            * ((1.0 - 2.0 * nu) * r + outer * outer / r)
    };
    let mut supports = Supports::none(&model)
        .fix(&model, at(0, 0.0), 0, 0.0)
        .fix(&model, at(1, 0.0), 1, 0.0)
        .fix(&model, at(2, 0.0), 2, 0.0)
        .fix(&model, at(2, height), 2, 0.0)
        .press(&cavity, 0.01);
    // The end that does not lie in a plane through the origin is to be held.
    for node in at(2, height) {
        let place = model.mesh().nodes[node].xy();
        let u = place.normalize() * lame(place.norm());
        supports = supports
            .fix(&model, [node], 0, u.x)
            .fix(&model, [node], 1, u.y);
    }
    let mut state = FiniteElementState::at_rest(&model);
    let mut workspace = FiniteElementWorkspace::new(&model).unwrap();
    equilibrate(&model, &supports, &mut state, &mut workspace).unwrap();
    let exact = lame(inner);
    for node in model
        .mesh()
        .nodes_where(|x| (x.xy().norm() - inner).abs() < 1e-12)
    {
        let outward = model.mesh().nodes[node].xy().normalize();
        let u = state.displacement(&model, node).xy().dot(&outward);
        // Elements of half the wall and a third of a right angle, of the fourth order.
        assert!((u / exact - 1.0).abs() < 5e-3, "{u} {exact}");
    }
}
