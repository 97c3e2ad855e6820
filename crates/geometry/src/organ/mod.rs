//! The built-in organs: closed surfaces made from formulas, at any fineness.
//!
//! Solid organs are smooth maps of the unit sphere (`sphere_map`), so that every even number of
//! triangles can be had exactly; the tube and the sheet with a hole (`revolved`), the hemisphere, the
//! cube and the slab are grids.

mod anchor;
mod cube;
mod description;
mod diaphragm;
mod error;
mod esophagus;
mod grid;
mod hemisphere;
mod kidney;
mod liver;
mod revolved;
mod slab;
mod sphere_map;
mod spleen;
mod stomach;
mod warp;

pub use anchor::AnchorPlane;
pub use description::OrganDescription;
pub use error::OrganError;

use crate::TriangleMesh;

/// A built-in organ or test body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Organ {
    /// The lower esophagus: a tube with a lumen, open at both ends.
    Esophagus,
    /// The liver.
    Liver,
    /// The left kidney.
    Kidney,
    /// The stomach, moderately filled.
    Stomach,
    /// The spleen.
    Spleen,
    /// The diaphragm around the esophagus, with its hiatus.
    Diaphragm,
    /// Half a ball, for comparison with closed forms.
    Hemisphere,
    /// A cube, for comparison with closed forms.
    Cube,
    /// A flat slab, for training models.
    Slab,
}

impl Organ {
    /// Every built-in, in the order in which they are listed to users.
    pub const ALL: [Self; 9] = [
        Self::Esophagus,
        Self::Liver,
        Self::Kidney,
        Self::Stomach,
        Self::Spleen,
        Self::Diaphragm,
        Self::Hemisphere,
        Self::Cube,
        Self::Slab,
    ];

    /// The word that a scene uses for it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Esophagus => "esophagus",
            Self::Liver => "liver",
            Self::Kidney => "kidney",
            Self::Stomach => "stomach",
            Self::Spleen => "spleen",
            Self::Diaphragm => "diaphragm",
            Self::Hemisphere => "hemisphere",
            Self::Cube => "cube",
            Self::Slab => "slab",
        }
    }

    /// Its axes, origin, lengths and fixed part.
    pub fn description(self) -> OrganDescription {
        match self {
            Self::Esophagus => esophagus::description(),
            Self::Liver => liver::description(),
            Self::Kidney => kidney::description(),
            Self::Stomach => stomach::description(),
            Self::Spleen => spleen::description(),
            Self::Diaphragm => diaphragm::description(),
            Self::Hemisphere => hemisphere::description(),
            Self::Cube => cube::description(),
            Self::Slab => slab::description(),
        }
    }

    /// Default number of triangles: enough to look smooth, few enough to be quick.
    pub fn default_triangles(self) -> usize {
        match self {
            Self::Esophagus => 3_726,
            Self::Liver => 6_000,
            Self::Kidney | Self::Spleen | Self::Stomach => 4_000,
            Self::Diaphragm => 6_000,
            Self::Hemisphere => 3_072,
            Self::Cube => 3_072,
            Self::Slab => 4_000,
        }
    }

    /// The smallest number of triangles that still has the shape of the organ.
    pub fn least_triangles(self) -> usize {
        match self {
            Self::Esophagus => esophagus::MIN_TRIANGLES,
            Self::Diaphragm => diaphragm::MIN_TRIANGLES,
            Self::Liver | Self::Kidney | Self::Stomach | Self::Spleen => 200,
            Self::Hemisphere => 48,
            Self::Cube => 12,
            Self::Slab => slab::MIN_TRIANGLES,
        }
    }

    /// Its closed surface, oriented outward. Liver, kidney, stomach and spleen get exactly
    /// `triangles` triangles when that is even, else one more; the others the nearest number that
    /// their grid allows.
    ///
    /// # Errors
    /// When there are too few triangles for the shape, or more than [`Organ::MAX_TRIANGLES`].
    pub fn surface_mesh(self, triangles: usize) -> Result<TriangleMesh, OrganError> {
        if triangles < self.least_triangles() || triangles > Self::MAX_TRIANGLES {
            return Err(OrganError::TriangleCount {
                organ: self,
                triangles,
                least: self.least_triangles(),
                most: Self::MAX_TRIANGLES,
            });
        }
        let mesh = match self {
            Self::Esophagus => esophagus::surface_mesh(triangles),
            Self::Liver => sphere_map::surface_mesh(liver::shape, triangles),
            Self::Kidney => sphere_map::surface_mesh(kidney::shape, triangles),
            Self::Stomach => sphere_map::surface_mesh(stomach::shape, triangles),
            Self::Spleen => sphere_map::surface_mesh(spleen::shape, triangles),
            Self::Diaphragm => diaphragm::surface_mesh(triangles),
            Self::Hemisphere => hemisphere::surface_mesh(triangles),
            Self::Cube => cube::surface_mesh(triangles),
            Self::Slab => slab::surface_mesh(triangles),
        };
        Ok(mesh?)
    }

    /// The largest number of triangles that is made; beyond it no model here could use the mesh.
    pub const MAX_TRIANGLES: usize = 2_000_000;

    /// Its default anchor: a triangle is fixed when its centroid lies behind any of these planes.
    pub fn anchor(self) -> Vec<AnchorPlane> {
        match self {
            Self::Esophagus => esophagus::anchor(),
            Self::Liver => liver::anchor(),
            Self::Kidney => kidney::anchor(),
            Self::Stomach => stomach::anchor(),
            Self::Spleen => spleen::anchor(),
            Self::Diaphragm => diaphragm::anchor(),
            Self::Hemisphere => hemisphere::anchor(),
            Self::Cube => cube::anchor(),
            Self::Slab => slab::anchor(),
        }
    }
}

impl std::fmt::Display for Organ {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.pad(self.name())
    }
}

impl std::str::FromStr for Organ {
    type Err = OrganError;

    fn from_str(word: &str) -> Result<Self, OrganError> {
        Self::ALL
            .into_iter()
            .find(|organ| organ.name() == word)
            .ok_or_else(|| OrganError::UnknownName {
                found: word.to_owned(),
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vec3;

    #[test]
    fn every_name_parses_back() {
        for organ in Organ::ALL {
            assert_eq!(organ.to_string().parse(), Ok(organ));
        }
    }

    #[test]
    fn an_unknown_name_is_refused_with_the_known_ones() {
        let message = "lung".parse::<Organ>().unwrap_err().to_string();
        assert!(message.contains("lung"), "{message}");
        for organ in Organ::ALL {
            assert!(message.contains(organ.name()), "{message}");
        }
    }

    #[test]
    fn too_few_triangles_are_refused_with_the_least_number() {
        let message = Organ::Liver.surface_mesh(10).unwrap_err().to_string();
        assert!(
            message.contains("liver") && message.contains("200"),
            "{message}"
        );
    }

    #[test]
    fn only_the_bottom_of_cube_and_slab_is_held() {
        for organ in [Organ::Cube, Organ::Slab] {
            let mesh = organ.surface_mesh(10_000).unwrap();
            let plane = organ.anchor()[0];
            let held: f64 = mesh
                .triangle_ids()
                .filter(|&t| plane.contains(&(mesh.positions(t).iter().sum::<Vec3>() / 3.0)))
                .map(|t| mesh.area_vector(t).norm())
                .sum();
            assert!((held - 0.01).abs() < 1e-12, "{organ}");
        }
    }
}
