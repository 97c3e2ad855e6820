//! Cells by the numbers that VTK has for them.

use super::RawVolume;
use crate::ReadFault;

const TETRAHEDRON: i64 = 10;
const QUADRATIC_TETRAHEDRON: i64 = 24;

/// Points, lines, faces, straight, quadratic and of any order: they bound volumes and fill none.
const FLAT: [i64; 21] = [
    1, 2, 3, 4, 5, 6, 7, 8, 9, 21, 22, 23, 28, 30, 34, 35, 36, 68, 69, 70, 75,
];

/// Cells as lists: where each ends among the nodes, and what it is.
#[derive(Debug, Default)]
pub(super) struct CellLists {
    pub(super) nodes: Vec<i64>,
    pub(super) ends: Vec<i64>,
    pub(super) kinds: Vec<i64>,
    /// The number of the region of each; empty where the file has none.
    pub(super) regions: Vec<i64>,
}

impl CellLists {
    /// Puts the tetrahedra into `volume`.
    pub(super) fn sort_out(&self, volume: &mut RawVolume) -> Result<(), ReadFault> {
        if self.kinds.len() != self.ends.len() {
            return Err(ReadFault::Mismatch {
                what: "types of cells",
                found: self.kinds.len(),
                expected: self.ends.len(),
            });
        }
        if !self.regions.is_empty() && self.regions.len() != self.kinds.len() {
            return Err(ReadFault::Mismatch {
                what: "regions of cells",
                found: self.regions.len(),
                expected: self.kinds.len(),
            });
        }
        let mut start = 0;
        for (cell, (&kind, &end)) in self.kinds.iter().zip(&self.ends).enumerate() {
            let end = usize::try_from(end).unwrap_or(0);
            let nodes = self.nodes.get(start..end).ok_or(ReadFault::Mismatch {
                what: "nodes of cells",
                found: self.nodes.len(),
                expected: end.max(start),
            })?;
            start = end;
            let expected = match kind {
                TETRAHEDRON => 4,
                QUADRATIC_TETRAHEDRON => 10,
                _ if FLAT.contains(&kind) => continue,
                _ => {
                    let found = named(kind);
                    return Err(ReadFault::NotATetrahedron { cell, found });
                }
            };
            if nodes.len() != expected {
                return Err(ReadFault::Mismatch {
                    what: "nodes of a tetrahedron",
                    found: nodes.len(),
                    expected,
                });
            }
            volume.add([nodes[0], nodes[1], nodes[2], nodes[3]], cell)?;
            let region = self.regions.get(cell).copied();
            volume.regions.push(region.unwrap_or(0));
        }
        Ok(())
    }
}

impl RawVolume {
    fn add(&mut self, nodes: [i64; 4], cell: usize) -> Result<(), ReadFault> {
        let vertices = self.points.vertices.len();
        let mut corners = [0; 4];
        for (corner, found) in corners.iter_mut().zip(nodes) {
            *corner = u32::try_from(found)
                .ok()
                .filter(|&n| (n as usize) < vertices)
                .ok_or(ReadFault::BadCorner {
                    cell,
                    found,
                    vertices,
                })?;
        }
        self.tetrahedra.push(corners);
        Ok(())
    }
}

fn named(kind: i64) -> String {
    let name = match kind {
        11 | 12 | 25 | 29 | 33 | 72 | 67 => "a hexahedron",
        13 | 26 | 31 | 32 | 73 => "a wedge",
        14 | 27 | 37 | 74 => "a pyramid",
        71 | 76..=82 => "a cell of high order",
        _ => "an unknown cell",
    };
    format!("{name} (type {kind})")
}
