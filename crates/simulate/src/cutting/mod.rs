//! Cutting: where a blade opens the organ, the resistance of the tissue, and the tissue below the opening (section
//! 7.7).
//!
//! ```text
//! contact ──track─▶ blade on the surface ──advance──▶ CutSurface (openings) ──place──▶ display mesh
//!    ▲                     │ lags by R d/k                    │
//!    └──── force ──────────┘                                  └──▶ facets of the slit ──▶ mechanics
//! ```
//!
//! A tool is a blade while its `cut` is 1 and it is scissors or a hook, or, whatever its kind, once its normal force
//! has exceeded the limit of the exposed layer under it and as long as it then touches: the two ways of the source
//! (section 7.8). Each layer opens by itself:
//!
//! - a blade opens the layers whose lower faces its edge has reached, by its depth below the surface at rest; one that
//!   is shallower than the outermost layer scratches and opens nothing;
//! - the exposed layer gives way to a normal force above its own limit, one layer per step.
//!
//! Where the outermost layer is open, a blade continues in the opening and opens the layers below. The innermost layer
//! opens as the others do; that is a perforation. An organ without layers has one, and a blade cuts it to the depth of
//! `[cutting]`.
//!
//! *Equations*: a cut takes the work R d per length, R being a layer's toughness and d the depth of the edge within the
//! layer, so at most Σ R d [N] resists an edge that is drawn through layers: the edge takes the tissue along until that
//! force is reached, then moves on, a slider with friction that generates no energy. With the contact's tangential
//! stiffness k the opening lags behind the tip by Σ R d/k. Scissors cut between their blades: Σ R d acts on the jaws
//! and nothing lags.
//!
//! *How we know*: `cutting::…`, `layers::…`.
//!
//! *Limits*: one blade at a time opens the outermost layer; a second one waits. Nothing resists a tip that slips. A
//! layer below the outermost opens part by part of the cut above it; the parts are as long as the surface's edges. The
//! compliance of a deepened cut changes when the blade is lifted. A blade follows the surface at rest, as contacts do.

mod blade_tracking;
mod cut_path;
mod cuts;
mod gape;
mod model;
mod parts;

pub(crate) use blade_tracking::{Blade, track_blade};
pub(crate) use cut_path::advance;
pub use cuts::Cuts;
pub use gape::gape;
pub(crate) use model::{CuttingModel, cuts};
pub use parts::CutPart;
