use palpate_files::scene::{Enhancement, EnhancementArea, Smoothing};
use palpate_geometry::{Surface, Vec3};
use palpate_mechanics::contact::Tip;
use palpate_mechanics::enhance::{
    Carrier, EnhancedPatch, EnhancementModel, Press, SurfaceField, SurfacePoint,
};

use crate::failure::Failure;
use crate::reproduce::m03::{Body, MODELS, Pressed};
use crate::reproduce::portrait::{Painter, Sitter};
use crate::reproduce::{Item, Rows};

pub(crate) const FIGURE_4_6: Item = Item {
    name: "figure-4-6",
    title: "a pressed cube: coarse, with finer triangles at the tip, and smoothed",
    seconds: 4.5,
    run,
};

/// What is shown: the name, the area that is refined, how displacements are spread.
const PICTURES: [(&str, EnhancementArea, Smoothing); 5] = [
    ("coarse", EnhancementArea::None, Smoothing::None),
    ("edge", EnhancementArea::Edge, Smoothing::None),
    ("edge_shepard", EnhancementArea::Edge, Smoothing::Shepard),
    ("vertex", EnhancementArea::Vertex, Smoothing::None),
    (
        "vertex_shepard",
        EnhancementArea::Vertex,
        Smoothing::Shepard,
    ),
];

/// Each triangle becomes 64.
const LEVELS: usize = 3;

/// How deep a triangle is pressed in [m].
const DEPTH: f64 = 15e-3;

fn run(rows: &mut Rows<'_>) -> Result<(), Failure> {
    let mut painter = match Painter::new() {
        Ok(painter) => painter,
        Err(why) => {
            for (name, ..) in PICTURES {
                rows.add_missing(name, "", why.to_string());
            }
            return Ok(());
        }
    };
    let cube = Body::new(MODELS[0])?;
    let pressed = Pressed::new(&cube, DEPTH)?;
    for (name, area, smoothing) in PICTURES {
        let settings = Enhancement {
            area,
            levels: LEVELS,
            smoothing,
        };
        let (surface, places) = enhanced(&cube.surface, &pressed, settings)?;
        let png = painter.draw(&Sitter {
            surface: &surface,
            places: &places,
            middle: (pressed.place, pressed.normal),
            near: 0.5,
        })?;
        let note = format!(
            "{}, a triangle pressed {:.0} mm deep; {} triangles are drawn; displacements are spread \
             {} beside the closed form of the dimple: geometry, no mechanics; drawn by {}",
            cube.told,
            1e3 * DEPTH,
            surface.mesh().triangles().len(),
            match smoothing {
                Smoothing::None => "linearly",
                Smoothing::Shepard => "by Shepard's functions",
                Smoothing::MovingLeastSquares => "by moving least squares",
            },
            painter.gpu.adapter(),
        );
        rows.add_picture(Some(name), &png, note)?;
    }
    Ok(())
}

/// The surface with the patch in it at rest, and where its vertices [m] are when it is pressed.
fn enhanced(
    coarse: &Surface,
    pressed: &Pressed,
    settings: Enhancement,
) -> Result<(Surface, Vec<Vec3>), Failure> {
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
    let mut field = SurfaceField::default();
    field.update(model.interpolation(), &pressed.displacements, &[press]);
    let mut patch = EnhancedPatch::default();
    patch.build(&model, &[pressed.triangle]);
    let mut of_patch = vec![Vec3::zeros(); patch.places().len()];
    patch.displace(&field, &mut of_patch);
    let mut moved = vec![Vec3::zeros(); coarse.mesh().vertices().len()];
    Carrier::of_vertices(model.interpolation()).carry(&field, &mut moved);
    // Its first points are vertices of the coarse mesh.
    moved.extend_from_slice(&of_patch[patch.corners().len()..]);
    let whole = patch.in_mesh(coarse.mesh(), patch.places());
    let places = whole.vertices().iter().zip(&moved).map(|(x, u)| x + u);
    let places = places.collect();
    Ok((Surface::new(whole)?, places))
}
