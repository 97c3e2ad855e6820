//! A piece that nothing fixes.

use nalgebra::Matrix3;
use palpate_geometry::{NodeId, TetrahedronMesh};
use palpate_mechanics::Vec3;
use palpate_mechanics::nonlinear::{
    Conditions, Coupling, Moduli, NonlinearModel, NonlinearState, StepSettings, advance,
};

/// Sides of a bar [m].
const SIDES: [f64; 3] = [0.1, 0.02, 0.02];

/// Resistance per volume [N s/m⁴].
const RESISTANCE: f64 = 1e5;

/// Two bars: one that is fixed at an end, and beside it one that is not.
fn bars() -> (NonlinearModel, Vec<(u32, f64)>) {
    let bar = TetrahedronMesh::block(Vec3::zeros(), SIDES.into(), [5, 1, 1]).unwrap();
    let off = Vec3::new(0.0, 0.05, 0.0);
    let count = bar.vertices().len() as u32;
    let mut places = bar.vertices().to_vec();
    places.extend(bar.vertices().iter().map(|place| place + off));
    let mut tetrahedra = bar.tetrahedra().to_vec();
    let others = bar.tetrahedra().iter();
    tetrahedra.extend(others.map(|nodes| nodes.map(|node| NodeId(node.0 + count))));
    let mesh = TetrahedronMesh::new(places, tetrahedra).unwrap();
    let moduli = Moduli::mooney_rivlin(2000.0, 0.0, 0.45).unwrap();
    let moduli = vec![moduli; mesh.tetrahedra().len()];
    let is_end = |place: &Vec3| place.y > 0.04 && place.x > SIDES[0] - 1e-9;
    let model = NonlinearModel::new(
        &mesh,
        &moduli,
        |_, place| place.y < 0.03 && place.x < 1e-9,
        |_, place| is_end(place),
    )
    .unwrap();
    let nodes = model.nodes().iter().enumerate();
    let end: Vec<u32> = nodes
        .filter(|(_, place)| is_end(place))
        .map(|(node, _)| node as u32)
        .collect();
    let weight = 1.0 / end.len() as f64;
    (model, end.into_iter().map(|node| (node, weight)).collect())
}

/// Judge: the closed form of the drag, at two lengths of a step; a thousandth is left of the beginning, when the bar stretches. Let
/// go, it stays, unstretched; the fixed bar never moves.
#[test]
fn a_free_bar_is_dragged() {
    let (model, end) = bars();
    assert_eq!(model.free_pieces(), 1);
    let volume: f64 = SIDES.iter().product();
    for (elapsed, speed) in [(5e-3, 0.02), (2e-3, 0.05)] {
        let mut state = NonlinearState::at_rest(&model, 1);
        let mut workspace = model.workspace(1);
        let pace = StepSettings {
            iterations: 4,
            elapsed,
        };
        let steps = 400;
        for step in 1..=steps {
            let grip = Coupling {
                nodes: &end,
                along: None,
                displacement: Vec3::new(speed * elapsed * f64::from(step), 0.0, 0.0),
                advance: Vec3::new(speed * elapsed, 0.0, 0.0),
                compliance: Matrix3::zeros(),
                offset: Vec3::zeros(),
            };
            let couplings = [Some(grip)];
            let conditions = Conditions::of_tools(&couplings);
            advance(&model, conditions, pace, &mut state, &mut workspace);
        }
        let drag = RESISTANCE * volume * speed;
        let force = state.force(0).x;
        println!("{elapsed} s: {force:.5} N of {drag:.5} N");
        assert!((force / drag - 1.0).abs() < 1e-3);
        let none = [None];
        for _ in 0..400 {
            let conditions = Conditions::of_tools(&none);
            advance(&model, conditions, pace, &mut state, &mut workspace);
        }
        assert!(state.last_motion() < 1e-7);
        assert!(state.largest(&model) < 1e-9);
        let bar = model
            .nodes()
            .iter()
            .zip(state.displacements.chunks_exact(3));
        let bar: Vec<(Vec3, Vec3)> = bar
            .filter(|(place, _)| place.y > 0.04)
            .map(|(place, by)| (*place, place + Vec3::from_column_slice(by)))
            .collect();
        let mut stretch = 0.0_f64;
        for (rest, at) in &bar {
            let way = at.x - rest.x;
            assert!((way / (speed * elapsed * f64::from(steps)) - 1.0).abs() < 0.1);
            for (other_rest, other) in &bar {
                stretch = stretch.max(((at - other).norm() - (rest - other_rest).norm()).abs());
            }
        }
        println!("stretched by {stretch:e} m");
        assert!(stretch < 1e-6 * SIDES[0]);
    }
}
