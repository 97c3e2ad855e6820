//! An expert's session that is followed.

use palpate_files::scene::ModelKind;
use palpate_files::{Events, Session, SessionHeader, SessionRow};
use palpate_simulate::{Stray, Tutor};

/// Ten seconds along x at 1 cm/s, pressing with 0.5 N from the third second to the seventh.
fn expert() -> Session {
    let rows = (0..=2000).map(|number| {
        let time = f64::from(number) / 200.0;
        let pressed = (3.0..=7.0).contains(&time);
        SessionRow {
            time_s: 100.0 + time,
            tool: 0,
            position_m: [0.01 * time, 0.0, 0.0],
            orientation: [0.0, 0.0, 0.0, 1.0],
            grip: 0.0,
            cut: false,
            force_n: [0.0, 0.0, if pressed { 0.5 } else { 0.0 }],
            contact: pressed,
            depth_m: 0.0,
            events: Events::NONE,
            grip_force_n: 0.0,
            stated_diameter_m: None,
        }
    });
    Session {
        header: SessionHeader {
            version: "0".to_owned(),
            scene_digest: "0".to_owned(),
            model: ModelKind::Local,
            step_s: 0.005,
            seed: 0,
            force_scale: 1.0,
        },
        tools: vec!["right".to_owned()],
        rows: rows.collect(),
        incomplete: None,
    }
}

/// A trainee who takes twice the time, with a pause, is told where they are. Tolerance: what is dearer the later it
/// is pulls back by half of its square over the way, and moments are 20 ms apart.
#[test]
fn progress_is_the_way_not_the_time() {
    let tools = ["left".to_owned(), "right".to_owned()];
    let mut tutor = Tutor::new(&expert(), &tools).unwrap();
    let mut follow =
        |place: f64, force: f64| tutor.follow(&[None, Some(([place, 0.0, 0.0], force))]);
    for number in 0..=600 {
        let place = 0.05 * f64::from(number) / 600.0;
        let told = follow(place, 0.0);
        assert!(
            (told.progress - place / 0.1).abs() < 0.01,
            "{} {place}",
            told.progress
        );
    }
    // A pause, and a way back.
    for place in [0.05, 0.05, 0.048] {
        let told = follow(place, 0.0);
        assert!((told.progress - 0.5).abs() < 0.01, "{}", told.progress);
        assert_eq!(told.ghosts[0], None);
        let ghost = told.ghosts[1].unwrap();
        assert!((ghost.position[0] - 0.055).abs() < 1e-3, "{ghost:?}");
    }
    let [low, high] = follow(0.05, 0.5).bands[1].unwrap();
    assert!(
        low < 0.36 && low > 0.29 && high > 0.6 && high < 0.75,
        "{low} {high}"
    );
    let stray = |told: palpate_simulate::Guidance| told.strays[1];
    assert_eq!(stray(follow(0.05, 0.5)), None);
    assert_eq!(stray(follow(0.05, 0.9)), Some(Stray::Above));
    assert_eq!(stray(follow(0.05, 0.0)), Some(Stray::Below));
    for number in 0..=600 {
        follow(0.05 + 0.05 * f64::from(number) / 600.0, 0.0);
    }
    assert!(follow(0.1, 0.0).progress > 0.98);
    // Lifted in the air, nothing is said of forces.
    assert_eq!(tutor.follow(&[None, None]).strays, [None, None]);
    tutor.begin_anew();
    assert!(tutor.follow(&[None, None]).progress < 0.01);
}

#[test]
fn a_session_of_other_tools_teaches_nothing() {
    assert!(Tutor::new(&expert(), &["third".to_owned()]).is_none());
}
