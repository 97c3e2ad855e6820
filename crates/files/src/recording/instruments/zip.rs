//! ZIP archives without encryption, of at most 65,534 parts, stored or deflated [PKWARE 2022, sections 4.3 to 4.4].
//!
//! A part says how large it is; no more memory is taken than its compressed bytes can fill, and its checksum must fit.

use std::collections::BTreeMap;
use std::io::Read;

use flate2::Crc;
use flate2::read::DeflateDecoder;

/// What a damaged archive suffers from.
type Cause = &'static str;

/// The largest part that is read [bytes].
const MOST_OF_PART: u32 = 1 << 28;
/// Deflate makes no byte into more than 1032 [RFC 1951].
const EXPANSION: u64 = 1032;
/// The record at the end, without its comment [bytes].
const END: usize = 22;

/// The parts of an archive by their names.
pub(super) struct Archive<'b> {
    bytes: &'b [u8],
    parts: BTreeMap<String, Part>,
}

#[derive(Debug, Clone, Copy)]
struct Part {
    local_header: u32,
    compressed: u32,
    size: u32,
    checksum: u32,
    method: u16,
    flags: u16,
}

impl<'b> Archive<'b> {
    pub(super) fn new(bytes: &'b [u8]) -> Result<Self, Cause> {
        let end = end_record(bytes).ok_or("has no end: it is cut short")?;
        let count = number16(bytes, end + 10).unwrap_or(0);
        let mut at = number32(bytes, end + 16).unwrap_or(0) as usize;
        if count == u16::MAX {
            return Err("has more than 65,534 parts, which is not read; save fewer curves");
        }
        let mut parts = BTreeMap::new();
        for _ in 0..count {
            let entry = directory_entry(bytes, at).ok_or("has a damaged list of parts")?;
            at = entry.end;
            parts.insert(entry.name, entry.part);
        }
        // The list ends where the record at the end begins, and each name stands at its part too.
        let archive = Self { bytes, parts };
        let mut each = archive.parts.iter();
        match at == end && each.all(|(name, part)| archive.is_named(part, name)) {
            true => Ok(archive),
            false => Err("has a damaged list of parts"),
        }
    }

    fn is_named(&self, part: &Part, name: &str) -> bool {
        let header = self.bytes.get(part.local_header as usize..);
        let own = header.and_then(|header| {
            header.starts_with(b"PK\x03\x04").then_some(())?;
            header.get(30..)?.get(..number16(header, 26)? as usize)
        });
        own.is_some_and(|own| String::from_utf8_lossy(own) == name)
    }

    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.parts.keys().map(String::as_str)
    }

    /// The content of a part; none when there is no such part.
    pub(super) fn read(&self, name: &str) -> Result<Option<Vec<u8>>, Cause> {
        let Some(part) = self.parts.get(name) else {
            return Ok(None);
        };
        let content = self.content(part)?;
        let mut sum = Crc::new();
        sum.update(&content);
        match sum.sum() == part.checksum {
            true => Ok(Some(content)),
            false => Err("does not have the checksum that it states"),
        }
    }

    fn content(&self, part: &Part) -> Result<Vec<u8>, Cause> {
        if part.flags & 1 != 0 {
            return Err("is encrypted");
        }
        let packed = self.packed(part).ok_or("is cut short")?;
        let most = EXPANSION * (packed.len() as u64 + 1);
        if part.size > MOST_OF_PART || u64::from(part.size) > most {
            return Err("states a size that it cannot have");
        }
        let mut content = Vec::with_capacity(part.size as usize);
        match part.method {
            0 => content.extend_from_slice(packed),
            8 => {
                let mut reader = DeflateDecoder::new(packed).take(u64::from(part.size) + 1);
                let read = reader.read_to_end(&mut content);
                read.map_err(|_| "cannot be decompressed")?;
            }
            _ => return Err("is compressed by another method than deflate"),
        }
        match content.len() == part.size as usize {
            true => Ok(content),
            false => Err("does not have the size that it states"),
        }
    }

    fn packed(&self, part: &Part) -> Option<&'b [u8]> {
        let at = part.local_header as usize;
        let header = self.bytes.get(at..)?;
        let names = number16(header, 26)? as usize + number16(header, 28)? as usize;
        header.get(30 + names..)?.get(..part.compressed as usize)
    }
}

struct DirectoryEntry {
    name: String,
    part: Part,
    /// Where the next one begins.
    end: usize,
}

fn directory_entry(bytes: &[u8], at: usize) -> Option<DirectoryEntry> {
    let entry = bytes.get(at..)?;
    entry.starts_with(b"PK\x01\x02").then_some(())?;
    let [name, extra, comment] = [28, 30, 32].map(|place| number16(entry, place));
    let name_end = 46 + name? as usize;
    Some(DirectoryEntry {
        name: String::from_utf8_lossy(entry.get(46..name_end)?).into_owned(),
        part: Part {
            flags: number16(entry, 8)?,
            method: number16(entry, 10)?,
            checksum: number32(entry, 16)?,
            compressed: number32(entry, 20)?,
            size: number32(entry, 24)?,
            local_header: number32(entry, 42)?,
        },
        end: at + name_end + extra? as usize + comment? as usize,
    })
}

/// Where the record at the end begins; a comment of up to 65,535 bytes may follow it.
fn end_record(bytes: &[u8]) -> Option<usize> {
    let last = bytes.len().checked_sub(END)?;
    let first = last.saturating_sub(usize::from(u16::MAX));
    (first..=last)
        .rev()
        .find(|at| bytes[*at..].starts_with(b"PK\x05\x06"))
}

fn number16(bytes: &[u8], at: usize) -> Option<u16> {
    let bytes = bytes.get(at..)?.first_chunk()?;
    Some(u16::from_le_bytes(*bytes))
}

fn number32(bytes: &[u8], at: usize) -> Option<u32> {
    let bytes = bytes.get(at..)?.first_chunk()?;
    Some(u32::from_le_bytes(*bytes))
}
