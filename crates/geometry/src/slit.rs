//! Slits in tetrahedra: their sides are faces, so that elements transmit no force across.
//!
//! The sheet below a path over the surface crosses edges. A vertex that is close to it moves onto it; the other edges that
//! cross it are split there, and after them, within the sheet, those that cross its ends and its floor. Then the faces of
//! the sheet separate.
//!
//! *How we know*: `slit::…`.
//!
//! *Limits*: a slit that branches off another ends at it. Vertices at the front of a sheet stay whole, so that a slit which
//! is to go through a wall has to be deeper than that.

mod net;
mod sheet;

use std::collections::{BTreeMap, BTreeSet, HashSet};

use crate::mesh::tetrahedra::pieces;
use crate::refine::{FLAT, SWEEPS, dihedral_quality, open_around};
use crate::{TetrahedronError, TetrahedronMesh, Vec3};
use net::{Boundary, Edge, Net, face_without};
use sheet::{Limit, Sheet, SheetCoordinates};

/// A vertex closer to the sheet than this part of an edge that crosses it moves onto it, if that leaves no flat tetrahedron [-];
/// where it cannot move, the slit goes through it if it is closer than the other part.
const SNAP: f64 = 0.5;
const BEND: f64 = 0.2;

/// The same of the limits of the sheet, in parts of an edge, and of the slit's depth or length if that is less [-].
const SNAP_OF_LIMIT: f64 = 0.45;

/// Vertices closer to the sheet than this are on it [m].
const ON: f64 = 1e-9;

/// Rounds that find where an edge crosses: to 1e-12 of its length.
const ROUNDS: usize = 40;

/// What changes by more of an edge's length between two places that are as close has no zero there [-].
const LEAP: f64 = 1e-3;

/// The sheet goes beyond the surface by this part of the longest edge around [-].
const ABOVE: f64 = 0.5;

/// A point of the path of a slit over the surface of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlitPoint {
    /// Its position [m].
    pub place: Vec3,
    /// Unit outward normal of the surface [-].
    pub normal: Vec3,
    /// Depth of the slit there [m].
    pub depth: f64,
}

/// Tetrahedra that are slit.
#[derive(Clone)]
pub struct SlitTetrahedra {
    net: Net,
}

/// Data of a slit that is being opened, per vertex.
struct Slit<'a> {
    sheet: &'a Sheet,
    /// Coordinates of the vertices near the sheet.
    at: BTreeMap<u32, SheetCoordinates>,
    /// Those on it.
    on: BTreeSet<u32>,
    /// Those on each limit of it.
    on_limit: [BTreeSet<u32>; 3],
}

const LIMITS: [Limit; 3] = [Limit::Start, Limit::End, Limit::Floor];

impl SlitTetrahedra {
    /// The body `mesh`, whole.
    pub fn new(mesh: &TetrahedronMesh) -> Self {
        Self {
            net: Net::new(mesh),
        }
    }

    /// Opens a slit below `path`. Returns its area [m²], which is less than the sheet's where the path turns within the length of
    /// an edge, as at a rim, and zero outside the body.
    pub fn open(&mut self, path: &[SlitPoint]) -> f64 {
        let net = &mut self.net;
        let longest = net.longest_edge_around(path);
        let path = net.onto_boundary(path);
        let Some(sheet) = Sheet::new(&path, ABOVE * longest) else {
            return 0.0;
        };
        let mut slit = Slit::new(&sheet, net, longest);
        slit.snap(net);
        slit.cross(net);
        for limit in 0..LIMITS.len() {
            slit.bound(net, limit);
        }
        slit.free_front(net);
        slit.relax(net);
        let faces = slit.faces(net);
        let before = net.boundary().area;
        net.part(&faces);
        0.5 * (net.boundary().area - before)
    }

    /// Whether every face-connected piece has a vertex [m] on its boundary for which `holds` is true.
    pub fn is_fixed(&self, holds: impl Fn(&Vec3) -> bool) -> bool {
        let tetrahedra = self.net.corners();
        let boundary = self.net.boundary();
        let vertices = self.net.split.vertices.iter().zip(&boundary.normals);
        let fixed: Vec<bool> = vertices
            .map(|(place, normals)| !normals.is_empty() && holds(place))
            .collect();
        let pieces = pieces(&tetrahedra);
        let mut is_held = vec![false; pieces.iter().max().map_or(0, |last| last + 1)];
        for (piece, nodes) in pieces.iter().zip(&tetrahedra) {
            is_held[*piece] |= nodes.iter().any(|node| fixed[node.index()]);
        }
        is_held.into_iter().all(|fixed| fixed)
    }

    /// The tetrahedra, and of which of the whole body each is a part.
    ///
    /// # Errors
    /// When one has lost its volume to rounding.
    pub fn into_mesh(self) -> Result<(TetrahedronMesh, Vec<u32>), TetrahedronError> {
        let tetrahedra = self.net.corners();
        let mesh = TetrahedronMesh::new(self.net.split.vertices, tetrahedra)?;
        Ok((mesh, self.net.parents))
    }
}

impl<'a> Slit<'a> {
    fn new(sheet: &'a Sheet, net: &Net, reach: f64) -> Self {
        let near = net.split.vertices.iter().enumerate();
        let near = near.filter(|(_, place)| sheet.is_near(place, reach));
        let near = near.map(|(number, place)| (number as u32, sheet.at(place)));
        let at: BTreeMap<u32, SheetCoordinates> = near.collect();
        let on = at.iter().filter(|(_, at)| at.side.abs() < ON);
        Self {
            sheet,
            on: on.map(|(vertex, _)| *vertex).collect(),
            at,
            on_limit: Default::default(),
        }
    }

    /// Distance of a vertex from the sheet [m], with its sign; none far away.
    fn side(&self, vertex: u32) -> Option<f64> {
        match self.on.contains(&vertex) {
            true => Some(0.0),
            false => self.at.get(&vertex).map(|at| at.side),
        }
    }

    /// Distance of a vertex inside a limit [m].
    fn within(&self, vertex: u32, limit: usize) -> Option<f64> {
        match self.on_limit[limit].contains(&vertex) {
            true => Some(0.0),
            false => self
                .at
                .get(&vertex)
                .map(|at| at.within(LIMITS[limit], self.sheet)),
        }
    }

    /// The edges that cross the sheet in tetrahedra that it passes.
    fn crossing(&self, net: &Net) -> BTreeMap<Edge, Vec3> {
        let mut all = BTreeMap::new();
        for number in 0..net.split.tetrahedra.len() as u32 {
            let edges = net.edges(number);
            let crossing = edges.into_iter().filter_map(|edge| {
                let sides = edge.map(|vertex| self.side(vertex));
                let crosses = matches!(sides, [Some(one), Some(other)] if one * other < 0.0);
                let place = crosses.then(|| self.root(net, edge, |at| at.side))?;
                place.map(|place| (edge, place))
            });
            let crossing: Vec<(Edge, Vec3)> = crossing.collect();
            if crossing.is_empty() {
                continue;
            }
            // Where it is, as a box in the coordinates of the sheet.
            let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
            let on = net.split.tetrahedra[number as usize].into_iter();
            let on = on.filter(|vertex| self.on.contains(vertex));
            let places = on.map(|vertex| net.split.vertices[vertex as usize]);
            let roots = crossing.iter().map(|(_, place)| *place);
            for place in places.chain(roots) {
                let at = self.sheet.at(&place);
                for (axis, value) in [at.along, at.below].into_iter().enumerate() {
                    low[axis] = low[axis].min(value);
                    high[axis] = high[axis].max(value);
                }
            }
            let is_passed = high[0] > 0.0
                && low[0] < self.sheet.length
                && low[1] < self.sheet.deepest
                && high[1] > -self.sheet.above;
            if is_passed {
                all.extend(crossing);
            }
        }
        all
    }

    /// Where a function of the place is zero along an edge [m]; none where it leaps there, between parts of the sheet that
    /// turn away from each other.
    fn root(
        &self,
        net: &Net,
        [a, b]: Edge,
        value: impl Fn(&SheetCoordinates) -> f64,
    ) -> Option<Vec3> {
        let [from, to] = [a, b].map(|vertex| net.split.vertices[vertex as usize]);
        let of = |part: f64| value(&self.sheet.at(&(from + (to - from) * part)));
        let sign = of(0.0).signum();
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..ROUNDS {
            let middle = 0.5 * (low + high);
            match of(middle) * sign > 0.0 {
                true => low = middle,
                false => high = middle,
            }
        }
        let leaps = (of(low) - of(high)).abs() > LEAP * (to - from).norm();
        (!leaps).then(|| from + (to - from) * (0.5 * (low + high)))
    }

    /// Moves vertices that are close to the sheet onto it.
    fn snap(&mut self, net: &mut Net) {
        let boundary = net.boundary();
        let mut close: Vec<(f64, u32)> = Vec::new();
        for edge in self.crossing(net).into_keys() {
            let sides = edge.map(|vertex| self.side(vertex).unwrap_or_default().abs());
            for (vertex, side) in edge.into_iter().zip(sides) {
                let part = side / (sides[0] + sides[1]);
                if part < SNAP {
                    close.push((part, vertex));
                }
            }
        }
        close.sort_unstable_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
        for (part, vertex) in close {
            if !self.on.contains(&vertex) && (self.move_onto(net, vertex, &boundary) || part < BEND)
            {
                self.on.insert(vertex);
            }
        }
    }

    /// Moves a vertex onto the sheet, along the boundary if it is on that; whether it could.
    fn move_onto(&mut self, net: &mut Net, vertex: u32, boundary: &Boundary) -> bool {
        let Some(SheetCoordinates { side, across, .. }) = self.at.get(&vertex).copied() else {
            return false;
        };
        let normals = &boundary.normals[vertex as usize];
        let normal = normals.iter().sum::<Vec3>().try_normalize(1e-9);
        let along = normal.map_or(across, |normal| across - normal * normal.dot(&across));
        let way = along * (-side / along.dot(&across));
        let moves = net.shift(vertex, &way, boundary);
        if moves {
            self.at
                .insert(vertex, self.sheet.at(&net.split.vertices[vertex as usize]));
        }
        moves
    }

    /// Splits the edges that cross the sheet.
    fn cross(&mut self, net: &mut Net) {
        for (edge, place) in self.crossing(net) {
            let new = self.add(net, edge, place);
            self.on.insert(new);
        }
    }

    fn add(&mut self, net: &mut Net, edge: Edge, place: Vec3) -> u32 {
        let new = net.split(edge, place);
        self.at.insert(new, self.sheet.at(&place));
        new
    }

    /// The edges on the sheet, inside of which it ends at a limit, and where [m].
    fn crossing_limit(&self, net: &Net, limit: usize) -> BTreeMap<Edge, Vec3> {
        let around = self
            .on
            .iter()
            .flat_map(|&vertex| &net.split.around[vertex as usize]);
        let edges = around.flat_map(|&tetrahedron| net.edges(tetrahedron));
        let crosses = |&[a, b]: &Edge| {
            let within = [a, b].map(|vertex| self.within(vertex, limit));
            self.on.contains(&a)
                && self.on.contains(&b)
                && matches!(within, [Some(one), Some(other)] if one * other < 0.0)
                && self.is_near_limits(net, &[a, b])
        };
        let crossing = edges.filter(crosses).filter_map(|edge| {
            let place = self.root(net, edge, |at| at.within(LIMITS[limit], self.sheet));
            place.map(|place| (edge, place))
        });
        crossing.collect()
    }

    /// Whether an edge comes closer to the inside of the sheet than it is long.
    fn is_near_limits(&self, net: &Net, edge: &Edge) -> bool {
        let [a, b] = edge.map(|vertex| net.split.vertices[vertex as usize]);
        let reach = (b - a).norm();
        (0..LIMITS.len()).all(|limit| {
            let each = edge.iter().map(|&vertex| self.within(vertex, limit));
            each.flatten().any(|within| within > -reach)
        })
    }

    /// Makes edges of a limit of the sheet.
    fn bound(&mut self, net: &mut Net, limit: usize) {
        let boundary = net.boundary();
        for &vertex in &self.on {
            let within = self
                .at
                .get(&vertex)
                .map(|at| at.within(LIMITS[limit], self.sheet));
            if within.is_some_and(|within| within.abs() < ON) {
                self.on_limit[limit].insert(vertex);
            }
        }
        let size = match LIMITS[limit] {
            Limit::Start | Limit::End => self.sheet.length,
            Limit::Floor => self.sheet.deepest,
        };
        let mut close: Vec<(f64, u32, Edge, Vec3)> = Vec::new();
        for (edge, place) in self.crossing_limit(net, limit) {
            let [a, b] = edge.map(|vertex| net.split.vertices[vertex as usize]);
            let length = (b - a).norm();
            for (vertex, from) in edge.into_iter().zip([a, b]) {
                let way = (place - from).norm();
                let part = way / length.min(size);
                if part < SNAP_OF_LIMIT {
                    close.push((part, vertex, edge, place));
                }
            }
        }
        close.sort_unstable_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
        for (part, vertex, edge, place) in close {
            let is_known = edge.iter().any(|end| self.on_limit[limit].contains(end));
            if is_known {
                continue;
            }
            let way = place - net.split.vertices[vertex as usize];
            let on_others = (0..limit).any(|other| self.on_limit[other].contains(&vertex));
            let is_outside = self
                .within(vertex, limit)
                .is_some_and(|within| within < 0.0);
            let is_inner = boundary.normals[vertex as usize].is_empty();
            // The slit bends to a vertex that cannot move; but a shallow one continues below the
            // surface.
            let bends = part < BEND && (is_outside || is_inner);
            if (!on_others && net.shift(vertex, &way, &boundary)) || bends {
                self.at
                    .insert(vertex, self.sheet.at(&net.split.vertices[vertex as usize]));
                self.on_limit[limit].insert(vertex);
            }
        }
        for (edge, place) in self.crossing_limit(net, limit) {
            let new = self.add(net, edge, place);
            self.on.insert(new);
            self.on_limit[limit].insert(new);
            for other in 0..limit {
                if edge
                    .iter()
                    .all(|vertex| self.on_limit[other].contains(vertex))
                {
                    self.on_limit[other].insert(new);
                }
            }
        }
    }

    /// Splits the edges within the sheet whose ends are both at its front, which would hold their faces together.
    fn free_front(&mut self, net: &mut Net) {
        let around = self
            .on
            .iter()
            .flat_map(|&vertex| &net.split.around[vertex as usize]);
        let edges: BTreeSet<Edge> = around.flat_map(|&t| net.edges(t)).collect();
        for edge in edges {
            let at_front = |vertex: &u32| self.on_limit.iter().any(|own| own.contains(vertex));
            let is_held = edge
                .iter()
                .all(|vertex| self.on.contains(vertex) && at_front(vertex));
            let is_front = |own: &BTreeSet<u32>| edge.iter().all(|vertex| own.contains(vertex));
            if !is_held || self.on_limit.iter().any(is_front) {
                continue;
            }
            let [a, b] = edge.map(|vertex| net.split.vertices[vertex as usize]);
            let middle = self.sheet.at(&(0.5 * (a + b)));
            if LIMITS
                .iter()
                .all(|&limit| middle.within(limit, self.sheet) > 0.0)
            {
                let new = self.add(net, edge, 0.5 * (a + b));
                self.on.insert(new);
            }
        }
    }

    /// Opens flat tetrahedra around the sheet: vertices inside the body move, those of the sheet on it; its front stays.
    fn relax(&self, net: &mut Net) {
        let boundary = net.boundary();
        let is_fixed = |vertex: u32| {
            net.is_locked(vertex)
                || !boundary.normals[vertex as usize].is_empty()
                || self.on_limit.iter().any(|own| own.contains(&vertex))
        };
        let around = self
            .on
            .iter()
            .flat_map(|&vertex| &net.split.around[vertex as usize]);
        let around: BTreeSet<u32> = around.copied().collect();
        let nodes = around
            .iter()
            .flat_map(|&t| net.split.tetrahedra[t as usize]);
        let free: BTreeSet<u32> = nodes.filter(|&vertex| !is_fixed(vertex)).collect();
        for _ in 0..SWEEPS {
            let mut any = false;
            for &vertex in &free {
                let star: Vec<_> = net.split.around[vertex as usize]
                    .iter()
                    .map(|&t| net.split.tetrahedra[t as usize])
                    .collect();
                let flattest = star.iter().map(|nodes| {
                    dihedral_quality(&nodes.map(|node| net.split.vertices[node as usize]))
                });
                if flattest.fold(f64::INFINITY, f64::min) < FLAT {
                    let is_on = self.on.contains(&vertex);
                    any |= open_around(
                        &mut net.split.vertices,
                        vertex,
                        &star,
                        |target| match is_on {
                            true => self.sheet.onto(&target),
                            false => target,
                        },
                    );
                }
            }
            if !any {
                break;
            }
        }
    }

    /// The faces that make up the sheet.
    fn faces(&self, net: &Net) -> HashSet<[u32; 3]> {
        let mut sides: BTreeMap<[u32; 3], [bool; 2]> = BTreeMap::new();
        let around = self
            .on
            .iter()
            .flat_map(|&vertex| &net.split.around[vertex as usize]);
        for &tetrahedron in around.collect::<BTreeSet<_>>() {
            let nodes = net.split.tetrahedra[tetrahedron as usize];
            let sum: f64 = nodes.iter().filter_map(|&vertex| self.side(vertex)).sum();
            // One whose vertices are all on it is on either side.
            let is_left = sum > 0.0;
            for left_out in nodes {
                let face = face_without(nodes, left_out);
                if !self.is_inside(net, &face) {
                    continue;
                }
                sides.entry(face).or_default()[usize::from(is_left)] = true;
            }
        }
        let both = sides.into_iter().filter(|(_, sides)| *sides == [true; 2]);
        both.map(|(face, _)| face).collect()
    }

    /// Whether a face is part of the sheet.
    fn is_inside(&self, net: &Net, face: &[u32; 3]) -> bool {
        let is_on = face.iter().all(|vertex| self.on.contains(vertex));
        let middle = face
            .iter()
            .map(|&vertex| net.split.vertices[vertex as usize])
            .sum::<Vec3>()
            / 3.0;
        is_on
            && (0..LIMITS.len()).all(|limit| {
                let each = face.iter().map(|&vertex| self.within(vertex, limit));
                let at = self.sheet.at(&middle);
                each.flatten().all(|within| within >= 0.0)
                    && at.within(LIMITS[limit], self.sheet) > 0.0
                    && at.below > -self.sheet.above
            })
    }
}
