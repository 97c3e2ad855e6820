//! A teacher's tables: cohorts, assignments with their due times, and the experts' attempts.
//!
//! The PIN prevents accidental use of a teacher's commands. It is no protection: anyone who may write the file may
//! change all of it, and the file has the PIN in plain text.

use rusqlite::{Connection, OptionalExtension, params};

use crate::{Error, Record, schema};

/// A group of trainees.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct Cohort {
    /// Its name.
    #[serde(rename = "cohort")]
    pub name: String,
    /// The trainees' names, in alphabetical order.
    pub trainees: Vec<String>,
}

/// An assignment of a task to a cohort.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Assignment {
    /// The cohort.
    pub cohort: String,
    /// The title of the task.
    pub task: String,
    /// Due time, since the beginning of 1970 [s].
    pub due: i64,
    /// The number of passed attempts that it requires by then.
    pub passes: u32,
}

/// A trainee's progress in an assignment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AssignmentProgress {
    /// Number of attempts at the task.
    pub attempts: usize,
    /// Number of attempts passed by the due time.
    pub passed: usize,
    /// Whether these are enough.
    pub is_done: bool,
}

impl Assignment {
    /// The progress of a trainee with these `attempts`.
    pub fn standing<'a>(
        &self,
        attempts: impl Iterator<Item = &'a crate::Attempt>,
    ) -> AssignmentProgress {
        let own: Vec<_> = attempts.filter(|own| own.task == self.task).collect();
        let passed = own.iter();
        let passed = passed.filter(|own| own.passed == Some(true) && own.when <= self.due);
        let passed = passed.count();
        AssignmentProgress {
            attempts: own.len(),
            passed,
            is_done: passed >= self.passes as usize,
        }
    }
}

impl Record {
    fn database<T>(&self, found: rusqlite::Result<T>) -> Result<T, Error> {
        found.map_err(|error| Error::of_database(self.path(), &error))
    }

    fn named(what: &'static str, name: &str) -> Result<(), Error> {
        match name.trim().is_empty() {
            true => Err(Error::Unnamed { what }),
            false => Ok(()),
        }
    }

    /// Checks that `pin` is the teacher's. A record without a PIN accepts every text.
    ///
    /// # Errors
    /// It is not, or the record cannot be read.
    pub fn check_pin(&self, pin: Option<&str>) -> Result<(), Error> {
        if self.database(is_former(self.connection()))? {
            return Ok(());
        }
        let sql = "SELECT value FROM setting WHERE key = 'pin'";
        let stored = self.connection().query_row(sql, [], |row| row.get(0));
        let stored: Option<String> = self.database(stored.optional())?;
        match stored {
            Some(stored) if pin != Some(&stored) => Err(Error::WrongPin {
                path: self.path().to_owned(),
            }),
            _ => Ok(()),
        }
    }

    /// Sets the teacher's PIN.
    ///
    /// # Errors
    /// It is empty, or the record cannot be written.
    pub fn set_pin(&mut self, pin: &str) -> Result<(), Error> {
        Self::named("PIN", pin)?;
        let sql = "INSERT INTO setting (key, value) VALUES ('pin', ?1)
                   ON CONFLICT (key) DO UPDATE SET value = excluded.value";
        let set = self.connection().execute(sql, [pin]);
        self.database(set).map(|_| ())
    }

    /// Adds trainees to a cohort and creates the cohort if it does not exist.
    ///
    /// # Errors
    /// A name is empty, or the record cannot be written.
    pub fn join(&mut self, cohort: &str, trainees: &[String]) -> Result<(), Error> {
        Self::named("cohort", cohort)?;
        for trainee in trainees {
            Self::named("trainee", trainee)?;
            let sql = "INSERT INTO member (cohort, trainee) VALUES (?1, ?2) ON CONFLICT DO NOTHING";
            let put = self
                .connection()
                .execute(sql, [cohort.trim(), trainee.trim()]);
            self.database(put)?;
        }
        Ok(())
    }

    /// Removes trainees from a cohort. Their attempts stay.
    ///
    /// # Errors
    /// The record cannot be written.
    pub fn leave(&mut self, cohort: &str, trainees: &[String]) -> Result<(), Error> {
        for trainee in trainees {
            let sql = "DELETE FROM member WHERE cohort = ?1 AND trainee = ?2";
            let taken = self
                .connection()
                .execute(sql, [cohort.trim(), trainee.trim()]);
            self.database(taken)?;
        }
        Ok(())
    }

    /// All cohorts, in alphabetical order.
    ///
    /// # Errors
    /// The record cannot be read.
    pub fn cohorts(&self) -> Result<Vec<Cohort>, Error> {
        let mut cohorts: Vec<Cohort> = Vec::new();
        for (name, trainee) in self.database(members(self.connection()))? {
            match cohorts.last_mut() {
                Some(last) if last.name == name => last.trainees.push(trainee),
                _ => cohorts.push(Cohort {
                    name,
                    trainees: vec![trainee],
                }),
            }
        }
        Ok(cohorts)
    }

    /// Gives a cohort an assignment; it replaces an earlier assignment of the same task.
    ///
    /// # Errors
    /// A name is empty, or the record cannot be written.
    pub fn assign(&mut self, assignment: &Assignment) -> Result<(), Error> {
        Self::named("cohort", &assignment.cohort)?;
        Self::named("task", &assignment.task)?;
        let sql = "INSERT INTO assignment (cohort, task, due_s, passes) VALUES (?1, ?2, ?3, ?4)
                   ON CONFLICT (cohort, task) DO UPDATE SET due_s = excluded.due_s, passes = excluded.passes";
        let put = self.connection().execute(
            sql,
            params![
                assignment.cohort.trim(),
                assignment.task.trim(),
                assignment.due,
                assignment.passes
            ],
        );
        self.database(put).map(|_| ())
    }

    /// All assignments, the first due first.
    ///
    /// # Errors
    /// The record cannot be read.
    pub fn assignments(&self) -> Result<Vec<Assignment>, Error> {
        self.database(assignments(self.connection()))
    }

    /// Makes a trainee's attempt with this session digest a reference attempt. It stays the trainee's.
    ///
    /// # Errors
    /// There is no such attempt, it was not passed, or the record cannot be written.
    pub fn make_expert(&mut self, trainee: &str, session_digest: &str) -> Result<(), Error> {
        let sql = "UPDATE attempt SET is_expert = 1 WHERE trainee = ?1 AND session_digest = ?2 AND passed = 1";
        let made = self
            .connection()
            .execute(sql, [trainee.trim(), session_digest]);
        match self.database(made)? {
            0 => Err(Error::NoExpert {
                trainee: trainee.to_owned(),
            }),
            _ => Ok(()),
        }
    }
}

/// Whether a record that is opened read-only has a version before the teacher's tables.
fn is_former(connection: &Connection) -> rusqlite::Result<bool> {
    Ok(schema::version(connection)? < schema::TEACHERS)
}

fn members(connection: &Connection) -> rusqlite::Result<Vec<(String, String)>> {
    if is_former(connection)? {
        return Ok(Vec::new());
    }
    let mut query =
        connection.prepare("SELECT cohort, trainee FROM member ORDER BY cohort, trainee")?;
    let rows = query.query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?;
    rows.collect()
}

fn assignments(connection: &Connection) -> rusqlite::Result<Vec<Assignment>> {
    if is_former(connection)? {
        return Ok(Vec::new());
    }
    let sql = "SELECT cohort, task, due_s, passes FROM assignment ORDER BY due_s, cohort, task";
    let mut query = connection.prepare(sql)?;
    let rows = query.query_map([], |row| {
        Ok(Assignment {
            cohort: row.get(0)?,
            task: row.get(1)?,
            due: row.get(2)?,
            passes: row.get(3)?,
        })
    })?;
    rows.collect()
}
