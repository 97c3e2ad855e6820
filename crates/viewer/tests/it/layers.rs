//! A cut through layers is one state: picture, events and score agree on which layers are open.

use image::RgbaImage;
use palpate_files::session::{Event, Events};
use palpate_files::{Pose, Scene};
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, performance, step};
use palpate_viewer::Studio;

use crate::{TURN, gpu};

/// A cube whose upper side is at z = 0.05, seen from above, with layers of 1 mm. The mucosa gives way at 0.1 N.
const SCENE: &str = "format = 1\n[organ]\nbuiltin = \"cube\"\ntriangles = 3072\n\
    [organ.tissue]\nlaw = \"linear\"\nyoungs_modulus_pa = 10000.0\npoissons_ratio = 0.45\n\
    [[organ.layer]]\nname = \"longitudinal muscle\"\nthickness_m = 0.001\nbuiltin_tissue = \"pig-esophagus\"\n\
    [[organ.layer]]\nname = \"circular muscle\"\nthickness_m = 0.001\nbuiltin_tissue = \"pig-esophagus\"\n\
    [[organ.layer]]\nname = \"mucosa\"\nthickness_m = 0.001\nbuiltin_tissue = \"pig-esophagus\"\n\
    perforation_force_n = 0.1\n\
    [cutting]\nwidth_m = 0.006\n\
    [view]\neye_m = [0.0, -0.01, 0.13]\ntarget_m = [0.0, 0.0, 0.05]\n\
    [task]\n[task.cut]\nfrom_m = [-0.018, 0.002, 0.05]\nto_m = [0.018, 0.002, 0.05]\ntolerance_m = 0.002\nlayers = 3\n\
    [[tool]]\nname = \"right\"\nkind = \"scissors\"\n\
    tip = { shape = \"flat\", radius_m = 0.001, contact = \"stick\" }\n";

struct Hand<'a> {
    simulation: &'a Simulation,
    state: SimulationState,
    workspace: SimulationWorkspace,
    score: performance::Performance,
    steps: u32,
}

impl Hand<'_> {
    /// What happens in a step with the tip `depth` [m] below (x, 0.002).
    fn at(&mut self, x: f64, depth: f64, cut: bool) -> Events {
        let pose = Pose {
            position_m: [x, 0.002, 0.05 - depth],
            orientation: None,
            grip: 0.0,
            cut,
        };
        let elapsed = self.simulation.step();
        step(
            self.simulation,
            elapsed * f64::from(self.steps),
            elapsed,
            &[Some(pose)],
            &mut self.state,
            &mut self.workspace,
        );
        self.steps += 1;
        let row = &self.state.tools[0].row;
        self.score.add(row);
        row.events
    }

    /// What happens in a stroke with the blade `depth` [m] deep.
    fn stroke(&mut self, depth: f64) -> Events {
        let steps = (0..=200).map(|k| -0.02 + 2e-4 * f64::from(k));
        let all = steps.fold(Events::NONE, |all, x| all | self.at(x, depth, true));
        self.lift();
        all
    }

    /// What happens in a press with closed jaws until it is `depth` [m] deep.
    fn press(&mut self, depth: f64) -> Events {
        let steps = (0..=100).map(|k| depth * f64::from(k) / 100.0);
        let all = steps.fold(Events::NONE, |all, depth| all | self.at(0.0, depth, false));
        self.lift();
        all
    }

    /// Far away, so that the tool is in no picture.
    fn lift(&mut self) {
        for _ in 0..200 {
            self.at(0.5, -0.5, false);
        }
    }
}

/// Pixels that differ by more than an eye overlooks [levels of 255], and how many of these became darker.
fn differing(before: &RgbaImage, after: &RgbaImage) -> [usize; 2] {
    let apart = |(a, b): &(&image::Rgba<u8>, &image::Rgba<u8>)| {
        let mut pairs = a.0.into_iter().zip(b.0);
        pairs.any(|(a, b)| a.abs_diff(b) > 12)
    };
    let light = |pixel: &image::Rgba<u8>| pixel.0[..3].iter().map(|c| u32::from(*c)).sum::<u32>();
    let changed: Vec<_> = before.pixels().zip(after.pixels()).filter(apart).collect();
    let darker = changed.iter().filter(|(a, b)| light(b) < light(a)).count();
    [changed.len(), darker]
}

/// Judge: the depth of the blade against the thicknesses, and the force against the limit. A stroke that opens a layer
/// changes the picture and one that opens none does not; the mucosa is torn in the picture (the dark of the lumen is
/// seen), in the events, in the score and in the cuts, or in none of them.
#[test]
fn a_torn_mucosa_is_torn_in_picture_event_and_score() {
    if gpu().is_none() {
        return;
    }
    let _turn = TURN.lock();
    let scene = Scene::parse(SCENE, "layers.toml").unwrap();
    let simulation = Simulation::new(&scene).unwrap();
    for by_press in [false, true] {
        let mut hand = Hand {
            simulation: &simulation,
            state: SimulationState::new(&simulation),
            workspace: SimulationWorkspace::new(&simulation),
            score: performance::Performance::new(&scene.task, &["right".to_owned()]),
            steps: 0,
        };
        let mut studio = Studio::new(&scene, &simulation, (320, 200)).unwrap();
        let mut before = studio.picture(&hand.state).unwrap();
        // How deep the blade is [m], and how many layers are open then.
        for (depth, layers) in [(0.001, 1), (0.002, 2), (0.002, 2), (0.003, 3)] {
            let tears = layers == 3;
            let opens = hand.state.cuts.as_ref().unwrap().length_through(layers) == 0.0;
            let events = match tears && by_press {
                true => hand.press(0.006),
                // Within the layer above the face that it reaches.
                false => hand.stroke(depth + 0.0001),
            };
            let picture = studio.picture(&hand.state).unwrap();
            let [changed, darker] = differing(&before, &picture);
            before = picture;
            let lengths = [1, 2, 3].map(|n| hand.state.cuts.as_ref().unwrap().length_through(n));
            let perforations = hand.score.errors().perforations;
            println!(
                "{depth} m: {events}; {lengths:?}; {perforations} perforations; {changed} pixels, {darker} darker"
            );
            assert_eq!(events.deepest_opened(), opens.then_some(layers));
            assert_eq!(changed > 0, opens, "{changed} pixels");
            assert_eq!(
                lengths.map(|length| length > 0.0),
                [1, 2, 3].map(|n| n <= layers)
            );
            assert_eq!(events.contains(Event::Perforation), tears);
            assert_eq!(perforations, u64::from(tears));
            // Through the mucosa the dark of the lumen is seen.
            if tears {
                assert!(2 * darker > changed, "{darker} of {changed} pixels");
            }
        }
        assert_eq!(hand.score.score().outcome.passed(), Some(false));
    }
}
