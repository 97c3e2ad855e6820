use super::net::{Corner, Net};
use crate::proximity::{PointOnTriangle, closest_on_triangle};
use crate::{Surface, TriangleId, Vec3};

/// A blade inside a triangle keeps this weight of each corner at least [-], so that the edge where
/// it leaves is always well defined.
const INSIDE: f64 = 1e-6;

/// A blade and the last vertex of its cut. While the blade is inside a triangle, that is one of those
/// around the vertex, and `front` names it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blade {
    pub(super) front: Corner,
    /// Its position [m]; at `front` when none.
    pub(super) inside: Option<Vec3>,
}

/// The point where the path of a blade leaves a triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossing {
    /// The last vertex of the cut, from the triangle that is left.
    pub(super) front: Corner,
    /// The edge that is crossed, from right to left.
    pub(super) edge: usize,
    /// How far along that edge [-].
    pub(super) part: f64,
    /// The place [m].
    pub(super) at: Vec3,
    /// The way to there, in units of the way to the goal [-].
    pub(super) way: f64,
}

impl Crossing {
    /// Whether the edge is opposite to the last vertex.
    pub(super) fn leaves_star(&self) -> bool {
        self.edge == (self.front.place + 1) % 3
    }
}

/// Where the surface bends away under a plane through blade, goal and normal.
struct Section {
    from: Vec3,
    right: Vec3,
    along: Vec3,
    goal: f64,
}

impl Blade {
    pub(super) fn position(&self, net: &Net) -> Vec3 {
        self.inside.unwrap_or_else(|| net.position(self.front))
    }

    /// The edge over which the blade leaves its triangle towards `goal` [m], if there is a way.
    pub(super) fn crossing(&self, net: &Net, goal: &Vec3) -> Option<Crossing> {
        let section = self.section(net, goal)?;
        if self.inside.is_some() {
            return (0..3).find_map(|edge| section.crossing(net, self.front, edge));
        }
        net.around(self.front)
            .filter_map(|front| section.crossing(net, front, (front.place + 1) % 3))
            .filter(|crossing| crossing.way > 0.0)
            .max_by(|one, other| one.way.total_cmp(&other.way))
    }

    fn section(&self, net: &Net, goal: &Vec3) -> Option<Section> {
        let from = self.position(net);
        let unit = |front: Corner| {
            let area = net.mesh.area_vector(front.triangle);
            area.try_normalize(0.0).unwrap_or_default()
        };
        let normal = match self.inside {
            Some(_) => unit(self.front),
            None => net.around(self.front).map(unit).sum::<Vec3>(),
        };
        let normal = normal.try_normalize(0.0)?;
        let way = goal - from;
        let tangent = way - normal * normal.dot(&way);
        let along = tangent.try_normalize(0.0)?;
        Some(Section {
            from,
            right: along.cross(&normal),
            along,
            goal: tangent.norm(),
        })
    }

    /// Moves the blade to `place` [m] inside the triangle of its front.
    pub(super) fn rest(&mut self, net: &Net, place: &Vec3) {
        let corners = net.mesh.positions(self.front.triangle);
        let weights = closest_on_triangle(&corners, place).barycentric;
        let weights = weights.map(|weight| weight.max(INSIDE));
        let sum: f64 = weights.iter().sum();
        self.inside = Some(
            (corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2]) / sum,
        );
    }
}

impl Section {
    /// The crossing of an edge from right to left: the way out of a counter-clockwise triangle. What
    /// lies in the plane counts as right, for all triangles alike.
    fn crossing(&self, net: &Net, front: Corner, edge: usize) -> Option<Crossing> {
        let corners = net.mesh.positions(front.triangle);
        let (start, end) = (corners[edge], corners[(edge + 1) % 3]);
        let [a, b] = [start, end].map(|p| (p - self.from).dot(&self.right));
        if a < 0.0 || b >= 0.0 {
            return None;
        }
        let part = a / (a - b);
        let at = start + part * (end - start);
        let way = (at - self.from).dot(&self.along) / self.goal;
        way.is_finite().then_some(Crossing {
            front,
            edge,
            part,
            at,
            way,
        })
    }
}

/// The nearest point of the cut mesh, downhill from triangle to triangle.
pub(super) fn nearest_of_net(
    net: &Net,
    start: TriangleId,
    point: &Vec3,
) -> (TriangleId, PointOnTriangle) {
    descend(
        start,
        point,
        |triangle| net.mesh.positions(triangle),
        |triangle| {
            let corners = [0, 1, 2].map(|place| Corner { triangle, place });
            let fans = corners.into_iter().flat_map(|corner| net.around(corner));
            fans.map(|corner| corner.triangle)
        },
    )
}

/// The nearest point of the surface, downhill from triangle to triangle.
pub(super) fn nearest_of_surface(
    surface: &Surface,
    start: TriangleId,
    point: &Vec3,
) -> (TriangleId, PointOnTriangle) {
    let mesh = surface.mesh();
    descend(
        start,
        point,
        |triangle| mesh.positions(triangle),
        |triangle| {
            let corners = mesh.corners(triangle).into_iter();
            corners.flat_map(|node| surface.adjacency().around(node).iter().copied())
        },
    )
}

fn descend<Neighbors: Iterator<Item = TriangleId>>(
    start: TriangleId,
    point: &Vec3,
    positions: impl Fn(TriangleId) -> [Vec3; 3],
    neighbors: impl Fn(TriangleId) -> Neighbors,
) -> (TriangleId, PointOnTriangle) {
    let on = |triangle| closest_on_triangle(&positions(triangle), point);
    let mut best = (start, on(start));
    let mut distance = (best.1.position - point).norm();
    loop {
        let here = best.0;
        for other in neighbors(here) {
            let candidate = on(other);
            let reached = (candidate.position - point).norm();
            if reached < distance * (1.0 - 1e-12) {
                distance = reached;
                best = (other, candidate);
            }
        }
        if best.0 == here {
            return best;
        }
    }
}
