//! Small dense systems, solved in place: by factors, or by iteration as the source has it.

pub(crate) mod dense;
pub(crate) mod gmres;
