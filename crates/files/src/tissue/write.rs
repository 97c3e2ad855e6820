use std::fmt::Write;
use std::path::Path;

use super::{Tissue, TissueSource};
use crate::toml_document::quoted;
use crate::{Error, write_atomically};

impl Tissue {
    /// The text of a tissue file, which [`Tissue::parse`] reads back to the same tissue.
    pub fn to_toml(&self) -> String {
        let mut text = "format = 1\n\n[tissue]\n".to_owned();
        if let Some(name) = &self.name {
            line(&mut text, "name", &quoted(name));
        }
        line(&mut text, "density_kg_m3", &self.density_kg_m3.to_toml());
        line(&mut text, "law", &quoted(self.elasticity.law().word()));
        for (key, estimate) in self.elasticity.parameters() {
            line(&mut text, key, &estimate.to_toml());
        }
        if !self.prony.is_empty() {
            let terms: Vec<_> = self.prony.iter().map(|term| term.to_toml()).collect();
            line(&mut text, "prony", &list(&terms));
        }
        for (table, parameters) in self.lumped.tables() {
            heading(&mut text, &format!("tissue.lumped.{table}"));
            for (key, estimate) in parameters {
                line(&mut text, key, &estimate.to_toml());
            }
        }
        if self.source != TissueSource::default() {
            heading(&mut text, "tissue.source");
            self.source.write(&mut text);
        }
        text
    }

    /// Writes a tissue file, whole or not at all.
    ///
    /// # Errors
    /// When a value is one that [`Tissue::read`] refuses, or the operating system refuses.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let text = self.to_toml();
        // The writer checks the text with the reader.
        Self::parse(&text, &path).map_err(Error::of_content)?;
        write_atomically(path, text.as_bytes())
    }
}

impl TissueSource {
    fn write(&self, text: &mut String) {
        let quote = |texts: &[String]| texts.iter().map(|t| quoted(t)).collect::<Vec<_>>();
        if !self.recordings.is_empty() {
            line(text, "recordings", &list(&quote(&self.recordings)));
        }
        if let Some(method) = &self.method {
            line(text, "method", &quoted(method));
        }
        if let Some(version) = &self.version {
            line(text, "version", &quoted(version));
        }
        if !self.warnings.is_empty() {
            line(text, "warnings", &list(&quote(&self.warnings)));
        }
    }
}

fn line(text: &mut String, key: &str, value: &str) {
    writeln!(text, "{key} = {value}").expect("a string takes every text");
}

fn heading(text: &mut String, table: &str) {
    writeln!(text, "\n[{table}]").expect("a string takes every text");
}

fn list(values: &[String]) -> String {
    match values {
        [only] => format!("[{only}]"),
        several => format!("[\n    {},\n]", several.join(",\n    ")),
    }
}
