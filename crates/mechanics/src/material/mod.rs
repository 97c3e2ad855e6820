//! The material of a tissue: a law between deformation and stress, and its relaxation in time.

pub(crate) mod exponential;
pub(crate) mod fibres;
pub(crate) mod holzapfel_gasser_ogden;
mod isochoric;
pub(crate) mod law;
pub(crate) mod linear_elastic;
#[expect(clippy::module_inception, reason = "the file is named for its type")]
pub(crate) mod material;
pub(crate) mod mooney_rivlin;
pub(crate) mod neo_hookean;
pub(crate) mod ogden;
mod principal;
pub(crate) mod prony;
pub(crate) mod reduced_polynomial;
pub(crate) mod volume;
