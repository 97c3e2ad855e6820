//! Sessions that are played again. Judge: what was recorded, bit by bit.

use std::sync::Arc;

use palpate_files::session::{Event, Events};
use palpate_files::{Pose, Scene, Session, SessionRow, SessionWriter};
use palpate_geometry::Vec3;
use palpate_servo::{Pointer, PointerHand, ServoSettings};
use palpate_simulate::interactive::{CUTS, ModelCommand, PlacedDevice, VirtualInteraction};
use palpate_simulate::{Error, Replay, Simulation, SimulationState, SimulationWorkspace, step};

use crate::scenes::Random;

/// A cube whose upper side is at z = 0.05, under a grasper through a trocar and a free hook.
fn simulation(model: &str, digest: &str) -> Arc<Simulation> {
    let text = format!(
        "format = 1\n\
         [organ]\nbuiltin = \"cube\"\ntriangles = 3072\n{digest}\n\
         [organ.tissue]\nlaw = \"linear\"\nyoungs_modulus_pa = 10000.0\npoissons_ratio = 0.45\n\
         prony = [{{ g = 0.4, tau_s = 0.3 }}]\n\
         [model]\n{model}\n\
         [[tool]]\nname = \"left\"\nkind = \"grasper\"\ntip = {{ shape = \"flat\", radius_m = 0.0015 }}\n\
         trocar_m = [-0.05, 0.0, 0.2]\n\
         [[tool]]\nname = \"right\"\nkind = \"hook\"\ntip = {{ shape = \"flat\", radius_m = 0.001 }}\n"
    );
    let scene = Scene::parse(&text, "replay.toml").unwrap();
    Arc::new(Simulation::new(&scene).unwrap())
}

/// What two hands do by chance: they press, pull, cut, let go of their tools and take them up again.
struct Played {
    interaction: VirtualInteraction,
    hands: [PointerHand; 2],
    rows: Vec<SessionRow>,
}

impl Played {
    fn new(simulation: &Arc<Simulation>) -> Self {
        let [(left, left_hand), (right, right_hand)] = [Pointer::new(), Pointer::new()];
        let devices = vec![
            Some(PlacedDevice::new(left)),
            Some(PlacedDevice::new(right)),
        ];
        let settings = ServoSettings::default();
        Self {
            interaction: VirtualInteraction::new(simulation.clone(), devices, settings).unwrap(),
            hands: [left_hand, right_hand],
            rows: Vec::new(),
        }
    }

    fn wait(&mut self, ticks: usize) {
        for _ in 0..ticks {
            self.interaction.advance().unwrap();
            self.rows.extend(self.interaction.rows());
        }
    }

    fn gestures(&mut self, count: usize, random: &mut Random) {
        for _ in 0..count {
            let mut place = || 0.03 * (random.unit() - 0.5);
            let (x, y, z) = (place(), place(), 0.0505 - 0.2 * place().abs());
            let side = usize::from(random.unit() < 0.5);
            let at = Vec3::new(x + 0.02 * side as f64, y, z);
            let hand = &mut self.hands[side];
            hand.move_to(at);
            let grip = f64::from(u8::from(random.unit() < 0.6));
            hand.press(grip, if random.unit() < 0.7 { CUTS } else { 0 });
            self.wait(40 + (80.0 * random.unit()) as usize);
            for drag in 1..=(20.0 * random.unit()) as u32 {
                let along = Vec3::new(0.0, 1.5e-3 * f64::from(drag), 0.0);
                self.hands[side].move_to(at + along);
                self.wait(20);
            }
            if random.unit() < 0.2 {
                self.hands[side].leave();
                self.wait((120.0 * random.unit()) as usize);
            }
            let order = match (12.0 * random.unit()) as usize {
                0 => ModelCommand::UndoCut,
                1 => ModelCommand::Mark,
                2 => ModelCommand::Pause,
                3 => ModelCommand::Reset,
                _ => continue,
            };
            self.interaction.send(order);
            self.wait((60.0 * random.unit()) as usize);
            self.interaction.send(ModelCommand::Resume);
        }
    }

    /// As it comes from its file.
    fn session(&self, simulation: &Simulation) -> Session {
        let folder = std::env::temp_dir().join(format!("palpate-replay-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join(format!("{}.csv", self.rows.len()));
        let names: Vec<_> = simulation.tools().iter().map(|t| t.name.clone()).collect();
        let mut writer =
            SessionWriter::create(&path, &simulation.session_header(), &names).unwrap();
        self.rows.iter().for_each(|row| writer.write(row).unwrap());
        writer.finish().unwrap();
        let session = Session::read(&path).unwrap();
        std::fs::remove_dir_all(&folder).unwrap();
        session
    }
}

/// Events that a step finds, not a hand or an order.
fn found(events: Events) -> Events {
    let told = [Event::Mark, Event::Lifted, Event::UndoCut, Event::Restart];
    // A free tool's shaft was not known.
    let shafts = [Event::ShaftContact, Event::ShaftRelease];
    let all = events
        .iter()
        .filter(|event| !told.contains(event) && !shafts.contains(event));
    all.collect()
}

/// Plays a step and compares it with its rows.
fn advance_and_compare(replay: &mut Replay, compared: &mut usize) -> bool {
    let is_there = replay.advance();
    if is_there {
        for row in replay.recorded() {
            let tool = &replay.state().tools[row.tool];
            if row.events.contains(Event::Lifted) {
                assert!(tool.pose.is_none());
                continue;
            }
            let same = tool.row.force_n == row.force_n
                && tool.row.depth_m == row.depth_m
                && tool.row.orientation == row.orientation
                && tool.row.grip_force_n == row.grip_force_n
                && found(tool.row.events) == found(row.events);
            assert!(same, "step {}\n{row:?}\n{:?}", replay.played(), tool.row);
            *compared += usize::from(row.contact);
        }
    }
    is_there
}

const MODELS: [&str; 2] = [
    "kind = \"local\"",
    "kind = \"hybrid\"\nresponse = \"boundary_elements\"\nmechanical_triangles = 400",
];

#[test]
fn what_was_felt_is_felt_again() {
    for model in MODELS {
        let simulation = simulation(model, "");
        let mut played = Played::new(&simulation);
        played.gestures(60, &mut Random(11));
        let session = played.session(&simulation);
        let number = |row: &SessionRow| {
            let name = &session.tools[row.tool];
            simulation
                .tools()
                .iter()
                .position(|tool| tool.name == *name)
                .unwrap()
        };
        let numbered = session.rows.iter().map(|row| SessionRow {
            tool: number(row),
            ..*row
        });
        assert_eq!(numbered.collect::<Vec<_>>(), played.rows);
        let happened = |event| {
            session
                .rows
                .iter()
                .filter(|r| r.events.contains(event))
                .count()
        };
        for event in [
            Event::Cut,
            Event::Grip,
            Event::Lifted,
            Event::UndoCut,
            Event::Restart,
            Event::Mark,
        ] {
            assert!(happened(event) > 0, "{event} {model}");
        }
        let mut replay = Replay::new(simulation, &session).unwrap();
        let mut compared = 0;
        while advance_and_compare(&mut replay, &mut compared) {}
        assert!(compared > 300, "{compared}");
        assert_eq!(replay.played(), replay.steps());
    }
}

#[test]
fn going_back_is_exact() {
    let simulation = simulation(MODELS[0], "");
    let mut played = Played::new(&simulation);
    let mut random = Random(5);
    played.gestures(25, &mut random);
    let mut replay = Replay::new(simulation.clone(), &played.session(&simulation)).unwrap();
    let steps = replay.steps();
    for _ in 0..12 {
        replay.go_to((random.unit() * steps as f64) as usize);
        advance_and_compare(&mut replay, &mut 0);
    }
    replay.go_to(usize::MAX);
    assert_eq!(replay.played(), steps);
}

#[test]
fn states_from_ahead_are_those_of_the_session() {
    let simulation = simulation(MODELS[0], "");
    let mut played = Played::new(&simulation);
    played.gestures(25, &mut Random(7));
    let mut replay = Replay::new(simulation.clone(), &played.session(&simulation)).unwrap();
    let last = replay.time(replay.steps()) - replay.time(0);
    assert!(last > 3.0, "{last} s are too few for states to be kept");
    replay.look_ahead();
    let mut jumps = 0;
    while replay.played() < replay.steps() {
        let before = replay.played();
        // Never computed here: it comes from the other thread, sooner or later.
        while jumps < 3 && replay.played() == before {
            replay.jump(before + 400);
        }
        jumps += 1;
        for _ in 0..20 {
            advance_and_compare(&mut replay, &mut 0);
        }
    }
    assert!(jumps > 3);
}

#[test]
fn another_scene_is_not_played() {
    let first = simulation(MODELS[0], "");
    let mut played = Played::new(&first);
    assert!(matches!(
        Replay::new(first.clone(), &played.session(&first)),
        Err(Error::EmptySession)
    ));
    played.gestures(2, &mut Random(3));
    let session = played.session(&first);
    let ball = "inclusion = [{ ball = { center_m = [0, 0, 0.04], radius_m = 0.004 }, stiffness_ratio = 5 }]";
    let message = match Replay::new(simulation(MODELS[0], ball), &session) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("played"),
    };
    assert!(message.contains("the scene"), "{message}");
    let mut other = session;
    other.tools[0] = "third".to_owned();
    assert!(Replay::new(first, &other).is_err());
}

/// Forces are those of every step, however rarely the surface is displayed: a session that was recorded without a window is replayed
/// in one. Judge: the same steps, to the last bit.
#[test]
fn forces_do_not_depend_on_the_display() {
    let simulation = simulation("kind = \"nonlinear\"\nnodes = 700", "");
    let mut random = Random(7);
    let mut states = [0.0, 1.0 / 60.0, 0.1].map(|period| {
        let state = SimulationState::new(&simulation).show_every(period);
        (state, SimulationWorkspace::new(&simulation))
    });
    let mut goals = [Vec3::new(0.0, 0.0, 0.06); 2];
    let mut places = goals;
    let (mut grip, mut touched, mut held) = (0.0, 0, 0);
    for k in 0..1500 {
        if k % 60 == 0 {
            let mut near = |wide: f64| wide * (random.unit() - 0.5);
            goals = [-0.01, 0.01].map(|x| Vec3::new(x + near(0.01), near(0.02), 0.05 + near(0.01)));
            grip = f64::from(u8::from(random.unit() < 0.5));
        }
        for (place, goal) in places.iter_mut().zip(&goals) {
            *place += 0.05 * (goal - *place);
        }
        let pose = |place: Vec3, cut: bool| Pose {
            position_m: place.into(),
            orientation: None,
            grip,
            cut,
        };
        // The left hand leaves its tool from time to time.
        let left = (k % 500 > 50).then(|| pose(places[0], false));
        let poses = [left, Some(pose(places[1], k % 300 > 200))];
        let elapsed = if k == 0 { 0.0 } else { simulation.step() };
        let time = f64::from(k) * simulation.step();
        let forces = states.each_mut().map(|(state, workspace)| {
            step(&simulation, time, elapsed, &poses, state, workspace);
            [0, 1].map(|tool| state.tools[tool].force)
        });
        assert!(
            forces[0] == forces[1] && forces[0] == forces[2],
            "{k}: {forces:?}"
        );
        touched += u32::from(forces[0][1].norm() > 0.0);
        held += u32::from(states[0].0.tools[0].is_grasping());
    }
    println!("{touched} steps in contact, {held} steps of a grasp");
    assert!(touched > 300 && held > 100);
}
