//! Every value from one thread to another, in order. The writer never waits: it counts values that do not fit as lost,
//! and the reader can read that count.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use rtrb::{Consumer, Producer, RingBuffer};

/// The writer's end.
pub struct Writer<T> {
    ring: Producer<T>,
    lost: Arc<AtomicU64>,
}

/// The reader's end.
pub struct Reader<T> {
    ring: Consumer<T>,
    lost: Arc<AtomicU64>,
}

/// Both ends of a ring with room for `capacity` values.
pub fn ring<T>(capacity: usize) -> (Writer<T>, Reader<T>) {
    let (producer, consumer) = RingBuffer::new(capacity);
    let lost = Arc::new(AtomicU64::new(0));
    let writer = Writer {
        ring: producer,
        lost: lost.clone(),
    };
    let reader = Reader {
        ring: consumer,
        lost,
    };
    (writer, reader)
}

impl<T> Writer<T> {
    /// Adds a value, or counts it as lost.
    pub fn add(&mut self, value: T) {
        if self.ring.push(value).is_err() {
            self.lost.fetch_add(1, Ordering::Relaxed);
        }
    }
}

impl<T> Reader<T> {
    /// The next value; none if all were read.
    pub fn next_value(&mut self) -> Option<T> {
        self.ring.pop().ok()
    }

    /// The values that are available now, as they are read.
    pub fn drain(&mut self) -> impl Iterator<Item = T> + '_ {
        std::iter::from_fn(|| self.next_value())
    }

    /// Number of values that did not fit.
    pub fn lost(&self) -> u64 {
        self.lost.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_finds_no_room_is_counted() {
        let (mut writer, mut reader) = ring(3);
        (0..5).for_each(|value| writer.add(value));
        assert_eq!(reader.drain().collect::<Vec<_>>(), [0, 1, 2]);
        assert_eq!(reader.lost(), 2);
        writer.add(9);
        assert_eq!(reader.next_value(), Some(9));
        assert_eq!(reader.next_value(), None);
    }
}
