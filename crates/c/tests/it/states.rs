//! States that are copied, restored, begun anew and used by several threads.

use palpate_c::*;

use crate::calling::{CUBE_UNDER_A_HOOK, HEMISPHERE, Hand, Model, NOBODY, at};

/// The forces of a slide [N], and where the organ is in the end [m].
fn slide(hand: &mut Hand) -> (Vec<[f64; 3]>, Vec<f64>) {
    let places = (0..50).map(|k| at([2e-4 * f64::from(k), 0.0, 0.047]));
    let forces = places.map(|pose| hand.go(&[pose])[0].force_n).collect();
    (forces, hand.shape().vertices)
}

#[test]
fn a_restored_state_goes_on_as_the_first_time() {
    let model = Model::new(HEMISPHERE);
    let mut hand = Hand::new(&model);
    let force = hand.go(&[at([0.0, 0.0, 0.046])])[0].force_n;
    assert!(force[2] > 0.01, "{force:?}");
    let kept = hand.cloned();
    let first = slide(&mut hand);
    assert_eq!(slide(&mut kept.cloned()), first);
    let elsewhere = slide(&mut hand);
    assert_ne!(elsewhere, first);
    hand.restore(&kept);
    assert_eq!(slide(&mut hand), first);
}

#[test]
fn a_state_outlives_its_simulation() {
    let model = Model::new(HEMISPHERE);
    let mut hand = Hand::new(&model);
    drop(model);
    assert!(slide(&mut hand).0.iter().all(|force| force[2] > 0.0));
}

#[test]
fn a_reset_state_begins_anew() {
    let model = Model::new(HEMISPHERE);
    let mut hand = Hand::new(&model);
    let first = slide(&mut hand);
    // SAFETY: a state.
    assert_eq!(
        unsafe { palpate_state_reset(hand.state) },
        Status::PalpateOk
    );
    assert_eq!(hand.shape(), model.surface());
    hand.time = 0.0;
    assert_eq!(slide(&mut hand), first);
}

#[test]
fn threads_share_a_model() {
    let model = Model::new(HEMISPHERE);
    let alone = slide(&mut Hand::new(&model));
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4)
            .map(|_| scope.spawn(|| slide(&mut Hand::new(&model))))
            .collect();
        for thread in threads {
            assert_eq!(thread.join().unwrap(), alone);
        }
    });
}

/// Triangles have another version whenever they are others, also when cuts are taken back and states are restored.
#[test]
fn versions_tell_triangles_apart() {
    let model = Model::new(CUBE_UNDER_A_HOOK);
    let mut hand = Hand::new(&model);
    let whole = hand.shape();
    assert_eq!(whole.version, 0);
    assert_eq!(whole, model.surface());
    let uncut = hand.cloned();
    assert!(hand.cut_along(0.0) & PALPATE_EVENT_CUT != 0);
    let first = hand.shape();
    assert!(first.version != 0 && first.corners.len() > whole.corners.len());
    let once = hand.cloned();
    hand.restore(&uncut);
    assert_eq!(hand.shape().version, 0);
    // As many steps, elsewhere.
    hand.cut_along(0.02);
    let second = hand.shape();
    assert_ne!(second.corners, first.corners);
    assert_ne!(second.version, first.version);
    hand.restore(&once);
    let again = hand.shape();
    assert_eq!(
        (&again.corners, &again.vertices),
        (&first.corners, &first.vertices)
    );
    assert!(again.version != second.version);

    // SAFETY: a state.
    assert_eq!(
        unsafe { palpate_state_undo_cut(hand.state) },
        Status::PalpateOk
    );
    assert_eq!(hand.shape(), again, "it is closed in the next step");
    let events = hand.go(&[NOBODY])[0].events;
    assert_eq!(events, PALPATE_EVENT_UNDO_CUT);
    assert_eq!(hand.shape().corners, whole.corners);
    assert_eq!(hand.shape().version, 0);
    // SAFETY: a state.
    unsafe { palpate_state_undo_cut(hand.state) };
    assert_eq!(hand.go(&[NOBODY])[0].events, 0, "there was none");
}
