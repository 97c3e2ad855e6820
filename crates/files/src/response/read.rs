use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

use super::checked::Checked;
use super::{DIGEST, FIRST_LINE, LONGEST_HEADER, StoredResponse};
use crate::Error;
use crate::atomic_write::open_regular;

/// The lines before the numbers.
struct Header {
    text: String,
    key: String,
    made_by: String,
    touchable: usize,
    triangles: usize,
}

impl StoredResponse<'static> {
    /// Reads a file and checks its checksum. `memory` is the memory limit [bytes]: a header may name any size, and a
    /// file with holes has any length.
    ///
    /// # Errors
    /// When it cannot be read, needs more memory than allowed or available, is incomplete, or fails the checksum.
    pub fn read(path: impl AsRef<Path>, memory: usize) -> Result<Self, Error> {
        let path = path.as_ref();
        let fault = |source| Error::read(path, source);
        let damaged = |what: &str| Error::DamagedResponse {
            path: path.to_owned(),
            what: what.to_owned(),
        };
        let file = open_regular(path)?;
        let length = file.metadata().map_err(fault)?.len();
        let mut file = BufReader::with_capacity(1 << 20, file);
        let header = header(&mut file).ok_or_else(|| damaged("its header cannot be read"))?;
        if header.length() != Some(length) {
            return Err(damaged("it is shorter or longer than its header says"));
        }
        let too_large = || Error::NoMemoryForResponse {
            path: path.to_owned(),
            bytes: length,
            memory,
        };
        if length > memory as u64 {
            return Err(too_large());
        }
        let (found, digest) = header.body(file).map_err(|source| match source.kind() {
            io::ErrorKind::OutOfMemory => too_large(),
            _ => fault(source),
        })?;
        match digest {
            true => Ok(found),
            false => Err(damaged("its checksum is another")),
        }
    }
}

impl Header {
    /// Bytes of the whole file; none when there is no such number.
    fn length(&self) -> Option<u64> {
        let values = self.triangles.checked_mul(9)?.checked_mul(self.touchable)?;
        let bytes = values.checked_add(self.touchable)?.checked_mul(4)?;
        u64::try_from(bytes.checked_add(self.text.len() + DIGEST)?).ok()
    }

    /// The data after the header, and whether the checksum matches.
    fn body(self, file: impl Read) -> io::Result<(StoredResponse<'static>, bool)> {
        let mut checked = Checked::new(io::Cursor::new(self.text.as_bytes()).chain(file));
        checked.bytes(&mut vec![0; self.text.len()])?;
        let count = 9 * self.triangles * self.touchable;
        let touchable = checked.numbers(self.touchable, u32::from_le_bytes)?;
        let displacements = checked.numbers(count, f32::from_le_bytes)?;
        let (digest, mut file) = checked.finish();
        let mut stated = [0; DIGEST];
        file.read_exact(&mut stated)?;
        let response = StoredResponse {
            key: self.key,
            made_by: self.made_by,
            touchable,
            triangles: self.triangles,
            displacements: displacements.into(),
        };
        Ok((response, digest == stated))
    }
}

fn header(file: &mut impl BufRead) -> Option<Header> {
    let mut text = String::new();
    let mut values = Vec::new();
    let keys = ["key = ", "touchable = ", "triangles = ", "made_by = "];
    let mut line = |text: &mut String| -> Option<String> {
        let start = text.len();
        let mut bytes = Vec::new();
        let room = LONGEST_HEADER.checked_sub(start)? as u64;
        file.by_ref()
            .take(room)
            .read_until(b'\n', &mut bytes)
            .ok()?;
        text.push_str(std::str::from_utf8(&bytes).ok()?);
        Some(text[start..].strip_suffix('\n')?.to_owned())
    };
    (line(&mut text)? == FIRST_LINE).then_some(())?;
    for key in keys {
        values.push(line(&mut text)?.strip_prefix(key)?.to_owned());
    }
    line(&mut text)?.is_empty().then_some(())?;
    let [key, touchable, triangles, made_by] = values.try_into().ok()?;
    Some(Header {
        touchable: touchable.parse().ok()?,
        triangles: triangles.parse().ok()?,
        key,
        made_by,
        text,
    })
}
