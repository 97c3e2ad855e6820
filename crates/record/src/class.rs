//! What a teacher keeps: who belongs together, what they shall do until when, and whose sessions are experts'.
//!
//! The PIN keeps trainees from a teacher's commands by mistake. It is no protection: whoever may write the file may
//! change all of it, and the PIN stands in it as it is.

use rusqlite::{Connection, OptionalExtension, params};

use crate::{Error, Record, schema};

/// Trainees that belong together.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct Cohort {
    /// What they are called together.
    #[serde(rename = "cohort")]
    pub name: String,
    /// Their names, in alphabetical order.
    pub trainees: Vec<String>,
}

/// What a cohort shall do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Assignment {
    /// The cohort.
    pub cohort: String,
    /// The title of the task.
    pub task: String,
    /// Until when, since the beginning of 1970 [s].
    pub due: i64,
    /// How many attempts have to be passed until then.
    pub passes: u32,
}

/// How far a trainee is with an assignment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AssignmentProgress {
    /// Attempts at the task.
    pub attempts: usize,
    /// Passed attempts until it was due.
    pub passed: usize,
    /// Whether there were enough of them.
    pub is_done: bool,
}

impl Assignment {
    /// How far a trainee is with it, whose attempts are `attempts`.
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

    /// Checks that `pin` is the teacher's; every text is, while there is none.
    ///
    /// # Errors
    /// It is not, or the record cannot be read.
    pub fn check_pin(&self, pin: Option<&str>) -> Result<(), Error> {
        if self.database(is_former(self.connection()))? {
            return Ok(());
        }
        let sql = "SELECT value FROM setting WHERE key = 'pin'";
        let kept = self.connection().query_row(sql, [], |row| row.get(0));
        let kept: Option<String> = self.database(kept.optional())?;
        match kept {
            Some(kept) if pin != Some(&kept) => Err(Error::WrongPin {
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

    /// Adds trainees to a cohort, which begins with the first of them.
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

    /// Takes trainees out of a cohort. Their attempts stay.
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

    /// Gives a cohort something to do; an earlier assignment of the same task is replaced.
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

    /// Makes the attempt of a trainee with a session of that digest one that others are judged by. It stays the
    /// trainee's.
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

/// Whether a record, which may only be read, is of a version before a teacher's tables.
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
