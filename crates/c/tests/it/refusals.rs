//! What C can get wrong and can be told, is told.

use std::ffi::CStr;
use std::ptr;

use palpate_c::*;

use crate::calling::{HEMISPHERE, Hand, Model, NOBODY, at, message};

/// That a call was refused, with these words in its one sentence.
fn assert_refused(status: Status, words: &[&str]) {
    let message = message();
    println!("{message}");
    assert_eq!(status, Status::PalpateBadInput, "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
    for word in words {
        assert!(message.contains(word), "{message:?} lacks {word:?}");
    }
}

#[test]
fn a_wrong_pose_changes_nothing() {
    let model = Model::new(HEMISPHERE);
    let (mut hand, mut other) = (Hand::new(&model), Hand::new(&model));
    let pressed = at([0.0, 0.0, 0.047]);
    let with = |change: &dyn Fn(&mut ToolPose)| {
        let mut pose = pressed;
        change(&mut pose);
        [pose]
    };
    hand.go(&[pressed]);
    for (poses, words) in [
        (
            &with(&|pose| pose.position_m[1] = f64::NAN)[..],
            ["position of tool 0", "NaN"],
        ),
        (
            &with(&|pose| pose.position_m[2] = f64::NEG_INFINITY),
            ["position", "inf"],
        ),
        (
            &with(&|pose| pose.grip = f64::NAN),
            ["grip of tool 0", "from 0"],
        ),
        (&with(&|pose| pose.grip = 1.5), ["1.5", "to 1"]),
        (
            &with(&|pose| pose.has_orientation = 1),
            ["orientation of tool 0", "length 1"],
        ),
        (
            &with(&|pose| {
                (pose.has_orientation, pose.orientation) = (1, [f64::NAN, 0.0, 0.0, 1.0])
            }),
            ["orientation of tool 0", "NaN"],
        ),
        (&[], ["1 tool", "0 poses"]),
        (&[pressed, NOBODY], ["1 tool", "2 poses"]),
    ] {
        let status = hand.try_at(hand.time, poses);
        assert_refused(status, &words);
    }
    other.go(&[pressed]);
    assert_eq!(hand.go(&[pressed]), other.go(&[pressed]));
    assert_eq!(hand.shape(), other.shape());
}

#[test]
fn a_wrong_time_changes_nothing() {
    let model = Model::new(HEMISPHERE);
    let mut hand = Hand::new(&model);
    let pressed = [at([0.0, 0.0, 0.047])];
    assert_eq!(hand.try_at(1.0, &pressed), Status::PalpateOk);
    let status = hand.try_at(0.5, &pressed);
    assert_refused(status, &["goes back from 1 s to 0.5 s", "reset"]);
    for time in [f64::NAN, f64::INFINITY, -1.0] {
        let status = hand.try_at(time, &pressed);
        assert_refused(status, &["time_s", "finite"]);
    }
    assert_eq!(hand.try_at(1.0, &pressed), Status::PalpateOk);
}

/// Not wrong, but far beyond anything: no panic, no contact, no force.
#[test]
fn places_beyond_all_bounds_are_survived() {
    let model = Model::new(HEMISPHERE);
    for far in [1e3, 1e9, 1e30, 1e155, 1e300, f64::MAX] {
        for place in [[far, 0.0, 0.0], [0.0, -far, far], [0.0, 0.0, -far]] {
            let mut hand = Hand::new(&model);
            hand.go(&[at([0.0, 0.0, 0.047])]);
            let touch = hand.go(&[at(place)])[0];
            assert_eq!(touch.force_n, [0.0; 3], "{far:e}: {touch:?}");
            assert_eq!(touch.contact, 0, "{far:e}: {touch:?}");
        }
    }
}

#[test]
fn null_is_refused_everywhere() {
    let model = Model::new(HEMISPHERE);
    let hand = Hand::new(&model);
    let mut simulation = ptr::null_mut();
    let mut state = ptr::null_mut();
    let text = c"format = 1".as_ptr();
    let pose = at([0.0; 3]);
    let words = ["null pointer"];
    // SAFETY: what is not null is what the header demands.
    unsafe {
        for status in [
            palpate_simulation_open(ptr::null(), ptr::null(), &mut simulation),
            palpate_simulation_open(c"scene.toml".as_ptr(), ptr::null(), ptr::null_mut()),
            palpate_simulation_open_text(ptr::null(), text, ptr::null(), &mut simulation),
            palpate_simulation_open_text(text, ptr::null(), ptr::null(), &mut simulation),
            palpate_simulation_open_text(text, text, ptr::null(), ptr::null_mut()),
            palpate_simulation_surface(
                ptr::null(),
                std::mem::zeroed::<[SurfaceView; 1]>().as_mut_ptr(),
            ),
            palpate_simulation_surface(model.0, ptr::null_mut()),
            palpate_state_new(ptr::null(), &mut state),
            palpate_state_new(model.0, ptr::null_mut()),
            palpate_state_clone(ptr::null(), &mut state),
            palpate_state_clone(hand.state, ptr::null_mut()),
            palpate_state_restore(hand.state, ptr::null()),
            palpate_state_restore(ptr::null_mut(), hand.state),
            palpate_state_reset(ptr::null_mut()),
            palpate_state_undo_cut(ptr::null_mut()),
            palpate_state_show_every(ptr::null_mut(), 0.0),
            palpate_state_surface(
                ptr::null(),
                std::mem::zeroed::<[SurfaceView; 1]>().as_mut_ptr(),
            ),
            palpate_state_surface(hand.state, ptr::null_mut()),
            palpate_step(ptr::null_mut(), 0.0, &pose, 1, ptr::null_mut()),
            palpate_step(hand.state, 0.0, ptr::null(), 1, ptr::null_mut()),
        ] {
            assert_refused(status, &words);
        }
        assert!(simulation.is_null() && state.is_null());
        assert_eq!(palpate_tool_count(ptr::null()), 0);
        assert_eq!(palpate_warning_count(ptr::null()), 0);
        assert!(palpate_tool_name(ptr::null(), 0).is_null());
        assert!(palpate_warning(ptr::null(), 0).is_null());
        assert!(palpate_simulation_normals(ptr::null()).is_null());
        assert_eq!(palpate_step_length(ptr::null()), 0.0);
        assert_eq!(palpate_force_scale(ptr::null()), 0.0);
        palpate_simulation_free(ptr::null_mut());
        palpate_state_free(ptr::null_mut());
        // Nobody wants to know.
        assert_eq!(
            palpate_step(hand.state, 0.0, &pose, 1, ptr::null_mut()),
            Status::PalpateOk
        );
    }
}

#[test]
fn a_crooked_array_is_refused() {
    let model = Model::new(HEMISPHERE);
    let hand = Hand::new(&model);
    let poses = [NOBODY; 2];
    let crooked = poses.as_ptr().wrapping_byte_add(1);
    // SAFETY: it is refused before it is read.
    let status = unsafe { palpate_step(hand.state, 0.0, crooked, 1, ptr::null_mut()) };
    assert_refused(status, &["`poses`", "its type"]);
}

#[test]
fn a_state_of_another_simulation_is_refused() {
    let (one, other) = (Model::new(HEMISPHERE), Model::new(HEMISPHERE));
    let (hand, from) = (Hand::new(&one), Hand::new(&other));
    // SAFETY: two states.
    let status = unsafe { palpate_state_restore(hand.state, from.state) };
    assert_refused(status, &["two simulations"]);
    // SAFETY: a state; itself is as good as any.
    let status = unsafe { palpate_state_restore(hand.state, hand.state) };
    assert_eq!(status, Status::PalpateOk);
}

/// The judge is the error of the crates below, which the command prints as it is.
#[test]
fn a_wrong_scene_is_told_as_the_command_tells_it() {
    let unknown = HEMISPHERE.replace("hemisphere", "hemisfere");
    let status = Model::open(&unknown, ptr::null()).unwrap_err();
    let told = palpate_files::Scene::parse(&unknown, "scene.toml").unwrap_err();
    assert_refused(status, &[&told.to_string(), "hemisfere"]);

    let missing = "format = 1\norgan = { mesh = \"no.stl\", mesh_unit = \"m\", builtin_tissue = \"pig-liver\" }\n\
                   tool = [{ name = \"right\", tip = { shape = \"flat\", radius_m = 0.001 } }]";
    let status = Model::open(missing, ptr::null()).unwrap_err();
    assert_refused(status, &["no.stl"]);

    let mut simulation = ptr::null_mut();
    // SAFETY: a text that ends with a zero, a variable for the pointer.
    unsafe {
        let none = palpate_simulation_open(c"no/scene.toml".as_ptr(), ptr::null(), &mut simulation);
        assert_refused(none, &["no/scene.toml", "check"]);
        let latin =
            palpate_simulation_open(c"sc\xe9ne.toml".as_ptr(), ptr::null(), &mut simulation);
        assert_refused(latin, &["`path`", "UTF-8"]);
    }
    assert!(simulation.is_null());
}

#[test]
fn a_scene_file_is_opened_and_described() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    let scene = HEMISPHERE.to_owned() + "[model]\nstep_s = 0.002\nforce_scale = 3.0\n";
    std::fs::write(
        &path,
        scene
            .replace("tool = [{", "[[tool]]\n")
            .replace(" }]\n", "\n")
            .replace(", tip", "\ntip"),
    )
    .unwrap();
    let path = std::ffi::CString::new(path.to_str().unwrap()).unwrap();
    let mut simulation = ptr::null_mut();
    // SAFETY: a text that ends with a zero, a variable for the pointer; then a simulation.
    unsafe {
        let status = palpate_simulation_open(path.as_ptr(), ptr::null(), &mut simulation);
        assert_eq!(status, Status::PalpateOk, "{}", message());
        assert_eq!(palpate_tool_count(simulation), 1);
        let name = CStr::from_ptr(palpate_tool_name(simulation, 0));
        assert_eq!(name, c"right");
        assert!(palpate_tool_name(simulation, 1).is_null());
        assert_eq!(palpate_step_length(simulation), 0.002);
        assert_eq!(palpate_force_scale(simulation), 3.0);
        palpate_simulation_free(simulation);
        let version = CStr::from_ptr(palpate_version());
        assert_eq!(version.to_str().unwrap(), env!("CARGO_PKG_VERSION"));
    }
}

#[test]
fn messages_are_those_of_a_thread() {
    Model::open("format = 2", ptr::null()).unwrap_err();
    let here = message();
    assert!(!here.is_empty());
    std::thread::scope(|scope| {
        scope.spawn(|| {
            assert_eq!(message(), "");
            Model::open("nonsense", ptr::null()).unwrap_err();
            assert_ne!(message(), here);
        });
    });
    assert_eq!(message(), here);
}
