use super::shell::dihedral_quality;
use crate::Vec3;

/// Tetrahedra whose edges are split.
#[derive(Debug, Clone)]
pub(crate) struct SplitNet {
    pub(crate) vertices: Vec<Vec3>,
    pub(crate) tetrahedra: Vec<[u32; 4]>,
    /// The tetrahedra around each vertex.
    pub(crate) around: Vec<Vec<u32>>,
}

impl SplitNet {
    pub(crate) fn new(vertices: Vec<Vec3>, tetrahedra: Vec<[u32; 4]>) -> Self {
        let mut around = vec![Vec::new(); vertices.len()];
        for (number, nodes) in tetrahedra.iter().enumerate() {
            for &node in nodes {
                around[node as usize].push(number as u32);
            }
        }
        Self {
            vertices,
            tetrahedra,
            around,
        }
    }

    /// The tetrahedra that have an edge.
    pub(crate) fn with_edge(&self, [a, b]: [u32; 2]) -> Vec<u32> {
        let around = self.around[a as usize].iter().copied();
        around
            .filter(|&t| self.tetrahedra[t as usize].contains(&b))
            .collect()
    }

    /// The tetrahedra around a vertex.
    pub(crate) fn star(&self, node: u32) -> Vec<[u32; 4]> {
        let around = self.around[node as usize].iter();
        around.map(|&t| self.tetrahedra[t as usize]).collect()
    }

    /// Splits an edge at the first of some `targets` [m] where no tetrahedron is less open than `floor` [rad]. Which tetrahedra had the
    /// edge, as [`Self::split`]; none where no target is sound.
    pub(crate) fn split_if_valid(
        &mut self,
        edge: [u32; 2],
        targets: impl IntoIterator<Item = Vec3>,
        floor: f64,
    ) -> Option<Vec<u32>> {
        let middle = self.vertices.len() as u32;
        let with_edge = self.with_edge(edge).into_iter();
        let halves: Vec<_> = with_edge
            .flat_map(|t| self.halves(t, edge, middle))
            .collect();
        let sound = targets.into_iter().find(|target| {
            let position = |node: u32| match node == middle {
                true => *target,
                false => self.vertices[node as usize],
            };
            let mut halves = halves.iter();
            halves.all(|corners| dihedral_quality(&corners.map(position)) >= floor)
        });
        sound.map(|place| self.split(edge, place))
    }

    /// The two halves of a tetrahedron when an edge of it gets the vertex `middle`: the part at the edge's beginning, and that at its
    /// end.
    pub(crate) fn halves(&self, number: u32, [a, b]: [u32; 2], middle: u32) -> [[u32; 4]; 2] {
        let nodes = self.tetrahedra[number as usize];
        [b, a].map(|old| nodes.map(|node| if node == old { middle } else { node }))
    }

    /// Puts a vertex at `place` [m] into an edge. Which tetrahedra had that: their parts at its beginning take their places, the
    /// others come last, in the same order.
    pub(crate) fn split(&mut self, edge: [u32; 2], place: Vec3) -> Vec<u32> {
        let with_edge = self.with_edge(edge);
        let middle = self.vertices.len() as u32;
        self.vertices.push(place);
        self.around.push(Vec::new());
        for &number in &with_edge {
            let [first, second] = self.halves(number, edge, middle);
            let added = self.tetrahedra.len() as u32;
            self.tetrahedra[number as usize] = first;
            self.tetrahedra.push(second);
            for node in second {
                let entries = &mut self.around[node as usize];
                if node == edge[1] {
                    entries.retain(|&entry| entry != number);
                }
                entries.push(added);
            }
            self.around[middle as usize].push(number);
        }
        with_edge
    }
}
