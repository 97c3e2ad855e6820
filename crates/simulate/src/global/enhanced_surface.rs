use palpate_files::scene::{Enhancement, EnhancementArea};
use palpate_geometry::{NodeId, TriangleId, TriangleMesh, Vec3};
use palpate_mechanics::contact::Tip;
use palpate_mechanics::enhance::{
    EmbeddedDisplayPoints, EnhancedPatch, EnhancementModel, Press, SurfaceField,
};

use super::deform::moved;
use crate::grip::Swept;
use crate::state::ToolState;
use crate::tool::Tool;
use crate::{Error, Simulation};

/// The displacement field of a displayed organ-scale model, at one instant.
#[derive(Debug, Clone, PartialEq)]
pub struct OrganField {
    /// Displacements of the mechanical triangles [m].
    pub(crate) displacements: Vec<Vec3>,
    /// Per tool, if it touches.
    pub(crate) contacts: Vec<Option<DisplayedContact>>,
}

/// A tool that touches the displayed surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DisplayedContact {
    pub(crate) triangle: TriangleId,
    /// Its contact point, at rest [m].
    pub(crate) place: Vec3,
    /// Its action on the mechanical surface.
    pub(crate) press: Press,
}

impl OrganField {
    /// The field of an untouched organ; none without an organ-scale model.
    pub(crate) fn at_rest(simulation: &Simulation) -> Option<Self> {
        let global = simulation.global.as_ref()?;
        Some(Self {
            displacements: vec![Vec3::zeros(); global.response.parts().triangles],
            contacts: vec![None; simulation.tools.len()],
        })
    }

    /// Resets to an untouched organ. It allocates nothing.
    pub(crate) fn return_to_rest(&mut self) {
        self.displacements.fill(Vec3::zeros());
        self.contacts.fill(None);
    }

    /// Copies `other`, which is of the same simulation; nothing is allocated.
    pub(crate) fn copy(&mut self, other: &Self) {
        self.displacements.copy_from_slice(&other.displacements);
        self.contacts.copy_from_slice(&other.contacts);
    }
}

impl DisplayedContact {
    /// For a tool whose jaws hold the organ: the faces of the jaws move it like a flat tip of their area.
    pub(super) fn of_hold(tool: &Tool, state: &ToolState) -> Option<Self> {
        let (hold, jaws) = (state.grip.grasp.as_ref()?, tool.jaws?);
        let radius = (Swept::face(&jaws) / std::f64::consts::PI).sqrt();
        let press = Press {
            at: hold.displayed.at?,
            tip: Tip::Flat { radius },
            displacement: hold.displaced(),
            own: Vec3::zeros(),
        };
        Some(Self {
            triangle: hold.displayed.triangle,
            place: hold.displayed.place,
            press,
        })
    }

    /// For a tool whose tip touches.
    pub(super) fn of(tool: &Tool, state: &ToolState) -> Option<Self> {
        let contact = state.contact.as_ref()?;
        let press = Press {
            at: state.site?,
            tip: tool.tip,
            displacement: state.displaced,
            own: state.own,
        };
        Some(Self {
            triangle: contact.place.triangle,
            place: contact.point(),
            press,
        })
    }
}

/// The displayed surface of an organ-scale model, refined around its contacts: computed from the field of a simulation,
/// at the display's rate, by no thread of the touch.
#[derive(Debug, Clone)]
pub struct EnhancedSurface {
    model: EnhancementModel,
    /// Displacements of the vertices without a patch.
    carrier: EmbeddedDisplayPoints,
    field: SurfaceField,
    patch: EnhancedPatch,
    touched: Vec<TriangleId>,
    presses: Vec<Press>,
    displacements: Vec<Vec3>,
    of_patch: Vec<Vec3>,
    /// At rest.
    mesh: TriangleMesh,
    places: Vec<Vec3>,
}

impl EnhancedSurface {
    /// With these `settings`; none if the simulation moves the same vertices by itself, or has no organ-scale model.
    ///
    /// # Errors
    /// When there are too many levels.
    pub fn new(simulation: &Simulation, settings: Enhancement) -> Result<Option<Self>, Error> {
        let Some(global) = &simulation.global else {
            return Ok(None);
        };
        let own = global.enhancement.settings();
        if settings.area == EnhancementArea::None && settings.smoothing == own.smoothing {
            return Ok(None);
        }
        let model = global.enhancement.with_settings(settings)?;
        let mesh = model.surface().mesh().clone();
        Ok(Some(Self {
            carrier: model.carrier(),
            field: SurfaceField::default(),
            patch: EnhancedPatch::default(),
            touched: Vec::new(),
            presses: Vec::new(),
            displacements: vec![Vec3::zeros(); mesh.vertices().len()],
            of_patch: Vec::new(),
            places: mesh.vertices().to_vec(),
            mesh,
            model,
        }))
    }

    /// Updates to `field`; returns whether its triangles have changed.
    ///
    /// # Panics
    /// When the field is that of another organ.
    pub fn follow(&mut self, field: &OrganField) -> bool {
        let contacts = field.contacts.iter().flatten();
        let touched = contacts.clone().map(|contact| contact.triangle);
        let refines = self.model.settings().area != EnhancementArea::None;
        let anew = refines && !self.touched.iter().copied().eq(touched.clone());
        if anew {
            self.touched.clear();
            self.touched.extend(touched);
            self.patch.build(&self.model, &self.touched);
            let surface = self.model.surface();
            self.mesh = self.patch.in_mesh(surface.mesh(), self.patch.places());
        }
        self.presses.clear();
        self.presses.extend(contacts.map(|contact| Press {
            // A curved patch covers the contact, and has to meet the tip as well.
            displacement: contact.press.displacement + contact.place
                - self.patch.nearest(&contact.place),
            ..contact.press
        }));
        let interpolation = self.model.interpolation();
        self.field
            .update(interpolation, &field.displacements, &self.presses);
        self.carry();
        anew
    }

    /// At rest: the vertices of the displayed surface, then those of the finer triangles.
    pub fn mesh(&self) -> &TriangleMesh {
        &self.mesh
    }

    /// Current positions of the vertices of [`Self::mesh`] [m].
    pub fn places(&self) -> &[Vec3] {
        &self.places
    }

    /// The new vertices, as means of three vertices of the displayed surface with weights [-].
    pub fn new_vertices(&self) -> impl Iterator<Item = ([NodeId; 3], [f64; 3])> {
        let shown = self.model.surface().mesh();
        let new = &self.patch.sites()[self.patch.corners().len()..];
        new.iter()
            .map(|at| (shown.corners(at.triangle), at.barycentric))
    }

    fn carry(&mut self) {
        let shown = self.carrier.places().len();
        self.displacements.truncate(shown);
        self.carrier
            .interpolate(&self.field, &mut self.displacements);
        self.of_patch
            .resize(self.patch.places().len(), Vec3::zeros());
        self.patch.displace(&self.field, &mut self.of_patch);
        let new = &self.of_patch[self.patch.corners().len()..];
        self.displacements.extend_from_slice(new);
        self.places.clear();
        let vertices = self.mesh.vertices().iter().zip(&self.displacements);
        self.places
            .extend(vertices.map(|(from, by)| moved(from, by)));
    }
}
