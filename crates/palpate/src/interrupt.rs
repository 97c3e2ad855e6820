//! Ctrl-C. What can stop in good order is asked to; a command that writes its files at its end is ended
//! between files, never within one.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, Once, PoisonError};

static ASKED: AtomicBool = AtomicBool::new(false);

/// Whether Ctrl-C was pressed. From the first question on it ends nothing by itself.
pub(crate) fn is_asked() -> bool {
    static LISTENING: Once = Once::new();
    LISTENING.call_once(|| {
        // Without a handler Ctrl-C ends the program at once, which sessions survive as well.
        let _ = ctrlc::set_handler(|| ASKED.store(true, Ordering::Relaxed));
    });
    ASKED.load(Ordering::Relaxed)
}

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
