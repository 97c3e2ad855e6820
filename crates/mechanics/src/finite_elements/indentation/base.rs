use std::sync::Arc;

use nalgebra::Matrix3;

use crate::material::law::Law;
use crate::{Error, LinearElastic, NeoHookean, Strain};

/// An elastic body that a block is glued to and that is glued to a rigid plate itself: as wide as the block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticBase {
    /// Thickness [m].
    pub thickness: f64,
    /// Its shear modulus at rest over that of the block [-]. It is neo-Hookean, or linear where the law of the block is.
    pub stiffness: f64,
}

impl ElasticBase {
    /// The law of a base under tissue of `law`.
    pub(super) fn law(&self, law: &dyn Law) -> Result<Arc<dyn Law>, Error> {
        let shear = law.distortion_tangent(&Matrix3::identity())[(3, 3)];
        let (own, volume) = (self.stiffness * shear, law.volume());
        let bulk = self.stiffness * volume.bulk_modulus;
        Ok(match volume.strain {
            Strain::Small => {
                // Poisson's ratio is that of the tissue.
                let softness = shear / volume.bulk_modulus;
                let ratio = (3.0 - 2.0 * softness) / (2.0 * (3.0 + softness));
                Arc::new(LinearElastic::new(2.0 * own * (1.0 + ratio), ratio)?)
            }
            Strain::Finite if bulk.is_finite() => {
                Arc::new(NeoHookean::compressible(0.5 * own, bulk)?)
            }
            Strain::Finite => Arc::new(NeoHookean::incompressible(0.5 * own)?),
        })
    }
}
