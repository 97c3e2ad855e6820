//! Attempts as rows of the tables.

use std::path::PathBuf;

use rusqlite::{Connection, OptionalExtension, Row, Transaction, TransactionBehavior, params};

use crate::{Added, Attempt, Better, Filter, Measure, schema};

/// Inserts an attempt atomically, unless it exists already.
pub(crate) fn put(
    connection: &mut Connection,
    attempt: &Attempt,
    session: &str,
) -> rusqlite::Result<Added> {
    let transaction = Transaction::new(connection, TransactionBehavior::Immediate)?;
    let other = transaction
        .query_row(
            "SELECT trainee, when_s FROM attempt WHERE session_digest = ?1 AND scene_digest = ?2
             ORDER BY when_s LIMIT 1",
            [&attempt.session_digest, &attempt.scene_digest],
            |row| {
                Ok(Added::SameSession {
                    trainee: row.get(0)?,
                    when: row.get(1)?,
                })
            },
        )
        .optional()?;
    let id: Option<i64> = transaction
        .query_row(
            "INSERT INTO attempt (session_digest, session, trainee, task, scene_digest, when_s, passed, is_expert)
             VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)
             ON CONFLICT DO NOTHING RETURNING id",
            params![
                attempt.session_digest,
                session,
                attempt.trainee.trim(),
                attempt.task.trim(),
                attempt.scene_digest,
                attempt.when,
                attempt.passed,
                attempt.is_expert
            ],
            |row| row.get(0),
        )
        .optional()?;
    let Some(id) = id else {
        return Ok(Added::AlreadyThere);
    };
    let mut insert = transaction.prepare(
        "INSERT INTO measure (attempt, place, key, value, better) VALUES (?1, ?2, ?3, ?4, ?5)",
    )?;
    for (place, Measure { key, value, better }) in (0_i64..).zip(&attempt.measures) {
        insert.execute(params![id, place, key, value, better.word()])?;
    }
    drop(insert);
    transaction.commit()?;
    Ok(other.unwrap_or(Added::New))
}

/// Attempts in order; one statement, so that all are of one moment.
pub(crate) fn taken(connection: &Connection, filter: &Filter) -> rusqlite::Result<Vec<Attempt>> {
    // A record that is opened read-only keeps its version.
    let digest = match schema::version(connection)? {
        1 => "'unknown, ' || session",
        _ => "session_digest",
    };
    let mut query = connection.prepare(&format!(
        "SELECT attempt.id, session, trainee, task, scene_digest, when_s, passed, is_expert,
             measure.key, measure.value, measure.better, {digest}
         FROM attempt LEFT JOIN measure ON measure.attempt = attempt.id
         WHERE (?1 IS NULL OR trainee = ?1) AND (?2 IS NULL OR task = ?2)
         ORDER BY when_s, attempt.id, measure.place"
    ))?;
    let mut rows = query.query(params![filter.trainee, filter.task])?;
    let mut attempts: Vec<Attempt> = Vec::new();
    let mut last = None;
    while let Some(row) = rows.next()? {
        let id: i64 = row.get(0)?;
        if last.replace(id) != Some(id) {
            attempts.push(attempt(row)?);
        }
        if let (Some(measure), Some(attempt)) = (measure(row)?, attempts.last_mut()) {
            attempt.measures.push(measure);
        }
    }
    Ok(attempts)
}

fn attempt(row: &Row<'_>) -> rusqlite::Result<Attempt> {
    Ok(Attempt {
        session: PathBuf::from(row.get::<_, String>(1)?),
        session_digest: row.get(11)?,
        trainee: row.get(2)?,
        task: row.get(3)?,
        scene_digest: row.get(4)?,
        when: row.get(5)?,
        passed: row.get(6)?,
        is_expert: row.get(7)?,
        measures: Vec::new(),
    })
}

fn measure(row: &Row<'_>) -> rusqlite::Result<Option<Measure>> {
    let Some(key) = row.get(8)? else {
        return Ok(None);
    };
    let word: String = row.get(10)?;
    let unknown =
        || rusqlite::Error::InvalidColumnType(10, word.clone(), rusqlite::types::Type::Text);
    Ok(Some(Measure {
        key,
        value: row.get(9)?,
        better: Better::of_word(&word).ok_or_else(unknown)?,
    }))
}
