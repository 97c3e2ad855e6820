use std::borrow::Cow;
use std::path::{Component, Path};

use super::super::{base64, read_whole};
use super::document::Document;
use crate::ReadFault;

/// The bytes of all buffers: the rest of a GLB, text inside the document, or files in `folder`.
pub(super) fn open_buffers<'a>(
    document: &Document,
    mut chunk: Option<&'a [u8]>,
    folder: &Path,
) -> Result<Vec<Cow<'a, [u8]>>, ReadFault> {
    let mut buffers = Vec::new();
    for buffer in &document.buffers {
        let bytes = match &buffer.uri {
            None => Cow::Borrowed(chunk.take().unwrap_or_default()),
            Some(uri) => Cow::Owned(by_uri(uri, folder)?),
        };
        if bytes.len() < buffer.byte_length {
            return Err(ReadFault::Truncated {
                what: "a buffer of the glTF document",
                expected: buffer.byte_length as u64,
                found: bytes.len() as u64,
            });
        }
        buffers.push(bytes);
    }
    Ok(buffers)
}

fn by_uri(uri: &str, folder: &Path) -> Result<Vec<u8>, ReadFault> {
    if let Some(rest) = uri.strip_prefix("data:") {
        let coded = rest.split_once(";base64,");
        let decoded = coded.and_then(|(_, text)| base64::decode(text));
        let cause = "a buffer inside the document is not base64";
        return decoded.ok_or_else(|| ReadFault::invalid_gltf(cause));
    }
    let elsewhere = || ReadFault::BufferElsewhere {
        uri: uri.chars().take(200).collect(),
    };
    let name = without_percents(uri).ok_or_else(elsewhere)?;
    let inside = Path::new(&name)
        .components()
        .all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    if !inside || name.contains(':') {
        return Err(elsewhere());
    }
    read_whole(&folder.join(name)).map_err(|_| elsewhere())
}

/// `%20` and its like as characters.
fn without_percents(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, after @ ..] = rest {
        rest = after;
        if *first != b'%' {
            bytes.push(*first);
            continue;
        }
        let digits = std::str::from_utf8(after.get(..2)?).ok()?;
        bytes.push(u8::from_str_radix(digits, 16).ok()?);
        rest = &after[2..];
    }
    String::from_utf8(bytes).ok()
}
