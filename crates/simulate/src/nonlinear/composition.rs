//! The composition of an organ and the bodies that bend around it, independent of their current elements.

use std::ops::ControlFlow;

use palpate_files::Scene;
use palpate_files::scene::Region;
use palpate_geometry::{
    AabbTree, HollowMesh, NodeId, Surface, TetrahedronError, TetrahedronMesh, TriangleMesh, Vec3,
};
use palpate_mechanics::PronySeries;
use palpate_mechanics::nonlinear::{
    EmbeddedPoints, NonlinearModel, NonlinearState, TouchingBoundary,
};

use super::ContactBodies;
use super::anchor::Anchor;
use super::filling::{grading, tetrahedra};
use super::local_compliance::WallField;
use super::merged::Merged;
use super::mesh_warnings::mesh_warnings;
use super::regions::Elements;
use super::soft::{Piece, SoftBody, touching};
use crate::neighbour::Neighbour;
use crate::regions::Regions;
use crate::{Error, fixed_region};

/// Approximate number of nodes, if the scene does not state it; more with cavities, whose walls have few elements.
const NODES: usize = 1_500;
const NODES_HOLLOW: usize = 2_500;

/// Iterations in a step: below this Poisson's ratio [-], and from it on (`docs/theory/large_deformation.md`).
const ITERATIONS: (usize, usize) = (4, 6);
const NEARLY_INCOMPRESSIBLE: f64 = 0.46;

/// The composition of an organ.
#[derive(Debug, Clone)]
pub(super) struct Composition {
    /// The display mesh of the organ and all bodies that bend.
    surface: Surface,
    pub(super) shown: Surface,
    pub(super) tree: AabbTree,
    /// The walls under the displayed surface.
    pub(super) walls: WallField,
    /// The fixed region of the organ.
    anchor: Region,
    soft: Vec<SoftBody>,
    pub(super) neighbours: Vec<Neighbour>,
    /// The organ, then the neighbours that bend: for tools, and their elements without cuts.
    pub(super) pieces: Vec<Piece>,
    pub(super) filled: Vec<Filled>,
    /// Relaxation of the tissues of all of them.
    series: Vec<PronySeries>,
    /// [m/s²]
    gravity: Option<Vec3>,
    /// Coulomb friction coefficient of the organ on itself, if it has self-contact [-].
    on_itself: Option<f64>,
    /// Approximate number of nodes of all of them.
    pub(super) nodes: usize,
    pub(super) iterations: usize,
    /// Diagonal of its bounds [m]: no part of it moves farther.
    pub(super) size: f64,
}

/// The elements of a piece. Those in a cavity have a region of the mesh, from 1, and no tissue.
#[derive(Debug, Clone)]
pub(super) struct Filled {
    pub(super) mesh: TetrahedronMesh,
    pub(super) elements: Elements,
}

impl Filled {
    /// A mesh of about `nodes` nodes within `surface`, and shorter edges by the factor `finer` [-].
    fn new(
        surface: &Surface,
        nodes: usize,
        regions: &Regions,
        finer: impl Fn(&Vec3) -> f64,
        on_progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Self, Error> {
        let (mesh, warnings) = tetrahedra(surface, nodes, regions, finer, on_progress)?;
        let mut elements = regions.of_elements(&mesh);
        elements.warnings.extend(warnings);
        Ok(Self { mesh, elements })
    }

    /// Its mesh without the cavities from 1 to `cavities`.
    pub(super) fn hollow(&self, cavities: usize) -> Result<HollowMesh, TetrahedronError> {
        let numbers: Vec<u32> = (1..=cavities as u32).collect();
        self.mesh.without(&numbers)
    }
}

impl Composition {
    /// The composition of the organ of `scene` with this surface and its tissues, displayed as `shown` together with
    /// the neighbours that bend; with warnings.
    pub(super) fn new(
        scene: &Scene,
        shown: &Surface,
        tree: &AabbTree,
        surface: &Surface,
        regions: Regions,
        contact_bodies: ContactBodies<'_>,
        on_progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(Self, Vec<String>), Error> {
        let ContactBodies {
            tools,
            soft,
            neighbours,
        } = contact_bodies;
        let nodes = scene
            .model
            .nodes
            .unwrap_or(match regions.cavities.is_empty() {
                true => NODES,
                false => NODES_HOLLOW,
            });
        let bodies = 1.0 + soft.len() as f64;
        let mut of_organ = |part| on_progress(part / bodies);
        let finer = grading(surface, nodes);
        let organ = Filled::new(surface, nodes, &regions, finer, &mut of_organ)?;
        let mut filled = vec![organ];
        let mut series = regions.series();
        for (number, body) in soft.iter().enumerate() {
            let mut of_body = |part| on_progress((1.0 + number as f64 + part) / bodies);
            let Filled { mesh, elements } = Filled::new(
                &body.surface,
                body.nodes,
                &body.regions,
                |_| 1.0,
                &mut of_body,
            )?;
            let elements = elements.numbered_from(series.len());
            filled.push(Filled { elements, mesh });
            series.extend(body.regions.series());
        }
        let mut warnings: Vec<String> = filled
            .iter_mut()
            .flat_map(|own| std::mem::take(&mut own.elements.warnings))
            .collect();
        let ratios = soft.iter().map(|body| body.regions.largest_ratio());
        let ratio = ratios.fold(regions.largest_ratio(), f64::max);
        let (low, high) = shown.mesh().bounds();
        let of_tissues = regions.nonlinear_warnings.clone();
        let mut walls = WallField::default();
        let anchor = fixed_region(&scene.organ.shape, scene.organ.anchor.as_ref());
        walls.extend(surface, &regions, |place| anchor.contains((*place).into()));
        for body in soft {
            walls.extend(&body.surface, &body.regions, |place| body.is_fixed(place));
        }
        let composition = Self {
            pieces: Piece::all(surface, regions, soft, tools),
            surface: surface.clone(),
            shown: shown.clone(),
            tree: tree.clone(),
            walls,
            anchor,
            soft: soft.to_vec(),
            neighbours: neighbours.to_vec(),
            series,
            gravity: scene.model.gravity_m_per_s2.map(Vec3::from),
            on_itself: scene
                .organ
                .self_contact
                .then_some(scene.organ.self_friction),
            iterations: match ratio < NEARLY_INCOMPRESSIBLE {
                true => ITERATIONS.0,
                false => ITERATIONS.1,
            },
            nodes: nodes + soft.iter().map(|body| body.nodes).sum::<usize>(),
            size: (high - low).norm(),
            filled,
        };
        let meshes = composition.filled.iter().map(|own| &own.mesh);
        let wanted = std::iter::once(nodes).chain(soft.iter().map(|body| body.nodes));
        let anchors = composition.anchors();
        let surfaces = composition.surfaces();
        for (((mesh, nodes), anchor), surface) in meshes.zip(wanted).zip(&anchors).zip(surfaces) {
            warnings.extend(mesh_warnings(surface, nodes, mesh, anchor));
        }
        drop(anchors);
        warnings.extend(of_tissues);
        Ok((composition, warnings))
    }

    /// The surfaces of the pieces.
    fn surfaces(&self) -> impl Iterator<Item = &Surface> {
        let soft = self.soft.iter().map(|body| &body.surface);
        std::iter::once(&self.surface).chain(soft)
    }

    /// The fixed regions of the pieces.
    pub(super) fn anchors(&self) -> Vec<Anchor<'_>> {
        let organ = Anchor::new(&self.surface, |place| self.anchor.contains((*place).into()));
        let soft = self.soft.iter();
        let soft = soft.map(|body| Anchor::new(&body.surface, |place| body.is_fixed(place)));
        std::iter::once(organ).chain(soft).collect()
    }

    /// The model of its pieces with these elements; the amount of fluids is that in the `whole` body if these are parts
    /// of it.
    pub(super) fn model(
        &self,
        merged: &Merged,
        whole: Option<&NonlinearModel>,
    ) -> Result<NonlinearModel, Error> {
        let anchors = self.anchors();
        let is_fixed = |tetrahedron: usize, place: &Vec3| {
            anchors[merged.pieces[tetrahedron] as usize].is_fixed(place)
        };
        let Elements {
            moduli,
            numbers,
            densities,
            ..
        } = &merged.elements;
        let mut cavities = merged.cavities.clone();
        for (number, own) in cavities.iter_mut().enumerate() {
            own.filling = whole.and_then(|whole| whole.filling(number));
        }
        let model = NonlinearModel::hollow(&merged.mesh, &cavities, moduli, is_fixed)?
            .relaxing(&self.series, numbers)?;
        let settled = match &self.gravity {
            Some(gravity) => model.under_gravity(densities, gravity),
            None => model.under_pressure(),
        };
        let is_pressed = cavities.iter().any(|own| own.content.own_pressure() != 0.0);
        settled.map_err(|error| match error {
            palpate_mechanics::Error::InvalidResponse { .. } if is_pressed => Error::CavityPressure,
            other => other.into(),
        })
    }

    /// The vertices of the displayed surface, each embedded in the elements of its piece, `aside` of cuts.
    pub(super) fn embed(
        &self,
        model: &NonlinearModel,
        merged: &Merged,
        aside: impl Fn(&Vec3) -> Vec3,
    ) -> Result<EmbeddedPoints, Error> {
        let mut embedded = EmbeddedPoints::default();
        let mut vertices = self.shown.mesh().vertices();
        for (surface, range) in self.surfaces().zip(&merged.ranges) {
            let (own, others) = vertices.split_at(surface.mesh().vertices().len());
            let own: Vec<Vec3> = own.iter().map(&aside).collect();
            embedded.extend(model.embed(&own, range.clone())?);
            vertices = others;
        }
        Ok(embedded)
    }

    /// The displayed surface and its boxes as all of it hangs under its weight and the pressures in its cavities, if
    /// there are any.
    pub(super) fn hangs(
        &self,
        model: &NonlinearModel,
        embedded: &EmbeddedPoints,
    ) -> Option<(TriangleMesh, AabbTree)> {
        if !model.is_settled() {
            return None;
        }
        let rest = NonlinearState::at_rest(model, 0);
        let mut mesh = self.shown.mesh().clone();
        let vertices = self.shown.mesh().vertices().iter();
        for (number, (from, by)) in vertices.zip(embedded.displacements(&rest)).enumerate() {
            mesh.move_vertex(NodeId(number as u32), from + by);
        }
        let tree = AabbTree::new(&mesh);
        Some((mesh, tree))
    }

    /// The contact of the pieces with one another, and of the organ with itself if the scene says so; none without any
    /// contact.
    pub(super) fn touching(
        &self,
        model: &NonlinearModel,
        merged: &Merged,
    ) -> Result<Option<TouchingBoundary>, Error> {
        touching(self.on_itself, model, merged, &self.soft)
    }
}
