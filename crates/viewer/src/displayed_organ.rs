use palpate_files::scene::Enhancement;
use palpate_geometry::{Surface, Vec3};
use palpate_simulate::interactive::OpenedSnapshot;
use palpate_simulate::{EnhancedSurface, OrganField, Simulation};

use crate::displayed_cut::{CutLayers, DisplayedCut};
use crate::render::ambient_light::ambient_light;
use crate::render::{Body, Tint, single_precision};
use crate::{Error, Gpu};

/// How deep and how wide a cut is that somebody shows on an organ which nothing cuts [m].
const CUT_DEPTH: f64 = 0.0015;
const CUT_WIDTH: f64 = 0.0015;

/// The organ that is touched, as it is drawn: with the simulation's vertices, with finer triangles around
/// the tips, or with what was cut.
pub(crate) struct DisplayedOrgan {
    body: Body,
    /// Once there was a cut.
    cut: Option<DisplayedCut>,
    /// Layers that cuts go through.
    layers: CutLayers,
    /// Whether the last picture was of a cut organ.
    is_open: bool,
    enhanced: Option<EnhancedSurface>,
    tint: Tint,
    /// How open the vertices of the surface are to light from all sides [-].
    open: Vec<f32>,
}

impl DisplayedOrgan {
    /// At rest, as the scene wants it shown.
    ///
    /// # Errors
    /// When the scene wants too many levels.
    pub(crate) fn new(gpu: &Gpu, simulation: &Simulation, tint: Tint) -> Result<Self, Error> {
        let surface = simulation.surface();
        let open = ambient_light(surface);
        let mut organ = Self {
            body: Body::with_ambient_light(gpu, surface.mesh(), &open, tint),
            cut: None,
            layers: CutLayers::of(simulation, CUT_DEPTH, CUT_WIDTH),
            is_open: false,
            enhanced: None,
            tint,
            open,
        };
        if let Some(wanted) = simulation.enhancement() {
            organ.enhance(gpu, simulation, *wanted)?;
        }
        Ok(organ)
    }

    /// Shows it otherwise from now on.
    ///
    /// # Errors
    /// When there are too many levels.
    pub(crate) fn enhance(
        &mut self,
        gpu: &Gpu,
        simulation: &Simulation,
        wanted: Enhancement,
    ) -> Result<(), Error> {
        self.enhanced = EnhancedSurface::new(simulation, wanted)?;
        let mesh = simulation.surface().mesh();
        self.body = Body::with_ambient_light(gpu, mesh, &self.open, self.tint);
        Ok(())
    }

    /// The bodies to draw.
    pub(crate) fn bodies(&self) -> impl Iterator<Item = &Body> {
        let cut = self.cut.as_ref().filter(|_| self.is_open);
        let whole = cut.is_none().then_some(&self.body);
        whole
            .into_iter()
            .chain(cut.into_iter().flat_map(DisplayedCut::bodies))
    }

    /// Shows `opening` in place of the uncut surface, whose vertices are at `vertices` [m].
    pub(crate) fn open(
        &mut self,
        gpu: &Gpu,
        opening: &OpenedSnapshot,
        surface: &Surface,
        vertices: &[[f32; 3]],
    ) {
        let cut = self
            .cut
            .get_or_insert_with(|| DisplayedCut::new(gpu, surface, &self.layers, self.tint));
        cut.follow(gpu, opening, surface, vertices, &self.open);
        self.is_open = true;
    }

    /// Forgets what was cut.
    pub(crate) fn close(&mut self) {
        self.cut = None;
        self.is_open = false;
    }

    /// Moves it to `vertices` [m], or to where `whole` has what takes their place; nothing is cut.
    pub(crate) fn deform(&mut self, gpu: &Gpu, vertices: &[[f32; 3]], whole: Option<&OrganField>) {
        self.is_open = false;
        let (Some(enhanced), Some(field)) = (&mut self.enhanced, whole) else {
            return self.body.deform(gpu, vertices);
        };
        if enhanced.follow(field) {
            let new = enhanced.new_vertices().map(|(nodes, shares)| {
                let open = nodes.map(|node| f64::from(self.open[node.index()]));
                Vec3::from(open).dot(&Vec3::from(shares)) as f32
            });
            let open: Vec<f32> = self.open.iter().copied().chain(new).collect();
            self.body = Body::with_ambient_light(gpu, enhanced.mesh(), &open, self.tint);
        }
        self.body.deform(gpu, &single_precision(enhanced.places()));
    }
}
