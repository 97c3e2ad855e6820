//! A panic in a tick takes the force off first, and is reported afterwards.
//!
//! Rust calls the panic hook of the program before it unwinds. A hook that prints a backtrace takes tens of
//! milliseconds, and the device would display its last force meanwhile. So this module stores a panic in a tick, and
//! calls the hook after the device is disabled.
//!
//! *How we know*: `hosts::a_panic_takes_the_force_off_before_it_is_reported`.

use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

thread_local! {
    static TICKING: Cell<bool> = const { Cell::new(false) };
    static DEFERRED: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// A panic that is not reported yet.
#[derive(Debug)]
pub(crate) struct Panic(Option<String>);

impl Panic {
    /// Reports it through the program's panic hook.
    pub(crate) fn report(self) {
        if let Some(message) = self.0 {
            // Only to call the hook.
            let _ = catch_unwind(|| std::panic::panic_any(message));
        }
    }
}

/// Installs the hook that defers panics in ticks, once for the program; every host of ticks calls it first.
pub(crate) fn prepare() {
    static PREPARED: Once = Once::new();
    PREPARED.call_once(|| {
        let hook = take_hook();
        set_hook(Box::new(move |panic| {
            let is_first = DEFERRED.with_borrow(Option::is_none);
            match TICKING.get() && is_first {
                true => DEFERRED.set(Some(panic.to_string())),
                // A second panic while the first unwinds ends the program, and is reported at once.
                false => hook(panic),
            }
        }));
    });
}

/// The result of `tick`; its panic is an error.
pub(crate) fn catch_panic<T>(tick: impl FnOnce() -> T) -> Result<T, Panic> {
    let was_ticking = TICKING.replace(true);
    let ticked = catch_unwind(AssertUnwindSafe(tick));
    TICKING.set(was_ticking);
    ticked.map_err(|_| Panic(DEFERRED.take()))
}
