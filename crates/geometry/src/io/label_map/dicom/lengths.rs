//! Checks the lengths of a file's elements: the DICOM library allocates as much memory as they state.

use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::ops::Range;

use crate::ReadFault;

/// The length of a value that ends with a delimiter.
const UNDEFINED: u32 = u32::MAX;

/// The group of items and of delimiters, which have no value representation.
const ITEM_GROUP: u16 = 0xfffe;
const SEQUENCE_END: u16 = 0xe0dd;

/// With an undefined length, it has compressed fragments as items; any other element of undefined length is a sequence.
const PIXEL_DATA: (u16, u16) = (0x7fe0, 0x0010);

/// Value representations with lengths of two bytes [DICOM PS3.5, 7.1.2].
const SHORT: [&[u8; 2]; 21] = [
    b"AE", b"AS", b"AT", b"CS", b"DA", b"DS", b"DT", b"FL", b"FD", b"IS", b"LO", b"LT", b"PN",
    b"SH", b"SL", b"SS", b"ST", b"TM", b"UI", b"UL", b"US",
];

/// How elements are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    /// Without value representations, little-endian.
    Implicit,
    Explicit,
    /// Explicit and big-endian, which is retired.
    BigEndian,
}

/// An element's header.
struct Header {
    tag: (u16, u16),
    representation: Option<[u8; 2]>,
    /// Of the value [bytes].
    length: u32,
}

impl Header {
    /// Of a number; 1 of anything else [bytes].
    fn value_size(&self) -> u32 {
        match self.representation.as_ref() {
            Some(b"OW" | b"SS" | b"US") => 2,
            Some(b"AT" | b"FL" | b"OF" | b"OL" | b"SL" | b"UL") => 4,
            Some(b"FD" | b"OD" | b"OV" | b"SV" | b"UV") => 8,
            _ => 1,
        }
    }

    fn invalid(&self, why: &str) -> ReadFault {
        let (group, element) = self.tag;
        let length = self.length;
        ReadFault::Dicom {
            cause: format!("element ({group:04X},{element:04X}) has {length} bytes, but {why}"),
        }
    }
}

/// Checks that each element in a part of a file ends within the part and within the item and the sequence that contain it,
/// and that numbers are complete.
pub(super) fn check_lengths(
    file: &mut (impl Read + Seek),
    part: Range<u64>,
    encoding: Encoding,
) -> Result<(), ReadFault> {
    match check(&mut BufReader::new(file), part, encoding) {
        // The parser reports a header that is cut short.
        Err(Fault::Read(error)) if error.kind() == io::ErrorKind::UnexpectedEof => Ok(()),
        Err(Fault::Read(error)) => Err(ReadFault::Unreadable(error)),
        Err(Fault::Length { header, left }) => Err(header.invalid(&format!("{left} are left"))),
        Err(Fault::Partial { header }) => {
            Err(header.invalid(&format!("its values have {} each", header.value_size())))
        }
        Ok(()) => Ok(()),
    }
}

enum Fault {
    Read(io::Error),
    /// Longer than what is left [bytes].
    Length {
        header: Header,
        left: u64,
    },
    /// No whole number of values: the parser takes the rest for the next element.
    Partial {
        header: Header,
    },
}

impl From<io::Error> for Fault {
    fn from(error: io::Error) -> Self {
        Self::Read(error)
    }
}

fn check<R: Read + Seek>(
    file: &mut BufReader<R>,
    part: Range<u64>,
    encoding: Encoding,
) -> Result<(), Fault> {
    let Range { start: mut at, end } = part;
    file.seek(SeekFrom::Start(at))?;
    let mut in_fragments = false;
    // Ends of the items and sequences of stated length that contain the next element.
    let mut ends = vec![end];
    while at < end {
        while ends.pop_if(|end| *end <= at).is_some() {}
        let (header, size) = read_header(file, encoding)?;
        at += size;
        let (group, element) = header.tag;
        if group == ITEM_GROUP {
            in_fragments &= element != SEQUENCE_END;
        }
        if header.length == UNDEFINED {
            in_fragments |= header.tag == PIXEL_DATA;
            continue;
        }
        if !header.length.is_multiple_of(header.value_size()) {
            return Err(Fault::Partial { header });
        }
        let left = ends.last().map_or(0, |end| end.saturating_sub(at));
        if u64::from(header.length) > left {
            return Err(Fault::Length { header, left });
        }
        // The elements of items and sequences are checked one by one.
        let is_sequence = match header.representation.as_ref() {
            _ if group == ITEM_GROUP => !in_fragments,
            Some(representation) => representation == b"SQ",
            None => header.length > 0 && begins_item(file)?,
        };
        let after = at + u64::from(header.length);
        if is_sequence {
            ends.push(after);
        } else {
            file.seek_relative(i64::from(header.length))?;
            at = after;
        }
    }
    Ok(())
}

/// Whether the next four bytes are the tag of an item.
fn begins_item<R: Read + Seek>(file: &mut BufReader<R>) -> io::Result<bool> {
    let mut tag = [0; 4];
    file.read_exact(&mut tag)?;
    file.seek_relative(-4)?;
    Ok(tag == [0xfe, 0xff, 0x00, 0xe0])
}

/// A header, and how many bytes it has.
fn read_header(file: &mut impl Read, encoding: Encoding) -> io::Result<(Header, u64)> {
    let mut number = || -> io::Result<u16> {
        let mut bytes = [0; 2];
        file.read_exact(&mut bytes)?;
        Ok(match encoding {
            Encoding::BigEndian => u16::from_be_bytes(bytes),
            _ => u16::from_le_bytes(bytes),
        })
    };
    let tag = (number()?, number()?);
    let mut header = Header {
        tag,
        representation: None,
        length: 0,
    };
    let mut size = 8;
    if encoding != Encoding::Implicit && tag.0 != ITEM_GROUP {
        let representation = number()?;
        let representation = match encoding {
            Encoding::BigEndian => representation.to_be_bytes(),
            _ => representation.to_le_bytes(),
        };
        header.representation = Some(representation);
        let short = number()?;
        if SHORT.contains(&&representation) {
            header.length = u32::from(short);
            return Ok((header, size));
        }
        size = 12;
    }
    let (first, second) = (u32::from(number()?), u32::from(number()?));
    header.length = match encoding {
        Encoding::BigEndian => first << 16 | second,
        _ => second << 16 | first,
    };
    Ok((header, size))
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    fn element(encoding: Encoding, representation: &[u8; 2], length: u32, value: &[u8]) -> Vec<u8> {
        let mut bytes = match encoding {
            Encoding::BigEndian => vec![0, 8, 0x11, 0x40],
            _ => vec![8, 0, 0x40, 0x11],
        };
        let is_short = SHORT.contains(&representation);
        if encoding != Encoding::Implicit {
            bytes.extend(representation);
            bytes.extend(&[0; 2][..if is_short { 0 } else { 2 }]);
        }
        let is_short = is_short && encoding != Encoding::Implicit;
        bytes.extend(number(encoding, length, if is_short { 2 } else { 4 }));
        bytes.extend(value);
        bytes
    }

    fn number(encoding: Encoding, number: u32, size: usize) -> Vec<u8> {
        match encoding {
            Encoding::BigEndian => number.to_be_bytes()[4 - size..].to_vec(),
            _ => number.to_le_bytes()[..size].to_vec(),
        }
    }

    fn item(encoding: Encoding, length: u32, value: &[u8]) -> Vec<u8> {
        let mut bytes = number(encoding, 0xfffe, 2);
        bytes.extend(number(encoding, 0xe000, 2));
        bytes.extend(number(encoding, length, 4));
        bytes.extend(value);
        bytes
    }

    fn fault(encoding: Encoding, bytes: &[u8]) -> Option<String> {
        let part = 0..bytes.len() as u64;
        let checked = check_lengths(&mut Cursor::new(bytes), part, encoding);
        checked.err().map(|fault| fault.to_string())
    }

    /// Judge: [DICOM PS3.5, 7] by hand.
    #[test]
    fn lengths_beyond_what_contains_them_are_faults() {
        for encoding in [Encoding::Implicit, Encoding::Explicit, Encoding::BigEndian] {
            let text = |length| element(encoding, b"LO", length, b"text");
            let nested = |of_text, of_item| {
                let inner = text(of_text);
                let item = item(encoding, of_item, &inner);
                [element(encoding, b"SQ", item.len() as u32, &item), text(4)].concat()
            };
            let size = text(4).len() as u32;
            for valid in [text(4), nested(4, size), nested(4, UNDEFINED)] {
                assert_eq!(fault(encoding, &valid), None, "{encoding:?}");
            }
            for (invalid, expected) in [
                (text(6), "(0008,1140) has 6 bytes, but 4 are left"),
                (nested(6, size), "(0008,1140) has 6 bytes, but 4 are left"),
                (nested(4, size + 1), "(FFFE,E000) has"),
                (
                    nested(4, size - 4),
                    "(0008,1140) has 4 bytes, but 0 are left",
                ),
                (element(encoding, b"OB", 1 << 31, b"12"), "but 2 are left"),
            ] {
                let found = fault(encoding, &invalid).unwrap();
                assert!(found.contains(expected), "{encoding:?} {found}");
            }
        }
        let half = element(Encoding::Explicit, b"UL", 6, b"123456");
        let found = fault(Encoding::Explicit, &half).unwrap();
        assert!(found.contains("its values have 4 each"), "{found}");
    }
}
