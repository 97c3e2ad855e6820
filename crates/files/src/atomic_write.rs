use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Write};
use std::path::Path;

use crate::Error;
use crate::error::Place;
use crate::partial::Partial;

/// Writes a file whole or not at all: `bytes` go to a file next to `path`, which then takes its name. A device or a
/// pipe is written to in place. The folder must exist.
///
/// # Errors
/// When the operating system refuses; a file at `path` is then unchanged, and no other file is left.
pub fn write_atomically(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), Error> {
    write_atomically_with(path, |file| file.write_all(bytes))
}

/// As [`write_atomically`], with the output of `put`.
pub(crate) fn write_atomically_with(
    path: impl AsRef<Path>,
    put: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Error> {
    let path = path.as_ref();
    let write = || match is_replaced(path)? {
        true => {
            let mut partial = Partial::create(path)?;
            put(&mut partial.file)?;
            partial.rename(path)
        }
        false => put(&mut OpenOptions::new().write(true).open(path)?),
    };
    write().map_err(|source| Error::write(path, source))
}

/// Whether a new file replaces the one at `path`, rather than going into the device or pipe there.
pub(crate) fn is_replaced(path: &Path) -> io::Result<bool> {
    match fs::metadata(path) {
        Ok(known) if known.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(known) => Ok(known.is_file()),
        // It will be created, or creating it reports the error.
        Err(_) => Ok(true),
    }
}

/// The largest document of keys that is read [bytes]: a scene, a tissue, a protocol, a problem.
pub const MAX_DOCUMENT_BYTES: u64 = 4 << 20;

/// The largest table of numbers that is read [bytes]: a recording, a motion, a session. An hour of two tools at 1 kHz
/// has 1.4 GB.
pub const MAX_TABLE_BYTES: u64 = 2 << 30;

/// Opens a regular file for reading. A device or a pipe may never end.
pub(crate) fn open_regular(path: &Path) -> Result<File, Error> {
    let refused = |source| Error::read(path, source);
    // Before it is opened: opening a pipe waits for its writer.
    let metadata = fs::metadata(path).map_err(refused)?;
    if metadata.is_dir() {
        return Err(refused(io::ErrorKind::IsADirectory.into()));
    }
    if !metadata.is_file() {
        let path = path.to_owned();
        return Err(Error::NotAFile { path });
    }
    File::open(path).map_err(refused)
}

/// The bytes of a regular file of at most `most` bytes.
///
/// # Errors
/// When it is no regular file, larger, or the operating system refuses.
pub fn read_bytes(path: impl AsRef<Path>, most: u64) -> Result<Vec<u8>, Error> {
    let path = path.as_ref();
    let refused = |source| Error::read(path, source);
    let file = open_regular(path)?;
    let length = file.metadata().map_err(refused)?.len();
    let mut bytes = Vec::new();
    let too_large = |bytes: u64| Error::TooLarge {
        path: path.to_owned(),
        bytes,
        most,
    };
    if length > most {
        return Err(too_large(length));
    }
    bytes
        .try_reserve_exact(length as usize)
        .map_err(|_| refused(io::ErrorKind::OutOfMemory.into()))?;
    // It may grow meanwhile.
    file.take(most + 1)
        .read_to_end(&mut bytes)
        .map_err(refused)?;
    match bytes.len() as u64 <= most {
        true => Ok(bytes),
        false => Err(too_large(bytes.len() as u64)),
    }
}

/// The text of a regular file of at most `most` bytes, without a byte-order mark.
///
/// # Errors
/// As for [`read_bytes`], and when it is no UTF-8.
pub fn read_text(path: impl AsRef<Path>, most: u64) -> Result<String, Error> {
    let path = path.as_ref();
    text(read_bytes(path, most)?, path)
}

/// The text of `bytes`, without a byte-order mark; `path` is its name in errors.
pub(crate) fn text(mut bytes: Vec<u8>, path: &Path) -> Result<String, Error> {
    if bytes.starts_with(BYTE_ORDER_MARK) {
        bytes.drain(..BYTE_ORDER_MARK.len());
    }
    String::from_utf8(bytes).map_err(|error| {
        let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        Error::NotText {
            place: Place::line(path, 1 + newlines(good)),
        }
    })
}

/// The mark that some programs put before UTF-8.
const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// How many lines end in `bytes`.
pub(crate) fn newlines(bytes: &[u8]) -> usize {
    bytes.iter().filter(|&&byte| byte == b'\n').count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_temporary_file_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("summary.json");
        write_atomically(&path, b"{}").unwrap();
        write_atomically(&path, b"{\"a\": 1}").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"{\"a\": 1}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_missing_folder_is_the_callers_mistake() {
        let folder = tempfile::tempdir().unwrap();
        let error = write_atomically(folder.path().join("no/such.json"), b"").unwrap_err();
        assert!(error.is_input(), "{error}");
        assert!(write_atomically(folder.path(), b"").is_err());
    }

    #[test]
    fn only_regular_files_of_some_size_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.toml");
        fs::write(&path, "\u{feff}format = 1\n").unwrap();
        assert_eq!(read_text(&path, 100).unwrap(), "format = 1\n");
        let error = read_text(&path, 10).unwrap_err().to_string();
        assert!(error.contains("14 bytes"), "{error}");
        assert!(read_text(folder.path(), 100).is_err());
        #[cfg(unix)]
        {
            let error = read_text("/dev/zero", 100).unwrap_err();
            assert!(error.to_string().contains("regular file"), "{error}");
        }
    }
}
