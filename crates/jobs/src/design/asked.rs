use std::path::PathBuf;

use palpate_characterize::design::Criterion;
use serde::Deserialize;

use super::{Known, Request, Within};
use crate::characterize::Choice;
use crate::{Error, Recordings};

/// What is asked for as JSON.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RequestDocument {
    tissue: Option<PathBuf>,
    recordings: Recordings,
    law: Option<String>,
    parameters: Vec<String>,
    criterion: String,
    within: Within,
}

impl Request {
    /// What other programs ask for, as JSON.
    ///
    /// # Errors
    /// When the text is none, or a law or a criterion is not known.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let asked: RequestDocument = serde_json::from_str(text).map_err(Error::input)?;
        let law = asked.law.as_deref();
        let law = law.map(|name| Choice::law_named(name, None)).transpose()?;
        Ok(Self {
            known: match asked.tissue {
                Some(path) => Known::Tissue(path),
                None => Known::Recordings(asked.recordings, law),
            },
            parameters: asked.parameters,
            criterion: match asked.criterion.as_str() {
                "minimax" => Criterion::Minimax,
                "d_optimal" => Criterion::Determinant,
                other => {
                    return Err(Error::input(format!(
                        "there is no criterion `{other}`; name minimax or d_optimal"
                    )));
                }
            },
            within: asked.within,
        })
    }
}
