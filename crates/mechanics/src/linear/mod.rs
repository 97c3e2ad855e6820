//! Small dense systems, solved in place: by factors, or by iteration as the source has it; and sparse
//! symmetric ones.

pub(crate) mod dense;
pub(crate) mod gmres;
pub(crate) mod sparse;
