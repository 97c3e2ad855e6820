use palpate_geometry::{AabbTree, Surface, TriangleId, Vec3};

/// Constant boundary elements are 10 % too stiff in bending when their edges are this part of a wall [-]
/// (`docs/theory/boundary_elements.md`).
const COARSEST: f64 = 0.6;

/// Part of the touchable triangles that may lie on thinner walls: rims are thin too [-].
const FEW: f64 = 0.1;

/// What deserves doubt where triangles are too large for the walls that they bound.
pub(super) fn doubt(surface: &Surface, touchable: &[TriangleId]) -> Option<String> {
    let mesh = surface.mesh();
    let tree = AabbTree::new(mesh);
    let (low, high) = mesh.bounds();
    let reach = (high - low).norm();
    let wall = |triangle: TriangleId| {
        let [a, b, c] = mesh.positions(triangle);
        let area = mesh.area_vector(triangle);
        let edge = (2.0 * area.norm()).sqrt();
        let inward: Vec3 = -area.normalize();
        let start = (a + b + c) / 3.0 + inward * (1e-3 * edge);
        let thickness = tree.cast(mesh, &start, &inward, reach)?.distance;
        Some((edge, thickness)).filter(|(edge, thickness)| *edge > COARSEST * thickness)
    };
    let coarse: Vec<_> = touchable.iter().copied().filter_map(wall).collect();
    if coarse.len() as f64 <= FEW * touchable.len() as f64 {
        return None;
    }
    let mean =
        |of: fn(&(f64, f64)) -> f64| 1e3 * coarse.iter().map(of).sum::<f64>() / coarse.len() as f64;
    let triangles = mesh.triangles().len();
    Some(format!(
        "{:.0} % of what can be touched are walls of {:.1} mm under triangles of {:.1} mm: more than 10 % too \
         stiff where they bend; raise `model.mechanical_triangles` above {triangles}",
        100.0 * coarse.len() as f64 / touchable.len() as f64,
        mean(|(_, thickness)| *thickness),
        mean(|(edge, _)| *edge),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use palpate_geometry::Organ;

    #[test]
    fn a_thin_wall_is_doubted_and_a_solid_is_not() {
        let doubted = |organ: Organ, triangles| {
            let surface = Surface::new(organ.surface_mesh(triangles).unwrap()).unwrap();
            let all: Vec<_> = surface.mesh().triangle_ids().collect();
            doubt(&surface, &all)
        };
        assert_eq!(doubted(Organ::Kidney, 1000), None);
        let words = doubted(Organ::Esophagus, 1000).unwrap();
        assert!(words.contains("mechanical_triangles` above"), "{words}");
        assert_eq!(doubted(Organ::Esophagus, 20_000), None);
    }
}
