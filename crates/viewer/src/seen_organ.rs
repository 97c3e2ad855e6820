use palpate_files::scene::Enhancement;
use palpate_geometry::Vec3;
use palpate_simulate::{EnhancedSurface, OrganField, Simulation};

use crate::render::openness::openness;
use crate::render::{Body, Tint, single_precision};
use crate::{Error, Gpu};

/// The organ that is touched, as it is drawn: with the simulation's vertices, or with finer triangles around
/// the tips.
pub(crate) struct SeenOrgan {
    pub(crate) body: Body,
    enhanced: Option<EnhancedSurface>,
    tint: Tint,
    /// How open the vertices of the surface are to light from all sides [-].
    open: Vec<f32>,
}

impl SeenOrgan {
    /// At rest, as the scene wants it shown.
    ///
    /// # Errors
    /// When the scene wants too many levels.
    pub(crate) fn new(gpu: &Gpu, simulation: &Simulation, tint: Tint) -> Result<Self, Error> {
        let surface = simulation.surface();
        let open = openness(surface);
        let mut organ = Self {
            body: Body::with_openness(gpu, surface.mesh(), &open, tint),
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
        self.body = Body::with_openness(gpu, mesh, &self.open, self.tint);
        Ok(())
    }

    /// Moves it to `vertices` [m], or to where `whole` has what takes their place.
    pub(crate) fn deform(&mut self, gpu: &Gpu, vertices: &[[f32; 3]], whole: Option<&OrganField>) {
        let (Some(enhanced), Some(field)) = (&mut self.enhanced, whole) else {
            return self.body.deform(gpu, vertices);
        };
        if enhanced.follow(field) {
            let new = enhanced.new_vertices().map(|(nodes, shares)| {
                let open = nodes.map(|node| f64::from(self.open[node.index()]));
                Vec3::from(open).dot(&Vec3::from(shares)) as f32
            });
            let open: Vec<f32> = self.open.iter().copied().chain(new).collect();
            self.body = Body::with_openness(gpu, enhanced.mesh(), &open, self.tint);
        }
        self.body.deform(gpu, &single_precision(enhanced.places()));
    }
}
