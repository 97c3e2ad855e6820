//! Triangle and tetrahedron meshes, and geometric queries on them.
//!
//! A [`TriangleMesh`] is any list of triangles; a [`Surface`] is one that has been checked: closed,
//! manifold, oriented outward, in one piece. Code that works on an organ takes a `Surface`.
//! A [`TetrahedronMesh`] fills one, for finite elements.
//!
//! ```
//! use palpate_geometry::{AabbTree, Organ, Surface, Vec3};
//!
//! // Watertight, manifold, oriented outward, or an error with the place.
//! let liver = Surface::new(Organ::Liver.surface_mesh(5000)?)?;
//! let tree = AabbTree::new(liver.mesh());
//!
//! // A point 2 mm outside the first vertex.
//! let vertex = liver.mesh().vertices()[0];
//! let point = vertex + 2e-3 * liver.vertex_normals()[0];
//! let nearest = tree.nearest(liver.mesh(), &point);
//! assert!((point - nearest.on.position).norm() <= 2e-3 * (1.0 + 1e-12)); // [m]
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod aabb_tree;
mod check;
mod coarsen;
mod cores;
mod cut;
mod deviation;
mod fill;
mod flood;
mod io;
mod isosurface;
mod label_map;
mod memoized;
mod mesh;
mod neighborhood_watch;
mod organ;
mod orient;
mod patch_field;
mod proximity;
mod refine;
mod simplify;
mod slit;
mod surface;
mod weld;
mod wrap;

pub use aabb_tree::{AabbTree, Hit, Nearest, ray_meets_triangle};
pub use check::problem::{MeshProblem, ProblemKind};
pub use check::{MeshReport, inspect};
pub use coarsen::{coarsen, coarsen_with_progress};
pub use cores::{collect_on_all_cores, cores, on_all_cores, threads_were_refused};
pub use cut::error::CutError;
pub use cut::net::{Origin, Side};
pub use cut::{CutMethod, CutProgress, CutSurface};
pub use deviation::{Deviation, deviation};
pub use fill::{Fidelity, FillSettings, fill, fill_graded};
pub use io::error::{ReadError, ReadFault, UnknownUnit};
pub use io::format::MeshFormat;
pub use io::label_map::dicom::{DicomFolder, DicomSeries, read_dicom_folder};
pub use io::label_map::read_label_map;
pub use io::unit::{LengthUnit, extent_warning, is_plausible_extent, unit_by_extent};
pub use io::volume::{ImportedTetrahedra, VolumeFormat, VolumeRegion, read_tetrahedra};
pub use io::vtk;
pub use io::write::WriteFormat;
pub use io::{ImportedMesh, read_mesh};
pub use isosurface::{
    Isosurface, IsosurfaceError, IsosurfaceSettings, MAX_VOXEL_TRIANGLES, isosurface,
    isosurface_with_progress,
};
pub use label_map::{Label, LabelMap};
pub use mesh::adjacency::Adjacency;
pub use mesh::error::MeshError;
pub use mesh::tetrahedra::{HollowMesh, TetrahedronError, TetrahedronMesh, TetrahedronQuality};
pub use mesh::triangles::{NodeId, TriangleId, TriangleMesh};
pub use neighborhood_watch::{ContactPoint, FASTEST_TURN, follow, project_contact_point};
pub use organ::{AnchorPlane, Organ, OrganDescription, OrganError};
pub use patch_field::{Patch, PatchField};
pub use proximity::{PointOnTriangle, closest_on_triangle};
pub use refine::{Level, Resolved, follow_sharp_edges, refine_to, resolve_levels};
pub use simplify::{
    Simplified, SimplifyError, SimplifySettings, simplify, simplify_graded, simplify_with_progress,
};
pub use slit::{SlitPoint, SlitTetrahedra};
pub use surface::{SHARP_EDGE, Surface};
pub use weld::{Repairs, repair, weld_exactly};
pub use wrap::{Gaps, WrapError, WrapSettings, Wrapped, wrap, wrap_with_progress};

/// A point or a vector in space [m, unless stated otherwise].
pub type Vec3 = nalgebra::Vector3<f64>;
