//! A damaged record is kept beside the new one. Its journal is none of our concern: the database rolls it back, or
//! finds it void, before anybody can say what is damaged.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::schema::APPLICATION;

/// The first bytes of every database.
const MAGIC: &[u8; 16] = b"SQLite format 3\0";

/// Where the header has the number of the application.
const APPLICATION_AT: usize = 68;

/// Endings of names that say: a database.
const DATABASES: [&str; 3] = ["sqlite", "sqlite3", "db"];

/// Whether a file that the database cannot read was a record: by its header, or without one by its name. Anything
/// else belongs to somebody and stays where it is.
pub(crate) fn was_record(path: &Path) -> bool {
    let mut header = [0; APPLICATION_AT + 4];
    let is_read = File::open(path).and_then(|mut file| file.read_exact(&mut header));
    if is_read.is_ok() && header.starts_with(MAGIC) {
        return header[APPLICATION_AT..] == (APPLICATION as u32).to_be_bytes();
    }
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    DATABASES.contains(&&*ending.to_lowercase())
}

/// When a file was written last, and its length; it differs for one that took its place.
pub(crate) fn stamp(path: &Path) -> Option<(SystemTime, u64)> {
    let known = fs::metadata(path).ok()?;
    Some((known.modified().ok()?, known.len()))
}

/// Renames a file to the first free one of `NAME.damaged-1`, `NAME.damaged-2` …
pub(crate) fn set_aside(path: &Path) -> io::Result<PathBuf> {
    let mut number = 1;
    let aside = loop {
        let mut name = OsString::from(path);
        name.push(format!(".damaged-{number}"));
        let aside = PathBuf::from(name);
        // Taking the name first, so that nobody else takes it in between.
        match File::create_new(&aside) {
            Ok(_) => break aside,
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
            Err(error) => return Err(error),
        }
    };
    if let Err(error) = fs::rename(path, &aside) {
        // The first failure is the one to report; a leftover is only untidy.
        let _ = fs::remove_file(&aside);
        return Err(error);
    }
    Ok(aside)
}
