use palpate_geometry::{Surface, TriangleId, TriangleMesh, Vec3, closest_on_triangle};
use palpate_mechanics::inclusion::InclusionField;
use palpate_mechanics::on_all_cores;

/// Radii of loads for which the inclusions are tabulated, and the least over that of the tip [-].
const RADII: usize = 5;
const LEAST_LOAD: f64 = 1.7;

/// Places of a triangle: its corners, then the middles of 01, 12, 20.
const PLACES: usize = 6;

/// What the inclusions under the surface that is seen add to what a tip is moved by, for loads of several radii; nothing of bodies
/// without any.
#[derive(Debug, Clone, Default)]
pub(crate) struct InclusionTable {
    /// Of each triangle: what is to be interpolated [1/m].
    at: Vec<[[f64; RADII]; PLACES]>,
}

impl InclusionTable {
    /// For a tip of the `radius` [m] on bodies with these inclusions, whose triangles follow one another.
    pub(crate) fn new(radius: f64, bodies: &[(&Surface, InclusionField)]) -> Self {
        if bodies.iter().all(|(_, field)| field.is_empty()) {
            return Self::default();
        }
        let loads = std::array::from_fn(|n| LEAST_LOAD * radius * 2.0_f64.powi(n as i32));
        let triangles = bodies.iter();
        let triangles = triangles.map(|(surface, _)| surface.mesh().triangles().len());
        let mut at = vec![[[0.0; RADII]; PLACES]; triangles.sum()];
        let mut rest = at.as_mut_slice();
        for (surface, field) in bodies {
            let mesh = surface.mesh();
            let (own, others) = rest.split_at_mut(mesh.triangles().len());
            on_all_cores(
                own.iter_mut().zip(mesh.triangle_ids()),
                |(own, triangle)| {
                    let corners = mesh.positions(triangle);
                    let normals = mesh
                        .corners(triangle)
                        .map(|node| surface.vertex_normals()[node.index()]);
                    for (own, [u, v, w]) in own.iter_mut().zip(PLACES_OF) {
                        let mean = |of: &[Vec3; 3]| of[0] * u + of[1] * v + of[2] * w;
                        *own = field.exchange(
                            radius,
                            loads,
                            &mean(&corners),
                            &mean(&normals).normalize(),
                        );
                    }
                },
            );
            rest = others;
        }
        Self { at }
    }

    /// At a `place` [m] of a triangle of the shown `mesh`, of a tip and a load with these `radii` [m].
    pub(crate) fn compliance(
        &self,
        mesh: &TriangleMesh,
        (triangle, place): (TriangleId, &Vec3),
        [tip, load]: [f64; 2],
    ) -> f64 {
        let Some(at) = self.at.get(triangle.index()) else {
            return 0.0;
        };
        let on = closest_on_triangle(&mesh.positions(triangle), place);
        let [a, b, c] = on.barycentric;
        let corner = |l: f64| l * (2.0 * l - 1.0);
        let shape = [
            corner(a),
            corner(b),
            corner(c),
            4.0 * a * b,
            4.0 * b * c,
            4.0 * c * a,
        ];
        let position = (load / (LEAST_LOAD * tip)).log2();
        let position = position.clamp(0.0, (RADII - 1) as f64);
        let below = (position as usize).min(RADII - 2);
        let within = position - below as f64;
        let each = at.iter().zip(shape);
        each.map(|(at, shape)| shape * ((1.0 - within) * at[below] + within * at[below + 1]))
            .sum()
    }
}

/// Barycentric coordinates of the places.
const PLACES_OF: [[f64; 3]; PLACES] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.5, 0.5, 0.0],
    [0.0, 0.5, 0.5],
    [0.5, 0.0, 0.5],
];
