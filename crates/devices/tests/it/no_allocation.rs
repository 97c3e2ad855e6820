//! A tick with a library allocates nothing, once it is warm. One with a service does: its messages are texts.

use std::time::Duration;

use assert_no_alloc::{AllocDisabler, assert_no_alloc, reset_violation_count, violation_count};
use palpate_servo::{Command, Vec3};

use crate::libraries::{BOTH, carry_pressing, library};

#[global_allocator]
static COUNTING: AllocDisabler = AllocDisabler;

#[test]
fn an_exchange_with_a_library_allocates_nothing() {
    for kind in BOTH {
        let (library, places, _folder) = library(kind);
        carry_pressing(&library);
        let mut device = kind.open(0, &places).unwrap();
        let mut exchange = |tick: u32| {
            let command = Command {
                time: f64::from(tick) * 1e-3,
                force: Vec3::y() * 0.1,
            };
            device.exchange(&command, Duration::from_millis(1)).is_ok()
        };
        assert!((0..100).all(&mut exchange));
        reset_violation_count();
        let answered = assert_no_alloc(|| (100..1100).all(&mut exchange));
        assert!(answered);
        assert_eq!(violation_count(), 0, "{kind}");
    }
}
