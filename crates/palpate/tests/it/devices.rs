//! `palpate devices`, without a device and against stand-ins.

use std::process::{Command, Output};

use palpate_device_stand_ins::{HaplyStandIn, HaplyStandInSettings, Misbehaviour, StandInClock};
use palpate_devices::haply::HaplyAddress;
use palpate_servo::{HandImpedance, Trajectory, Vec3, VirtualDevice, Waypoint};

use crate::{json, stderr, stdout};

/// The variable that says where the service is.
fn place(address: &HaplyAddress) -> String {
    format!("{address},{}", address.events_port)
}

fn nowhere() -> String {
    let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    listener.local_addr().unwrap().to_string()
}

fn devices(arguments: &[&str], haply: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_palpate"))
        .arg("devices")
        .args(arguments)
        .env("PALPATE_HAPLY", haply)
        .env("PALPATE_OPENHAPTICS", "/nowhere/libHD.so")
        .env("PALPATE_FORCE_DIMENSION", "/nowhere/libdhd.so")
        .output()
        .unwrap()
}

fn service() -> HaplyStandIn {
    let still = Trajectory::waypoints(vec![Waypoint::new(0.0, Vec3::zeros())]).unwrap();
    let hand = VirtualDevice::new(still)
        .with_hand(HandImpedance::default())
        .unwrap();
    let settings = HaplyStandInSettings {
        clock: StandInClock::Wall,
        ..HaplyStandInSettings::default()
    };
    HaplyStandIn::start(vec![Box::new(hand)], settings).unwrap()
}

#[test]
fn without_a_device_every_kind_says_why() {
    let output = devices(&[], &nowhere());
    assert_eq!(output.status.code(), Some(1));
    assert!(stdout(&output).contains("haply: no Haply Inverse Service answers at 127.0.0.1:"));
    assert!(stderr(&output).starts_with("palpate: error: no haptic device was found; "));
}

#[test]
fn one_that_is_asked_for_and_missing_is_one_sentence() {
    let library = |kind: &str, file: &str| {
        format!("the library of `{kind}` is not there: no /nowhere/{file} can be loaded")
    };
    for (kind, begins) in [
        ("haply", "no Haply Inverse Service answers".to_owned()),
        ("openhaptics", library("openhaptics", "libHD.so")),
        ("force_dimension", library("force_dimension", "libdhd.so")),
    ] {
        let output = devices(&[kind], &nowhere());
        assert_eq!(output.status.code(), Some(1));
        assert!(output.stdout.is_empty());
        let said = stderr(&output);
        let begins = format!("palpate: error: {begins}");
        assert!(said.starts_with(&begins), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    }
}

#[test]
fn an_address_that_is_none_is_refused() {
    let output = devices(&[], "somewhere");
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("\"somewhere\" is no address"));
}

#[test]
fn a_device_is_listed_with_its_limits() {
    let service = service();
    let found = json(&devices(&["haply", "--json"], &place(service.address())));
    let device = &found["devices"][0];
    assert_eq!(device["model"], "inverse3");
    assert_eq!(device["peak_force_n"], 3.0);
    assert!(device["self_test"].is_null());
    // Listing moves nothing.
    assert!(service.forces(0).is_empty());
}

/// On the machine's clock. A machine that is busy elsewhere makes a tick late, which takes forces off and is said; one
/// run of five has to be undisturbed.
#[test]
#[ignore = "long"]
fn a_self_test_pushes_and_says_so() {
    let service = service();
    let passed = (0..5).any(|_| {
        let output = devices(&["haply", "--self-test"], &place(service.address()));
        let text = stdout(&output);
        println!("{text}{}", stderr(&output));
        assert!(
            text.contains("N sent") && text.contains("self-test"),
            "{text}"
        );
        output.status.code() == Some(0)
    });
    assert!(passed);
    let largest = service.forces(0).iter().map(Vec3::norm).fold(0.0, f64::max);
    assert!(largest > 0.1 && largest <= 0.3, "{largest}");
    assert_eq!(service.force(0), Vec3::zeros());
    service.misbehave(Some(Misbehaviour::NoCalibration));
    let output = devices(&["haply", "--self-test"], &place(service.address()));
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stdout(&output).contains("it was not ready"),
        "{}",
        stdout(&output)
    );
    assert!(stderr(&output).contains("did not pass its self-test"));
}

/// Before a window, and before the organ is prepared.
#[test]
fn a_scene_and_a_rig_without_their_device_are_one_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "format = 1\norgan = { builtin = \"liver\", builtin_tissue = \"pig-liver\" }\n\
                 tool = [{ name = \"right\", kind = \"probe\", device = \"haply\", \
                 tip = { shape = \"flat\", radius_m = 0.002 } }]\n";
    let protocol = "format = 1\n[rig]\ndevice = \"haply\"\n[[specimen]]\nbuiltin_tissue = \"pig-liver\"\n\
                    [[stimulus]]\nkind = \"ramp_and_hold\"\ndepth_m = 0.001\nramp_s = 0.5\nhold_s = 1\n";
    std::fs::write(folder.path().join("scene.toml"), scene).unwrap();
    std::fs::write(folder.path().join("protocol.toml"), protocol).unwrap();
    let rig = ["measure", "protocol.toml", "--headless", "--out", "made"];
    for arguments in [&["simulate", "scene.toml"][..], &rig] {
        let output = Command::new(env!("CARGO_BIN_EXE_palpate"))
            .args(arguments)
            .env("PALPATE_HAPLY", nowhere())
            .current_dir(folder.path())
            .output()
            .unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(output.stdout.is_empty());
        assert!(said.contains("no Haply Inverse Service answers"), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    }
    assert!(!folder.path().join("made").exists());
}

/// Without a window a device moves the tools, and who connects sees it; nothing listens but on loopback.
#[test]
fn a_touch_without_a_window_is_shown() {
    use std::io::{BufRead, BufReader, Read};
    use std::process::Stdio;
    let folder = tempfile::tempdir().unwrap();
    let scene = "format = 1\norgan = { builtin = \"liver\", triangles = 2000, builtin_tissue = \"pig-liver\" }\n\
                 model = { kind = \"local\" }\n\
                 tool = [{ name = \"right\", kind = \"probe\", device = \"haply\", \
                 tip = { shape = \"flat\", radius_m = 0.002 } }]\n";
    std::fs::write(folder.path().join("scene.toml"), scene).unwrap();
    let service = service();
    let mut child = Command::new(env!("CARGO_BIN_EXE_palpate"))
        .args(["simulate", "scene.toml", "--headless", "--openigtlink=0"])
        .env("PALPATE_HAPLY", place(service.address()))
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut said = String::new();
    let mut lines = BufReader::new(child.stdout.take().unwrap());
    lines.read_line(&mut said).unwrap();
    let address = said
        .strip_prefix("shown at ")
        .unwrap()
        .split(',')
        .next()
        .unwrap();
    assert!(address.starts_with("127.0.0.1:"), "{said}");
    let mut stream = std::net::TcpStream::connect(address).unwrap();
    let mut seen: Vec<u8> = Vec::new();
    while !seen.windows(9).any(|nine| nine == b"TRANSFORM") {
        let mut bytes = [0; 4096];
        let length = stream.read(&mut bytes).unwrap();
        assert!(length > 0);
        seen.extend(&bytes[..length]);
    }
    // A device that is lost ends it, with its name.
    service.misbehave(Some(Misbehaviour::Disconnects));
    assert_eq!(child.wait().unwrap().code(), Some(1));
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |arguments: &[&str], word: &str| {
        crate::errors::assert_refused(folder.path(), arguments, &[word]);
    };
    refused(&["simulate", "--headless"], "--motion");
    refused(
        &["simulate", "--headless", "--openigtlink=0"],
        "moved without a window",
    );
    refused(&["simulate", "--openigtlink=home"], "0.0.0.0:18944");
    let motion = [
        "simulate",
        "--headless",
        "--openigtlink",
        "--motion",
        "m",
        "--out",
        "o",
    ];
    refused(&motion, "faster than it can be displayed");
}
