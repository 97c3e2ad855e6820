//! What a tetrahedron of the lattice keeps inside, cut into tetrahedra
//! [Labelle and Shewchuk 2007].
//!
//! Two neighbours share a face, and where the face keeps a quadrilateral both must cut it along the
//! same diagonal. It is chosen by what the face alone knows (`diagonal_from_first`).

use super::lattice::{Coordinates, Lattice, Place};
use crate::mesh::tetrahedra::six_fold_volume;
use crate::{NodeId, Vec3};

/// Tetrahedra not yet checked.
pub(super) struct Filling {
    pub(super) vertices: Vec<Vec3>,
    pub(super) tetrahedra: Vec<[NodeId; 4]>,
}

/// A point of the lattice.
#[derive(Debug, Clone, Copy)]
struct Point {
    number: u32,
    at: Coordinates,
    place: Place,
}

struct Stuffer<'a> {
    lattice: &'a Lattice,
    /// Number of the vertex that a lattice point became, and that a cut became.
    of_point: Vec<u32>,
    of_cut: Vec<u32>,
    filling: Filling,
}

/// No vertex yet.
const NONE: u32 = u32::MAX;

pub(super) fn fill(lattice: &Lattice) -> Filling {
    let mut stuffer = Stuffer {
        lattice,
        of_point: vec![NONE; lattice.len()],
        of_cut: vec![NONE; lattice.cuts()],
        filling: Filling {
            vertices: Vec::new(),
            tetrahedra: Vec::new(),
        },
    };
    let cells = lattice.cells;
    for z in 0..cells[2] {
        for y in 0..cells[1] {
            for x in 0..cells[0] {
                for axis in 0..3 {
                    if [x, y, z][axis] + 1 < cells[axis] {
                        stuffer.around_face([x, y, z], axis);
                    }
                }
            }
        }
    }
    stuffer.filling
}

impl Stuffer<'_> {
    /// The four tetrahedra between the centres of a cell and of the next one along `axis`: each has
    /// one edge of the face between them.
    fn around_face(&mut self, cell: [i32; 3], axis: usize) {
        let center = cell.map(|c| 2 * c + 1);
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut next = center;
        next[axis] += 2;
        let corner = |along_u: i32, along_v: i32| {
            let mut at = center;
            at[axis] += 1;
            at[u] += along_u;
            at[v] += along_v;
            at
        };
        let ring = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
        let [center, next] = [center, next].map(|at| self.point(at));
        let ring = ring.map(|at| self.point(at));
        for k in 0..4 {
            self.stuff([center, next, ring[k], ring[(k + 1) % 4]]);
        }
    }

    fn point(&self, at: Coordinates) -> Point {
        let number = self.lattice.number(at);
        let place = self.lattice.place(number);
        Point { number, at, place }
    }

    fn stuff(&mut self, points: [Point; 4]) {
        let of = |place| points.iter().copied().filter(move |p| p.place == place);
        let inside: Vec<_> = of(Place::Inside).collect();
        let outside: Vec<_> = of(Place::Outside).collect();
        match (&inside[..], &outside[..]) {
            ([], _) => {}
            (_, []) => {
                let corners = points.map(|p| self.vertex(p));
                self.add(corners);
            }
            ([p], _) => {
                let corners = points.map(|other| match other.place {
                    Place::Outside => self.cut(*p, other),
                    Place::Inside | Place::On => self.vertex(other),
                });
                self.add(corners);
            }
            ([p, q], [n]) => {
                let apex = points.iter().copied().find(|p| p.place == Place::On);
                let Some(apex) = apex.map(|apex| self.vertex(apex)) else {
                    return;
                };
                let from_p = diagonal_from_first(p, q, n);
                let ends = [self.vertex(*p), self.vertex(*q)];
                let cuts = [self.cut(*p, *n), self.cut(*q, *n)];
                self.pyramid(apex, ends, cuts, from_p);
            }
            ([p, q, r], [n]) => {
                let from = [
                    diagonal_from_first(p, q, n),
                    diagonal_from_first(q, r, n),
                    diagonal_from_first(r, p, n),
                ];
                let top = [p, q, r].map(|p| self.vertex(*p));
                let bottom = [p, q, r].map(|p| self.cut(*p, *n));
                self.prism(top, bottom, from);
            }
            ([p, q], [n, m]) => {
                let (p_to_n, q_to_m) =
                    (diagonal_from_first(p, q, n), !diagonal_from_first(p, q, m));
                let one = [self.vertex(*p), self.cut(*p, *n), self.cut(*p, *m)];
                let other = [self.vertex(*q), self.cut(*q, *n), self.cut(*q, *m)];
                // The third diagonal lies on the boundary and is free, but three that follow each
                // other around leave no tetrahedra.
                let free = if p_to_n == q_to_m {
                    !p_to_n
                } else {
                    self.length(one[1], other[2]) <= self.length(one[2], other[1])
                };
                self.prism(one, other, [p_to_n, free, q_to_m]);
            }
            _ => {}
        }
    }

    /// A pyramid over the quadrilateral `ends[0], ends[1], cuts[1], cuts[0]`.
    fn pyramid(&mut self, apex: NodeId, ends: [NodeId; 2], cuts: [NodeId; 2], from_first: bool) {
        if from_first {
            self.add([apex, ends[0], ends[1], cuts[1]]);
            self.add([apex, ends[0], cuts[1], cuts[0]]);
        } else {
            self.add([apex, ends[0], ends[1], cuts[0]]);
            self.add([apex, ends[1], cuts[1], cuts[0]]);
        }
    }

    /// A prism with sides `k` between corners k and k + 1; `from[k]`: whether the diagonal of the
    /// side runs from `top[k]` to `bottom[k + 1]`, else from `top[k + 1]` to `bottom[k]`.
    fn prism(&mut self, top: [NodeId; 3], bottom: [NodeId; 3], from: [bool; 3]) {
        let two_meet_at = (0..3).find(|&k| from[k] && !from[(k + 2) % 3]);
        let Some(k) = two_meet_at else { return };
        let (next, last) = ((k + 1) % 3, (k + 2) % 3);
        self.add([top[k], bottom[0], bottom[1], bottom[2]]);
        let ends = [top[next], top[last]];
        let cuts = [bottom[next], bottom[last]];
        self.pyramid(top[k], ends, cuts, from[next]);
    }

    fn vertex(&mut self, point: Point) -> NodeId {
        let known = &mut self.of_point[point.number as usize];
        if *known == NONE {
            *known = self.filling.vertices.len() as u32;
            let position = self.lattice.position(point.number, point.at);
            self.filling.vertices.push(position);
        }
        NodeId(*known)
    }

    fn cut(&mut self, inside: Point, outside: Point) -> NodeId {
        let (number, position) = self
            .lattice
            .cut(inside.number, outside.number)
            .expect("every edge from inside to outside was cut");
        let known = &mut self.of_cut[number as usize];
        if *known == NONE {
            *known = self.filling.vertices.len() as u32;
            self.filling.vertices.push(position);
        }
        NodeId(*known)
    }

    fn length(&self, from: NodeId, to: NodeId) -> f64 {
        let vertices = &self.filling.vertices;
        (vertices[from.index()] - vertices[to.index()]).norm()
    }

    fn add(&mut self, mut corners: [NodeId; 4]) {
        let positions = corners.map(|node| self.filling.vertices[node.index()]);
        if six_fold_volume(&positions) < 0.0 {
            corners.swap(2, 3);
        }
        self.filling.tetrahedra.push(corners);
    }
}

/// Whether the quadrilateral that the face p, q, n keeps (n being outside) is cut from p to the cut
/// of q, rather than from q to the cut of p.
fn diagonal_from_first(p: &Point, q: &Point, n: &Point) -> bool {
    let odd = |point: &Point| point.at[0] % 2;
    if odd(p) == odd(q) {
        // Two short edges are cut. The ends of the long one are neighbours of a kind, and one of
        // them is even among its kind.
        p.at.iter().map(|c| c / 2).sum::<i32>() % 2 == 0
    } else {
        // The diagonal ends in the cut of the long edge.
        odd(q) == odd(n)
    }
}
