//! The cuts, compared with the required line.

use palpate_files::scene::Goal;
use palpate_files::{Event, SessionRow};
use palpate_geometry::Vec3;

use crate::polyline::Polyline;

/// A blade that is farther from its position a row before than this [m] was lifted in between.
const LEAP: f64 = 5e-3;

/// Cuts along the line with gaps shorter than this [m] count as one: an opening extends to the edge of its triangle,
/// about a millimetre, and leaves no tissue there for a blade to open.
const JOINED: f64 = 1.5e-3;

/// A line is complete when at most this part of it is left [-], and no gap is longer than the tolerated one: openings
/// end at the edges of triangles.
const LEFT: f64 = 0.03;

/// The paths of the cuts.
#[derive(Debug, Clone)]
pub(super) struct CutTracker {
    line: Option<Polyline>,
    /// The largest counted distance from it [m].
    tolerance: f64,
    /// The layer down to which the line is to be cut; none in an organ without layers.
    wanted_layers: Option<usize>,
    /// The openings, cut by cut.
    cut_paths: Vec<Vec<Opening>>,
    /// The tool that makes the last one.
    by: Option<CuttingTool>,
}

/// A tool that makes a cut.
#[derive(Debug, Clone, Copy)]
struct CuttingTool {
    tool: usize,
    /// Whether the hand makes the cut, and not tissue that gives way under the tool.
    by_hand: bool,
    /// Last position of its tip [m].
    tip: Vec3,
}

/// An opening.
#[derive(Debug, Clone, Copy)]
struct Opening {
    /// The tip [m].
    tip: Vec3,
    /// The deepest layer opened there; none in an organ without layers.
    layer: Option<usize>,
    /// Whether it opens the surface, and not a layer below an opening.
    outermost: bool,
    /// Arc length along the line [m].
    along: f64,
    /// Deviation from the line over the surface.
    deviation: Deviation,
}

/// Deviation of a cut from its line over the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// [m]
    pub distance: f64,
    /// Whether it is inside the line; none for an open line.
    pub is_inside: Option<bool>,
}

/// Measures of the cuts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutScore {
    /// Number of cuts.
    pub count: usize,
    /// Path length of the tip while it opened the surface [m]: layers below an opening add nothing.
    pub length: f64,
    /// Of cuts along a line.
    pub along_line: Option<LineScore>,
}

/// A cut compared with the line that it should follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineScore {
    /// Length of the line [m].
    pub wanted: f64,
    /// Length of its cut part [m].
    pub covered: f64,
    /// Distance from it, mean over the cuts' length [m].
    pub mean_deviation: f64,
    /// The largest distance from it [m].
    pub largest_deviation: f64,
    /// The area between it and the openings of the surface: the distance, over their length [m²].
    pub deviation_area: f64,
}

impl CutTracker {
    pub(super) fn new(goal: &Goal) -> Self {
        let (line, tolerance, wanted_layers) = match goal {
            Goal::Cut {
                line,
                tolerance_m,
                layers,
            } => (Polyline::new(line), *tolerance_m, *layers),
            _ => (None, f64::INFINITY, None),
        };
        Self {
            line,
            tolerance,
            wanted_layers,
            cut_paths: Vec::new(),
            by: None,
        }
    }

    pub(super) fn add(&mut self, row: &SessionRow) {
        let happened = |event| row.events.contains(event);
        if happened(Event::Restart) {
            self.cut_paths.clear();
            self.by = None;
        }
        if happened(Event::UndoCut) {
            self.cut_paths.pop();
            self.by = None;
        }
        let tip = Vec3::from(row.position_m);
        if let Some(by) = self.by.as_mut().filter(|by| by.tool == row.tool) {
            let ends = !row.contact
                || happened(Event::Lifted)
                || by.by_hand && !row.cut
                || (tip - by.tip).norm() > LEAP;
            by.tip = tip;
            if ends {
                self.by = None;
            }
        }
        if !happened(Event::Cut) {
            return;
        }
        if self.by.is_none_or(|by| by.tool != row.tool) {
            self.cut_paths.push(Vec::new());
            self.by = Some(CuttingTool {
                tool: row.tool,
                by_hand: row.cut,
                tip,
            });
        }
        let near = self.line.as_ref().map(|line| line.nearest(&tip));
        if let Some(cut_path) = self.cut_paths.last_mut() {
            cut_path.push(Opening {
                tip,
                along: near.map_or(0.0, |near| near.along),
                deviation: Deviation {
                    distance: near.map_or(0.0, |near| surface_part(&near.offset, row.depth_m)),
                    is_inside: near.and_then(|near| near.is_inside),
                },
                layer: row.events.deepest_opened(),
                outermost: happened(Event::OpensLayer1) || row.events.deepest_opened().is_none(),
            });
        }
    }

    /// Deviation of the present cut from its line.
    pub(super) fn deviation(&self) -> Option<Deviation> {
        self.by.and(self.line.as_ref())?;
        Some(self.cut_paths.last()?.last()?.deviation)
    }

    /// Length of the required line, and of its part that is cut down to the required layer [m].
    fn covered(&self) -> Option<[f64; 2]> {
        let line = self.line.as_ref()?;
        // A sum of nothing is -0.
        let parts = self.parts(line).into_iter();
        let covered = parts.fold(0.0, |sum, [low, high]| sum + (high - low));
        Some([line.length(), covered])
    }

    /// The part of the line that is cut down to the required layer [-].
    pub(super) fn part(&self) -> Option<f64> {
        self.covered().map(|[wanted, covered]| covered / wanted)
    }

    /// Whether the whole line is cut down to the required layer.
    pub(super) fn is_complete(&self) -> bool {
        self.covered()
            .is_some_and(|[wanted, covered]| wanted - covered <= JOINED.min(LEFT * wanted))
    }

    /// The stretches of the line that are not cut down to the required layer: the ends of their straight pieces [m].
    pub(super) fn uncut(&self) -> Vec<[Vec3; 2]> {
        let Some(line) = &self.line else {
            return Vec::new();
        };
        let mut gaps = Vec::new();
        let mut end = 0.0;
        for [low, high] in self.parts(line).into_iter().chain([[line.length(); 2]]) {
            if low > end {
                gaps.extend(line.pieces(end, low));
            }
            end = high;
        }
        gaps
    }

    /// The stretches of the line that are cut down to the required layer within the tolerance, in order and disjoint:
    /// their arc lengths [m].
    fn parts(&self, line: &Polyline) -> Vec<[f64; 2]> {
        let length = line.length();
        let mut each: Vec<[f64; 2]> = Vec::new();
        for cut_path in &self.cut_paths {
            for pair in cut_path.windows(2) {
                let counts = |place: &Opening| {
                    place.layer >= self.wanted_layers && place.deviation.distance <= self.tolerance
                };
                if !pair.iter().all(counts) {
                    continue;
                }
                let [one, other] = [pair[0].along, pair[1].along];
                let (low, high) = (one.min(other), one.max(other));
                match line.is_closed() && high - low > 0.5 * length {
                    true => each.extend([[0.0, low], [high, length]]),
                    false => each.push([low, high]),
                }
            }
        }
        each.retain(|[low, high]| low < high);
        each.sort_unstable_by(|one, other| one[0].total_cmp(&other[0]));
        let mut parts: Vec<[f64; 2]> = Vec::new();
        for [low, high] in each {
            match parts.last_mut() {
                Some(last) if low <= last[1] + JOINED => last[1] = last[1].max(high),
                _ => parts.push([low, high]),
            }
        }
        // A closed line continues beyond its end.
        if let (true, Some(first), Some(last)) = (line.is_closed(), parts.first(), parts.last())
            && first[0] + length - last[1] <= JOINED
        {
            let last = parts.len() - 1;
            parts[0][0] = 0.0;
            parts[last][1] = length;
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
            along_line: self.covered().map(|[wanted, covered]| {
                let places = self.cut_paths.iter().flatten();
                let largest = places
                    .map(|place| place.deviation.distance)
                    .fold(0.0, f64::max);
                let (mut weight, mut sum, mut area) = (0.0, 0.0, 0.0);
                for piece in pieces.clone() {
                    let piece_length = (piece[1].tip - piece[0].tip).norm();
                    let both = piece[0].deviation.distance + piece[1].deviation.distance;
                    weight += piece_length;
                    sum += 0.5 * piece_length * both;
                    if piece.iter().all(|place| place.outermost) {
                        area += 0.5 * piece_length * both;
                    }
                }
                LineScore {
                    wanted,
                    covered,
                    mean_deviation: if weight > 0.0 { sum / weight } else { largest },
                    largest_deviation: largest,
                    deviation_area: area,
                }
            }),
        })
    }
}

/// The part of a path [m] at the surface, when `depth` [m] of it is below.
pub(super) fn surface_part(path: &Vec3, depth: f64) -> f64 {
    (path.norm_squared() - depth * depth).max(0.0).sqrt()
}
