use std::path::PathBuf;

use crate::Error;

/// One attempt at a task.
#[derive(Debug, Clone, PartialEq)]
pub struct Attempt {
    /// Who.
    pub trainee: String,
    /// The title of the task.
    pub task: String,
    /// Tells scenes apart that have a task of the same title.
    pub scene_digest: String,
    /// Since the beginning of 1970, without leap seconds [s].
    pub when: i64,
    /// The folder that its session was in; another session may have taken its place since.
    pub session: PathBuf,
    /// Names what happened: a digest of the session's rows. With the scene's digest, the trainee and the time it
    /// tells the attempt from all others.
    pub session_digest: String,
    /// Whether the task was done; none where there was nothing to be done.
    pub passed: Option<bool>,
    /// Whether others are judged by it.
    pub is_expert: bool,
    /// What was measured, each key once.
    pub measures: Vec<Measure>,
}

/// What became of an attempt that was added.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Added {
    /// It is in the record now.
    New,
    /// It was in the record already, which is as it was.
    AlreadyThere,
    /// It is in the record now, beside another attempt with the same session to the last bit.
    SameSession {
        /// Whose the other attempt is.
        trainee: String,
        /// When it was, since the beginning of 1970 [s].
        when: i64,
    },
}

/// A number of an attempt.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Measure {
    /// Its key, with its unit at the end where it has one: `left.path_m`.
    #[serde(rename = "measure")]
    pub key: String,
    /// In SI.
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
    /// Neither: it should be as an expert has it.
    Neither,
}

impl Attempt {
    /// The value of a measure.
    pub fn value(&self, key: &str) -> Option<f64> {
        let found = self.measures.iter().find(|measure| measure.key == key);
        found.map(|measure| measure.value)
    }

    /// Whether a record can keep it.
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
    /// How it stands in files: `less`, `more`, `neither`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Less => "less",
            Self::More => "more",
            Self::Neither => "neither",
        }
    }

    /// What a word stands for.
    pub(crate) fn of_word(word: &str) -> Option<Self> {
        let all = [Self::Less, Self::More, Self::Neither];
        all.into_iter().find(|better| better.word() == word)
    }
}
