//! Cuts as slits in the elements, with traction-free sides.
//!
//! *How we know*: `nonlinear_cuts::…`.
//!
//! *Limits*: a cut that turns back within the length of an edge, for example over a rim, stays closed there, and one
//! that would cut a piece off or open a cavity stays closed altogether, with a warning.

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

/// A key of the first `count` parts of the cuts; zero if none changes the forces.
pub(super) fn key(cuts: &Cuts, count: usize) -> u64 {
    let mut hasher = DefaultHasher::new();
    let mut any = false;
    for part in parting_parts(cuts, count) {
        any = true;
        for end in part.ends {
            let place: [f64; 3] = end.into();
            place.map(f64::to_bits).hash(&mut hasher);
        }
        part.in_mechanics.hash(&mut hasher);
    }
    if any { hasher.finish().max(1) } else { 0 }
}

/// Those of the first `count` parts of cuts that part the tissue.
fn parting_parts(cuts: &Cuts, count: usize) -> impl Iterator<Item = &CutPart> {
    let parts = cuts.parts().iter().take(count);
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

    /// Takes over the first `count` parts of `cuts`.
    pub(super) fn follow(&mut self, model: &CuttingModel, cuts: &Cuts, count: usize) {
        self.points.clear();
        self.begins.clear();
        let mut end = None;
        for part in parting_parts(cuts, count) {
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
            let part = (place - from.place).dot(&by) / by.norm_squared();
            let off = place - from.place - by * part.clamp(0.0, 1.0);
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
        let anchors = composition.anchors();
        for (number, whole) in composition.filled.iter().enumerate() {
            let own = paths
                .each()
                .filter(|path| self.piece_at(&path[0].place) == number);
            let mut slit = SlitTetrahedra::new(&whole.mesh);
            for path in own {
                let mut parted = slit.clone();
                let stays = open(&mut parted, path);
                // An unfixed piece has no equilibrium; a fluid would leave an opened cavity.
                let is_held = parted.is_fixed(|place| anchors[number].is_fixed(place));
                if is_held && encloses_cavities(&parted, whole, &composition.pieces[number]) {
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
