use super::super::text::{lines, number};
use super::header::{Element, Encoding, Header, Scalar};
use crate::ReadFault;

/// The values after the header, one at a time, each as `f64`: it holds every integer of a PLY file.
pub(super) enum Values<'a> {
    Text {
        words: Box<dyn Iterator<Item = (usize, String)> + 'a>,
        /// The line that the last word was on, from one.
        line: usize,
    },
    Binary {
        bytes: &'a [u8],
        next: usize,
        swapped: bool,
    },
}

impl<'a> Values<'a> {
    pub(super) fn after(header: &Header, bytes: &'a [u8]) -> Self {
        match header.encoding {
            Encoding::Text => {
                let first = header.end_line;
                let words = lines(&bytes[header.end..]).flat_map(move |(number, line)| {
                    let words: Vec<_> = line
                        .split_ascii_whitespace()
                        .map(|word| (first + number - 1, word.to_owned()))
                        .collect();
                    words
                });
                Self::Text {
                    words: Box::new(words),
                    line: first,
                }
            }
            encoding => Self::Binary {
                bytes,
                next: header.end,
                swapped: encoding == Encoding::BigEndian,
            },
        }
    }

    pub(super) fn next(&mut self, scalar: Scalar) -> Result<f64, ReadFault> {
        match self {
            Self::Text { words, line } => {
                let (at, word) = words.next().ok_or(ReadFault::EndsEarly {
                    line: *line,
                    expected: "a number",
                })?;
                *line = at;
                number(Some(&word), at)
            }
            Self::Binary {
                bytes,
                next,
                swapped,
            } => {
                let end = *next + scalar.bytes();
                let raw = bytes.get(*next..end).ok_or(ReadFault::Truncated {
                    what: "the table of faces or vertices",
                    expected: end as u64,
                    found: bytes.len() as u64,
                })?;
                *next = end;
                let mut little = [0; 8];
                little[..raw.len()].copy_from_slice(raw);
                if *swapped {
                    little[..raw.len()].reverse();
                }
                Ok(decode(little, scalar))
            }
        }
    }
}

/// Refuses a count that the rest of the file cannot hold, before anything is made of that size.
pub(super) fn check_size(element: &Element, header: &Header, file: &[u8]) -> Result<(), ReadFault> {
    let row: u64 = element
        .properties
        .iter()
        .map(|p| match header.encoding {
            // A digit and a space.
            Encoding::Text => 2,
            _ => p.length.unwrap_or(p.value).bytes() as u64,
        })
        .sum();
    let expected = row.saturating_mul(element.count).saturating_sub(1);
    if expected > (file.len() - header.end) as u64 {
        return Err(ReadFault::Truncated {
            what: "the table of faces or vertices",
            expected: expected.saturating_add(header.end as u64),
            found: file.len() as u64,
        });
    }
    Ok(())
}

fn decode(little: [u8; 8], scalar: Scalar) -> f64 {
    let whole = u64::from_le_bytes(little);
    match scalar {
        Scalar::I8 => f64::from(whole as u8 as i8),
        Scalar::U8 => f64::from(whole as u8),
        Scalar::I16 => f64::from(whole as u16 as i16),
        Scalar::U16 => f64::from(whole as u16),
        Scalar::I32 => f64::from(whole as u32 as i32),
        Scalar::U32 => f64::from(whole as u32),
        Scalar::F32 => f64::from(f32::from_bits(whole as u32)),
        Scalar::F64 => f64::from_bits(whole),
    }
}
