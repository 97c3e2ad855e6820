use crate::{AabbTree, Surface, TetrahedronMesh, Vec3};

/// How faithfully tetrahedra fill a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fidelity {
    /// Volume of the filling less that within the surface, relative to the latter [-].
    pub volume: f64,
    /// The largest distance of a vertex of the surface to the boundary of the filling [m].
    pub distance: f64,
    /// That vertex [m].
    pub place: Vec3,
}

impl Fidelity {
    /// A relative error of the volume above this gives a warning [-]: a tenth of the allowed error of an organ's force.
    pub const VOLUME: f64 = 0.005;

    /// That of the `filling` of a `surface`.
    pub fn of(filling: &TetrahedronMesh, surface: &Surface) -> Self {
        let boundary = filling.boundary_mesh();
        let tree = AabbTree::new(&boundary);
        let mesh = surface.mesh();
        let off = |place: &Vec3| (tree.nearest(&boundary, place).distance, *place);
        let farthest = mesh.vertices().iter().map(off);
        let farthest = farthest.reduce(|most, next| if next.0 > most.0 { next } else { most });
        let (distance, place) = farthest.unwrap_or_default();
        Self {
            volume: filling.volume() / mesh.volume() - 1.0,
            distance,
            place,
        }
    }

    /// A sentence where the volume is off by more than half of a percent, or a part longer than an `edge` [m] of the
    /// lattice is missing: edges and corners are rounded by less.
    pub fn warning(&self, edge: f64) -> Option<String> {
        let Self {
            volume,
            distance,
            place,
        } = self;
        if volume.abs() <= Self::VOLUME && *distance <= edge {
            return None;
        }
        let off = match *volume {
            less if less < -Self::VOLUME => {
                format!("{:.1} % of the volume is missing, and ", -100.0 * less)
            }
            more if more > Self::VOLUME => {
                format!("there is {:.1} % too much volume, and ", 100.0 * more)
            }
            _ => String::new(),
        };
        let [x, y, z]: [f64; 3] = (*place).into();
        Some(format!(
            "the tetrahedra follow the surface with edges of about {:.1} mm: {off}they end up to {:.1} mm from it, \
             at ({x:.4}, {y:.4}, {z:.4}) m, where it is sharp or thin",
            1e3 * edge,
            1e3 * distance,
        ))
    }
}
