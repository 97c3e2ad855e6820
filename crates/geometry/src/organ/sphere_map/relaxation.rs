use super::SphereMap;
use super::triangulation::{Diamond, Triangulation};
use crate::Vec3;

/// Move points along the surface to the middle of their neighbourhoods and flip edges, until
/// triangles are well shaped.
pub(super) fn relax(map: SphereMap, net: &mut Triangulation, units: &mut Vec<Vec3>, rounds: usize) {
    let mut positions: Vec<Vec3> = units.iter().map(map).collect();
    flip_to_delaunay(net, units, &positions);
    for _ in 0..rounds {
        let targets = neighborhood_centroids(net, &positions);
        let mut moved: Vec<Vec3> = units
            .iter()
            .zip(&positions)
            .zip(&targets)
            .map(|((unit, position), target)| slide(map, unit, position, target))
            .collect();
        undo_reversals(net, units, &mut moved);
        *units = moved;
        positions = units.iter().map(map).collect();
        flip_to_delaunay(net, units, &positions);
    }
}

/// Per point, the centroid of the triangles around it.
fn neighborhood_centroids(net: &Triangulation, positions: &[Vec3]) -> Vec<Vec3> {
    let mut sums = vec![(Vec3::zeros(), 0.0); positions.len()];
    for corners in net.triangles() {
        let [a, b, c] = corners.map(|i| positions[i as usize]);
        let area = (b - a).cross(&(c - a)).norm();
        let moment = area / 3.0 * (a + b + c);
        for &corner in corners {
            let sum = &mut sums[corner as usize];
            sum.0 += moment;
            sum.1 += area;
        }
    }
    sums.into_iter()
        .map(|(moment, area)| moment / area)
        .collect()
}

/// The unit vector whose image is nearest to `target`, to first order.
fn slide(map: SphereMap, unit: &Vec3, position: &Vec3, target: &Vec3) -> Vec3 {
    const STEP: f64 = 1e-5;
    let across = unit.cross(&Vec3::ith(unit.iamin(), 1.0)).normalize();
    let along = unit.cross(&across);
    let by_across = (map(&(unit + STEP * across)) - position) / STEP;
    let by_along = (map(&(unit + STEP * along)) - position) / STEP;
    let wanted = target - position;
    // Least squares: the normal equations of a 3 × 2 system.
    let (m00, m01, m11) = (
        by_across.norm_squared(),
        by_across.dot(&by_along),
        by_along.norm_squared(),
    );
    let (r0, r1) = (by_across.dot(&wanted), by_along.dot(&wanted));
    let determinant = m00 * m11 - m01 * m01;
    let first = (m11 * r0 - m01 * r1) / determinant;
    let second = (m00 * r1 - m01 * r0) / determinant;
    (unit + first * across + second * along).normalize()
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
