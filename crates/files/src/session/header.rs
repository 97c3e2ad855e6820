use crate::scene::ModelKind;
use crate::table::header_line;
use crate::toml_document::{quoted, toml_number};
use crate::{Domain, Error, Key, Keys};

/// The conditions of a session.
#[derive(Debug, Clone, PartialEq)]
pub struct SessionHeader {
    /// The version of the program.
    pub version: String,
    /// A digest of the scene with all its files.
    pub scene_digest: String,
    /// The model.
    pub model: ModelKind,
    /// The model's period [s].
    pub step_s: f64,
    /// The seed of all random numbers.
    pub seed: u64,
    /// Factor on every force [-].
    pub force_scale: f64,
}

impl SessionHeader {
    pub(super) const KEYS: &'static [Key] = &[
        Key::text("version", "The version of the program.").required("\"0.2.0\""),
        Key::text(
            "scene_digest",
            "A digest of the scene with all that belongs to it.",
        )
        .required("\"\""),
        Key::word("model", ModelKind::MEANINGS, "The model.").required("\"local\""),
        Key::number("step_s", Domain::STEP, "The model's period.").required("0.005"),
        Key::integer(
            "seed",
            0,
            u64::MAX,
            "The seed of whatever was drawn by chance.",
        )
        .required("1"),
        Key::number("force_scale", Domain::FACTOR, "Factor on every force.").required("1.0"),
    ];

    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let text = |key| {
            keys.text(key)?
                .ok_or_else(|| keys.missing(key, "a text in double quotes"))
        };
        let model = keys.word("model", ModelKind::WORDS)?;
        let seed = keys.integer("seed")?;
        Ok(Self {
            version: text("version")?,
            scene_digest: text("scene_digest")?,
            model: model.ok_or_else(|| keys.missing("model", "\"local\" or \"hybrid\""))?,
            step_s: keys.required_number("step_s")?,
            seed: seed.ok_or_else(|| keys.missing("seed", "a whole number"))?,
            force_scale: keys.required_number("force_scale")?,
        })
    }

    /// The lines above the names of the columns.
    pub(super) fn print(&self) -> String {
        [
            header_line("format", 1),
            header_line("version", quoted(&self.version)),
            header_line("scene_digest", quoted(&self.scene_digest)),
            header_line("model", quoted(self.model.word())),
            header_line("step_s", toml_number(self.step_s)),
            header_line("seed", self.seed),
            header_line("force_scale", toml_number(self.force_scale)),
        ]
        .concat()
    }
}
