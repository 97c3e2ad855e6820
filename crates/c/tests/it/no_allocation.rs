//! A step that allocates may wait for the allocator longer than it has time.

use assert_no_alloc::{AllocDisabler, assert_no_alloc, reset_violation_count, violation_count};
use palpate_c::Status;

use crate::calling::{HEMISPHERE, Hand, KIDNEY, Model, NOBODY, at};

#[global_allocator]
static COUNTING: AllocDisabler = AllocDisabler;

/// How often a slide of 400 steps allocates; it touches in most of them.
fn allocations(hand: &mut Hand, tools: usize) -> u32 {
    let mut poses = vec![NOBODY; tools];
    reset_violation_count();
    let before = violation_count();
    let touched = assert_no_alloc(|| {
        let steps = (0..400).map(|k| {
            poses[tools - 1] = at([1e-4 * f64::from(k % 100), 0.0, 0.0]);
            poses[tools - 1].position_m[2] = if tools == 1 { 0.047 } else { 0.0 };
            hand.go(&poses)[tools - 1].contact
        });
        steps.filter(|contact| *contact != 0).count()
    });
    assert!(touched > 300, "{touched}");
    violation_count() - before
}

#[test]
fn a_step_allocates_nothing() {
    for (scene, tools) in [(HEMISPHERE, 1), (KIDNEY, 2)] {
        let model = Model::new(scene);
        let mut hand = Hand::new(&model);
        assert_eq!(allocations(&mut hand, tools), 0);
        // Nor does one of a copy, or of a state that was restored.
        let mut copy = Hand::new(&model).cloned();
        assert_eq!(allocations(&mut copy, tools), 0);
        hand.restore(&Hand::new(&model));
        assert_eq!(allocations(&mut hand, tools), 0);
    }
}

/// In a loop a hand may be wrong a thousand times a second.
#[test]
fn a_refused_step_allocates_nothing() {
    let model = Model::new(HEMISPHERE);
    let mut hand = Hand::new(&model);
    hand.go(&[NOBODY]);
    reset_violation_count();
    let before = violation_count();
    assert_no_alloc(|| {
        let nowhere = [at([f64::NAN; 3])];
        assert_eq!(hand.try_at(1.0, &nowhere), Status::PalpateBadInput);
        assert_eq!(hand.try_at(f64::NAN, &nowhere), Status::PalpateBadInput);
    });
    assert_eq!(violation_count() - before, 0);
}
