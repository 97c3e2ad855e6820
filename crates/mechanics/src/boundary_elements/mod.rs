//! Linear elasticity on the surface alone: boundary elements.
//!
//! Somigliana's identity at the centroid of each flat triangle, with displacement u and traction t constant
//! on it (4.1) to (4.5):
//!
//! ```text
//! ½ uᵢ + Σⱼ Tᵢⱼ uⱼ = Σⱼ Uᵢⱼ tⱼ,   Tᵢⱼ = ∫ⱼ p* dA,   Uᵢⱼ = ∫ⱼ u* dA
//! ```
//!
//! with Kelvin's displacement u* and traction p* ([`Kelvin`]), which the source misprints
//! (`docs/errata.md`). All integrals are closed forms.
//!
//! *How we know*: `boundary_elements::…`: quadrature of the kernels, rigid motions, Kelvin's and Lamé's
//! solutions, the linear patch test with its order.
//!
//! *Limits*: constant elements err with the first power of their size; one solid, linear and homogeneous.

mod assembly;
mod integrals;
mod kelvin;
mod panel;

pub use assembly::{InfluenceMatrices, Influences};
pub use integrals::{PanelIntegrals, Place, integrate};
pub use kelvin::Kelvin;
pub use panel::Panel;
