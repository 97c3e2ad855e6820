//! What an organ that is cut answers, as a whole.

use palpate_files::{Pose, Scene};
use palpate_geometry::Vec3;
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};

/// The esophagus, or a cube, that a hook cuts and a probe touches.
fn simulation(organ: &str, cutting: &str) -> Simulation {
    let tool = |name: &str, kind: &str| {
        format!(
            "[[tool]]\nname = \"{name}\"\nkind = \"{kind}\"\n\
             tip = {{ shape = \"flat\", radius_m = 0.001, contact = \"stick\" }}\n"
        )
    };
    let text = format!(
        "format = 1\n[organ]\n{organ}\n[organ.tissue]\nlaw = \"linear\"\nyoungs_modulus_pa = 10000.0\n\
         poissons_ratio = 0.45\n[cutting]\ntoughness_j_per_m2 = 1.0\n{cutting}\n[model]\nkind = \"hybrid\"\n\
         mechanical_triangles = 1200\nresponse = \"boundary_elements\"\n{}{}",
        tool("right", "hook"),
        tool("left", "probe")
    );
    Simulation::new(&Scene::parse(&text, "cut.toml").unwrap()).unwrap()
}

const CUBE: &str = "builtin = \"cube\"\ntriangles = 3072\n\
    [organ.touchable]\nspheres = [{ center_m = [0.0, 0.0, 0.05], radius_m = 0.03 }]";

struct Hands<'a> {
    simulation: &'a Simulation,
    state: SimulationState,
    workspace: SimulationWorkspace,
    steps: u32,
}

impl<'a> Hands<'a> {
    fn new(simulation: &'a Simulation) -> Self {
        Self {
            state: SimulationState::new(simulation),
            workspace: SimulationWorkspace::new(simulation),
            simulation,
            steps: 0,
        }
    }

    /// A step with the hook at `hook` [m], cutting, and the probe at `probe` [m], or one of them alone.
    fn at(&mut self, hook: Option<Vec3>, probe: Option<Vec3>) -> Vec3 {
        let pose = |place: Vec3, cut| Pose {
            position_m: place.into(),
            orientation: None,
            grip: 0.0,
            cut,
        };
        let poses = [
            hook.map(|place| pose(place, true)),
            probe.map(|place| pose(place, false)),
        ];
        let elapsed = self.simulation.step();
        let time = elapsed * f64::from(self.steps);
        self.steps += 1;
        step(
            self.simulation,
            time,
            elapsed,
            &poses,
            &mut self.state,
            &mut self.workspace,
        );
        self.state.tools[1].force
    }

    /// From `from` to `to` [m], and up.
    fn cut(&mut self, from: Vec3, to: Vec3) {
        for k in 0..=200 {
            self.at(Some(from + (to - from) * (f64::from(k) / 200.0)), None);
        }
        self.at(None, None);
    }

    /// The force of a probe that goes straight in to `place` [m].
    fn feel(&mut self, place: Vec3) -> Vec3 {
        let force = self.at(None, Some(place));
        self.at(None, None);
        force
    }
}

/// On the upper side of the cube, 1 mm deep.
fn top(x: f64, y: f64) -> Vec3 {
    Vec3::new(x, y, 0.049)
}

/// A cut softens its rim and nothing far away; undone, it leaves no trace. Judge: the uncut organ; how much it
/// softens is judged in `mechanics`, against finite elements with a slit.
#[test]
fn a_rim_is_softer_and_the_rest_is_not() {
    let simulation = simulation(CUBE, "depth_m = 0.004");
    let mut hands = Hands::new(&simulation);
    let places = [0.0016, 0.0022, 0.0034, 0.026].map(|y| top(0.0, y));
    let uncut = places.map(|place| hands.feel(place));
    hands.cut(top(-0.012, 0.0004), top(0.012, 0.0004));
    // Of 24 mm, what the ends lack: an edge of 8.8 mm at most.
    assert!(hands.state.cuts.as_ref().unwrap().length() > 0.015);
    let cut = places.map(|place| hands.feel(place));
    let parts = [0, 1, 2, 3].map(|k| cut[k].z / uncut[k].z);
    println!("force over that of the uncut organ: {parts:.3?}");
    // A quarter-space is softer than a half-space by some tenths; 26 mm are six depths away.
    assert!(parts[0] < 0.95 && parts[0] > 0.3, "{parts:?}");
    assert!(parts.is_sorted(), "{parts:?}");
    assert!((parts[3] - 1.0).abs() < 0.02, "{parts:?}");
    // Pressed beside a slit, tissue goes towards it.
    assert!(hands.state.undo_cut());
    let again = places.map(|place| hands.feel(place));
    assert_eq!(again, uncut);
}

/// A circle that is cut all around, and a little further, softens both of its sides and its middle less; undone, it leaves
/// no trace. Judge: the uncut organ, and the other side of the circle; how much it softens is judged in `mechanics`,
/// against finite elements with a slit that closes. Tolerance: a quarter, for triangles are ten times as large as the
/// distance from the rim, and unlike on both sides.
#[test]
fn a_circle_softens_both_of_its_sides() {
    const RADIUS: f64 = 0.012;
    let simulation = simulation(CUBE, "depth_m = 0.003");
    let mut hands = Hands::new(&simulation);
    let at = |radius: f64, angle: f64| top(radius * angle.cos(), radius * angle.sin());
    let rim =
        [0.5, 2.1, 3.7, 5.3].map(|angle| [RADIUS - 0.002, RADIUS + 0.002].map(|r| at(r, angle)));
    let places: Vec<Vec3> = rim.into_iter().flatten().chain([top(0.0, 0.0)]).collect();
    let feel = |hands: &mut Hands<'_>| -> Vec<Vec3> {
        places.iter().map(|place| hands.feel(*place)).collect()
    };
    let uncut = feel(&mut hands);
    for k in 0..=420 {
        let force = hands.at(
            Some(at(RADIUS, std::f64::consts::TAU * f64::from(k) / 400.0)),
            None,
        );
        assert!(force.iter().all(|x| x.is_finite()), "{k}");
    }
    hands.at(None, None);
    let around = std::f64::consts::TAU * RADIUS;
    let length = hands.state.cuts.as_ref().unwrap().length();
    assert!((0.95..1.15).contains(&(length / around)), "{length}");
    let cut = feel(&mut hands);
    let parts: Vec<f64> = cut
        .iter()
        .zip(&uncut)
        .map(|(cut, uncut)| cut.z / uncut.z)
        .collect();
    println!("force over that of the uncut organ: {parts:.3?}");
    let mean = parts[..8].iter().sum::<f64>() / 8.0;
    assert!(mean > 0.3 && mean < 0.95, "{parts:?}");
    for part in &parts[..8] {
        assert!((part / mean - 1.0).abs() < 0.25, "{parts:?}");
    }
    assert!(parts[8] > mean && parts[8] <= 1.0, "{parts:?}");
    assert!(hands.state.undo_cut());
    assert_eq!(feel(&mut hands), uncut);
}

/// What the model has no room for is reported, and no longer once it is undone. Five strokes of 40 mm are more than 96
/// pieces of 1.2 mm.
#[test]
fn cuts_that_are_not_felt_are_reported() {
    let simulation = simulation(CUBE, "depth_m = 0.002");
    let mut hands = Hands::new(&simulation);
    let mut said = Vec::new();
    for stroke in 0..5 {
        let y = 0.006 * f64::from(stroke) - 0.0116;
        hands.cut(top(-0.02, y), top(0.02, y));
        hands.feel(top(0.0, 0.03));
        said.push(hands.workspace.warnings().join(" "));
    }
    assert!(said[0].is_empty() && said[1].is_empty(), "{said:?}");
    assert!(said[4].contains("mm of the cuts are seen"), "{said:?}");
    for _ in 0..3 {
        assert!(hands.state.undo_cut());
    }
    hands.feel(top(0.0, 0.03));
    assert!(hands.workspace.warnings().is_empty());
}

/// The source's mode leaves forces alone (section 7.7).
#[test]
fn the_source_s_mode_changes_no_force() {
    let simulation = simulation(CUBE, "depth_m = 0.004\nmode = \"snap\"");
    let mut hands = Hands::new(&simulation);
    let uncut = hands.feel(top(0.0, 0.0022));
    hands.cut(top(-0.012, 0.0004), top(0.012, 0.0004));
    assert!(hands.state.cuts.as_ref().unwrap().length() > 0.015);
    assert_eq!(hands.feel(top(0.0, 0.0022)), uncut);
}

/// A workspace that is lost in the middle of a cut changes nothing: the slit is made again of the cuts.
#[test]
fn a_lost_workspace_changes_no_force() {
    let simulation = simulation(CUBE, "depth_m = 0.004");
    let (mut kept, mut lost) = (Hands::new(&simulation), Hands::new(&simulation));
    for k in 0..150 {
        let hook = Some(top(-0.012 + 1.6e-4 * f64::from(k), 0.0004));
        let probe = Some(top(0.0, 0.004));
        if k % 40 == 0 {
            lost.workspace = SimulationWorkspace::new(&simulation);
        }
        let (a, b) = (kept.at(hook, probe), lost.at(hook, probe));
        assert_eq!(a, b, "step {k}");
    }
    assert!(kept.state.cuts.as_ref().unwrap().length() > 0.01);
}

/// Along an esophagus as wide as that of the finite elements, which judged cuts of up to 24 mm.
#[test]
fn a_cut_longer_than_any_that_was_judged_is_warned_of() {
    let esophagus = "builtin = \"esophagus\"\ntriangles = 3726";
    let simulation = simulation(esophagus, "depth_m = 0.002");
    let mut hands = Hands::new(&simulation);
    // Its axis runs through these places at y = 0, and its wall is at y = 7.5 mm.
    let places = [[-2.1, 16.8], [0.0, 0.0], [3.8, -16.6]];
    let place = |x: f64, z: f64| Vec3::new(1e-3 * x, 6.8e-3, 1e-3 * z);
    let way = |from: usize, part: f64| {
        let between = |k: usize| places[from][k] + part * (places[from + 1][k] - places[from][k]);
        place(between(0), between(1))
    };
    for half in [0, 1] {
        for k in 0..=150 {
            hands.at(Some(way(half, f64::from(k) / 150.0)), None);
        }
        let warnings = hands.workspace.warnings();
        match half {
            0 => assert!(warnings.is_empty(), "{warnings:?}"),
            _ => assert!(warnings[0].contains("mm long"), "{warnings:?}"),
        }
    }
    assert!(hands.state.cuts.as_ref().unwrap().length() > 0.03);
}
