use super::crossing::{Blade, Crossing};
use super::net::{Corner, Mark, Side};
use super::{CutMethod, CutSurface, snap, split};
use crate::{NodeId, Surface, TriangleId, Vec3};

/// A blade that is lifted or turns so near to the last vertex leaves no other there, in units of the
/// shortest part [-]: the edge between the two would not point along the blade's way.
const MIN_LEAD: f64 = 3.0;

/// A blade that turns by more than this within a triangle gets a vertex where it turns [rad].
const TURN: f64 = 0.35;

/// A cut in progress.
#[derive(Debug, Clone, Copy)]
pub(super) struct CutPath {
    pub(super) blade: Blade,
    /// The vertex before the last one, while the edge between the two is not yet opened.
    pub(super) pending: Option<NodeId>,
    pub(super) opened: usize,
    pub(super) before: Mark,
}

impl CutPath {
    /// Triangles from the end of the opening to the blade, which is always in one around the last
    /// vertex.
    pub(super) fn lag(&self) -> usize {
        usize::from(self.blade.inside.is_some()) + usize::from(self.pending.is_some())
    }
}

impl CutSurface {
    /// The first vertex of a cut, and the blade at it or near it.
    pub(super) fn first_vertex(
        &mut self,
        surface: &Surface,
        triangle: TriangleId,
        at: &Vec3,
    ) -> Blade {
        let corners = self.net.mesh.positions(triangle);
        let mut nearest = 0;
        for place in 1..3 {
            if (corners[place] - at).norm() < (corners[nearest] - at).norm() {
                nearest = place;
            }
        }
        let nearest = Corner {
            triangle,
            place: nearest,
        };
        let made = match self.method {
            CutMethod::SnapVertices => (self.net.openings_at(nearest) == 0
                && snap::snap(&mut self.net, surface, nearest, at))
            .then_some(nearest),
            CutMethod::SplitTriangles => {
                split::insert(&mut self.net, surface, triangle, at, &self.limits)
            }
        };
        let mut blade = Blade {
            front: made.unwrap_or(nearest),
            inside: None,
        };
        if made.is_none() {
            blade.rest(&self.net, at);
        }
        blade
    }

    /// Moves the blade over the next edge of its path. Returns whether the path continues.
    pub(super) fn pass(&mut self, surface: &Surface, cut_path: &mut CutPath, to: &Vec3) -> bool {
        let blade = &mut cut_path.blade;
        let Some(crossing) = blade.crossing(&self.net, to) else {
            return false;
        };
        let from = blade.position(&self.net);
        blade.front = crossing.front;
        if crossing.way >= 1.0 {
            let place = from + (crossing.at - from) / crossing.way;
            blade.rest(&self.net, &place);
            return false;
        }
        if !crossing.leaves_star() {
            blade.front = if crossing.edge == crossing.front.place {
                self.net.previous(crossing.front)
            } else {
                self.net.next(crossing.front)
            };
            blade.rest(&self.net, &crossing.at);
            return true;
        }
        let Some(next) = self.next_vertex(surface, cut_path.pending, &crossing, to) else {
            cut_path.blade.rest(&self.net, &crossing.at);
            return false;
        };
        self.extend(cut_path, next);
        true
    }

    /// The vertex through which a cut goes on where the blade crosses an edge.
    fn next_vertex(
        &mut self,
        surface: &Surface,
        pending: Option<NodeId>,
        crossing: &Crossing,
        to: &Vec3,
    ) -> Option<Corner> {
        let (triangle, edge) = (crossing.front.triangle, crossing.edge);
        let ends = [edge, (edge + 1) % 3].map(|place| Corner { triangle, place });
        let ends = if crossing.part <= 0.5 {
            ends
        } else {
            [ends[1], ends[0]]
        };
        let net = &mut self.net;
        let made = match self.method {
            CutMethod::SnapVertices => ends.into_iter().find(|&end| {
                let free = net.openings_at(end) == 0 && pending != Some(net.node_at(end));
                free && snap::snap(net, surface, end, &crossing.at)
            }),
            CutMethod::SplitTriangles => {
                let (part, limits) = (crossing.part, &self.limits);
                if split::is_near_end(net, triangle, edge, part, limits) {
                    None
                } else {
                    split::split_edge(net, surface, triangle, edge, part, limits)
                }
            }
        };
        let gap = (net.position(crossing.front) - to).norm();
        made.or_else(|| {
            ends.into_iter()
                .find(|&end| (net.position(end) - to).norm() < gap)
        })
    }

    /// A vertex where the blade is lifted.
    pub(super) fn finish(&mut self, surface: &Surface, cut_path: &mut CutPath) {
        let (CutMethod::SplitTriangles, Some(place)) = (self.method, cut_path.blade.inside) else {
            return;
        };
        let front = cut_path.blade.front;
        let lead = (place - self.net.position(front)).norm();
        if lead > MIN_LEAD * self.limits.edge || self.meets_opening(front, &place) {
            self.lead_to(surface, cut_path, &place);
        }
    }

    /// Whether an opening other than that of `front` has a vertex at a point of the triangle [m].
    fn meets_opening(&self, front: Corner, place: &Vec3) -> bool {
        let triangle = front.triangle;
        let corners = (0..3).map(|place| Corner { triangle, place });
        corners.filter(|&corner| corner != front).any(|corner| {
            let off = (self.net.position(corner) - place).norm();
            off < self.limits.edge && self.net.openings_at(corner) > 0
        })
    }

    /// A vertex where the blade is, when it turns there.
    pub(super) fn turn(&mut self, surface: &Surface, cut_path: &mut CutPath, to: &Vec3) {
        let (CutMethod::SplitTriangles, Some(place)) = (self.method, cut_path.blade.inside) else {
            return;
        };
        let (come, goes) = (place - self.net.position(cut_path.blade.front), to - place);
        if come.norm() > MIN_LEAD * self.limits.edge && come.angle(&goes) > TURN {
            self.lead_to(surface, cut_path, &place);
        }
    }

    /// Leads the cut to a point [m] of the triangle in which the blade is, if a vertex can be had there.
    fn lead_to(&mut self, surface: &Surface, cut_path: &mut CutPath, place: &Vec3) {
        let front = cut_path.blade.front;
        let last = self.net.node_at(front);
        let made = split::insert(&mut self.net, surface, front.triangle, place, &self.limits);
        let Some(made) = made.filter(|&made| self.net.node_at(made) != last) else {
            return;
        };
        let next = self
            .net
            .around(made)
            .find(|next| self.net.mesh.corners(next.triangle).contains(&last))
            .expect("a vertex in a triangle around the last one is its neighbour");
        let corners = self.net.mesh.corners(next.triangle);
        let place = corners.iter().position(|&corner| corner == last);
        cut_path.blade.front = Corner {
            triangle: next.triangle,
            place: place.expect("the triangle was found by this corner"),
        };
        self.extend(cut_path, next);
    }

    /// Opens the edge from the last vertex to the next, which is a corner of the same triangle, and
    /// puts the blade there. The first edge of a slit stays pending until the second: opened alone
    /// it would leave both sides with the same two vertices.
    fn extend(&mut self, cut_path: &mut CutPath, next: Corner) {
        let front = cut_path.blade.front;
        cut_path.blade = Blade {
            front: next,
            inside: None,
        };
        let (edge, side) = if next.place == (front.place + 1) % 3 {
            (front.place, Side::Left)
        } else {
            (next.place, Side::Right)
        };
        let (from, to) = (self.net.node_at(front), self.net.node_at(next));
        let returns = cut_path.pending == Some(to);
        if returns {
            cut_path.pending = Some(from);
        }
        if returns || self.net.facet(front.triangle).open[edge].is_some() {
            return;
        }
        if let Some(start) = cut_path.pending.take() {
            let spoke = self.net.around(front).find(|corner| {
                self.net.mesh.corners(corner.triangle)[(corner.place + 1) % 3] == start
            });
            if let Some(corner) = spoke {
                self.net.open(corner.triangle, corner.place, Side::Right);
                cut_path.opened += 1;
            }
        }
        if self.net.openings_at(front) == 0 && self.net.openings_at(next) == 0 {
            cut_path.pending = Some(from);
            return;
        }
        self.net.open(front.triangle, edge, side);
        cut_path.opened += 1;
    }
}
