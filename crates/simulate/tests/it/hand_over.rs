//! What is handed over after a step is the force and its slope.

use palpate_files::scene::TissueChoice;
use palpate_files::{BuiltinTissue, Pose};
use palpate_geometry::Vec3;
use palpate_simulate::interactive::affine_force;
use palpate_simulate::{Simulation, step};

use crate::scenes::{Hand, Setting};

/// The force [N] when the tip of `hand` is at `tip` [m] a moment later.
fn at_once(simulation: &Simulation, hand: &Hand<'_>, tip: &Vec3) -> Vec3 {
    let mut state = hand.state.clone();
    let mut workspace = palpate_simulate::SimulationWorkspace::new(simulation);
    let pose = Pose {
        position_m: (*tip).into(),
        orientation: None,
        grip: 0.0,
        cut: false,
    };
    step(
        simulation,
        (9.0, 0.0),
        &[Some(pose)],
        &mut state,
        &mut workspace,
    );
    state.tools[0].force
}

/// Judge: central differences of the step itself, 10 µm, in a jump, which tissue cannot relax from.
#[test]
fn the_slope_is_that_of_the_force() {
    let prony = "[{ g = 0.2866, tau_s = 1.537 }, { g = 0.2022, tau_s = 6.090 }]";
    let cases = [
        ("flat", "slip", None),
        ("flat", "stick", None),
        ("sphere", "slip", None),
        ("sphere", "stick", None),
        ("flat", "slip", Some(BuiltinTissue::PigLiver)),
        ("sphere", "slip", Some(BuiltinTissue::PigLiver)),
    ];
    for (shape, contact, tissue) in cases {
        let setting = Setting {
            shape,
            contact,
            prony,
            radius: 2e-3,
            ..Setting::default()
        };
        let mut scene = setting.scene();
        if let Some(tissue) = tissue {
            scene.organ.tissue = TissueChoice::Builtin(tissue);
        }
        let simulation = Simulation::new(&scene).unwrap();
        let overhang = if shape == "sphere" { 2e-3 } else { 0.0 };
        let tip = Vec3::new(1e-3, 5e-4, 0.05 + overhang - 1e-3);
        let mut hand = Hand::new(&simulation);
        for _ in 0..200 {
            hand.at(&tip);
        }
        let tool = &hand.state.tools[0];
        let given = affine_force(&simulation.tools()[0], tool, 0.0);
        assert!(given.contact && (given.force - tool.force).norm() < 1e-15);
        let largest = given.gradient.amax();
        for axis in 0..3 {
            let way = Vec3::ith(axis, 1e-5);
            let by = at_once(&simulation, &hand, &(tip + way))
                - at_once(&simulation, &hand, &(tip - way));
            let slope = by / 2e-5;
            let error = (given.gradient.column(axis) - slope).norm() / largest;
            println!("{shape} {contact} {tissue:?} {axis}: {error:.4}");
            // A slipping tip's normal turns along the organ: f/R, 1.5 %, and as much by its triangles.
            assert!(error < 0.05, "{shape} {contact} {axis}: {error}");
        }
    }
}

/// After a quick way out tissue has not come back: its force would pull, and the loop is told so, for a
/// hand that turns around shall not meet a force too soon.
#[test]
fn a_pull_is_handed_over_but_not_felt() {
    let simulation = Setting {
        prony: "[{ g = 0.6, tau_s = 0.5 }]",
        ..Setting::default()
    }
    .simulation();
    let below = |depth: f64| Vec3::new(0.0, 0.0, 0.05 - depth);
    let mut hand = Hand::new(&simulation);
    for _ in 0..400 {
        hand.at(&below(3e-3));
    }
    let force = hand.at(&below(2e-4));
    assert_eq!(force, Vec3::zeros());
    let given = affine_force(&simulation.tools()[0], &hand.state.tools[0], 0.0);
    assert!(given.contact && given.force.z < 0.0, "{given:?}");
    let still = Vec3::zeros();
    assert_eq!(given.at(&below(2e-4), &still), still);
    assert_eq!(given.at(&below(4e-4), &still), still);
    assert!(given.at(&below(3e-3), &still).z > 0.0);
}
