//! A surface that a moving blade cuts (section 7.7), and the resulting openings.
//!
//! A [`CutSurface`] is a [`Surface`] with openings. A cut goes from vertex to vertex. While the blade is
//! among the triangles around the last one nothing happens; when it leaves them over an edge, that
//! edge gives the next vertex: one of its ends, moved under the blade ([`CutMethod::SnapVertices`], the
//! source's), or a new one there ([`CutMethod::SplitTriangles`]). The edge between the two opens, and
//! where two open edges meet, each fan of triangles between them gets a vertex of its own. So a cut may
//! turn, cross another, continue from its end or free a flap, without special rules. Openings have no
//! width here: positions are those at rest, and each vertex of an opening stores the direction of
//! its pull.
//!
//! *Equations*: the blade goes along the plane through it, its goal and the surface's normal n. A vertex
//! right of the cutting vector c is pulled along c × n, one left of it along n × c (7.7, whose product
//! is a cross product).
//!
//! *How we know*: `cut::slit_opens_one_border`, `cut::closed_loop_frees_a_flap`,
//! `cut::source_keeps_triangles_and_area`, `cut::split_parts_follow_the_blade`,
//! `cut::sides_are_pulled_apart`, `cut::gestures::random_gestures_leave_sound_meshes`.
//!
//! *Limits*: a cut shorter than two edges opens nothing, and its end may lack part of an edge. Where a
//! triangle would become a sliver, and in the source's mode where a vertex is already part of an
//! opening, the cut goes through a vertex as it lies, up to half an edge off the blade. A width
//! beyond the triangles along an opening folds them over. Path and pull are those of the surface at
//! rest: the caller maps the blade from a deformed surface back to it, and lifts a blade that has
//! left it.

mod crossing;
mod cut_path;
pub(crate) mod error;
pub(crate) mod net;
mod snap;
mod split;

use cut_path::CutPath;
use error::CutError;
use net::{Mark, Net, Side};
use split::Limits;

use crate::{NodeId, Surface, TriangleId, TriangleMesh, Vec3};

/// No triangle is made whose height is less, in units of its longest edge [-].
const MIN_SHAPE: f64 = 0.05;

/// A blade nearer to the end of an edge than this part of it passes through the end [-].
const NEAR: f64 = 0.1;

/// The shortest part of a split edge, in units of the surface's mean edge [-].
const SHORTEST: f64 = 0.1;

/// Splitting ends at this many triangles per triangle of the surface.
const MAX_GROWTH: usize = 8;

/// Spare capacity for vertices and triangles, as a part of the surface's [-] and at least: beyond it, a cut may
/// allocate.
const SPARE: f64 = 0.25;
const MIN_CAPACITY: usize = 2048;

/// Most change of area of the triangles around a vertex that is moved [-].
const MAX_AREA_CHANGE: f64 = 0.01;

/// More edges than this in one step are cut in the next one.
const MAX_CROSSED_EDGES: usize = 256;

/// How a cut gets its vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CutMethod {
    /// The source's: vertices are moved under the blade and doubled; no triangle is added.
    SnapVertices,
    /// Triangles are split where the blade passes.
    SplitTriangles,
}

/// The result of a step of a blade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutProgress {
    /// Edges that were opened.
    pub opened: usize,
    /// Triangles from the end of the opening to the blade: none when it is there, one when it is among
    /// those around, and one more while the first edge of a slit is pending.
    pub lag: usize,
    /// Distance from the target of the blade to its place on the surface [m]: large when it has
    /// left the surface, passed over a fold, or moved too far for one step.
    pub away: f64,
}

/// A surface with openings, and the blade that makes them.
#[derive(Debug, Clone)]
pub struct CutSurface {
    method: CutMethod,
    limits: Limits,
    net: Net,
    cut_path: Option<CutPath>,
    cuts: Vec<Mark>,
    /// Before the first cut.
    uncut: Mark,
}

impl CutSurface {
    /// `surface`, uncut. The same one must be given to each step.
    pub fn new(surface: &Surface, method: CutMethod) -> Self {
        let mesh = surface.mesh();
        let sum: f64 = mesh
            .triangle_ids()
            .map(|triangle| {
                let [a, b, c] = mesh.positions(triangle);
                (b - a).norm() + (c - b).norm() + (a - c).norm()
            })
            .sum();
        let triangles = mesh.triangles().len();
        let net = Net::new(surface);
        Self {
            method,
            limits: Limits {
                edge: SHORTEST * sum / (3 * triangles) as f64,
                triangles: MAX_GROWTH * triangles,
            },
            uncut: net.mark(),
            net,
            cut_path: None,
            cuts: Vec::with_capacity(MIN_CAPACITY),
        }
    }

    /// Vertices and triangles that it has room for without an allocation.
    pub fn capacity(&self) -> [usize; 2] {
        [self.net.nodes.capacity(), self.net.facets.capacity()]
    }

    /// The triangles with their openings, at rest and without width. Splitting keeps the number of a
    /// triangle for one of its parts.
    pub fn mesh(&self) -> &TriangleMesh {
        &self.net.mesh
    }

    /// The triangle across each edge, where it is not open.
    pub fn across(&self, triangle: TriangleId) -> [Option<TriangleId>; 3] {
        let facet = self.net.facet(triangle);
        [0, 1, 2].map(|edge| facet.open[edge].is_none().then_some(facet.across[edge]))
    }

    /// On which side of an opening the triangle lies, at each edge.
    pub fn sides(&self, triangle: TriangleId) -> [Option<Side>; 3] {
        self.net.facet(triangle).open
    }

    /// The triangle of the surface that this one is part of.
    pub fn parent(&self, triangle: TriangleId) -> TriangleId {
        self.net.facet(triangle).parent
    }

    /// Direction in which an opening pulls a vertex: a unit vector, or zero where nothing opens
    /// [-].
    pub fn opening(&self, node: NodeId) -> Vec3 {
        self.net.nodes[node.index()].opening
    }

    /// The side of a vertex that an opening pulls; of several cuts, that of the one where its
    /// triangles begin, counter-clockwise.
    pub fn side(&self, node: NodeId) -> Option<Side> {
        self.net.nodes[node.index()].side
    }

    /// How many cuts have been made that can be undone.
    pub fn cuts(&self) -> usize {
        self.cuts.len()
    }

    /// Positions of the vertices [m] when those of `surface` are at `moved` [m] and openings are
    /// `width` wide [m]; into `places`, which is cleared.
    ///
    /// # Panics
    /// When `moved` is shorter than the surface's vertices.
    pub fn place(&self, surface: &Surface, moved: &[Vec3], width: f64, places: &mut Vec<Vec3>) {
        places.clear();
        places.extend(self.net.nodes.iter().map(|node| {
            let corners = surface.mesh().corners(node.origin.triangle);
            let mut place = 0.5 * width * node.opening;
            for (corner, weight) in corners.into_iter().zip(node.origin.barycentric) {
                place += weight * moved[corner.index()];
            }
            place
        }));
    }

    /// Puts the blade on the surface at `at` [m], near the triangle `near`.
    ///
    /// # Errors
    /// When a cut is under way, the triangle is not there, or `at` is not finite or not on the surface.
    pub fn begin(
        &mut self,
        surface: &Surface,
        near: TriangleId,
        at: &Vec3,
    ) -> Result<(), CutError> {
        if self.cut_path.is_some() {
            return Err(CutError::UnderWay);
        }
        CutError::of_place(at)?;
        let triangles = self.net.facets.len();
        if near.index() >= triangles {
            return Err(CutError::NoSuchTriangle {
                triangle: near.index(),
                triangles,
            });
        }
        let (triangle, on) = crossing::nearest_of_net(&self.net, near, at);
        let distance_m = (on.position - at).norm();
        let [a, b, c] = self.net.mesh.positions(triangle);
        let edge_m = (b - a).norm().max((c - b).norm()).max((a - c).norm());
        if distance_m > edge_m {
            return Err(CutError::OffSurface { distance_m, edge_m });
        }
        let before = self.net.mark();
        let blade = self.first_vertex(surface, triangle, &on.position);
        self.cut_path = Some(CutPath {
            blade,
            pending: None,
            opened: 0,
            before,
        });
        Ok(())
    }

    /// Moves the blade along the surface towards `to` [m].
    ///
    /// # Errors
    /// When no cut is under way or `to` is not finite; the blade then stays where it is.
    pub fn advance(&mut self, surface: &Surface, to: &Vec3) -> Result<CutProgress, CutError> {
        CutError::of_place(to)?;
        let mut cut_path = self.cut_path.ok_or(CutError::NotBegun)?;
        let before = cut_path.opened;
        self.turn(surface, &mut cut_path, to);
        for _ in 0..MAX_CROSSED_EDGES {
            if !self.pass(surface, &mut cut_path, to) {
                break;
            }
        }
        self.cut_path = Some(cut_path);
        Ok(CutProgress {
            opened: cut_path.opened - before,
            lag: cut_path.lag(),
            away: (to - cut_path.blade.position(&self.net)).norm(),
        })
    }

    /// Lifts the blade. A cut that has opened nothing is taken back. The edges that the whole cut has
    /// opened.
    ///
    /// # Errors
    /// When no cut is under way.
    pub fn end(&mut self, surface: &Surface) -> Result<usize, CutError> {
        let mut cut_path = self.cut_path.take().ok_or(CutError::NotBegun)?;
        self.finish(surface, &mut cut_path);
        if cut_path.opened == 0 {
            self.net.restore(cut_path.before);
        } else {
            self.cuts.push(cut_path.before);
        }
        Ok(cut_path.opened)
    }

    /// Closes the last cut again, as if it had never been. Whether there was one.
    ///
    /// # Errors
    /// When a cut is under way.
    pub fn undo(&mut self) -> Result<bool, CutError> {
        if self.cut_path.is_some() {
            return Err(CutError::UnderWay);
        }
        let last = self.cuts.pop();
        if let Some(mark) = last {
            self.net.restore(mark);
        }
        Ok(last.is_some())
    }

    /// Closes all cuts, and one that is under way, as if they had never been. It allocates nothing.
    pub fn close_all(&mut self) {
        self.cut_path = None;
        self.cuts.clear();
        self.net.restore(self.uncut);
    }
}
