use palpate_files::session::Event;
use palpate_geometry::{CutSurface, NodeId, TriangleMesh, Vec3};

use super::CuttingModel;
use super::cut_path::LEAVES;
use super::gape::Gape;
use super::parts::{CutPart, nearest, opening_at};
use crate::Simulation;
use crate::nonlinear::is_within_one;

/// Initial capacity for parts and cuts: beyond, a step may allocate.
const CAPACITY: usize = 1024;

/// The cuts of an organ.
#[derive(Debug, Clone)]
pub struct Cuts {
    pub(super) surface: CutSurface,
    /// The cut in progress.
    pub(super) cut_path: Option<CutPath>,
    /// The path of all cuts over the resting surface.
    pub(super) parts: Vec<CutPart>,
    /// Parts that were opened to more layers, in the order in which that happened.
    pub(super) deepened: Vec<Deepened>,
    /// The sizes before each cut that can be undone.
    pub(super) before: Vec<Mark>,
    /// The gape displacements, and the version to which they belong.
    gape: Gape,
    gapes: u64,
    /// Current positions of the vertices [m].
    places: Vec<Vec3>,
    /// The detached piece of each vertex, from 1 on, or zero; empty without any.
    detached: Vec<u32>,
    /// The triangles to display.
    triangles: Vec<[NodeId; 3]>,
    pub(crate) version: u64,
    pub(super) largest_lag: usize,
}

/// A cut in progress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CutPath {
    /// The tool that makes it.
    pub(super) tool: usize,
    /// End of the opening [m].
    pub(super) at: Vec3,
    /// Position of the blade [m].
    pub(super) blade: Vec3,
    /// Whether it opens the surface; else it moves within an opening.
    pub(super) opens: bool,
    /// The sizes before it.
    pub(super) before: Mark,
}

/// The sizes of all lists that a cut extends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mark {
    pub(super) parts: usize,
    pub(super) deepened: usize,
    /// Cuts of the surface.
    pub(super) surface: usize,
}

/// A part that was opened to more layers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Deepened {
    pub(super) part: usize,
    /// Number of open layers before.
    pub(super) before: usize,
}

impl Cuts {
    /// No cuts.
    pub(crate) fn new(simulation: &Simulation, model: &CuttingModel) -> Self {
        let surface = CutSurface::new(&simulation.surface, model.method);
        let [vertices, triangles] = surface.capacity();
        let mut places = Vec::with_capacity(vertices);
        let mut shown = Vec::with_capacity(triangles);
        shown.extend_from_slice(surface.mesh().triangles());
        places.extend_from_slice(surface.mesh().vertices());
        Self {
            places,
            detached: Vec::with_capacity(vertices),
            triangles: shown,
            surface,
            cut_path: None,
            gape: Gape::with_capacity(vertices, triangles),
            gapes: 0,
            parts: Vec::with_capacity(CAPACITY),
            deepened: Vec::with_capacity(CAPACITY * Event::OPENS_LAYER.len()),
            before: Vec::with_capacity(CAPACITY),
            version: 0,
            largest_lag: 0,
        }
    }

    /// Removes all cuts; the version continues. It allocates nothing.
    pub(crate) fn reset(&mut self) {
        self.surface.close_all();
        self.places.clear();
        self.places
            .extend_from_slice(self.surface.mesh().vertices());
        self.cut_path = None;
        self.parts.clear();
        self.deepened.clear();
        self.before.clear();
        self.largest_lag = 0;
        self.version += 1;
        self.detached.clear();
        self.update_triangles();
        // A closed cut does not gape.
        self.gape.clear();
        self.gapes = self.version;
    }

    /// The organ's triangles with their openings, at rest and closed: the first are those of its surface. Among them are those
    /// that join detached pieces to the rest ([`Self::triangles`]).
    pub fn mesh(&self) -> &TriangleMesh {
        self.surface.mesh()
    }

    /// The same with its edges and vertices.
    pub fn surface(&self) -> &CutSurface {
        &self.surface
    }

    /// The triangles to display: those of [`Self::mesh`] without those that join a detached piece to the rest.
    pub fn triangles(&self) -> &[[NodeId; 3]] {
        &self.triangles
    }

    /// The piece of each vertex of [`Self::mesh`] that cuts have detached from all that is fixed, from 1 on; zero for the rest.
    /// Empty without such pieces; of the newest vertices not yet known.
    pub fn detached(&self) -> &[u32] {
        &self.detached
    }

    /// Number of detached pieces.
    pub fn detached_pieces(&self) -> u32 {
        self.detached.iter().copied().max().unwrap_or(0)
    }

    /// Takes over the detached pieces of the `surface` and of the vertices that openings have added to it.
    pub(crate) fn set_detached(&mut self, surface: &[u32], rims: impl Iterator<Item = (u32, u32)>) {
        if surface.is_empty() && self.detached.is_empty() {
            return;
        }
        self.detached.clear();
        self.detached.extend_from_slice(surface);
        if !surface.is_empty() {
            self.detached.resize(self.mesh().vertices().len(), 0);
            for (vertex, piece) in rims {
                if let Some(own) = self.detached.get_mut(vertex as usize) {
                    *own = piece;
                }
            }
        }
        self.version += 1;
    }

    /// Finds the triangles to display.
    fn update_triangles(&mut self) {
        let mesh = self.surface.mesh();
        self.detached.truncate(mesh.vertices().len());
        let all = mesh.triangles().iter();
        self.triangles.clear();
        self.triangles
            .extend(all.filter(|corners| is_within_one(&self.detached, corners)));
    }

    /// Current positions of the vertices of [`Self::mesh`], gaping [m].
    pub fn places(&self) -> &[Vec3] {
        &self.places
    }

    /// Gape displacement of a rim vertex and of the points below it [m]; zero elsewhere.
    pub(crate) fn gape_of_rim(&self, vertex: u32) -> Vec3 {
        let is_known = (vertex as usize) < self.places.len();
        let is_on_rim = is_known && self.surface.opening(NodeId(vertex)) != Vec3::zeros();
        let displacement = self.gape.displacements().get(vertex as usize);
        displacement
            .filter(|_| is_on_rim)
            .copied()
            .unwrap_or_default()
    }

    /// Changes whenever the triangles change, or the depth of a cut.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Whether there is an opening, or one begins.
    pub fn has_openings(&self) -> bool {
        self.cut_path.is_some() || !self.before.is_empty()
    }

    /// Number of cuts that can be undone.
    pub fn count(&self) -> usize {
        self.before.len()
    }

    /// Number of cuts that can be undone, with one in progress.
    pub(crate) fn begun(&self) -> usize {
        self.before.len() + usize::from(self.cut_path.is_some())
    }

    /// The path of all cuts over the resting surface, with the number of open layers in each part.
    pub fn parts(&self) -> &[CutPart] {
        &self.parts
    }

    /// Whether a blade is in the tissue.
    pub(crate) fn is_cutting(&self) -> bool {
        self.cut_path.is_some()
    }

    /// The vertices of the openings: their numbers, their positions at rest [m], and the directions in which they open
    /// [-].
    pub(crate) fn openings(
        &self,
        simulation: &Simulation,
    ) -> impl Iterator<Item = (u32, Vec3, Vec3)> {
        let of_surface = simulation.surface.mesh().vertices().len();
        let vertices = self.mesh().vertices().iter().enumerate();
        vertices.filter_map(move |(number, place)| {
            let opens = self.surface.opening(NodeId(number as u32));
            (number >= of_surface || opens != Vec3::zeros()).then_some((
                number as u32,
                *place,
                opens,
            ))
        })
    }

    /// Whether the surface is being opened.
    pub(crate) fn is_in_progress(&self) -> bool {
        self.cut_path.is_some_and(|cut_path| cut_path.opens)
    }

    /// Length of all cuts over the resting surface [m].
    pub fn length(&self) -> f64 {
        self.length_through(1)
    }

    /// Length of all cuts through this number of layers, over the resting surface [m].
    pub fn length_through(&self, layers: usize) -> f64 {
        let deep = self.parts.iter().filter(|part| part.layers >= layers);
        // A sum of nothing is -0.
        deep.fold(0.0, |sum, part| sum + part.length())
    }

    /// The largest number of triangles so far between a blade and the end of its opening.
    pub fn largest_lag(&self) -> usize {
        self.largest_lag
    }

    /// Undoes the last cut. Returns whether there was one; while a cut is in progress there is none.
    pub(crate) fn undo(&mut self) -> bool {
        if self.is_cutting() {
            return false;
        }
        let Some(mark) = self.before.pop() else {
            return false;
        };
        while self.surface.cuts() > mark.surface && self.surface.undo() == Ok(true) {}
        for last in self.deepened.drain(mark.deepened..).rev() {
            let part = &mut self.parts[last.part];
            part.layers = last.before;
            part.in_mechanics = last.before;
        }
        self.parts.truncate(mark.parts);
        self.version += 1;
        true
    }

    /// Updates the shape to the displacements of the organ's vertices [m], and the openings in `rims` to theirs. It
    /// allocates if the triangles exceed the capacity.
    pub(crate) fn follow(
        &mut self,
        simulation: &Simulation,
        moved: &[Vec3],
        rims: impl Iterator<Item = (u32, Vec3)>,
        width: f64,
    ) {
        if self.gapes != self.version {
            self.gapes = self.version;
            self.gape.follow(&self.surface, width);
            self.update_triangles();
        }
        self.surface
            .place(&simulation.surface, moved, 0.0, &mut self.places);
        let rest = self.surface.mesh().vertices();
        for (number, by) in rims {
            self.places[number as usize] = rest[number as usize] + by;
        }
        for (place, displacement) in self.places.iter_mut().zip(self.gape.displacements()) {
            *place += displacement;
        }
    }

    /// Whether an update is due at once, because the triangles have changed.
    pub(crate) fn is_outdated(&self) -> bool {
        self.gapes != self.version
    }

    /// The part of a cut that is closest to a point, within `reach` [m].
    pub(super) fn part_near(&self, place: &Vec3, reach: f64) -> Option<usize> {
        let near = nearest(&self.parts, place).filter(|near| near.distance < reach)?;
        Some(near.part)
    }

    /// Number of layers that were open at a blade before its tool began to cut there.
    pub(super) fn open_before(&self, model: &CuttingModel, tool: usize, place: &Vec3) -> usize {
        let own = self.cut_path.filter(|cut_path| cut_path.tool == tool);
        if !model.is_layered || own.is_some_and(|cut_path| cut_path.opens) {
            return 0;
        }
        let Some(part) = opening_at(&self.parts, place, LEAVES * model.width) else {
            return 0;
        };
        let since = own.map_or(self.deepened.len(), |cut_path| cut_path.before.deepened);
        let mut own = self.deepened[since..].iter();
        own.find(|deepened| deepened.part == part)
            .map_or(self.parts[part].layers, |deepened| deepened.before)
    }
}
