//! A tick that allocates may wait for the allocator longer than it has time.

use assert_no_alloc::{AllocDisabler, assert_no_alloc, reset_violation_count, violation_count};
use palpate_measure::phantom::Imperfections;
use palpate_measure::{Ended, RigSettings, VirtualSpecimen};

use crate::rig::{RADIUS, rig_on, tissue, usual};

#[global_allocator]
static COUNTING: AllocDisabler = AllocDisabler;

/// Waiting and a whole stimulus, from the way down to the withdrawal, over a specimen with heart and breath. The
/// approach makes room for all that it will see, once.
#[test]
fn a_tick_of_the_rig_allocates_nothing() {
    let specimen = VirtualSpecimen::of_tissue(&tissue(), RADIUS, 8e-3, &mut |_| ()).unwrap();
    let settings = RigSettings::default();
    let mut rig = rig_on(Imperfections::premium(), specimen.alive(3), settings, 1);
    let trajectory = usual();
    let (mut ticks, mut approached) = (0, Ok(Ended::Stopped));
    reset_violation_count();
    assert_no_alloc(|| approached = rig.approach(&mut |_| true));
    assert_eq!(approached, Ok(Ended::Complete));
    // Heights and forces, and their means when it is met, taken and given back.
    let room = violation_count();
    assert!(room <= 8, "{room}");
    reset_violation_count();
    let mut pressed = Ok(Ended::Stopped);
    assert_no_alloc(|| {
        rig.wait(1.0, &mut |_| true).unwrap();
        pressed = rig.press(&trajectory, &mut |_| {
            ticks += 1;
            true
        });
    });
    assert_eq!((pressed, violation_count()), (Ok(Ended::Complete), 0));
    assert!(ticks > 8000);
}
