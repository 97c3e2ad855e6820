//! The same surface with fewer triangles.
//!
//! Edges are collapsed in the order of a cost: the squared distance from the planes that a vertex represents, as a quadratic form
//! [Garland and Heckbert 1997], and a small term that keeps triangles even. Planes that stand on borders and sharp edges keep these. A
//! collapse must keep the kind of the surface [Dey et al. 1999], turn no triangle over, make no needle and pass through nothing; only
//! the last three yield when the number of triangles cannot be met otherwise. Then edges are flipped and vertices slide along the
//! surface, which makes triangles even, and each vertex stands so that its triangles are on the mean neither outside of the original
//! nor inside: the volume stays. Large meshes are first simplified in blocks, on all cores (`blocks`); the result does not depend on
//! their number.
//!
//! *How we know*: `simplify::organs_stay_closed_and_keep_their_volume`,
//! `simplify::deviation_is_that_of_parry`, `simplify::a_cube_keeps_its_edges`,
//! `simplify::real_organs_are_simplified_as_published`, `simplify::sizes_are_met_beside_one_another`,
//! `simplify::large_meshes_are_simplified_as_well_as_smaller_ones`.
//!
//! *Limits*: a closed mesh has an even number of triangles, so that an odd number is missed by one.
//! Where the original passes through itself the result may too. Handles and hollows stay, however
//! small.

mod blocks;
mod collapse;
mod guard;
mod net;
mod quadric;
mod reference;
mod relax;

pub(crate) use quadric::Quadric;

use std::ops::ControlFlow;

use self::net::Net;
use self::reference::Reference;
use crate::check::self_intersection::count_self_intersections;
use crate::deviation::{Deviation, deviation_with_tree};
use crate::{AabbTree, TriangleMesh};

/// The fewest triangles of a closed surface.
const FEWEST: usize = 4;

/// Settings of [`simplify`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimplifySettings {
    /// The number of triangles to reach; a closed mesh has an even number.
    pub triangles: usize,
    /// Weight of even triangles relative to a small distance from the original [-]; 0 leaves large
    /// triangles on flat sides.
    pub evenness: f64,
}

impl SimplifySettings {
    /// Settings for so many triangles, as even as organs want them for mechanics.
    pub fn to(triangles: usize) -> Self {
        Self {
            triangles,
            evenness: 1e-3,
        }
    }
}

/// A mesh with fewer triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Simplified {
    /// The triangles [m].
    pub mesh: TriangleMesh,
    /// Distance of the original from the result.
    pub of_original: Deviation,
    /// Distance of the result from the original.
    pub of_result: Deviation,
    /// Triangles of the result that meet another one.
    pub self_intersections: usize,
}

impl Simplified {
    /// A sentence where triangles of the result meet.
    pub fn warning(&self) -> Option<String> {
        let meet = self.self_intersections;
        let warning =
            || format!("{meet} triangles of the result meet others; ask for more triangles");
        (meet > 0).then(warning)
    }
}

/// Why a mesh is not simplified.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SimplifyError {
    /// Fewer triangles than bound a solid.
    #[error("{asked} triangles bound no solid; ask for {FEWEST} or more")]
    TooFew {
        /// The requested number.
        asked: usize,
    },
    /// Another number of sizes than of vertices.
    #[error("{found} sizes for {vertices} vertices; give one for each")]
    NotASizeEach {
        /// How many there are.
        found: usize,
        /// Vertices of the mesh.
        vertices: usize,
    },
    /// A size that is none.
    #[error("a size is {found}; give a positive number")]
    NotASize {
        /// What was given.
        found: f64,
    },
    /// The caller cancelled it.
    #[error("the simplification was cancelled; start it again")]
    Cancelled,
}

impl SimplifyError {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::Cancelled => false,
            Self::TooFew { .. } | Self::NotASizeEach { .. } | Self::NotASize { .. } => true,
        }
    }
}

/// The surface of `mesh` with fewer triangles, at most the requested number. A mesh that has so few
/// already stays as it is.
///
/// # Errors
/// When fewer than four triangles are asked for.
pub fn simplify(
    mesh: &TriangleMesh,
    settings: &SimplifySettings,
) -> Result<Simplified, SimplifyError> {
    simplify_with_progress(mesh, settings, &mut |_| ControlFlow::Continue(()))
}

/// The same. `progress` receives the fraction of the work done, from 0 to 1 [-], and may cancel it.
///
/// # Errors
/// When fewer than four triangles are asked for, or the work is cancelled.
pub fn simplify_with_progress(
    mesh: &TriangleMesh,
    settings: &SimplifySettings,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Simplified, SimplifyError> {
    check(settings)?;
    match reduced(mesh, settings, None, progress) {
        ControlFlow::Continue(simplified) => Ok(simplified),
        ControlFlow::Break(()) => Err(SimplifyError::Cancelled),
    }
}

/// The same with triangles that are smaller in some places than in others: by `sizes` at the vertices of `mesh`,
/// which are lengths of edges relative to one another [-].
///
/// # Errors
/// When fewer than four triangles are asked for, there are not as many sizes as vertices, or one of them is not
/// positive.
pub fn simplify_graded(
    mesh: &TriangleMesh,
    settings: &SimplifySettings,
    sizes: &[f64],
) -> Result<Simplified, SimplifyError> {
    check(settings)?;
    let vertices = mesh.vertices().len();
    if sizes.len() != vertices {
        let found = sizes.len();
        return Err(SimplifyError::NotASizeEach { found, vertices });
    }
    if let Some(&found) = sizes
        .iter()
        .find(|size| !(**size > 0.0 && size.is_finite()))
    {
        return Err(SimplifyError::NotASize { found });
    }
    match reduced(mesh, settings, Some(sizes), &mut |_| {
        ControlFlow::Continue(())
    }) {
        ControlFlow::Continue(simplified) => Ok(simplified),
        ControlFlow::Break(()) => Err(SimplifyError::Cancelled),
    }
}

fn check(settings: &SimplifySettings) -> Result<(), SimplifyError> {
    match settings.triangles {
        asked if asked < FEWEST => Err(SimplifyError::TooFew { asked }),
        _ => Ok(()),
    }
}

/// Parts of the work after which blocks are simplified, after which edges are collapsed, and after which vertices are
/// moved [-].
const IN_BLOCKS: f64 = 0.4;
const COLLAPSED: f64 = 0.75;
const RELAXED: f64 = 0.9;

fn reduced(
    mesh: &TriangleMesh,
    settings: &SimplifySettings,
    sizes: Option<&[f64]>,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> ControlFlow<(), Simplified> {
    let tree = AabbTree::new(mesh);
    let coarser = match sizes {
        None => blocks::simplify_in_blocks(mesh, settings, &mut |part| progress(IN_BLOCKS * part))?,
        Some(_) => None,
    };
    let done = if coarser.is_some() { IN_BLOCKS } else { 0.0 };
    let mut net = Net::new(coarser.as_ref().unwrap_or(mesh));
    if net.live() > settings.triangles {
        let on_crease = collapse::collapse(&mut net, settings, sizes, &mut |part| {
            progress(done + (COLLAPSED - done) * part)
        })?;
        let reference = Reference { mesh, tree: &tree };
        relax::relax(&mut net, &reference, &on_crease, &mut |part| {
            progress(COLLAPSED + (RELAXED - COLLAPSED) * part)
        })?;
    }
    progress(RELAXED)?;
    let simplified = net.mesh();
    let of_original = deviation_with_tree(mesh, &simplified, &AabbTree::new(&simplified));
    progress(0.5 * (1.0 + RELAXED))?;
    ControlFlow::Continue(Simplified {
        of_original,
        of_result: deviation_with_tree(&simplified, mesh, &tree),
        self_intersections: count_self_intersections(&simplified),
        mesh: simplified,
    })
}
