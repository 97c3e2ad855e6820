//! The latest value from one thread to another: neither thread ever waits, and values between two reads are lost. Three
//! buffers; writer and reader always own one each.

use triple_buffer::{Input, Output, triple_buffer};

/// The writer's end.
pub struct Sender<T: Send>(Input<T>);

/// The reader's end.
pub struct Receiver<T: Send>(Output<T>);

/// Both ends; the reader gets `first` until a value is sent.
pub fn channel<T: Clone + Send>(first: &T) -> (Sender<T>, Receiver<T>) {
    let (input, output) = triple_buffer(first);
    (Sender(input), Receiver(output))
}

impl<T: Send> Sender<T> {
    /// Sends a value.
    pub fn send(&mut self, value: T) {
        self.0.write(value);
    }

    /// Sends the value that `fill` makes from an older one, so that its memory is reused and nothing is allocated.
    pub fn send_with(&mut self, fill: impl FnOnce(&mut T)) {
        fill(self.0.input_buffer_mut());
        self.0.publish();
    }
}

impl<T: Send> Receiver<T> {
    /// The latest value.
    pub fn latest(&mut self) -> &T {
        self.0.read()
    }

    /// Whether there is a value that has not been read.
    pub fn has_update(&self) -> bool {
        self.0.updated()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A read never mixes two values.
    #[test]
    fn values_arrive_whole_and_in_order() {
        let (mut sender, mut receiver) = channel(&[0u64; 64]);
        let writer = std::thread::spawn(move || {
            for number in 1..=20_000 {
                sender.send([number; 64]);
            }
        });
        let mut last = 0;
        while last < 20_000 {
            let value = *receiver.latest();
            assert!(value.iter().all(|&part| part == value[0]));
            assert!(value[0] >= last);
            last = value[0];
        }
        writer.join().unwrap();
    }
}
