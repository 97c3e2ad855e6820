use palpate_geometry::{Surface, TriangleId};
use palpate_mechanics::finite_elements::condensed::RegionLaws;
use sha2::{Digest, Sha256};

use super::method::Method;

/// Changes with the equations, so that stored responses are solved anew.
const BOUNDARY_ELEMENTS: &str = "boundary elements 2";
const FINITE_ELEMENTS: &str = "condensed finite elements 3";

/// The inputs of a response.
pub(super) struct Ingredients<'a> {
    pub(super) surface: &'a Surface,
    /// [-]
    pub(super) poissons_ratio: f64,
    pub(super) fixed: &'a [TriangleId],
    pub(super) touchable: &'a [TriangleId],
    pub(super) method: Method,
    pub(super) regions: Option<RegionLaws<'a>>,
}

impl Ingredients<'_> {
    /// A key of 64 hexadecimal digits, unique to these inputs.
    pub(super) fn key(&self) -> String {
        let mut hash = Sha256::new();
        match self.method {
            Method::BoundaryElements => hash.update(BOUNDARY_ELEMENTS),
            Method::FiniteElements { edge } => {
                hash.update(FINITE_ELEMENTS);
                hash.update(edge.to_le_bytes());
            }
        }
        hash.update(self.poissons_ratio.to_le_bytes());
        let mesh = self.surface.mesh();
        hash.update((mesh.vertices().len() as u64).to_le_bytes());
        for coordinate in mesh.vertices().iter().flatten() {
            hash.update(coordinate.to_le_bytes());
        }
        for node in mesh.triangles().iter().flatten() {
            hash.update(node.0.to_le_bytes());
        }
        for list in [self.fixed, self.touchable] {
            hash.update((list.len() as u64).to_le_bytes());
            for triangle in list {
                hash.update(triangle.0.to_le_bytes());
            }
        }
        if let Some(RegionLaws { map, laws }) = self.regions {
            map.bytes(&mut |bytes| hash.update(bytes));
            for law in laws {
                hash.update(law.youngs_modulus().to_le_bytes());
                hash.update(law.poissons_ratio().to_le_bytes());
            }
        }
        let digits = hash.finalize();
        digits.iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

#[cfg(test)]
mod tests {
    use palpate_files::scene::InclusionShape;
    use palpate_geometry::{AabbTree, Organ};
    use palpate_mechanics::LinearElastic;
    use palpate_mechanics::regions::{RegionMap, RegionPlace};

    use super::*;

    #[test]
    fn every_ingredient_counts() {
        let surface =
            |triangles| Surface::new(Organ::Cube.surface_mesh(triangles).unwrap()).unwrap();
        let (fine, coarse) = (surface(108), surface(48));
        let boundary = Method::BoundaryElements;
        let key = |surface, poissons_ratio, fixed: &[u32], touchable: &[u32], method| {
            let of = |list: &[u32]| list.iter().map(|&t| TriangleId(t)).collect::<Vec<_>>();
            Ingredients {
                surface,
                poissons_ratio,
                fixed: &of(fixed),
                touchable: &of(touchable),
                method,
                regions: None,
            }
            .key()
        };
        let first = key(&fine, 0.3, &[0, 1], &[2], boundary);
        assert_eq!(first, key(&fine, 0.3, &[0, 1], &[2], boundary));
        assert_eq!(first.len(), 64);
        let finite = |edge| Method::FiniteElements { edge };
        let mut all = vec![
            first,
            key(&coarse, 0.3, &[0, 1], &[2], boundary),
            key(&fine, 0.31, &[0, 1], &[2], boundary),
            key(&fine, 0.3, &[0], &[1, 2], boundary),
            key(&fine, 0.3, &[0, 1], &[3], boundary),
            key(&fine, 0.3, &[0, 1], &[2], finite(1e-3)),
            key(&fine, 0.3, &[0, 1], &[2], finite(2e-3)),
        ];
        all.sort();
        all.dedup();
        assert_eq!(all.len(), 7);
    }

    #[test]
    fn every_region_counts() {
        let surface = Surface::new(Organ::Cube.surface_mesh(108).unwrap()).unwrap();
        let tree = AabbTree::new(surface.mesh());
        let key = |depth: f64, radius: f64, modulus: f64| {
            let ball = InclusionShape::Ball {
                center_m: [0.0, 0.0, 0.02],
                radius_m: radius,
            };
            let places = [RegionPlace::Layer(depth), RegionPlace::Shape(ball)];
            let map = RegionMap::new(&surface, &tree, places).unwrap();
            let laws = [1.0, 1.0, modulus].map(|of| LinearElastic::new(of, 0.3).unwrap());
            Ingredients {
                surface: &surface,
                poissons_ratio: 0.3,
                fixed: &[],
                touchable: &[],
                method: Method::FiniteElements { edge: 1e-2 },
                regions: Some(RegionLaws {
                    map: &map,
                    laws: &laws,
                }),
            }
            .key()
        };
        let first = key(1e-3, 5e-3, 2.0);
        assert_eq!(first, key(1e-3, 5e-3, 2.0));
        let others = [
            key(2e-3, 5e-3, 2.0),
            key(1e-3, 6e-3, 2.0),
            key(1e-3, 5e-3, 3.0),
        ];
        assert!(others.iter().all(|other| *other != first));
    }
}
