//! The inside part of a tetrahedron of the background, cut into tetrahedra
//! [Labelle and Shewchuk 2007].
//!
//! Two neighbours share a face, and where the face keeps a quadrilateral both must cut it along the
//! same diagonal. The choice depends on the face alone (`diagonal_from_first`).

use super::background::{Background, Place};
use crate::mesh::tetrahedra::six_fold_volume;
use crate::{NodeId, Vec3};

/// Tetrahedra not yet checked.
pub(super) struct Filling {
    pub(super) vertices: Vec<Vec3>,
    pub(super) tetrahedra: Vec<[NodeId; 4]>,
}

/// A point of the background.
#[derive(Debug, Clone, Copy)]
struct Point {
    number: u32,
    place: Place,
}

struct Stuffer<'a> {
    background: &'a dyn Background,
    /// Number of the vertex that a point became, and that a cut became.
    of_point: Vec<u32>,
    of_cut: Vec<u32>,
    filling: Filling,
}

/// No vertex yet.
const NONE: u32 = u32::MAX;

pub(super) fn fill(background: &dyn Background) -> Filling {
    let mut stuffer = Stuffer {
        background,
        of_point: vec![NONE; background.points()],
        of_cut: vec![NONE; background.cuts()],
        filling: Filling {
            vertices: Vec::new(),
            tetrahedra: Vec::new(),
        },
    };
    background.visit(&mut |points| {
        let points = points.map(|point| stuffer.point(point));
        stuffer.stuff(points);
    });
    stuffer.filling
}

impl Stuffer<'_> {
    fn point(&self, number: u32) -> Point {
        let place = self.background.place(number);
        Point { number, place }
    }

    fn diagonal_from_first(&self, p: &Point, q: &Point, n: &Point) -> bool {
        let [p, q, n] = [p, q, n].map(|point| point.number);
        self.background.diagonal_from_first(p, q, n)
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
                let from_p = self.diagonal_from_first(p, q, n);
                let ends = [self.vertex(*p), self.vertex(*q)];
                let cuts = [self.cut(*p, *n), self.cut(*q, *n)];
                self.pyramid(apex, ends, cuts, from_p);
            }
            ([p, q, r], [n]) => {
                let from = [
                    self.diagonal_from_first(p, q, n),
                    self.diagonal_from_first(q, r, n),
                    self.diagonal_from_first(r, p, n),
                ];
                let top = [p, q, r].map(|p| self.vertex(*p));
                let bottom = [p, q, r].map(|p| self.cut(*p, *n));
                self.prism(top, bottom, from);
            }
            ([p, q], [n, m]) => {
                let (p_to_n, q_to_m) = (
                    self.diagonal_from_first(p, q, n),
                    !self.diagonal_from_first(p, q, m),
                );
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
            let position = self.background.position(point.number);
            self.filling.vertices.push(position);
        }
        NodeId(*known)
    }

    fn cut(&mut self, inside: Point, outside: Point) -> NodeId {
        let (number, position) = self
            .background
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
