use crate::{AabbTree, Surface, Vec3};

/// Parts of the length of an edge: a cut nearer to a point than that moves the point. These give
/// the best angles [Labelle and Shewchuk 2007].
const ALPHA_LONG: f64 = 0.24999;
const ALPHA_SHORT: f64 = 0.41189;

/// Points that a lattice may have: the memory of a small computer [-].
pub(super) const MOST_POINTS: f64 = 2e8;

/// A point nearer to the surface than this part of the edge lies on it [-].
const ON: f64 = 1e-9;

/// Steps from a point to its neighbours, in halves of a cell: six along the axes to its own kind
/// (long edges), eight to the other kind (short edges).
pub(super) const STEPS: [[i32; 3]; 14] = [
    [-2, 0, 0],
    [2, 0, 0],
    [0, -2, 0],
    [0, 2, 0],
    [0, 0, -2],
    [0, 0, 2],
    [-1, -1, -1],
    [1, -1, -1],
    [-1, 1, -1],
    [1, 1, -1],
    [-1, -1, 1],
    [1, -1, 1],
    [-1, 1, 1],
    [1, 1, 1],
];

/// Where a point of the lattice lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    Inside,
    Outside,
    On,
}

/// A point of the lattice in halves of a cell: all even at the corners of cells, all odd at their
/// centres.
pub(super) type Coordinates = [i32; 3];

/// A cut of an edge, from the point inside to the one outside.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Cut {
    ends: [u32; 2],
    position: Vec3,
}

/// The lattice with the place of each point, points moved onto the surface, and cuts.
pub(super) struct Lattice {
    pub(super) cells: [i32; 3],
    low: Vec3,
    half: f64,
    places: Vec<Place>,
    /// Points that moved, by number, in ascending order.
    moved: Vec<(u32, Vec3)>,
    /// In ascending order of their ends.
    cuts: Vec<Cut>,
}

impl Lattice {
    /// About how many points a lattice of this `edge` [m] needs [-].
    pub(super) fn points(surface: &Surface, edge: f64) -> f64 {
        let (low, high) = surface.mesh().bounds();
        2.0 * (high - low).iter().map(|l| l / edge + 3.0).product::<f64>()
    }

    pub(super) fn new(surface: &Surface, tree: &AabbTree, edge: f64) -> Self {
        let (low, high) = surface.mesh().bounds();
        // A cell to spare on each side: the outermost points are outside.
        let cells = [0, 1, 2].map(|k| ((high[k] - low[k]) / edge).ceil() as i32 + 2);
        let size = Vec3::from(cells.map(|n| f64::from(n) * edge));
        let mut lattice = Self {
            cells,
            low: 0.5 * (low + high - size),
            half: 0.5 * edge,
            places: Vec::new(),
            moved: Vec::new(),
            cuts: Vec::new(),
        };
        lattice.find_places(surface, tree);
        lattice.find_cuts(surface, tree);
        lattice.warp();
        lattice
    }

    pub(super) fn number(&self, at: Coordinates) -> u32 {
        let [x, y, z] = at.map(|c| c / 2);
        let odd = at[0] % 2;
        let [along_x, along_y, along_z] = self.cells.map(|n| n + 1 - odd);
        let before = odd * self.corners() as i32;
        debug_assert!(x < along_x && y < along_y && z < along_z);
        (before + (z * along_y + y) * along_x + x) as u32
    }

    fn corners(&self) -> usize {
        self.cells.iter().map(|&n| n as usize + 1).product()
    }

    pub(super) fn len(&self) -> usize {
        self.places.len()
    }

    pub(super) fn place(&self, number: u32) -> Place {
        self.places[number as usize]
    }

    /// Where a point is now [m].
    pub(super) fn position(&self, number: u32, at: Coordinates) -> Vec3 {
        match self.moved.binary_search_by_key(&number, |m| m.0) {
            Ok(found) => self.moved[found].1,
            Err(_) => self.rest(at),
        }
    }

    /// Where the edge between these points is cut [m].
    pub(super) fn cut(&self, inside: u32, outside: u32) -> Option<(u32, Vec3)> {
        let ends = [inside, outside];
        let found = self.cuts.binary_search_by_key(&ends, |cut| cut.ends).ok()?;
        Some((found as u32, self.cuts[found].position))
    }

    pub(super) fn cuts(&self) -> usize {
        self.cuts.len()
    }

    fn rest(&self, at: Coordinates) -> Vec3 {
        self.low + self.half * Vec3::from(at.map(f64::from))
    }

    /// All points in the order of their numbers.
    fn coordinates(&self) -> impl Iterator<Item = Coordinates> + use<> {
        let cells = self.cells;
        [0, 1].into_iter().flat_map(move |odd| {
            let [nx, ny, nz] = cells.map(|n| n + 1 - odd);
            let row = move |z, y| (0..nx).map(move |x| [x, y, z].map(|c| 2 * c + odd));
            (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| row(z, y)))
        })
    }

    fn neighbours(&self, at: Coordinates) -> impl Iterator<Item = (usize, Coordinates)> {
        let highest = self.cells.map(|n| 2 * n);
        STEPS.iter().enumerate().filter_map(move |(which, step)| {
            let there = [0, 1, 2].map(|k| at[k] + step[k]);
            let odd = there[0].rem_euclid(2);
            let within = (0..3).all(|k| there[k] >= odd && there[k] <= highest[k] - odd);
            within.then_some((which, there))
        })
    }

    /// The distance changes by no more than one walks, so that one question answers for all the
    /// points of a row within it.
    fn find_places(&mut self, surface: &Surface, tree: &AabbTree) {
        let edge = 2.0 * self.half;
        let (mut known, mut place) = (0, Place::Outside);
        let mut places = Vec::new();
        for at in self.coordinates() {
            if at[0] < 2 {
                known = 0;
            }
            if known > 0 {
                known -= 1;
            } else {
                let (_, distance) = surface.signed_distance(tree, &self.rest(at));
                place = if distance.abs() <= ON * edge {
                    Place::On
                } else if distance < 0.0 {
                    Place::Inside
                } else {
                    Place::Outside
                };
                known = ((distance.abs() / edge - 1e-6).max(0.0)) as usize;
            }
            places.push(place);
        }
        self.places = places;
    }

    fn find_cuts(&mut self, surface: &Surface, tree: &AabbTree) {
        let mut cuts = Vec::new();
        for (inside, at) in self.coordinates().enumerate() {
            if self.places[inside] != Place::Inside {
                continue;
            }
            for (_, there) in self.neighbours(at) {
                let outside = self.number(there);
                if self.place(outside) == Place::Outside {
                    let (from, to) = (self.rest(at), self.rest(there));
                    cuts.push(Cut {
                        ends: [inside as u32, outside],
                        position: crossing(surface, tree, from, to),
                    });
                }
            }
        }
        cuts.sort_unstable_by_key(|cut| cut.ends);
        self.cuts = cuts;
    }

    /// Moves each point that a cut comes too near to. The cuts of its edges are then no more.
    fn warp(&mut self) {
        let [long, short] = [2.0 * ALPHA_LONG, 3f64.sqrt() * ALPHA_SHORT].map(|l| l * self.half);
        for (number, at) in self.coordinates().enumerate() {
            let number = number as u32;
            let place = self.place(number);
            if place == Place::On {
                continue;
            }
            let here = self.rest(at);
            let mut nearest: Option<(f64, Vec3)> = None;
            for (which, there) in self.neighbours(at) {
                let other = self.number(there);
                let cut = match (place, self.place(other)) {
                    (Place::Inside, Place::Outside) => self.cut(number, other),
                    (Place::Outside, Place::Inside) => self.cut(other, number),
                    _ => None,
                };
                let Some((_, position)) = cut else { continue };
                let distance = (position - here).norm();
                let reach = if which < 6 { long } else { short };
                if distance < reach && nearest.is_none_or(|(least, _)| distance < least) {
                    nearest = Some((distance, position));
                }
            }
            if let Some((_, position)) = nearest {
                self.places[number as usize] = Place::On;
                self.moved.push((number, position));
            }
        }
    }
}

/// Where the way from inside to outside leaves the body first. A ray may slip through a gap of
/// rounding; then halving finds a change of sign.
fn crossing(surface: &Surface, tree: &AabbTree, from: Vec3, to: Vec3) -> Vec3 {
    let way = to - from;
    let length = way.norm();
    let hit = tree.cast(surface.mesh(), &from, &(way / length), length);
    if let Some(hit) = hit {
        return from + way * (hit.distance / length);
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if surface.signed_distance(tree, &(from + way * middle)).1 < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    from + way * (0.5 * (low + high))
}
