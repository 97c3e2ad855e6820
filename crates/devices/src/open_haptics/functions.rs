//! The functions of `libHD` that are used, as its interface has them.

#![allow(
    unsafe_code,
    reason = "functions of a library that is loaded at run time"
)]

use std::ffi::{c_char, c_void};
use std::path::Path;

use palpate_servo::Vec3;

use super::errors;
use crate::library::{Library, text};
use crate::{Kind, OpenError};

/// A handle that is none.
const INVALID: u32 = 0xFFFF_FFFF;

const BUTTONS: u32 = 0x2000;
const POSITION: u32 = 0x2050;
const TRANSFORM: u32 = 0x2052;
const MODEL: u32 = 0x2501;
const SERIAL: u32 = 0x2504;
const USABLE_WORKSPACE: u32 = 0x2551;
const NOMINAL_MAX_FORCE: u32 = 0x2603;
const NOMINAL_MAX_CONTINUOUS_FORCE: u32 = 0x2604;
const CURRENT_FORCE: u32 = 0x2700;
const FORCE_OUTPUT: u32 = 0x4000;
const FORCE_RAMPING: u32 = 0x4002;
const CALIBRATION_OK: u32 = 0x5000;
const CALIBRATION_NEEDS_UPDATE: u32 = 0x5001;

/// Of all calls the one that may come at any time.
const HIGHEST_PRIORITY: u16 = 65_535;

/// What a callback answers to be called again, or not.
pub(super) const DONE: u32 = 0;
pub(super) const CONTINUE: u32 = 1;

#[repr(C)]
struct ErrorInfo {
    code: u32,
    internal: i32,
    device: u32,
}

/// What the scheduler calls.
pub(super) type Callback = extern "system" fn(*mut c_void) -> u32;

/// A C long, of whatever size it is here.
type ULong = std::ffi::c_ulong;

/// `libHD`, loaded.
#[derive(Clone, Copy)]
pub(super) struct Functions {
    init_device: extern "system" fn(*const c_char) -> u32,
    disable_device: extern "system" fn(u32),
    make_current: extern "system" fn(u32),
    begin_frame: extern "system" fn(u32),
    end_frame: extern "system" fn(u32),
    error: extern "system" fn() -> ErrorInfo,
    enable: extern "system" fn(u32),
    doubles: extern "system" fn(u32, *mut f64),
    integers: extern "system" fn(u32, *mut i32),
    set_doubles: extern "system" fn(u32, *const f64),
    string: extern "system" fn(u32) -> *const c_char,
    check_calibration: extern "system" fn() -> u32,
    calibration_style: extern "system" fn() -> u32,
    update_calibration: extern "system" fn(u32),
    start_scheduler: extern "system" fn(),
    stop_scheduler: extern "system" fn(),
    schedule: extern "system" fn(Callback, *mut c_void, u16) -> ULong,
    unschedule: extern "system" fn(ULong),
}

/// What a frame finds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Read {
    /// [mm]
    pub(super) position: Vec3,
    /// Column by column.
    pub(super) transform: [f64; 16],
    pub(super) buttons: i32,
}

impl Functions {
    pub(super) fn load(named: Option<&Path>) -> Result<Self, OpenError> {
        let names = match cfg!(windows) {
            true => &["HD.dll"][..],
            false => &["libHD.so", "libHD.so.3.4"],
        };
        let library = Library::load(Kind::OpenHaptics, names, named)?;
        macro_rules! function {
            ($name:literal) => {
                // SAFETY: the types are those of the interface, version 3.00.66; an integer of another width would
                // be another function.
                unsafe { library.function($name)? }
            };
        }
        Ok(Self {
            init_device: function!("hdInitDevice"),
            disable_device: function!("hdDisableDevice"),
            make_current: function!("hdMakeCurrentDevice"),
            begin_frame: function!("hdBeginFrame"),
            end_frame: function!("hdEndFrame"),
            error: function!("hdGetError"),
            enable: function!("hdEnable"),
            doubles: function!("hdGetDoublev"),
            integers: function!("hdGetIntegerv"),
            set_doubles: function!("hdSetDoublev"),
            string: function!("hdGetString"),
            check_calibration: function!("hdCheckCalibration"),
            calibration_style: function!("hdCheckCalibrationStyle"),
            update_calibration: function!("hdUpdateCalibration"),
            start_scheduler: function!("hdStartScheduler"),
            stop_scheduler: function!("hdStopScheduler"),
            schedule: function!("hdScheduleAsynchronous"),
            unschedule: function!("hdUnschedule"),
        })
    }

    /// The last error, and no older one; zero for none.
    pub(super) fn last_error(&self) -> u32 {
        let mut last = errors::NONE;
        // It keeps a stack; a bound, for a library that never empties it.
        for _ in 0..64 {
            let found = (self.error)().code;
            if found == errors::NONE {
                break;
            }
            last = errors::worse(last, found);
        }
        last
    }

    /// Opens the default device.
    pub(super) fn open(&self) -> Result<u32, u32> {
        let handle = (self.init_device)(std::ptr::null());
        let error = self.last_error();
        if handle == INVALID || error != errors::NONE {
            return Err(error);
        }
        (self.make_current)(handle);
        Ok(handle)
    }

    pub(super) fn close(&self, handle: u32) {
        (self.disable_device)(handle);
    }

    /// Model and serial number.
    pub(super) fn names(&self) -> [String; 2] {
        // SAFETY: texts of the library, which end with a zero and stay.
        [MODEL, SERIAL].map(|which| unsafe { text((self.string)(which)) })
    }

    /// The largest force, and the largest for as long as one likes [N].
    pub(super) fn largest_forces(&self) -> [f64; 2] {
        [NOMINAL_MAX_FORCE, NOMINAL_MAX_CONTINUOUS_FORCE].map(|which| self.read::<1>(which)[0])
    }

    /// Least and greatest corner [mm].
    pub(super) fn workspace(&self) -> [f64; 6] {
        self.read(USABLE_WORKSPACE)
    }

    pub(super) fn enable_forces(&self) {
        (self.enable)(FORCE_OUTPUT);
        (self.enable)(FORCE_RAMPING);
    }

    /// Whether it knows where its handle is; it may be brought to by itself.
    pub(super) fn calibrate(&self) {
        if (self.check_calibration)() == CALIBRATION_NEEDS_UPDATE {
            (self.update_calibration)((self.calibration_style)());
        }
    }

    pub(super) fn is_calibrated(&self) -> bool {
        (self.check_calibration)() == CALIBRATION_OK
    }

    /// One frame, in the scheduler's thread: reads, and hands `force` [N] over.
    pub(super) fn frame(&self, handle: u32, force: &Vec3) -> Read {
        (self.begin_frame)(handle);
        let position: [f64; 3] = self.read(POSITION);
        let transform = self.read(TRANSFORM);
        let mut buttons = 0;
        (self.integers)(BUTTONS, &raw mut buttons);
        let force: [f64; 3] = (*force).into();
        (self.set_doubles)(CURRENT_FORCE, force.as_ptr());
        (self.end_frame)(handle);
        Read {
            position: position.into(),
            transform,
            buttons,
        }
    }

    /// Has `callback` called with `data` from now on, until it is unscheduled.
    pub(super) fn schedule(&self, callback: Callback, data: *mut c_void) -> ULong {
        let number = (self.schedule)(callback, data, HIGHEST_PRIORITY);
        (self.start_scheduler)();
        number
    }

    pub(super) fn unschedule(&self, number: ULong) {
        (self.stop_scheduler)();
        (self.unschedule)(number);
    }

    fn read<const N: usize>(&self, which: u32) -> [f64; N] {
        // Of what a library does not know it writes nothing.
        let mut found = [f64::NAN; N];
        (self.doubles)(which, found.as_mut_ptr());
        found
    }
}
