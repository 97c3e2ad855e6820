//! Bounds of the models that change a force are told with numbers.

use palpate_geometry::Vec3;
use palpate_mechanics::Limit;
use palpate_simulate::interactive::Snapshot;

use crate::scenes::{Hand, Setting, motion, played};

/// The words of the only warning that has them.
fn warning<'a>(warnings: &'a [String], words: &str) -> &'a str {
    let found: Vec<_> = warnings.iter().filter(|own| own.contains(words)).collect();
    assert_eq!(found.len(), 1, "{words}: {warnings:?}");
    found[0]
}

/// A tip of 16 mm on a hemisphere of 50 mm: its shells reach beyond where the surface turns by 37 degrees.
/// A small one is not limited.
#[test]
fn a_limited_curvature_is_told_with_its_steps() {
    let setting = Setting {
        radius: 16e-3,
        ..Setting::default()
    };
    // In contact for half of the motion.
    let over = motion(&[(0.0, [0.0, 0.0, 0.052]), (0.2, [0.0, 0.0, 0.048])]);
    let simulation = setting.simulation();
    let (rows, summary) = played(&simulation, &over);
    let touching = rows.iter().filter(|row| row.contact).count();
    let told = warning(&summary.warnings, "curvature");
    let steps = format!("in {touching} of {touching} steps in contact");
    for words in ["the tip \"right\" was limited from", &steps, "hybrid"] {
        assert!(told.contains(words), "{words}: {told}");
    }

    let small = Setting::default().simulation();
    let (_, summary) = played(&small, &over);
    assert_eq!(summary.warnings, Vec::<String>::new());
}

/// A step that shows it is one that counts it: what the window says comes with its snapshot.
#[test]
fn a_snapshot_carries_the_limits() {
    let simulation = Setting {
        radius: 16e-3,
        ..Setting::default()
    }
    .simulation();
    let mut hand = Hand::new(&simulation);
    let mut snapshot = Snapshot::new(&simulation);
    assert!(snapshot.warnings(simulation.tools()).is_empty());
    for _ in 0..3 {
        hand.at(&Vec3::new(0.0, 0.0, 0.049));
    }
    snapshot.show(0.0, &hand.state);
    let told = snapshot.warnings(simulation.tools());
    assert!(told[0].contains("in 3 of 3 steps"), "{told:?}");
    assert_eq!(told, hand.state.warnings(&simulation));
}

/// A sphere that is pressed deep right over what is held, wider than its load there: the organ's model leaves
/// less than nothing to yield, and the tip law stops at twenty half-spaces.
#[test]
fn a_tip_over_the_anchor_is_told() {
    let simulation = Setting {
        organ: "builtin = \"cube\"\ntriangles = 600\n[organ.anchor]\nplanes = [\
            { point_m = [0.0, 0.0, 0.0], normal = [-1.0, 0.0, 0.0] }]",
        kind: "hybrid",
        shape: "sphere",
        radius: 22e-3,
        contact: "stick",
        ..Setting::default()
    }
    .simulation();
    let at = |depth: f64| [0.03, 0.0, 0.072 - depth];
    let down = motion(&[(0.0, at(0.0)), (0.2, at(21e-3))]);
    let (_, summary) = played(&simulation, &down);
    warning(
        &summary.warnings,
        "along the surface under the tip \"right\" was taken as 20 times",
    );
    let told = warning(
        &summary.warnings,
        "the organ under the tip \"right\" was taken as 20 times",
    );
    assert!(told.contains("of 41 steps in contact"), "{told}");

    let mut hand = Hand::new(&simulation);
    hand.at(&Vec3::from(at(21e-3)));
    let limits = &hand.state.tools[0].limits;
    assert_eq!(limits.steps_limited(Limit::TipStiffness), 1);
    assert_eq!(
        limits.worst().reached(Limit::TipStiffness).unwrap().used,
        20.0
    );
}
