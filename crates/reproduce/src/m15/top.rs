use palpate_files::Scene;
use palpate_files::scene::Shading;
use palpate_geometry::{AabbTree, CutError, CutMethod, CutSurface, Vec3};
use palpate_simulate::{Simulation, SimulationState};
use palpate_viewer::{Body, FRAME_SIZE, OpenedSurface, Studio, Tint, png};

use crate::Error;
use crate::row::Rows;
use crate::wire_frame::wire_frame;

/// Half of an edge of the cube [m]: its upper side.
const TOP: f64 = 0.05;

/// The upper side of the cube, and the studio in which it is cut.
pub(super) struct Top {
    simulation: Simulation,
    state: SimulationState,
    studio: Studio,
}

/// How a picture is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Look {
    pub(super) shading: Shading,
    /// Width of an opening [m].
    pub(super) width: f64,
    /// Width of the wires [m]; none without.
    pub(super) wires: Option<f64>,
}

impl Top {
    /// Of a cube of about so many triangles, seen from `eye` [m].
    pub(super) fn new(triangles: usize, eye: [f64; 3]) -> Result<Self, Error> {
        let [x, y, z] = eye;
        let text = format!(
            "format = 1\n[organ]\nbuiltin = \"cube\"\ntriangles = {triangles}\n\
             builtin_tissue = \"pig-esophagus\"\n\
             [view]\neye_m = [{x:?}, {y:?}, {z:?}]\ntarget_m = [0.0, 0.0, {TOP:?}]\n"
        );
        let scene = Scene::parse(&text, "built-in scene")?;
        let simulation = Simulation::new(&scene)?;
        Ok(Self {
            state: SimulationState::new(&simulation),
            studio: Studio::new(&scene, &simulation, FRAME_SIZE)?,
            simulation,
        })
    }

    /// A blade on `way` (x, y) [m], which is not lifted, in as many steps of half a millimetre as that takes; the
    /// largest lag behind it [triangles].
    pub(super) fn cut(
        &self,
        method: CutMethod,
        way: &[(f64, f64)],
    ) -> Result<(CutSurface, usize), CutError> {
        let surface = self.simulation.surface();
        let mut cut = CutSurface::new(surface, method);
        let places: Vec<Vec3> = way.iter().map(|&(x, y)| Vec3::new(x, y, TOP)).collect();
        let tree = AabbTree::new(surface.mesh());
        cut.begin(
            surface,
            tree.nearest(surface.mesh(), &places[0]).triangle,
            &places[0],
        )?;
        let mut lag = 0;
        for pair in places.windows(2) {
            let way = pair[1] - pair[0];
            let steps = (way.norm() / 5e-4).ceil() as u32;
            for step in 1..=steps {
                let to = pair[0] + way * (f64::from(step) / f64::from(steps));
                lag = lag.max(cut.advance(surface, &to)?.lag);
            }
        }
        Ok((cut, lag))
    }

    /// Adds the picture `name` of `cut`.
    pub(super) fn add(
        &mut self,
        rows: &mut Rows<'_>,
        name: &str,
        cut: &CutSurface,
        look: Look,
    ) -> Result<(), Error> {
        let surface = self.simulation.surface();
        let moved = surface.mesh().vertices();
        let open = OpenedSurface::new(cut, surface, moved, look.width);
        self.studio.view.shading = look.shading;
        self.studio.view.looks.relief = look.shading != Shading::Plain;
        self.studio.other_bodies.clear();
        if let Some(width) = look.wires {
            let wires = wire_frame(open.mesh(), open.places(), width).map_err(Error::failed)?;
            let body = Body::of_mesh(&self.studio.gpu, &wires, Tint::WIRE);
            self.studio.other_bodies.push(body);
        }
        let is_cut = !open.drawn().rims.is_empty();
        let picture = self
            .studio
            .picture_of(&self.state, is_cut.then_some(open.drawn()))?;
        let adapter = self.studio.gpu.adapter();
        let figure = rows.figure(name).with("adapter", adapter);
        figure.picture(&png(&picture)?)
    }
}

/// Without an adapter a figure's row says so.
pub(super) fn or_missing(rows: &mut Rows<'_>, made: Result<(), Error>) -> Result<(), Error> {
    match made {
        Err(why) if !why.is_input() => {
            rows.row("pictures").missing(why);
            Ok(())
        }
        other => other,
    }
}
