use std::collections::BTreeMap;
use std::ops::Deref;
use std::path::{Component, Path, PathBuf};
use std::rc::Rc;

use super::super::{MAX_BYTES, base64, read_whole};
use super::document::Document;
use crate::ReadFault;
use crate::io::text::shortened;

/// The bytes of a buffer: a part of the file, or shared by all buffers that name one file.
#[derive(Debug, Clone)]
pub(super) enum Bytes<'a> {
    Within(&'a [u8]),
    External(Rc<Vec<u8>>),
}

impl Deref for Bytes<'_> {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        match self {
            Self::Within(bytes) => bytes,
            Self::External(bytes) => bytes,
        }
    }
}

/// The bytes of all buffers: the rest of a GLB, text inside the document, or files in `folder`. Each file is read
/// once, and all together hold at most as many bytes as one mesh file may.
pub(super) fn open_buffers<'a>(
    document: &Document,
    mut chunk: Option<&'a [u8]>,
    folder: &Path,
) -> Result<Vec<Bytes<'a>>, ReadFault> {
    let mut files = BTreeMap::new();
    let mut left = MAX_BYTES;
    let mut buffers = Vec::new();
    for buffer in &document.buffers {
        let bytes = match &buffer.uri {
            None => Bytes::Within(chunk.take().unwrap_or_default()),
            Some(uri) => Bytes::External(by_uri(uri, folder, &mut files, &mut left)?),
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

/// The file of a URI; `files` are those read before, and `left` [bytes] is the rest of the limit.
fn by_uri(
    uri: &str,
    folder: &Path,
    files: &mut BTreeMap<PathBuf, Rc<Vec<u8>>>,
    left: &mut u64,
) -> Result<Rc<Vec<u8>>, ReadFault> {
    if let Some(rest) = uri.strip_prefix("data:") {
        let coded = rest.split_once(";base64,");
        let decoded = coded.and_then(|(_, text)| base64::decode(text));
        let cause = "a buffer inside the document is not base64";
        let decoded = decoded.ok_or_else(|| ReadFault::invalid_gltf(cause));
        return decoded.map(Rc::new);
    }
    let elsewhere = || ReadFault::BufferElsewhere {
        uri: shortened(uri).into_owned(),
    };
    let name = without_percents(uri).ok_or_else(elsewhere)?;
    let inside = Path::new(&name)
        .components()
        .all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    if !inside || name.contains(':') {
        return Err(elsewhere());
    }
    // Without `./`, which would make one file two.
    let path: PathBuf = Path::new(&name)
        .components()
        .filter(|part| matches!(part, Component::Normal(_)))
        .collect();
    if let Some(read) = files.get(&path) {
        return Ok(Rc::clone(read));
    }
    let bytes = read_whole(&folder.join(&path), *left).map_err(|fault| match fault {
        ReadFault::TooLarge { what, found, .. } => ReadFault::TooLarge {
            what,
            found: found + (MAX_BYTES - *left),
            most: MAX_BYTES,
        },
        _ => elsewhere(),
    })?;
    *left -= bytes.len() as u64;
    let bytes = Rc::new(bytes);
    files.insert(path, Rc::clone(&bytes));
    Ok(bytes)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Three hundred names of one file, some in another way, asked for three hundred times its size.
    #[test]
    fn a_file_is_read_once_however_often_it_is_named() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a b.bin"), [7; 12]).unwrap();
        let names = ["a b.bin", "a%20b.bin", "./a b.bin", "././a%20b.bin"];
        let buffers: Vec<String> = (0..300)
            .map(|k| format!(r#"{{"uri":"{}","byteLength":12}}"#, names[k % 4]))
            .collect();
        let text = format!(
            r#"{{"asset":{{"version":"2.0"}},"buffers":[{}]}}"#,
            buffers.join(",")
        );
        let document = Document::parse(text.as_bytes()).unwrap();
        let opened = open_buffers(&document, None, folder.path()).unwrap();
        assert_eq!(opened.len(), 300);
        let Bytes::External(first) = &opened[0] else {
            panic!("it lies beside the document");
        };
        // 300 of the list, and this one is among them.
        assert_eq!(Rc::strong_count(first), 300);
    }
}
