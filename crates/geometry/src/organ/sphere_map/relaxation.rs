use super::SphereMap;
use super::triangulation::{Diamond, Triangulation};
use crate::Vec3;

/// How much a triangle counts for more when the surface turns within it. Coarse meshes would lose
/// tips and margins otherwise; it has no effect on fine ones.
const TURN_WEIGHT: f64 = 2.0;

/// Move points along the surface to the middle of their neighbourhoods and flip edges, until
/// triangles are well shaped.
pub(super) fn relax(map: SphereMap, net: &mut Triangulation, units: &mut Vec<Vec3>, rounds: usize) {
    for _ in 0..rounds {
        let places: Vec<Place> = units.iter().map(|unit| Place::new(map, unit)).collect();
        let positions: Vec<Vec3> = places.iter().map(|place| place.position).collect();
        flip_to_delaunay(net, units, &positions);
        let targets = neighborhood_centroids(net, &places);
        let mut moved: Vec<Vec3> = places
            .iter()
            .zip(&targets)
            .map(|(place, target)| place.slide_towards(target))
            .collect();
        undo_reversals(net, units, &mut moved);
        *units = moved;
    }
    let positions: Vec<Vec3> = units.iter().map(map).collect();
    flip_to_delaunay(net, units, &positions);
}

/// A point of the surface and the plane that touches it there.
struct Place {
    unit: Vec3,
    /// Two directions on the sphere, and how the surface point moves along them.
    directions: [Vec3; 2],
    tangents: [Vec3; 2],
    position: Vec3,
    normal: Vec3,
}

impl Place {
    fn new(map: SphereMap, unit: &Vec3) -> Self {
        const STEP: f64 = 1e-5;
        let across = unit.cross(&Vec3::ith(unit.iamin(), 1.0)).normalize();
        let directions = [across, unit.cross(&across)];
        let position = map(unit);
        let tangents =
            directions.map(|direction| (map(&(unit + STEP * direction)) - position) / STEP);
        Self {
            unit: *unit,
            directions,
            tangents,
            position,
            normal: tangents[0].cross(&tangents[1]).normalize(),
        }
    }

    /// The unit vector whose image is nearest to `target`, to first order.
    fn slide_towards(&self, target: &Vec3) -> Vec3 {
        let [one, two] = self.tangents;
        let wanted = target - self.position;
        // Least squares: the normal equations of a 3 × 2 system.
        let (m11, m12, m22) = (one.norm_squared(), one.dot(&two), two.norm_squared());
        let (r1, r2) = (one.dot(&wanted), two.dot(&wanted));
        let determinant = m11 * m22 - m12 * m12;
        let first = (m22 * r1 - m12 * r2) / determinant;
        let second = (m11 * r2 - m12 * r1) / determinant;
        (self.unit + first * self.directions[0] + second * self.directions[1]).normalize()
    }
}

/// Per point, the centroid of the triangles around it.
fn neighborhood_centroids(net: &Triangulation, places: &[Place]) -> Vec<Vec3> {
    let mut sums = vec![(Vec3::zeros(), 0.0); places.len()];
    for corners in net.triangles() {
        let [a, b, c] = corners.map(|i| &places[i as usize]);
        let area = (b.position - a.position)
            .cross(&(c.position - a.position))
            .norm();
        let turn =
            3.0 - (a.normal.dot(&b.normal) + b.normal.dot(&c.normal) + c.normal.dot(&a.normal));
        let weight = area * (1.0 + TURN_WEIGHT * turn);
        let moment = weight / 3.0 * (a.position + b.position + c.position);
        for &corner in corners {
            let sum = &mut sums[corner as usize];
            sum.0 += moment;
            sum.1 += weight;
        }
    }
    sums.into_iter()
        .map(|(moment, weight)| moment / weight)
        .collect()
}

/// Put points back whose move would turn a triangle over on the sphere.
fn undo_reversals(net: &Triangulation, before: &[Vec3], moved: &mut [Vec3]) {
    loop {
        let mut reversed = false;
        for corners in net.triangles() {
            if !is_outward(corners.map(|i| moved[i as usize])) {
                for &corner in corners {
                    reversed |= moved[corner as usize] != before[corner as usize];
                    moved[corner as usize] = before[corner as usize];
                }
            }
        }
        if !reversed {
            return;
        }
    }
}

fn is_outward([a, b, c]: [Vec3; 3]) -> bool {
    a.dot(&b.cross(&c)) > 0.0
}

/// Flip edges until the angles opposite to each add up to less than a half turn.
fn flip_to_delaunay(net: &mut Triangulation, units: &[Vec3], positions: &[Vec3]) {
    let count = net.triangles().len() as u32;
    let mut waiting: Vec<u32> = (0..count).rev().collect();
    // Guarded flips might go in circles; far more than are ever needed is enough.
    let mut left = 10 * count as usize;
    while let Some(triangle) = waiting.pop() {
        for k in 0..3 {
            let diamond = net.diamond(triangle, k);
            if left > 0 && improves(&diamond, positions) && is_allowed(&diamond, units, positions) {
                left -= 1;
                waiting.extend(net.flip(triangle, k));
                break;
            }
        }
    }
}

fn improves(diamond: &Diamond, positions: &[Vec3]) -> bool {
    let [from, to, apex, opposite] = corners(diamond, positions);
    cotangent(apex, from, to) + cotangent(opposite, from, to) < -1e-9
}

/// Whether the flipped triangles lie the right way round on the sphere and do not fold the surface.
fn is_allowed(diamond: &Diamond, units: &[Vec3], positions: &[Vec3]) -> bool {
    let [from, to, apex, opposite] = corners(diamond, units);
    if !is_outward([apex, from, opposite]) || !is_outward([opposite, to, apex]) {
        return false;
    }
    let [from, to, apex, opposite] = corners(diamond, positions);
    let before = fold([from, to, apex], [to, from, opposite]);
    let after = fold([apex, from, opposite], [opposite, to, apex]);
    after > before.min(0.5)
}

fn corners(diamond: &Diamond, points: &[Vec3]) -> [Vec3; 4] {
    [diamond.from, diamond.to, diamond.apex, diamond.opposite].map(|i| points[i as usize])
}

/// Cosine of the angle between the normals of two triangles.
fn fold(one: [Vec3; 3], two: [Vec3; 3]) -> f64 {
    let normal = |[a, b, c]: [Vec3; 3]| (b - a).cross(&(c - a)).normalize();
    normal(one).dot(&normal(two))
}

/// Cotangent of the angle at `at` between the directions to two points.
fn cotangent(at: Vec3, one: Vec3, two: Vec3) -> f64 {
    let (a, b) = (one - at, two - at);
    a.dot(&b) / a.cross(&b).norm()
}
