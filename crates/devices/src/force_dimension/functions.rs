//! The functions of `libdhd` that are used, as its interface has them.

#![allow(
    unsafe_code,
    reason = "functions of a library that is loaded at run time"
)]

use std::ffi::{c_char, c_int, c_uint};
use std::path::Path;

use palpate_servo::Vec3;

use crate::library::{Library, text};
use crate::{Kind, OpenError};

/// Room for the states of a device: versions have 15 to 17.
const STATES: usize = 32;

const POWER: usize = 0;
const CONNECTED: usize = 1;
const STARTED: usize = 2;
const ERROR: usize = 9;
const FORCE_OFF_CAUSE: usize = 14;

/// What a device says of itself.
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
    count: extern "C" fn() -> c_int,
    open: extern "C" fn(c_char) -> c_int,
    close: extern "C" fn(c_char) -> c_int,
    enable_force: extern "C" fn(u8, c_char) -> c_int,
    position: extern "C" fn(*mut f64, *mut f64, *mut f64, c_char) -> c_int,
    frame: extern "C" fn(*mut [[f64; 3]; 3], c_char) -> c_int,
    set_force: extern "C" fn(f64, f64, f64, c_char) -> c_int,
    set_max_force: extern "C" fn(f64, c_char) -> c_int,
    buttons: extern "C" fn(c_char) -> c_uint,
    status: extern "C" fn(*mut c_int, c_char) -> c_int,
    name: extern "C" fn(c_char) -> *const c_char,
    last_error: extern "C" fn() -> c_int,
    last_error_text: extern "C" fn() -> *const c_char,
}

/// A device of the library.
#[derive(Clone, Copy)]
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
                // SAFETY: the types are those of the interface, version 3; all of them are declared for C.
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
            buttons: function!("dhdGetButtonMask"),
            status: function!("dhdGetStatus"),
            name: function!("dhdGetSystemName"),
            last_error: function!("dhdErrorGetLast"),
            last_error_text: function!("dhdErrorGetLastStr"),
        })
    }

    pub(super) fn count(&self) -> usize {
        usize::try_from((self.count)()).unwrap_or(0)
    }

    /// Opens device `number`, from zero on.
    pub(super) fn open(&self, number: usize) -> Result<Opened, OpenError> {
        let there = self.count();
        let wanted = c_char::try_from(number).ok().filter(|_| number < there);
        let wanted = wanted.ok_or(OpenError::NoSuchDevice {
            kind: Kind::ForceDimension,
            there,
            wanted: number + 1,
        })?;
        match (self.open)(wanted) {
            id @ 0..=127 => Ok(Opened {
                functions: *self,
                id: id as c_char,
            }),
            _ => Err(OpenError::NotOpened {
                kind: Kind::ForceDimension,
                what: self.said(),
            }),
        }
    }

    fn said(&self) -> String {
        // SAFETY: a text of the library, which ends with a zero and stays until its next error.
        let said = unsafe { text((self.last_error_text)()) };
        match said.is_empty() {
            true => format!("error {}", (self.last_error)()),
            false => said,
        }
    }
}

impl Opened {
    pub(super) fn close(&self) {
        (self.functions.close)(self.id);
    }

    pub(super) fn name(&self) -> String {
        // SAFETY: a text of the library, which ends with a zero and stays while the device is open.
        unsafe { text((self.functions.name)(self.id)) }
    }

    /// Its forces are on from now on, but never above `most` [N].
    pub(super) fn enable_forces(&self, most: f64) -> Result<(), i32> {
        self.checked((self.functions.set_max_force)(most, self.id))?;
        self.checked((self.functions.enable_force)(1, self.id))
    }

    pub(super) fn disable_forces(&self) {
        (self.functions.enable_force)(0, self.id);
    }

    /// Hands `force` [N] over, in the library's axes. That motors are at their end is no error.
    pub(super) fn set_force(&self, force: &Vec3) -> Result<(), i32> {
        self.checked((self.functions.set_force)(
            force.x, force.y, force.z, self.id,
        ))
    }

    /// [m], in the library's axes.
    pub(super) fn position(&self) -> Result<Vec3, i32> {
        let [mut x, mut y, mut z] = [f64::NAN; 3];
        let answer = (self.functions.position)(&raw mut x, &raw mut y, &raw mut z, self.id);
        self.checked(answer)?;
        Ok(Vec3::new(x, y, z))
    }

    /// Row by row, in the library's axes.
    pub(super) fn frame(&self) -> Result<[[f64; 3]; 3], i32> {
        let mut frame = [[f64::NAN; 3]; 3];
        self.checked((self.functions.frame)(&raw mut frame, self.id))?;
        Ok(frame)
    }

    pub(super) fn buttons(&self) -> u32 {
        (self.functions.buttons)(self.id)
    }

    pub(super) fn status(&self) -> Result<Status, i32> {
        let mut states = [0; STATES];
        self.checked((self.functions.status)(states.as_mut_ptr(), self.id))?;
        Ok(Status {
            powered: states[POWER] != 0,
            connected: states[CONNECTED] != 0,
            started: states[STARTED] != 0,
            error: states[ERROR] != 0,
            force_off_cause: states[FORCE_OFF_CAUSE],
        })
    }

    /// An answer below zero is an error, whose number the library keeps.
    fn checked(&self, answer: c_int) -> Result<(), i32> {
        match answer {
            0.. => Ok(()),
            _ => Err((self.functions.last_error)()),
        }
    }
}
