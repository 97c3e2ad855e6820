use crate::ReadFault;

/// First bytes of a GLB.
pub(crate) const MAGIC: &[u8] = b"glTF";

const HEADER_BYTES: usize = 12;

/// The document and the buffer of a GLB, or the document alone when the file is nothing else.
pub(super) fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), ReadFault> {
    if !bytes.starts_with(MAGIC) {
        return Ok((bytes, None));
    }
    let length = number_at(bytes, 8)?;
    let Some(mut rest) = bytes.get(HEADER_BYTES..length) else {
        return Err(cut_short(length.max(HEADER_BYTES), bytes.len()));
    };
    let (mut document, mut buffer) = (None, None);
    while !rest.is_empty() {
        let end = number_at(rest, 0)?.saturating_add(8);
        let kind = rest.get(4..8);
        let chunk = rest.get(8..end);
        let chunk = chunk.ok_or_else(|| cut_short(bytes.len() - rest.len() + end, bytes.len()))?;
        match kind {
            Some(b"JSON") if document.is_none() => document = Some(chunk),
            Some(b"BIN\0") if buffer.is_none() => buffer = Some(chunk),
            _ => {}
        }
        rest = &rest[end..];
    }
    let document = document.ok_or(ReadFault::MissingPart {
        expected: "JSON chunk",
    })?;
    Ok((document, buffer))
}

fn number_at(bytes: &[u8], at: usize) -> Result<usize, ReadFault> {
    let four = bytes.get(at..at + 4).and_then(|four| four.try_into().ok());
    let four = four.ok_or_else(|| cut_short(HEADER_BYTES, bytes.len()))?;
    Ok(u32::from_le_bytes(four) as usize)
}

fn cut_short(expected: usize, found: usize) -> ReadFault {
    ReadFault::Truncated {
        what: "the GLB or a chunk of it",
        expected: expected as u64,
        found: found as u64,
    }
}
