/// A closed net of triangles whose edges can be flipped. Edge `k` of a triangle runs from corner
/// `k` to corner `(k + 1) % 3`.
pub(super) struct Triangulation {
    triangles: Vec<[u32; 3]>,
    /// The triangle across each edge.
    across: Vec<[u32; 3]>,
}

/// The two triangles at an edge: `left` = (from, to, apex) and `right` = (to, from, opposite).
#[derive(Clone, Copy)]
pub(super) struct Diamond {
    pub(super) from: u32,
    pub(super) to: u32,
    pub(super) apex: u32,
    pub(super) opposite: u32,
}

impl Triangulation {
    /// The net of `triangles`, which are closed and consistently oriented.
    pub(super) fn new(triangles: Vec<[u32; 3]>) -> Self {
        let mut edges: Vec<(u32, u32, u32, usize)> = Vec::with_capacity(3 * triangles.len());
        for (triangle, corners) in (0..).zip(&triangles) {
            for k in 0..3 {
                let (from, to) = (corners[k], corners[(k + 1) % 3]);
                edges.push((from.min(to), from.max(to), triangle, k));
            }
        }
        edges.sort_unstable();
        let mut across = vec![[0; 3]; triangles.len()];
        for pair in edges.chunks_exact(2) {
            let [(.., one, one_edge), (.., two, two_edge)] = [pair[0], pair[1]];
            across[one as usize][one_edge] = two;
            across[two as usize][two_edge] = one;
        }
        Self { triangles, across }
    }

    pub(super) fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The two triangles around edge `k` of `triangle`.
    pub(super) fn diamond(&self, triangle: u32, k: usize) -> Diamond {
        let corners = self.triangles[triangle as usize];
        let (right, right_edge) = self.twin(triangle, k);
        Diamond {
            from: corners[k],
            to: corners[(k + 1) % 3],
            apex: corners[(k + 2) % 3],
            opposite: self.triangles[right as usize][(right_edge + 2) % 3],
        }
    }

    /// The other triangle at edge `k` of `triangle` and the number that the edge has there.
    pub(super) fn twin(&self, triangle: u32, k: usize) -> (u32, usize) {
        let right = self.across[triangle as usize][k];
        let start = self.triangles[triangle as usize][(k + 1) % 3];
        let edge = (0..3).find(|&e| self.triangles[right as usize][e] == start);
        (right, edge.expect("neighbours share the edge"))
    }

    /// Replace the edge by the one from apex to opposite. Returns the two changed triangles.
    pub(super) fn flip(&mut self, triangle: u32, k: usize) -> [u32; 2] {
        let Diamond {
            from,
            to,
            apex,
            opposite,
        } = self.diamond(triangle, k);
        let (right, e) = self.twin(triangle, k);
        let left_sides = self.across[triangle as usize];
        let right_sides = self.across[right as usize];
        let (to_apex, apex_from) = (left_sides[(k + 1) % 3], left_sides[(k + 2) % 3]);
        let (from_opposite, opposite_to) = (right_sides[(e + 1) % 3], right_sides[(e + 2) % 3]);
        self.triangles[triangle as usize] = [apex, from, opposite];
        self.across[triangle as usize] = [apex_from, from_opposite, right];
        self.triangles[right as usize] = [opposite, to, apex];
        self.across[right as usize] = [opposite_to, to_apex, triangle];
        self.relink(from_opposite, right, triangle);
        self.relink(to_apex, triangle, right);
        [triangle, right]
    }

    fn relink(&mut self, triangle: u32, old: u32, new: u32) {
        for side in &mut self.across[triangle as usize] {
            if *side == old {
                *side = new;
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flipping_twice_gives_the_same_triangles() {
        let octahedron = vec![
            [0, 1, 2],
            [1, 3, 2],
            [3, 4, 2],
            [4, 0, 2],
            [1, 0, 5],
            [3, 1, 5],
            [4, 3, 5],
            [0, 4, 5],
        ];
        let mut net = Triangulation::new(octahedron.clone());
        let before = net.diamond(0, 0);
        let [one, _] = net.flip(0, 0);
        // The new edge is the last one of both.
        net.flip(one, 2);
        let sorted = |triangles: &[[u32; 3]]| {
            let mut sets: Vec<_> = triangles.to_vec();
            sets.iter_mut().for_each(|t| t.sort_unstable());
            sets.sort_unstable();
            sets
        };
        assert_eq!(sorted(net.triangles()), sorted(&octahedron));
        assert_eq!((before.apex, before.opposite), (2, 5));
    }
}
