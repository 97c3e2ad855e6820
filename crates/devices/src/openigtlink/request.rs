use super::checksum;
use super::message::HEADER;

/// The largest body that is read [B]: requests have none, or a few bytes.
const LARGEST: u64 = 1 << 16;

/// A request of a client.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Request {
    /// Its type, such as `GET_POLYDATA`.
    pub kind: String,
    /// Its device; empty for any.
    pub device: String,
}

/// Bytes of a client, from which requests are read.
#[derive(Debug, Default)]
pub struct Requests {
    bytes: Vec<u8>,
    lost: bool,
}

impl Requests {
    /// Adds received bytes.
    pub fn add(&mut self, bytes: &[u8]) {
        if !self.lost {
            self.bytes.extend(bytes);
        }
    }

    /// Whether the bytes cannot come from a client of this protocol.
    pub fn is_lost(&self) -> bool {
        self.lost
    }

    /// The next complete request. One with a wrong checksum is skipped.
    pub fn next_request(&mut self) -> Option<Request> {
        loop {
            let header: &[u8; HEADER] = self.bytes.first_chunk()?;
            let number = |from: usize| {
                let mut number = [0; 8];
                number.copy_from_slice(&header[from..from + 8]);
                u64::from_be_bytes(number)
            };
            let version = u16::from_be_bytes([header[0], header[1]]);
            let (size, sum) = (number(42), number(50));
            if !(1..=3).contains(&version) || size > LARGEST {
                self.lost = true;
                self.bytes = Vec::new();
                return None;
            }
            let end = HEADER + size as usize;
            let body = self.bytes.get(HEADER..end)?;
            let is_whole = checksum(body) == sum;
            let request = Request {
                kind: name(&header[2..14]),
                device: name(&header[14..34]),
            };
            self.bytes.drain(..end);
            if is_whole {
                return Some(request);
            }
        }
    }
}

/// Up to the first zero, or the end.
fn name(field: &[u8]) -> String {
    let letters = field.iter().take_while(|byte| **byte != 0);
    letters.map(|byte| char::from(*byte)).collect()
}
