//! Pictures of bodies without a scene.

use palpate_files::scene::Shading;
use palpate_geometry::{Surface, Vec3};
use palpate_viewer::{
    Body, FRAME_SIZE, Gpu, Looks, Orbit, Renderer, Target, Tint, View, png, single_precision,
};

use crate::Error;
use crate::row::Rows;
use crate::wire_frame::wire_frame;

/// A body, and where it is now.
pub(super) struct RenderedBody<'a> {
    /// At rest.
    pub(super) surface: &'a Surface,
    /// Its vertices [m].
    pub(super) places: &'a [Vec3],
    /// What is in the middle of the picture [m], and the unit normal there [-].
    pub(super) middle: (Vec3, Vec3),
    /// Part of the way from where the whole fills the picture [-].
    pub(super) near: f64,
    /// Width of the lines along the edges of its triangles [m]; none without lines.
    pub(super) lines: Option<f64>,
}

/// Who draws them.
pub(super) struct Painter {
    pub(super) gpu: Gpu,
    renderer: Renderer,
    target: Target,
}

impl Painter {
    /// Fails when there is no adapter.
    fn new() -> Result<Self, palpate_viewer::Error> {
        let gpu = Gpu::open()?;
        Ok(Self {
            renderer: Renderer::new(&gpu),
            target: Target::new(&gpu, FRAME_SIZE, 4),
            gpu,
        })
    }

    /// Or, where there is no adapter, rows `names` that say so.
    pub(super) fn or_missing(rows: &mut Rows<'_>, names: &[&str]) -> Option<Self> {
        let made = Self::new();
        if let Err(why) = &made {
            names.iter().for_each(|name| rows.row(name).missing(why));
        }
        made.ok()
    }

    /// As a PNG file.
    pub(super) fn draw(&mut self, sitter: &RenderedBody<'_>) -> Result<Vec<u8>, Error> {
        let mesh = sitter.surface.mesh();
        let mut body = Body::new(&self.gpu, sitter.surface, Tint::MUSCLE);
        body.deform(&self.gpu, &single_precision(sitter.places));
        let lines = match sitter.lines {
            Some(width) => Some(wire_frame(mesh, sitter.places, width)?),
            None => None,
        };
        let lines = lines.map(|lines| Body::of_mesh(&self.gpu, &lines, Tint::WIRE));
        let bodies: Vec<&Body> = std::iter::once(&body).chain(&lines).collect();
        let aspect = f64::from(FRAME_SIZE.0) / f64::from(FRAME_SIZE.1);
        let mut orbit = Orbit::framing(mesh, 0.785, aspect);
        let (middle, side) = sitter.middle;
        orbit.target = middle;
        // Turned with the normal, if that has a direction around the vertical.
        if side.xy().norm() > 0.5 {
            orbit.azimuth += side.x.atan2(-side.y);
        }
        orbit.elevation += 0.15 * side.z.clamp(-1.0, 1.0).asin();
        orbit.distance *= sitter.near;
        let camera = orbit.camera();
        let (low, high) = mesh.bounds();
        let view = View {
            camera,
            shading: Shading::Plain,
            looks: Looks::NONE,
            reach: (high - low).norm(),
        };
        self.renderer
            .draw(&self.gpu, &view, &bodies, &[], &self.target);
        Ok(png(&self.target.read(&self.gpu)?)?)
    }
}
