use palpate_files::scene::Enhancement;
use palpate_geometry::{AabbTree, Surface};

use super::carrier::EmbeddedDisplayPoints;
use super::corner_normals::CornerNormals;
use super::interpolation::{Interpolation, SurfacePoint};
use crate::{Error, Vec3};

/// More subdivisions would make more than 4096 triangles of one.
pub const MAX_LEVELS: usize = 6;

/// A coarse surface, the displayed one, and the settings of the enhancement.
#[derive(Debug, Clone)]
pub struct EnhancementModel {
    interpolation: Interpolation,
    /// A finer surface of the same organ, with the boxes around the coarse one.
    finer: Option<(Surface, AabbTree)>,
    /// Of the displayed surface.
    pub(super) normals: CornerNormals,
    settings: Enhancement,
}

impl EnhancementModel {
    /// For the coarse `surface`, which is displayed.
    ///
    /// # Errors
    /// When there are more than [`MAX_LEVELS`].
    pub fn new(surface: Surface, settings: Enhancement) -> Result<Self, Error> {
        let normals = CornerNormals::new(&surface);
        let interpolation = Interpolation::new(surface, settings.smoothing);
        Self::with_parts(interpolation, None, normals, settings)
    }

    /// For a coarse surface that carries `finer`, which is displayed.
    ///
    /// # Errors
    /// When there are more than [`MAX_LEVELS`].
    pub fn with_display_mesh(
        finer: Surface,
        surface: Surface,
        settings: Enhancement,
    ) -> Result<Self, Error> {
        let normals = CornerNormals::new(&finer);
        let tree = AabbTree::new(surface.mesh());
        let interpolation = Interpolation::new(surface, settings.smoothing);
        Self::with_parts(interpolation, Some((finer, tree)), normals, settings)
    }

    /// The same surfaces, enhanced otherwise.
    ///
    /// # Errors
    /// When there are more than [`MAX_LEVELS`].
    pub fn with_settings(&self, settings: Enhancement) -> Result<Self, Error> {
        let interpolation = self.interpolation.with_smoothing(settings.smoothing);
        let (finer, normals) = (self.finer.clone(), self.normals.clone());
        Self::with_parts(interpolation, finer, normals, settings)
    }

    fn with_parts(
        interpolation: Interpolation,
        finer: Option<(Surface, AabbTree)>,
        normals: CornerNormals,
        settings: Enhancement,
    ) -> Result<Self, Error> {
        if settings.levels > MAX_LEVELS {
            return Err(Error::TooManyLevels {
                levels: settings.levels,
            });
        }
        Ok(Self {
            interpolation,
            finer,
            normals,
            settings,
        })
    }

    /// How displacements are spread over the coarse surface.
    pub fn interpolation(&self) -> &Interpolation {
        &self.interpolation
    }

    /// The displayed surface.
    pub fn surface(&self) -> &Surface {
        match &self.finer {
            Some((finer, _)) => finer,
            None => self.interpolation.surface(),
        }
    }

    /// Whether the displayed surface is finer than the coarse one.
    pub fn has_finer_display(&self) -> bool {
        self.finer.is_some()
    }

    /// The settings.
    pub fn settings(&self) -> &Enhancement {
        &self.settings
    }

    /// All displayed vertices.
    pub fn carrier(&self) -> EmbeddedDisplayPoints {
        match &self.finer {
            Some((finer, _)) => EmbeddedDisplayPoints::of_surface(&self.interpolation, finer),
            None => EmbeddedDisplayPoints::of_vertices(&self.interpolation),
        }
    }

    /// The point of the coarse surface that moves a point over `at` of the displayed one, at rest at
    /// `place` [m].
    pub(super) fn site(&self, at: &SurfacePoint, place: &Vec3) -> SurfacePoint {
        let Some((finer, tree)) = &self.finer else {
            return *at;
        };
        let corners = finer.mesh().corners(at.triangle);
        let normals = corners.iter().zip(at.barycentric);
        let facing = normals
            .map(|(node, share)| finer.vertex_normals()[node.index()] * share)
            .sum();
        self.interpolation.nearest_facing(tree, place, &facing)
    }
}
