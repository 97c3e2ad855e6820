use std::cell::RefCell;

use crate::Vec3;

/// No place.
const NOWHERE: Vec3 = Vec3::new(f64::NAN, f64::NAN, f64::NAN);

/// A place [m] and the value there.
type Slot = (Vec3, f64);

/// Slots at first, by how much they become more when all were filled anew, and the most, of 32 MB.
const FEW: usize = 1 << 12;
const MORE: usize = 4;
const MOST: usize = 1 << 20;

/// A function of places that is called for the same ones again and again, with a cache of recent values.
pub(crate) struct Memoized<F> {
    of: F,
    cache: RefCell<Cache>,
}

struct Cache {
    /// Each at a hash of its place.
    slots: Vec<Slot>,
    /// How many were filled since there are as many.
    filled: usize,
}

impl<F: Fn(&Vec3) -> f64> Memoized<F> {
    pub(crate) fn new(of: F) -> Self {
        let slots = vec![(NOWHERE, 0.0); FEW];
        let cache = RefCell::new(Cache { slots, filled: 0 });
        Self { of, cache }
    }

    pub(crate) fn at(&self, place: &Vec3) -> f64 {
        let mut cache = self.cache.borrow_mut();
        let Cache { slots, filled } = &mut *cache;
        if *filled > slots.len() && slots.len() < MOST {
            *slots = vec![(NOWHERE, 0.0); MORE * slots.len()];
            *filled = 0;
        }
        let hash = place.iter().fold(0_u64, |hash, coordinate| {
            // Multiplicative hashing [Knuth 1998].
            (hash.rotate_left(21) ^ coordinate.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        });
        let slot = (hash >> 32) as usize & (slots.len() - 1);
        let (known, value) = &mut slots[slot];
        if known != place {
            (*known, *value) = (*place, (self.of)(place));
            *filled += 1;
        }
        *value
    }
}
