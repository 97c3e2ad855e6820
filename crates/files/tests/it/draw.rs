//! Scenes whose numbers are drawn.

use palpate_files::Scene;
use palpate_files::scene::{Drawn, Goal, LARGEST_SEED, OnSurface, SurfacePoint};

const SCENE: &str = r#"
format = 1
[organ]
builtin = "hemisphere"
builtin_tissue = "pig-liver"
[[organ.inclusion]]
ball = { center_mm = { draw = "lump" }, radius_m = { draw = "radius" } }
stiffness_ratio = { draw = "stiffness" }
[[tool]]
name = "left"
[[tool]]
name = "right"
[draw.place]
on_surface = { min_m = [-0.02, -0.02, 0.04], max_m = [0.02, 0.02, 0.06], facing = [0.0, 0.0, 2.0] }
[draw.depth]
uniform = [0.008, 0.012]
[draw.lump]
uniform = [[0.0, 0.0, 30.0], [1.0, 2.0, 40.0]]
[draw.below]
below = "place"
depth_m = "depth"
[draw.radius]
uniform = [0.004, 0.006]
[draw.stiffness]
one_of = [4, 8.0]
[draw.hand]
one_of = ["left", "right"]
[task.traction]
tool = { draw = "hand" }
force_n = 0.2
tolerance_n = 0.1
hold_s = 3.0
direction = { draw = "below" }
"#;

fn scene() -> Scene {
    Scene::parse(SCENE, "task.toml").unwrap()
}

/// A flat organ at z = 0.05 m.
fn flat(on: &OnSurface, [_, u, v]: [f64; 3]) -> Option<SurfacePoint> {
    let across = |axis: usize, part: f64| on.min_m[axis] + part * (on.max_m[axis] - on.min_m[axis]);
    Some(SurfacePoint {
        point_m: [across(0, u), across(1, v), 0.05],
        normal: [0.0, 0.0, 1.0],
    })
}

fn value<'s>(scene: &'s Scene, name: &str) -> &'s Drawn {
    let drawn = &scene.variant.as_ref().unwrap().drawn;
    &drawn.iter().find(|(own, _)| own == name).unwrap().1
}

#[test]
fn the_same_seed_is_the_same_scene_and_another_is_another() {
    let scene = scene();
    assert_eq!(scene.draws.as_ref().unwrap().surfaces().count(), 1);
    let one = scene.drawn(7, &flat).unwrap();
    let again = scene.drawn(7, &flat).unwrap();
    assert_eq!(one, again);
    assert_eq!(one.written, again.written);
    assert_eq!(one.variant.as_ref().unwrap().seed, 7);
    assert!(one.draws.is_none());
    let other = scene.drawn(8, &flat).unwrap();
    assert_ne!(
        one.organ.estimated_inclusions,
        other.organ.estimated_inclusions
    );
    assert!(scene.drawn(LARGEST_SEED, &flat).is_ok());
}

/// A session's scene has the values, so that no later version of the program draws others.
#[test]
fn a_variant_is_read_as_it_was_drawn() {
    let one = scene().drawn(7, &flat).unwrap();
    let text = one.written.clone().unwrap();
    assert!(!text.contains("draw ="), "{text}");
    let read = Scene::parse(&text, "elsewhere/scene.toml").unwrap();
    assert_eq!(read.organ, one.organ);
    assert_eq!(read.task, one.task);
    assert_eq!(read.variant, one.variant);
    assert_eq!(read.drawn(8, &flat).unwrap().organ, one.organ);
}

/// Judge: the words of the scene, over 300 seeds; means of uniform numbers within four standard errors of the middle.
#[test]
fn values_are_those_of_their_distributions() {
    let scene = scene();
    let all: Vec<Scene> = (0..300)
        .map(|seed| scene.drawn(seed, &flat).unwrap())
        .collect();
    let mut depths = Vec::new();
    let (mut lefts, mut soft) = (0, 0);
    for one in &all {
        let lump = &one.organ.estimated_inclusions[0];
        assert!((0.004..=0.006).contains(&lump.shape.smallest_radius()));
        // The place takes the value in its own unit.
        assert!((0.030..=0.040).contains(&lump.middle()[2]), "{lump:?}");
        let (Drawn::Vector(place), Drawn::Number(depth), Drawn::Vector(below)) = (
            value(one, "place"),
            value(one, "depth"),
            value(one, "below"),
        ) else {
            panic!("{:?}", one.variant)
        };
        assert_eq!(below[..2], place[..2]);
        assert!((place[2] - below[2] - depth).abs() < 1e-15);
        depths.push(*depth);
        soft += usize::from(lump.stiffness_ratio == 4.0);
        let Goal::Traction { tool, .. } = &one.task.goal else {
            panic!("{:?}", one.task)
        };
        lefts += usize::from(tool.as_deref() == Some("left"));
    }
    let mean = depths.iter().sum::<f64>() / 300.0;
    // A uniform number of width w has the deviation w/√12.
    assert!(
        (mean - 0.010).abs() < 4.0 * 0.004 / 12_f64.sqrt() / 300_f64.sqrt(),
        "{mean}"
    );
    for count in [lefts, soft] {
        // Four deviations of a fair coin.
        assert!(count.abs_diff(150) < 35, "{count}");
    }
    // Draws with different names do not follow one another.
    let both = all.iter().filter(|one| {
        let left = *value(one, "hand") == Drawn::Text("left".to_owned());
        left == (one.organ.estimated_inclusions[0].stiffness_ratio == 4.0)
    });
    assert!(both.count().abs_diff(150) < 35);
}

/// A draw more leaves the others as they are.
#[test]
fn a_new_draw_changes_no_other() {
    let more = SCENE.to_owned() + "[draw.another]\nuniform = [0.0, 1.0]\n";
    let more = Scene::parse(&more, "task.toml").unwrap();
    let (one, other) = (
        scene().drawn(3, &flat).unwrap(),
        more.drawn(3, &flat).unwrap(),
    );
    assert_eq!(one.organ, other.organ);
    assert_eq!(one.task, other.task);
}

#[test]
fn what_cannot_be_drawn_is_an_error_at_its_line() {
    let refused = |from: &str, to: &str| {
        let error = Scene::parse(&SCENE.replacen(from, to, 1), "task.toml").unwrap_err();
        error.to_string()
    };
    for (from, to, line, words) in [
        (
            "{ draw = \"radius\" }",
            "{ draw = \"radus\" }",
            8,
            "`radius_m.draw` is \"radus\"",
        ),
        (
            "{ draw = \"radius\" }",
            "{ draw = 3 }",
            8,
            "`radius_m.draw` is 3",
        ),
        (
            "uniform = [0.004, 0.006]",
            "uniform = [0.006, 0.004]",
            24,
            "`draw.radius.uniform`",
        ),
        (
            "uniform = [0.004, 0.006]",
            "uniform = [-0.006, -0.004]",
            8,
            "organ.inclusion[0].ball.radius_m",
        ),
        (
            "uniform = [0.004, 0.006]",
            "unifrom = [0.004, 0.006]",
            24,
            "draw.radius.unifrom",
        ),
        (
            "one_of = [4, 8.0]",
            "one_of = []",
            26,
            "draw.stiffness.one_of",
        ),
        (
            "below = \"place\"",
            "below = \"depth\"",
            21,
            "draw.below.below",
        ),
        ("depth_m = \"depth\"", "depth_m = \"hand\"", 22, ""),
        (
            "facing = [0.0, 0.0, 2.0]",
            "facing = [0.0, 0.0, 0.0]",
            14,
            "facing",
        ),
    ] {
        let error = refused(from, to);
        assert!(error.contains(words), "{words}: {error}");
        let _ = line;
        assert!(error.contains("task.toml line "), "{error}");
    }
    // A box without surface is found when a variant is drawn.
    let error = scene().drawn(1, &|_, _| None).unwrap_err().to_string();
    assert!(error.contains("draw.place.on_surface"), "{error}");
}
