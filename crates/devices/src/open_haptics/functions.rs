//! The required functions of `libHD`, as declared in its interface.
//!
//! All of them are `unsafe` to call, since their types are known from documents alone: the headers of version 3.00.66
//! and the *OpenHaptics Toolkit API Reference Guide*. Each wrapper states why its call is safe; only the wrappers call
//! them.

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

/// The invalid handle.
const INVALID: u32 = 0xFFFF_FFFF;

/// A quantity of the library with `N` numbers. The size belongs to the constant, so that a buffer is never smaller than
/// what the library writes.
#[derive(Clone, Copy)]
struct Quantity<const N: usize>(u32);

const POSITION: Quantity<3> = Quantity(0x2050);
const TRANSFORM: Quantity<16> = Quantity(0x2052);
const USABLE_WORKSPACE: Quantity<6> = Quantity(0x2551);
const NOMINAL_MAX_FORCE: Quantity<1> = Quantity(0x2603);
const NOMINAL_MAX_CONTINUOUS_FORCE: Quantity<1> = Quantity(0x2604);
const CURRENT_FORCE: Quantity<3> = Quantity(0x2700);

const BUTTONS: u32 = 0x2000;
const INKWELL_SWITCH: u32 = 0x2002;
const MODEL: u32 = 0x2501;
const SERIAL: u32 = 0x2504;
const FORCE_OUTPUT: u32 = 0x4000;
const FORCE_RAMPING: u32 = 0x4002;
const CALIBRATION_OK: u32 = 0x5000;
const CALIBRATION_NEEDS_UPDATE: u32 = 0x5001;
/// The bit of the calibration style of a stylus with an inkwell.
const STYLE_INKWELL: u32 = 4;

/// The only call that is permitted at any time.
const HIGHEST_PRIORITY: u16 = 65_535;

/// The results of a callback: call again, or not.
pub(super) const DONE: u32 = 0;
pub(super) const CONTINUE: u32 = 1;

#[derive(Clone, Copy)]
#[repr(C)]
pub(super) struct ErrorInfo {
    pub(super) code: u32,
    pub(super) internal: i32,
    pub(super) device: u32,
}

/// A callback of the scheduler.
pub(super) type Callback = unsafe extern "system" fn(*mut c_void) -> u32;

/// A C long, of the size on this system.
type ULong = std::ffi::c_ulong;

/// `libHD`, loaded.
#[derive(Clone, Copy)]
pub(super) struct Functions {
    pub(super) init_device: unsafe extern "system" fn(*const c_char) -> u32,
    pub(super) disable_device: unsafe extern "system" fn(u32),
    pub(super) make_current: unsafe extern "system" fn(u32),
    pub(super) begin_frame: unsafe extern "system" fn(u32),
    pub(super) end_frame: unsafe extern "system" fn(u32),
    pub(super) error: unsafe extern "system" fn() -> ErrorInfo,
    pub(super) enable: unsafe extern "system" fn(u32),
    pub(super) disable: unsafe extern "system" fn(u32),
    pub(super) doubles: unsafe extern "system" fn(u32, *mut f64),
    pub(super) integers: unsafe extern "system" fn(u32, *mut i32),
    pub(super) booleans: unsafe extern "system" fn(u32, *mut u8),
    pub(super) set_doubles: unsafe extern "system" fn(u32, *const f64),
    pub(super) string: unsafe extern "system" fn(u32) -> *const c_char,
    pub(super) check_calibration: unsafe extern "system" fn() -> u32,
    pub(super) calibration_style: unsafe extern "system" fn() -> u32,
    pub(super) update_calibration: unsafe extern "system" fn(u32),
    pub(super) start_scheduler: unsafe extern "system" fn(),
    pub(super) stop_scheduler: unsafe extern "system" fn(),
    pub(super) schedule: unsafe extern "system" fn(Callback, *mut c_void, u16) -> ULong,
    pub(super) unschedule: unsafe extern "system" fn(ULong),
}

/// The calibration of a device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Calibration {
    Known,
    /// It calibrates on request: its stylus is in the inkwell.
    NeedsUpdate,
    /// A person has to calibrate it.
    NeedsHand,
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
                // SAFETY: parameters and result are those that hdDefines.h, hdDevice.h and hdScheduler.h declare for
                // it: HHD, HDenum and HDerror are 32 bits, HDushort 16, HDboolean 8, HDSchedulerHandle a C long, and
                // HDErrorInfo is three words by value.
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
            disable: function!("hdDisable"),
            doubles: function!("hdGetDoublev"),
            integers: function!("hdGetIntegerv"),
            booleans: function!("hdGetBooleanv"),
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

    /// The worst error since the last call; zero if there is none.
    pub(super) fn last_error(&self) -> u32 {
        let mut last = errors::NONE;
        // The library keeps a stack of errors; a bound, in case it never empties.
        for _ in 0..64 {
            // SAFETY: hdGetError takes nothing, may be called at any time, and returns three words by value.
            let found = unsafe { (self.error)() }.code;
            if found == errors::NONE {
                break;
            }
            last = errors::worse(last, found);
        }
        last
    }

    /// Opens the default device. A handle that comes with an error is closed again.
    pub(super) fn open(&self) -> Result<u32, u32> {
        // SAFETY: hdInitDevice takes the name of a device, or null (HD_DEFAULT_DEVICE) for the default one.
        let handle = unsafe { (self.init_device)(std::ptr::null()) };
        let error = self.last_error();
        if handle == INVALID {
            return Err(error);
        }
        if error != errors::NONE {
            self.close(handle);
            return Err(error);
        }
        // SAFETY: hdMakeCurrentDevice takes a handle of hdInitDevice that was not disabled.
        unsafe { (self.make_current)(handle) };
        Ok(handle)
    }

    /// Closes a device for good, after its scheduler has stopped.
    pub(super) fn close(&self, handle: u32) {
        // SAFETY: hdDisableDevice takes a handle of hdInitDevice; one that it does not know is an error on its stack
        // and no more. The handle is not used again: every caller drops what holds it.
        unsafe { (self.disable_device)(handle) };
    }

    /// Model and serial number.
    pub(super) fn names(&self) -> [String; 2] {
        // SAFETY: hdGetString returns null or a text that ends with a zero and belongs to the library, which is never
        // unloaded; it is copied before any other call.
        [MODEL, SERIAL].map(|which| unsafe { text((self.string)(which)) })
    }

    /// The largest force, and the largest continuous force [N].
    pub(super) fn largest_forces(&self) -> [f64; 2] {
        [NOMINAL_MAX_FORCE, NOMINAL_MAX_CONTINUOUS_FORCE].map(|which| self.read(which)[0])
    }

    /// Least and greatest corner [mm].
    pub(super) fn workspace(&self) -> [f64; 6] {
        self.read(USABLE_WORKSPACE)
    }

    pub(super) fn enable_forces(&self) {
        for what in [FORCE_OUTPUT, FORCE_RAMPING] {
            // SAFETY: hdEnable takes the number of a capability; one that it does not know is an error on its stack.
            unsafe { (self.enable)(what) };
        }
    }

    pub(super) fn disable_forces(&self) {
        // SAFETY: hdDisable takes the number of a capability, as hdEnable does.
        unsafe { (self.disable)(FORCE_OUTPUT) };
    }

    pub(super) fn calibration(&self) -> Calibration {
        // SAFETY: hdCheckCalibration takes nothing and asks the current device.
        match unsafe { (self.check_calibration)() } {
            CALIBRATION_OK => Calibration::Known,
            CALIBRATION_NEEDS_UPDATE => Calibration::NeedsUpdate,
            _ => Calibration::NeedsHand,
        }
    }

    /// Calibrates the device; a calibration that needs an update does so by itself.
    pub(super) fn update_calibration(&self) {
        // SAFETY: hdUpdateCalibration takes one of the styles that hdCheckCalibrationStyle answers, which takes nothing.
        unsafe { (self.update_calibration)((self.calibration_style)()) };
    }

    /// Whether an inkwell calibrates its stylus.
    pub(super) fn has_inkwell(&self) -> bool {
        // SAFETY: hdCheckCalibrationStyle takes nothing and asks the current device.
        unsafe { (self.calibration_style)() & STYLE_INKWELL != 0 }
    }

    /// Begins a frame of `handle`.
    pub(super) fn frame(&self, handle: u32) -> Frame<'_> {
        // SAFETY: hdBeginFrame takes a handle of hdInitDevice that was not disabled; who holds a frame borrows the
        // functions from the device that owns the handle. Frames do not overlap: a frame ends before its caller's next.
        unsafe { (self.begin_frame)(handle) };
        Frame {
            functions: self,
            handle,
        }
    }

    /// Has the scheduler call `callback` with `data` from now on, until it is unscheduled or returns [`DONE`].
    ///
    /// # Safety
    /// `callback` has to take `data` from any thread, for as long as the program runs: the interface does not say when
    /// the last call comes.
    pub(super) unsafe fn schedule(&self, callback: Callback, data: *mut c_void) -> ULong {
        // SAFETY: hdScheduleAsynchronous takes a callback, what it is called with, and a priority of 0 to 65535;
        // hdStartScheduler takes nothing. The caller vouches for callback and data.
        unsafe {
            let number = (self.schedule)(callback, data, HIGHEST_PRIORITY);
            (self.start_scheduler)();
            number
        }
    }

    /// In the order of the vendor's examples.
    pub(super) fn unschedule(&self, number: ULong) {
        // SAFETY: hdStopScheduler takes nothing; hdUnschedule takes a number of hdScheduleAsynchronous, also of a
        // callback that is done, which is an error on its stack at most.
        unsafe {
            (self.stop_scheduler)();
            (self.unschedule)(number);
        }
    }

    fn read<const N: usize>(&self, which: Quantity<N>) -> [f64; N] {
        // The library writes nothing for an unknown quantity.
        let mut found = [f64::NAN; N];
        // SAFETY: hdGetDoublev writes as many doubles as the API Reference lists for the quantity, which its constant
        // has as N; there is room for as many.
        unsafe { (self.doubles)(which.0, found.as_mut_ptr()) };
        found
    }
}

/// An open frame. Dropping it ends it and writes its force to the device: zero, unless one was set.
pub(super) struct Frame<'f> {
    functions: &'f Functions,
    handle: u32,
}

impl Frame<'_> {
    /// [mm]
    pub(super) fn position(&self) -> Vec3 {
        self.functions.read(POSITION).into()
    }

    /// Column by column.
    pub(super) fn transform(&self) -> [f64; 16] {
        self.functions.read(TRANSFORM)
    }

    pub(super) fn buttons(&self) -> i32 {
        let mut buttons = 0;
        // SAFETY: hdGetIntegerv writes one integer for HD_CURRENT_BUTTONS, for which there is room.
        unsafe { (self.functions.integers)(BUTTONS, &raw mut buttons) };
        buttons
    }

    /// Whether the stylus is in its inkwell: public drivers read 0 then. An unknown state counts as held.
    pub(super) fn is_in_inkwell(&self) -> bool {
        let mut switch = 1;
        // SAFETY: hdGetBooleanv writes one byte for HD_CURRENT_INKWELL_SWITCH, for which there is room.
        unsafe { (self.functions.booleans)(INKWELL_SWITCH, &raw mut switch) };
        switch == 0
    }

    /// Sets the force [N] that is written when the frame ends.
    pub(super) fn set_force(&self, force: &Vec3) {
        let force: [f64; 3] = (*force).into();
        let Quantity(which) = CURRENT_FORCE;
        // SAFETY: hdSetDoublev reads three doubles for HD_CURRENT_FORCE, which are there until it returns.
        unsafe { (self.functions.set_doubles)(which, force.as_ptr()) };
    }
}

impl Drop for Frame<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.set_force(&Vec3::zeros());
        }
        // SAFETY: hdEndFrame takes the handle of the frame that has begun, and each frame is ended once.
        unsafe { (self.functions.end_frame)(self.handle) };
    }
}
