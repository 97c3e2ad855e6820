use std::fs;
use std::io;
use std::path::{Path, PathBuf, absolute};
use std::time::Duration;

use rusqlite::{Connection, OpenFlags};

use crate::schema::{self, DatabaseState, VERSION};
use crate::{Added, Attempt, Error, damaged, rows};

/// Timeout for another program's lock.
const TIMEOUT: Duration = Duration::from_secs(2);

/// How often opening retries a damaged file that another program changes at the same time.
const LOOKS: usize = 3;

/// A training record in one file.
#[derive(Debug)]
pub struct Record {
    path: PathBuf,
    connection: Connection,
    warnings: Vec<String>,
}

/// A filter for attempts; the default selects all.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Filter {
    /// Of one trainee.
    pub trainee: Option<String>,
    /// At one task.
    pub task: Option<String>,
}

impl Record {
    /// Opens the record in a file for writing. It creates a missing record with its folder. It renames a damaged one to
    /// `NAME.damaged-1` and creates a new one at once, so that an attempt that was just finished is not lost;
    /// [`Record::warnings`] reports this.
    ///
    /// # Errors
    /// Another program locks it for longer than two seconds, it is another kind of file or of a later version, or the
    /// operating system does not permit writing.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let path = absolute(path).map_err(|error| Error::of_system(path, &error))?;
        let folder = path.parent().unwrap_or(&path);
        fs::create_dir_all(folder).map_err(|error| Error::of_system(&path, &error))?;
        let mut warnings = Vec::new();
        let mut looks = 0;
        loop {
            let stamp = damaged::stamp(&path);
            let reason = match opened(&path, true) {
                Err(Error::Damaged { reason, .. }) => reason,
                other => {
                    let connection = other?;
                    return Ok(Self {
                        path,
                        connection,
                        warnings,
                    });
                }
            };
            looks += 1;
            // Another program may just have renamed it and created a new one.
            if damaged::stamp(&path) != stamp && looks < LOOKS {
                continue;
            }
            if looks > LOOKS {
                // Another program damages the file that this one creates.
                return Err(Error::Locked { path });
            }
            let kept = match damaged::rename_damaged(&path) {
                // Another program was faster.
                Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                other => other.map_err(|error| Error::of_system(&path, &error))?,
            };
            warnings.push(format!(
                "the training record {} was damaged ({reason}); it is kept as {}, and a new one is begun",
                path.display(),
                kept.display()
            ));
        }
    }

    /// Opens the record in a file for reading. It creates and renames nothing.
    ///
    /// # Errors
    /// There is none, it is damaged, another program locks it for longer than two seconds, it is another kind of file
    /// or of a later version, or the operating system does not permit reading.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let path = absolute(path).map_err(|error| Error::of_system(path, &error))?;
        if !path.exists() {
            return Err(Error::Missing { path });
        }
        let connection = opened(&path, false)?;
        Ok(Self {
            path,
            connection,
            warnings: Vec::new(),
        })
    }

    pub(crate) fn connection(&self) -> &Connection {
        &self.connection
    }

    /// Its file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Warnings from opening the record.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// Adds an attempt atomically: it is on the disk when this returns, or not at all. No other attempt changes. An
    /// attempt with the same digests of session and scene, trainee and time is not added again. Names are stored
    /// without surrounding white space.
    ///
    /// # Errors
    /// The attempt lacks a name, a measure is not a number, another program locks the record for longer than two
    /// seconds, or it cannot be written.
    pub fn add(&mut self, attempt: &Attempt) -> Result<Added, Error> {
        attempt.check()?;
        let session = session(&attempt.session)?;
        rows::put(&mut self.connection, attempt, &session)
            .map_err(|error| Error::of_database(&self.path, &error))
    }

    /// Attempts in the order of their times; within the same second, in the order in which they were added.
    ///
    /// # Errors
    /// Another program locks the record for longer than two seconds, or it cannot be read.
    pub fn attempts(&self, filter: &Filter) -> Result<Vec<Attempt>, Error> {
        rows::taken(&self.connection, filter)
            .map_err(|error| Error::of_database(&self.path, &error))
    }

    /// The trainees with attempts, in alphabetical order.
    ///
    /// # Errors
    /// As of [`Record::attempts`].
    pub fn trainees(&self) -> Result<Vec<String>, Error> {
        self.names("SELECT DISTINCT trainee FROM attempt ORDER BY trainee")
    }

    /// The tasks with attempts, in alphabetical order.
    ///
    /// # Errors
    /// As of [`Record::attempts`].
    pub fn tasks(&self) -> Result<Vec<String>, Error> {
        self.names("SELECT DISTINCT task FROM attempt ORDER BY task")
    }

    fn names(&self, sql: &str) -> Result<Vec<String>, Error> {
        let names = || -> rusqlite::Result<Vec<String>> {
            let mut query = self.connection.prepare(sql)?;
            query.query_map([], |row| row.get(0))?.collect()
        };
        names().map_err(|error| Error::of_database(&self.path, &error))
    }
}

/// Opens a record, or an empty file in which to create one.
fn opened(path: &Path, begins: bool) -> Result<Connection, Error> {
    let looked = looked_at(path, begins);
    let path = path.to_owned();
    let error = match looked {
        Ok((connection, DatabaseState::Record)) => return Ok(connection),
        Ok((_, DatabaseState::Nothing)) => Error::Missing { path },
        Ok((_, DatabaseState::Foreign)) => Error::Foreign { path },
        Ok((_, DatabaseState::Damaged(reason))) => Error::Damaged { path, reason },
        Ok((_, DatabaseState::Newer(found))) => Error::Newer {
            path,
            found,
            known: VERSION,
        },
        Err(error) => Error::of_database(&path, &error),
    };
    match error {
        Error::Damaged { path, .. } if !damaged::was_record(&path) => Err(Error::Foreign { path }),
        Error::Unusable { path, .. } if path.is_dir() => {
            let reason = "it is a folder".to_owned();
            Err(Error::Unusable { path, reason })
        }
        other => Err(other),
    }
}

/// Opens a file and checks its kind; in an empty one it creates a record if requested.
fn looked_at(path: &Path, begins: bool) -> rusqlite::Result<(Connection, DatabaseState)> {
    let mut flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    if begins {
        flags |= OpenFlags::SQLITE_OPEN_CREATE;
    }
    let is_long = || fs::metadata(path).is_ok_and(|known| known.len() > 0);
    let was_long = is_long();
    let mut connection = Connection::open_with_flags(path, flags)?;
    connection.busy_timeout(TIMEOUT)?;
    // An added attempt survives a power failure: the commit also waits for the end of the journal.
    connection.pragma_update(None, "synchronous", "EXTRA")?;
    let mut found = schema::database_state(&mut connection)?;
    // The database treats a file of a few bytes as empty and would overwrite it. An interrupted creation of a record
    // leaves a long file before and an empty one afterwards.
    if found == DatabaseState::Nothing && was_long && is_long() {
        found = DatabaseState::Damaged("it is no database".to_owned());
    }
    if found == DatabaseState::Nothing && begins {
        schema::begin(&mut connection)?;
        found = schema::database_state(&mut connection)?;
    }
    if found == DatabaseState::Record && begins {
        schema::upgrade(&mut connection)?;
    }
    Ok((connection, found))
}

/// The stored form of a session's folder: always the same for the same folder.
fn session(folder: &Path) -> Result<String, Error> {
    let whole = fs::canonicalize(folder).or_else(|_| absolute(folder));
    let whole = whole.map_err(|error| Error::of_system(folder, &error))?;
    let text = whole.to_str().map(str::to_owned);
    text.ok_or(Error::FolderName { path: whole })
}
