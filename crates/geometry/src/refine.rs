//! Finer tetrahedra: around a place, everywhere, or along a circle.
//!
//! Around a place by bisection with marked edges [Arnold, Mukherjee and Pouly 2000]: each
//! tetrahedron knows which of its edges is cut next and which edge of each face, and its children
//! inherit that, so that only finitely many shapes come of one tetrahedron and neighbours always
//! agree. Everywhere by cutting each into eight [Bey 1995]. New vertices of the boundary move onto
//! the surface (`shell`), unless that would spoil a tetrahedron; vertices inside move where that
//! opens a flat one (`relax`).
//!
//! *How we know*: `refine::stays_sound_and_well_shaped`, `refine::real_organs_are_refined`,
//! `refine::a_circle_is_resolved`, `refine::eight_for_one_converges_to_the_surface`.
//!
//! *Limits*: a bisected tetrahedron may have angles of about half those of the one it came from. A
//! vertex that cannot move stays on the chord.

mod bisection;
mod near;
mod relax;
mod shell;
mod sphere;
mod uniform;

pub use near::{Focus, refine_near, refine_to};
pub use sphere::{Resolved, resolve_sphere};
pub use uniform::refine_uniformly;
