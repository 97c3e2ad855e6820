//! Self-contained pages: one file of HTML that needs no network and runs no script, on a screen, light or dark, and
//! on paper. Markup is that of XHTML, so that any reader of XML can check it; pictures are drawn by [`crate::plot`].
//! The commands write the content.

mod markup;
mod page;
mod provenance;
mod symbol;
mod table;
mod words;

pub(crate) use markup::Markup;
pub(crate) use page::{Page, figure};
pub(crate) use palpate_files::quantity::{Scale, quantity, rounded, unit};
pub(crate) use provenance::{Provenance, provenance};
pub(crate) use symbol::symbol;
pub(crate) use table::Table;
pub(crate) use words::{count, warning_list};
