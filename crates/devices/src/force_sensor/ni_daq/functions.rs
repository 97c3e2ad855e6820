//! The required functions of `libnidaqmx`, as declared in `NIDAQmx.h`.

#![allow(
    unsafe_code,
    reason = "functions of a library that is loaded at run time"
)]

use std::ffi::{CString, c_char, c_void};
use std::path::Path;
use std::ptr;

use crate::OpenError;
use crate::force_sensor::Gauges;
use crate::library::{Loaded, text};

type Handle = *mut c_void;

const DIFFERENTIAL: i32 = 10_106;
const VOLTS: i32 = 10_348;
const RISING: i32 = 10_280;
const CONTINUOUS: i32 = 10_123;
const BY_SCAN: u32 = 1;
/// The library's number for too few samples within the time.
const TIMED_OUT: i32 = -200_284;
/// Timeout of a reading [s].
const WAITED: f64 = 0.05;
/// Capacity for the text of an error [byte].
const TEXT: usize = 2048;
/// Channels.
const SIX: usize = 6;

/// `libnidaqmx`, loaded.
#[derive(Clone, Copy)]
pub(super) struct Functions {
    create: extern "system" fn(*const c_char, *mut Handle) -> i32,
    add_voltages: extern "system" fn(
        Handle,
        *const c_char,
        *const c_char,
        i32,
        f64,
        f64,
        i32,
        *const c_char,
    ) -> i32,
    set_clock: extern "system" fn(Handle, *const c_char, f64, i32, i32, u64) -> i32,
    start: extern "system" fn(Handle) -> i32,
    read: extern "system" fn(Handle, i32, f64, u32, *mut f64, u32, *mut i32, *mut u32) -> i32,
    stop: extern "system" fn(Handle) -> i32,
    clear: extern "system" fn(Handle) -> i32,
    error: extern "system" fn(*mut c_char, u32) -> i32,
}

impl Functions {
    pub(super) fn load(named: Option<&Path>) -> Result<Self, OpenError> {
        let names = match cfg!(windows) {
            true => &["nicaiu.dll"][..],
            false => &["libnidaqmx.so", "libnidaqmx.so.1"],
        };
        let library = Loaded::load(names, named).map_err(|missing| OpenError::NoSensorLibrary {
            names: missing.names,
            cause: missing.cause,
        })?;
        macro_rules! function {
            ($name:literal) => {{
                // SAFETY: the types are those of `NIDAQmx.h`; all of them are declared for C.
                let found = unsafe { library.function($name) };
                found.ok_or_else(|| OpenError::NoSensorFunction {
                    library: library.name().to_owned(),
                    function: $name,
                })?
            }};
        }
        Ok(Self {
            create: function!("DAQmxCreateTask"),
            add_voltages: function!("DAQmxCreateAIVoltageChan"),
            set_clock: function!("DAQmxCfgSampClkTiming"),
            start: function!("DAQmxStartTask"),
            read: function!("DAQmxReadAnalogF64"),
            stop: function!("DAQmxStopTask"),
            clear: function!("DAQmxClearTask"),
            error: function!("DAQmxGetExtendedErrorInfo"),
        })
    }

    /// An error for a negative code; positive ones are warnings.
    fn check(&self, code: i32) -> Result<(), OpenError> {
        if code >= 0 {
            return Ok(());
        }
        let mut room = [0 as c_char; TEXT];
        // One byte less than its size: the text then always ends with a zero.
        (self.error)(room.as_mut_ptr(), (TEXT - 1) as u32);
        // SAFETY: the last byte was never given away and is zero.
        let message = unsafe { text(room.as_ptr()) };
        let what = match message.lines().next() {
            Some(line) if !line.is_empty() => line.trim_end_matches('.').to_owned(),
            _ => "no reason".to_owned(),
        };
        Err(OpenError::SensorLibrary { code, what })
    }
}

/// A task that reads six voltages. It stays in the thread that started it.
pub(super) struct Task {
    functions: Functions,
    handle: Handle,
}

/// Capacity for one reading.
pub(super) struct Volts {
    values: Vec<f64>,
}

impl Volts {
    /// For so many scans of six voltages.
    pub(super) fn new(scans: usize) -> Self {
        Self {
            values: vec![0.0; SIX * scans],
        }
    }

    /// The first scans.
    pub(super) fn scans(&self, read: usize) -> impl ExactSizeIterator<Item = &[f64]> {
        self.values[..SIX * read].chunks_exact(SIX)
    }
}

impl Task {
    pub(super) fn start(functions: Functions, gauges: &Gauges) -> Result<Self, OpenError> {
        let mut handle: Handle = ptr::null_mut();
        functions.check((functions.create)(c"".as_ptr(), &raw mut handle))?;
        // From here on the task is cleared, whatever fails.
        let task = Self { functions, handle };
        let channels =
            CString::new(gauges.channels.as_str()).map_err(|_| OpenError::SensorLibrary {
                code: 0,
                what: "a name of channels with a zero in it".to_owned(),
            })?;
        let range = gauges.range;
        functions.check((functions.add_voltages)(
            handle,
            channels.as_ptr(),
            c"".as_ptr(),
            DIFFERENTIAL,
            -range,
            range,
            VOLTS,
            ptr::null(),
        ))?;
        // Capacity for a second, in case the thread is delayed.
        let room = gauges.rate.ceil() as u64;
        let clock = ptr::null();
        functions.check((functions.set_clock)(
            handle,
            clock,
            gauges.rate,
            RISING,
            CONTINUOUS,
            room,
        ))?;
        functions.check((functions.start)(handle))?;
        Ok(task)
    }

    /// Fills `volts` and returns the number of scans; none after the timeout.
    ///
    /// # Errors
    /// The library's number for it.
    pub(super) fn read(&self, volts: &mut Volts) -> Result<usize, i32> {
        let room = volts.values.len();
        let mut read = 0;
        let code = (self.functions.read)(
            self.handle,
            (room / SIX) as i32,
            WAITED,
            BY_SCAN,
            volts.values.as_mut_ptr(),
            room as u32,
            &raw mut read,
            ptr::null_mut(),
        );
        match code {
            TIMED_OUT => Ok(0),
            code if code < 0 => Err(code),
            _ => Ok((read.max(0) as usize).min(room / SIX)),
        }
    }
}

impl Drop for Task {
    fn drop(&mut self) {
        (self.functions.stop)(self.handle);
        (self.functions.clear)(self.handle);
    }
}
