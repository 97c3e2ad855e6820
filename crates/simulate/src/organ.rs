use nalgebra::Rotation3;
use palpate_files::Tissue;
use palpate_files::scene::{
    BuiltinOrgan, LengthUnit as FileUnit, Location, Neighbour, Region, RegionPlane, Shape,
    TissueChoice,
};
use palpate_geometry::{
    AnchorPlane, LengthUnit, Organ, ProblemKind, Surface, Vec3, inspect, read_mesh, repair,
};
use palpate_mechanics::Material;

use crate::Error;

/// The tissue of `choice`, which must be suitable for a simulation, and its material.
///
/// # Errors
/// When it cannot be read, is not a solid, or has fibres, whose direction a scene does not give.
pub fn read_tissue(choice: &TissueChoice) -> Result<(Tissue, Material), Error> {
    let tissue = choice.read()?;
    let material = Material::isotropic(&tissue, "a simulation")?;
    Ok((tissue, material))
}

/// The surface of `shape`, read and repaired or made, and warnings.
///
/// # Errors
/// When the file cannot be read or its mesh encloses no solid.
pub fn read_organ(shape: &Shape) -> Result<(Surface, Vec<String>), Error> {
    match shape {
        Shape::Builtin { organ, triangles } => {
            let organ = builtin_organ(*organ);
            let triangles = triangles.unwrap_or_else(|| organ.default_triangles());
            let mesh = organ.surface_mesh(triangles)?;
            let surface = Surface::new(mesh).expect("built-in organs are closed: see their tests");
            Ok((surface, Vec::new()))
        }
        Shape::Mesh { path, unit } => {
            let no_solid = |fault| Error::NoSolid {
                path: path.clone(),
                fault,
            };
            let imported = read_mesh(path, unit.map(length_unit))?;
            let (mesh, repairs) = repair(&imported.mesh).map_err(no_solid)?;
            let mut warnings = imported.warnings;
            if repairs.flipped_triangles > 0 {
                warnings.push(format!(
                    "{}: {} triangles faced inward or against their neighbours and were turned",
                    path.display(),
                    repairs.flipped_triangles
                ));
            }
            let surface = Surface::new(mesh).map_err(no_solid)?;
            for problem in inspect(surface.mesh()).problems {
                let fault = match problem.kind {
                    ProblemKind::DoubleWall => "the solid is a thin sheet with two sides",
                    ProblemKind::SelfIntersecting => "the surface passes through itself",
                    // Slivers are as good as other triangles for the forces; the size got a warning on reading, and the
                    // other problems are repaired.
                    _ => continue,
                };
                warnings.push(format!("{}: {fault}. {}", path.display(), problem.remedy));
            }
            Ok((surface, warnings))
        }
    }
}

/// The surface of `neighbour` at its location, and warnings.
///
/// # Errors
/// When its file cannot be read, its mesh encloses no solid, or it is too far away for floating-point numbers.
pub fn read_neighbour(neighbour: &Neighbour) -> Result<(Surface, Vec<String>), Error> {
    let (surface, warnings) = read_organ(&neighbour.shape)?;
    let Location {
        at_m,
        turn_rad: [x, y, z],
        scale,
    } = neighbour.location;
    // About fixed axes, x first.
    let turn = Rotation3::from_euler_angles(x, y, z);
    let place = |vertex: &Vec3| turn * (scale * vertex) + Vec3::from(at_m);
    let misplaced = |fault| Error::Misplaced { fault };
    let mesh = surface.mesh().map_vertices(place).map_err(misplaced)?;
    Ok((Surface::new(mesh).map_err(misplaced)?, warnings))
}

/// A `place` of the scene [m] in the frame of a body at `location`.
pub(crate) fn back(location: &Location, place: &Vec3) -> Vec3 {
    let [x, y, z] = location.turn_rad;
    let turn = Rotation3::from_euler_angles(x, y, z);
    turn.inverse() * (place - Vec3::from(location.at_m)) / location.scale
}

/// The fixed region of an organ of `shape`: as `stated`, or that of the built-in organ.
pub fn fixed_region(shape: &Shape, stated: Option<&Region>) -> Region {
    match (stated, shape) {
        (Some(stated), _) => stated.clone(),
        (None, Shape::Builtin { organ, .. }) => Region {
            planes: builtin_organ(*organ).anchor().iter().map(plane).collect(),
            ..Region::default()
        },
        (None, Shape::Mesh { .. }) => Region::default(),
    }
}

fn plane(plane: &AnchorPlane) -> RegionPlane {
    RegionPlane {
        point_m: plane.point.into(),
        normal: plane.normal.into(),
    }
}

/// The organ of this name in a scene.
pub fn builtin_organ(organ: BuiltinOrgan) -> Organ {
    match organ {
        BuiltinOrgan::Esophagus => Organ::Esophagus,
        BuiltinOrgan::Liver => Organ::Liver,
        BuiltinOrgan::Kidney => Organ::Kidney,
        BuiltinOrgan::Stomach => Organ::Stomach,
        BuiltinOrgan::Spleen => Organ::Spleen,
        BuiltinOrgan::Diaphragm => Organ::Diaphragm,
        BuiltinOrgan::Hemisphere => Organ::Hemisphere,
        BuiltinOrgan::Cube => Organ::Cube,
        BuiltinOrgan::Slab => Organ::Slab,
    }
}

pub(crate) fn length_unit(unit: FileUnit) -> LengthUnit {
    match unit {
        FileUnit::Metre => LengthUnit::Metre,
        FileUnit::Centimetre => LengthUnit::Centimetre,
        FileUnit::Millimetre => LengthUnit::Millimetre,
        FileUnit::Micrometre => LengthUnit::Micrometre,
        FileUnit::Inch => LengthUnit::Inch,
    }
}
