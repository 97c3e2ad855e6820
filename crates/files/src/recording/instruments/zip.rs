//! ZIP archives without encryption, stored or deflated [PKWARE 2022, sections 4.3 to 4.5], with numbers of 64 bits (ZIP64)
//! where those of 16 or 32 bits are at their largest.
//!
//! A part says how large it is; no more memory is taken than its compressed bytes can fill, and its checksum must fit.

use std::collections::BTreeMap;
use std::io::Read;

use flate2::Crc;
use flate2::read::DeflateDecoder;

/// The defect of a damaged archive.
type Cause = &'static str;

/// The largest part that is read [bytes].
const MAX_PART_BYTES: u64 = 1 << 28;
/// Deflate expands a byte to at most 1032 [RFC 1951].
const EXPANSION: u64 = 1032;
/// The record at the end, without its comment; of ZIP64 the record before it and its locator between the two [bytes].
const END: usize = 22;
const END_64: usize = 56;
const LOCATOR_64: usize = 20;
/// The extra field with numbers of 64 bits.
const EXTRA_64: u16 = 1;

/// The parts of an archive by their names.
pub(super) struct Archive<'b> {
    bytes: &'b [u8],
    parts: BTreeMap<String, Part>,
}

#[derive(Debug, Clone, Copy)]
struct Part {
    local_header: u64,
    compressed: u64,
    size: u64,
    checksum: u32,
    method: u16,
    flags: u16,
}

impl<'b> Archive<'b> {
    pub(super) fn new(bytes: &'b [u8]) -> Result<Self, Cause> {
        let directory = Directory::find(bytes).ok_or("has no end: it is cut short")?;
        let mut at = usize::try_from(directory.at).unwrap_or(usize::MAX);
        let mut parts = BTreeMap::new();
        for _ in 0..directory.count {
            let entry = directory_entry(bytes, at).ok_or("has a damaged list of parts")?;
            at = entry.end;
            parts.insert(entry.name, entry.part);
        }
        // The list ends where the record at the end begins, and each name stands at its part too.
        let archive = Self { bytes, parts };
        let mut each = archive.parts.iter();
        match at == directory.end && each.all(|(name, part)| archive.is_named(part, name)) {
            true => Ok(archive),
            false => Err("has a damaged list of parts"),
        }
    }

    fn is_named(&self, part: &Part, name: &str) -> bool {
        let header = self.from(part.local_header);
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
        if part.size > MAX_PART_BYTES || part.size > most {
            return Err("states a size that it cannot have");
        }
        let mut content = Vec::with_capacity(part.size as usize);
        match part.method {
            0 => content.extend_from_slice(packed),
            8 => {
                let mut reader = DeflateDecoder::new(packed).take(part.size + 1);
                let read = reader.read_to_end(&mut content);
                read.map_err(|_| "cannot be decompressed")?;
            }
            _ => return Err("is compressed by another method than deflate"),
        }
        match content.len() as u64 == part.size {
            true => Ok(content),
            false => Err("does not have the size that it states"),
        }
    }

    fn packed(&self, part: &Part) -> Option<&'b [u8]> {
        let header = self.from(part.local_header)?;
        let names = number16(header, 26)? as usize + number16(header, 28)? as usize;
        let compressed = usize::try_from(part.compressed).ok()?;
        header.get(30 + names..)?.get(..compressed)
    }

    fn from(&self, at: u64) -> Option<&'b [u8]> {
        self.bytes.get(usize::try_from(at).ok()?..)
    }
}

/// The list of all parts.
struct Directory {
    at: u64,
    count: u64,
    /// Where the record after the list begins.
    end: usize,
}

impl Directory {
    fn find(bytes: &[u8]) -> Option<Self> {
        let end = end_record(bytes)?;
        let Some(locator) = locator_64(bytes, end) else {
            return Some(Self {
                at: number32(bytes, end + 16)?.into(),
                count: number16(bytes, end + 10)?.into(),
                end,
            });
        };
        let end = usize::try_from(number64(locator, 8)?).ok()?;
        let record = bytes.get(end..)?;
        record.starts_with(b"PK\x06\x06").then_some(())?;
        record.get(..END_64)?;
        Some(Self {
            at: number64(record, 48)?,
            count: number64(record, 32)?,
            end,
        })
    }
}

/// The bytes from the locator of ZIP64 on; none where there is none before the record at the end.
fn locator_64(bytes: &[u8], end: usize) -> Option<&[u8]> {
    let own = bytes.get(end.checked_sub(LOCATOR_64)?..)?;
    own.starts_with(b"PK\x06\x07").then_some(own)
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
    let (name, extra) = (name? as usize, extra? as usize);
    let extra_at = 46 + name;
    let own_extra = entry.get(extra_at..)?.get(..extra)?;
    // Those that do not fit in 32 bits follow one another in the extra field, in this order.
    let mut long = extra_64(own_extra).unwrap_or_default();
    let mut number = |place: usize| match number32(entry, place)? {
        u32::MAX => {
            let (own, rest) = long.split_at_checked(8)?;
            long = rest;
            number64(own, 0)
        }
        own => Some(u64::from(own)),
    };
    let (size, compressed, local_header) = (number(24)?, number(20)?, number(42)?);
    Some(DirectoryEntry {
        name: String::from_utf8_lossy(entry.get(46..extra_at)?).into_owned(),
        part: Part {
            flags: number16(entry, 8)?,
            method: number16(entry, 10)?,
            checksum: number32(entry, 16)?,
            compressed,
            size,
            local_header,
        },
        end: at + extra_at + extra + comment? as usize,
    })
}

/// The numbers of 64 bits among the extra fields of an entry.
fn extra_64(mut fields: &[u8]) -> Option<&[u8]> {
    loop {
        let (kind, size) = (number16(fields, 0)?, number16(fields, 2)? as usize);
        let own = fields.get(4..)?;
        match kind {
            EXTRA_64 => return own.get(..size),
            _ => fields = own.get(size..)?,
        }
    }
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

fn number64(bytes: &[u8], at: usize) -> Option<u64> {
    let bytes = bytes.get(at..)?.first_chunk()?;
    Some(u64::from_le_bytes(*bytes))
}
