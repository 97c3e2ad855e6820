use std::ffi::OsString;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::atomic_write::is_replaced;
use crate::{Error, unfinished};

/// The file that is locked in a claimed folder; its text is the number of the process.
const LOCK: &str = ".palpate-lock";

/// Whether files that exist may be replaced.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Overwrite {
    /// They are an error.
    Refused,
    /// They are replaced, each by a whole new one.
    Allowed,
}

impl Overwrite {
    /// From the option `--overwrite`.
    pub fn of_option(is_given: bool) -> Self {
        if is_given {
            Self::Allowed
        } else {
            Self::Refused
        }
    }
}

/// A folder or a file, locked by this program until this is dropped. The operating system releases the lock of a
/// program that is killed.
#[derive(Debug)]
pub struct Claim {
    path: PathBuf,
    /// The folder that is claimed, or that of the file.
    folder: PathBuf,
    overwrite: Overwrite,
    lock: PathBuf,
    _locked: File,
}

/// Files and folders that claims of this program have created.
static MADE: Mutex<Vec<Made>> = Mutex::new(Vec::new());

/// A file or folder that a claim has created.
#[derive(Debug)]
struct Made {
    lock: PathBuf,
    /// The folder that did not exist before.
    folder: Option<PathBuf>,
}

impl Claim {
    /// Claims a folder, which is created if missing; an empty one that was created is removed at the end.
    ///
    /// # Errors
    /// When another program has claimed it, or the operating system refuses.
    pub fn of_folder(path: impl AsRef<Path>, overwrite: Overwrite) -> Result<Self, Error> {
        let path = path.as_ref().to_owned();
        let has_made_folder = !path.exists();
        fs::create_dir_all(&path).map_err(|source| Error::write(&path, source))?;
        let lock = path.join(LOCK);
        let locked = locked(&lock, &path)?;
        made().push(Made {
            lock: lock.clone(),
            folder: has_made_folder.then(|| path.clone()),
        });
        Ok(Self {
            folder: path.clone(),
            path,
            overwrite,
            lock,
            _locked: locked,
        })
    }

    /// Claims a file, which may not exist yet. Its folder must exist.
    ///
    /// # Errors
    /// When another program has claimed it, or the operating system refuses.
    pub fn of_file(path: impl AsRef<Path>, overwrite: Overwrite) -> Result<Self, Error> {
        let path = path.as_ref().to_owned();
        let mut name = OsString::from(".");
        name.push(path.file_name().unwrap_or_default());
        name.push(LOCK);
        let lock = path.with_file_name(name);
        let locked = locked(&lock, &path)?;
        made().push(Made {
            lock: lock.clone(),
            folder: None,
        });
        Ok(Self {
            folder: path.parent().unwrap_or(Path::new("")).to_owned(),
            path,
            overwrite,
            lock,
            _locked: locked,
        })
    }

    /// Claims the files that a command writes, before its work. A device or a pipe is written to in place: several
    /// programs may do so, and it is not replaced. A file without content, as `mktemp` makes one, may be replaced.
    ///
    /// # Errors
    /// When two of them are one file, one is a folder or exists and may not be replaced, another program has claimed
    /// one, or the operating system refuses.
    pub fn of_files(
        paths: impl IntoIterator<Item = impl AsRef<Path>>,
        overwrite: Overwrite,
    ) -> Result<Vec<Self>, Error> {
        let (mut files, mut claims) = (Vec::new(), Vec::new());
        for path in paths {
            let path = path.as_ref();
            if !is_replaced(path).map_err(|source| Error::write(path, source))? {
                continue;
            }
            if overwrite == Overwrite::Refused && has_content(path) {
                let path = path.to_owned();
                return Err(Error::Exists { path });
            }
            let file = in_real_folder(path).map_err(|source| Error::write(path, source))?;
            if files.contains(&file) {
                let path = path.to_owned();
                return Err(Error::NamedTwice { path });
            }
            files.push(file);
            claims.push(Self::of_file(path, overwrite)?);
        }
        Ok(claims)
    }

    /// The claimed path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Rejects an output that would replace one of `files` in the folder, or the remains of an unfinished one, unless
    /// replacing is allowed.
    ///
    /// # Errors
    /// When one exists that may not be replaced.
    pub fn check(&self, files: impl IntoIterator<Item = impl AsRef<Path>>) -> Result<(), Error> {
        if self.overwrite == Overwrite::Allowed {
            return Ok(());
        }
        let files = files.into_iter().map(|file| self.folder.join(file));
        let mut all = files.flat_map(|file| [unfinished(&file), file]);
        match all.find(|file| file.exists()) {
            Some(path) => Err(Error::Exists { path }),
            None => Ok(()),
        }
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        let mut all = made();
        if let Some(place) = all.iter().position(|made| made.lock == self.lock) {
            all.swap_remove(place).remove();
        }
    }
}

impl Made {
    fn remove(self) {
        // A leftover lock file does no harm: nobody holds it.
        let _ = fs::remove_file(&self.lock);
        if let Some(folder) = self.folder {
            // The system refuses this unless it is empty.
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Removes all files and folders that claims of this program have created: for one that exits without dropping them.
pub fn remove_claims() {
    made().drain(..).for_each(Made::remove);
}

fn made() -> MutexGuard<'static, Vec<Made>> {
    MADE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Whether the file has content that could be lost; assumed if the file cannot be read.
fn has_content(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|known| !known.is_file() || known.len() > 0)
}

/// The file with the real path of its folder, so that one file has one path.
fn in_real_folder(path: &Path) -> io::Result<PathBuf> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    Ok(fs::canonicalize(folder)?.join(path.file_name().unwrap_or_default()))
}

/// A lock of this program on the file `lock`; errors name `path`.
fn locked(lock: &Path, path: &Path) -> Result<File, Error> {
    let refused = |source| Error::write(path, source);
    loop {
        let file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(lock);
        let mut file = file.map_err(refused)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let mut process = String::new();
                // Without it the sentence does not name the process.
                let _ = file.read_to_string(&mut process);
                return Err(Error::InUse {
                    path: path.to_owned(),
                    process: process.trim().parse().ok(),
                });
            }
            Err(TryLockError::Error(source)) => return Err(refused(source)),
        }
        // The previous program may have removed the file between its opening and its locking.
        if is_at(lock, &file).map_err(refused)? {
            let process = std::process::id().to_string();
            file.set_len(0)
                .and_then(|()| file.write_all(process.as_bytes()))
                .map_err(refused)?;
            return Ok(file);
        }
    }
}

/// Whether `path` is the name of the file that is open.
#[cfg(unix)]
pub(crate) fn is_at(path: &Path, file: &File) -> io::Result<bool> {
    use std::os::unix::fs::MetadataExt;
    let open = file.metadata()?;
    match fs::metadata(path) {
        Ok(named) => Ok((named.dev(), named.ino()) == (open.dev(), open.ino())),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error),
    }
}

/// Elsewhere an open file keeps its name until it is closed.
#[cfg(not(unix))]
pub(crate) fn is_at(_path: &Path, _file: &File) -> io::Result<bool> {
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_claim_is_refused_until_the_first_is_dropped() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("session");
        let claim = || Claim::of_folder(&path, Overwrite::Refused);
        let first = claim().unwrap();
        let error = claim().unwrap_err();
        assert!(!error.is_input());
        let process = std::process::id().to_string();
        assert!(error.to_string().contains(&process), "{error}");
        drop(first);
        // Nothing is left, not even the created folder.
        assert!(!path.exists());
        let file = path.with_extension("csv");
        let first = Claim::of_file(&file, Overwrite::Refused).unwrap();
        assert!(Claim::of_file(&file, Overwrite::Allowed).is_err());
        assert!(claim().is_ok());
        drop(first);
        assert!(Claim::of_file(&file, Overwrite::Refused).is_ok());
    }

    /// Many at once: never two of them hold it.
    #[test]
    fn one_of_many_threads_holds_a_claim() {
        use std::sync::atomic::{AtomicU32, Ordering};
        let folder = tempfile::tempdir().unwrap();
        let (inside, acquired) = (AtomicU32::new(0), AtomicU32::new(0));
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    for _ in 0..200 {
                        if let Ok(_claim) = Claim::of_folder(folder.path(), Overwrite::Refused) {
                            assert_eq!(inside.fetch_add(1, Ordering::SeqCst), 0);
                            acquired.fetch_add(1, Ordering::SeqCst);
                            inside.fetch_sub(1, Ordering::SeqCst);
                        }
                    }
                });
            }
        });
        assert!(acquired.into_inner() > 0);
    }

    #[test]
    fn files_of_a_command_are_claimed_unless_one_exists_or_is_named_twice() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let claim = |names: &[&str], overwrite| {
            Claim::of_files(names.iter().map(|name| at(name)), overwrite)
        };
        let entries = || fs::read_dir(folder.path()).unwrap().count();
        let first = claim(&["a.png", "b.csv"], Overwrite::Refused).unwrap();
        let error = claim(&["b.csv"], Overwrite::Allowed).unwrap_err();
        assert!(matches!(error, Error::InUse { .. }), "{error}");
        drop(first);
        assert_eq!(entries(), 0);
        for overwrite in [Overwrite::Refused, Overwrite::Allowed] {
            let error = claim(&["a.png", "./a.png"], overwrite).unwrap_err();
            assert!(matches!(error, Error::NamedTwice { .. }), "{error}");
            let error = claim(&["no/such.png"], overwrite).unwrap_err();
            assert!(matches!(error, Error::Write { .. }), "{error}");
            assert!(claim(&[""], overwrite).is_err());
        }
        fs::write(at("a.png"), "old").unwrap();
        let error = claim(&["b.csv", "a.png"], Overwrite::Refused).unwrap_err();
        assert!(
            error.to_string().contains("a.png is there already"),
            "{error}"
        );
        let allowed = claim(&["b.csv", "a.png"], Overwrite::Allowed).unwrap();
        assert_eq!((entries(), allowed.len()), (3, 2));
        drop(allowed);
        assert_eq!(fs::read(at("a.png")).unwrap(), b"old");
        fs::write(at("empty.png"), "").unwrap();
        assert!(claim(&["empty.png"], Overwrite::Refused).is_ok());
        #[cfg(unix)]
        assert!(
            Claim::of_files(["/dev/null", "/dev/null"], Overwrite::Refused)
                .unwrap()
                .is_empty()
        );
    }

    #[test]
    fn what_exists_is_replaced_when_that_is_allowed() {
        let folder = tempfile::tempdir().unwrap();
        let refused = Claim::of_folder(folder.path(), Overwrite::Refused).unwrap();
        refused.check(["session.csv"]).unwrap();
        fs::write(folder.path().join("session.csv.part"), "").unwrap();
        let error = refused.check(["session.csv"]).unwrap_err();
        assert!(error.is_input() && error.to_string().contains("--overwrite"));
        drop(refused);
        let allowed = Claim::of_folder(folder.path(), Overwrite::Allowed).unwrap();
        allowed.check(["session.csv"]).unwrap();
    }
}
