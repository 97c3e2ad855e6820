use palpate_files::scene::Enhancement;
use palpate_geometry::Surface;

use super::corner_normals::CornerNormals;
use super::interpolation::Interpolation;
use crate::Error;

/// More subdivisions would make more than 4096 triangles of one.
pub const MOST_LEVELS: usize = 6;

/// A coarse surface and how it is enhanced.
#[derive(Debug, Clone)]
pub struct EnhancementModel {
    interpolation: Interpolation,
    pub(super) normals: CornerNormals,
    settings: Enhancement,
}

impl EnhancementModel {
    /// For the coarse `surface`.
    ///
    /// # Errors
    /// When there are more than [`MOST_LEVELS`].
    pub fn new(surface: Surface, settings: Enhancement) -> Result<Self, Error> {
        if settings.levels > MOST_LEVELS {
            return Err(Error::TooManyLevels {
                levels: settings.levels,
            });
        }
        Ok(Self {
            normals: CornerNormals::new(&surface),
            interpolation: Interpolation::new(surface, settings.smoothing),
            settings,
        })
    }

    /// How displacements are spread over the surface.
    pub fn interpolation(&self) -> &Interpolation {
        &self.interpolation
    }

    /// What was chosen.
    pub fn settings(&self) -> &Enhancement {
        &self.settings
    }
}
