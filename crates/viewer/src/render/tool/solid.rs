use std::collections::BTreeMap;

use palpate_geometry::Vec3;

/// Two sides have an edge between them when the cosine between their normals is less: 37°.
const EDGE: f64 = 0.8;

/// Places that are nearer to one another than this are the same [m].
const SAME: f64 = 1e-7;

/// A body of flat pieces, which are seen as round where they meet at small angles.
#[derive(Debug, Clone, Default)]
pub(super) struct Solid {
    triangles: Vec<[Vec3; 3]>,
}

impl Solid {
    /// The skin between `rings` of as many points each, which run counter-clockwise about the way from ring
    /// to ring; with a lid on both ends.
    pub(super) fn skin(rings: &[Vec<Vec3>]) -> Self {
        let mut solid = Self::default();
        solid.add_skin(rings);
        if let [first, .., last] = rings {
            solid.add_lid(first, true);
            solid.add_lid(last, false);
        }
        solid
    }

    /// The skin of `rings` of which the last is followed by the first.
    pub(super) fn loop_of(rings: &[Vec<Vec3>]) -> Self {
        let mut solid = Self::default();
        solid.add_skin(rings);
        if let [first, .., last] = rings {
            solid.add_skin(&[last.clone(), first.clone()]);
        }
        solid
    }

    /// A disc of `radius` [m] about an axis along y, from `low` to `high` there [m].
    pub(super) fn disc(center: Vec3, radius: f64, low: f64, high: f64) -> Self {
        const AROUND: usize = 28;
        let ring = |y: f64| -> Vec<Vec3> {
            let angles = (0..AROUND).map(|k| std::f64::consts::TAU * k as f64 / AROUND as f64);
            angles
                .map(|angle| center + Vec3::new(radius * angle.sin(), y, radius * angle.cos()))
                .collect()
        };
        Self::skin(&[ring(low), ring(high)])
    }

    /// This and `other`, which may pass through one another.
    pub(super) fn with(mut self, other: Self) -> Self {
        self.triangles.extend(other.triangles);
        self
    }

    /// The same on the other side of x = 0 and, with the hinge's half that it has there, of y = 0.
    pub(super) fn turned_over(mut self) -> Self {
        for corner in self.triangles.iter_mut().flatten() {
            corner.x = -corner.x;
            corner.y = -corner.y;
        }
        self
    }

    fn add_skin(&mut self, rings: &[Vec<Vec3>]) {
        for pair in rings.windows(2) {
            let (low, high) = (&pair[0], &pair[1]);
            let count = low.len();
            for k in 0..count {
                let next = (k + 1) % count;
                self.add([low[k], low[next], high[k]]);
                self.add([high[k], low[next], high[next]]);
            }
        }
    }

    /// Closes a ring, which need not be convex but is seen whole from its middle.
    fn add_lid(&mut self, ring: &[Vec3], is_first: bool) {
        let middle = ring.iter().sum::<Vec3>() / ring.len() as f64;
        for k in 0..ring.len() {
            let (here, next) = (ring[k], ring[(k + 1) % ring.len()]);
            self.add(match is_first {
                true => [middle, next, here],
                false => [middle, here, next],
            });
        }
    }

    fn add(&mut self, corners: [Vec3; 3]) {
        let [a, b, c] = corners;
        // Rings that end in a point leave triangles without area.
        if (b - a).cross(&(c - a)).norm() > 1e-16 {
            self.triangles.push(corners);
        }
    }

    /// Position and normal of three corners of each triangle.
    pub(super) fn corners(&self) -> Vec<[f32; 6]> {
        let key = |place: &Vec3| -> [i64; 3] { place.map(|c| (c / SAME).round() as i64).into() };
        let area = |[a, b, c]: &[Vec3; 3]| (b - a).cross(&(c - a));
        let mut around: BTreeMap<[i64; 3], Vec<Vec3>> = BTreeMap::new();
        for triangle in &self.triangles {
            for corner in triangle {
                around.entry(key(corner)).or_default().push(area(triangle));
            }
        }
        let mut corners = Vec::with_capacity(3 * self.triangles.len());
        for triangle in &self.triangles {
            let own = area(triangle).normalize();
            for corner in triangle {
                let sides = around[&key(corner)].iter();
                let round = sides.filter(|side| side.normalize().dot(&own) > EDGE);
                let normal = round.sum::<Vec3>().normalize();
                corners.push(
                    [corner.x, corner.y, corner.z, normal.x, normal.y, normal.z].map(|c| c as f32),
                );
            }
        }
        corners
    }
}
