//! What a tissue is made of: a law between deformation and stress, and its relaxation in time.

pub(crate) mod law;
pub(crate) mod linear_elastic;
pub(crate) mod prony;
