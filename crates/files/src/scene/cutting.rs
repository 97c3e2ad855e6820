use crate::words::words;
use crate::{Domain, Error, Key, Keys};

words! {
    /// How the surface gives way to a blade.
    pub enum CutMode {
        /// Triangles are split where the blade passes, and the mechanics follow.
        Split = "split",
        /// The source's: vertices are moved under the blade and doubled, no triangle is added, and the force
        /// stays that of the uncut organ.
        Snap = "snap",
    }
}

/// Settings for cutting the organ. A depth that the scene leaves out follows from its layers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cutting {
    /// The method of cutting the surface.
    pub mode: CutMode,
    /// The largest depth of a cut [m], and the depth of every cut in an organ without layers.
    pub depth_m: Option<f64>,
    /// The width of an opening in its middle [m].
    pub width_m: f64,
    /// The fracture work per area of the cut face [J/m²], in layers that have no toughness of their own.
    pub toughness_j_per_m2: f64,
    /// The normal force at which any tool begins to cut [N]; none when it never does.
    pub force_limit_n: Option<f64>,
}

impl Default for Cutting {
    fn default() -> Self {
        Self {
            mode: CutMode::Split,
            depth_m: None,
            width_m: 0.0015,
            // The source could not measure it (section 7.8). That of bovine liver
            // [Gokgol, Basdogan and Canadinc 2012]; others found 76 to 225 for liver.
            toughness_j_per_m2: 164.0,
            force_limit_n: None,
        }
    }
}

impl Cutting {
    pub(super) const KEYS: &'static [Key] = &[
        Key::word("mode", CutMode::MEANINGS, "How the surface gives way.").default("\"split\""),
        Key::number(
            "depth_m",
            Domain::LENGTH,
            "How deep a cut goes: at most in an organ with layers, always in one without.",
        )
        .optional("0.0015", "with layers, no limit"),
        Key::number("width_m", Domain::LENGTH, "How far an opening gapes in its middle.")
            .default("0.0015"),
        Key::number(
            "toughness_j_per_m2",
            Domain::TOUGHNESS,
            "The work of a cut per area of its face, in layers that have no toughness of their own.",
        )
        .default("164.0"),
        Key::number(
            "force_limit_n",
            Domain::FORCE,
            "The normal force at which any tool begins to cut.",
        )
        .optional("2.0", "none does"),
    ];

    pub(super) fn from_keys(keys: Option<&Keys<'_>>) -> Result<Self, Error> {
        let default = Self::default();
        let Some(keys) = keys else {
            return Ok(default);
        };
        let or = |key, or: f64| Ok(keys.number(key)?.unwrap_or(or));
        Ok(Self {
            mode: keys.word("mode", CutMode::WORDS)?.unwrap_or(default.mode),
            depth_m: keys.number("depth_m")?,
            width_m: or("width_m", default.width_m)?,
            toughness_j_per_m2: or("toughness_j_per_m2", default.toughness_j_per_m2)?,
            force_limit_n: keys.number("force_limit_n")?,
        })
    }
}
