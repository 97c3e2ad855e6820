use palpate_geometry::{CutSurface, TriangleMesh, Vec3};

use super::{CuttingModel, gape};
use crate::Simulation;

/// The cuts of an organ.
#[derive(Debug, Clone)]
pub struct Cuts {
    pub(super) surface: CutSurface,
    /// The cut that is being made.
    pub(super) stroke: Option<Stroke>,
    /// The way of all cuts over the resting surface.
    pub(super) way: Vec<CutSegment>,
    /// Parts of the way before each cut that can be undone.
    pub(super) before: Vec<usize>,
    /// How far they are moved to gape [m], and of which version that is.
    ways: Vec<Vec3>,
    gapes: u64,
    /// Where the vertices are now [m].
    places: Vec<Vec3>,
    pub(crate) version: u64,
    pub(super) largest_lag: usize,
}

/// A cut that is being made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stroke {
    /// By which tool.
    pub(super) tool: usize,
    /// Where the opening has come to [m].
    pub(super) at: Vec3,
    /// Where the blade is [m].
    pub(super) blade: Vec3,
    /// Parts of the way before it.
    pub(super) before: usize,
}

/// A straight part of a cut on the resting surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CutSegment {
    /// Its ends [m].
    pub(crate) ends: [Vec3; 2],
    /// Unit outward normal of the surface there [-].
    pub(crate) normal: Vec3,
}

impl Cuts {
    /// None yet.
    pub(crate) fn new(simulation: &Simulation, model: &CuttingModel) -> Self {
        let surface = CutSurface::new(&simulation.surface, model.method);
        Self {
            places: surface.mesh().vertices().to_vec(),
            surface,
            stroke: None,
            ways: Vec::new(),
            gapes: 0,
            way: Vec::new(),
            before: Vec::new(),
            version: 0,
            largest_lag: 0,
        }
    }

    /// None any more, as at the beginning, but for the version. It allocates nothing.
    pub(crate) fn begin_anew(&mut self) {
        self.surface.close_all();
        self.places.clear();
        self.places
            .extend_from_slice(self.surface.mesh().vertices());
        self.stroke = None;
        self.way.clear();
        self.before.clear();
        self.largest_lag = 0;
        self.version += 1;
        // What is closed gapes nowhere.
        self.ways.clear();
        self.gapes = self.version;
    }

    /// The organ's triangles with their openings, at rest and closed: the first are those of its surface.
    pub fn mesh(&self) -> &TriangleMesh {
        self.surface.mesh()
    }

    /// The same with what is known of its edges and vertices.
    pub fn surface(&self) -> &CutSurface {
        &self.surface
    }

    /// Where the vertices of [`Self::mesh`] are now, gaping [m].
    pub fn places(&self) -> &[Vec3] {
        &self.places
    }

    /// Another number whenever the triangles are others.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Whether there is an opening, or one begins.
    pub fn are_there(&self) -> bool {
        self.stroke.is_some() || self.surface.cuts() > 0
    }

    /// How many cuts there are that can be undone.
    pub fn count(&self) -> usize {
        self.surface.cuts()
    }

    /// The way of all cuts over the resting surface.
    pub(crate) fn way(&self) -> &[CutSegment] {
        &self.way
    }

    /// Where in the way each cut begins, in no order.
    pub(crate) fn begins(&self) -> impl Iterator<Item = usize> {
        let own = self.stroke.map(|stroke| stroke.before);
        self.before.iter().copied().chain(own)
    }

    /// Whether a cut is being made.
    pub(crate) fn goes_on(&self) -> bool {
        self.stroke.is_some()
    }

    /// Length of all cuts over the resting surface [m].
    pub fn length(&self) -> f64 {
        let lengths = self
            .way
            .iter()
            .map(|part| (part.ends[1] - part.ends[0]).norm());
        // A sum of nothing is -0.
        lengths.fold(0.0, |sum, length| sum + length)
    }

    /// Triangles between a blade and the end of its opening, at most so far.
    pub fn largest_lag(&self) -> usize {
        self.largest_lag
    }

    /// Closes the last cut again. Whether there was one; while one is being made there is none.
    pub(crate) fn undo(&mut self) -> bool {
        let undone = self.stroke.is_none() && self.surface.undo() == Ok(true);
        if undone {
            self.way.truncate(self.before.pop().unwrap_or(0));
            self.version += 1;
        }
        undone
    }

    /// Follows the organ to where its vertices are moved [m]. It allocates where the triangles are others.
    pub(crate) fn follow(&mut self, simulation: &Simulation, moved: &[Vec3], width: f64) {
        if self.gapes != self.version {
            self.gapes = self.version;
            self.ways = gape(&self.surface, width);
        }
        self.surface
            .place(&simulation.surface, moved, 0.0, &mut self.places);
        for (place, way) in self.places.iter_mut().zip(&self.ways) {
            *place += way;
        }
    }

    /// Whether it has to follow at once: its triangles are others than those whose places are known.
    pub(crate) fn is_behind(&self) -> bool {
        self.gapes != self.version
    }

    /// Whether what lies under the surface is bare within `reach` [m] of a place of it.
    pub(super) fn expose(&self, place: &Vec3, reach: f64) -> bool {
        self.way.iter().any(|part| distance(part, place) < reach)
    }
}

fn distance(part: &CutSegment, place: &Vec3) -> f64 {
    let [start, end] = part.ends;
    let way = end - start;
    let length = way.norm_squared();
    let at = if length > 0.0 {
        ((place - start).dot(&way) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (start + at * way - place).norm()
}
