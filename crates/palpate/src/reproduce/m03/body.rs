use palpate_geometry::{AnchorPlane, Organ, Surface, TriangleId, Vec3};
use palpate_mechanics::boundary_elements::BoundaryProblem;

use crate::failure::Failure;
use crate::reproduce::published::TABLE_4_1;
use crate::reproduce::real_mesh::real_mesh;

/// The source names none.
const POISSONS_RATIO: f64 = 0.45;

/// Part of the depth of a real kidney that is held, from its back [-].
const HELD: f64 = 0.25;

/// A solid, what holds it, and all the rest of its surface.
pub(in crate::reproduce) struct Body {
    pub(in crate::reproduce) surface: Surface,
    held: Vec<TriangleId>,
    pub(super) free: Vec<TriangleId>,
    /// What it is.
    pub(in crate::reproduce) told: String,
}

/// A model of table 4-1.
#[derive(Debug, Clone, Copy)]
pub(in crate::reproduce) struct Model {
    /// Its row in the published table.
    pub(super) row: &'static str,
    /// The real mesh that is taken when it is at hand.
    real: Option<&'static str>,
    /// What is taken else.
    organ: Organ,
}

pub(in crate::reproduce) const MODELS: [Model; 3] = [
    Model {
        row: "cube",
        real: None,
        organ: Organ::Cube,
    },
    Model {
        row: "kidney_graphic",
        real: Some("vhm_kidney_left_688"),
        organ: Organ::Kidney,
    },
    Model {
        row: "kidney_visible_human",
        real: Some("vhm_kidney_left_5146"),
        organ: Organ::Kidney,
    },
];

impl Body {
    /// With as many triangles as published, or one more.
    pub(in crate::reproduce) fn new(Model { row, real, organ }: Model) -> Result<Self, Failure> {
        let triangles = TABLE_4_1.value(row, "triangles");
        let triangles = triangles.map_or(organ.default_triangles(), |count| count as usize);
        let found = match real {
            Some(name) => real_mesh(name)?.map(|mesh| (mesh, name)),
            None => None,
        };
        let (mesh, anchor, whose) = match found {
            Some((mesh, name)) => {
                // From y up and z to the front to the axes of the built-in organs.
                let mesh = mesh.map_vertices(|v| Vec3::new(v.x, -v.z, v.y))?;
                let (low, high) = mesh.bounds();
                let plane = AnchorPlane {
                    point: high - HELD * (high - low),
                    normal: -Vec3::y(),
                };
                let whose = format!("the real mesh {name}, held on the back quarter");
                (mesh, vec![plane], whose)
            }
            None => {
                let mesh = organ.surface_mesh(triangles)?;
                let held = organ.description().held;
                let whose = format!("the built-in {organ}, held on {held}");
                (mesh, organ.anchor(), whose)
            }
        };
        let surface = Surface::new(mesh)?;
        let mesh = surface.mesh();
        let (held, free) = mesh.triangle_ids().partition(|&triangle| {
            let centroid = centroid(&surface, triangle);
            anchor.iter().any(|plane| plane.holds(&centroid))
        });
        let told = format!(
            "{whose}: {} vertices, {} triangles",
            mesh.vertices().len(),
            mesh.triangles().len()
        );
        Ok(Self {
            surface,
            held,
            free,
            told,
        })
    }

    /// With all that is not held touchable.
    pub(super) fn problem(&self) -> BoundaryProblem<'_> {
        BoundaryProblem {
            surface: &self.surface,
            poissons_ratio: POISSONS_RATIO,
            held: &self.held,
            touchable: &self.free,
        }
    }

    /// The free triangles, nearest first, about the place that lies opposite of what holds the body.
    pub(in crate::reproduce) fn opposite(&self) -> Vec<TriangleId> {
        let middle = |ids: &[TriangleId]| {
            let sum: Vec3 = ids.iter().map(|&id| self.centroid(id)).sum();
            sum / ids.len() as f64
        };
        let held = middle(&self.held);
        let axis = (middle(&self.free) - held).normalize();
        // Far along the axis, and near it.
        let score = |id: TriangleId| {
            let away = self.centroid(id) - held;
            let along = away.dot(&axis);
            along - (away - along * axis).norm()
        };
        let first = self.free.iter().copied();
        let first = first.max_by(|&a, &b| score(a).total_cmp(&score(b)));
        let first = first.map_or(held, |id| self.centroid(id));
        let away = |id: TriangleId| (self.centroid(id) - first).norm();
        let mut near = self.free.clone();
        near.sort_by(|&a, &b| away(a).total_cmp(&away(b)));
        near
    }

    /// Unit outward normal of the triangle opposite of what holds the body [-].
    pub(super) fn touched_normal(&self) -> Vec3 {
        let triangle = self.opposite()[0];
        self.surface.mesh().area_vector(triangle).normalize()
    }

    fn centroid(&self, triangle: TriangleId) -> Vec3 {
        centroid(&self.surface, triangle)
    }
}

fn centroid(surface: &Surface, triangle: TriangleId) -> Vec3 {
    surface.mesh().positions(triangle).iter().sum::<Vec3>() / 3.0
}
