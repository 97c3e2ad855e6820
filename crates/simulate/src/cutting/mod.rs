//! Cutting: where a blade opens the organ, what it feels, and what lies under the opening (section 7.7).
//!
//! ```text
//! contact ──lead──▶ blade on the surface ──advance──▶ CutSurface (openings) ──place──▶ what is seen
//!    ▲                     │ lags by R d/k                    │
//!    └──── force ──────────┘                                  └──▶ facets of the slit ──▶ mechanics
//! ```
//!
//! A tool is a blade while its `cut` is 1 and it is scissors or a hook, or, whatever it is, once its normal force
//! has passed the limit of the layer that is bare under it and as long as it touches then: the two ways of the
//! source (section 7.8). Each layer is opened by itself:
//!
//! - a blade opens the layers whose lower faces its edge has reached, by its depth below the surface at rest; one
//!   that is shallower than the outermost layer scratches and opens nothing;
//! - the layer that is bare gives way to a normal force above its own limit, one layer a step.
//!
//! Where the outermost layer is open, a blade goes on in the opening and opens what is below. The innermost layer
//! opens as the others do; that is a perforation. An organ without layers is one, and a blade cuts it to the depth
//! of `[cutting]`.
//!
//! *Equations*: a cut takes R d of work per length, R being a layer's toughness and d how much of the layer the edge
//! is in, so an edge that is drawn through layers is held back by no more than Σ R d [N]: it takes the tissue along
//! until that is reached, then goes on, a slider with friction that makes no energy. With the contact's tangential
//! stiffness k the opening lags behind the tip by Σ R d/k. Scissors cut between their blades: Σ R d is on the jaws
//! and nothing lags.
//!
//! *How we know*: `cutting::…`, `layers::…`.
//!
//! *Limits*: one blade at a time opens the outermost layer; a second one waits. A tip that slips is not held back. A
//! layer below the outermost opens part by part of the cut above it, which are as long as the surface's edges. What
//! a deepened cut yields is known when the blade is lifted. A blade follows the surface at rest, as contacts do.

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
