//! Relaxation of a tissue, without knowledge of its elastic law (section 6.4.2).
//!
//! One relaxation function for the whole body: with the elastic force Fₑ of the depth,
//!   F(t) = Fₑ − Σ gᵢ hᵢ(t),  τᵢ ḣᵢ = Fₑ − hᵢ,
//! and the real depth d(t) of the indenter, not a step. Only the shape of Fₑ matters, and only while the
//! depth changes: Fₑ = A s(d/D) (d/D)^μ with a given s, the size A of each recording and one exponent μ
//! for all of them. A step cannot be distinguished from its relaxed modulus, a ramp can: [`relaxation_of_steps`] is
//! provided too, since the source finds no difference.
//!
//! *How we know*: `viscoelastic::…`: true series of made recordings in their intervals, the product form
//! there and back, a ramp against its closed form.
//!
//! *Limits*: one relaxation function at every depth; what is faster than two samples or slower than the
//! recording is not in it.

mod model;
mod product_form;
mod relaxation;
mod while_pressing;

pub use model::RelaxationRecord;
pub(crate) use model::terms;
pub use product_form::ProductForm;
pub(crate) use relaxation::{QUASI_LINEAR, even, expected_relaxation, quasi_linear};
pub use relaxation::{Relaxation, RelaxationSettings, relaxation, relaxation_of_steps};
pub(crate) use while_pressing::PressedRelaxation;
