//! What comes from C as a pointer: null and crooked ones are refused, the rest is taken at its word.

use std::ffi::{CStr, CString, c_char};

use crate::refused::Refused;

/// A pointer that may be read through or written through, as far as that can be told.
fn checked<T>(pointer: *const T, name: &'static str) -> Result<*const T, Refused> {
    match (pointer.is_null(), pointer.is_aligned()) {
        (true, _) => Err(Refused::Null { name }),
        (_, false) => Err(Refused::NotAUnitVector { name }),
        _ => Ok(pointer),
    }
}

/// What `pointer` points at.
///
/// # Safety
/// A pointer that is neither null nor crooked points at a `T` that stays, and nobody writes there, for `'a`.
pub(crate) unsafe fn borrowed<'a, T>(
    pointer: *const T,
    name: &'static str,
) -> Result<&'a T, Refused> {
    let pointer = checked(pointer, name)?;
    // SAFETY: it is neither null nor crooked; for the rest the caller vouches.
    Ok(unsafe { &*pointer })
}

/// `count` of them, one after the other; with a `count` of zero any pointer will do.
///
/// # Safety
/// As of [`borrowed`], for an array of `count`.
pub(crate) unsafe fn array<'a, T>(
    pointer: *const T,
    count: usize,
    name: &'static str,
) -> Result<&'a [T], Refused> {
    if count == 0 {
        return Ok(&[]);
    }
    let pointer = checked(pointer, name)?;
    // SAFETY: it is neither null nor crooked; for the rest the caller vouches.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// A place for an answer. It is written, never read: C need not have put anything there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Answer<T>(*mut T);

impl<T> Answer<T> {
    /// The place of `count` answers at `pointer`.
    pub(crate) fn at(pointer: *mut T, name: &'static str) -> Result<Self, Refused> {
        checked(pointer, name)?;
        Ok(Self(pointer))
    }

    /// Puts an answer there.
    ///
    /// # Safety
    /// `number` is less than the length of the array there, in which nobody else reads or writes.
    pub(crate) unsafe fn put(self, number: usize, value: T) {
        // SAFETY: it is neither null nor crooked; for the rest the caller vouches.
        unsafe { self.0.add(number).write(value) }
    }
}

/// A text that ends with a zero.
///
/// # Safety
/// A pointer that is not null points at such a text, which stays and in which nobody writes for `'a`.
pub(crate) unsafe fn text<'a>(
    pointer: *const c_char,
    name: &'static str,
) -> Result<&'a str, Refused> {
    let pointer = checked(pointer, name)?;
    // SAFETY: it is not null; for the rest the caller vouches.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map_err(|_| Refused::NotText { name })
}

/// Ends what a handle points at; null is nothing.
///
/// # Safety
/// `handle` is null or came from [`handle`], and nobody uses it any more.
pub(crate) unsafe fn free<T>(handle: *mut T) {
    if !handle.is_null() {
        // SAFETY: it came from a box, and the caller vouches that this is the last that is heard of it.
        drop(unsafe { Box::from_raw(handle) });
    }
}

/// A pointer for C that keeps `value` until it is freed.
pub(crate) fn handle<T>(value: T) -> *mut T {
    Box::into_raw(Box::new(value))
}

/// A text for C; a zero in it becomes a space.
pub(crate) fn text_for_c(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).expect("no zero is left in it")
}
