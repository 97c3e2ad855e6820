//! Renames a damaged record, so that it stays next to the new one. This ignores its journal: the database rolls it
//! back, or finds it invalid, before the damage is detected.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::schema::APPLICATION;

/// The first bytes of every database.
const MAGIC: &[u8; 16] = b"SQLite format 3\0";

/// Offset of the application number in the header.
const APPLICATION_AT: usize = 68;

/// Name extensions of databases.
const DATABASES: [&str; 3] = ["sqlite", "sqlite3", "db"];

/// Whether a file that the database cannot read was a record: by its header, or without a header by its name. Any other
/// file stays where it is.
pub(crate) fn was_record(path: &Path) -> bool {
    let mut header = [0; APPLICATION_AT + 4];
    let is_read = File::open(path).and_then(|mut file| file.read_exact(&mut header));
    if is_read.is_ok() && header.starts_with(MAGIC) {
        return header[APPLICATION_AT..] == (APPLICATION as u32).to_be_bytes();
    }
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    DATABASES.contains(&&*ending.to_lowercase())
}

/// Last modification time and length of a file, to detect that another file replaced it.
pub(crate) fn stamp(path: &Path) -> Option<(SystemTime, u64)> {
    let metadata = fs::metadata(path).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

/// Renames a file to the first free one of `NAME.damaged-1`, `NAME.damaged-2` …
pub(crate) fn rename_damaged(path: &Path) -> io::Result<PathBuf> {
    let mut number = 1;
    let new_path = loop {
        let mut name = OsString::from(path);
        name.push(format!(".damaged-{number}"));
        let new_path = PathBuf::from(name);
        // Reserves the name first, so that no other program uses it in between.
        match File::create_new(&new_path) {
            Ok(_) => break new_path,
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
            Err(error) => return Err(error),
        }
    };
    if let Err(error) = fs::rename(path, &new_path) {
        // The first failure is the one to report; a leftover file is harmless.
        let _ = fs::remove_file(&new_path);
        return Err(error);
    }
    Ok(new_path)
}
