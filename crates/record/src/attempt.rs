use std::path::PathBuf;

use crate::Error;

/// One attempt at a task.
#[derive(Debug, Clone, PartialEq)]
pub struct Attempt {
    /// The trainee.
    pub trainee: String,
    /// The title of the task.
    pub task: String,
    /// The scene's digest: distinguishes scenes that have a task of the same title.
    pub scene_digest: String,
    /// Time, since the beginning of 1970, without leap seconds [s].
    pub when: i64,
    /// The folder of its session; another session may have replaced it since.
    pub session: PathBuf,
    /// The digest of the session's rows. With the scene's digest, the trainee and the time it identifies the attempt.
    pub session_digest: String,
    /// Whether the attempt passed; none for a task without a goal.
    pub passed: Option<bool>,
    /// Whether it is a reference attempt, against which others are judged.
    pub is_expert: bool,
    /// The measures, each key once.
    pub measures: Vec<Measure>,
}

/// The result of adding an attempt.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Added {
    /// The attempt was added.
    New,
    /// The record already had the attempt and is unchanged.
    AlreadyThere,
    /// The attempt was added, and the record has another attempt whose session is identical to the last bit.
    SameSession {
        /// The trainee of the other attempt.
        trainee: String,
        /// Time of the other attempt, since the beginning of 1970 [s].
        when: i64,
    },
}

/// A measure of an attempt.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Measure {
    /// Its key, with its unit at the end where it has one: `left.path_m`.
    #[serde(rename = "measure")]
    pub key: String,
    /// In SI units.
    pub value: f64,
    /// Which is better.
    pub better: Better,
}

/// Which of two values is better.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Better {
    /// The smaller one.
    Less,
    /// The larger one.
    More,
    /// Neither: the target is the experts' value.
    Neither,
}

impl Attempt {
    /// The value of a measure.
    pub fn value(&self, key: &str) -> Option<f64> {
        let found = self.measures.iter().find(|measure| measure.key == key);
        found.map(|measure| measure.value)
    }

    /// Whether a record can store it.
    pub(crate) fn check(&self) -> Result<(), Error> {
        for (what, name) in [("trainee", &self.trainee), ("task", &self.task)] {
            if name.trim().is_empty() {
                return Err(Error::Unnamed { what });
            }
        }
        for (place, Measure { key, value, .. }) in self.measures.iter().enumerate() {
            if key.trim().is_empty() {
                return Err(Error::Unnamed { what: "measure" });
            }
            if !value.is_finite() {
                let (key, value) = (key.clone(), *value);
                return Err(Error::NoNumber { key, value });
            }
            if self.measures[..place].iter().any(|other| other.key == *key) {
                return Err(Error::Twice { key: key.clone() });
            }
        }
        Ok(())
    }
}

impl Better {
    /// Its word in files: `less`, `more`, `neither`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Less => "less",
            Self::More => "more",
            Self::Neither => "neither",
        }
    }

    /// Parses such a word.
    pub(crate) fn of_word(word: &str) -> Option<Self> {
        let all = [Self::Less, Self::More, Self::Neither];
        all.into_iter().find(|better| better.word() == word)
    }
}
