//! Names that hold what a terminal obeys, a browser runs or a spreadsheet computes, in every kind of document, through
//! every command. Judges: no printed character is hidden, readers of XML and JSON, and the names read back.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use palpate_files::{Session, is_hidden};
use tempfile::TempDir;

use crate::recordings::recording;
use crate::report::parse;
use crate::{json, palpate_in, stderr, stdout};

/// Sets the title of a terminal, clears it (in two ways), turns the direction of writing, and begins a line.
const HOSTILE: &str = "=HYPERLINK(\"x\")\u{1b}]0;pwned\u{7}\u{1b}[2J\u{9b}2J\u{7f}\u{202e}\u{200b}<script>alert(1)</script>";

/// The name of a file on a disk.
const FILE: &str = "scene\u{1b}]0;pwned\u{7}\u{9b}2J\u{202e}";

/// `text` in TOML.
fn quoted(text: &str) -> String {
    let letters = text.chars().map(|letter| match letter {
        '"' => "\\\"".to_owned(),
        letter if is_hidden(letter) => format!("\\U{:08X}", u32::from(letter)),
        letter => letter.to_string(),
    });
    format!("\"{}\"", letters.collect::<String>())
}

fn is_printable(text: &str) -> bool {
    !text
        .chars()
        .any(|letter| letter != '\n' && is_hidden(letter))
}

/// What was printed is printable; the exit status is one of those that are expected.
fn printed(output: &Output, status: i32) -> String {
    let both = [stdout(output), stderr(output)].concat();
    assert_eq!(output.status.code(), Some(status), "{both:?}");
    assert!(is_printable(&both), "{both:?}");
    both
}

/// Scene, motion and recordings with hostile names.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let name = quoted(HOSTILE);
    let scene = format!(
        "format = 1\n[organ]\nbuiltin = \"hemisphere\"\n[organ.tissue]\nlaw = \"linear\"\n\
         youngs_modulus_pa = 10000.0\npoissons_ratio = 0.45\n[[tool]]\nname = {name}\n\
         tip = {{ shape = \"flat\", radius_m = 0.001, contact = \"slip\" }}\n[task]\ntitle = {name}\n"
    );
    fs::write(at(&format!("{FILE}.toml")), scene).unwrap();
    let tool = format!("\"{}\"", HOSTILE.replace('"', "\"\""));
    fs::write(
        at("motion.csv"),
        format!(
            "# format = 1\ntime_s,tool,x_m,y_m,z_m\n0.0,{tool},0,0,0.051\n0.2,{tool},0,0,0.047\n"
        ),
    )
    .unwrap();
    let keys = format!(
        "# organ = {name}\n# subject = {name}\n# indenter_shape = \"flat\"\n# indenter_radius_m = 0.001\n"
    );
    fs::create_dir(at("recordings")).unwrap();
    for depth in [1, 2] {
        let text = recording(1e-3 * f64::from(depth), 8.0, &keys);
        fs::write(at(&format!("recordings/{FILE}{depth}.csv")), text).unwrap();
    }
    folder
}

fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    paths
        .filter(|path| path.extension().is_some_and(|own| own == ending))
        .collect()
}

/// A page that a reader of XML reads, in which names are text.
fn assert_harmless_page(path: &Path) {
    let page = fs::read_to_string(path).unwrap();
    assert!(is_printable(&page), "{}", path.display());
    assert!(!page.contains("<script"), "{}", path.display());
    assert!(page.contains("pwned"), "{}", path.display());
    parse(&page);
}

/// No cell is a formula, whatever else it is.
fn assert_no_formula(path: &Path) {
    let text = fs::read_to_string(path).unwrap();
    assert!(text.contains("'=HYPERLINK"), "{text}");
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .has_headers(false)
        .flexible(true)
        .from_reader(text.as_bytes());
    for cell in reader.records().flat_map(|row| {
        let row = row.unwrap();
        row.iter().map(str::to_owned).collect::<Vec<_>>()
    }) {
        let begins = cell.starts_with(['=', '+', '-', '@', '\t', '\r']);
        assert!(!begins || cell.parse::<f64>().is_ok(), "{cell:?}");
    }
}

#[test]
fn a_simulated_scene_prints_no_escape_and_gives_its_names_back() {
    let folder = folder();
    let run = |arguments: &[&str]| palpate_in(folder.path(), arguments);
    let scene = format!("{FILE}.toml");
    let out = format!("out{FILE}");
    let simulate = |more: &[&str]| {
        let begin = ["simulate", &scene, "--headless", "--motion", "motion.csv"];
        run(&[&begin[..], &["--out", &out], more].concat())
    };
    printed(&simulate(&[]), 0);
    let again = printed(&simulate(&[]), 2);
    assert!(
        again.contains("pwned") && again.contains(r"\u{1b}"),
        "{again}"
    );
    let answer = simulate(&["--json", "--overwrite"]);
    printed(&answer, 0);
    json(&answer);
    let session = Session::read(folder.path().join(&out).join("session.csv")).unwrap();
    assert_eq!(session.tools, [HOSTILE]);
    assert_no_formula(&folder.path().join(&out).join("session.csv"));
    printed(&run(&["replay", &out, "--json"]), 0);
    let score = ["score", &out, "--trainee", HOSTILE, "--record", "r.sqlite"];
    printed(&run(&score), 0);
    printed(&run(&[&score[..], &["--json"]].concat()), 0);
    let progress = ["progress", "--record", "r.sqlite"];
    printed(&run(&progress), 0);
    let written = ["--csv", "p.csv", "--report", "p.html"];
    printed(&run(&[&progress[..], &written].concat()), 0);
    assert_no_formula(&folder.path().join("p.csv"));
    assert_harmless_page(&folder.path().join("p.html"));
    // A tool that the scene does not have, and a key that no scene has.
    fs::write(
        folder.path().join("motion.csv"),
        "# format = 1\ntime_s,tool,x_m,y_m,z_m\n0,\u{1b}[2J,0,0,0\n",
    )
    .unwrap();
    printed(&simulate(&["--overwrite"]), 2);
    let key = format!("format = 1\n{} = 1\n", quoted(HOSTILE));
    for (command, file) in [
        ("simulate", "key.toml"),
        ("solve", "key.toml"),
        ("measure", "key.toml"),
    ] {
        fs::write(folder.path().join(file), &key).unwrap();
        printed(
            &run(&[command, file, "--headless"][..if command == "solve" { 2 } else { 3 }]),
            2,
        );
    }
    printed(&run(&["precompute", "\u{1b}[2J.toml"]), 2);
}

#[test]
fn recordings_of_hostile_names_make_harmless_pages_and_tables() {
    let folder = folder();
    let run = |arguments: &[&str]| palpate_in(folder.path(), arguments);
    for json_too in [&[][..], &["--json"]] {
        let analyze = ["analyze", "recordings", "--report", "a.html", "--overwrite"];
        printed(&run(&[&analyze[..], json_too].concat()), 0);
    }
    assert_harmless_page(&folder.path().join("a.html"));
    let study = ["--law", "neo_hookean", "--draws", "0", "--study", "kept"];
    let outputs = ["--report", "c.html", "--out", "t.toml", "--febio", "t.feb"];
    let all = [&["characterize", "recordings"], &study[..], &outputs].concat();
    printed(&run(&all), 0);
    assert_harmless_page(&folder.path().join("c.html"));
    assert_no_formula(&folder.path().join("kept/summary.csv"));
    for card in files(folder.path(), "feb") {
        roxmltree::Document::parse(&fs::read_to_string(card).unwrap()).unwrap();
    }
}

#[test]
fn meshes_labels_and_arguments_of_hostile_names_print_no_escape() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| palpate_in(folder.path(), arguments);
    let map = format!("{FILE}.nrrd");
    let mut bytes = format!(
        "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 4 4\n\
         space directions: (2,0,0) (0,2,0) (0,0,2)\nspace origin: (0,0,0)\nencoding: raw\n\
         Segment0_LabelValue:=1\nSegment0_Name:={HOSTILE}\nSegment1_LabelValue:=3\n\
         Segment1_Name:=liver\nSegment2_LabelValue:=4\nSegment2_Name:=liver\n\n"
    )
    .into_bytes();
    bytes.extend((0..64).map(|voxel| [0, 1, 3, 4][voxel % 4]));
    fs::write(folder.path().join(&map), bytes).unwrap();
    let isosurface = |more: &[&str]| run(&[&["mesh", "isosurface", &map], more].concat());
    let listed = printed(&isosurface(&[]), 0);
    assert!(listed.contains("pwned"), "{listed}");
    printed(&isosurface(&["--json"]), 0);
    printed(&isosurface(&["--label", "\u{1b}[2J", "--out", "x.ply"]), 2);
    // Two labels have the name: neither is taken.
    let twice = printed(&isosurface(&["--label", "liver", "--out", "x.ply"]), 2);
    assert!(
        twice.contains("3, 4") && twice.contains("number"),
        "{twice}"
    );
    assert!(!folder.path().join("x.ply").exists());
    let mesh = format!("{FILE}.obj");
    fs::write(
        folder.path().join(&mesh),
        "v 0 0 0\n\u{1b}]0;pwned\u{7} 1\n",
    )
    .unwrap();
    printed(&run(&["mesh", "info", &mesh, "--unit", "mm"]), 2);
    for command in ["reproduce", "devices", "quality", "replay", "\u{1b}[2J"] {
        printed(
            &run(&[command, "\u{1b}]0;pwned\u{7}\u{202e}\r\npalpate: error: no"]),
            2,
        );
    }
}

/// A record on a full disk is a failure (1), and no invalid input (2). Judge: a limit of the operating system on the
/// size of files, which the database takes for a full disk.
#[cfg(target_os = "linux")]
#[test]
fn a_record_without_room_is_a_failure() {
    let folder = folder();
    let scene = format!("{FILE}.toml");
    let simulate = ["simulate", &scene, "--headless", "--motion", "motion.csv"];
    printed(
        &palpate_in(folder.path(), &[&simulate[..], &["--out", "o"]].concat()),
        0,
    );
    let output = Command::new("sh")
        .args(["-c", "trap '' XFSZ; ulimit -f 8; exec \"$0\" \"$@\""])
        .arg(env!("CARGO_BIN_EXE_palpate"))
        .args(["score", "o", "--trainee", "Anna", "--record", "r.sqlite"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    let said = printed(&output, 1);
    assert!(said.contains("room") && said.contains("r.sqlite"), "{said}");
}
