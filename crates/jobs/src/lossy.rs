use std::path::{Path, PathBuf};

use serde::{Serialize, Serializer};

/// A path, or several, in an answer that is text.
pub trait LossyPath {
    /// With a mark (U+FFFD) in the place of bytes that are no text.
    type Text: Serialize;

    /// As text.
    fn text(&self) -> Self::Text;
}

impl LossyPath for PathBuf {
    type Text = String;

    fn text(&self) -> String {
        Path::to_string_lossy(self).into_owned()
    }
}

impl<P: LossyPath> LossyPath for &P {
    type Text = P::Text;

    fn text(&self) -> P::Text {
        (*self).text()
    }
}

impl LossyPath for Option<PathBuf> {
    type Text = Option<String>;

    fn text(&self) -> Option<String> {
        self.as_ref().map(LossyPath::text)
    }
}

impl LossyPath for Vec<PathBuf> {
    type Text = Vec<String>;

    fn text(&self) -> Vec<String> {
        self.iter().map(LossyPath::text).collect()
    }
}

/// Writes a path whose bytes need not be text, for `#[serde(serialize_with = "…")]`: the name of a file is any bytes on
/// most systems, and JSON holds text.
///
/// # Errors
/// As the serializer.
pub fn lossy<S: Serializer>(path: &impl LossyPath, serializer: S) -> Result<S::Ok, S::Error> {
    path.text().serialize(serializer)
}
