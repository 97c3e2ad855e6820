use super::Tissue;
use crate::words::words;

words! {
    /// A tissue that comes with the program: the source's measurements on living pigs.
    pub enum BuiltinTissue {
        /// Liver at 6 mm (tables 6-3 and 6-4).
        PigLiver = "pig-liver",
        /// Kidney at 5 mm (tables 6-3 and 6-4).
        PigKidney = "pig-kidney",
        /// Spleen (table 6-1).
        PigSpleen = "pig-spleen",
        /// Lower esophagus (section 6.4.5).
        PigEsophagus = "pig-esophagus",
    }
}

impl BuiltinTissue {
    /// The tissue's file, which may be copied and changed.
    pub fn text(self) -> &'static str {
        match self {
            Self::PigLiver => include_str!("builtin/pig-liver.toml"),
            Self::PigKidney => include_str!("builtin/pig-kidney.toml"),
            Self::PigSpleen => include_str!("builtin/pig-spleen.toml"),
            Self::PigEsophagus => include_str!("builtin/pig-esophagus.toml"),
        }
    }
}

impl Tissue {
    /// A tissue that comes with the program. Each has warnings: the published numbers contradict one another.
    pub fn builtin(tissue: BuiltinTissue) -> Self {
        Self::parse(tissue.text(), tissue.word()).expect("a test reads every built-in tissue")
    }
}
