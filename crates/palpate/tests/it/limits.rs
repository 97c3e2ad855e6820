//! What the system refuses, or forbids, is an error with a sentence, or takes longer; never a panic, and never an abort.
#![cfg(unix)]

use std::fs::{self, Permissions};
use std::io::Write;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::{palpate, stderr, stdout};

const SCENE: &str = "\
format = 1
[organ]
builtin = \"hemisphere\"
triangles = 4000
builtin_tissue = \"pig-liver\"
[organ.anchor]
planes = [{ point_m = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }]
[model]
kind = \"hybrid\"
mechanical_triangles = 4000
[[tool]]
name = \"right\"
kind = \"probe\"
tip = { shape = \"flat\", radius_m = 0.001 }
device = \"none\"
";

/// A folder that every user may write into, with a file in it.
fn folder_with(name: &str, text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    fs::set_permissions(folder.path(), Permissions::from_mode(0o777)).unwrap();
    let path = folder.path().join(name);
    fs::write(&path, text).unwrap();
    (folder, path)
}

/// Runs the command under `limit`, a command of the shell such as `ulimit -v 1000000`.
fn under(limit: &str, arguments: &[&str], folder: &Path) -> Output {
    Command::new("sh")
        .arg("-c")
        .arg(format!("{limit} && exec \"$@\""))
        .arg("sh")
        .arg(env!("CARGO_BIN_EXE_palpate"))
        .args(arguments)
        .env("PALPATE_CACHE", folder)
        .current_dir(folder)
        .output()
        .unwrap()
}

/// 4000 triangles take (3 · 4000)² numbers of four bytes twice, 1.2 GB; the limit leaves less. On the code before it was
/// ended by SIGABRT, for the machine had enough.
#[test]
#[cfg(target_os = "linux")]
fn precompute_refuses_what_a_limit_of_memory_forbids() {
    let (folder, scene) = folder_with("scene.toml", SCENE);
    let scene = scene.to_str().unwrap();
    let output = under("ulimit -v 1000000", &["precompute", scene], folder.path());
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("of memory"), "{said}");
    assert!(said.contains("fewer triangles"), "{said}");
    // What may be used says the limit, less what is used: below four fifths of it.
    let may = said.split(" GB may be used").next().unwrap_or_default();
    let may: f64 = may.rsplit(' ').next().unwrap_or_default().parse().unwrap();
    assert!(may < 0.82, "{said}");
}

/// Runs the command without a thread but its own: as another user where this one is root, whom the limit does not bind.
#[cfg(target_os = "linux")]
fn without_threads(arguments: &[&str], folder: &Path) -> Option<Output> {
    let id = Command::new("id").arg("-u").output().ok()?;
    let mut command = match id.stdout.starts_with(b"0\n") {
        true => {
            let mut command = Command::new("setpriv");
            command.args(["--reuid=54321", "--regid=54321", "--clear-groups", "--"]);
            command.arg("prlimit");
            command
        }
        false => Command::new("prlimit"),
    };
    command
        .arg("--nproc=0:0")
        .arg(env!("CARGO_BIN_EXE_palpate"))
        .args(arguments)
        .env("PALPATE_CACHE", folder)
        .env("HOME", folder)
        .current_dir(folder);
    // Of util-linux, which nearly every Linux has.
    let tools = Command::new("setpriv").arg("--version").output();
    tools.ok()?;
    Some(command.output().unwrap())
}

/// Judge: the same command with threads. On the code before it panicked.
#[test]
#[cfg(target_os = "linux")]
fn without_threads_it_takes_longer_and_comes_to_the_same() {
    let coarse = SCENE.replace("4000", "400");
    let (folder, scene) = folder_with("scene.toml", &coarse);
    let motion = folder.path().join("motion.csv");
    fs::write(
        &motion,
        "# format = 1\ntime_s,tool,x_m,y_m,z_m\n0.0,right,0.0,0.0,0.051\n0.2,right,0.0,0.0,0.049\n",
    )
    .unwrap();
    let arguments = |out: &'static str| {
        [
            "simulate",
            scene.to_str().unwrap(),
            "--headless",
            "--motion",
            motion.to_str().unwrap(),
            "--out",
            out,
        ]
    };
    let Some(alone) = without_threads(&arguments("alone"), folder.path()) else {
        eprintln!("passed over: no setpriv here");
        return;
    };
    let said = stderr(&alone);
    assert_eq!(alone.status.code(), Some(0), "{said}");
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    assert_eq!(said.contains("fewer threads"), cores > 1, "{said}");
    fs::remove_file(kept(folder.path())).unwrap();
    let together = under("true", &arguments("together"), folder.path());
    assert_eq!(together.status.code(), Some(0), "{}", stderr(&together));
    let session = |out: &str| fs::read(folder.path().join(out).join("session.csv")).unwrap();
    assert_eq!(session("alone"), session("together"));
}

/// The response that was kept.
#[cfg(target_os = "linux")]
fn kept(folder: &Path) -> PathBuf {
    let all = fs::read_dir(folder).unwrap();
    let mut paths = all.map(|entry| entry.unwrap().path());
    let is_response = |path: &PathBuf| path.extension().is_some_and(|end| end == "response");
    paths.find(is_response).unwrap()
}

/// On the code before, `--json` failed: JSON holds text, and a name is any bytes.
#[test]
fn a_name_that_is_no_text_is_read_and_shown() {
    let folder = tempfile::tempdir().unwrap();
    let name = |before: &[u8], after: &str| {
        let name = [before, b"\xff", after.as_bytes()].concat();
        folder.path().join(std::ffi::OsStr::from_bytes(&name))
    };
    let mesh = name(b"organ", ".obj");
    // Not every system lets a file have such a name.
    let text = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    if fs::write(&mesh, text).is_err() {
        return;
    }
    let run = |arguments: &[&std::ffi::OsStr]| {
        let output = Command::new(env!("CARGO_BIN_EXE_palpate"))
            .args(arguments)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let answer: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
        answer.to_string()
    };
    let answer = run(&["mesh", "info", "--json"]
        .map(std::ffi::OsStr::new)
        .into_iter()
        .chain([mesh.as_os_str()])
        .collect::<Vec<_>>());
    assert!(answer.contains("organ\u{fffd}.obj"), "{answer}");
    let out = name(b"written", ".ply");
    let convert = ["mesh", "convert"].map(std::ffi::OsStr::new);
    let answer = run(&[
        convert[0],
        convert[1],
        mesh.as_os_str(),
        out.as_os_str(),
        "--json".as_ref(),
    ]);
    assert!(
        answer.contains("written\u{fffd}.ply") && out.exists(),
        "{answer}"
    );
    let recording = name(b"press", ".csv");
    let rows: String = (0..400)
        .map(|k| {
            format!(
                "{},{},{}\n",
                0.01 * f64::from(k),
                1e-5 * f64::from(k.min(100)),
                1e-3 * f64::from(k.min(100))
            )
        })
        .collect();
    fs::write(
        &recording,
        format!("# format = 1\n# organ = \"liver\"\n# stimulus = \"ramp_and_hold\"\n# indenter_shape = \"flat\"\n# indenter_radius_m = 0.001\ntime_s,depth_m,force_n\n{rows}"),
    )
    .unwrap();
    let answer = run(&["analyze".as_ref(), recording.as_os_str(), "--json".as_ref()]);
    assert!(answer.contains("press\u{fffd}.csv"), "{answer}");
}

/// On the code before, each of these messages had five megabytes.
#[test]
fn what_errors_quote_is_short() {
    let folder = tempfile::tempdir().unwrap();
    let long = "x".repeat(5_000_000);
    let cases = [
        (
            "key.toml",
            format!("format = 1\n{} = 1\n", &long[..4_000_000]),
        ),
        (
            "value.toml",
            format!("format = 1\norgan = \"{}\"\n", &long[..4_000_000]),
        ),
        (
            "syntax.toml",
            format!("format = 1\n{}\n", &long[..4_000_000]),
        ),
        ("column.csv", format!("# format = 1\n{long}\n1\n")),
        (
            "row.csv",
            format!("# format = 1\ntime_s,tool,x_m,y_m,z_m\n{long},right,0,0,0\n"),
        ),
        ("mesh.obj", format!("v {long} 0 0\n")),
    ];
    for (name, text) in cases {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        let path = path.to_str().unwrap();
        let output = match name.rsplit_once('.').unwrap().1 {
            "toml" => palpate(&[
                "simulate",
                path,
                "--headless",
                "--motion",
                path,
                "--out",
                "never",
            ]),
            "csv" if name == "row.csv" => palpate(&["analyze", path]),
            "csv" => palpate(&["analyze", path]),
            _ => palpate(&["mesh", "info", path]),
        };
        let said = stderr(&output);
        assert_eq!(
            output.status.code(),
            Some(2),
            "{name}: {} bytes",
            said.len()
        );
        assert!(said.contains(name), "{name}: {} bytes", said.len());
        assert!(said.len() < 4000, "{name}: {} bytes", said.len());
    }
}

/// 200,000 keys above a table, which took 21 s.
#[test]
fn too_many_keys_above_a_table_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("press.csv");
    let mut file = fs::File::create(&path).unwrap();
    writeln!(file, "# format = 1").unwrap();
    for k in 0..200_000 {
        writeln!(file, "# instrument_key_{k} = {k}").unwrap();
    }
    writeln!(file, "time_s,depth_m,force_n\n0.0,0.0,0.0").unwrap();
    let output = palpate(&["analyze", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("press.csv line 1001: found more than 1000 keys"));
}
