//! A solid of any shape, fixed in one place, and moved by a tool or loaded in others.
//!
//! Quadratic tetrahedra with a pressure field fill the body [Taylor and Hood 1973], refined
//! towards the edge of the patch that the tool moves and that of the anchor (`grading`). The patch is a set of whole triangles
//! within a radius of a point; *stick* prescribes all three components of its displacement, *slip* only
//! the one along the displacement. With K the tangent and r the residual,
//!   K Δu = −r, u prescribed where the body is fixed or moved,
//! once at small strain, and in steps at finite strain; the force is Σ r over the nodes of the patch. Weight and forces on
//! the boundary are dead loads: they keep their direction while the body turns. A pressure stays normal to the boundary.
//! All grow with the displacement of the patch.
//!
//! Regions have laws of their own. Tetrahedra are cut at their borders, and pressures jump there. Where a region is a
//! cavity its tetrahedra are taken out, and its wall bears a pressure or that of a fluid of constant volume.
//!
//! Rigid tools come after patch and loads: they move along paths of their own, and the boundary meets them with friction
//! (`rigid_tool`). The mesh is finer where they meet the boundary at rest (`footprint`).
//!
//! *How we know*: `rigid_tools::…`, `solid::a_patch_on_a_cube_is_a_punch` (axisymmetric elements and the half-space),
//! `solid::a_patch_on_a_hemisphere_is_3_percent_stiffer_than_on_a_half_space`,
//! `solid::the_force_converges_with_the_edge_of_the_patch`, `cavities::…`, `thin_patch::a_patch_on_a_thin_edge_has_its_area`, and energy, equilibrium and turned bodies.
//!
//! *Limits*: a patch neither grows nor shrinks. Tissue that comes to a tool from farther than half the length of its path and
//! two sizes of its contact passes through it, with a warning. Where the
//! anchor ends inside a side, it ends along whole triangles. A body without a surface of its own keeps
//! its facets. A third mesh of an organ takes gigabytes and minutes.

mod answer;
mod cavities;
mod error;
mod footprint;
mod frame;
mod grading;
mod loads;
mod mesh;
mod patch;
mod problem;
mod regions;
mod run;
mod solve;
mod supports;

pub(crate) use mesh::{Face, faces, take_walls};

pub use answer::{CavityAnswer, SolidAnswer, SolidFields};
pub use error::SolidError;
pub use problem::{
    Body, LoadPlace, Loads, MovedPatch, RegionContent, SolidPlace, SolidProblem, SolidRegion,
    SurfaceLoad, Weight,
};
pub use run::{solve, solve_at};
pub use solve::ToolIncrement;
