//! A tick with a library allocates nothing, once it is warm. One with a service does: its messages are texts.

use assert_no_alloc::{AllocDisabler, assert_no_alloc, reset_violation_count, violation_count};

use crate::libraries::{BOTH, library, pressed};

#[global_allocator]
static COUNTING: AllocDisabler = AllocDisabler;

#[test]
fn a_tick_with_a_library_allocates_nothing() {
    for kind in BOTH {
        let (library, places) = library(kind);
        let (mut servo, _) = pressed(&library, kind.open(0, &places).unwrap());
        // The switches of the stand-in are looked up by name the first time.
        assert!((0..100).all(|_| servo.tick().is_ok()));
        reset_violation_count();
        let answered = assert_no_alloc(|| (0..1000).all(|_| servo.tick().is_ok()));
        assert!(answered);
        assert_eq!(violation_count(), 0, "{kind}");
        servo.end();
    }
}
