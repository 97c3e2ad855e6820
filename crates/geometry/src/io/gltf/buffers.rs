use std::path::{Component, Path};

use ::gltf::Document;
use ::gltf::buffer::Source;

use super::super::{base64, read_whole};
use crate::ReadFault;

/// The bytes that the document refers to.
pub(super) struct Buffers {
    buffers: Vec<Vec<u8>>,
}

impl Buffers {
    /// Reads all buffers: the rest of a GLB, text inside the document, or files in `folder`.
    pub(super) fn open(
        document: &Document,
        mut blob: Option<Vec<u8>>,
        folder: &Path,
    ) -> Result<Self, ReadFault> {
        let mut buffers = Vec::new();
        for buffer in document.buffers() {
            let bytes = match buffer.source() {
                Source::Bin => blob.take().unwrap_or_default(),
                Source::Uri(uri) => by_uri(uri, folder)?,
            };
            if bytes.len() < buffer.length() {
                return Err(ReadFault::Truncated {
                    what: "a buffer of the glTF document",
                    expected: buffer.length() as u64,
                    found: bytes.len() as u64,
                });
            }
            buffers.push(bytes);
        }
        Ok(Self { buffers })
    }

    pub(super) fn bytes(&self, buffer: usize) -> &[u8] {
        self.buffers.get(buffer).map_or(&[], Vec::as_slice)
    }
}

fn by_uri(uri: &str, folder: &Path) -> Result<Vec<u8>, ReadFault> {
    if let Some(rest) = uri.strip_prefix("data:") {
        let decoded = rest
            .split_once(";base64,")
            .and_then(|(_, text)| base64::decode(text));
        return decoded.ok_or(ReadFault::Gltf {
            cause: "a buffer inside the document is not base64".to_owned(),
        });
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
