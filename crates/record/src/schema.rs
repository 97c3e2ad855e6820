//! The tables in the file, and how the file is recognized.

use rusqlite::{Connection, Transaction, TransactionBehavior};

/// In the header of every record: `palp`.
pub(crate) const APPLICATION: i64 = 0x7061_6c70;

/// Version of the tables.
pub(crate) const VERSION: i64 = 3;

/// The first version with a teacher's tables.
pub(crate) const TEACHERS: i64 = 3;

/// The tables; an attempt is what was done (digest of the session, digest of the scene), by whom and when.
const TABLES: &str = "
CREATE TABLE attempt (
    id INTEGER PRIMARY KEY,
    session_digest TEXT NOT NULL,
    session TEXT NOT NULL,
    trainee TEXT NOT NULL,
    task TEXT NOT NULL,
    scene_digest TEXT NOT NULL,
    when_s INTEGER NOT NULL,
    passed INTEGER CHECK (passed IN (0, 1)),
    is_expert INTEGER NOT NULL CHECK (is_expert IN (0, 1)),
    UNIQUE (session_digest, scene_digest, trainee, when_s)
) STRICT;
CREATE TABLE measure (
    attempt INTEGER NOT NULL REFERENCES attempt (id),
    place INTEGER NOT NULL,
    key TEXT NOT NULL,
    value REAL NOT NULL,
    better TEXT NOT NULL CHECK (better IN ('less', 'more', 'neither')),
    PRIMARY KEY (attempt, place)
) STRICT, WITHOUT ROWID;
";

/// The tables of a teacher, new in version 3.
const TEACHER: &str = "
CREATE TABLE setting (key TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT, WITHOUT ROWID;
CREATE TABLE member (
    cohort TEXT NOT NULL,
    trainee TEXT NOT NULL,
    PRIMARY KEY (cohort, trainee)
) STRICT, WITHOUT ROWID;
CREATE TABLE assignment (
    cohort TEXT NOT NULL,
    task TEXT NOT NULL,
    due_s INTEGER NOT NULL,
    passes INTEGER NOT NULL CHECK (passes > 0),
    PRIMARY KEY (cohort, task)
) STRICT, WITHOUT ROWID;
";

/// Migration from version 1, which identified an attempt by its session's folder; the folder becomes the digest.
const FROM_VERSION_1: &str = "
ALTER TABLE attempt RENAME TO attempt_1;
ALTER TABLE measure RENAME TO measure_1;
";

/// Copies the content of version 1 to the tables of version 2.
const COPY_OF_VERSION_1: &str = "
INSERT INTO attempt
    SELECT id, 'unknown, ' || session, session, trainee, task, scene_digest, when_s, passed, is_expert
    FROM attempt_1;
INSERT INTO measure SELECT * FROM measure_1;
DROP TABLE measure_1;
DROP TABLE attempt_1;
";

/// The kind of a database.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum DatabaseState {
    /// Empty.
    Nothing,
    /// A complete record of this version or an earlier one.
    Record,
    /// A record of a later version.
    Newer(i64),
    /// A record with missing or wrong parts.
    Damaged(String),
    /// Another kind of database.
    Foreign,
}

/// The kind at one moment: a record that another program creates at the same time is empty or complete.
pub(crate) fn database_state(connection: &mut Connection) -> rusqlite::Result<DatabaseState> {
    state_within(&*connection.transaction()?)
}

fn state_within(connection: &Connection) -> rusqlite::Result<DatabaseState> {
    let number = |sql: &str| connection.query_row(sql, [], |row| row.get::<_, i64>(0));
    let application = number("PRAGMA application_id")?;
    let version = version(connection)?;
    let objects = number("SELECT count(*) FROM sqlite_schema")?;
    if (application, version, objects) == (0, 0, 0) {
        return Ok(DatabaseState::Nothing);
    }
    if application != APPLICATION {
        return Ok(DatabaseState::Foreign);
    }
    if version > VERSION {
        return Ok(DatabaseState::Newer(version));
    }
    let said: String = connection.query_row("PRAGMA integrity_check(1)", [], |row| {
        row.get::<_, String>(0)
    })?;
    if said != "ok" {
        return Ok(DatabaseState::Damaged(said.replace('\n', " ")));
    }
    let tables = "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name IN ('attempt', 'measure')";
    if version < 1 || number(tables)? != 2 {
        return Ok(DatabaseState::Damaged("its tables are missing".to_owned()));
    }
    Ok(DatabaseState::Record)
}

/// Creates the tables atomically; another program may have done so first.
pub(crate) fn begin(connection: &mut Connection) -> rusqlite::Result<()> {
    let transaction = Transaction::new(connection, TransactionBehavior::Immediate)?;
    if state_within(&transaction)? == DatabaseState::Nothing {
        transaction.execute_batch(TABLES)?;
        transaction.execute_batch(TEACHER)?;
        transaction.pragma_update(None, "application_id", APPLICATION)?;
        transaction.pragma_update(None, "user_version", VERSION)?;
    }
    transaction.commit()
}

/// Migrates a record of an earlier version to this one, atomically.
pub(crate) fn upgrade(connection: &mut Connection) -> rusqlite::Result<()> {
    if version(connection)? == VERSION {
        return Ok(());
    }
    let transaction = Transaction::new(connection, TransactionBehavior::Immediate)?;
    // Another program may have done so first.
    let found = version(&transaction)?;
    if found == 1 {
        transaction.execute_batch(FROM_VERSION_1)?;
        transaction.execute_batch(TABLES)?;
        transaction.execute_batch(COPY_OF_VERSION_1)?;
    }
    if found < VERSION {
        transaction.execute_batch(TEACHER)?;
        transaction.pragma_update(None, "user_version", VERSION)?;
    }
    transaction.commit()
}

/// The version of the tables.
pub(crate) fn version(connection: &Connection) -> rusqlite::Result<i64> {
    connection.query_row("PRAGMA user_version", [], |row| row.get(0))
}
