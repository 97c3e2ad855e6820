use std::collections::HashMap;

use super::block::Block;
use crate::{NodeId, Vec3};

/// Corners of the faces of a cell, counter-clockwise seen from outside; bit `k` of a corner is its
/// place along axis `k`.
const FACES: [[usize; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

/// An edge of a cell, by its ends.
type Edge = (usize, usize);

/// The surface between the voxels inside and those outside, through the middles between them.
///
/// Marching cubes whose loops are traced rather than looked up: on a face with two inside corners
/// across, these are separated, in both cells alike. So every edge of the surface has two
/// triangles; and a vertex, which belongs to one edge of the grid, one fan.
///
/// None when it has more than so many triangles.
pub(super) fn contour(block: &Block, most: usize) -> Option<(Vec<Vec3>, Vec<[NodeId; 3]>)> {
    let table: Vec<Vec<Vec<Edge>>> = (0..256).map(loops).collect();
    let [nx, ny, nz] = block.size;
    let mut surface = Contour::default();
    for z in 0..nz - 1 {
        for y in 0..ny - 1 {
            for x in 0..nx - 1 {
                let corner = |c: usize| {
                    let [i, j, k] = [x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)];
                    (k * ny + j) * nx + i
                };
                let case = (0..8).filter(|&c| block.is_inside(corner(c)));
                let case: usize = case.map(|c| 1 << c).sum();
                for ring in &table[case] {
                    let nodes = ring.iter().map(|&(a, b)| {
                        let middle =
                            Vec3::new(x as f64, y as f64, z as f64) + 0.5 * (offset(a) + offset(b));
                        surface.vertex(corner(a), corner(b), middle)
                    });
                    let nodes: Vec<NodeId> = nodes.collect();
                    surface.close(&nodes);
                }
            }
            if surface.triangles.len() > most {
                return None;
            }
        }
    }
    Some((surface.vertices, surface.triangles))
}

#[derive(Default)]
struct Contour {
    vertices: Vec<Vec3>,
    triangles: Vec<[NodeId; 3]>,
    numbers: HashMap<(usize, usize), NodeId>,
}

impl Contour {
    /// The vertex on an edge of the grid, made when it is met first.
    fn vertex(&mut self, a: usize, b: usize, position: Vec3) -> NodeId {
        let new = NodeId(self.vertices.len() as u32);
        let number = *self.numbers.entry((a.min(b), a.max(b))).or_insert(new);
        if number == new {
            self.vertices.push(position);
        }
        number
    }

    /// Triangles over a loop; a long one gets a vertex in its middle, so that no edge is shared with
    /// another loop by chance.
    fn close(&mut self, ring: &[NodeId]) {
        match *ring {
            [a, b, c] => self.triangles.push([a, b, c]),
            [a, b, c, d] => self.triangles.extend([[a, b, c], [a, c, d]]),
            _ => {
                let sum: Vec3 = ring.iter().map(|node| self.vertices[node.index()]).sum();
                let middle = NodeId(self.vertices.len() as u32);
                self.vertices.push(sum / ring.len() as f64);
                for (k, &node) in ring.iter().enumerate() {
                    self.triangles
                        .push([node, ring[(k + 1) % ring.len()], middle]);
                }
            }
        }
    }
}

fn offset(corner: usize) -> Vec3 {
    Vec3::from_fn(|k, _| (corner >> k & 1) as f64)
}

/// The closed loops of crossed edges in a cell whose inside corners are the bits of `case`.
fn loops(case: usize) -> Vec<Vec<Edge>> {
    let inside = |corner: usize| case >> corner & 1 == 1;
    // From each crossed edge to the next: over each face one step for each run of inside corners.
    let mut steps: Vec<(Edge, Edge)> = Vec::new();
    for face in FACES {
        for k in 0..4 {
            if inside(face[k]) || !inside(face[(k + 1) % 4]) {
                continue;
            }
            let mut end = k + 1;
            while inside(face[(end + 1) % 4]) {
                end += 1;
            }
            let enter = edge(face[k], face[(k + 1) % 4]);
            let leave = edge(face[end % 4], face[(end + 1) % 4]);
            steps.push((enter, leave));
        }
    }
    let mut loops = Vec::new();
    while let Some((start, mut at)) = steps.pop() {
        let mut ring = vec![start];
        while at != start {
            ring.push(at);
            let next = steps.iter().position(|&(from, _)| from == at);
            let next = next.expect("each crossed edge is entered and left once");
            at = steps.swap_remove(next).1;
        }
        loops.push(ring);
    }
    loops
}

fn edge(a: usize, b: usize) -> Edge {
    (a.min(b), a.max(b))
}
