use palpate_files::scene::{Enhancement, EnhancementArea, Smoothing};
use palpate_geometry::{Surface, Vec3};
use palpate_mechanics::contact::Tip;
use palpate_mechanics::enhance::{
    EmbeddedDisplayPoints, EnhancedPatch, EnhancementModel, Press, SurfaceField, SurfacePoint,
};

use crate::Error;
use crate::m03::{Body, MODELS, Pressed};
use crate::rendered_body::{Painter, RenderedBody};
use crate::row::Rows;

/// A picture of the figure.
struct Shown {
    name: &'static str,
    /// Whether the cube is pressed.
    pressed: bool,
    area: EnhancementArea,
    smoothing: Smoothing,
    /// Whether the closed form of the dimple is added, which the source does not have.
    dimple: bool,
}

const fn shown(name: &'static str, area: EnhancementArea, smoothing: Smoothing) -> Shown {
    Shown {
        name,
        pressed: true,
        area,
        smoothing,
        dimple: false,
    }
}

/// The source's (a), (b) and (c), its (c) with each area and each smoothing, and ours.
const PICTURES: [Shown; 9] = [
    Shown {
        pressed: false,
        ..shown("unmodified", EnhancementArea::None, Smoothing::None)
    },
    shown("coarse", EnhancementArea::None, Smoothing::None),
    shown("edge", EnhancementArea::Edge, Smoothing::None),
    shown("edge_shepard", EnhancementArea::Edge, Smoothing::Shepard),
    shown("vertex", EnhancementArea::Vertex, Smoothing::None),
    shown(
        "vertex_shepard",
        EnhancementArea::Vertex,
        Smoothing::Shepard,
    ),
    shown(
        "edge_moving_least_squares",
        EnhancementArea::Edge,
        Smoothing::MovingLeastSquares,
    ),
    shown(
        "vertex_moving_least_squares",
        EnhancementArea::Vertex,
        Smoothing::MovingLeastSquares,
    ),
    Shown {
        dimple: true,
        ..shown(
            "vertex_shepard_dimple",
            EnhancementArea::Vertex,
            Smoothing::Shepard,
        )
    },
];

/// Each triangle becomes 64.
const LEVELS: usize = 3;

/// How deep a triangle is pressed in [m]: two fifths of the cube.
const DEPTH: f64 = 40e-3;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let Some(mut painter) = Painter::or_missing(rows, &PICTURES.map(|shown| shown.name)) else {
        return Ok(());
    };
    let cube = Body::new(MODELS[0])?;
    let pressed = Pressed::new(&cube, DEPTH)?;
    for shown in PICTURES {
        let (surface, places) = enhanced(&cube.surface, &pressed, &shown)?;
        let png = painter.draw(&RenderedBody {
            surface: &surface,
            places: &places,
            middle: (pressed.place, pressed.normal),
            near: 0.62,
            lines: Some(1.2e-4),
        })?;
        rows.figure(shown.name)
            .with("body", &cube.description)
            .with("depth", 1e3 * DEPTH)
            .with("smoothing", shown.smoothing)
            .with("dimple", shown.dimple)
            .with("triangles", surface.mesh().triangles().len())
            .with("adapter", painter.gpu.adapter())
            .picture(&png)?;
    }
    Ok(())
}

/// The surface with the patch in it at rest, and where its vertices [m] are when it is pressed.
fn enhanced(
    coarse: &Surface,
    pressed: &Pressed,
    shown: &Shown,
) -> Result<(Surface, Vec<Vec3>), Error> {
    let settings = Enhancement {
        area: shown.area,
        levels: LEVELS,
        smoothing: shown.smoothing,
    };
    let model = EnhancementModel::new(coarse.clone(), settings)?;
    // As large as the triangle.
    let area = coarse.mesh().area_vector(pressed.triangle).norm();
    let radius = (area / std::f64::consts::PI).sqrt();
    let press = Press {
        at: SurfacePoint::centroid(pressed.triangle),
        tip: Tip::Flat { radius },
        displacement: -DEPTH * pressed.normal,
        own: -DEPTH * pressed.normal,
    };
    let presses = if shown.dimple { &[press][..] } else { &[] };
    let still = vec![Vec3::zeros(); pressed.displacements.len()];
    let displacements = if shown.pressed {
        &pressed.displacements
    } else {
        &still
    };
    let mut field = SurfaceField::default();
    field.update(model.interpolation(), displacements, presses);
    let mut patch = EnhancedPatch::default();
    patch.build(&model, &[pressed.triangle]);
    let mut of_patch = vec![Vec3::zeros(); patch.places().len()];
    patch.displace(&field, &mut of_patch);
    let mut moved = vec![Vec3::zeros(); coarse.mesh().vertices().len()];
    EmbeddedDisplayPoints::of_vertices(model.interpolation()).interpolate(&field, &mut moved);
    // Its first points are vertices of the coarse mesh.
    moved.extend_from_slice(&of_patch[patch.corners().len()..]);
    let whole = patch.in_mesh(coarse.mesh(), patch.places());
    let places = whole.vertices().iter().zip(&moved).map(|(x, u)| x + u);
    let places = places.collect();
    Ok((Surface::new(whole)?, places))
}
