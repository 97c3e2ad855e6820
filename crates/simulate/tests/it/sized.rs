//! A lump that is found and sized.

use palpate_files::scene::{Goal, SizeGoal, Task};
use palpate_files::{Event, SessionRow};
use palpate_geometry::Vec3;
use palpate_simulate::performance::{Performance, Status};

use crate::performance::row;

/// A place is marked first, then its size is stated; a size without a place, or beside it, earns nothing.
#[test]
fn a_lump_is_found_and_then_sized() {
    let tools = ["right".to_owned()];
    let size = SizeGoal {
        radius_m: 0.008,
        diameter_tolerance_m: 0.002,
    };
    let find = Task {
        goal: Goal::Find {
            target_m: [0.0; 3],
            tolerance_m: 0.004,
            size: Some(size),
        },
        ..Task::default()
    };
    let marks = |x: f64| SessionRow {
        contact: true,
        events: Event::Mark.into(),
        ..row(1.0, Vec3::new(x, 0.0, 0.0))
    };
    let states = |diameter: f64| SessionRow {
        stated_diameter_m: Some(diameter),
        ..row(2.0, Vec3::zeros())
    };
    let after = |rows: &[SessionRow]| {
        let mut performance = Performance::new(&find, &tools);
        rows.iter().for_each(|row| performance.add(row));
        let score = performance.score();
        let measures = score.measures().into_iter();
        let error = measures.filter(|own| own.key == "diameter_error_m");
        let error = error.map(|own| own.value).next();
        let is_over = matches!(performance.status(), Status::Ended { .. });
        (is_over, score.outcome.passed(), error)
    };
    assert_eq!(after(&[states(0.016)]), (false, Some(false), None));
    assert_eq!(after(&[marks(0.0)]), (false, Some(false), None));
    let (is_over, passed, error) = after(&[marks(0.0), states(0.0175)]);
    assert_eq!((is_over, passed), (true, Some(true)));
    assert!((error.unwrap() - 0.0015).abs() < 1e-12);
    let (is_over, passed, error) = after(&[marks(0.0), states(0.0135)]);
    assert_eq!((is_over, passed), (true, Some(false)));
    assert!((error.unwrap() - 0.0025).abs() < 1e-12);
    // The right size of a lump that was not found is a guess.
    let missed = after(&[marks(0.02), states(0.016)]);
    assert_eq!(missed, (true, Some(false), None));
    // The first mark counts: the size is not felt by marking until one is right.
    let again = after(&[marks(0.02), marks(0.0), states(0.016)]);
    assert_eq!(again, (true, Some(false), None));
}
