//! Cutting: where a blade opens the organ, what it feels, and what lies under the opening (section 7.7).
//!
//! ```text
//! contact ──lead──▶ blade on the surface ──advance──▶ CutSurface (openings) ──place──▶ what is seen
//!    ▲                     │ lags by R d/k                    │
//!    └──── force ──────────┘                                  └──▶ facets of the slit ──▶ mechanics
//! ```
//!
//! A tool cuts while its `cut` is 1 and it is scissors or a hook, or, whatever it is, once its normal force has
//! passed a limit and as long as it touches then: the two ways of the source (section 7.8). A cut goes down to
//! the innermost layer. That one gives way at a force of its own, which is an event and opens nothing.
//!
//! *Equations*: a cut of depth d takes R d of work per length, R being the tissue's toughness, so an edge that is
//! drawn through it is held back by no more than R d [N]: it takes the tissue along until that is reached, then
//! goes on, a slider with friction that makes no energy. With the contact's tangential stiffness k the opening
//! lags behind the tip by R d/k. Scissors cut between their blades: R d is on the jaws and nothing lags.
//!
//! *How we know*: `cutting::…`.
//!
//! *Limits*: one blade at a time; a second one waits. A tip that slips is not held back. All cuts have the same
//! depth. A blade follows the surface at rest, as contacts do.

mod cuts;
mod gape;
mod lead;
mod model;
mod stroke;

pub(crate) use cuts::CutSegment;
pub use cuts::Cuts;
pub use gape::gape;
pub(crate) use lead::{Blade, lead};
pub(crate) use model::CuttingModel;
pub(crate) use stroke::advance;
