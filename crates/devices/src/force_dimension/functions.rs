//! The required functions of `libdhd`, as declared in its interface.
//!
//! All of them are `unsafe` to call, since their types are known from documents alone: the header dhdc.h of the Force
//! Dimension SDK, version 3, and its reference. Each wrapper states why its call is safe; only the wrappers call them.

#![allow(
    unsafe_code,
    reason = "functions of a library that is loaded at run time"
)]

use std::ffi::{c_char, c_int, c_uint};
use std::path::Path;

use palpate_servo::Vec3;

use crate::library::{Library, text};
use crate::{Kind, OpenError};

/// Capacity for the states of a device: DHD_MAX_STATUS, which is 15 to 17, depending on the version.
const STATES: usize = 32;

const POWER: usize = 0;
const CONNECTED: usize = 1;
const STARTED: usize = 2;
const ERROR: usize = 9;
const FORCE_OFF_CAUSE: usize = 14;

/// The status of a device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Status {
    pub(super) powered: bool,
    pub(super) connected: bool,
    pub(super) started: bool,
    pub(super) error: bool,
    /// Why it took its forces off; zero when it did not.
    pub(super) force_off_cause: i32,
}

/// `libdhd`, loaded.
#[derive(Clone, Copy)]
pub(super) struct Functions {
    pub(super) count: unsafe extern "C" fn() -> c_int,
    pub(super) open: unsafe extern "C" fn(c_char) -> c_int,
    pub(super) close: unsafe extern "C" fn(c_char) -> c_int,
    pub(super) enable_force: unsafe extern "C" fn(u8, c_char) -> c_int,
    pub(super) position: unsafe extern "C" fn(*mut f64, *mut f64, *mut f64, c_char) -> c_int,
    pub(super) frame: unsafe extern "C" fn(*mut [[f64; 3]; 3], c_char) -> c_int,
    pub(super) set_force: unsafe extern "C" fn(f64, f64, f64, c_char) -> c_int,
    pub(super) set_max_force: unsafe extern "C" fn(f64, c_char) -> c_int,
    /// Not in every version.
    pub(super) set_watchdog: Option<unsafe extern "C" fn(u8, c_char) -> c_int>,
    pub(super) buttons: unsafe extern "C" fn(c_char) -> c_uint,
    pub(super) status: unsafe extern "C" fn(*mut c_int, c_char) -> c_int,
    pub(super) name: unsafe extern "C" fn(c_char) -> *const c_char,
    pub(super) last_error: unsafe extern "C" fn() -> c_int,
    pub(super) last_error_text: unsafe extern "C" fn() -> *const c_char,
}

/// A device of the library; dropping it closes the device. It must not be copied: closing must be the last call with
/// its number.
pub(super) struct Opened {
    functions: Functions,
    id: c_char,
}

impl Functions {
    pub(super) fn load(named: Option<&Path>) -> Result<Self, OpenError> {
        let names = match cfg!(windows) {
            true => &["dhd64.dll"][..],
            false => &["libdhd.so", "libdhd.so.3"],
        };
        let library = Library::load(Kind::ForceDimension, names, named)?;
        macro_rules! function {
            ($name:literal) => {
                // SAFETY: parameters and result are those that dhdc.h declares for it: int, unsigned int, char, unsigned
                // char, double, and pointers to them; all are declared extern "C".
                unsafe { library.function($name)? }
            };
        }
        Ok(Self {
            count: function!("dhdGetDeviceCount"),
            open: function!("dhdOpenID"),
            close: function!("dhdClose"),
            enable_force: function!("dhdEnableForce"),
            position: function!("dhdGetPosition"),
            frame: function!("dhdGetOrientationFrame"),
            set_force: function!("dhdSetForce"),
            set_max_force: function!("dhdSetMaxForce"),
            // SAFETY: as above; dhdc.h has it from version 3.3.2 on.
            set_watchdog: unsafe { library.function("dhdSetWatchdog") }.ok(),
            buttons: function!("dhdGetButtonMask"),
            status: function!("dhdGetStatus"),
            name: function!("dhdGetSystemName"),
            last_error: function!("dhdErrorGetLast"),
            last_error_text: function!("dhdErrorGetLastStr"),
        })
    }

    pub(super) fn count(&self) -> usize {
        // SAFETY: dhdGetDeviceCount takes nothing.
        usize::try_from(unsafe { (self.count)() }).unwrap_or(0)
    }

    /// Opens device `number`, counted from zero.
    pub(super) fn open(&self, number: usize) -> Result<Opened, OpenError> {
        let there = self.count();
        let wanted = c_char::try_from(number).ok().filter(|_| number < there);
        let wanted = wanted.ok_or(OpenError::NoSuchDevice {
            kind: Kind::ForceDimension,
            there,
            wanted: number + 1,
        })?;
        // SAFETY: dhdOpenID takes the number of a device below that of dhdGetDeviceCount, and answers −1 when it cannot.
        match unsafe { (self.open)(wanted) } {
            id @ 0..=127 => Ok(Opened {
                functions: *self,
                id: id as c_char,
            }),
            _ => Err(OpenError::NotOpened {
                kind: Kind::ForceDimension,
                what: self.error_text(),
            }),
        }
    }

    fn error_text(&self) -> String {
        // SAFETY: dhdErrorGetLastStr takes nothing and returns a text that ends with a zero and belongs to the library,
        // which is never unloaded; it is copied before any other call.
        let error_text = unsafe { text((self.last_error_text)()) };
        match error_text.is_empty() {
            true => format!("error {}", self.last_error()),
            false => error_text,
        }
    }

    fn last_error(&self) -> i32 {
        // SAFETY: dhdErrorGetLast takes nothing.
        unsafe { (self.last_error)() }
    }
}

impl Opened {
    pub(super) fn name(&self) -> String {
        // SAFETY: dhdGetSystemName takes the number of an open device and returns null or a text that ends with a zero
        // and belongs to the library; it is copied before any other call.
        unsafe { text((self.functions.name)(self.id)) }
    }

    /// Enables its forces, but never above `most` [N], and off if no force comes for `fresh` [s], if the device
    /// supports that.
    pub(super) fn enable_forces(&self, most: f64, fresh: f64) -> Result<(), i32> {
        // SAFETY: dhdSetMaxForce takes a number of newtons and an open device.
        self.checked(unsafe { (self.functions.set_max_force)(most, self.id) })?;
        if let Some(set) = self.functions.set_watchdog {
            // In multiples of 125 µs; a device without a watchdog returns an error.
            let multiples = (fresh / 125e-6).clamp(1.0, 255.0) as u8;
            // SAFETY: dhdSetWatchdog takes an unsigned char and an open device.
            unsafe { set(multiples, self.id) };
        }
        // SAFETY: dhdEnableForce takes 1 to enable forces and an open device.
        self.checked(unsafe { (self.functions.enable_force)(1, self.id) })
    }

    pub(super) fn disable_forces(&self) -> Result<(), i32> {
        // SAFETY: dhdEnableForce takes 0 to disable forces and an open device.
        self.checked(unsafe { (self.functions.enable_force)(0, self.id) })
    }

    /// Sets `force` [N], in the library's axes. Saturated motors are no error.
    pub(super) fn set_force(&self, force: &Vec3) -> Result<(), i32> {
        // SAFETY: dhdSetForce takes three numbers of newtons and an open device.
        self.checked(unsafe { (self.functions.set_force)(force.x, force.y, force.z, self.id) })
    }

    /// [m], in the library's axes.
    pub(super) fn position(&self) -> Result<Vec3, i32> {
        let [mut x, mut y, mut z] = [f64::NAN; 3];
        // SAFETY: dhdGetPosition writes one double to each of three pointers, which are there until it returns.
        let answer =
            unsafe { (self.functions.position)(&raw mut x, &raw mut y, &raw mut z, self.id) };
        self.checked(answer)?;
        Ok(Vec3::new(x, y, z))
    }

    /// Row by row, in the library's axes.
    pub(super) fn frame(&self) -> Result<[[f64; 3]; 3], i32> {
        let mut frame = [[f64::NAN; 3]; 3];
        // SAFETY: dhdGetOrientationFrame writes a double[3][3], whose layout is that of the array.
        self.checked(unsafe { (self.functions.frame)(&raw mut frame, self.id) })?;
        Ok(frame)
    }

    pub(super) fn buttons(&self) -> u32 {
        // SAFETY: dhdGetButtonMask takes an open device.
        unsafe { (self.functions.buttons)(self.id) }
    }

    pub(super) fn status(&self) -> Result<Status, i32> {
        let mut states = [0; STATES];
        // SAFETY: dhdGetStatus writes DHD_MAX_STATUS integers, 17 at most in the versions known, for which there is room
        // twice over.
        self.checked(unsafe { (self.functions.status)(states.as_mut_ptr(), self.id) })?;
        Ok(Status {
            powered: states[POWER] != 0,
            connected: states[CONNECTED] != 0,
            started: states[STARTED] != 0,
            error: states[ERROR] != 0,
            force_off_cause: states[FORCE_OFF_CAUSE],
        })
    }

    /// A negative result is an error; the library keeps its number.
    fn checked(&self, answer: c_int) -> Result<(), i32> {
        match answer {
            0.. => Ok(()),
            _ => Err(self.functions.last_error()),
        }
    }
}

impl Drop for Opened {
    fn drop(&mut self) {
        // SAFETY: dhdClose takes an open device, and this one is closed once, by the last that knows its number.
        unsafe { (self.functions.close)(self.id) };
    }
}
