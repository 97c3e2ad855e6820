use palpate_geometry::{Surface, TriangleId};
use sha2::{Digest, Sha256};

/// Changes with the equations, so that what was stored before is solved anew.
const EDITION: &str = "boundary elements 1";

/// What a response is made from.
pub(super) struct Ingredients<'a> {
    pub(super) surface: &'a Surface,
    /// [-]
    pub(super) poissons_ratio: f64,
    pub(super) held: &'a [TriangleId],
    pub(super) touchable: &'a [TriangleId],
}

impl Ingredients<'_> {
    /// 64 hexadecimal digits that no other ingredients have.
    pub(super) fn key(&self) -> String {
        let mut hash = Sha256::new();
        hash.update(EDITION);
        hash.update(self.poissons_ratio.to_le_bytes());
        let mesh = self.surface.mesh();
        hash.update((mesh.vertices().len() as u64).to_le_bytes());
        for coordinate in mesh.vertices().iter().flatten() {
            hash.update(coordinate.to_le_bytes());
        }
        for node in mesh.triangles().iter().flatten() {
            hash.update(node.0.to_le_bytes());
        }
        for list in [self.held, self.touchable] {
            hash.update((list.len() as u64).to_le_bytes());
            for triangle in list {
                hash.update(triangle.0.to_le_bytes());
            }
        }
        let digits = hash.finalize();
        digits.iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use palpate_geometry::Organ;

    #[test]
    fn every_ingredient_counts() {
        let surface =
            |triangles| Surface::new(Organ::Cube.surface_mesh(triangles).unwrap()).unwrap();
        let (fine, coarse) = (surface(108), surface(48));
        let key = |surface, poissons_ratio, held: &[u32], touchable: &[u32]| {
            let of = |list: &[u32]| list.iter().map(|&t| TriangleId(t)).collect::<Vec<_>>();
            Ingredients {
                surface,
                poissons_ratio,
                held: &of(held),
                touchable: &of(touchable),
            }
            .key()
        };
        let first = key(&fine, 0.3, &[0, 1], &[2]);
        assert_eq!(first, key(&fine, 0.3, &[0, 1], &[2]));
        assert_eq!(first.len(), 64);
        for other in [
            key(&coarse, 0.3, &[0, 1], &[2]),
            key(&fine, 0.31, &[0, 1], &[2]),
            key(&fine, 0.3, &[0], &[1, 2]),
            key(&fine, 0.3, &[0, 1], &[3]),
        ] {
            assert_ne!(first, other);
        }
    }
}
