//! A closed envelope of any triangles: open, crossing, doubled or unoriented.
//!
//! The rims of holes are capped by fans. On a grid somewhat finer than the asked distance, the outside is the part that a ball of
//! radius r reaches from the border without touching a triangle; the inside is the part that no such ball covers (a morphological
//! closing [Serra 1982]). Its surface is closed, manifold and in one piece ([`isosurface`](crate::isosurface)), and its vertices
//! are moved to the nearest point of the triangles where one is near and no triangle is turned by it. Where that encloses
//! nothing, wider openings get a cap where they are narrowest (`openings`). Closed surfaces inside are returned as well
//! (`inner`).
//!
//! *How we know*: `wrap::…`: balls of crossing, doubled, turned and missing triangles keep their volume and distance.
//!
//! *Limits*: a closing fills what is narrower than twice r, also a fissure of the organ; where it is not needed, r is a voxel. Sharp edges
//! are rounded by about the asked distance.

mod closing;
mod grid;
mod holes;
mod inner;
mod openings;

use std::ops::ControlFlow;

use crate::check::self_intersection::self_intersecting;
use crate::deviation::deviation_with_tree;
use crate::{
    AabbTree, Deviation, IsosurfaceError, IsosurfaceSettings, MeshError, NodeId, SimplifyError,
    Surface, TriangleMesh, Vec3, deviation, isosurface_with_progress, repair,
};
use closing::Closing;
use grid::Grid;
use openings::Openings;

/// Voxels that a grid may have; they take up to 17 bytes each.
const MAX_VOXELS: f64 = 3e8;

/// The edge of a voxel over the asked distance [-]. A voxel's surface is off by half of it and by half its diagonal at
/// most, and its vertices are then moved to the triangles.
const SPACING: f64 = 0.75;

/// From the envelope to a surface inside, over the asked distance, at least [-].
const CLEAR: f64 = 0.5;

/// Which gaps between triangles are closed. Holes with a rim are closed at any width, and where nothing is enclosed then,
/// openings without one behind which there is more room.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Gaps {
    /// All up to this width [m].
    Close(f64),
    /// The same, but none where the body is whole without, so that fissures of the organ stay.
    CloseIfNeeded(f64),
}

impl Gaps {
    /// The width [m].
    pub fn width(self) -> f64 {
        match self {
            Self::Close(width) | Self::CloseIfNeeded(width) => width,
        }
    }
}

/// How [`wrap`] works.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrapSettings {
    /// Largest distance of the envelope from the triangles [m].
    pub distance: f64,
    /// Which gaps are closed.
    pub gaps: Gaps,
    /// Triangles at most, of each surface.
    pub triangles: usize,
    /// Whether closed surfaces inside are given too.
    pub keep_inner: bool,
}

impl Default for WrapSettings {
    fn default() -> Self {
        Self {
            distance: 0.5e-3,
            gaps: Gaps::CloseIfNeeded(2e-3),
            triangles: 100_000,
            keep_inner: false,
        }
    }
}

/// An envelope.
#[derive(Debug, Clone, PartialEq)]
pub struct Wrapped {
    /// Closed, manifold, oriented outward and in one piece [m].
    pub surface: Surface,
    /// Distance of the envelope from the triangles.
    pub to_input: Deviation,
    /// Distance of the triangles from the envelope; large where they lie inside.
    pub of_input: Deviation,
    /// Holes with a rim that were capped.
    pub holes: usize,
    /// Extent of the largest rim [m]; 0 without one.
    pub widest_rim: f64,
    /// Width up to which gaps were closed [m].
    pub gaps: f64,
    /// Width of the widest opening without a rim that was closed, where closing the gaps enclosed nothing [m].
    pub opening: Option<f64>,
    /// Pieces other than the largest, which were dropped.
    pub other_pieces: usize,
    /// Volume of cavities that were filled [m³].
    pub filled: f64,
    /// Closed surfaces inside, the largest first, if requested: of cavities, vessels and parts, and inner walls. One may
    /// lie within another.
    pub inner: Vec<Surface>,
}

/// Why there is no envelope.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WrapError {
    /// A distance that is none.
    #[error("a distance of {distance} m is none; give one above 0, such as 0.0005")]
    Distance {
        /// What was asked [m].
        distance: f64,
    },
    /// A width of gaps that is none.
    #[error("gaps of {width} m are none; give a width of 0 or more, such as 0.002")]
    Gaps {
        /// What was asked [m].
        width: f64,
    },
    /// A grid too large for memory.
    #[error(
        "a distance of {distance} m takes {voxels:.1e} voxels, and {MAX_VOXELS:.0e} are the most; ask for {least:.1e} m or more"
    )]
    TooFine {
        /// What was asked [m].
        distance: f64,
        /// Voxels needed.
        voxels: f64,
        /// The least distance that fits [m].
        least: f64,
    },
    /// The triangles enclose nothing.
    #[error(
        "the triangles enclose nothing, not even behind an opening that is narrower than the room behind it; close the body in a \
         mesh editor first"
    )]
    Open,
    /// See there.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// See there.
    #[error(transparent)]
    Surface(#[from] IsosurfaceError),
}

impl WrapError {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::Mesh(error) => error.is_input(),
            Self::Surface(error) => error.is_input(),
            Self::Distance { .. } | Self::Gaps { .. } | Self::TooFine { .. } | Self::Open => true,
        }
    }
}

/// The envelope of `mesh` [m].
///
/// # Errors
/// When the triangles enclose nothing, or the distance is too small for memory.
pub fn wrap(mesh: &TriangleMesh, settings: &WrapSettings) -> Result<Wrapped, WrapError> {
    wrap_with_progress(mesh, settings, &mut |_| ControlFlow::Continue(()))
}

/// The same. `progress` receives the fraction of the work done, from 0 to 1 [-], and may cancel it.
///
/// # Errors
/// As [`wrap`], and when the work is cancelled.
pub fn wrap_with_progress(
    mesh: &TriangleMesh,
    settings: &WrapSettings,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Wrapped, WrapError> {
    let distance = settings.distance;
    if !(distance > 0.0 && distance.is_finite()) {
        return Err(WrapError::Distance { distance });
    }
    let width = settings.gaps.width();
    if !(width >= 0.0 && width.is_finite()) {
        return Err(WrapError::Gaps { width });
    }
    let mut at = |part| match progress(part) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(WrapError::Surface(SimplifyError::Cancelled.into())),
    };
    at(0.0)?;
    let (input, _) = repair(mesh)?;
    let capped = holes::cap(&input)?;
    let spacing = SPACING * distance;
    let mut radius = (0.5 * width).max(spacing);
    let grid = Grid::around(&capped.mesh, spacing, radius);
    if grid.voxels() > MAX_VOXELS {
        return Err(WrapError::TooFine {
            distance,
            voxels: grid.voxels(),
            least: distance * (grid.voxels() / MAX_VOXELS).cbrt(),
        });
    }
    let mut closing = Closing::new(&grid, &capped.mesh);
    at(0.1)?;
    let (mut opening, mut map) = (None, None);
    if !closing.encloses(radius) {
        let found = Openings::find(&capped.mesh, spacing).ok_or(WrapError::Open)?;
        at(0.15)?;
        found.close(&mut closing, radius);
        opening = Some(found.width);
    } else if let Gaps::CloseIfNeeded(_) = settings.gaps {
        map = closing.same_body(spacing, radius);
        if map.is_some() {
            radius = spacing;
        }
    }
    at(0.2)?;
    let tree = AabbTree::new(&capped.mesh);
    let inner = match settings.keep_inner {
        true => {
            closing.inner_surfaces(radius, &capped.mesh, &tree, distance, settings.triangles)?
        }
        false => Vec::new(),
    };
    at(0.25)?;
    let map = map.unwrap_or_else(|| closing.inside(radius));
    drop(closing);
    at(0.3)?;
    let found = isosurface_with_progress(
        &map,
        1,
        &IsosurfaceSettings {
            triangles: settings.triangles,
            ..IsosurfaceSettings::default()
        },
        &mut |part| progress(0.3 + 0.6 * part),
    )?;
    let filled = found.filled_voxels as f64 * map.voxel_volume();
    let fitted = fit(
        found.simplified.mesh,
        &capped.mesh,
        &tree,
        distance,
        distance,
    );
    let to_input = deviation_with_tree(&fitted, &capped.mesh, &tree);
    let of_input = deviation(&input, &fitted);
    let surface = Surface::new(fitted)?;
    let envelope = AabbTree::new(surface.mesh());
    let is_inside = |inner: &Surface| {
        let mut vertices = inner.mesh().vertices().iter();
        vertices.all(|place| surface.signed_distance(&envelope, place).1 < -CLEAR * distance)
    };
    Ok(Wrapped {
        to_input,
        of_input,
        holes: capped.holes,
        widest_rim: capped.widest_rim,
        gaps: 2.0 * radius,
        opening,
        other_pieces: found.other_pieces,
        filled,
        inner: inner.into_iter().filter(is_inside).collect(),
        surface,
    })
}

/// Cosine of the angle by which a triangle may turn when its corners move to the input.
const MIN_TURN: f64 = 0.5;

/// `envelope` with its vertices on the nearest triangles of `input`, where one is within `distance` [m] and no triangle
/// turns over or crosses another by it. They are searched from a place that lies outside of the vertex by `from` [m].
fn fit(
    envelope: TriangleMesh,
    input: &TriangleMesh,
    tree: &AabbTree,
    distance: f64,
    from: f64,
) -> TriangleMesh {
    let before = envelope.clone();
    let mut fitted = envelope;
    let mut is_free = vec![true; before.vertices().len()];
    let mut normals = vec![Vec3::zeros(); before.vertices().len()];
    for triangle in before.triangle_ids() {
        for node in before.corners(triangle) {
            normals[node.index()] += before.area_vector(triangle);
        }
    }
    for (number, (place, normal)) in before.vertices().iter().zip(&normals).enumerate() {
        // Seen from the side of the surface, since another wall may be nearer.
        let from = place + from * normal.try_normalize(0.0).unwrap_or_default();
        let nearest = tree.nearest(input, &from);
        if (nearest.on.position - place).norm() <= distance {
            fitted.move_vertex(NodeId(number as u32), nearest.on.position);
        }
    }
    // Each round returns the corners of bad triangles; when all have returned, nothing is left to be bad.
    loop {
        let mut bad: Vec<_> = before
            .triangle_ids()
            .filter(|&triangle| {
                let (then, now) = (before.area_vector(triangle), fitted.area_vector(triangle));
                let turn = then.normalize().dot(&now.normalize());
                !(turn >= MIN_TURN && now.norm() > 0.1 * then.norm())
            })
            .collect();
        bad.extend(self_intersecting(&fitted));
        let mut has_returned = false;
        for triangle in bad {
            for node in before.corners(triangle) {
                if std::mem::take(&mut is_free[node.index()]) {
                    fitted.move_vertex(node, before.vertices()[node.index()]);
                    has_returned = true;
                }
            }
        }
        if !has_returned {
            return fitted;
        }
    }
}
