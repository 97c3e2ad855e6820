//! Ctrl-C in a command that writes its files at its end: it ends the program between files, never
//! within one.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// Held while a file is written.
static WRITING: Mutex<()> = Mutex::new(());

/// Exit status after Ctrl-C: a failure.
const INTERRUPTED: i32 = 1;

/// From now on Ctrl-C waits for files that are being written, then ends the program after `farewell`.
pub(crate) fn ends_between_files(farewell: impl Fn() + Send + 'static) {
    // Without a handler Ctrl-C ends the program at once, which leaves a file beside at worst.
    let _ = ctrlc::set_handler(move || {
        let _between = WRITING.lock().unwrap_or_else(PoisonError::into_inner);
        farewell();
        std::process::exit(INTERRUPTED);
    });
}

/// While it lives, files are written.
pub(crate) struct Unbroken {
    _held: MutexGuard<'static, ()>,
}

impl Unbroken {
    pub(crate) fn begin() -> Self {
        Self {
            _held: WRITING.lock().unwrap_or_else(PoisonError::into_inner),
        }
    }
}
