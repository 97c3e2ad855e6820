use palpate_files::scene::EnhancementArea;
use palpate_geometry::{Surface, TriangleId};

/// The triangles that are replaced around some contacts (figure 4-4).
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Neighborhood {
    refined: Vec<TriangleId>,
    border: Vec<TriangleId>,
}

impl Neighborhood {
    /// The neighbourhood of the triangles `touched`.
    pub fn of(surface: &Surface, touched: &[TriangleId], area: EnhancementArea) -> Self {
        let mut neighborhood = Self::default();
        neighborhood.gather(surface, touched, area);
        neighborhood
    }

    /// The triangles that are cut into finer ones.
    pub fn refined(&self) -> &[TriangleId] {
        &self.refined
    }

    /// Their neighbours, which are cut only so that no vertex lies inside an edge.
    pub fn border(&self) -> &[TriangleId] {
        &self.border
    }

    /// Which edges of a triangle (from corner k to the next) are cut.
    pub(super) fn cut(&self, surface: &Surface, triangle: TriangleId) -> [bool; 3] {
        let across = surface.adjacency().across(triangle);
        across.map(|other| other.is_some_and(|other| self.refined.contains(&other)))
    }

    /// [`Neighborhood::of`] into the same buffers.
    pub(super) fn gather(
        &mut self,
        surface: &Surface,
        touched: &[TriangleId],
        area: EnhancementArea,
    ) {
        self.refined.clear();
        self.border.clear();
        let adjacency = surface.adjacency();
        for &triangle in touched {
            match area {
                EnhancementArea::None => {}
                EnhancementArea::Edge => {
                    self.refined.push(triangle);
                    self.refined.extend(adjacency.edge_neighborhood(triangle));
                }
                EnhancementArea::Vertex => {
                    for corner in surface.mesh().corners(triangle) {
                        self.refined.extend_from_slice(adjacency.around(corner));
                    }
                }
            }
        }
        self.refined.sort_unstable();
        self.refined.dedup();
        self.border.extend(
            self.refined
                .iter()
                .flat_map(|&triangle| adjacency.edge_neighborhood(triangle)),
        );
        self.border.sort_unstable();
        self.border.dedup();
        let refined = &mut self.refined;
        let area = refined.len();
        self.border.retain(|&triangle| {
            if refined[..area].binary_search(&triangle).is_ok() {
                return false;
            }
            let cut = adjacency.edge_neighborhood(triangle);
            let enclosed = cut
                .filter(|other| refined[..area].binary_search(other).is_ok())
                .count()
                == 3;
            if enclosed {
                refined.push(triangle);
            }
            !enclosed
        });
    }
}
