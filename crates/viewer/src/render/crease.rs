use palpate_geometry::{NodeId, SHARP_EDGE, Vec3};

/// A mesh for drawing: a vertex at a crease is there once for each side.
pub(super) struct Creased {
    /// The mesh's vertex behind each drawn one.
    pub(super) nodes: Vec<u32>,
    /// Drawn vertices of each triangle.
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Splits vertices where the surface has an edge.
pub(super) fn crease(vertices: &[Vec3], triangles: &[[NodeId; 3]]) -> Creased {
    let mut nodes: Vec<u32> = (0..vertices.len() as u32).collect();
    // Per drawn vertex: a normal of its side, and the next drawn vertex at the same place.
    let mut sides: Vec<(Option<Vec3>, Option<u32>)> = vec![(None, None); vertices.len()];
    let mut drawn = Vec::with_capacity(triangles.len());
    for corners in triangles {
        let [a, b, c] = corners.map(|node| vertices[node.index()]);
        let normal = (b - a).cross(&(c - a));
        let normal = normal.try_normalize(0.0).unwrap_or_else(Vec3::z);
        drawn.push(corners.map(|node| {
            let mut at = node.0;
            loop {
                match &mut sides[at as usize] {
                    (side @ None, _) => {
                        *side = Some(normal);
                        return at;
                    }
                    (Some(side), _) if side.dot(&normal) > SHARP_EDGE => return at,
                    (_, Some(next)) => at = *next,
                    (_, next) => {
                        let new = nodes.len() as u32;
                        *next = Some(new);
                        nodes.push(node.0);
                        sides.push((Some(normal), None));
                        return new;
                    }
                }
            }
        }));
    }
    Creased {
        nodes,
        triangles: drawn,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use palpate_geometry::Organ;

    #[test]
    fn a_cube_has_its_edges_and_a_liver_none() {
        let cube = Organ::Cube.surface_mesh(3_072).unwrap();
        let drawn = crease(cube.vertices(), cube.triangles());
        // Twelve edges of fifteen inner vertices twice, eight corners three times.
        let steps = (3_072.0_f64 / 12.0).sqrt() as usize;
        let added = drawn.nodes.len() - cube.vertices().len();
        assert_eq!(added, 12 * (steps - 1) + 8 * 2);
        let liver = Organ::Liver.surface_mesh(6_000).unwrap();
        let drawn = crease(liver.vertices(), liver.triangles());
        assert!(drawn.nodes.len() < liver.vertices().len() * 102 / 100);
    }
}
