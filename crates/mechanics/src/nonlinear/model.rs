use std::collections::{BTreeSet, HashSet};
use std::ops::Range;

use nalgebra::Matrix3;
use palpate_geometry::TetrahedronMesh;

use super::boundary::{Boundary, SpreadLoad};
use super::cavities::{BodyCavity, Wall};
use super::contact::{AT, BoundaryPoint};
use super::drag::Drag;
use super::elements::{NODES, Pack};
use super::embedded::EmbeddedPoints;
use super::law::Moduli;
use super::relaxation::Relaxation;
use super::rest::{Influence, RestFactors};
use super::state::NonlinearState;
use super::step::Workspace;
use crate::finite_elements::solid::{Face, faces, take_walls};
use crate::finite_elements::{ElementMesh, Mismatch};
use crate::{Error, PronySeries, Vec3};

/// Largest memory of the influences of the nodes that can be loaded [bytes].
pub const MAX_INFLUENCE_BYTES: usize = 1 << 30;

/// A node moves at most by this part of a mean edge in a step, in addition to the continued motion
/// [-].
const FARTHEST: f64 = 0.5;

/// A body of quadratic tetrahedra, fixed at some nodes, with its stiffness at rest in factors.
#[derive(Debug, Clone)]
pub struct NonlinearModel {
    pub(super) packs: Vec<Pack<f32>>,
    pub(super) rest: RestFactors,
    pub(super) relaxation: Option<Relaxation>,
    /// On pieces that nothing fixes.
    pub(super) drag: Drag,
    /// Its cavities.
    pub(super) walls: Vec<Wall>,
    /// Weight on each node [N]; none without gravity. And the body at rest under that and the pressures in its cavities.
    pub(super) weight: Vec<f32>,
    pub(super) settled: Option<Box<NonlinearState>>,
    /// 1/volume of the elements around each node [1/m³].
    pub(super) inverse_volumes: Vec<f32>,
    /// Those of the nodes that can be loaded.
    pub(super) influences: Vec<Influence>,
    /// Place of each node in `influences`.
    pub(super) loaded: Vec<Option<u32>>,
    nodes: Vec<Vec3>,
    /// Largest motion of a node in a step, in addition to the continued motion [m].
    pub(super) farthest: f32,
    mesh: TetrahedronMesh,
    /// Ten nodes for each tetrahedron.
    elements: Vec<u32>,
    boundary: Boundary,
    /// Whether each face of the mesh is one of `boundary`, rather than of the wall of a cavity.
    is_outer: Vec<bool>,
    points: Vec<BoundaryPoint>,
    tool_points: Vec<BoundaryPoint>,
}

impl NonlinearModel {
    /// `moduli` are those of each tetrahedron of `mesh`. Nodes are those of
    /// [`ElementMesh::from_tetrahedra`]; `is_fixed` marks those that cannot move, `can_be_loaded` those that tools may act
    /// on, which costs 36 bytes times the square of their number. A piece of which nothing is fixed is dragged through a
    /// viscous fluid and has no weight.
    ///
    /// # Errors
    /// When a list has another length, nothing is fixed, the influences need more than [`MAX_INFLUENCE_BYTES`], or
    /// the stiffness at rest is not positive.
    pub fn new(
        mesh: &TetrahedronMesh,
        moduli: &[Moduli<f64>],
        is_fixed: impl Fn(usize, &Vec3) -> bool,
        can_be_loaded: impl Fn(usize, &Vec3) -> bool,
    ) -> Result<Self, Error> {
        Self::within(
            &Faces::new(mesh, &[]),
            mesh,
            moduli,
            is_fixed,
            can_be_loaded,
        )
    }

    fn within(
        faces: &Faces,
        mesh: &TetrahedronMesh,
        moduli: &[Moduli<f64>],
        is_fixed: impl Fn(usize, &Vec3) -> bool,
        can_be_loaded: impl Fn(usize, &Vec3) -> bool,
    ) -> Result<Self, Error> {
        if moduli.len() != mesh.tetrahedra().len() {
            return Err(Mismatch::WrongLength {
                what: "the list of the elements' moduli",
                found: moduli.len(),
                expected: mesh.tetrahedra().len(),
            }
            .into());
        }
        let ElementMesh {
            nodes: places,
            elements: numbers,
            ..
        } = ElementMesh::from_tetrahedra(mesh);
        let select = |holds: &dyn Fn(usize, &Vec3) -> bool| -> Vec<bool> {
            let nodes = places.iter().enumerate();
            nodes.map(|(node, place)| holds(node, place)).collect()
        };
        let is_fixed = select(&is_fixed);
        if !is_fixed.contains(&true) {
            return Err(Error::NothingFixed);
        }
        let can_be_loaded = select(&can_be_loaded);
        let list: Vec<u32> = (0..places.len() as u32)
            .filter(|&node| can_be_loaded[node as usize] && !is_fixed[node as usize])
            .collect();
        let needed = 36 * list.len() * places.len();
        if needed > MAX_INFLUENCE_BYTES {
            return Err(Error::NotEnoughMemory {
                needed,
                memory: MAX_INFLUENCE_BYTES,
            });
        }
        let exact = Pack::<f64>::all(mesh, &numbers, moduli);
        let drag = Drag::new(mesh, &numbers, &is_fixed);
        let (rest, influences) = RestFactors::new(&exact, &is_fixed, &drag, &list)?;
        let mut loaded = vec![None; places.len()];
        for (place, &node) in list.iter().enumerate() {
            loaded[node as usize] = Some(place as u32);
        }
        Ok(Self {
            packs: Pack::all(mesh, &numbers, moduli),
            inverse_volumes: inverse_volumes(&exact, places.len()),
            rest,
            relaxation: None,
            drag,
            weight: Vec::new(),
            settled: None,
            influences,
            loaded,
            nodes: places,
            farthest: (FARTHEST * mean_edge(mesh)) as f32,
            boundary: Boundary::new(mesh, &faces.outer)?,
            is_outer: faces.are_outer(),
            points: BoundaryPoint::of_quadrature(mesh, &faces.all, moduli, mean_edge(mesh)),
            tool_points: BoundaryPoint::for_tools(mesh, &faces.outer, moduli, mean_edge(mesh)),
            walls: Vec::new(),
            mesh: mesh.clone(),
            elements: numbers,
        })
    }

    /// As [`Self::new`], fixed on the boundary where `is_fixed` holds of a place [m] of a tetrahedron; tools may act on all
    /// of the boundary.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn on_boundary(
        mesh: &TetrahedronMesh,
        moduli: &[Moduli<f64>],
        is_fixed: impl Fn(usize, &Vec3) -> bool,
    ) -> Result<Self, Error> {
        Self::hollow(mesh, &[], moduli, is_fixed)
    }

    /// As [`Self::on_boundary`], with `cavities`, whose walls are neither fixed nor touched by tools. Pressures act from the first step
    /// on, unless the body comes to rest under them before ([`Self::under_pressure`]).
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn hollow(
        mesh: &TetrahedronMesh,
        cavities: &[BodyCavity],
        moduli: &[Moduli<f64>],
        is_fixed: impl Fn(usize, &Vec3) -> bool,
    ) -> Result<Self, Error> {
        let faces = Faces::new(mesh, cavities);
        let (outer, all) = (nodes(&faces.outer), nodes(&faces.all));
        let ElementMesh { elements, .. } = ElementMesh::from_tetrahedra(mesh);
        let mut owners = vec![0; elements.iter().max().map_or(0, |most| *most as usize + 1)];
        for (place, node) in elements.iter().enumerate() {
            owners[*node as usize] = place / NODES;
        }
        let is_on = |nodes: &[u32], node: usize| nodes.binary_search(&(node as u32)).is_ok();
        let mut model = Self::within(
            &faces,
            mesh,
            moduli,
            |node, place| is_on(&outer, node) && is_fixed(owners[node], place),
            |node, _| is_on(&all, node),
        )?;
        let walls = cavities.iter().zip(&faces.walls);
        let walls =
            walls.map(|(own, wall)| Wall::new(wall, &model.nodes, own.content, own.filling));
        model.walls = walls.collect();
        Ok(model)
    }

    /// The same body of tissues that relax: each element by the one of `series` with its number.
    ///
    /// # Errors
    /// When an element has no such number.
    pub fn relaxing(mut self, series: &[PronySeries], numbers: &[usize]) -> Result<Self, Error> {
        self.relaxation = Relaxation::new(series, numbers, self.mesh.tetrahedra().len())?;
        Ok(self)
    }

    /// Whether any of it relaxes.
    pub fn relaxes(&self) -> bool {
        self.relaxation.is_some()
    }

    /// Places of the nodes at rest [m].
    pub fn nodes(&self) -> &[Vec3] {
        &self.nodes
    }

    /// The tetrahedra.
    pub fn mesh(&self) -> &TetrahedronMesh {
        &self.mesh
    }

    /// Ten nodes for each tetrahedron.
    pub(super) fn elements(&self) -> &[u32] {
        &self.elements
    }

    /// The boundary, which tools load.
    pub fn boundary(&self) -> &Boundary {
        &self.boundary
    }

    /// The points of its boundary that may touch fixed bodies and the boundary itself.
    pub fn boundary_points(&self) -> &[BoundaryPoint] {
        &self.points
    }

    /// The points of its boundary that may touch tools: of each face both [`super::TOOL_POINTS`], one face after the other.
    pub fn tool_points(&self) -> &[BoundaryPoint] {
        &self.tool_points
    }

    /// Volume of a cavity in `state`, and at rest without any load [m³].
    ///
    /// # Panics
    /// When there is no such cavity.
    pub fn cavity_volumes(&self, state: &NonlinearState, cavity: usize) -> [f64; 2] {
        let wall = &self.walls[cavity];
        [wall.volume(&self.nodes, &state.displacements), wall.at_rest]
    }

    /// The volume of the fluid in a cavity over that of the cavity at rest without any load [-]; none without a fluid under
    /// pressure.
    ///
    /// # Panics
    /// When there is no such cavity.
    pub fn filling(&self, cavity: usize) -> Option<f64> {
        self.walls[cavity].filling
    }

    /// The number of its pieces of which nothing is fixed.
    pub fn free_pieces(&self) -> usize {
        self.drag.count
    }

    /// Whether it moves under its weight and the pressures in it, before anything else loads it.
    pub fn is_settled(&self) -> bool {
        self.settled.is_some()
    }

    /// Whether a point of [`Self::boundary_points`] is on the outer boundary, rather than on the wall of a cavity.
    ///
    /// # Panics
    /// When there is no such point.
    pub fn is_outer(&self, point: usize) -> bool {
        self.is_outer[point / AT.len()]
    }

    /// Room for a load on its boundary.
    pub fn spread_load(&self) -> SpreadLoad {
        SpreadLoad::with_capacity(self.nodes.len(), self.boundary.areas().count())
    }

    /// Embeds `points` [m] in the tetrahedra of a range.
    ///
    /// # Errors
    /// When the range is empty.
    pub fn embed(
        &self,
        points: &[Vec3],
        tetrahedra: Range<usize>,
    ) -> Result<EmbeddedPoints, Error> {
        EmbeddedPoints::new(&self.mesh, &self.elements, points, tetrahedra)
    }

    /// Compliance of the weighted mean of `nodes` [m/N], by the factors of the stiffness at rest, turned as the nodes are
    /// in `state`.
    ///
    /// # Panics
    /// When one of the nodes can move and cannot be loaded.
    pub fn compliance(&self, state: &NonlinearState, nodes: &[(u32, f64)]) -> Matrix3<f64> {
        let rotation = |node: u32| {
            let q = &state.rotations[node as usize];
            Matrix3::from_iterator(q.iter().map(|&entry| f64::from(entry)))
        };
        let mut sum = Matrix3::zeros();
        for &(there, weight) in nodes {
            let Some(influence) = self.influence(there) else {
                continue;
            };
            let columns = influence.columns();
            let mut own = Matrix3::zeros();
            for &(here, weight) in nodes {
                let by = Matrix3::from_fn(|i, j| f64::from(columns[j][3 * here as usize + i]));
                own += weight * rotation(here) * by;
            }
            sum += weight * own * rotation(there).transpose();
        }
        sum
    }

    /// The part of [`Self::compliance`] that is the motion of a free piece, in a step of 5 ms [m/N]; zero for what is fixed.
    pub fn drag_compliance(&self, state: &NonlinearState, nodes: &[(u32, f64)]) -> Matrix3<f64> {
        let place = |node: u32| {
            let by = &state.displacements[3 * node as usize..][..3];
            self.nodes[node as usize] + Vec3::from_column_slice(by)
        };
        self.drag.compliance(place, nodes)
    }

    /// Displacements of all nodes from forces on one; none where that is fixed.
    ///
    /// # Panics
    /// When it can move and cannot be loaded: without its influence, steps would not converge.
    #[inline]
    pub(super) fn influence(&self, node: u32) -> Option<&Influence> {
        let place = self.loaded[node as usize];
        assert!(
            place.is_some() || self.rest.is_fixed(node),
            "a tool loads node {node}, which this model was made without"
        );
        place.map(|place| &self.influences[place as usize])
    }

    /// Scratch for [`super::advance`] with at most `tools` tools.
    pub fn workspace(&self, tools: usize) -> Workspace {
        Workspace::new(self, tools)
    }
}

/// The faces of a mesh.
struct Faces {
    all: Vec<Face>,
    /// Those that are not of a wall, and those of the wall of each cavity.
    outer: Vec<Face>,
    walls: Vec<Vec<Face>>,
}

impl Faces {
    fn new(mesh: &TetrahedronMesh, cavities: &[BodyCavity]) -> Self {
        let all = faces(mesh);
        let walls: Vec<_> = cavities.iter().map(|own| own.wall.clone()).collect();
        let mut outer = all.clone();
        let walls = take_walls(&mut outer, &walls);
        Self { all, outer, walls }
    }

    /// Whether each of all is an outer one.
    fn are_outer(&self) -> Vec<bool> {
        let walls = self.walls.iter().flatten();
        let of_walls: HashSet<_> = walls.map(|face| face.corners).collect();
        let all = self.all.iter();
        all.map(|face| !of_walls.contains(&face.corners)).collect()
    }
}

/// The nodes of faces, ascending.
pub(super) fn nodes(faces: &[Face]) -> Vec<u32> {
    let nodes = faces.iter().flat_map(|face| face.nodes);
    let nodes: BTreeSet<u32> = nodes.map(|node| node as u32).collect();
    nodes.into_iter().collect()
}

/// Mean length of the edges [m].
fn mean_edge(mesh: &TetrahedronMesh) -> f64 {
    let edges = mesh.edges();
    let lengths = edges.iter().map(|edge| {
        let [from, to] = edge.map(|node| mesh.vertices()[node.index()]);
        (to - from).norm()
    });
    lengths.sum::<f64>() / edges.len() as f64
}

fn inverse_volumes(packs: &[Pack<f64>], nodes: usize) -> Vec<f32> {
    let mut volumes = vec![0.0; nodes];
    for pack in packs {
        for own in &pack.nodes {
            for (&node, quarter) in own.iter().zip(pack.quarter.0) {
                volumes[node as usize] += 4.0 * quarter;
            }
        }
    }
    let inverse = |volume: f64| (1.0 / volume) as f32;
    volumes.into_iter().map(inverse).collect()
}
