//! The loop in the library's scheduler.
//!
//! The argument of the callback is never freed: the interface says neither that `hdStopScheduler` waits for a running
//! call, nor that none comes after `hdUnschedule`. It is small, and there is one per opened device. Its content, the
//! tick and its device, is dropped once the tick has returned that it was the last. Calls that overlap, or come after
//! that, do nothing.

#![allow(unsafe_code, reason = "a callback gets its own data as a pointer")]

use std::ffi::{c_ulong, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use palpate_servo::{Disabled, Fault, Next, Scheduler, Tick};

use super::errors;
use super::functions::{CONTINUE, DONE, Functions};

/// Timeout for the library to switch forces off.
const DISABLE: Duration = Duration::from_millis(20);

/// How long a waiting thread sleeps.
const NAP: Duration = Duration::from_millis(1);

/// The scheduler of the library.
pub(super) struct OpenHapticsScheduler {
    functions: Functions,
    inside: Arc<AtomicBool>,
    started: Option<Started>,
}

struct Started {
    called: &'static Called,
    number: c_ulong,
}

/// The argument of the callback.
struct Called {
    tick: Mutex<Option<Tick>>,
    /// Whether a call is inside the tick.
    inside: Arc<AtomicBool>,
    /// Whether the tick has returned that it was the last.
    ended: AtomicBool,
}

impl OpenHapticsScheduler {
    pub(super) fn new(functions: Functions, inside: Arc<AtomicBool>) -> Self {
        Self {
            functions,
            inside,
            started: None,
        }
    }
}

/// The callback of the scheduler.
///
/// # Safety
/// `data` has to be a [`Called`] that is never freed.
unsafe extern "system" fn call(data: *mut c_void) -> u32 {
    // SAFETY: the caller passes what it was scheduled with, which is a leaked `Called`; only shared references to it are
    // ever made, and it may be used from any thread.
    let called = unsafe { &*data.cast::<Called>() };
    // No panic may unwind into the library.
    match catch_unwind(AssertUnwindSafe(|| called.tick())) {
        Ok(Next::Continue) => CONTINUE,
        Ok(Next::End) => DONE,
        Err(_) => {
            called.ended.store(true, Ordering::Release);
            DONE
        }
    }
}

impl Called {
    fn tick(&self) -> Next {
        if self.ended.load(Ordering::Acquire) {
            return Next::End;
        }
        // An overlapping call finds it locked, and the scheduler never waits.
        let Ok(mut tick) = self.tick.try_lock() else {
            return Next::Continue;
        };
        let Some(tick) = tick.as_mut() else {
            return Next::End;
        };
        self.inside.store(true, Ordering::Release);
        let next = tick();
        self.inside.store(false, Ordering::Release);
        self.ended.store(next == Next::End, Ordering::Release);
        next
    }
}

impl Started {
    /// Whether the tick returned within `timeout` that it was the last.
    fn ends_within(&self, timeout: Duration) -> bool {
        let until = Instant::now() + timeout;
        while !self.called.ended.load(Ordering::Acquire) {
            if Instant::now() >= until {
                return false;
            }
            std::thread::sleep(NAP);
        }
        true
    }
}

impl Scheduler for OpenHapticsScheduler {
    fn start(&mut self, tick: Tick) -> Result<(), Fault> {
        let called: &'static Called = Box::leak(Box::new(Called {
            tick: Mutex::new(Some(tick)),
            inside: self.inside.clone(),
            ended: AtomicBool::new(false),
        }));
        let data = std::ptr::from_ref(called).cast_mut().cast();
        // SAFETY: `call` takes a `Called` that is never freed, from any thread: `Called` is `Sync`.
        let number = unsafe { self.functions.schedule(call, data) };
        self.started = Some(Started { called, number });
        errors::fault(self.functions.last_error())?;
        Ok(())
    }

    /// No further frame can send zero, but hdDisable needs no frame.
    fn disable(&mut self) -> Disabled {
        disable_within(self.functions, DISABLE);
        Disabled::Unknown
    }

    fn stop(&mut self, timeout: Duration) -> Result<(), Fault> {
        let Some(started) = self.started.take() else {
            return Ok(());
        };
        let hung = Fault::Hung {
            limit: timeout.as_secs_f64(),
        };
        let ended = started.ends_within(timeout);
        if !ended {
            disable_within(self.functions, DISABLE);
        }
        // A library that hangs blocks only this detached thread.
        let (functions, number) = (self.functions, started.number);
        let (stopped, wait) = channel();
        let thread = std::thread::Builder::new().name("openhaptics stop".to_owned());
        let thread = thread.spawn(move || {
            functions.unschedule(number);
            let _ = stopped.send(());
        });
        thread.map_err(|_| Fault::NoThread)?;
        if wait.recv_timeout(timeout).is_err() || !ended {
            return Err(hung);
        }
        // Only this takes it out, and a late call finds none.
        let tick = started
            .called
            .tick
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner)
            .take();
        drop(tick);
        Ok(())
    }
}

/// Switches forces off through the library; if that hangs it blocks only a detached thread.
fn disable_within(functions: Functions, timeout: Duration) {
    let (disabled, wait) = channel();
    let thread = std::thread::Builder::new().name("openhaptics disable".to_owned());
    let spawned = thread.spawn(move || {
        functions.disable_forces();
        let _ = disabled.send(());
    });
    match spawned {
        Ok(_) => drop(wait.recv_timeout(timeout)),
        // The only remaining way.
        Err(_) => functions.disable_forces(),
    }
}

impl Drop for OpenHapticsScheduler {
    fn drop(&mut self) {
        // `stop` returns the result. The device of a tick that did not end stays open.
        let _ = self.stop(Duration::ZERO);
    }
}
