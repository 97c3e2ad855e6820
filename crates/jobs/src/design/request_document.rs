use std::path::PathBuf;

use palpate_characterize::design::Criterion;
use serde::Deserialize;

use super::{Known, Request, Within};
use crate::characterize::Choice;
use crate::{Error, Recordings};

/// A request as JSON.
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
    /// The request of another program, as JSON.
    ///
    /// # Errors
    /// When the text is no request, or a law or a criterion is unknown.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let request: RequestDocument = serde_json::from_str(text).map_err(Error::input)?;
        let law = request.law.as_deref();
        let law = law.map(|name| Choice::law_named(name, None)).transpose()?;
        Ok(Self {
            known: match request.tissue {
                Some(path) => Known::Tissue(path),
                None => Known::Recordings(request.recordings, law),
            },
            parameters: request.parameters,
            criterion: match request.criterion.as_str() {
                "minimax" => Criterion::Minimax,
                "d_optimal" => Criterion::Determinant,
                other => {
                    return Err(Error::input(format!(
                        "there is no criterion `{other}`; name minimax or d_optimal"
                    )));
                }
            },
            within: request.within,
        })
    }
}
