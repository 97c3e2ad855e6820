//! Temporary files for atomic replacement: `.NAME.1.partial` next to the target, or with the next free number, which
//! then takes the target's name. It is locked while it is written. A file that a killed program left has no lock, and
//! is removed when the same target is written again.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use crate::claim::is_at;

/// Removed when it is dropped, unless it was renamed.
pub(crate) struct Partial {
    pub(crate) file: File,
    path: PathBuf,
    is_renamed: bool,
}

impl Partial {
    /// A new file that nobody else writes, in the folder of `path`, so that renaming is atomic on one disk.
    pub(crate) fn create(path: &Path) -> io::Result<Self> {
        let no_name = || io::Error::new(ErrorKind::InvalidInput, "the path names no file");
        let name = path.file_name().ok_or_else(no_name)?;
        let candidate = |number: u32| {
            let mut partial = OsString::from(".");
            partial.push(name);
            partial.push(format!(".{number}.partial"));
            path.with_file_name(partial)
        };
        let mut number = 1;
        let created = loop {
            match Self::create_at(candidate(number))? {
                Some(created) => break created,
                None => number += 1,
            }
        };
        // Several programs may have been killed at once.
        let others = (number + 1..).map(candidate);
        for other in others.take_while(|other| other.exists()) {
            remove_if_left(&other);
        }
        Ok(created)
    }

    /// None when another program writes there.
    fn create_at(path: PathBuf) -> io::Result<Option<Self>> {
        loop {
            let file = match OpenOptions::new().write(true).create_new(true).open(&path) {
                Ok(file) => file,
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {
                    match remove_if_left(&path) {
                        true => continue,
                        false => return Ok(None),
                    }
                }
                Err(error) => return Err(error),
            };
            // Between its creation and its locking another program may have treated it as a leftover. A disk without
            // locks keeps it: its name was free.
            if matches!(file.try_lock(), Err(fs::TryLockError::WouldBlock)) || !is_at(&path, &file)?
            {
                continue;
            }
            return Ok(Some(Self {
                file,
                path,
                is_renamed: false,
            }));
        }
    }

    /// Writes all data to the disk and gives the file its name.
    pub(crate) fn rename(mut self, path: &Path) -> io::Result<()> {
        // Without this the new name could reach the disk before the bytes do.
        self.file.sync_all()?;
        fs::rename(&self.path, path)?;
        self.is_renamed = true;
        Ok(())
    }
}

impl Drop for Partial {
    fn drop(&mut self) {
        if !self.is_renamed {
            // Report the earlier failure; the next writer of this target removes a leftover.
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Removes a file that nobody writes any more; returns whether its name is free now.
fn remove_if_left(path: &Path) -> bool {
    let Ok(file) = File::open(path) else {
        return !path.exists();
    };
    file.try_lock().is_ok()
        && is_at(path, &file).is_ok_and(|is| is)
        && fs::remove_file(path).is_ok()
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let name = |entry: io::Result<fs::DirEntry>| entry.unwrap().file_name();
        let mut names: Vec<String> = entries
            .map(|entry| name(entry).into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    /// Killed programs leave files without a lock; the next writer of the same target removes them, and nothing else.
    #[test]
    fn leftovers_of_killed_programs_are_removed_by_the_next_write() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        for left in [".a.csv.1.partial", ".a.csv.2.partial", ".b.csv.1.partial"] {
            fs::write(at(left), "half").unwrap();
        }
        crate::write_atomically(at("a.csv"), b"whole").unwrap();
        assert_eq!(names(folder.path()), [".b.csv.1.partial", "a.csv"]);
    }

    #[test]
    fn several_write_the_same_file_at_once_and_each_writes_it_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        let mut first = Partial::create(&path).unwrap();
        let mut second = Partial::create(&path).unwrap();
        assert_ne!(first.path, second.path);
        first.file.write_all(b"first").unwrap();
        second.file.write_all(b"second").unwrap();
        first.rename(&path).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"first");
        second.rename(&path).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(names(folder.path()), ["a.csv"]);
        let write =
            |text: [u8; 1]| (0..100).for_each(|_| crate::write_atomically(&path, &text).unwrap());
        std::thread::scope(|scope| {
            for letter in *b"abcd" {
                scope.spawn(move || write([letter]));
            }
        });
        assert_eq!(names(folder.path()), ["a.csv"]);
    }

    #[test]
    fn what_fails_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        let full = crate::atomic_write::write_atomically_with(&path, |file| {
            file.write_all(b"half")?;
            Err(ErrorKind::StorageFull.into())
        });
        assert!(!full.unwrap_err().is_input());
        assert_eq!(names(folder.path()), [""; 0]);
    }

    /// A device is written to; it is never replaced by a file.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_device_stays_and_a_full_one_is_a_failure() {
        use std::os::unix::fs::FileTypeExt;
        crate::write_atomically("/dev/null", b"whole").unwrap();
        let full = crate::write_atomically("/dev/full", b"whole").unwrap_err();
        assert!(!full.is_input(), "{full}");
        for device in ["/dev/null", "/dev/full"] {
            assert!(fs::metadata(device).unwrap().file_type().is_char_device());
        }
    }
}
