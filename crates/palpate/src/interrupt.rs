//! Ctrl-C, SIGTERM and the end of the terminal (SIGHUP) are treated alike. A command that can stop cleanly receives a
//! request to stop; a command that writes its files at its end is ended between files, never within one.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Barrier, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

use signal_hook::consts::{SIGINT, SIGTERM};

use crate::failure::Failure;
use crate::output;

/// Whether a signal ends the command between files, without a request to stop.
static ENDS_ITSELF: AtomicBool = AtomicBool::new(false);

/// Polling interval of a command that ends between files.
const LOOK: Duration = Duration::from_millis(20);

/// Whether a stop is requested. The first call installs the handlers; after it no signal ends the command by itself.
pub(crate) fn is_requested() -> bool {
    was_sent() && !ENDS_ITSELF.load(Ordering::Relaxed)
}

/// Whether a signal came since the first call.
fn was_sent() -> bool {
    static SENT: OnceLock<Arc<AtomicBool>> = OnceLock::new();
    let sent = SENT.get_or_init(|| {
        let sent = Arc::new(AtomicBool::new(false));
        for signal in signals() {
            // Without a handler the signal ends the program at once, which leaves files that say so.
            let _ = signal_hook::flag::register(signal, sent.clone());
        }
        sent
    });
    sent.load(Ordering::Relaxed)
}

#[cfg(unix)]
fn signals() -> Vec<i32> {
    use signal_hook::consts::SIGHUP;
    let mut signals = vec![SIGINT, SIGTERM];
    // Started by `nohup` it goes on without its terminal.
    if !is_ignored(SIGHUP) {
        signals.push(SIGHUP);
    }
    signals
}

#[cfg(not(unix))]
fn signals() -> Vec<i32> {
    vec![SIGINT, SIGTERM]
}

/// Whether the program was started with a signal that is ignored, where the system says so (Linux).
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

/// Locked while a file is written.
static WRITING: Mutex<()> = Mutex::new(());

/// Exit status after a signal: a failure.
const INTERRUPTED: i32 = 1;

/// After this call a signal lets the current file be completed, then ends the program with `sentence`. Where the
/// system gives no thread for this, a signal ends the program at once.
pub(crate) fn ends_between_files(sentence: impl Into<String>) {
    let sentence = sentence.into();
    let begins = Arc::new(Barrier::new(2));
    let begun = begins.clone();
    let wait = move || {
        begun.wait();
        while !was_sent() {
            std::thread::sleep(LOOK);
        }
        let _between = WRITING.lock().unwrap_or_else(PoisonError::into_inner);
        // Nothing is dropped at this exit.
        palpate_files::remove_claims();
        output::error(&Failure::failed(sentence));
        std::process::exit(INTERRUPTED);
    };
    if std::thread::Builder::new().spawn(wait).is_err() {
        output::warnings(&[
            "the system gives no thread; Ctrl-C ends the command at once, also within a file"
                .to_owned(),
        ]);
        return;
    }
    // Signals are caught from here on, and not before the thread listens.
    ENDS_ITSELF.store(true, Ordering::Relaxed);
    was_sent();
    begins.wait();
}

/// While it lives, a signal does not end the command.
pub(crate) struct UninterruptedSection {
    _lock: MutexGuard<'static, ()>,
}

impl UninterruptedSection {
    pub(crate) fn begin() -> Self {
        Self {
            _lock: WRITING.lock().unwrap_or_else(PoisonError::into_inner),
        }
    }
}
