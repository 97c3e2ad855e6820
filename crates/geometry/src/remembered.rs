use std::cell::RefCell;

use crate::Vec3;

/// No place.
const NOWHERE: Vec3 = Vec3::new(f64::NAN, f64::NAN, f64::NAN);

/// A place [m] and the answer there.
type Slot = (Vec3, f64);

/// Slots at first, by how much they become more when all were filled anew, and the most, of 32 MB.
const FEW: usize = 1 << 12;
const MORE: usize = 4;
const MOST: usize = 1 << 20;

/// A function of places that is asked for the same ones again and again: recent answers are kept.
pub(crate) struct Remembered<F> {
    of: F,
    kept: RefCell<Kept>,
}

struct Kept {
    /// Each at a hash of its place.
    slots: Vec<Slot>,
    /// How many were filled since there are as many.
    filled: usize,
}

impl<F: Fn(&Vec3) -> f64> Remembered<F> {
    pub(crate) fn new(of: F) -> Self {
        let slots = vec![(NOWHERE, 0.0); FEW];
        let kept = RefCell::new(Kept { slots, filled: 0 });
        Self { of, kept }
    }

    pub(crate) fn at(&self, place: &Vec3) -> f64 {
        let mut kept = self.kept.borrow_mut();
        let Kept { slots, filled } = &mut *kept;
        if *filled > slots.len() && slots.len() < MOST {
            *slots = vec![(NOWHERE, 0.0); MORE * slots.len()];
            *filled = 0;
        }
        let hash = place.iter().fold(0_u64, |hash, coordinate| {
            // Multiplicative hashing [Knuth 1998].
            (hash.rotate_left(21) ^ coordinate.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        });
        let slot = (hash >> 32) as usize & (slots.len() - 1);
        let (known, answer) = &mut slots[slot];
        if known != place {
            (*known, *answer) = (*place, (self.of)(place));
            *filled += 1;
        }
        *answer
    }
}
