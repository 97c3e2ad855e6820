//! What a step costs more through C than in Rust, on the built-in hemisphere: of a tool that nobody holds, where a step
//! does next to nothing, and of one that slides 1 mm deep.
//!
//! Budget: 1 µs more. Before the times of both it prints the difference of their medians.

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    unsafe_code,
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a bench calls as C does, and one that fails to unwrap has failed"
)]

use std::hint::black_box;
use std::ptr;
use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use palpate_c::*;
use palpate_files::{Pose, Scene};
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};

const SCENE: &str = "format = 1\norgan = { builtin = \"hemisphere\", builtin_tissue = \"pig-liver\" }\n\
                     tool = [{ name = \"right\", tip = { shape = \"flat\", radius_m = 0.001 } }]\n";

/// Steps that are timed one by one.
const STEPS: u32 = 20_000;

/// To and fro over the pole, 1 mm below it; none: nobody holds the tool.
fn place(number: u32, is_there: bool) -> Option<[f64; 3]> {
    let along = f64::from((number % 200).abs_diff(100));
    is_there.then_some([1e-4 * along - 5e-3, 0.0, 0.049])
}

/// A step every 5 ms in Rust.
fn in_rust(simulation: &Simulation, is_there: bool) -> impl FnMut() -> f64 {
    let mut state = SimulationState::new(simulation);
    let mut workspace = SimulationWorkspace::new(simulation);
    let mut number = 0;
    move || {
        let pose = black_box(place(number, is_there)).map(|position_m| Pose {
            position_m,
            orientation: None,
            grip: 0.0,
            cut: false,
        });
        let time = 5e-3 * f64::from(number);
        step(simulation, time, 5e-3, &[pose], &mut state, &mut workspace);
        number += 1;
        state.tools[0].force.z
    }
}

/// The same through C.
fn through_c(simulation: *const SimulationHandle, is_there: bool) -> impl FnMut() -> f64 {
    let mut state = ptr::null_mut();
    // SAFETY: the pointers are those of variables; the state lives to the end of the program.
    assert_eq!(
        unsafe { palpate_state_new(simulation, &mut state) },
        Status::PalpateOk
    );
    let mut touch = std::mem::MaybeUninit::<ToolTouch>::uninit();
    let mut number = 0;
    move || {
        let place = black_box(place(number, is_there));
        let pose = ToolPose {
            position_m: place.unwrap_or_default(),
            orientation: [0.0; 4],
            grip: 0.0,
            is_there: place.is_some().into(),
            has_orientation: 0,
            cut: 0,
        };
        let time = 5e-3 * f64::from(number);
        number += 1;
        // SAFETY: one tool, one pose, one touch, which is written when the step succeeds.
        unsafe {
            let status = palpate_step(state, time, &pose, 1, touch.as_mut_ptr());
            assert_eq!(status, Status::PalpateOk);
            touch.assume_init_ref().force_n[2]
        }
    }
}

/// The medians [s] of two calls that take turns, so that both see the same machine.
fn medians(mut one: impl FnMut() -> f64, mut other: impl FnMut() -> f64) -> [f64; 2] {
    let mut times = [const { Vec::new() }; 2];
    let time = |call: &mut dyn FnMut() -> f64| {
        let start = Instant::now();
        black_box(call());
        start.elapsed().as_secs_f64()
    };
    for _ in 0..STEPS {
        times[0].push(time(&mut one));
        times[1].push(time(&mut other));
    }
    times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    })
}

fn overhead(c: &mut Criterion) {
    let simulation = Simulation::new(&Scene::parse(SCENE, "scene.toml").unwrap()).unwrap();
    let text = std::ffi::CString::new(SCENE).unwrap();
    let mut handle = ptr::null_mut();
    // SAFETY: the texts end with a zero, and the pointer is that of a variable.
    let status = unsafe {
        palpate_simulation_open_text(
            text.as_ptr(),
            c"scene.toml".as_ptr(),
            ptr::null(),
            &mut handle,
        )
    };
    assert_eq!(status, Status::PalpateOk);
    for (name, is_there) in [("away", false), ("sliding", true)] {
        let [rust, other] = medians(in_rust(&simulation, is_there), through_c(handle, is_there));
        eprintln!(
            "{name}: {:.3} µs in Rust, {:.3} µs through C, {:+.3} µs",
            1e6 * rust,
            1e6 * other,
            1e6 * (other - rust)
        );
        let mut group = c.benchmark_group(format!("overhead/{name}"));
        let mut call = in_rust(&simulation, is_there);
        group.bench_function("rust", |b| b.iter(&mut call));
        let mut call = through_c(handle, is_there);
        group.bench_function("c", |b| b.iter(&mut call));
        group.finish();
    }
}

criterion_group!(benches, overhead);
criterion_main!(benches);
