//! The whole organ: how its surface answers forces anywhere on it, prepared once (section 4.2).
//!
//! ```text
//! shown surface ──simplify──▶ mechanical surface ──boundary elements──▶ SurfaceResponse ◀──▶ stored file
//!       ▲                                                                    │
//!       └──────────── carried by the displacements of its triangles ◀────────┘ forces of the tips
//! ```
//!
//! A coarse mesh is enough for the mechanics, since the tip has its own law ([`TipLaw`]) and the organ
//! around it only yields further; the fine one is what is seen.
//!
//! *How we know*: `hybrid::…`.
//!
//! *Limits*: the organ around a tip answers as at small strain; nothing of it moves through its anchor.
//!
//! [`TipLaw`]: palpate_mechanics::TipLaw

mod key;
mod mechanical_surface;
mod solve;

use palpate_files::Scene;
use palpate_geometry::{AabbTree, Surface};
use palpate_mechanics::LinearElastic;
use palpate_mechanics::enhance::{Carrier, EnhancementModel};
use palpate_mechanics::surface_response::SurfaceResponse;
use std::ops::ControlFlow;

use crate::{Error, Progress, Resources};
pub use solve::{StoredPlace, is_stored};

/// How the whole organ answers.
#[derive(Debug, Clone)]
pub(crate) struct GlobalModel {
    /// Of the mechanical surface.
    pub(crate) response: SurfaceResponse,
    /// How displacements of triangles are spread over it.
    pub(crate) enhancement: EnhancementModel,
    /// The vertices that are shown.
    pub(crate) carrier: Carrier,
    /// Around the mechanical surface.
    pub(crate) tree: AabbTree,
}
