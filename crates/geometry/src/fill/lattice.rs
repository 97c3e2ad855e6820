use super::background::{Background, Cut, Place, crossing, find_cut};
use crate::mesh::tetrahedra::six_fold_volume;
use crate::{AabbTree, NodeId, Surface, TetrahedronError, TetrahedronMesh, Vec3};

/// Parts of the length of an edge: a cut nearer to a point than that moves the point. These give
/// the best angles [Labelle and Shewchuk 2007].
const ALPHA_LONG: f64 = 0.24999;
const ALPHA_SHORT: f64 = 0.41189;

/// Points that a lattice may have: the memory of a small computer [-].
pub(super) const MAX_POINTS: f64 = 2e8;

/// Steps from a point to its neighbours, in halves of a cell: six along the axes to its own kind
/// (long edges), eight to the other kind (short edges).
const STEPS: [[i32; 3]; 14] = [
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

/// A point of the lattice in halves of a cell: all even at the corners of cells, all odd at their
/// centres.
type Coordinates = [i32; 3];

/// The lattice with the place of each point, points moved onto the surface, and cuts.
pub(super) struct Lattice {
    cells: [i32; 3],
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
        let mut lattice = Self::around(surface, edge);
        lattice.find_places(surface, tree);
        lattice.find_cuts(surface, tree);
        lattice.warp();
        lattice
    }

    /// All of its tetrahedra as they are before there is a surface.
    ///
    /// # Errors
    /// When there are too many.
    pub(super) fn tetrahedra(
        surface: &Surface,
        edge: f64,
    ) -> Result<TetrahedronMesh, TetrahedronError> {
        let lattice = Self::around(surface, edge);
        let vertices: Vec<_> = lattice.coordinates().map(|at| lattice.rest(at)).collect();
        let mut tetrahedra = Vec::new();
        lattice.visit(&mut |points| {
            let mut corners = points.map(NodeId);
            let positions = points.map(|point| vertices[point as usize]);
            if six_fold_volume(&positions) < 0.0 {
                corners.swap(2, 3);
            }
            tetrahedra.push(corners);
        });
        TetrahedronMesh::new(vertices, tetrahedra)
    }

    /// That covers a surface, before any cut.
    fn around(surface: &Surface, edge: f64) -> Self {
        let (low, high) = surface.mesh().bounds();
        // A cell to spare on each side: the outermost points are outside.
        let cells = [0, 1, 2].map(|k| ((high[k] - low[k]) / edge).ceil() as i32 + 2);
        let size = Vec3::from(cells.map(|n| f64::from(n) * edge));
        Self {
            cells,
            low: 0.5 * (low + high - size),
            half: 0.5 * edge,
            places: Vec::new(),
            moved: Vec::new(),
            cuts: Vec::new(),
        }
    }

    fn number(&self, at: Coordinates) -> u32 {
        let [x, y, z] = at.map(|c| c / 2);
        let odd = at[0] % 2;
        let [along_x, along_y, along_z] = self.cells.map(|n| n + 1 - odd);
        let before = odd * self.corners() as i32;
        debug_assert!(x < along_x && y < along_y && z < along_z);
        (before + (z * along_y + y) * along_x + x) as u32
    }

    fn at(&self, number: u32) -> Coordinates {
        let corners = self.corners() as u32;
        let odd = i32::from(number >= corners);
        let [along_x, along_y, _] = self.cells.map(|n| (n + 1 - odd) as u32);
        let number = number - if odd == 1 { corners } else { 0 };
        let row = number / along_x;
        [number % along_x, row % along_y, row / along_y].map(|c| 2 * c as i32 + odd)
    }

    fn corners(&self) -> usize {
        self.cells.iter().map(|&n| n as usize + 1).product()
    }

    fn rest(&self, at: Coordinates) -> Vec3 {
        self.low + self.half * Vec3::from(at.map(f64::from))
    }

    /// The four tetrahedra between the centres of a cell and of the next one along `axis`: each has
    /// one edge of the face between them.
    fn around_face(&self, cell: [i32; 3], axis: usize) -> [[u32; 4]; 4] {
        let center = cell.map(|c| 2 * c + 1);
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut next = center;
        next[axis] += 2;
        let corner = |along_u: i32, along_v: i32| {
            let mut at = center;
            at[axis] += 1;
            at[u] += along_u;
            at[v] += along_v;
            self.number(at)
        };
        let ring = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
        let [center, next] = [center, next].map(|at| self.number(at));
        [0, 1, 2, 3].map(|k| [center, next, ring[k], ring[(k + 1) % 4]])
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
                place = Place::at(distance, edge);
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

impl Background for Lattice {
    fn points(&self) -> usize {
        self.places.len()
    }

    fn cuts(&self) -> usize {
        self.cuts.len()
    }

    fn place(&self, number: u32) -> Place {
        self.places[number as usize]
    }

    fn position(&self, number: u32) -> Vec3 {
        match self.moved.binary_search_by_key(&number, |m| m.0) {
            Ok(found) => self.moved[found].1,
            Err(_) => self.rest(self.at(number)),
        }
    }

    fn cut(&self, inside: u32, outside: u32) -> Option<(u32, Vec3)> {
        find_cut(&self.cuts, inside, outside)
    }

    fn diagonal_from_first(&self, p: u32, q: u32, n: u32) -> bool {
        let [at_p, q, n] = [p, q, n].map(|point| self.at(point));
        let odd = |at: Coordinates| at[0] % 2;
        if odd(at_p) == odd(q) {
            // Two short edges are cut. The ends of the long one are neighbours of a kind, and one of
            // them is even among its kind.
            at_p.iter().map(|c| c / 2).sum::<i32>() % 2 == 0
        } else {
            // The diagonal ends in the cut of the long edge.
            odd(q) == odd(n)
        }
    }

    fn visit(&self, see: &mut dyn FnMut([u32; 4])) {
        let cells = self.cells;
        for z in 0..cells[2] {
            for y in 0..cells[1] {
                for x in 0..cells[0] {
                    for axis in 0..3 {
                        if [x, y, z][axis] + 1 < cells[axis] {
                            self.around_face([x, y, z], axis)
                                .into_iter()
                                .for_each(&mut *see);
                        }
                    }
                }
            }
        }
    }
}
