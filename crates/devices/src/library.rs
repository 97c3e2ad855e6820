//! Libraries that are loaded at run time, when a device is opened, so that the build does not need them.

use std::ffi::{CStr, OsString, c_char};
use std::path::Path;

use crate::{Kind, OpenError};

/// A library that stays loaded to the end of the program: its threads may outlive its user.
pub(crate) struct Loaded {
    loaded: &'static libloading::Library,
    name: String,
}

/// A failed load: the file names that were tried, and the error of the system.
pub(crate) struct NotLoaded {
    pub(crate) names: String,
    pub(crate) cause: String,
}

impl Loaded {
    /// Loads the first of `names` that exists, or only `named`.
    pub(crate) fn load(names: &[&str], named: Option<&Path>) -> Result<Self, NotLoaded> {
        let names: Vec<OsString> = match named {
            Some(path) => vec![path.into()],
            None => names.iter().map(Into::into).collect(),
        };
        let mut causes = Vec::new();
        for name in &names {
            match open(name) {
                Ok(loaded) => {
                    return Ok(Self {
                        loaded: Box::leak(Box::new(loaded)),
                        name: name.to_string_lossy().into_owned(),
                    });
                }
                Err(cause) => causes.push(cause),
            }
        }
        let names: Vec<_> = names.iter().map(|name| name.to_string_lossy()).collect();
        Err(NotLoaded {
            names: names.join(" or "),
            cause: one_line(causes.first()),
        })
    }

    /// Its file.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// The function `name`; none when it has no such function.
    ///
    /// # Safety
    /// `F` has to be the type of a pointer to it.
    #[allow(
        unsafe_code,
        reason = "the types of a library's functions are known from its documents only"
    )]
    pub(crate) unsafe fn function<F: Copy>(&self, name: &'static str) -> Option<F> {
        // SAFETY: the caller vouches for the type; the library is never unloaded.
        let found = unsafe { self.loaded.get::<F>(name.as_bytes()) };
        found.ok().map(|symbol| *symbol)
    }
}

/// The library of a kind of haptic device.
pub(crate) struct Library {
    loaded: Loaded,
    kind: Kind,
}

impl Library {
    /// Loads the first of `names` that exists, or only `named`.
    pub(crate) fn load(
        kind: Kind,
        names: &[&str],
        named: Option<&Path>,
    ) -> Result<Self, OpenError> {
        let loaded = Loaded::load(names, named).map_err(|missing| OpenError::NoLibrary {
            kind,
            names: missing.names,
            cause: missing.cause,
        })?;
        Ok(Self { loaded, kind })
    }

    /// The function `name`.
    ///
    /// # Safety
    /// `F` has to be the type of a pointer to it, `unsafe extern "C" fn(…)` or `"system"`.
    #[allow(
        unsafe_code,
        reason = "the types of a library's functions are known from its documents only"
    )]
    pub(crate) unsafe fn function<F: Copy>(&self, name: &'static str) -> Result<F, OpenError> {
        // SAFETY: the caller vouches for the type.
        let found = unsafe { self.loaded.function::<F>(name) };
        found.ok_or_else(|| OpenError::NoFunction {
            kind: self.kind,
            library: self.loaded.name().to_owned(),
            function: name,
        })
    }
}

/// Exports its symbols globally, since device libraries load further libraries that need them.
#[cfg(unix)]
#[allow(unsafe_code, reason = "loading a library runs its initialisation")]
fn open(name: &std::ffi::OsStr) -> Result<libloading::Library, libloading::Error> {
    use libloading::os::unix::{Library, RTLD_GLOBAL, RTLD_LAZY};
    // SAFETY: dlopen runs the library's initialisation, which may do anything. The person at the machine installed the
    // library under its usual name or named its file by a variable of the environment; no document can.
    unsafe { Library::open(Some(name), RTLD_LAZY | RTLD_GLOBAL) }.map(Into::into)
}

#[cfg(not(unix))]
#[allow(unsafe_code, reason = "loading a library runs its initialisation")]
fn open(name: &std::ffi::OsStr) -> Result<libloading::Library, libloading::Error> {
    // SAFETY: LoadLibrary runs the library's initialisation, which may do anything. The person at the machine installed
    // the library under its usual name or named its file by a variable of the environment; no document can.
    unsafe { libloading::Library::new(name) }
}

fn one_line(cause: Option<&libloading::Error>) -> String {
    use std::error::Error;
    let message = cause.map(|cause| {
        cause
            .source()
            .map_or(cause.to_string(), ToString::to_string)
    });
    let message = message.unwrap_or_default();
    message.lines().collect::<Vec<_>>().join(" ")
}

/// Copies a text of a library; empty for null.
///
/// # Safety
/// `text` has to be null, or end with a zero and live for as long as it is read here.
#[allow(unsafe_code, reason = "texts of a library are pointers")]
pub(crate) unsafe fn text(text: *const c_char) -> String {
    if text.is_null() {
        return String::new();
    }
    // SAFETY: it is not null, and the caller vouches for its end and its life; it is copied before this returns.
    let text = unsafe { CStr::from_ptr(text) };
    text.to_string_lossy().trim().to_owned()
}
