use palpate_geometry::{AabbTree, Surface, Vec3};

/// Rays that may be cast for one organ: a tenth of a second's work.
const RAYS: usize = 160_000;

/// Openness of each vertex to light from all sides [-]: 1 on a ball, less in a hollow, by the rays from there
/// that meet the organ again within a third of its size.
pub(crate) fn ambient_light(surface: &Surface) -> Vec<f32> {
    let mesh = surface.mesh();
    let tree = AabbTree::new(mesh);
    let (low, high) = mesh.bounds();
    let reach = 0.33 * (high - low).norm();
    let rays = (RAYS / mesh.vertices().len()).clamp(4, 24);
    let open: Vec<f32> = mesh
        .vertices()
        .iter()
        .zip(surface.vertex_normals())
        .map(|(vertex, normal)| {
            let from = vertex + 2e-3 * reach * normal;
            let blocked: f64 = directions(normal, rays)
                .filter_map(|direction| tree.cast(mesh, &from, &direction, reach))
                .map(|hit| 1.0 - hit.distance / reach)
                .sum();
            (1.0 - blocked / rays as f64) as f32
        })
        .collect();
    smoothed(surface, &open)
}

/// Directions around `normal`, denser towards it as light counts there, along a spiral.
fn directions(normal: &Vec3, count: usize) -> impl Iterator<Item = Vec3> {
    let other = if normal.x.abs() < 0.8 {
        Vec3::x()
    } else {
        Vec3::y()
    };
    let first = normal.cross(&other).normalize();
    let second = normal.cross(&first);
    let normal = *normal;
    (0..count).map(move |k| {
        let squared = (k as f64 + 0.5) / count as f64;
        // The golden angle.
        let (sin, cos) = (2.399_963 * k as f64).sin_cos();
        let flat = squared.sqrt();
        flat * (cos * first + sin * second) + (1.0 - squared).sqrt() * normal
    })
}

/// Each vertex and its neighbours evened out: few rays leave grain.
fn smoothed(surface: &Surface, open: &[f32]) -> Vec<f32> {
    let mut sums: Vec<(f32, f32)> = open.iter().map(|&value| (value, 1.0)).collect();
    for corners in surface.mesh().triangles() {
        let mean = corners.iter().map(|c| open[c.index()]).sum::<f32>() / 3.0;
        for corner in corners {
            sums[corner.index()].0 += mean;
            sums[corner.index()].1 += 1.0;
        }
    }
    sums.into_iter().map(|(sum, count)| sum / count).collect()
}
