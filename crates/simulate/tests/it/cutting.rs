//! Blades: what they open, what they feel, and what lies under an opening.

use std::sync::Arc;

use palpate_files::session::Event;
use palpate_files::{Motion, Pose, Scene};
use palpate_geometry::{CutMethod, TriangleId, Vec3};
use palpate_servo::ServoSettings;
use palpate_simulate::interactive::{ModelCommand, VirtualInteraction};
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};

use crate::interactive::playing;

/// A cube of 0.1 m, whose upper side is at z = 0.05, and one tool called "right".
fn scene(tool: &str, more: &str) -> Scene {
    let text = format!(
        "format = 1\n\
         [organ]\nbuiltin = \"cube\"\ntriangles = 3072\n\
         [organ.tissue]\nlaw = \"linear\"\nyoungs_modulus_pa = 10000.0\npoissons_ratio = 0.45\n\
         {more}\n\
         [[tool]]\nname = \"right\"\n{tool}\n"
    );
    Scene::parse(&text, "cutting.toml").unwrap()
}

const HOOK: &str =
    "kind = \"hook\"\ntip = { shape = \"flat\", radius_m = 0.001, contact = \"stick\" }";
const PROBE: &str =
    "kind = \"probe\"\ntip = { shape = \"flat\", radius_m = 0.001, contact = \"stick\" }";

/// A tool that is moved step by step.
struct Hand<'a> {
    simulation: &'a Simulation,
    state: SimulationState,
    workspace: SimulationWorkspace,
    steps: u32,
}

impl<'a> Hand<'a> {
    fn new(simulation: &'a Simulation) -> Self {
        Self {
            state: SimulationState::new(simulation),
            workspace: SimulationWorkspace::new(simulation),
            simulation,
            steps: 0,
        }
    }

    fn at(&mut self, tip: Vec3, cut: bool) -> Vec3 {
        let pose = Pose {
            position_m: tip.into(),
            orientation: None,
            grip: 0.0,
            cut,
        };
        let elapsed = self.simulation.step();
        let time = elapsed * f64::from(self.steps);
        self.steps += 1;
        step(
            self.simulation,
            time,
            elapsed,
            &[Some(pose)],
            &mut self.state,
            &mut self.workspace,
        );
        self.state.tools[0].force
    }

    /// Cuts along the upper side, 0.1 mm a step, 1 mm deep; the forces.
    fn cut_along(&mut self, [from, to]: [Vec3; 2]) -> Vec<Vec3> {
        let steps = ((to - from).norm() / 1e-4).round().max(1.0);
        let places = (0..=steps as u32).map(|k| from + (to - from) * (f64::from(k) / steps));
        let forces = places.map(|place| self.at(place, true)).collect();
        self.at(to + Vec3::z() * 0.01, false);
        forces
    }

    fn happened(&self, event: Event) -> bool {
        self.state.tools[0].row.events.contains(event)
    }

    fn shape(&self) -> (Vec<Vec3>, usize) {
        let cuts = self.state.cuts.as_ref().unwrap();
        (
            cuts.mesh().vertices().to_vec(),
            cuts.mesh().triangles().len(),
        )
    }
}

/// A place on the upper side, 1 mm deep.
fn top(x: f64, y: f64) -> Vec3 {
    Vec3::new(x, y, 0.049)
}

/// An edge that is drawn through tissue is held back by R d, however fast, and leaves work R d per length.
/// Judge: the slider with friction, in closed form: the force rises to R d over the way R d/k and stays there. The
/// stiffness of this model changes along a flat side by parts of a percent, by how the triangles lie: 2 %.
#[test]
fn an_edge_is_held_back_by_toughness() {
    let simulation = Simulation::new(&scene(
        HOOK,
        "[cutting]\ndepth_m = 0.001\ntoughness_j_per_m2 = 20.0",
    ))
    .unwrap();
    let resistance = 20.0 * 0.001;
    let mut hand = Hand::new(&simulation);
    let forces = hand.cut_along([top(-0.02, 0.003), top(0.02, 0.003)]);
    let back: Vec<f64> = forces.iter().map(|force| -force.x).collect();
    let stiffness = (back[2] - back[1]) / 1e-4;
    let lag = resistance / stiffness;
    println!("k = {stiffness:.2} N/m, R d/k = {:.2} mm", 1e3 * lag);
    assert!(lag > 5e-4 && lag < 5e-3);
    let risen = (lag / 1e-4).ceil() as usize + 2;
    for (k, force) in back.iter().enumerate().skip(risen) {
        assert!((force / resistance - 1.0).abs() < 0.02, "step {k}: {force}");
    }
    let work: f64 = back.iter().map(|force| force * 1e-4).sum();
    let expected = resistance * (0.04 - 0.5 * lag);
    println!("work {:.4} mJ of {:.4}", 1e3 * work, 1e3 * expected);
    assert!((work / expected - 1.0).abs() < 0.02);
    // The opening ends where the edge is, which is R d/k behind the tip, and at most two edges of 8.8 mm and what
    // the ends lack, half an edge each.
    let length = hand.state.cuts.as_ref().unwrap().length();
    assert!(length > 0.04 - lag - 0.0095 && length < 0.04, "{length}");
}

/// Scissors work between their blades: nothing lags, nothing holds the tool back but that.
#[test]
fn scissors_do_not_drag() {
    let tool = HOOK.replace("hook", "scissors");
    let simulation = Simulation::new(&scene(&tool, "")).unwrap();
    let mut hand = Hand::new(&simulation);
    let forces = hand.cut_along([top(-0.02, 0.003), top(0.02, 0.003)]);
    // What is left comes from how the surface's normals turn: nothing on a flat side.
    let sideways = forces[1..].iter().map(|force| force.xy().norm());
    let largest = sideways.fold(0.0, f64::max);
    let normal = forces[10].z;
    assert!(
        normal > 1e-3 && largest < 1e-3 * normal,
        "{largest} {normal}"
    );
    assert!(hand.state.cuts.as_ref().unwrap().length() > 0.03);
}

/// The source's mode (section 7.7): as many triangles as before, area outside of the opening unchanged within
/// 1 %, forces those of the uncut organ to the last bit, the same motion the same mesh.
#[test]
fn the_source_s_mode_keeps_triangles_area_and_force() {
    let simulation = Simulation::new(&scene(HOOK, "[cutting]\nmode = \"snap\"")).unwrap();
    let way = [top(-0.02, -0.01), top(0.02, 0.015)];
    let (mut hand, mut again) = (Hand::new(&simulation), Hand::new(&simulation));
    hand.cut_along(way);
    again.cut_along(way);
    assert!(hand.shape() == again.shape());
    let cuts = hand.state.cuts.as_ref().unwrap();
    assert!(cuts.has_openings() && cuts.largest_lag() >= 1 && cuts.largest_lag() <= 3);
    let (before, after) = (simulation.surface().mesh(), cuts.mesh());
    assert_eq!(before.triangles().len(), after.triangles().len());
    assert!((after.area() / before.area() - 1.0).abs() < 0.01);
    let mut untouched = Hand::new(&simulation);
    for hand in [&mut hand, &mut untouched] {
        hand.steps = 10_000;
    }
    let place = top(0.001, 0.002);
    assert_eq!(hand.at(place, false), untouched.at(place, false));
}

/// Seen in the opening, the two sides of the cut are its width apart. Judge: the width that was asked for.
#[test]
fn an_opening_gapes() {
    let simulation = Simulation::new(&scene(HOOK, "[cutting]\nwidth_m = 0.002")).unwrap();
    let mut hand = Hand::new(&simulation);
    hand.cut_along([top(-0.02, 0.003), top(0.02, 0.003)]);
    // A step without a contact: the organ is at rest, and the opening still there.
    hand.at(Vec3::new(0.0, 0.0, 0.2), false);
    let cuts = hand.state.cuts.as_ref().unwrap();
    let (mut left, mut right) = (f64::NEG_INFINITY, f64::INFINITY);
    for (place, rest) in cuts.places().iter().zip(cuts.mesh().vertices()) {
        let moved = (place - rest).y;
        if moved != 0.0 && rest.x.abs() < 0.01 {
            (left, right) = (left.max(moved), right.min(moved));
        }
    }
    // The blade went along x, so that the sides go along y.
    assert!(
        (left - 0.001).abs() < 5e-5 && (right + 0.001).abs() < 5e-5,
        "{left} {right}"
    );
}

/// An undone cut leaves no trace; a new beginning neither.
#[test]
fn what_is_undone_was_never_there() {
    let simulation = Simulation::new(&scene(HOOK, "")).unwrap();
    let mut hand = Hand::new(&simulation);
    let uncut = hand.shape();
    hand.cut_along([top(-0.02, 0.0), top(0.02, 0.0)]);
    let once = hand.shape();
    hand.cut_along([top(0.0, -0.02), top(0.0, 0.02)]);
    assert!(hand.shape() != once);
    assert!(hand.state.undo_cut());
    assert!(hand.shape() == once);
    assert!(hand.state.undo_cut() && !hand.state.undo_cut());
    assert!(hand.shape() == uncut);
    hand.cut_along([top(-0.02, 0.0), top(0.02, 0.0)]);
    hand.state.reset(&simulation);
    assert!(hand.shape() == uncut && !hand.state.cuts.as_ref().unwrap().has_openings());
}

const LAYERS: &str = "[[organ.layer]]\nname = \"muscle\"\nthickness_m = 0.0015\n\
    builtin_tissue = \"pig-esophagus\"\nperforation_force_n = 0.06\n\
    [[organ.layer]]\nname = \"mucosa\"\nthickness_m = 0.001\n\
    builtin_tissue = \"pig-esophagus\"\nperforation_force_n = 0.05\n";

/// A layer gives way at its force and not before: a probe that presses harder cuts the outer one as it slides,
/// and breaks through the inner one only where that is bare. Judge: the forces that the scene names.
#[test]
fn layers_give_way_one_by_one() {
    let tool = PROBE.replace("0.001", "0.0015");
    let tough = format!("{LAYERS}[cutting]\ntoughness_j_per_m2 = 20.0");
    let simulation = Simulation::new(&scene(&tool, &tough)).unwrap();
    let mut hand = Hand::new(&simulation);
    let cuts = |hand: &Hand<'_>| hand.state.cuts.as_ref().unwrap().has_openings();
    // Down until just below the outer layer's force: nothing gives way.
    let mut depth = 0.0;
    while hand.at(Vec3::new(0.0, 0.0, 0.05 - depth), false).z < 0.055 {
        assert!(!hand.happened(Event::Perforation) && !cuts(&hand));
        depth += 5e-5;
        assert!(depth < 0.01);
    }
    // Beyond it, and along.
    let mut along = 0.0;
    let mut deeper = depth;
    while hand.at(Vec3::new(0.0, 0.0, 0.05 - deeper), false).z <= 0.06 {
        deeper += 5e-5;
    }
    let (mut opened, mut perforated_at) = (0, None);
    while along < 0.03 {
        along += 1e-4;
        hand.at(Vec3::new(along, 0.0, 0.05 - deeper), false);
        opened += usize::from(hand.happened(Event::Cut));
        if hand.happened(Event::Perforation) && perforated_at.is_none() {
            perforated_at = Some(opened);
        }
    }
    assert!(opened > 2, "{opened}");
    // It was broken through once, and not before anything was open.
    assert!(perforated_at.is_some_and(|opened| opened > 0));
}

fn refused(more: &str) -> String {
    let scene = scene(HOOK, more);
    match Simulation::new(&scene) {
        Ok(_) => panic!("was taken"),
        Err(error) => {
            assert!(error.is_input());
            error.to_string()
        }
    }
}

#[test]
fn too_much_of_a_layer_or_a_cut_is_refused() {
    let thick = LAYERS.replace("0.0015", "0.5");
    let words = refused(&thick);
    assert!(
        words.contains("\"muscle\" the layers are 500 mm thick"),
        "{words}"
    );
    let words = refused("[cutting]\ndepth_m = 0.3");
    assert!(words.contains("cut would be 300 mm deep"), "{words}");
}

/// Judge: `geometry`'s own checks of a cut mesh, by another way: each edge belongs to one or two triangles, and
/// every triangle has an area.
#[test]
fn cuts_that_cross_turn_and_end_leave_a_sound_mesh() {
    for (mode, method) in [
        ("split", CutMethod::SplitTriangles),
        ("snap", CutMethod::SnapVertices),
    ] {
        let simulation =
            Simulation::new(&scene(HOOK, &format!("[cutting]\nmode = \"{mode}\""))).unwrap();
        let mut hand = Hand::new(&simulation);
        for [ax, ay, bx, by] in [
            [-0.03, 0.0, 0.03, 0.004],
            [0.004, -0.03, 0.0, 0.03],
            [-0.03, 0.03, 0.03, -0.03],
            [-0.02, 0.001, -0.021, 0.002],
        ] {
            hand.cut_along([top(ax, ay), top(bx, by)]);
        }
        let cuts = hand.state.cuts.as_ref().unwrap();
        assert!(cuts.count() >= 3, "{method:?}");
        let mesh = cuts.mesh();
        let mut edges = std::collections::HashMap::new();
        for id in mesh.triangle_ids() {
            assert!(mesh.area_vector(id).norm() > 0.0);
            let nodes = mesh.corners(id);
            for k in 0..3 {
                *edges.entry((nodes[k], nodes[(k + 1) % 3])).or_insert(0) += 1;
            }
        }
        assert!(edges.values().all(|&count| count == 1));
        let open = edges.keys().filter(|(a, b)| !edges.contains_key(&(*b, *a)));
        let sides = |id: TriangleId| cuts.surface().sides(id).into_iter().flatten().count();
        let rims: usize = mesh.triangle_ids().map(sides).sum();
        assert_eq!(open.count(), rims);
        assert!(rims > 20);
    }
}

/// Who looks sees a place for every vertex, at every step of a model that shapes the organ more rarely than it
/// steps. Judge: the triangles that are told beside them.
#[test]
fn what_is_seen_of_a_cut_is_whole() {
    let simulation = Arc::new(Simulation::new(&scene(HOOK, "")).unwrap());
    let motion = "# format = 1\ntime_s,tool,x_m,y_m,z_m,cut\n0.0,right,-0.03,0.002,0.052,0\n\
                  0.1,right,-0.03,0.002,0.049,1\n1.1,right,0.03,0.004,0.049,1\n1.3,right,0.03,0.0,0.06,0\n";
    let motion = Motion::parse(motion, "motion.csv").unwrap();
    let device = playing(&motion.tools()[0]);
    let mut hands =
        VirtualInteraction::new(simulation, vec![Some(device)], ServoSettings::default()).unwrap();
    let mut versions = std::collections::HashSet::new();
    for tick in 0..1500 {
        if tick == 1400 {
            hands.send(ModelCommand::UndoCut);
        }
        hands.advance().unwrap();
        let opened = hands.snapshot().opened.as_ref().unwrap();
        assert_eq!(opened.places.len(), opened.rest.len(), "tick {tick}");
        let nodes = opened.triangles.iter().flatten();
        assert!(
            nodes
                .copied()
                .all(|node| (node as usize) < opened.places.len())
        );
        versions.insert(opened.version);
    }
    assert!(versions.len() > 5, "{versions:?}");
    // Undone.
    assert_eq!(hands.snapshot().opened.as_ref().unwrap().version, 0);
}
