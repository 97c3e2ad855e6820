//! Tests of the driver with functions in Rust, so that Miri can check every pointer: `cargo +nightly miri test -p
//! palpate-devices --lib`.

#![allow(unsafe_code, reason = "functions that stand for those of a library")]

use std::ffi::{c_char, c_int, c_uint};
use std::sync::Mutex;

use palpate_servo::{DeviceState, Limits, ServoLoop, ServoSettings, Vec3};

use super::ForceDimensionDevice;
use super::functions::Functions;

/// The displayed force [N], whether forces are enabled, and the number of open devices.
static LIBRARY: Mutex<([f64; 3], bool, i32)> = Mutex::new(([0.0; 3], false, 0));

unsafe extern "C" fn count() -> c_int {
    1
}
unsafe extern "C" fn open(_: c_char) -> c_int {
    LIBRARY.lock().unwrap().2 += 1;
    0
}
unsafe extern "C" fn close(_: c_char) -> c_int {
    LIBRARY.lock().unwrap().2 -= 1;
    0
}
unsafe extern "C" fn enable_force(on: u8, _: c_char) -> c_int {
    LIBRARY.lock().unwrap().1 = on != 0;
    0
}
unsafe extern "C" fn position(x: *mut f64, y: *mut f64, z: *mut f64, _: c_char) -> c_int {
    for place in [x, y, z] {
        // SAFETY: the caller has room for one number at each.
        unsafe { place.write(0.0) };
    }
    0
}
unsafe extern "C" fn frame(out: *mut [[f64; 3]; 3], _: c_char) -> c_int {
    // SAFETY: the caller has room for nine numbers.
    unsafe { out.write([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]) };
    0
}
unsafe extern "C" fn set_force(x: f64, y: f64, z: f64, _: c_char) -> c_int {
    LIBRARY.lock().unwrap().0 = [x, y, z];
    0
}
unsafe extern "C" fn set_max_force(_: f64, _: c_char) -> c_int {
    0
}
unsafe extern "C" fn set_watchdog(_: u8, _: c_char) -> c_int {
    0
}
unsafe extern "C" fn buttons(_: c_char) -> c_uint {
    0
}
/// Seventeen states, as the largest version has.
unsafe extern "C" fn status(out: *mut c_int, _: c_char) -> c_int {
    for at in 0..17 {
        // SAFETY: the caller has room for as many.
        unsafe { out.add(at).write(c_int::from(at < 3)) };
    }
    0
}
unsafe extern "C" fn name(_: c_char) -> *const c_char {
    c"ours".as_ptr()
}
unsafe extern "C" fn last_error() -> c_int {
    0
}
unsafe extern "C" fn last_error_text() -> *const c_char {
    std::ptr::null()
}

#[test]
fn a_loop_ends_with_zero_and_a_closed_device() {
    let functions = Functions {
        count,
        open,
        close,
        enable_force,
        position,
        frame,
        set_force,
        set_max_force,
        set_watchdog: Some(set_watchdog),
        buttons,
        status,
        name,
        last_error,
        last_error_text,
    };
    let device = ForceDimensionDevice::of(functions.open(0).unwrap());
    let limits = Limits {
        ramp: 1e-9,
        ..Limits::default()
    };
    let settings = ServoSettings {
        limits: Some(limits),
        log: 64,
        ..ServoSettings::default()
    };
    let push = |_: &DeviceState, _: f64| Vec3::y() * 0.2;
    let (mut servo, _) = ServoLoop::new(Box::new(device), Box::new(push), settings).unwrap();
    for tick in 0..20 {
        servo.tick(f64::from(tick) * 1e-3, 0.0).unwrap();
    }
    // Up is z of the library.
    assert_eq!(*LIBRARY.lock().unwrap(), ([0.0, 0.0, 0.2], true, 1));
    drop(servo);
    assert_eq!(*LIBRARY.lock().unwrap(), ([0.0; 3], false, 0));
}
