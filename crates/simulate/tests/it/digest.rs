//! The names of scenes in recorded sessions. Judge: sessions that were recorded.

use palpate_files::{Scene, Session};
use palpate_simulate::{Replay, Simulation};

const ESOPHAGUS: &str = include_str!("../../../../assets/esophagus/scene.toml");

/// A session of the esophagus as a version with a digest wrote it.
fn session(digest: &str) -> Session {
    let text = format!(
        "# format = 1\n# version = \"0.1.0\"\n# scene_digest = \"{digest}\"\n# model = \"local\"\n\
         # step_s = 0.005\n# seed = 0\n# force_scale = 1.0\n\
         time_s,tool,x_m,y_m,z_m,qx,qy,qz,qw,grip,cut,fx_n,fy_n,fz_n,contact,depth_m,event,grip_force_n\n\
         0.0,right,0.0,-0.012,0.006,0.0,0.0,0.0,1.0,0.0,0,0.0,0.0,0.0,0,0.0,,0.0\n"
    );
    Session::parse(&text, "session.csv").unwrap()
}

/// Digests that sessions on disks have must not change: of version 0.1.0, from the names of fields, and of the
/// canonical form. Another scene is refused.
#[test]
fn digests_of_recorded_sessions_are_known() {
    let scene = Scene::parse(ESOPHAGUS, "scene.toml").unwrap();
    let simulation = std::sync::Arc::new(Simulation::new(&scene).unwrap());
    assert_eq!(simulation.session_header().scene_digest, CANONICAL);
    for digest in [FORMER, CANONICAL] {
        assert!(
            Replay::new(simulation.clone(), &session(digest)).is_ok(),
            "{digest}"
        );
    }
    let other = Replay::new(simulation, &session("2-03af0b310a409016"));
    assert!(
        other
            .err()
            .unwrap()
            .to_string()
            .contains("recorded with the scene")
    );
}

const FORMER: &str = "03af0b310a409016";
const CANONICAL: &str = "2-e1c8cf9a5cc97eb8";
