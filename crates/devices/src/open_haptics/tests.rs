//! Tests of the driver with functions in Rust, so that Miri can check every pointer: `cargo +nightly miri test -p
//! palpate-devices --lib`.

#![allow(unsafe_code, reason = "functions that stand for those of a library")]

use std::ffi::{c_char, c_ulong, c_void};
use std::sync::Mutex;

use palpate_servo::{Clock, DeviceState, Fault, ServoLoop, ServoSettings, ServoThread, Vec3};

use super::OpenHapticsDevice;
use super::functions::{CONTINUE, Callback, ErrorInfo, Functions};

/// The state of the library.
#[derive(Default)]
struct LibraryState {
    frame: Option<[f64; 3]>,
    displayed: [f64; 3],
    enabled: bool,
    open: i32,
    frames: u32,
    called: Option<(Callback, Data)>,
}

/// The argument of a callback.
#[derive(Clone, Copy)]
struct Data(*mut c_void);

// SAFETY: what the scheduler was given may be used from any thread; it says so where it is scheduled.
unsafe impl Send for Data {}

impl Data {
    fn pointer(self) -> *mut c_void {
        self.0
    }
}

static LIBRARY: Mutex<Option<LibraryState>> = Mutex::new(None);
/// One library in the process, one test at a time.
static ALONE: Mutex<()> = Mutex::new(());

fn library<T>(act: impl FnOnce(&mut LibraryState) -> T) -> T {
    act(LIBRARY
        .lock()
        .unwrap()
        .get_or_insert_with(LibraryState::default))
}

unsafe extern "system" fn init(_: *const c_char) -> u32 {
    library(|library| library.open += 1);
    7
}
unsafe extern "system" fn close(_: u32) {
    library(|library| library.open -= 1);
}
unsafe extern "system" fn nothing_of(_: u32) {}
unsafe extern "system" fn nothing() {}
unsafe extern "system" fn begin(_: u32) {
    library(|library| library.frame = Some([0.0; 3]));
}
unsafe extern "system" fn end(_: u32) {
    library(|library| {
        let force = library.frame.take().unwrap();
        library.displayed = if library.enabled { force } else { [0.0; 3] };
        library.frames += 1;
    });
}
unsafe extern "system" fn error() -> ErrorInfo {
    ErrorInfo {
        code: 0,
        internal: 0,
        device: 7,
    }
}
unsafe extern "system" fn enable(what: u32) {
    library(|library| library.enabled |= what == 0x4000);
}
unsafe extern "system" fn disable(what: u32) {
    library(|library| library.enabled &= what != 0x4000);
}
/// As many numbers as the documents list, one after another, so that Miri finds room that is too small.
unsafe extern "system" fn doubles(what: u32, out: *mut f64) {
    let count = match what {
        0x2050 => 3,
        0x2052 => 16,
        0x2551 => 6,
        _ => 1,
    };
    for at in 0..count {
        let value = match (what, at) {
            (0x2052, 0 | 5 | 10 | 15) => 1.0,
            (0x2551, _) => [-80.0, -60.0, -35.0, 80.0, 60.0, 35.0][at],
            (0x2603 | 0x2604, _) => 2.0,
            _ => 0.0,
        };
        // SAFETY: the caller has room for what the documents list.
        unsafe { out.add(at).write(value) };
    }
}
unsafe extern "system" fn integers(_: u32, out: *mut i32) {
    // SAFETY: the caller has room for one.
    unsafe { out.write(0) };
}
unsafe extern "system" fn booleans(_: u32, out: *mut u8) {
    // SAFETY: the caller has room for one.
    unsafe { out.write(1) };
}
unsafe extern "system" fn set_doubles(_: u32, force: *const f64) {
    // SAFETY: the caller has three numbers there.
    let force = unsafe { force.cast::<[f64; 3]>().read() };
    library(|library| library.frame = Some(force));
}
unsafe extern "system" fn string(_: u32) -> *const c_char {
    c"ours".as_ptr()
}
unsafe extern "system" fn calibrated() -> u32 {
    0x5000
}
unsafe extern "system" fn style() -> u32 {
    4
}
unsafe extern "system" fn schedule(with: Callback, data: *mut c_void, _: u16) -> c_ulong {
    library(|library| library.called = Some((with, Data(data))));
    1
}
unsafe extern "system" fn unschedule(_: c_ulong) {}

fn functions() -> Functions {
    Functions {
        init_device: init,
        disable_device: close,
        make_current: nothing_of,
        begin_frame: begin,
        end_frame: end,
        error,
        enable,
        disable,
        doubles,
        integers,
        booleans,
        set_doubles,
        string,
        check_calibration: calibrated,
        calibration_style: style,
        update_calibration: nothing_of,
        start_scheduler: nothing,
        stop_scheduler: nothing,
        schedule,
        unschedule,
    }
}

/// One call of the scheduler, on a separate thread; returns its result.
fn call() -> u32 {
    let (with, data) = library(|library| library.called).unwrap();
    let called = std::thread::spawn(move || {
        // SAFETY: what was scheduled, with what it was scheduled.
        unsafe { with(data.pointer()) }
    });
    called.join().unwrap()
}

fn loop_of(push: impl FnMut(&DeviceState, f64) -> Vec3 + Send + 'static) -> ServoThread {
    *LIBRARY.lock().unwrap() = None;
    let device = OpenHapticsDevice::of(functions()).unwrap();
    let settings = ServoSettings {
        limits: Some(palpate_servo::Limits {
            ramp: 1e-9,
            ..palpate_servo::Limits::default()
        }),
        log: 64,
        ..ServoSettings::default()
    };
    let (servo, _) = ServoLoop::new(Box::new(device), Box::new(push), settings).unwrap();
    ServoThread::start(servo, Clock::virtual_time()).unwrap()
}

/// Ticks, the last of which sends zero, and later calls.
#[test]
fn a_loop_in_the_callback_ends_with_zero() {
    let _alone = ALONE.lock();
    let thread = loop_of(|_, _| Vec3::y() * 0.2);
    for _ in 0..10 {
        assert_eq!(call(), CONTINUE);
    }
    assert!(library(|library| library.displayed[1] > 0.1));
    let ended = std::thread::spawn(move || thread.stop());
    while call() == CONTINUE {
        std::thread::yield_now();
    }
    assert_eq!(ended.join().unwrap().unwrap().fault, None);
    let (displayed, frames) = library(|library| (library.displayed, library.frames));
    assert_eq!(displayed, [0.0; 3]);
    assert!(library(|library| !library.enabled && library.open == 0));
    // A late call finds no tick, but its argument still exists.
    assert_ne!(call(), CONTINUE);
    assert_eq!(library(|library| library.frames), frames);
}

#[test]
fn a_panic_in_the_callback_ends_with_zero() {
    let _alone = ALONE.lock();
    let thread = loop_of(|state, _| {
        assert!(state.time < 0.008, "a defect");
        Vec3::y() * 0.2
    });
    while call() == CONTINUE {}
    assert_eq!(library(|library| library.displayed), [0.0; 3]);
    assert!(library(
        |library| library.frame.is_none() && !library.enabled
    ));
    assert_eq!(thread.stop(), Err(Fault::Panicked));
    assert_eq!(library(|library| library.open), 0);
}
