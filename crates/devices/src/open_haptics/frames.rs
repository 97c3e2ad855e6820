//! What runs in the scheduler's thread, and the ways to it and from it.

#![allow(unsafe_code, reason = "a callback gets its own data as a pointer")]

use std::ffi::{c_ulong, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use palpate_servo::Vec3;
use palpate_servo::latest::{Receiver, Sender, channel};

use super::errors;
use super::functions::{CONTINUE, DONE, Functions, Read};

/// A force that is older is not displayed: whoever sent it hangs.
const FRESH: Duration = Duration::from_millis(20);

/// Frames from one look at the calibration to the next.
const LOOKS: u64 = 10;

/// A force, and when it was sent.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sent {
    force: Vec3,
    when: Instant,
}

/// What a frame told.
#[derive(Debug, Clone, Copy)]
pub(super) struct Told {
    pub(super) read: Read,
    pub(super) calibrated: bool,
}

/// The servo loop's end.
pub(super) struct Frames {
    functions: Functions,
    number: c_ulong,
    forces: Sender<Sent>,
    pub(super) told: Receiver<Option<Told>>,
    error: Arc<AtomicU32>,
    /// Given to the library until it is unscheduled.
    scheduled: *mut Scheduled,
}

// SAFETY: the pointer is only given back to the allocator, after the last callback.
unsafe impl Send for Frames {}

/// The scheduler's end.
struct Scheduled {
    functions: Functions,
    handle: u32,
    forces: Receiver<Sent>,
    told: Sender<Option<Told>>,
    error: Arc<AtomicU32>,
    count: u64,
    calibrated: bool,
}

impl Frames {
    /// Begins to read `handle`.
    pub(super) fn start(functions: Functions, handle: u32) -> Self {
        let (forces, sent) = channel(&Sent {
            force: Vec3::zeros(),
            when: Instant::now(),
        });
        let (tell, told) = channel(&None);
        let error = Arc::new(AtomicU32::new(errors::NONE));
        let scheduled = Box::into_raw(Box::new(Scheduled {
            functions,
            handle,
            forces: sent,
            told: tell,
            error: error.clone(),
            count: 0,
            calibrated: functions.is_calibrated(),
        }));
        Self {
            number: functions.schedule(call, scheduled.cast()),
            functions,
            forces,
            told,
            error,
            scheduled,
        }
    }

    /// The force [N] of the next frames.
    pub(super) fn send(&mut self, force: Vec3) {
        let when = Instant::now();
        self.forces.send(Sent { force, when });
    }

    /// The worst error since the last time.
    pub(super) fn error(&self) -> u32 {
        self.error.swap(errors::NONE, Ordering::AcqRel)
    }
}

impl Drop for Frames {
    fn drop(&mut self) {
        self.functions.unschedule(self.number);
        // SAFETY: it came from a box, and nobody is called with it any more.
        drop(unsafe { Box::from_raw(self.scheduled) });
    }
}

/// The scheduler calls it from one thread, one call at a time.
extern "system" fn call(data: *mut c_void) -> u32 {
    // SAFETY: it is what was given when this was scheduled, and lives until it is unscheduled.
    let scheduled = unsafe { &mut *data.cast::<Scheduled>() };
    // Nothing may unwind into the library.
    match catch_unwind(AssertUnwindSafe(|| scheduled.frame())) {
        Ok(()) => CONTINUE,
        Err(_) => DONE,
    }
}

impl Scheduled {
    fn frame(&mut self) {
        let sent = *self.forces.latest();
        let is_fresh = sent.when.elapsed() < FRESH;
        let is_finite = sent.force.iter().all(|component| component.is_finite());
        let force = match is_fresh && is_finite && self.calibrated {
            true => sent.force,
            false => Vec3::zeros(),
        };
        let read = self.functions.frame(self.handle, &force);
        if self.count.is_multiple_of(LOOKS) {
            self.calibrated = self.functions.is_calibrated();
        }
        self.count += 1;
        let found = self.functions.last_error();
        if found != errors::NONE {
            let worse = |before| Some(errors::worse(before, found));
            // It always stores something.
            let _ = self
                .error
                .fetch_update(Ordering::AcqRel, Ordering::Acquire, worse);
        }
        self.told.send(Some(Told {
            read,
            calibrated: self.calibrated,
        }));
    }
}
