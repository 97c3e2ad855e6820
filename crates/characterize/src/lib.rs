//! From recordings to tissue.
//!
//! ```text
//! Recording ──clean──▶ CleanRecording ──▶ analyze   (what was measured: statistics, no model)
//!                                     └─▶ models ── fit ──▶ parameters, their uncertainty, warnings ──▶ Tissue
//! ```
//!
//! The crate reads and writes no file and prints nothing; it starts no thread that outlives a call.
//!
//! ```
//! use palpate_characterize::clean::{CleanSettings, clean};
//! use palpate_characterize::{CharacterizeSettings, characterize, inverse::CandidateLaw};
//! use palpate_files::{Recording, recording::ForeignColumns};
//!
//! let recording = Recording::read_foreign("../../assets/first/liver-4mm.csv", &ForeignColumns::default())?;
//! let cleaned = clean(&recording, &CleanSettings::default())?;
//! let settings = CharacterizeSettings { laws: vec![CandidateLaw::NeoHookean], ..Default::default() };
//! let found = characterize(&[cleaned], &settings, &mut |_| ());
//! let tissue = found.tissue(None)?; // law, Prony series and the standard error of each number
//! println!("{}", tissue.to_toml());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod analyze;
pub mod clean;
pub mod design;
mod error;
pub mod fit;
mod grouping;
pub mod inverse;
pub mod lumped;
pub mod online;
mod specimen;
pub mod viscoelastic;
mod without_geometry;

pub use analyze::{Analysis, analyze};
pub use clean::{CleanRecording, CleanSettings, clean};
pub use error::Error;
pub use grouping::specimens;
pub use specimen::{
    Characterization, CharacterizeSettings, FittedLaw, FittedRecording, FittedRelaxation,
    characterize, characterize_organ,
};
pub use without_geometry::WithoutGeometry;
