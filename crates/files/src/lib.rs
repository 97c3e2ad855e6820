//! The six open documents of palpate: the protocol of a measurement, its recording, the motion of tools, the session
//! of a simulation, the tissue of an organ, and the scene.
//!
//! [`Recording`], [`Motion`] and [`Session`] are tables of numbers (CSV), [`Tissue`], [`Scene`] and
//! [`Protocol`] are TOML. All are in SI units; a key or a column in another unit says so in its name
//! (`depth_mm`) and is converted on reading, see [`units`]. An [`Error`] names the file, the line,
//! the value found and the value expected.
//!
//! In addition, [`StoredResponse`] caches the response of an organ that a model has prepared, which takes minutes; it
//! is not for people.
//!
//! [`printable`] shows text from elsewhere, [`text_cell`] puts it into cells of tables, and [`quantity`] writes
//! numbers.
//!
//! The documents hold plain numbers. They do not depend on meshes, mechanics or devices, so that each verb (measure,
//! characterize, simulate) can be used without the others.
//!
//! ```
//! use palpate_files::{Scene, Tissue};
//!
//! let text = r#"
//! format = 1
//! tissue = { law = "neo_hookean", c10_pa = 452.9 }
//! "#;
//! let tissue = Tissue::parse(text, "liver.toml")?;
//! assert_eq!(tissue.elasticity.values()[0], 452.9); // [Pa]
//!
//! let refused = Scene::parse("format = 1\norgan = { builtin = \"lver\" }", "scene.toml").unwrap_err();
//! println!("{refused}"); // names the file, the line, and the word that was meant
//! assert!(refused.to_string().starts_with("scene.toml line 2"));
//! # Ok::<(), palpate_files::Error>(())
//! ```

mod atomic_write;
pub mod card;
mod claim;
mod domain;
mod error;
mod estimate;
mod fibre_directions;
pub mod motion;
mod partial;
mod printable;
pub mod protocol;
pub mod quantity;
pub mod recording;
mod response;
pub mod scene;
pub mod session;
pub mod settings;
mod table;
pub mod tissue;
mod toml_document;
pub mod units;
mod words;

pub use atomic_write::{
    MAX_DOCUMENT_BYTES, MAX_TABLE_BYTES, read_bytes, read_text, write_atomically,
};
pub use claim::{Claim, Overwrite, remove_claims};
pub use domain::Domain;
pub use error::{Error, Place, names_wrong_path};
pub use estimate::Estimate;
pub use fibre_directions::{FibreDirection, FibreDirections};
pub use motion::{Motion, Pose};
pub use printable::{cell_text, is_hidden, printable, printable_lines, text_cell};
pub use protocol::Protocol;
pub use recording::Recording;
pub use response::StoredResponse;
pub use scene::Scene;
pub use session::{Event, Events, Session, SessionHeader, SessionRow, SessionWriter};
pub use settings::{Language, MouseHand, Settings};
pub use table::{Incomplete, unfinished};
pub use tissue::{BuiltinTissue, Elasticity, PronyTerm, Tissue};
pub use toml_document::{Document, Key, Keys, Omitted, ValueType, Word};
