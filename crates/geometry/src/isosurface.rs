//! The surface of one label of a segmented picture.
//!
//! Marching cubes that never branch bound the largest piece of the label's voxels, with enclosed
//! voids filled; the border of the picture counts as outside, so that a cut organ is closed by a
//! flat side. The steps of the voxels are smoothed [Taubin 1995] by at most half a voxel to each
//! side; the surface is then moved along its normals until it encloses the volume of the voxels,
//! and simplified to even triangles.
//!
//! *How we know*: `isosurface::every_pattern_of_eight_voxels_is_closed`,
//! `isosurface::random_voxels_bound_one_solid`, `isosurface::a_ball_keeps_its_volume_and_shape`,
//! `isosurface::real_organs_come_back_from_their_voxels`.
//!
//! *Limits*: handles of the voxels stay, also those that noise made. A sheet of one voxel keeps its
//! volume and not its thickness. Slices much thicker than their voxels are wide leave flats that are
//! too wide to be smoothed. A label of a few voxels may miss its volume.

mod bits;
mod block;
mod contour;
mod smooth;

use std::ops::ControlFlow;

use self::block::Block;
use crate::{
    LabelMap, NodeId, Simplified, SimplifyError, SimplifySettings, TriangleMesh, Vec3,
    simplify_with_progress,
};

/// Triangles that the surface of the voxels may have before it is simplified. The liver in a whole-body scan has a
/// million; four take 2.5 GB, and minutes.
pub const MAX_VOXEL_TRIANGLES: usize = 4_000_000;

/// How [`isosurface`] works.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IsosurfaceSettings {
    /// Rounds of smoothing; 0 leaves the steps of the voxels.
    pub smoothing: usize,
    /// Triangles at most; even triangles are half as many as there are first, or fewer.
    pub triangles: usize,
}

impl Default for IsosurfaceSettings {
    fn default() -> Self {
        Self {
            smoothing: 60,
            triangles: 20_000,
        }
    }
}

/// The surface of a label.
#[derive(Debug, Clone, PartialEq)]
pub struct Isosurface {
    /// The triangles [m], with their distance from the smoothed surface of the voxels.
    pub simplified: Simplified,
    /// Volume of the voxels that it bounds [m³].
    pub voxel_volume: f64,
    /// Smaller pieces that were left out.
    pub other_pieces: usize,
    /// Voxels of these.
    pub other_voxels: usize,
    /// Voxels of other labels, or none, that were shut in and are filled.
    pub filled_voxels: usize,
    /// Whether the border of the picture cuts the label.
    pub is_cut: bool,
}

/// Why there is no surface.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum IsosurfaceError {
    /// No voxel has the label.
    #[error("no voxel has the label {label}; there are {present}")]
    Absent {
        /// The label.
        label: u16,
        /// The labels present, as a list.
        present: String,
    },
    /// More triangles than are simplified: noise, a sponge, or very small voxels.
    #[error(
        "the surface of the label {label} has more than {MAX_VOXEL_TRIANGLES} triangles before it is simplified; take larger voxels, or remove noise from the segmentation"
    )]
    TooLarge {
        /// The label.
        label: u16,
    },
    /// See there.
    #[error(transparent)]
    Simplify(#[from] SimplifyError),
}

impl IsosurfaceError {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::Simplify(error) => error.is_input(),
            Self::Absent { .. } | Self::TooLarge { .. } => true,
        }
    }
}

/// Part of the work that is done when the surface of the voxels is found [-].
const FOUND: f64 = 0.1;

/// The surface of `label` in `map`: closed, manifold and in one piece.
///
/// # Errors
/// When no voxel has the label, its surface has more than [`MAX_VOXEL_TRIANGLES`], or fewer than four triangles are
/// requested.
pub fn isosurface(
    map: &LabelMap,
    label: u16,
    settings: &IsosurfaceSettings,
) -> Result<Isosurface, IsosurfaceError> {
    isosurface_with_progress(map, label, settings, &mut |_| ControlFlow::Continue(()))
}

/// The same. `progress` receives the fraction of the work done, from 0 to 1 [-], and may cancel it.
///
/// # Errors
/// As [`isosurface`], and when the work is cancelled.
pub fn isosurface_with_progress(
    map: &LabelMap,
    label: u16,
    settings: &IsosurfaceSettings,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Isosurface, IsosurfaceError> {
    let mut at = |part| match progress(part) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(SimplifyError::Cancelled),
    };
    let block = Block::of(map, label).filter(|_| label != 0);
    let mut block = block.ok_or_else(|| IsosurfaceError::Absent {
        label,
        present: present(map),
    })?;
    at(0.1 * FOUND)?;
    let all = block.count();
    let other_pieces = block.keep_largest();
    let kept = block.count();
    at(0.4 * FOUND)?;
    let filled_voxels = block.fill_voids();
    at(0.7 * FOUND)?;
    let voxel_volume = (kept + filled_voxels) as f64 * map.voxel_volume();
    let fine = smooth_surface(map, &block, settings.smoothing, voxel_volume);
    let fine = fine.ok_or(IsosurfaceError::TooLarge { label })?;
    at(FOUND)?;
    let triangles = settings.triangles.min(fine.triangles().len() / 2).max(4);
    let simplified = simplify_with_progress(
        &fine,
        &SimplifySettings::to(triangles.min(settings.triangles)),
        &mut |part| progress(FOUND + (1.0 - FOUND) * part),
    )?;
    Ok(Isosurface {
        simplified,
        voxel_volume,
        other_pieces,
        other_voxels: all - kept,
        filled_voxels,
        is_cut: block.is_cut,
    })
}

/// Voxels of the largest piece of `label`, and of the others.
pub(crate) fn voxels_in_pieces(map: &LabelMap, label: u16) -> [usize; 2] {
    Block::of(map, label).map_or([0; 2], |mut block| {
        let all = block.count();
        block.keep_largest();
        [block.count(), all - block.count()]
    })
}

/// The labels that there are, for a sentence.
fn present(map: &LabelMap) -> String {
    let labels = map.labels().into_iter().map(|label| match label.name {
        Some(name) => format!("{} ({name})", label.number),
        None => label.number.to_string(),
    });
    let labels: Vec<_> = labels.collect();
    match labels.len() {
        0 => "no labels at all".to_owned(),
        _ => labels.join(", "),
    }
}

/// The surface with all triangles of the voxels [m], of their volume; none when there are too many.
fn smooth_surface(
    map: &LabelMap,
    block: &Block,
    rounds: usize,
    volume: f64,
) -> Option<TriangleMesh> {
    let (mut vertices, mut triangles) = contour::contour(block, MAX_VOXEL_TRIANGLES)?;
    smooth::smooth(&mut vertices, &triangles, rounds);
    let first = Vec3::from(block.first.map(|index| index as f64));
    for vertex in &mut vertices {
        *vertex = map.position(&(*vertex + first));
    }
    if map.steps.determinant() < 0.0 {
        triangles.iter_mut().for_each(|corners| corners.swap(0, 1));
    }
    let mesh = TriangleMesh::new(vertices, triangles);
    let mesh = mesh.expect("voxels have finite places, and one voxel has triangles");
    let most = map.spacing().into_iter().fold(f64::INFINITY, f64::min);
    Some(with_volume(mesh, volume, 0.25 * most))
}

/// The mesh moved along its normals until it has this volume [m³], by at most `most` [m] at a time: a
/// few voxels alone can leave next to no area.
fn with_volume(mut mesh: TriangleMesh, volume: f64, most: f64) -> TriangleMesh {
    // The volume is nearly linear in the distance.
    for _ in 0..3 {
        let distance = ((volume - mesh.volume()) / mesh.area()).clamp(-most, most);
        let mut normals = vec![Vec3::zeros(); mesh.vertices().len()];
        for triangle in mesh.triangle_ids() {
            for node in mesh.corners(triangle) {
                normals[node.index()] += mesh.area_vector(triangle);
            }
        }
        for (node, normal) in (0..).map(NodeId).zip(&normals) {
            let along = normal.try_normalize(0.0).unwrap_or_default();
            let moved = mesh.vertices()[node.index()] + distance * along;
            mesh.move_vertex(node, moved);
        }
    }
    mesh
}
