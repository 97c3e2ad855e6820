//! Where was cut, beside where should be.

use palpate_files::scene::Goal;
use palpate_files::{Event, SessionRow};
use palpate_geometry::Vec3;

/// A blade that is farther from its last opening than this [m] was lifted in between.
const LEAP: f64 = 5e-3;

/// Strokes that leave less than this [m] between them are one cut: an opening goes on to the edge of its triangle,
/// about a millimetre, and nothing is left there that a blade could open.
const JOINED: f64 = 1.5e-3;

/// The ways of cuts.
#[derive(Debug, Clone)]
pub(super) struct CutWay {
    line: Option<[Vec3; 2]>,
    /// The layer that the line shall be cut down to; none in an organ without layers.
    wanted_layers: Option<usize>,
    /// Where something was opened, cut by cut.
    cut_paths: Vec<Vec<Place>>,
    /// Which tool makes the last one.
    by: Option<usize>,
}

/// Where something was opened.
#[derive(Debug, Clone, Copy)]
struct Place {
    /// The tip [m].
    tip: Vec3,
    /// How far it was below the surface at rest [m].
    depth: f64,
    /// The deepest layer that was opened there; none in an organ without layers.
    layer: Option<usize>,
    /// Whether the surface was opened there, not a layer below an opening.
    outermost: bool,
}

/// What was cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutScore {
    /// How many cuts there are.
    pub count: usize,
    /// The way of the tip while the surface was opened [m]: layers below an opening add nothing.
    pub length: f64,
    /// Of cuts along a line.
    pub along_line: Option<LineScore>,
}

/// A cut beside the line that it should follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineScore {
    /// Length of the line [m].
    pub wanted: f64,
    /// What of it is cut [m].
    pub covered: f64,
    /// Distance from it, mean over the cuts' length [m].
    pub mean_deviation: f64,
    /// The largest distance from it [m].
    pub largest_deviation: f64,
}

impl CutWay {
    pub(super) fn new(goal: &Goal) -> Self {
        let (line, wanted_layers) = match goal {
            Goal::Cut {
                from_m,
                to_m,
                layers,
                ..
            } => (Some([*from_m, *to_m].map(Vec3::from)), *layers),
            _ => (None, None),
        };
        Self {
            line,
            wanted_layers,
            cut_paths: Vec::new(),
            by: None,
        }
    }

    pub(super) fn add(&mut self, row: &SessionRow) {
        let happened = |event| row.events.contains(event);
        if happened(Event::BeginAnew) {
            self.cut_paths.clear();
            self.by = None;
        }
        if happened(Event::UndoCut) {
            self.cut_paths.pop();
            self.by = None;
        }
        let ends = !row.contact || happened(Event::Lifted);
        if self.by == Some(row.tool) && ends {
            self.by = None;
        }
        if !happened(Event::Cut) {
            return;
        }
        let tip = Vec3::from(row.position_m);
        let goes_on = self.by == Some(row.tool)
            && self
                .cut_paths
                .last()
                .and_then(|cut_path| cut_path.last())
                .is_some_and(|last| (last.tip - tip).norm() < LEAP);
        if !goes_on {
            self.cut_paths.push(Vec::new());
            self.by = Some(row.tool);
        }
        if let Some(cut_path) = self.cut_paths.last_mut() {
            cut_path.push(Place {
                tip,
                depth: row.depth_m,
                layer: row.events.deepest_opened(),
                outermost: happened(Event::OpensLayer1) || row.events.deepest_opened().is_none(),
            });
        }
    }

    /// Length of the line that shall be cut, and what of it is cut down to the wanted layer [m].
    pub(super) fn covered(&self) -> Option<(f64, f64)> {
        let [from, to] = self.line?;
        let parts = self.parts();
        let covered = parts.iter().map(|[low, high]| high - low).sum();
        Some(((to - from).norm(), covered))
    }

    /// The stretches of the line that are not cut down to the wanted layer: their ends [m].
    pub(super) fn uncut(&self) -> Vec<[Vec3; 2]> {
        let Some([from, to]) = self.line else {
            return Vec::new();
        };
        let wanted = (to - from).norm();
        let along = (to - from) / wanted;
        let mut gaps = Vec::new();
        let mut end = 0.0;
        for [low, high] in self.parts().into_iter().chain([[wanted, wanted]]) {
            if low > end {
                gaps.push([from + along * end, from + along * low]);
            }
            end = high;
        }
        gaps
    }

    /// What of the line is cut down to the wanted layer, in order and apart: from where to where along it [m].
    fn parts(&self) -> Vec<[f64; 2]> {
        let Some([from, to]) = self.line else {
            return Vec::new();
        };
        let wanted = (to - from).norm();
        let along = (to - from) / wanted;
        let mut each: Vec<[f64; 2]> = Vec::new();
        for cut_path in &self.cut_paths {
            let deep = cut_path
                .iter()
                .filter(|place| place.layer >= self.wanted_layers);
            let at = deep.map(|place| (place.tip - from).dot(&along));
            let (low, high) = at.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| {
                (low.min(at), high.max(at))
            });
            let (low, high) = (low.max(0.0), high.min(wanted));
            if low < high {
                each.push([low, high]);
            }
        }
        each.sort_unstable_by(|one, other| one[0].total_cmp(&other[0]));
        let mut parts: Vec<[f64; 2]> = Vec::new();
        for [low, high] in each {
            match parts.last_mut() {
                Some(last) if low <= last[1] + JOINED => last[1] = last[1].max(high),
                _ => parts.push([low, high]),
            }
        }
        parts
    }

    pub(super) fn score(&self) -> Option<CutScore> {
        if self.cut_paths.is_empty() {
            return None;
        }
        let pieces = self
            .cut_paths
            .iter()
            .flat_map(|cut_path| cut_path.windows(2));
        let length = pieces
            .clone()
            .filter(|piece| piece[0].outermost && piece[1].outermost)
            .map(|piece| (piece[1].tip - piece[0].tip).norm());
        Some(CutScore {
            count: self.cut_paths.len(),
            length: length.sum(),
            along_line: self
                .line
                .zip(self.covered())
                .map(|(line, (wanted, covered))| {
                    let places = self.cut_paths.iter().flatten();
                    let largest = places.map(|place| off(&line, place)).fold(0.0, f64::max);
                    let (mut weight, mut sum) = (0.0, 0.0);
                    for piece in pieces.clone() {
                        let way = (piece[1].tip - piece[0].tip).norm();
                        weight += way;
                        sum += way * 0.5 * (off(&line, &piece[0]) + off(&line, &piece[1]));
                    }
                    LineScore {
                        wanted,
                        covered,
                        mean_deviation: if weight > 0.0 { sum / weight } else { largest },
                        largest_deviation: largest,
                    }
                }),
        })
    }
}

/// How far a tip of a depth is beside a line over the surface [m]: what is below it does not count.
fn off([from, to]: &[Vec3; 2], place: &Place) -> f64 {
    let line = to - from;
    let at = ((place.tip - from).dot(&line) / line.norm_squared()).clamp(0.0, 1.0);
    aside(&(place.tip - (from + line * at)), place.depth)
}

/// The part of a way [m] along the surface when `depth` [m] of it is below it.
pub(super) fn aside(way: &Vec3, depth: f64) -> f64 {
    (way.norm_squared() - depth * depth).max(0.0).sqrt()
}
