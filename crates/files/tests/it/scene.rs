use std::path::PathBuf;

use palpate_files::scene::*;
use palpate_files::tissue::LawName;
use palpate_files::{BuiltinTissue, Elasticity, Scene, Tissue};

use crate::SCENE;

fn parse(text: &str) -> Scene {
    Scene::parse(text, "scenes/scene.toml").unwrap()
}

#[test]
fn every_key_is_understood() {
    let scene = parse(SCENE);
    assert_eq!(scene.folder, PathBuf::from("scenes"));
    let shape = Shape::Mesh {
        path: PathBuf::from("scenes/kidney.stl"),
        unit: Some(LengthUnit::Millimetre),
    };
    assert_eq!(scene.organ.shape, shape);
    let tissue = PathBuf::from("scenes/tissue.toml");
    assert_eq!(scene.organ.tissue, TissueChoice::File(tissue));
    assert_eq!(scene.neighbours.len(), 2);
    assert!(scene.neighbours[1].collides && !scene.neighbours[0].collides);
    assert_eq!(scene.neighbours[0].location, Location::default());
    let placed = Location {
        at_m: [0.010, -0.020, 0.030],
        turn_rad: [0.0, 0.0, 90_f64.to_radians()],
        scale: 1.5,
    };
    assert_eq!(scene.neighbours[1].location, placed);
    assert_eq!(scene.task.expert, Some(PathBuf::from("scenes/expert")));
    assert_eq!(scene.task.force_limit_n, Some(2.0));
    assert_eq!(scene.task.time_limit_s, Some(60.0));
    assert_eq!(scene.task.title.as_deref(), Some("palpation"));
    let goal = Goal::Find {
        target_m: [0.001, 0.002, 0.003],
        tolerance_m: 0.004,
        size: None,
    };
    assert_eq!(scene.task.goal, goal);
    // By the name that they had first.
    let nodule = EstimatedInclusion {
        name: "nodule 1".to_owned(),
        shape: InclusionShape::Ball {
            center_m: [0.0, 0.0, 0.02],
            radius_m: 0.005,
        },
        stiffness_ratio: 6.0,
    };
    assert_eq!(scene.organ.estimated_inclusions, [nodule]);
    assert!((scene.view.field_of_view_rad - 60_f64.to_radians()).abs() < 1e-15);
    assert_eq!(scene.view.shading, Shading::Plain);
}

#[test]
fn layers_hold_their_own_tissues() {
    let scene = parse(SCENE);
    let [outer, inner] = scene.organ.layers.as_slice() else {
        panic!("{:?}", scene.organ.layers)
    };
    assert_eq!(
        (outer.thickness_m, outer.perforation_force_n),
        (0.0015, Some(0.5))
    );
    let tissue = outer.tissue.read().unwrap();
    let expected = Elasticity::new(LawName::NeoHookean, &[1000.0.into()]);
    assert_eq!(Some(tissue.elasticity), expected);
    assert_eq!(tissue.prony[1].tau_s, 6.09.into());
    assert_eq!((inner.name.as_str(), inner.thickness_m), ("layer 2", 0.002));
    assert_eq!(
        inner.tissue.read().unwrap(),
        Tissue::builtin(BuiltinTissue::PigLiver)
    );
}

#[test]
fn inclusions_and_weight_are_understood() {
    let text = "format = 1\n[organ]\nbuiltin = \"liver\"\nbuiltin_tissue = \"pig-liver\"\n\
        [[organ.inclusion]]\nname = \"tumour\"\nball = { center_m = [0.01, 0, 0], radius_m = 0.005 }\n\
        builtin_tissue = \"pig-liver\"\n[[organ.inclusion]]\n\
        ellipsoid = { center_m = [0, 0.01, 0], radii_m = [0.01, 0.02, 0.03], turn_rad = [0.1, 0.2, 0.3] }\n\
        tissue = \"cyst.toml\"\n[[organ.inclusion]]\n\
        capsule = { from_m = [0, 0, 0], to_m = [0, 0, 0.1], radius_m = 0.002 }\ntissue = \"vessel.toml\"\n\
        [[organ.inclusion]]\nmesh = \"stone.stl\"\nmesh_unit = \"mm\"\ntissue = \"stone.toml\"\n\
        [model]\nkind = \"nonlinear\"\ngravity_m_per_s2 = [0, 0, -9.81]\n[[tool]]\nname = \"right\"\n";
    let scene = parse(text);
    assert_eq!(scene.model.gravity_m_per_s2, Some([0.0, 0.0, -9.81]));
    let [ball, ellipsoid, capsule, stone] = &scene.organ.inclusions[..] else {
        panic!("{:?}", scene.organ.inclusions)
    };
    assert_eq!(
        (ball.name.as_str(), ellipsoid.name.as_str()),
        ("tumour", "inclusion 2")
    );
    let shape = InclusionShape::Ball {
        center_m: [0.01, 0.0, 0.0],
        radius_m: 0.005,
    };
    assert_eq!(ball.place, InclusionPlace::Shape(shape));
    let shape = InclusionShape::Ellipsoid {
        center_m: [0.0, 0.01, 0.0],
        radii_m: [0.01, 0.02, 0.03],
        turn_rad: [0.1, 0.2, 0.3],
    };
    assert_eq!(ellipsoid.place, InclusionPlace::Shape(shape));
    let shape = InclusionShape::Capsule {
        from_m: [0.0; 3],
        to_m: [0.0, 0.0, 0.1],
        radius_m: 0.002,
    };
    assert_eq!(capsule.place, InclusionPlace::Shape(shape));
    let mesh = InclusionPlace::Mesh {
        path: PathBuf::from("scenes/stone.stl"),
        unit: Some(LengthUnit::Millimetre),
    };
    assert_eq!(stone.place, mesh);
    let tissue = PathBuf::from("scenes/vessel.toml");
    assert_eq!(capsule.tissue(), Some(&TissueChoice::File(tissue)));
}

#[test]
fn every_setting_of_the_model_is_understood() {
    let model = parse(SCENE).model;
    assert_eq!(model.kind, ModelKind::Hybrid);
    assert_eq!((model.step_s, model.force_scale), (0.004, 2.0));
    assert_eq!(model.hand_over, HandOver::Hold);
    assert_eq!(model.local.particles, 40);
    assert_eq!(model.local.form, Form::Strong);
    assert_eq!(model.local.placement, Placement::Source);
    assert_eq!(model.local.solver, Solver::Gmres);
    assert_eq!(model.local.integration_points, IntegrationPoints::Many);
    assert_eq!(model.local.calibration, Calibration::None);
    assert_eq!(model.enhancement.area, EnhancementArea::Vertex);
    assert_eq!(model.enhancement.levels, 2);
    assert_eq!(model.enhancement.smoothing, Smoothing::Shepard);
}

#[test]
fn every_key_of_the_tools_is_understood() {
    let tools = parse(SCENE).tools;
    assert_eq!(tools[0].name, "right");
    assert_eq!(tools[0].kind, ToolKind::Grasper);
    assert_eq!(tools[0].tip.shape, TipShape::Sphere);
    assert_eq!(tools[0].tip.radius_m, 0.002);
    assert_eq!(tools[0].tip.contact, TipContact::Slip);
    assert_eq!(tools[0].trocar_m, Some([0.0, -0.1, 0.2]));
    assert_eq!(tools[0].trocar_friction_n, 0.3);
    assert_eq!(tools[0].trocar_stiffness_n_per_m, 20.0);
    let jaws = Jaws {
        length_m: 0.02,
        width_m: 0.005,
        opening_m: 0.012,
        force_n: 3.0,
        friction: 0.3,
    };
    assert_eq!(tools[0].jaws, Some(jaws));
    assert_eq!(tools[0].device, DeviceKind::ForceDimension);
    let left = Tool {
        name: "left".to_owned(),
        ..Tool::default()
    };
    assert_eq!(tools[1], left);
}

#[test]
fn what_is_not_stated_has_its_default() {
    let text = "format = 1\n[organ]\nbuiltin = \"hemisphere\"\nbuiltin_tissue = \"pig-kidney\"\n";
    let scene = parse(text);
    assert_eq!(scene.organ.anchor, None);
    assert_eq!(scene.model, Model::default());
    assert_eq!(scene.model.kind, ModelKind::Local);
    assert_eq!(scene.model.step_s, 0.005);
    assert_eq!(scene.model.local.particles, 34);
    assert_eq!(scene.model.local.calibration, Calibration::Fitted);
    assert_eq!(
        scene.model.local.integration_points,
        IntegrationPoints::Standard
    );
    assert_eq!(scene.tools, [Tool::default()]);
    assert_eq!(scene.tools[0].tip.radius_m, 0.001);
    assert_eq!(scene.view, View::default());
    assert_eq!(scene.task, Task::default());
}

#[test]
fn a_tool_without_a_name_takes_the_free_hand() {
    let names = |tables: &str| {
        let organ = "[organ]\nbuiltin = \"cube\"\nbuiltin_tissue = \"pig-liver\"";
        let scene = parse(&format!("format = 1\n{organ}\n{tables}"));
        scene
            .tools
            .into_iter()
            .map(|tool| tool.name)
            .collect::<Vec<_>>()
    };
    assert_eq!(names("[[tool]]\n[[tool]]"), ["right", "left"]);
    assert_eq!(
        names("[[tool]]\nname = \"left\"\n[[tool]]"),
        ["left", "right"]
    );
}

#[test]
fn jaws_are_those_of_the_kind() {
    let jaws = |tool: &str| {
        let organ = "[organ]\nbuiltin = \"cube\"\nbuiltin_tissue = \"pig-liver\"";
        let scene = parse(&format!("format = 1\n{organ}\n[[tool]]\n{tool}"));
        scene.tools[0].jaws
    };
    assert_eq!(jaws("kind = \"probe\""), None);
    assert_eq!(jaws("kind = \"hook\""), None);
    assert_eq!(jaws("kind = \"grasper\""), Some(Jaws::GRASPER));
    assert_eq!(jaws("kind = \"scissors\""), Some(Jaws::SCISSORS));
    let wider = Jaws {
        opening_m: 0.015,
        ..Jaws::SCISSORS
    };
    let stated = "kind = \"scissors\"\njaws = { opening_mm = 15 }";
    assert_eq!(jaws(stated), Some(wider));
}

#[test]
fn an_anchor_holds_what_lies_in_its_regions() {
    let anchor = parse(SCENE).organ.anchor.unwrap();
    assert!(anchor.contains([0.5, 0.5, 0.0]), "behind the plane");
    assert!(anchor.contains([0.5, 0.5, 0.001]), "on the plane");
    assert!(!anchor.contains([0.5, 0.5, 0.0011]));
    assert!(anchor.contains([-0.5, 0.5, 0.5]), "in the box");
    assert!(anchor.contains([0.1, 0.0, 0.004]), "in the sphere");
    assert!(!anchor.contains([0.1, 0.0, 0.006]));
    assert!(!Region::default().contains([0.0; 3]) && Region::default().is_empty());
}

#[test]
fn the_hybrid_model_has_its_own_settings() {
    let text = SCENE.replace(
        "[organ.anchor]",
        "touchable = { planes = [{ point_m = [0, 0, 0], normal = [0, 0, -1] }] }\n[organ.anchor]",
    );
    let text = text.replace("[model]", "[model]\nmechanical_triangles = 2000");
    let scene = parse(&text);
    assert_eq!(scene.model.mechanical_triangles, Some(2000));
    assert_eq!(scene.model.response, ResponseMethod::Automatic);
    let chosen = text.replace("[model]", "[model]\nresponse = \"finite_elements\"");
    let response = parse(&chosen).model.response;
    assert_eq!(response, ResponseMethod::FiniteElements);
    let unknown = chosen.replace("finite_elements", "finite_element");
    let error = Scene::parse(&unknown, "scene.toml")
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("model.response") && error.contains("finite_elements"),
        "{error}"
    );
    let touchable = scene.organ.touchable.unwrap();
    assert!(touchable.contains([0.0, 0.0, 0.1]) && !touchable.contains([0.0, 0.0, -0.1]));
}

#[test]
fn the_hybrid_model_needs_something_that_is_held() {
    let text = SCENE.replace("[organ.anchor]", "[organ.unused]");
    assert!(Scene::parse(&text, "scene.toml").is_err());
    let from = SCENE.find("[organ.anchor]").unwrap();
    let to = SCENE.find("[[organ.layer]]").unwrap();
    let loose = SCENE.replace(&SCENE[from..to], "");
    let error = Scene::parse(&loose, "scene.toml").unwrap_err().to_string();
    assert!(error.contains("`organ.anchor` is missing"), "{error}");
    parse(&loose.replace("kind = \"hybrid\"", "kind = \"local\""));
    let builtin = "builtin = \"cube\"";
    let cube = loose.replace("mesh = \"kidney.stl\"\nmesh_unit = \"mm\"", builtin);
    assert_eq!(parse(&cube).organ.anchor, None);
}

#[test]
fn a_tissue_file_is_read_from_the_folder_of_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("tissue.toml"), crate::TISSUE).unwrap();
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let scene = Scene::read(folder.path().join("scene.toml")).unwrap();
    let tissue = scene.organ.tissue.read().unwrap();
    assert_eq!(tissue.name.as_deref(), Some("pig liver"));
}

/// The scenes and motions that come with the program.
#[test]
fn those_that_come_along_are_read() {
    let folder = PathBuf::from(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../assets/esophagus"
    ));
    let (mut scenes, mut motions) = (0, 0);
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            Scene::read(&path).unwrap();
            scenes += 1;
        } else {
            palpate_files::Motion::read(&path).unwrap();
            motions += 1;
        }
    }
    assert!(scenes >= 2 && motions >= 4, "{scenes} {motions}");
}

#[test]
fn a_scene_that_stands_alone_is_the_same_elsewhere() {
    let text = self_contained(SCENE, "scenes/deep/../scene.toml").unwrap();
    let here = Scene::parse(&text, "other/place/scene.toml").unwrap();
    let mut expected =
        Scene::parse(SCENE, std::path::absolute("scenes/scene.toml").unwrap()).unwrap();
    expected.folder = here.folder.clone();
    assert_eq!(here, expected);
    let refused = self_contained("[organ", "s.toml").unwrap_err().to_string();
    assert!(refused.starts_with("s.toml:"), "{refused}");
}

#[test]
fn goals_are_one_table_or_none() {
    let task = |more: &str| {
        let text = format!(
            "format = 1\n[organ]\nbuiltin = \"liver\"\nbuiltin_tissue = \"pig-liver\"\n{more}"
        );
        Scene::parse(&text, "s.toml").map(|scene| scene.task.goal)
    };
    assert_eq!(task("").unwrap(), Goal::Free);
    let cut = "[task.cut]\nfrom_m = [0, 0, 0]\nto_m = [0, 0, 0.03]\ntolerance_m = 0.002\n";
    assert_eq!(task(cut).unwrap().word(), "cut");
    let pull = "[task.traction]\nforce_n = 0.5\ntolerance_n = 0.1\nhold_s = 5\n";
    assert_eq!(task(pull).unwrap().word(), "traction");
    for (bad, expected) in [
        (format!("{cut}{pull}"), "task.traction"),
        (cut.replace("0.03", "0"), "another place"),
        (pull.replace("0.5", "-1"), "task.traction.force_n"),
    ] {
        let message = task(&bad).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    }
}

/// A line to cut is straight or a circle, which is closed, around its normal; half of one, both and neither are refused in
/// one sentence. Judge: the circle's distance from its centre, and the sense of its points.
#[test]
fn a_line_to_cut_is_straight_or_a_circle() {
    let line = |keys: &str| {
        let text = format!(
            "format = 1\n[organ]\nbuiltin = \"slab\"\nbuiltin_tissue = \"pig-liver\"\n[task.cut]\ntolerance_mm = 2\n{keys}"
        );
        let goal = Scene::parse(&text, "s.toml").map(|scene| scene.task.goal);
        goal.map(|goal| match goal {
            Goal::Cut { line, .. } => line,
            other => panic!("{other:?}"),
        })
    };
    let straight = "from_mm = [0, 0, 15]\nto_mm = [10, 0, 15]\n";
    let found = line(straight).unwrap();
    assert!(!found.is_closed());
    assert_eq!(found.points_m(), [[0.0, 0.0, 0.015], [0.01, 0.0, 0.015]]);
    let circle = "center_mm = [1, 2, 15]\nradius_mm = 14\nnormal = [0, 0, 3]\n";
    let found = line(circle).unwrap();
    assert!(found.is_closed());
    let mut turned = 0.0;
    for pair in found.points_m().windows(2) {
        let [a, b] = [pair[0], pair[1]].map(|p| [p[0] - 0.001, p[1] - 0.002]);
        assert!((a[0].hypot(a[1]) - 0.014).abs() < 1e-15 && pair[0][2] == 0.015);
        turned += (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
    }
    assert!((turned - std::f64::consts::TAU).abs() < 1e-12, "{turned}");
    for (bad, expected) in [
        (format!("{straight}{circle}"), "keep one of them"),
        (
            String::new(),
            "a straight line, by `from_m` and `to_m`, or a circle",
        ),
        (circle.replace("radius_mm = 14\n", ""), "task.cut.radius_m"),
        (
            circle.replace("normal = [0, 0, 3]\n", ""),
            "task.cut.normal",
        ),
        (circle.replace("3]", "0]"), "whose length is not 0"),
        (circle.replace("14", "0"), "task.cut.radius_m"),
        ("to_mm = [0, 0, 1]\n".to_owned(), "task.cut.from_m"),
    ] {
        let message = line(&bad).unwrap_err().to_string();
        assert!(
            message.contains(expected) && !message.contains('\n'),
            "{message}"
        );
    }
}

/// Each fault of a touch is refused by its key, with what to give instead.
#[test]
fn a_touch_names_tools_and_a_neighbour_that_are_there() {
    let goal = |more: &str| {
        let text = format!(
            "format = 1\n[organ]\nbuiltin = \"liver\"\nbuiltin_tissue = \"pig-liver\"\n{more}"
        );
        Scene::parse(&text, "s.toml").map(|scene| scene.task.goal)
    };
    let whole = "[[neighbour]]\nbuiltin = \"stomach\"\ncollides = true\n\
                 [[tool]]\nname = \"left\"\nkind = \"grasper\"\n[[tool]]\nname = \"right\"\n\
                 [task.touch]\ntool = \"right\"\nholder = \"left\"\ntarget_m = [0.05, 0.01, 0.05]\n\
                 tolerance_m = 0.004\nforce_n = 0.15\ntolerance_n = 0.1\nhold_s = 3\n\
                 injury_force_n = 0.5\ntear_force_n = 1.0\n";
    assert_eq!(goal(whole).unwrap().word(), "touch");
    for (from, to, expected) in [
        (
            "tool = \"right\"",
            "tool = \"rihgt\"",
            "`task.touch.tool` is \"rihgt\"; give a tool of the scene, \"left\" or \"right\"",
        ),
        ("tool = \"right\"\nholder", "holder", "task.touch.tool"),
        (
            "holder = \"left\"",
            "holder = \"right\"",
            "the other tool, a grasper",
        ),
        (
            "kind = \"grasper\"",
            "kind = \"probe\"",
            "the other tool, a grasper",
        ),
        ("holder = \"left\"\n", "", "`holder` that pulls"),
        (
            "collides = true",
            "collides = false",
            "`[[neighbour]]` with `collides = true`",
        ),
        (
            "injury_force_n = 0.5",
            "injury_force_n = 0.1",
            "a force above `force_n`",
        ),
        ("target_m = [0.05, 0.01, 0.05]\n", "", "task.touch.target_m"),
    ] {
        assert!(whole.contains(from), "{from}");
        let message = goal(&whole.replace(from, to)).unwrap_err().to_string();
        assert!(
            message.contains(expected) && !message.contains('\n'),
            "{message}"
        );
    }
    // The surface of a neighbour on which a place is drawn is there.
    let draw =
        "[draw.place]\non_surface = { min_m = [0, 0, 0], max_m = [1, 1, 1], neighbour = 2 }\n";
    let message = goal(&format!("{whole}{draw}")).unwrap_err().to_string();
    assert!(
        message.contains("draw.place.on_surface.neighbour") && message.contains("there are 1"),
        "{message}"
    );
}

/// `auto` takes what the tools need and says why; a stated kind says nothing.
#[test]
fn auto_chooses_and_says_why() {
    let chosen = |more: &str| {
        let text = format!("format = 1\nmodel = {{ kind = \"auto\" }}\n{more}");
        let scene = Scene::parse(&text, "scene.toml").unwrap();
        let said = scene
            .warnings
            .iter()
            .filter(|warning| warning.contains("auto"));
        assert_eq!(said.count(), 1, "{:?}", scene.warnings);
        scene.model.kind
    };
    let organ = "organ = { builtin = \"liver\", builtin_tissue = \"pig-liver\" }\n";
    let tool = |kind: &str| format!("{organ}[[tool]]\nname = \"right\"\nkind = \"{kind}\"\n");
    assert_eq!(chosen(&tool("probe")), ModelKind::Local);
    assert_eq!(chosen(&tool("grasper")), ModelKind::Nonlinear);
    assert_eq!(chosen(&tool("scissors")), ModelKind::Hybrid);
    assert_eq!(chosen(&tool("hook")), ModelKind::Hybrid);
    let cuts = format!("{}[cutting]\nmode = \"split\"\n", tool("grasper"));
    assert_eq!(chosen(&cuts), ModelKind::Hybrid);
    let loose = "organ = { mesh = \"a.stl\", builtin_tissue = \"pig-liver\" }\n\
                 [[tool]]\nname = \"right\"\nkind = \"grasper\"\n";
    assert_eq!(chosen(loose), ModelKind::Local);
    let stated = Scene::parse(&format!("format = 1\n{organ}"), "scene.toml").unwrap();
    assert_eq!(stated.model.reason, None);
    assert!(stated.warnings.is_empty());
}
