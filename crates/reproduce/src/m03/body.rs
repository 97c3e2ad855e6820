use palpate_geometry::{
    AnchorPlane, Organ, SimplifySettings, Surface, TriangleId, TriangleMesh, Vec3, simplify,
};
use palpate_mechanics::boundary_elements::BoundaryProblem;

use crate::Error;
use crate::published::cell;
use crate::real_mesh::real_mesh;

/// The source names none.
const POISSONS_RATIO: f64 = 0.45;

/// Part of the depth of a real kidney that is fixed, from its back [-].
const FIXED_PART: f64 = 0.25;

/// A solid with its fixed and its free triangles.
pub(crate) struct Body {
    pub(crate) surface: Surface,
    fixed: Vec<TriangleId>,
    pub(super) free: Vec<TriangleId>,
    /// Description for notes.
    pub(crate) description: String,
}

/// A model of table 4-1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Model {
    /// Its row in the published table.
    pub(super) row: &'static str,
    /// The real mesh that is taken when it is at hand.
    real: Option<&'static str>,
    /// The built-in organ that is taken otherwise.
    organ: Organ,
}

pub(crate) const MODELS: [Model; 3] = [
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

impl Model {
    fn real_mesh(&self) -> Result<Option<(TriangleMesh, &'static str)>, Error> {
        match self.real {
            Some(name) => Ok(real_mesh(name)?.map(|mesh| (mesh, name))),
            None => Ok(None),
        }
    }
}

impl Body {
    /// With as many triangles as published, or one more.
    pub(crate) fn new(model: Model) -> Result<Self, Error> {
        let organ = model.organ;
        let triangles = cell(&format!("table-4-1 {} triangles", model.row))? as usize;
        match model.real_mesh()? {
            Some((mesh, name)) => Self::real(&mesh, &format!("the real mesh {name}")),
            None => Self::built_in(organ, triangles),
        }
    }

    /// The last kidney of the table with at most so many triangles.
    pub(super) fn kidney(triangles: usize) -> Result<Self, Error> {
        let Some((mesh, name)) = MODELS[2].real_mesh()? else {
            return Self::built_in(MODELS[2].organ, triangles);
        };
        let settings = SimplifySettings::to(triangles);
        let coarse = simplify(&mesh, &settings)?;
        Self::real(&coarse.mesh, &format!("the real mesh {name} made coarser"))
    }

    fn real(mesh: &TriangleMesh, whose: &str) -> Result<Self, Error> {
        // From y up and z to the front to the axes of the built-in organs.
        let mesh = mesh.map_vertices(|v| Vec3::new(v.x, -v.z, v.y))?;
        let (low, high) = mesh.bounds();
        let plane = AnchorPlane {
            point: high - FIXED_PART * (high - low),
            normal: -Vec3::y(),
        };
        let whose = format!("{whose}, fixed on the back quarter");
        Self::fixed(Surface::new(mesh)?, &[plane], &whose)
    }

    fn built_in(organ: Organ, triangles: usize) -> Result<Self, Error> {
        let mesh = organ.surface_mesh(triangles)?;
        let whose = format!(
            "the built-in {organ}, fixed on {}",
            organ.description().fixed
        );
        Self::fixed(Surface::new(mesh)?, &organ.anchor(), &whose)
    }

    fn fixed(surface: Surface, anchor: &[AnchorPlane], whose: &str) -> Result<Self, Error> {
        let mesh = surface.mesh();
        let (fixed, free) = mesh.triangle_ids().partition(|&triangle| {
            let centroid = centroid(&surface, triangle);
            anchor.iter().any(|plane| plane.contains(&centroid))
        });
        let description = format!(
            "{whose}: {} vertices, {} triangles",
            mesh.vertices().len(),
            mesh.triangles().len()
        );
        Ok(Self {
            surface,
            fixed,
            free,
            description,
        })
    }

    /// The boundary problem in which all free triangles are touchable.
    pub(super) fn problem(&self) -> BoundaryProblem<'_> {
        BoundaryProblem {
            surface: &self.surface,
            poissons_ratio: POISSONS_RATIO,
            fixed: &self.fixed,
            touchable: &self.free,
        }
    }

    /// The free triangles, nearest first, about the place opposite the fixed triangles.
    pub(crate) fn opposite(&self) -> Vec<TriangleId> {
        let middle = |ids: &[TriangleId]| {
            let sum: Vec3 = ids.iter().map(|&id| self.centroid(id)).sum();
            sum / ids.len() as f64
        };
        let center = middle(&self.fixed);
        let axis = (middle(&self.free) - center).normalize();
        // Far along the axis, and near it.
        let score = |id: TriangleId| {
            let away = self.centroid(id) - center;
            let along = away.dot(&axis);
            along - (away - along * axis).norm()
        };
        let first = self.free.iter().copied();
        let first = first.max_by(|&a, &b| score(a).total_cmp(&score(b)));
        let first = first.map_or(center, |id| self.centroid(id));
        let away = |id: TriangleId| (self.centroid(id) - first).norm();
        let mut near = self.free.clone();
        near.sort_by(|&a, &b| away(a).total_cmp(&away(b)));
        near
    }

    /// Unit outward normal of the triangle opposite the fixed ones [-].
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
