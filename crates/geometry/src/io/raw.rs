use crate::{ReadFault, Vec3};

/// Vertices and triangles that are read of a mesh at most: no organ needs more, and a damaged file must not fill the
/// memory. They take 0.7 GB.
pub(crate) const MAX_TRIANGLES: u64 = 20_000_000;

/// Coordinates beyond this would overflow when they are multiplied.
const LARGEST_COORDINATE: f64 = 1e12;

/// A mesh as the file has it: in the unit of the file, indices checked.
#[derive(Debug, Default)]
pub(crate) struct RawMesh {
    pub(crate) vertices: Vec<Vec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
    faces: usize,
}

impl RawMesh {
    pub(crate) fn add_vertex(&mut self, position: Vec3) -> Result<(), ReadFault> {
        let vertex = self.vertices.len();
        if let Some(&found) = position
            .iter()
            .find(|c| c.is_nan() || c.abs() >= LARGEST_COORDINATE)
        {
            return Err(ReadFault::BadCoordinate { vertex, found });
        }
        check_count("vertices", vertex)?;
        self.vertices.push(position);
        Ok(())
    }

    /// Adds a polygon as a fan of triangles around its first corner. The corners are numbers from
    /// zero as the file has them; they are checked by [`Self::check_indices`] or here.
    pub(crate) fn add_face(&mut self, corners: &[u32]) -> Result<(), ReadFault> {
        let face = self.faces;
        self.faces += 1;
        let [first, rest @ ..] = corners else {
            return Err(ReadFault::TooFewCorners { face, found: 0 });
        };
        if rest.len() < 2 {
            let found = corners.len();
            return Err(ReadFault::TooFewCorners { face, found });
        }
        check_count("triangles", self.triangles.len() + rest.len())?;
        for pair in rest.windows(2) {
            self.triangles.push([*first, pair[0], pair[1]]);
        }
        Ok(())
    }

    /// Number of faces so far.
    pub(crate) fn faces(&self) -> usize {
        self.faces
    }

    /// Refuses a mesh without triangles or with corners that are not there.
    pub(crate) fn check_indices(self) -> Result<Self, ReadFault> {
        if self.triangles.is_empty() {
            return Err(ReadFault::NoTriangles);
        }
        let vertices = self.vertices.len();
        for (face, corners) in self.triangles.iter().enumerate() {
            if let Some(&corner) = corners.iter().find(|&&c| c as usize >= vertices) {
                return Err(ReadFault::BadIndex {
                    face,
                    found: i64::from(corner),
                    vertices,
                });
            }
        }
        Ok(self)
    }
}

fn check_count(what: &'static str, so_far: usize) -> Result<(), ReadFault> {
    if so_far as u64 >= MAX_TRIANGLES {
        return Err(ReadFault::TooLarge {
            what,
            found: so_far as u64 + 1,
            most: MAX_TRIANGLES,
        });
    }
    Ok(())
}
