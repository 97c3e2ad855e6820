//! Tetrahedra that fill a closed surface: isosurface stuffing [Labelle and Shewchuk 2007].
//!
//! A body-centred cubic lattice covers the body. Each of its points is inside, outside, or on the
//! surface; where an edge passes from inside to outside, a ray finds the cut. A point that a cut
//! comes too near to moves there. The part inside of each tetrahedron of the lattice is one of a
//! few shapes, each cut into tetrahedra in a fixed way (`stencil`). All vertices of the boundary
//! lie on the surface, and between the faces of a tetrahedron there are 10.7° at least and 164.8°
//! at most, whatever the surface.
//!
//! *How we know*: `fill::angles_hold_wherever_the_lattice_lies`, `fill::volume_converges_with_order_two`,
//! `fill::real_organs_are_filled`, `fill::a_thin_rim_is_filled_where_it_is_asked_for`,
//! `fill::a_lost_rod_is_told_with_its_end`.
//!
//! *Limits*: sharp edges are cut off by up to a third of an edge; [`follow_sharp_edges`](crate::follow_sharp_edges) restores
//! them. Parts thinner than about two edges may be lost; then the coarseness is refused, or [`Fidelity`] reports the missing
//! part. [`fill_graded`] is finer where requested. Where a thin gap would leave tetrahedra that touch in an edge or a vertex
//! only, a few are removed and the boundary lies off the surface.

mod background;
mod fidelity;
mod graded;
mod lattice;
mod repair;
mod stencil;

use self::background::Background;
pub use self::fidelity::Fidelity;
use self::graded::GradedLattice;
use self::lattice::Lattice;
use self::stencil::Filling;
use crate::{AabbTree, Surface, TetrahedronError, TetrahedronMesh, Vec3};

/// Part of the volume that may be lost in fragments [-].
const MAX_LOST: f64 = 0.01;

/// How to fill a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FillSettings {
    /// Edge of the cells of the lattice [m]: the longest edge inside. The shorter ones are 0.87 of
    /// it, and a cell holds twelve tetrahedra.
    pub edge: f64,
    /// More tetrahedra than these are refused.
    pub most_tetrahedra: usize,
}

impl FillSettings {
    /// Cells of this `edge` [m], and as many tetrahedra as [`TetrahedronMesh`] allows.
    pub fn new(edge: f64) -> Self {
        Self {
            edge,
            most_tetrahedra: TetrahedronMesh::MAX_TETRAHEDRA,
        }
    }

    /// The edge that fills `surface` with about so many tetrahedra.
    pub fn with_tetrahedron_count(surface: &Surface, tetrahedra: usize) -> Self {
        Self::new((12.0 * surface.mesh().volume() / tetrahedra.max(1) as f64).cbrt())
    }
}

/// Fills `surface` with tetrahedra in one piece; fragments where it is thin are dropped while they
/// are less than a hundredth of the volume. The same input gives the same bytes.
///
/// # Errors
/// When the edge is not a positive length, so short that too many tetrahedra would come, or so long
/// that parts of the body are lost.
pub fn fill(
    surface: &Surface,
    settings: &FillSettings,
) -> Result<TetrahedronMesh, TetrahedronError> {
    settings.check(surface)?;
    let tree = AabbTree::new(surface.mesh());
    stuffed(
        &Lattice::new(surface, &tree, settings.edge),
        surface,
        settings,
    )
}

/// The same with cells that are bisected until no edge is longer than `longest_edge` [m] at its place [m]: thin parts
/// there are filled, while the rest stays as coarse as in `settings`. The bounds on angles do not hold: some
/// tetrahedra are flat until they are relaxed, as by [`refine_to`](crate::refine_to).
///
/// # Errors
/// As [`fill`].
pub fn fill_graded(
    surface: &Surface,
    settings: &FillSettings,
    longest_edge: impl Fn(&Vec3) -> f64,
) -> Result<TetrahedronMesh, TetrahedronError> {
    settings.check(surface)?;
    let tree = AabbTree::new(surface.mesh());
    let lattice = GradedLattice::new(surface, &tree, settings.edge, longest_edge)?;
    stuffed(&lattice, surface, settings)
}

impl FillSettings {
    fn check(&self, surface: &Surface) -> Result<(), TetrahedronError> {
        let edge_m = self.edge;
        if !edge_m.is_finite() || edge_m <= 0.0 {
            let (what, found) = ("the edge of the lattice", edge_m);
            return Err(TetrahedronError::NotALength { what, found });
        }
        // A twelfth of a cell each.
        let expected = 12.0 * surface.mesh().volume() / edge_m.powi(3);
        if expected > self.most() as f64 || Lattice::points(surface, edge_m) > lattice::MAX_POINTS {
            return Err(self.too_many(expected));
        }
        let (low, high) = surface.mesh().bounds();
        if edge_m > (high - low).max() {
            let lost_percent = 100.0;
            return Err(TetrahedronError::TooCoarse {
                edge_m,
                lost_percent,
            });
        }
        Ok(())
    }

    fn most(&self) -> usize {
        self.most_tetrahedra.min(TetrahedronMesh::MAX_TETRAHEDRA)
    }

    fn too_many(&self, expected: f64) -> TetrahedronError {
        TetrahedronError::TooMany {
            expected,
            edge_m: self.edge,
            most: self.most(),
        }
    }
}

/// The inside part of `background`, in one piece.
fn stuffed(
    background: &dyn Background,
    surface: &Surface,
    settings: &FillSettings,
) -> Result<TetrahedronMesh, TetrahedronError> {
    let volume = surface.mesh().volume();
    let Filling {
        vertices,
        tetrahedra,
    } = stencil::fill(background);
    if tetrahedra.len() > settings.most() {
        return Err(settings.too_many(tetrahedra.len() as f64));
    }
    let (tetrahedra, lost) = repair::largest_component(&vertices, tetrahedra);
    if tetrahedra.is_empty() || lost > MAX_LOST * volume {
        let filled: f64 = repair::volume(&vertices, &tetrahedra);
        return Err(TetrahedronError::TooCoarse {
            edge_m: settings.edge,
            lost_percent: 100.0 * (1.0 - filled / volume),
        });
    }
    TetrahedronMesh::new(vertices, tetrahedra)
}
