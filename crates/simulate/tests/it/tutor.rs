//! An expert's session that is followed.

use palpate_files::scene::ModelKind;
use palpate_files::{Events, Session, SessionHeader, SessionRow};
use palpate_simulate::Tutor;

/// Ten seconds along x at 1 cm/s.
fn expert() -> Session {
    let rows = (0..=2000).map(|number| {
        let time = f64::from(number) / 200.0;
        SessionRow {
            time_s: 100.0 + time,
            tool: 0,
            position_m: [0.01 * time, 0.0, 0.0],
            orientation: [0.0, 0.0, 0.0, 1.0],
            grip: 0.0,
            cut: false,
            force_n: [0.0; 3],
            torque_nm: [0.0; 3],
            contact: false,
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
        has_torques: true,
        incomplete: None,
    }
}

/// A trainee who takes twice the time, with a pause, is shown the tools half a second ahead, 5 mm further. Tolerance:
/// the penalty for later moments pulls back by half of its square over the path, and moments are 20 ms apart.
#[test]
fn ghosts_lead_along_the_path_whatever_the_time() {
    let tools = ["left".to_owned(), "right".to_owned()];
    let mut tutor = Tutor::new(&expert(), &tools).unwrap();
    let mut ghost = |place: f64| {
        let ghosts = tutor.follow(&[None, Some([place, 0.0, 0.0])]);
        assert_eq!(ghosts[0], None);
        ghosts[1].unwrap().position[0]
    };
    for number in 0..=600 {
        let place = 0.05 * f64::from(number) / 600.0;
        let found = ghost(place);
        assert!((found - place - 0.005).abs() < 1e-3, "{found} {place}");
    }
    // A pause, and a way back.
    for place in [0.05, 0.05, 0.048] {
        let found = ghost(place);
        assert!((found - 0.055).abs() < 1e-3, "{found}");
    }
    for number in 0..=600 {
        ghost(0.05 + 0.05 * f64::from(number) / 600.0);
    }
    // At the end the last moment is shown.
    assert!(ghost(0.1) > 0.098);
    tutor.reset();
    assert!(tutor.follow(&[None, None])[1].unwrap().position[0] < 0.006);
}

#[test]
fn a_session_of_other_tools_teaches_nothing() {
    assert!(Tutor::new(&expert(), &["third".to_owned()]).is_none());
}
