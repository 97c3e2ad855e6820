//! Every command that writes, killed at random moments and on a disk of random size. Judges: the files before, and those
//! of a run that nothing disturbed. Afterwards each file is the old one, the new one, or says that it is incomplete; the
//! training record holds every attempt that was acknowledged.
//!
//! A disk of random size is a bound on the size of a file (`ulimit -f`), which needs no rights and no mount: a write
//! beyond it fails as on a full disk where SIGXFSZ is ignored (`trap '' XFSZ`), and kills the program where it is not.
//! Half of the kills wait until the first file changes, for most of a command's time goes before its first write.

mod record;
mod write_path;

use std::fs;

use tempfile::TempDir;

use crate::palpate_in;
use write_path::{WritePath, done};

const SCENE: &str = "format = 1\n[organ]\nbuiltin = \"hemisphere\"\ntriangles = 400\n\
     [organ.tissue]\nlaw = \"linear\"\nyoungs_modulus_pa = 10000.0\npoissons_ratio = 0.45\n\
     [[tool]]\nname = \"right\"\ntip = { shape = \"flat\", radius_m = 0.001, contact = \"slip\" }\n\
     [task]\ntitle = \"Press\"\n";

/// Through the pole, so many millimetres deep at 1 s, and out again.
fn motion(depth: u32) -> String {
    format!(
        "# format = 1\ntime_s,tool,x_m,y_m,z_m\n0.0,right,0.0,0.0,0.051\n1.0,right,0.0,0.0,{}\n\
         4.0,right,0.0,0.0,0.051\n",
        0.05 - 1e-3 * f64::from(depth)
    )
}

fn protocol(depth: u32) -> String {
    format!(
        "format = 1\n[rig]\nrecovery_s = 1\n[[specimen]]\npublished = \"liver\"\n[[stimulus]]\n\
         kind = \"ramp_and_hold\"\ndepth_m = {}\nramp_s = 0.5\nhold_s = 10\n",
        1e-3 * f64::from(depth)
    )
}

/// A label map of 12³ voxels of 2 mm: a ball of so many millimetres.
fn labels(radius: f64) -> Vec<u8> {
    let mut bytes =
        b"NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 12 12 12\n\
        space directions: (2,0,0) (0,2,0) (0,0,2)\nspace origin: (0,0,0)\nencoding: raw\n\
        Segment0_LabelValue:=5\nSegment0_Name:=liver\n\n"
            .to_vec();
    bytes.extend((0..12_i32.pow(3)).map(|voxel| {
        let places = [voxel % 12, voxel / 12 % 12, voxel / 144];
        let away = places.map(|place| 2.0 * f64::from(place) - 11.0);
        5 * u8::from(away.iter().map(|a| a * a).sum::<f64>().sqrt() < radius)
    }));
    bytes
}

fn with(files: &[(&str, &[u8])]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).unwrap();
    }
    folder
}

/// A session is replaced by another of the same folder.
fn a_session() -> WritePath {
    let line = "simulate scene.toml --headless --motion motion.csv --out out --overwrite";
    let folder = with(&[
        ("scene.toml", SCENE.as_bytes()),
        ("motion.csv", motion(2).as_bytes()),
    ]);
    done(&palpate_in(folder.path(), &words(line)));
    fs::write(folder.path().join("motion.csv"), motion(3)).unwrap();
    let other = SCENE.replace("Press", "Press harder");
    fs::write(folder.path().join("scene.toml"), other).unwrap();
    WritePath::new("simulate", &folder, line)
}

/// Pictures of a session; none where nothing can draw.
fn pictures() -> Option<WritePath> {
    let folder = with(&[
        ("scene.toml", SCENE.as_bytes()),
        ("motion.csv", motion(2).as_bytes()),
    ]);
    let line = "simulate scene.toml --headless --motion motion.csv --out session";
    done(&palpate_in(folder.path(), &words(line)));
    let line = "replay session --frames 3 --out pictures --overwrite";
    let output = palpate_in(folder.path(), &words(line));
    if String::from_utf8_lossy(&output.stderr).contains("no graphics adapter") {
        return None;
    }
    done(&output);
    let other =
        words("simulate scene.toml --headless --motion motion.csv --out session --overwrite");
    fs::write(folder.path().join("motion.csv"), motion(8)).unwrap();
    done(&palpate_in(folder.path(), &other));
    Some(WritePath::new("replay --frames", &folder, line))
}

fn a_recording() -> WritePath {
    let line = "measure protocol.toml --headless --out one.csv --overwrite";
    let folder = with(&[("protocol.toml", protocol(2).as_bytes())]);
    done(&palpate_in(folder.path(), &words(line)));
    fs::write(folder.path().join("protocol.toml"), protocol(3)).unwrap();
    WritePath::new("measure", &folder, line)
}

fn a_surface() -> WritePath {
    let line = "mesh isosurface labels.nrrd --label all --out organs --overwrite";
    let folder = with(&[("labels.nrrd", &labels(8.0))]);
    done(&palpate_in(folder.path(), &words(line)));
    fs::write(folder.path().join("labels.nrrd"), labels(7.0)).unwrap();
    WritePath::new("mesh isosurface", &folder, line)
}

fn a_tissue() -> WritePath {
    let folder = with(&[("protocol.toml", protocol(2).as_bytes())]);
    let at = |name: &str| folder.path().join(name);
    let measure = words("measure protocol.toml --headless --out one.csv");
    done(&palpate_in(folder.path(), &measure));
    // The lumped law alone, for this is about files.
    let line = "characterize one.csv --law neo_hookean --terms 1 --draws 0 --out tissue.toml --abaqus card.inp --febio card.feb \
                --report page.html --overwrite";
    done(&palpate_in(folder.path(), &words(line)));
    fs::remove_file(at("one.csv")).unwrap();
    fs::write(at("protocol.toml"), protocol(3)).unwrap();
    done(&palpate_in(folder.path(), &measure));
    WritePath::new("characterize", &folder, line)
}

fn a_response() -> WritePath {
    let scene = SCENE.replace(
        "[[tool]]",
        "[model]\nkind = \"hybrid\"\nresponse = \"boundary_elements\"\nmechanical_triangles = 200\n[[tool]]",
    );
    let folder = with(&[("scene.toml", scene.as_bytes())]);
    WritePath::new("precompute", &folder, "precompute scene.toml")
}

fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

/// Judge: the files before and those of an undisturbed run; of the record what was acknowledged.
#[test]
#[ignore = "long"]
fn what_is_killed_or_has_no_room_loses_nothing() {
    for path in [a_session(), a_recording(), a_surface(), a_response()] {
        println!("{}", path.crash(3, 2, 7));
    }
    println!("{}", record::crash(3, 2));
}

/// Judge: the files before and those of an undisturbed run. Quick form:
/// `what_is_killed_or_has_no_room_loses_nothing`.
#[test]
#[ignore = "slow: 200 kills and 60 full disks of a simulation"]
fn a_session_that_is_killed_200_times_is_old_or_new() {
    println!("{}", a_session().crash(200, 60, 7));
}

/// Judge: the files before and those of an undisturbed run. Quick form:
/// `what_is_killed_or_has_no_room_loses_nothing`.
#[test]
#[ignore = "slow: 200 kills and 60 full disks of a measurement"]
fn a_recording_that_is_killed_200_times_is_old_or_new() {
    println!("{}", a_recording().crash(200, 60, 7));
}

/// Judge: the files before and those of an undisturbed run. Quick form:
/// `what_is_killed_or_has_no_room_loses_nothing`.
#[test]
#[ignore = "slow: 200 kills and 60 full disks of a surface from a label map"]
fn a_surface_that_is_killed_200_times_is_old_or_new() {
    println!("{}", a_surface().crash(200, 60, 7));
}

/// Judge: the files before and those of an undisturbed run. Quick form:
/// `what_is_killed_or_has_no_room_loses_nothing`.
#[test]
#[ignore = "slow: 200 kills and 60 full disks of a preparation"]
fn a_response_that_is_killed_200_times_is_old_or_new() {
    println!("{}", a_response().crash(200, 60, 7));
}

/// Judge: what was acknowledged. Quick form:
/// `what_is_killed_or_has_no_room_loses_nothing`.
#[test]
#[ignore = "slow: 200 kills and 60 full disks of a scoring into a record"]
fn a_record_that_is_killed_200_times_keeps_what_it_acknowledged() {
    println!("{}", record::crash(200, 60));
}

/// Judge: the files before and those of an undisturbed run. Quick form: `what_is_killed_or_has_no_room_loses_nothing`,
/// of the other commands, whose files are written by the same function.
#[test]
#[ignore = "slow: 200 kills and 60 full disks of a characterization"]
fn a_tissue_that_is_killed_200_times_is_old_or_new() {
    println!("{}", a_tissue().crash(200, 60, 7));
}

/// Judge: the files before and those of an undisturbed run; nothing where no picture can be drawn. Quick form:
/// `what_is_killed_or_has_no_room_loses_nothing`, of the other commands, whose files are written by the same function.
#[test]
#[ignore = "slow: the first 100 of 200 kills and 30 of 60 full disks of three pictures"]
fn pictures_that_are_killed_100_times_are_old_or_new() {
    crash_pictures(7);
}

/// Judge: as for `pictures_that_are_killed_100_times_are_old_or_new`.
#[test]
#[ignore = "slow: the other 100 of 200 kills and 30 of 60 full disks of three pictures"]
fn pictures_that_are_killed_another_100_times_are_old_or_new() {
    crash_pictures(8);
}

fn crash_pictures(seed: u64) {
    match pictures() {
        Some(path) => println!("{}", path.crash(100, 30, seed)),
        None => println!("passed over: no graphics adapter"),
    }
}
