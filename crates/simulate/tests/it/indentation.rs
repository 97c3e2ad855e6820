//! An indentation that was asked for, and the one that is felt.

use palpate_files::Scene;
use palpate_geometry::Vec3;
use palpate_simulate::{Error, Flow, Simulation, play};

/// Judge: the depth that a session records is measured to the rest surface, not along the way. Tolerance: the
/// normals of a mesh, which are averaged over the tip; 3 % of the depth.
#[test]
#[ignore = "long"]
fn an_indentation_is_as_deep_as_was_asked() {
    for (organ, tip) in [
        ("liver", "flat"),
        ("hemisphere", "sphere"),
        ("kidney", "flat"),
    ] {
        let text = format!(
            "format = 1\norgan = {{ builtin = \"{organ}\", builtin_tissue = \"pig-liver\" }}\n\
             tool = [{{ name = \"left\", tip = {{ shape = \"{tip}\", radius_m = 0.001 }} }}]\n"
        );
        let simulation = Simulation::new(&Scene::parse(&text, "scene.toml").unwrap()).unwrap();
        let tool = &simulation.tools()[0];
        let (low, high) = simulation.surface().mesh().bounds();
        let top = simulation.site(tool, None);
        assert!(
            top.point.z > 0.5 * (low.z + high.z) && top.normal.z > 0.5,
            "{organ}"
        );
        for place in [top.point, top.point + Vec3::new(0.004, -0.003, 0.01)] {
            let site = simulation.site(tool, Some(place));
            let asked = [-5e-4, 0.0, 1.5e-3, 3e-3, 3e-3];
            let times = [-0.5, 0.0, 0.25, 0.5, 1.0];
            let motion = site.indented(tool, &times, &asked).unwrap();
            let mut felt = Vec::new();
            play(&simulation, &motion, |frame| -> Result<Flow, Error> {
                felt.extend(frame.rows().map(|row| (row.time_s, row.depth_m)));
                Ok(Flow::Continue)
            })
            .unwrap();
            for (time, depth) in felt {
                let asked = 6e-3 * time.clamp(0.0, 0.5);
                assert!(
                    (depth - asked).abs() < 0.03 * 3e-3,
                    "{organ} {time}: {depth}"
                );
            }
        }
    }
}
