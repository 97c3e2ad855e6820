use super::element::ElementKind;
use super::graded::halved;
use super::mismatch::Mismatch;
use crate::{Error, Vec3};

/// Elements of one kind in their places.
#[derive(Debug, Clone)]
pub struct ElementMesh {
    /// The kind of all elements.
    pub kind: ElementKind,
    /// Nodes at rest [m]: (x, y, z), or (r, z, 0) for [`ElementKind::Quad9`].
    pub nodes: Vec<Vec3>,
    /// Numbers of the nodes; elements × [`ElementKind::nodes`], element by element.
    pub elements: Vec<u32>,
}

impl ElementMesh {
    /// Number of elements.
    pub fn len(&self) -> usize {
        self.elements.len() / self.kind.nodes()
    }

    /// Whether there is no element.
    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }

    /// Nodes of an element.
    pub fn element(&self, element: usize) -> &[u32] {
        let nodes = self.kind.nodes();
        &self.elements[element * nodes..(element + 1) * nodes]
    }

    /// Numbers of the nodes for which `holds` is true, ascending.
    pub fn nodes_where(&self, holds: impl Fn(&Vec3) -> bool) -> Vec<usize> {
        (0..self.nodes.len())
            .filter(|&node| holds(&self.nodes[node]))
            .collect()
    }

    /// A grid of [`ElementKind::Quad9`] between the `columns` [m] in r and the `rows` [m] in z, both
    /// ascending; `place` puts a point of the grid where it belongs. Fewer than two columns or rows make no element.
    pub fn grid(columns: &[f64], rows: &[f64], place: impl Fn(f64, f64) -> [f64; 2]) -> Self {
        let (across, up) = (halved(columns), halved(rows));
        let width = across.len();
        let mut nodes = Vec::with_capacity(width * up.len());
        for &z in &up {
            for &r in &across {
                let [r, z] = place(r, z);
                nodes.push(Vec3::new(r, z, 0.0));
            }
        }
        let mut elements = Vec::new();
        for j in (0..up.len().saturating_sub(1)).step_by(2) {
            for i in (0..width.saturating_sub(1)).step_by(2) {
                let corner = i + j * width;
                elements.extend((0..9).map(|n| (corner + n % 3 + n / 3 * width) as u32));
            }
        }
        Self {
            kind: ElementKind::Quad9,
            nodes,
            elements,
        }
    }

    /// Every element has all of its nodes, and they exist.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let whole = self.len() * self.kind.nodes();
        if self.elements.len() != whole {
            return Err(Mismatch::WrongLength {
                what: "the list of the elements' nodes",
                found: self.elements.len(),
                expected: whole + self.kind.nodes(),
            }
            .into());
        }
        let nodes = self.nodes.len();
        let stray = self.elements.iter().position(|&n| n as usize >= nodes);
        if let Some(place) = stray {
            return Err(Error::NodeOutOfRange {
                element: place / self.kind.nodes(),
                nodes,
            });
        }
        if self.is_empty() {
            return Err(Error::NoElements);
        }
        Ok(())
    }
}
