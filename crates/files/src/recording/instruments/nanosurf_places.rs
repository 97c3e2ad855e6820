//! Positions of the curves of a Nanosurf file: on grids, or in a list.
//!
//! ```text
//! Map0=x₀;x₁;y₀;y₁;columns;rows;rotation;placement     the outermost curves of a grid, in metres
//! PosAxis=X;Y  PosUnit=m;m  Pos0=x;y                   a place
//! ```
//!
//! Curves go back and forth over a grid: the first row from x₀ to x₁, the second from x₁ to x₀, and so on from y₀ to y₁.
//!
//! *How we know*: `microscopes::nanosurf_…`; the heights of the surface in a real map against the image in the same file
//! (`docs/comparisons/recordings.md`).
//!
//! *Limits*: grids that are rotated have no places: no file was found that states such a rotation.

use super::nanosurf::Header;
use super::properties::number;
use crate::Domain;
use crate::units::Unit;

const MODE: &str = "DataSet\\SpecInfos\\SpecHeader";
const GRIDS: &str = "DataSet\\SpecInfos\\SpecMapTable";
const LISTED: &str = "DataSet\\SpecInfos\\SpecPosTable";
/// Grids of a file at most.
const MAX_GRIDS: usize = 256;

/// The positions of all curves.
pub(super) enum Places {
    /// Grids, one after another.
    Grids(Vec<Grid>),
    /// One place for each curve [m].
    Listed(Vec<[f64; 2]>),
    /// The header has no table of positions.
    Unstated,
    /// Why the table is not used.
    Unusable(&'static str),
}

/// A grid of curves.
pub(super) struct Grid {
    /// The first and the last place along x and y [m].
    ends: [[f64; 2]; 2],
    /// Curves along x and y.
    counts: [usize; 2],
}

impl Grid {
    fn parse(text: &str) -> Option<Self> {
        let numbers: Option<Vec<f64>> = text.split(';').map(number).collect();
        let numbers = numbers?;
        let [x0, x1, y0, y1, ..] = numbers[..] else {
            return None;
        };
        let count = |place: usize| text.split(';').nth(place)?.trim().parse().ok();
        let is_rotated = numbers.get(6).is_some_and(|angle| *angle != 0.0);
        let ends = [[x0, x1], [y0, y1]];
        let has_ends = ends
            .iter()
            .flatten()
            .all(|own| Domain::COORDINATE.contains(*own));
        (has_ends && !is_rotated).then_some(Self {
            ends,
            counts: [count(4)?, count(5)?],
        })
    }

    fn curves(&self) -> usize {
        self.counts[0].saturating_mul(self.counts[1])
    }

    /// The place of a curve [m], by its number in this grid.
    fn place(&self, curve: usize) -> [f64; 2] {
        let (row, along) = (curve / self.counts[0], curve % self.counts[0]);
        let column = match row % 2 {
            0 => along,
            _ => self.counts[0] - 1 - along,
        };
        let on = |axis: usize, step: usize| {
            let [from, to] = self.ends[axis];
            let last = self.counts[axis].saturating_sub(1).max(1);
            from + (to - from) * step as f64 / last as f64
        };
        [on(0, column), on(1, row)]
    }
}

impl Places {
    /// The positions that the `header` states, for so many curves.
    pub(super) fn of(header: &Header<'_>, curves: usize) -> Self {
        let is_grid = header
            .get(MODE, "SpecMode")
            .is_none_or(|mode| mode.starts_with("Map"));
        let own = match is_grid {
            true => Self::grids(header),
            false => Self::listed(header, curves),
        };
        let known = match &own {
            Self::Grids(grids) => grids
                .iter()
                .fold(0usize, |sum, grid| sum.saturating_add(grid.curves())),
            Self::Listed(places) => places.len(),
            Self::Unstated | Self::Unusable(_) => return own,
        };
        match known < curves {
            true => Self::Unusable("it has fewer places than there are curves"),
            false => own,
        }
    }

    fn grids(header: &Header<'_>) -> Self {
        let Some(count) = header.get(GRIDS, "Count") else {
            return Self::Unstated;
        };
        let count = count.trim().parse().unwrap_or(0usize).min(MAX_GRIDS);
        let grids = (0..count).map(|place| Grid::parse(header.get(GRIDS, &format!("Map{place}"))?));
        match grids.collect::<Option<Vec<_>>>() {
            Some(grids) => Self::Grids(grids),
            None => Self::Unusable("its grid is rotated or not stated as a grid is"),
        }
    }

    fn listed(header: &Header<'_>, curves: usize) -> Self {
        let Some(axes) = header.get(LISTED, "PosAxis") else {
            return Self::Unstated;
        };
        let units = header
            .get(LISTED, "PosUnits")
            .or_else(|| header.get(LISTED, "PosUnit"));
        let along = |name: &str| {
            let place = axes.split(';').position(|own| own.trim() == name)?;
            let unit = units?.split(';').nth(place)?;
            let unit = Unit::named(unit.trim()).filter(|unit| unit.si == "m")?;
            Some((place, unit))
        };
        let both = along("X").zip(along("Y"));
        let place_of = |curve: usize| {
            let text = header.get(LISTED, &format!("Pos{curve}"))?;
            let on = |(place, unit): (usize, &Unit)| {
                let value = number(text.split(';').nth(place)?)? * unit.multiply / unit.divide;
                Domain::COORDINATE.contains(value).then_some(value)
            };
            let (x, y) = both?;
            Some([on(x)?, on(y)?])
        };
        Self::Listed((0..curves).map_while(place_of).collect())
    }

    /// The place of a curve [m]; none where it is not known.
    pub(super) fn of_curve(&self, curve: usize) -> Option<[f64; 2]> {
        match self {
            Self::Grids(grids) => {
                let mut before = 0;
                for grid in grids {
                    let own = curve - before;
                    if own < grid.curves() {
                        return Some(grid.place(own));
                    }
                    before += grid.curves();
                }
                None
            }
            Self::Listed(places) => places.get(curve).copied(),
            Self::Unstated | Self::Unusable(_) => None,
        }
    }

    /// Why the positions are not known, although the header has a table of them.
    pub(super) fn cause(&self) -> Option<&'static str> {
        match self {
            Self::Unusable(cause) => Some(cause),
            _ => None,
        }
    }
}
