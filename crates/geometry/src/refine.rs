//! Refinement of tetrahedra, and tetrahedra that do not cross given levels or that follow sharp edges.
//!
//! By bisection with marked edges [Arnold, Mukherjee and Pouly 2000]: each tetrahedron stores which of its edges is cut next and
//! which edge of each face, and its children inherit that, so that only finitely many shapes come of one tetrahedron and neighbours
//! always agree. New vertices of the boundary move onto the surface (`shell`), unless that would spoil a tetrahedron; vertices
//! inside move where that opens a flat one (`relax`), those between regions excepted. A level (`level`) gets vertices where edges
//! cross it: ends that move there, or new ones. The sharp edges of a surface (`sharp`) are what its `facets` meet in; an edge of
//! the boundary from one facet to another gets a vertex there in the same way.
//!
//! *How we know*: `refine::stays_sound_and_well_shaped`, `refine::real_organs_are_refined`,
//! `refine::a_circle_is_resolved`, `refine::balls_become_sets_of_tetrahedra`,
//! `sharp_edges::…`.
//!
//! *Limits*: a bisected tetrahedron may have angles of about half those of the one it came from. A
//! vertex that cannot move stays on the chord. Levels are met by flat triangles.
//! A sharp edge that ends within a facet, as the crest of a thin rim may, is not followed.

mod bisection;
mod facets;
mod level;
mod near;
mod relax;
mod sharp;
mod shell;
mod split;

pub use level::{Level, Resolved, resolve_levels};
pub use near::refine_to;
pub(crate) use relax::{FLAT, SWEEPS, open_around};
pub use sharp::follow_sharp_edges;
pub(crate) use shell::{dihedral_quality, move_if_valid};
pub(crate) use split::SplitNet;
