//! A panic in a tick takes the force off first, and is reported then.
//!
//! Rust calls the panic hook of the program before anything is unwound. One that prints a backtrace takes tens of
//! milliseconds, and the device would display its last force meanwhile. So a panic in a tick is kept, and the hook is
//! called when the device is disabled.
//!
//! *How we know*: `hosts::a_panic_takes_the_force_off_before_it_is_reported`.

use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

thread_local! {
    static TICKING: Cell<bool> = const { Cell::new(false) };
    static KEPT: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// A panic that nobody has been told of.
#[derive(Debug)]
pub(crate) struct Panic(Option<String>);

impl Panic {
    /// Has the program's hook tell of it.
    pub(crate) fn report(self) {
        if let Some(what) = self.0 {
            // Only for its hook.
            let _ = catch_unwind(|| std::panic::panic_any(what));
        }
    }
}

/// Has panics in ticks kept, once for the program; whoever ticks calls it before.
pub(crate) fn prepare() {
    static PREPARED: Once = Once::new();
    PREPARED.call_once(|| {
        let hook = take_hook();
        set_hook(Box::new(move |panic| {
            let is_first = KEPT.with_borrow(Option::is_none);
            match TICKING.get() && is_first {
                true => KEPT.set(Some(panic.to_string())),
                // A second one while the first is unwound ends the program, and is told at once.
                false => hook(panic),
            }
        }));
    });
}

/// What `tick` answers; its panic is an error.
pub(crate) fn caught<T>(tick: impl FnOnce() -> T) -> Result<T, Panic> {
    let was_ticking = TICKING.replace(true);
    let ticked = catch_unwind(AssertUnwindSafe(tick));
    TICKING.set(was_ticking);
    ticked.map_err(|_| Panic(KEPT.take()))
}
