//! Cuts as slits in the elements, with traction-free sides.
//!
//! *How we know*: `nonlinear_cuts::…`.
//!
//! *Limits*: a cut that turns back within the length of an edge, for example over a rim, stays closed there, and one
//! that would open a cavity stays closed altogether, with a warning.

use std::hash::{DefaultHasher, Hash, Hasher};

use palpate_geometry::{SlitPoint, SlitTetrahedra, TetrahedronError, Vec3};

use super::NonlinearOrgan;
use super::composition::Filled;
use super::regions::Elements;
use super::soft::Piece;
use crate::Error;
use crate::cutting::{CutPart, Cuts, CuttingModel};

/// Points of a path closer to the one before than this are left out [m].
const SPACING: f64 = 2e-3;

/// A path reaches another one, or itself, within this distance of its end, and goes so far beyond another [m].
const JOIN_DISTANCE: f64 = 1.5e-3;
const OVERSHOOT: f64 = 1e-3;

/// A path returns to itself after this length, or later [m].
const MIN_LOOP: f64 = 6e-3;

/// A path that parts less than this part of its area changes no force [-].
const PARTED: f64 = 0.4;

/// Points closer to a cut than this count as this far from it [m]: the sides of a slit are not exactly below it.
pub(super) const CLEARANCE: f64 = 1.5e-3;

/// The cuts of an organ as paths of slits.
#[derive(Debug, Clone, Default)]
pub(super) struct CutPaths {
    points: Vec<SlitPoint>,
    /// Where each path begins in `points`.
    begins: Vec<usize>,
}

/// A key of the cuts; zero if none changes the forces.
pub(super) fn key(cuts: &Cuts) -> u64 {
    let mut hasher = DefaultHasher::new();
    let mut any = false;
    for part in parting_parts(cuts) {
        any = true;
        for end in part.ends {
            let place: [f64; 3] = end.into();
            place.map(f64::to_bits).hash(&mut hasher);
        }
        part.in_mechanics.hash(&mut hasher);
    }
    if any { hasher.finish().max(1) } else { 0 }
}

/// The parts of cuts that part the tissue.
fn parting_parts(cuts: &Cuts) -> impl Iterator<Item = &CutPart> {
    let parts = cuts.parts().iter();
    parts.filter(|part| part.in_mechanics > 0 && part.length() > 0.0)
}

impl CutPaths {
    /// With capacity for this number of points.
    pub(super) fn with_capacity(points: usize) -> Self {
        Self {
            points: Vec::with_capacity(points),
            begins: Vec::with_capacity(points),
        }
    }

    /// Takes over `other`; nothing is allocated within the capacity.
    pub(super) fn copy(&mut self, other: &Self) {
        self.points.clear();
        self.points.extend_from_slice(&other.points);
        self.begins.clear();
        self.begins.extend_from_slice(&other.begins);
    }

    /// Takes over `cuts`.
    pub(super) fn follow(&mut self, model: &CuttingModel, cuts: &Cuts) {
        self.points.clear();
        self.begins.clear();
        let mut end = None;
        for part in parting_parts(cuts) {
            let depth = model.slit_depth(part.in_mechanics);
            let point = |place| SlitPoint {
                place,
                normal: part.normal,
                depth,
            };
            let [from, to] = part.ends;
            if end != Some(from) {
                self.begins.push(self.points.len());
                self.points.push(point(from));
            } else if let Some(last) = self.points.last_mut() {
                // Where the depth of a cut increases the larger one counts.
                last.depth = last.depth.max(depth);
                last.normal = (last.normal + part.normal).normalize();
            }
            self.points.push(point(to));
            end = Some(to);
        }
    }

    /// The points of each path.
    pub(super) fn each(&self) -> impl Iterator<Item = &[SlitPoint]> {
        let ends = self.begins.iter().skip(1).copied();
        let ends = ends.chain([self.points.len()]);
        let ranges = self.begins.iter().zip(ends);
        ranges.map(|(begin, end)| &self.points[*begin..end])
    }

    /// Whether a point [m] is closer to a point of the cuts than `reach` [m].
    pub(super) fn is_within(&self, place: &Vec3, reach: f64) -> bool {
        let mut points = self.points.iter();
        points.any(|point| (point.place - place).norm() < reach)
    }

    /// Moves a point [m] as far from every cut as its sides may deviate from it.
    pub(super) fn aside(&self, place: &Vec3) -> Vec3 {
        let pairs = self.each().flat_map(|path| path.windows(2));
        let nearest = pairs.map(|pair| {
            let [from, to] = [&pair[0], &pair[1]];
            let by = to.place - from.place;
            let off = place - nearest_on(&from.place, &to.place, place);
            (off.norm(), off, from.normal.cross(&by).normalize())
        });
        let nearest = nearest.min_by(|one, other| one.0.total_cmp(&other.0));
        match nearest {
            Some((distance, off, across)) if distance < CLEARANCE => {
                let side = off.dot(&across);
                place + across * (side.signum() * (CLEARANCE - side.abs()))
            }
            _ => *place,
        }
    }
}

impl NonlinearOrgan {
    /// This intact organ with slits along `paths`; and the total length of those that stay closed [m].
    pub(super) fn slit(&self, paths: &CutPaths) -> Result<(Self, f64), Error> {
        let composition = &self.composition;
        let (mut filled, mut closed) = (Vec::new(), 0.0);
        let paths_to_slit = joined(paths);
        for (number, whole) in composition.filled.iter().enumerate() {
            let own = paths_to_slit
                .iter()
                .filter(|path| self.piece_at(&path[0].place) == number);
            let mut slit = SlitTetrahedra::new(&whole.mesh);
            for path in own {
                let mut parted = slit.clone();
                let stays = open(&mut parted, path);
                // A fluid would leave an opened cavity.
                if encloses_cavities(&parted, whole, &composition.pieces[number]) {
                    slit = parted;
                    closed += stays;
                } else {
                    closed += length(path);
                }
            }
            filled.push(whole.slit(slit).map_err(palpate_mechanics::Error::from)?);
        }
        let organ = Self::of_pieces(composition, &filled, paths.clone(), Some(&self.model))?;
        Ok((organ, closed))
    }

    /// The piece with the point of the displayed surface that is closest to a point [m].
    fn piece_at(&self, place: &Vec3) -> usize {
        let composition = &self.composition;
        let nearest = composition.tree.nearest(composition.shown.mesh(), place);
        Piece::with(&composition.pieces, nearest.triangle.0)
    }
}

/// The paths, closed where they return to themselves, and with ends that go through others which they reach: a blade stops where
/// the surface is open, and a bridge of elements would stay there.
fn joined(paths: &CutPaths) -> Vec<Vec<SlitPoint>> {
    let all: Vec<&[SlitPoint]> = paths.each().collect();
    let extended = |number: usize, end: &SlitPoint, before: &SlitPoint| {
        let outward = (end.place - before.place).try_normalize(0.0)?;
        let others = all.iter().enumerate().filter(|(other, _)| *other != number);
        let reached = others.filter_map(|(_, path)| nearest_joined(path, &end.place));
        let near = reached.min_by(|one, other| one.apart.total_cmp(&other.apart))?;
        let place = near.place + OVERSHOOT * outward;
        Some(SlitPoint { place, ..*end })
    };
    let each = all.iter().enumerate().flat_map(|(number, path)| {
        let mut parts = looped(path);
        for own in parts.iter_mut().filter(|own| !is_closed(own)) {
            let ends = match own[..] {
                [first, second, .., before, last] => [[first, second], [last, before]],
                [first, last] => [[first, last], [last, first]],
                _ => continue,
            };
            let [first, last] = ends.map(|[end, before]| extended(number, &end, &before));
            own.splice(0..0, first);
            own.extend(last);
        }
        parts
    });
    each.collect()
}

/// Whether a path ends where it begins.
fn is_closed(path: &[SlitPoint]) -> bool {
    path.len() > 3 && path[0].place == path[path.len() - 1].place
}

/// A path that returns to itself as a loop, with what of it is no part of that; any other as it is.
fn looped(path: &[SlitPoint]) -> Vec<Vec<SlitPoint>> {
    let [first, .., last] = path else {
        return vec![path.to_vec()];
    };
    let whole = length(path);
    if whole < MIN_LOOP {
        return vec![path.to_vec()];
    }
    // What of it is so near to an end along the path does not count.
    let far = |from: usize, to: usize| length(&path[from..=to]) < whole - MIN_LOOP;
    let early = (2..=path.len()).take_while(|end| far(0, end - 1)).last();
    let late = (0..path.len() - 1).find(|begin| far(*begin, path.len() - 1));
    let returns = early.and_then(|end| nearest_joined(&path[..end], &last.place));
    let passed = late.and_then(|begin| {
        let near = nearest_joined(&path[begin..], &first.place)?;
        Some((begin + near.number, near))
    });
    let at = |near: &Near, end: &SlitPoint| SlitPoint {
        place: near.place,
        ..*end
    };
    let (around, rest) = match (returns, passed) {
        (Some(near), _) => {
            let seam = at(&near, last);
            let around = [&[seam], &path[near.number + 1..], &[seam]].concat();
            (around, [&path[..=near.number], &[seam]].concat())
        }
        (None, Some((number, near))) => {
            let seam = at(&near, first);
            let around = [&[seam], &path[..=number], &[seam]].concat();
            (around, [&[seam], &path[number + 1..]].concat())
        }
        (None, None) => return vec![path.to_vec()],
    };
    match length(&rest) > JOIN_DISTANCE {
        true => vec![around, rest],
        false => vec![around],
    }
}

/// The point of a path that is nearest to another point.
struct Near {
    /// Number of its segment.
    number: usize,
    place: Vec3,
    apart: f64,
}

/// The point of `path` that is nearest to `place` [m], if a cut there reaches it.
fn nearest_joined(path: &[SlitPoint], place: &Vec3) -> Option<Near> {
    let pairs = path.windows(2).enumerate();
    let each = pairs.map(|(number, pair)| {
        let on = nearest_on(&pair[0].place, &pair[1].place, place);
        Near {
            number,
            place: on,
            apart: (on - place).norm(),
        }
    });
    let near = each.filter(|near| near.apart < JOIN_DISTANCE);
    near.min_by(|one, other| one.apart.total_cmp(&other.apart))
}

/// The point between `from` and `to` that is nearest to `place` [m].
fn nearest_on(from: &Vec3, to: &Vec3, place: &Vec3) -> Vec3 {
    let by = to - from;
    let part = (place - from).dot(&by) / by.norm_squared();
    from + by * part.clamp(0.0, 1.0)
}

/// Whether the cavities of a piece are still closed.
fn encloses_cavities(slit: &SlitTetrahedra, whole: &Filled, piece: &Piece) -> bool {
    let cavities = piece.regions.cavities.len();
    let hollow = || whole.slit(slit.clone())?.hollow(cavities);
    cavities == 0 || hollow().is_ok()
}

/// Opens a slit along a path; returns how much of its length stays closed [m].
fn open(slit: &mut SlitTetrahedra, path: &[SlitPoint]) -> f64 {
    let mut thinned: Vec<SlitPoint> = Vec::with_capacity(path.len());
    for (number, point) in path.iter().enumerate() {
        let is_last = number + 1 == path.len();
        let apart = thinned.last().map(|last| (point.place - last.place).norm());
        if is_last && thinned.len() > 1 && apart.is_some_and(|apart| apart < SPACING) {
            thinned.pop();
        }
        if is_last || apart.is_none_or(|apart| apart >= SPACING) {
            thinned.push(*point);
        }
    }
    let parted = slit.open(&thinned);
    let areas = path.windows(2).map(|pair| {
        let depth = 0.5 * (pair[0].depth + pair[1].depth);
        depth * (pair[1].place - pair[0].place).norm()
    });
    let area: f64 = areas.sum();
    match parted < PARTED * area {
        true => length(path) * (1.0 - (parted / area).max(0.0)),
        false => 0.0,
    }
}

fn length(path: &[SlitPoint]) -> f64 {
    let pairs = path.windows(2);
    pairs
        .map(|pair| (pair[1].place - pair[0].place).norm())
        .sum()
}

impl Filled {
    /// Its elements, some of them divided.
    fn slit(&self, slit: SlitTetrahedra) -> Result<Self, TetrahedronError> {
        let (mesh, parents) = slit.into_mesh()?;
        let regions = parents
            .iter()
            .map(|parent| self.mesh.region(*parent as usize));
        Ok(Self {
            mesh: mesh.with_regions(regions.collect())?,
            elements: self.elements.parts(&parents),
        })
    }
}

impl Elements {
    /// The materials of the parts: each from its original element.
    pub(super) fn parts(&self, parents: &[u32]) -> Self {
        let parents = || parents.iter().map(|&parent| parent as usize);
        Self {
            moduli: parents().map(|parent| self.moduli[parent]).collect(),
            numbers: parents().map(|parent| self.numbers[parent]).collect(),
            densities: parents().map(|parent| self.densities[parent]).collect(),
            warnings: Vec::new(),
        }
    }
}
