//! A library that stands for `libnidaqmx`: a small C file, compiled when it is asked for.

#![allow(
    unsafe_code,
    reason = "functions of a library that is loaded at run time"
)]

use std::ffi::c_int;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

const SOURCE: &str = include_str!("../libraries/nidaqmx.c");

/// A library that was made, and its switches.
pub struct DaqStandIn {
    path: PathBuf,
    library: libloading::Library,
}

impl DaqStandIn {
    /// Compiles it into `folder`. Each folder's has a state of its own.
    ///
    /// # Errors
    /// When there is no C compiler (`cc`).
    pub fn build(folder: &Path) -> io::Result<Self> {
        let file = folder.join("nidaqmx.c");
        let path = folder.join("libnidaqmx-stand-in.so");
        std::fs::write(&file, SOURCE)?;
        let compiled = Command::new("cc")
            .args(["-O1", "-shared", "-fPIC", "-o"])
            .args([&path, &file])
            .output()?;
        if !compiled.status.success() {
            let said = String::from_utf8_lossy(&compiled.stderr).into_owned();
            return Err(io::Error::other(said));
        }
        // SAFETY: its initialisation is that of a C library without any of its own.
        let library = unsafe { libloading::Library::new(&path) }.map_err(io::Error::other)?;
        Ok(Self { path, library })
    }

    /// Its file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The six voltages [V].
    pub fn set_volts(&self, volts: &[f64; 6]) {
        // SAFETY: it takes six numbers, as the C file has it.
        unsafe {
            self.function::<unsafe extern "C" fn(*const f64)>("stand_in_volts")(volts.as_ptr())
        };
    }

    /// Every reading fails with this number; 0 for none.
    pub fn fail(&self, code: i32) {
        // SAFETY: it takes an int, as the C file has it.
        unsafe { self.function::<unsafe extern "C" fn(c_int)>("stand_in_fail")(code) };
    }

    /// No reading comes back until this is false again.
    pub fn hang(&self, hangs: bool) {
        // SAFETY: it takes an int, as the C file has it.
        unsafe {
            self.function::<unsafe extern "C" fn(c_int)>("stand_in_hang")(c_int::from(hangs));
        }
    }

    /// Tasks that were not cleared.
    pub fn tasks(&self) -> i32 {
        // SAFETY: it takes nothing and returns an int, as the C file has it.
        unsafe { self.function::<unsafe extern "C" fn() -> c_int>("stand_in_tasks")() }
    }

    /// A function of the C file.
    ///
    /// # Safety
    /// `F` has to be the type of a pointer to it.
    unsafe fn function<F: Copy>(&self, name: &'static str) -> F {
        // SAFETY: the caller vouches for the type.
        let found = unsafe { self.library.get::<F>(name.as_bytes()) };
        *found.unwrap_or_else(|_| panic!("the stand-in has no function {name}"))
    }
}
