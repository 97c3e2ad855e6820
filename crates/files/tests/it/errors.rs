//! Every error names the place, the key, what was found, what is expected and the remedy.

use palpate_files::recording::{ExtraColumn, RecordingHeader, Samples};
use palpate_files::{
    BuiltinTissue, Error, Motion, Recording, Scene, Session, Tissue, write_atomically,
};

use crate::{MOTION, RECORDING, SCENE, SESSION};

const ORGAN: &str = "format = 1\n[organ]\nbuiltin = \"cube\"\nbuiltin_tissue = \"pig-liver\"\n";

fn scene(text: &str) -> String {
    refused(Scene::parse(text, "s.toml"))
}

fn organ_and(more: &str) -> String {
    scene(&format!("{ORGAN}{more}"))
}

/// A linear tissue with one of its lines replaced.
fn tissue(line: &str) -> String {
    let lines = [
        "law = \"linear\"",
        "youngs_modulus_pa = 1e4",
        "poissons_ratio = 0.45",
    ];
    let key = line.split(['=', '_']).next().unwrap_or("").trim();
    let kept = lines.iter().filter(|own| !own.starts_with(key));
    let body: Vec<_> = kept.copied().chain([line]).collect();
    let text = format!("format = 1\n[tissue]\n{}\n", body.join("\n"));
    refused(Tissue::parse(&text, "t.toml"))
}

fn motion(rows: &str) -> String {
    let text = format!("# format = 1\ntime_s,tool,x_m,y_m,z_m,qx,qy,qz,qw,grip,cut\n{rows}\n");
    refused(Motion::parse(&text, "m.csv"))
}

fn recording(text: &str) -> String {
    refused(Recording::parse(text, "r.csv"))
}

/// The message of a refusal, which is one sentence and the input's fault.
fn refused<T: std::fmt::Debug>(result: Result<T, Error>) -> String {
    let error = result.expect_err("this must be refused");
    let message = error.to_string();
    assert!(error.is_input(), "{message}");
    assert!(!message.contains('\n'), "{message}");
    message
}

#[test]
fn read_and_write() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("missing.toml");
    let message = refused(Scene::read(&path));
    assert!(
        message.starts_with(&path.display().to_string()),
        "{message}"
    );
    assert!(
        message.contains("cannot be read: No such file"),
        "{message}"
    );
    assert!(
        message.ends_with("check the name and that you may read it"),
        "{message}"
    );
    let message = refused(write_atomically(path.join("a"), b"x"));
    assert!(message.contains("cannot be written"), "{message}");
    let full = Error::Write {
        path,
        source: std::io::ErrorKind::StorageFull.into(),
    };
    assert!(!full.is_input(), "a full disk is a failure, not a mistake");
}

#[test]
fn not_text() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    std::fs::write(&path, b"# format = 1\ntime\xff").unwrap();
    let message = refused(Motion::read(&path));
    let end =
        "a.csv line 2: found bytes that are not UTF-8 text; save the file as plain UTF-8 text";
    assert!(message.ends_with(end), "{message}");
}

#[test]
fn syntax() {
    let message = scene("format = 1\n[organ\n");
    assert!(
        message.starts_with("s.toml line 2: this is not TOML: "),
        "{message}"
    );
    let message = recording("# format = 1\n# organ = liver\ntime_s,depth_m,force_n\n0,0,0\n");
    assert!(
        message.starts_with("r.csv line 2: this is not TOML: "),
        "{message}"
    );
    assert!(
        message.ends_with("write `key = value`, with text in double quotes"),
        "{message}"
    );
}

#[test]
fn format() {
    assert_eq!(
        scene("[organ]\nbuiltin = \"cube\"\n"),
        "s.toml: `format` is missing; add the line `format = 1` at the top"
    );
    assert_eq!(
        recording("time_s,depth_m,force_n\n0,0,0\n"),
        "r.csv: `format` is missing; add the line `# format = 1` at the top"
    );
    assert_eq!(
        scene("\nformat = 2\n"),
        "s.toml line 2: format is 2, but this version reads format 1; \
         set `format = 1` or use a newer version of palpate"
    );
    for text in [MOTION, SESSION, RECORDING] {
        let text = text.replace("format = 1", "format = \"1\"");
        let message = refused(Motion::parse(&text, "m.csv"));
        assert!(
            message.starts_with("m.csv line 1: format is \"1\""),
            "{message}"
        );
    }
}

#[test]
fn unknown_keys() {
    assert_eq!(
        scene(&SCENE.replace("[organ.anchor]", "[organ.ancor]")),
        "s.toml line 7: the key `organ.ancor` is not known here; \
         the nearest known key is `organ.anchor`, use it or remove the line"
    );
    // A misspelled key that must be there is unknown, not missing.
    assert_eq!(
        tissue("poisson_ratio = 0.45"),
        "t.toml line 5: the key `tissue.poisson_ratio` is not known here; \
         the nearest known key is `tissue.poissons_ratio`, use it or remove the line"
    );
    assert!(organ_and("[[tool]]\n[[tool]]\nnam = \"a\"").contains("line 7: the key `tool[1].nam`"));
    assert!(organ_and("[model]\nc10_pa = 1").contains("`model.c10_pa`"));
    // A parameter of another law has no meaning here.
    assert!(tissue("gamma_pa = 1").contains("`tissue.gamma_pa` is not known here"));
    assert!(
        recording("# format = 1\n# indenter_radus_m = 1\ntime_s,depth_m,force_n\n")
            .contains("line 2: the key `indenter_radus_m` is not known here; the nearest known key is `indenter_radius_m`")
    );
    let message = refused(Motion::parse(&MOTION.replace("grip", "gripp"), "m.csv"));
    assert!(
        message.contains("`gripp`") && message.contains("`grip`"),
        "{message}"
    );
}

#[test]
fn unknown_units() {
    assert_eq!(
        tissue("youngs_modulus_psi = 1"),
        "t.toml line 5: the unit of `tissue.youngs_modulus_psi` is not known here; \
         use `youngs_modulus_pa`, `youngs_modulus_kpa`, `youngs_modulus_mpa`, \
         `youngs_modulus_gpa` or `youngs_modulus_mmhg`"
    );
    assert_eq!(
        recording("# format = 1\ntime_s,depth_inch,force_n\n0,0,0\n"),
        "r.csv line 2: the unit of `depth_inch` is not known here; \
         use `depth_m`, `depth_cm`, `depth_mm`, `depth_um` or `depth_nm`"
    );
    assert!(organ_and("[model]\nstep = 0.005").contains("the unit of `model.step`"));
    assert!(
        recording("# format = 1\n# indenter_radius = 1\ntime_s,depth_m,force_n\n")
            .contains("the unit of `indenter_radius`")
    );
}

#[test]
fn given_twice() {
    assert_eq!(
        organ_and("[model]\nstep_s = 0.005\nstep_ms = 5"),
        "s.toml line 7: `model.step_s` is given although `model.step_ms` is given too; \
         keep one of them"
    );
    assert!(recording("# format = 1\ntime_s,depth_m,depth_mm,force_n\n").contains("given too"));
    assert!(organ_and("mesh = \"a.stl\"").contains("`organ.builtin` is given although"));
    assert!(organ_and("tissue = \"a.toml\"").contains("`organ.builtin_tissue` is given although"));
    let twice = "# format = 1\n# repeat = 1\n# repeat = 2\ntime_s,depth_m,force_n\n";
    assert!(recording(twice).contains("r.csv line 3: `repeat` is given although"));
}

#[test]
fn missing_keys() {
    assert_eq!(
        scene("format = 1\n"),
        "s.toml: `organ` is missing; give a table `[organ]`"
    );
    let text = "format = 1\n[tissue]\nlaw = \"neo_hookean\"\n";
    assert_eq!(
        refused(Tissue::parse(text, "t.toml")),
        "t.toml line 2: `tissue.c10_pa` is missing; give a modulus of tissue from 0.001 Pa to 100 GPa"
    );
    assert!(scene("format = 1\n[organ]\nbuiltin = \"cube\"").contains("`organ.tissue` is missing"));
    let no_seed = SESSION.replace("# seed = 7\n", "");
    let message = refused(Session::parse(&no_seed, "x.csv"));
    assert_eq!(message, "x.csv: `seed` is missing; give a whole number");
}

#[test]
fn bad_values_of_a_tissue() {
    assert_eq!(
        tissue("poissons_ratio = 0.5"),
        "t.toml line 5: `tissue.poissons_ratio` is 0.5; give a number above -1 and below 0.5 \
         (0.5 itself belongs to the incompressible laws, such as neo_hookean; 0.49 is near enough for most tissues)"
    );
    assert_eq!(
        tissue("youngs_modulus_kpa = -10"),
        "t.toml line 5: `tissue.youngs_modulus_kpa` is -10; give a modulus of tissue from 0.001 Pa to 100 GPa"
    );
    assert!(tissue("youngs_modulus_pa = nan").contains("is nan; give a modulus of tissue"));
    assert!(tissue("youngs_modulus_pa = inf").contains("is inf; give"));
    assert!(tissue("youngs_modulus_pa = 1e999").contains("is 1e999; give"));
    assert!(tissue("youngs_modulus_pa = \"10\"").contains("is \"10\"; give a modulus"));
    assert!(tissue("law = \"hookean\"").contains(
        "`tissue.law` is \"hookean\"; give \"linear\", \"neo_hookean\", \"mooney_rivlin\", \"exponential\", \
         \"ogden\", \"reduced_polynomial\" or \"holzapfel_gasser_ogden\""
    ));
    assert!(tissue("prony = [{ g = 0.5, tau_s = 1 }, { g = 0.5, tau_s = 2 }]").contains(
        "`tissue.prony` is a series whose g add up to 1; give terms whose g add up to less than 1"
    ));
    assert!(tissue("prony = [{ g = -0.1, tau_s = 1 }]").contains("`tissue.prony[0].g` is -0.1"));
    assert!(tissue("prony = [{ g = 0.1, tau_s = 0 }]").contains("`tissue.prony[0].tau_s` is 0;"));
    assert!(tissue("prony = 3").contains("`tissue.prony` is 3; give a list of tables"));
    let text = "format = 1\n[tissue]\nlaw = \"mooney_rivlin\"\nc10_pa = 1\nc01_pa = -1\n";
    assert!(refused(Tissue::parse(text, "t.toml")).contains("`tissue.c10_pa + c01_pa` is 0;"));
}

/// What stands below the organ of a scene, and what must be said of it.
const BAD_SCENES: &[(&str, &str)] = &[
    (
        "[model]\nstep_s = 0",
        "`model.step_s` is 0; give a period from 10 us to 1 s",
    ),
    (
        "[model]\nparticles = 7",
        "`model.particles` is 7; give a whole number from 12 to 600",
    ),
    ("[model]\nparticles = 34.5", "is 34.5; give a whole number"),
    (
        "[model]\nkind = \"global\"",
        "is \"global\"; give \"local\", \"hybrid\", \"nonlinear\" or \"auto\"",
    ),
    (
        "[model]\nintegration_points = 400",
        "is 400; give 130, 415 or 957",
    ),
    (
        "[model]\nassembly = \"reused\"\nplacement = \"source\"",
        "`model.assembly` is \"reused\"",
    ),
    ("[model]\nforce_scale = -1", "`model.force_scale` is -1"),
    (
        "[model]\nenhancement = \"edge\"",
        "`model.enhancement` is \"edge\"; give a table",
    ),
    (
        "[[tool]]\ntip = { shape = \"flat\", radius_m = 0 }",
        "`tool[0].tip.radius_m` is 0",
    ),
    (
        "[[tool]]\ntip = { shape = \"flat\" }",
        "`tool[0].tip.radius_m` is missing",
    ),
    (
        "[[tool]]\ntip = { shape = \"flat\", radius_mm = 1, contact = \"slip\", friction = 0.3 }",
        "`tool[0].tip.friction` is 0.3; give no friction of a tip that slips",
    ),
    (
        "[[tool]]\ntip = { shape = \"flat\", radius_mm = 1, friction = -1 }",
        "`tool[0].tip.friction` is -1; give a coefficient of friction from 0 to 100",
    ),
    (
        "[[tool]]\ntrocar_m = [0, 1]",
        "`tool[0].trocar_m` is [0, 1]; give a list of three",
    ),
    (
        "[[tool]]\njaws = { length_m = 0.01 }",
        "`tool[0].jaws` is a table; give no jaws to a tool that has none",
    ),
    (
        "[[tool]]\nkind = \"scissors\"\njaws = { friction = 0.4 }",
        "the key `tool[0].jaws.friction`",
    ),
    (
        "[[tool]]\nkind = \"grasper\"\njaws = { opening_m = 0 }",
        "`tool[0].jaws.opening_m` is 0; give a length from 1 nm",
    ),
    (
        "[[tool]]\ntrocar_friction_n = 0.2",
        "`tool[0].trocar_friction_n` is 0.2; give `trocar_m` too",
    ),
    (
        "[[tool]]\ntrocar_m = [0, 0, 1]\ntrocar_stiffness_n_per_m = -1",
        "`tool[0].trocar_stiffness_n_per_m` is -1; give a stiffness from 0 to",
    ),
    (
        "[[tool]]\n[[tool]]\n[[tool]]\n",
        "`tool` is a list of 3 tools; give at most two",
    ),
    (
        "[[tool]]\nname = \"a\"\n[[tool]]\nname = \"a\"",
        "line 8: `tool[1].name` is \"a\"",
    ),
    (
        "[[tool]]\nname = \" \"",
        "`tool[0].name` is \" \"; give a text",
    ),
    (
        "triangles = 3",
        "`organ.triangles` is 3; give a whole number from 4",
    ),
    (
        "mesh_unit = \"m\"",
        "`organ.mesh_unit` is \"m\"; give no unit",
    ),
    (
        "[organ.anchor]\nspheres = [{ center_m = [0, 0, 0], radius_m = -1 }]",
        "spheres[0].radius_m` is -1",
    ),
    (
        "[organ.anchor]\nboxes = [{ min_m = [0, 0, 0], max_m = [1, -1, 1] }]",
        "boxes[0].max_m` is",
    ),
    (
        "[organ.anchor]\nplanes = [{ point_m = [0, 0, 0], normal = [0, 0, 0] }]",
        "`organ.anchor.planes[0].normal` is [0, 0, 0]; give a direction",
    ),
    (
        "[organ.anchor]\nplanes = [{ point_m = [0, 0, nan], normal = [0, 0, 1] }]",
        "point_m[2]` is nan",
    ),
    (
        "[[organ.layer]]\nthickness_m = 0\nbuiltin_tissue = \"pig-liver\"",
        "`organ.layer[0].thickness_m` is 0",
    ),
    (
        "[view]\nfield_of_view_deg = 180",
        "`view.field_of_view_deg` is 180",
    ),
    ("[task]\ntime_limit_s = 0", "`task.time_limit_s` is 0"),
];

#[test]
fn bad_values_of_a_scene() {
    for (more, expected) in BAD_SCENES {
        let message = organ_and(more);
        assert!(message.contains(expected), "{more}\n{message}");
        assert!(message.starts_with("s.toml line "), "{message}");
    }
}

#[test]
fn bad_rows_of_a_motion() {
    assert_eq!(
        motion("0,a,0,0,0,0,0,0,1,0,0\n\n# pause\n0.1,a,0,0,x,0,0,0,1,0,0"),
        "m.csv line 6: `z_m` is \"x\"; give a coordinate of at most 10000 m in size"
    );
    assert_eq!(
        motion("0,a,0,0,0,0,0,0,1,0"),
        "m.csv line 3: found 10 fields; give 11 fields, one for each column"
    );
    assert_eq!(
        motion("0.2,a,0,0,0,0,0,0,1,0,0\n0.1,b,0,0,0,0,0,0,1,0,0\n0.1,a,0,0,0,0,0,0,1,0,0"),
        "m.csv line 5: `time_s` is 0.1 after 0.2 s; \
         sort the rows so that the time grows from each to the next"
    );
    assert!(motion("0,a,0,0,0,0,0,0,0,0,0").contains("give a quaternion (qx, qy, qz, qw)"));
    assert!(
        motion("0,a,0,0,0,0,0,0,1,1.5,0").contains("`grip` is \"1.5\"; give a number from 0 to 1")
    );
    assert!(motion("0,a,0,0,0,0,0,0,1,0,2").contains("`cut` is \"2\"; give 0 or 1"));
    assert!(motion("0,,0,0,0,0,0,0,1,0,0").contains("`tool` is \"\"; give the name of a tool"));
    assert!(motion("nan,a,0,0,0,0,0,0,1,0,0").contains("`time_s` is \"nan\""));
    let three = ["a", "b", "c"].map(|tool| format!("0,{tool},0,0,0,0,0,0,1,0,0"));
    assert!(motion(&three.join("\n")).contains("line 5: `tool` is \"c\"; give one of the two"));
    assert_eq!(
        motion(""),
        "m.csv: found no rows below the names of the columns; add at least one"
    );
}

#[test]
fn missing_columns() {
    assert_eq!(
        recording("# format = 1\n\ntime_s,depth_m,load\n0,0,0\n"),
        "r.csv line 3: the column `force_n` is missing among `time_s`, `depth_m`, `load`; \
         add it or correct its name"
    );
    let text = MOTION.replace("qx,qy,qz,qw", "qx,qy,qz,other");
    assert!(refused(Motion::parse(&text, "m.csv")).contains("the column `qw` is missing"));
    assert!(
        recording("# format = 1\n")
            .contains("line 2: found the end of the file; give a line with the names")
    );
}

#[test]
fn bad_rows_of_a_recording() {
    let rows = |rows: &str| recording(&format!("# format = 1\ntime_s,depth_m,force_mn\n{rows}"));
    assert_eq!(
        rows("0,0,NaN\n"),
        "r.csv line 3: `force_mn` is \"NaN\"; give a force of at most 1000000 kN in size"
    );
    assert!(rows("0,0,0\n0,1,1\n").contains("line 4: `time_s` is 0 after 0 s"));
    assert!(rows("0,0\n").contains("line 3: found 2 fields; give 3 fields"));
    assert!(rows("").contains("found no rows"));
    let header = |line: &str| {
        recording(&format!(
            "# format = 1\n# {line}\ntime_s,depth_m,force_n\n0,0,0\n"
        ))
    };
    assert!(
        header("condition = \"alive\"").contains("give \"in_vivo\", \"ex_vivo\" or \"in_vitro\"")
    );
    assert!(header("indenter_radius_mm = 0").contains("line 2: `indenter_radius_mm` is 0; give"));
    assert!(header("breath_held = 1").contains("is 1; give true or false"));
    let wall = "inner_radius_m = 0.01\n# outer_radius_m = 0.01";
    assert!(header(wall).contains("line 3: `outer_radius_m` is 0.01; give a radius above"));
}

#[test]
fn bad_rows_of_a_session() {
    let text = SESSION.replace("contact;cut", "contact;sneeze");
    let message = refused(Session::parse(&text, "x.csv"));
    assert!(message.contains("x.csv line 11: `event` is \"contact;sneeze\"; give events such as"));
    let text = SESSION.replace("0.005,right", "0,right");
    assert!(refused(Session::parse(&text, "x.csv")).contains("line 11: `time_s` is 0 after 0 s"));
}

#[test]
fn contents_that_no_file_can_hold() {
    let failed = |result: Result<(), Error>| {
        let error = result.expect_err("this must be refused");
        assert!(!error.is_input(), "{error}");
        error.to_string()
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a");
    let mut tissue = Tissue::builtin(BuiltinTissue::PigLiver);
    tissue.prony[0].g.value = f64::NAN;
    assert_eq!(
        failed(tissue.write(&path)),
        "`tissue.prony[0].g` is nan; give a number from 0 to below 1"
    );
    let samples = |time_s: &[f64]| Samples {
        time_s: time_s.to_vec(),
        depth_m: vec![0.0; time_s.len()],
        force_n: vec![0.0; 2],
    };
    let new = |times: &[f64]| {
        failed(Recording::new(RecordingHeader::default(), samples(times)).map(drop))
    };
    assert_eq!(
        new(&[0.0, 0.0]),
        "time_s of sample 1 is 0; give a time after that of the sample before"
    );
    assert_eq!(
        new(&[0.0]),
        "force_n is 2 numbers for 1 times; give one for each time"
    );
    assert_eq!(new(&[]), "a recording is empty; give at least one sample");
    let mut recording = Recording::new(RecordingHeader::default(), samples(&[0.0, 1.0])).unwrap();
    let taken = ExtraColumn {
        name: "force_mn".to_owned(),
        values: vec!["0".to_owned(); 2],
    };
    assert!(recording.clone().with_extra_column(taken).is_err());
    recording.header.indenter_radius_m = Some(0.0);
    assert_eq!(
        failed(recording.write(&path)),
        "`indenter_radius_m` is 0.0; give the radius of a tip from 1 nm to 100 mm"
    );
    assert!(!path.exists());
}
