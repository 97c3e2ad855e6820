mod fields;
mod points;
mod regions;
mod tools;

use std::borrow::Cow;
use std::path::Path;

use palpate_files::quantity::rounded;
use palpate_files::scene::{LengthUnit, Shape};
use palpate_files::{Place, Tissue};
use palpate_geometry::{TetrahedronError, VolumeRegion, read_tetrahedra};
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_elements::solid::{
    Body, Loads, MovedPatch, RegionContent, SolidError, SolidProblem, Weight, solve,
};
use palpate_mechanics::{Material, Vec3};
use palpate_simulate::{fixed_region, read_organ};

use super::super::problem::{Patch, Problem, Solid};
use super::super::table::Table;
use super::figures::{
    CavityFigures, Displacements, Figures, PatchFigures, PointFigures, SolidFigures,
};
use super::{RequestedOutputs, Solution, plots, warnings};
use crate::Error;
use crate::solve::solver_progress::ProgressReporter;

/// Displacement over the length of a body above which a linear law gets a warning [-].
const LARGE_WAY: f64 = 0.05;

/// File extensions of tetrahedral meshes.
const VOLUMES: [&str; 3] = ["msh", "vtk", "vtu"];

/// The fit of the stiffness stops when it changes by no more than this part of the accuracy [-], or after this many
/// solutions.
const FITTED_TO: f64 = 0.1;
const MAX_FITS: usize = 8;

/// Solves a body that is moved or loaded, and fits its tissue where that is requested.
pub(crate) fn solution(
    problem: &Problem,
    case: &Solid,
    wanted: RequestedOutputs,
    reporter: &ProgressReporter<'_>,
) -> Result<Solution, Error> {
    let BodyOfFile {
        body,
        regions: of_file,
        mut warnings,
    } = body(&case.shape)?;
    let (regions, more) = regions::solved(&case.parts, &of_file)?;
    warnings.extend(more);
    let patch = case.patch.as_ref();
    let (places, more) = points::places(case, &body);
    warnings.extend(more);
    let mut mechanical = SolidProblem {
        patch: patch.map(moved),
        regions,
        fibres: case.fibres.as_ref().map(|fibres| fibres.field.clone()),
        loads: Loads {
            weight: case.gravity.map(|gravity| Weight {
                gravity,
                density: problem.tissue.density_kg_m3.value,
            }),
            on_surface: case.loads.iter().map(|load| load.load.clone()).collect(),
        },
        tools: case
            .tools
            .iter()
            .flat_map(|tool| tool.bodies.clone())
            .collect(),
        points: places,
        ..SolidProblem::new(
            body,
            fixed_region(&case.shape, case.anchor.as_ref()),
            problem.material.law.clone(),
        )
    };
    let solved = |mechanical: &SolidProblem| {
        solve(mechanical, problem.accuracy, &mut |progress| {
            reporter.at(progress);
        })
        .map_err(|error| refused(problem, case, error))
    };
    let mut found = solved(&mechanical)?;
    let mut factor = 1.0;
    let mut tissue = None;
    for fit in 0..=MAX_FITS {
        if !case.fits {
            break;
        }
        // Displacements are nearly proportional to the reciprocal of the stiffness.
        let change = stiffness_ratio(case, &found.answer.points).ok_or_else(|| against(case))?;
        if (change - 1.0).abs() <= FITTED_TO * problem.accuracy {
            break;
        }
        if fit == MAX_FITS {
            warnings.push(format!(
                "the fitted stiffness still changes by {:.2} % after {MAX_FITS} solutions; measure points that move \
                 more with it",
                100.0 * (change - 1.0).abs()
            ));
            break;
        }
        factor *= change;
        let law_of = |tissue: &Tissue| {
            let mut fitted = tissue.clone();
            fitted.elasticity = fitted.elasticity.times(factor);
            let material = Material::from_tissue(&fitted);
            let material = material.map_err(|error| problem.refused(error))?;
            Ok::<_, Error>((fitted, material.law))
        };
        let (fitted, law) = law_of(&problem.tissue)?;
        mechanical.law = law;
        for (region, part) in mechanical.regions.iter_mut().zip(&case.parts) {
            if let (RegionContent::Tissue { law, .. }, Some(tissue)) =
                (&mut region.content, part.tissue())
            {
                *law = law_of(tissue)?.1;
            }
        }
        tissue = Some(Box::new(fitted));
        found = solved(&mechanical)?;
    }
    let answer = found.answer;
    warnings.extend(found.warnings);
    warnings.extend(answer.warnings.iter().cloned());
    let turned = answer.fields.displacements.iter().map(Vec3::norm);
    let farthest = turned.fold(0.0, f64::max);
    let (low, high) = mechanical.body.bounds();
    if patch.is_none() && problem.is_small_strain() && farthest > LARGE_WAY * (high - low).max() {
        warnings.push(format!(
            "the linear law is for small strain and small rotation, but the body moves by {:.3} of its length; a \
             hyperelastic law follows large ones",
            farthest / (high - low).max()
        ));
    }
    let mut tables = Vec::new();
    if let Some(patch) = patch {
        let length = patch.displacement.norm();
        warnings.extend(warnings::of_depths(problem, patch.radius, &[length]));
        let on_tool = -answer.force;
        let table = Table::default()
            .with("displacement [mm]", [1e3 * length])
            .with("force along it [mN]", [1e3 * answer.force_along])
            .with("on the tool: x [mN]", [1e3 * on_tool.x])
            .with("y [mN]", [1e3 * on_tool.y])
            .with("z [mN]", [1e3 * on_tool.z]);
        tables.push(table);
    } else if case.tools.is_empty() {
        let reaction = answer.reaction;
        let table = Table::default()
            .with("largest displacement [mm]", [1e3 * farthest])
            .with("on the fixed tissue: x [mN]", [1e3 * reaction.x])
            .with("y [mN]", [1e3 * reaction.y])
            .with("z [mN]", [1e3 * reaction.z]);
        tables.push(table);
    }
    let tools = tools::figures(case, &answer);
    if !tools.is_empty() {
        tables.push(tools::table(&tools));
        warnings.extend(tools::warnings(&tools));
    }
    let points = points::figures(case, &mechanical.points, &answer.points);
    if !points.is_empty() {
        tables.push(points::table(&points));
    }
    let regions = regions::figures(problem, case, &answer.fields);
    if !regions.is_empty() {
        tables.push(
            Table::default()
                .with_texts("region", regions.iter().map(|region| region.name.clone()))
                .with_texts("law", regions.iter().map(|region| region.law.to_owned()))
                .with(
                    "volume [cm³]",
                    regions.iter().map(|region| 1e6 * region.volume_m3),
                ),
        );
    }
    let cavities = regions::cavities(case, &answer.cavities);
    if !cavities.is_empty() {
        let column = |of: fn(&CavityFigures) -> f64| cavities.iter().map(of).collect::<Vec<_>>();
        tables.push(
            Table::default()
                .with_texts("cavity", cavities.iter().map(|cavity| cavity.name.clone()))
                .with("pressure [Pa]", column(|cavity| cavity.pressure_pa))
                .with(
                    "volume at rest [cm³]",
                    column(|cavity| 1e6 * cavity.volume_at_rest_m3),
                )
                .with("volume [cm³]", column(|cavity| 1e6 * cavity.volume_m3)),
        );
    }
    if case.fits {
        let parameters = tissue
            .as_deref()
            .unwrap_or(&problem.tissue)
            .elasticity
            .parameters();
        let table = Table::default().with("fitted stiffness, factor", [factor]);
        tables.push(parameters.iter().fold(table, |table, (key, estimate)| {
            table.with(key, [estimate.value])
        }));
    }
    Ok(Solution {
        heading: heading(case),
        tables,
        plot: match case.tools.is_empty() {
            true => fields::around_patch(case, &answer.fields),
            false => tools::along_paths(case, &answer),
        },
        figures: Figures::Solid(SolidFigures {
            patch: patch.map(|patch| PatchFigures {
                force_n: (-answer.force).into(),
                force_along_displacement_n: answer.force_along,
                patch_displacement_m: patch.displacement.into(),
            }),
            displacement_m: Displacements::of(case, &points),
            reaction_n: answer.reaction.into(),
            tools,
            points,
            regions,
            cavities,
            stiffness_factor: case.fits.then_some(factor),
            tissue: match case.fits {
                true => Some(tissue.unwrap_or_else(|| Box::new(problem.tissue.clone()))),
                false => None,
            },
        }),
        unknowns: answer.unknowns,
        estimated_error: found.error,
        observed_order: found.observed_order,
        warnings,
        vtu: wanted.vtu.then(|| fields::grid(&answer.fields)),
        recording: None,
    })
}

impl Displacements {
    /// Those of the points of `points_m`, or else of the patch.
    fn of(case: &Solid, points: &[PointFigures]) -> Option<Self> {
        let each = case.points.iter().zip(points);
        let listed: Vec<_> = each
            .filter(|(point, _)| point.is_nearest)
            .map(|(_, point)| point.displacement_m)
            .collect();
        match listed.is_empty() {
            false => Some(Self::Points(listed)),
            true => case
                .patch
                .as_ref()
                .map(|patch| Self::Patch(patch.displacement.into())),
        }
    }
}

fn moved(patch: &Patch) -> MovedPatch {
    MovedPatch {
        center: patch.center,
        radius: patch.radius,
        displacement: patch.displacement,
        friction: patch.contact,
    }
}

/// Least-squares factor on the stiffness, so that the points move as measured; none where they do not move.
fn stiffness_ratio(case: &Solid, moved: &[Vec3]) -> Option<f64> {
    let (mut both, mut squares) = (0.0, 0.0);
    for (point, moved) in case.points.iter().zip(moved) {
        if let Some((along, measured)) = point.measured {
            let found = moved.dot(&along);
            both += found * measured;
            squares += found * found;
        }
    }
    let ratio = squares / both;
    (ratio > 0.0 && ratio.is_finite()).then_some(ratio)
}

/// The error when the points move in the opposite direction.
fn against(case: &Solid) -> Error {
    let measured = case.points.iter().find(|point| point.measured.is_some());
    let way = measured.and_then(|point| point.measured);
    let Some((point, (_, way))) = measured.zip(way) else {
        return Error::failed("no point has a measured displacement");
    };
    let error = palpate_files::Error::BadValue {
        place: point.place.clone(),
        key: point.key.replace("at_m", "measured_m"),
        found: format!("{way}"),
        expected: "a displacement to the side to which gravity and the loads move the points"
            .into(),
    };
    error.into()
}

/// The error of the solver, with the line and the key where it concerns a load or a point.
fn refused(problem: &Problem, case: &Solid, error: palpate_mechanics::Error) -> Error {
    let load = |number: usize| case.loads.get(number);
    match &error {
        palpate_mechanics::Error::Solid(SolidError::EmptyLoad { load: number }) => load(*number)
            .map(|load| {
                let found = "a region without a part of the surface".to_owned();
                bad(
                    &load.place,
                    &load.key,
                    found,
                    "one that takes in a part of the surface",
                )
            }),
        palpate_mechanics::Error::Solid(SolidError::LineOffSurface {
            load: number,
            distance,
        }) => load(*number).map(|load| {
            let found = format!("{} m off the surface", rounded(*distance, 3));
            bad(&load.place, &load.key, found, "a line on the surface")
        }),
        palpate_mechanics::Error::Solid(SolidError::PointOutside { point, distance }) => {
            case.points.get(*point).map(|point| {
                let found = format!("{} m outside the body", rounded(*distance, 3));
                bad(
                    &point.place,
                    &point.key,
                    found,
                    "a point in the body or on its surface",
                )
            })
        }
        palpate_mechanics::Error::Region(error) => regions::refused(case, error),
        palpate_mechanics::Error::Tetrahedra(TetrahedronError::NotEnclosed { region }) => {
            let part = region.checked_sub(1).map(|at| &case.parts[at as usize]);
            part.map(|part| {
                let found = format!(
                    "{:?}, a cavity that reaches the surface or another one",
                    part.name
                );
                bad(
                    &part.found_at,
                    &part.key,
                    found,
                    "a cavity that tissue encloses",
                )
            })
        }
        _ => None,
    }
    .unwrap_or_else(|| problem.refused(error))
}

/// A surface to be meshed, or a tetrahedral mesh.
struct BodyOfFile {
    body: Body,
    /// Regions of the cells, where a file of tetrahedra has any.
    regions: Vec<VolumeRegion>,
    /// Warnings.
    warnings: Vec<String>,
}

fn body(shape: &Shape) -> Result<BodyOfFile, Error> {
    if let Shape::Mesh { path, unit } = shape
        && holds_tetrahedra(path)
    {
        let imported = read_tetrahedra(path, unit.map(in_words).transpose()?)?;
        return Ok(BodyOfFile {
            body: Body::Volume(imported.mesh),
            regions: imported.regions,
            warnings: imported.warnings,
        });
    }
    let (surface, warnings) = read_organ(shape)?;
    Ok(BodyOfFile {
        body: Body::Surface(surface),
        regions: Vec::new(),
        warnings,
    })
}

fn bad(place: &Place, key: &str, found: String, expected: impl Into<Cow<'static, str>>) -> Error {
    Error::from(palpate_files::Error::BadValue {
        place: place.clone(),
        key: key.to_owned(),
        found,
        expected: expected.into(),
    })
}

fn holds_tetrahedra(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    VOLUMES.iter().any(|volume| extension == *volume)
}

fn in_words(unit: LengthUnit) -> Result<palpate_geometry::LengthUnit, Error> {
    Ok(unit.word().parse()?)
}

fn heading(case: &Solid) -> String {
    let name = match &case.shape {
        Shape::Builtin { organ, .. } => format!("Built-in {organ}"),
        Shape::Mesh { path, .. } => path.display().to_string(),
    };
    let mut how = Vec::new();
    if case.gravity.is_some() {
        how.push("under its weight".to_owned());
    }
    match case.loads.len() {
        0 => {}
        1 => how.push("under a load".to_owned()),
        many => how.push(format!("under {many} loads")),
    }
    if let Some(patch) = &case.patch {
        let contact = match patch.contact {
            Friction::Bonded => "sticks",
            Friction::Frictionless => "slips",
        };
        let radius = plots::short(1e3 * patch.radius);
        how.push(format!(
            "moved by a patch of radius {radius} mm that {contact}"
        ));
    }
    let tools: Vec<_> = case.tools.iter().map(|tool| tool.name.as_str()).collect();
    if !tools.is_empty() {
        how.push(format!("pressed by {}", tools.join(" and ")));
    }
    format!("{name}, {}", how.join(", "))
}
