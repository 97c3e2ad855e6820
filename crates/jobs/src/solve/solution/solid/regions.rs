//! The parts of a solid: for the solver, and in the answer.

use palpate_files::quantity::rounded;
use palpate_files::scene::PartPlace;
use palpate_geometry::VolumeRegion;
use palpate_mechanics::finite_elements::solid::{
    CavityAnswer, RegionContent, SolidFields, SolidPlace, SolidRegion,
};
use palpate_mechanics::regions::{RegionError, RegionPlace};
use palpate_simulate::read_inclusion;

use super::super::super::problem::{Problem, Solid, SolidContent, SolidPart};
use super::super::figures::{CavityFigures, RegionFigures};
use super::bad;
use crate::Error;

/// The parts of the body in the solver's form, and warnings.
pub(super) fn solved(
    parts: &[SolidPart],
    of_file: &[VolumeRegion],
) -> Result<(Vec<SolidRegion>, Vec<String>), Error> {
    let mut warnings = Vec::new();
    let mut taken = Vec::new();
    let mut regions = Vec::new();
    for part in parts {
        let place = match &part.place {
            PartPlace::Layer(thickness) => SolidPlace::Bounded(RegionPlace::Layer(*thickness)),
            PartPlace::Inclusion(inclusion) => {
                let (place, more) = read_inclusion(inclusion)?;
                warnings.extend(more);
                SolidPlace::Bounded(place)
            }
            PartPlace::Label(_) | PartPlace::Group(_) => {
                let is_it = |region: &VolumeRegion| match &part.place {
                    PartPlace::Label(number) => region.number == *number,
                    PartPlace::Group(group) => region.name.as_ref() == Some(group),
                    PartPlace::Layer(_) | PartPlace::Inclusion(_) => false,
                };
                let found = of_file.iter().position(is_it);
                let cells = found.ok_or_else(|| no_region(part, of_file))?;
                if taken.contains(&cells) {
                    let found = format!("{:?}, which another `[[region]]` has", part.name);
                    return Err(bad(&part.found_at, &part.key, found, "each region once"));
                }
                taken.push(cells);
                SolidPlace::Cells(cells as u32)
            }
        };
        let content = match &part.content {
            SolidContent::Tissue(own) => {
                let (tissue, material) = own.as_ref();
                warnings.extend(material.warnings.iter().cloned());
                RegionContent::Tissue {
                    law: material.law.clone(),
                    density: tissue.density_kg_m3.value,
                }
            }
            SolidContent::Cavity(content) => RegionContent::Cavity(*content),
        };
        regions.push(SolidRegion {
            name: part.name.clone(),
            place,
            content,
        });
    }
    if of_file.len() > 1 && taken.is_empty() {
        warnings.push(format!(
            "the mesh has {}, which are all of `tissue`: no `[[region]]` has the `label` of one",
            in_a_list(of_file)
        ));
    }
    Ok((regions, warnings))
}

fn no_region(part: &SolidPart, of_file: &[VolumeRegion]) -> Error {
    let found = match &part.place {
        PartPlace::Group(group) => format!("{group:?}"),
        PartPlace::Label(number) => number.to_string(),
        PartPlace::Layer(_) | PartPlace::Inclusion(_) => String::new(),
    };
    let expected = match of_file.is_empty() {
        true => {
            "a shape such as `ball` or `surface`, for the body is no file of tetrahedra".to_owned()
        }
        false => format!("one of the mesh, which has {}", in_a_list(of_file)),
    };
    bad(&part.found_at, &part.key, found, expected)
}

/// The regions of a file in words.
fn in_a_list(regions: &[VolumeRegion]) -> String {
    const MOST: usize = 12;
    let each = regions.iter().take(MOST).map(|region| match &region.name {
        Some(name) => format!("{} {name:?}", region.number),
        None => region.number.to_string(),
    });
    let each: Vec<_> = each.collect();
    let more = match regions.len() > MOST {
        true => format!(" and {} others", regions.len() - MOST),
        false => String::new(),
    };
    let noun = if regions.len() == 1 {
        "region"
    } else {
        "regions"
    };
    format!("the {noun} {}{more}", each.join(", "))
}

/// The answer for each part of the body; none where it has no parts.
pub(super) fn figures(problem: &Problem, case: &Solid, fields: &SolidFields) -> Vec<RegionFigures> {
    if case.parts.is_empty() {
        return Vec::new();
    }
    let mut volumes = vec![0.0; 1 + case.parts.len()];
    for (nodes, region) in fields.cells.chunks_exact(10).zip(&fields.regions) {
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| fields.positions[nodes[k] as usize]);
        volumes[*region as usize] += (b - a).dot(&(c - a).cross(&(d - a))) / 6.0;
    }
    let body = std::iter::once(("body", Some(&problem.tissue)));
    let parts = case
        .parts
        .iter()
        .map(|part| (part.name.as_str(), part.tissue()));
    let each = body.chain(parts).zip(volumes);
    let each = each.filter_map(|((name, tissue), volume_m3)| {
        Some(RegionFigures {
            name: name.to_owned(),
            law: tissue?.elasticity.law().word(),
            volume_m3,
        })
    });
    each.filter(|region| region.volume_m3 > 0.0).collect()
}

/// The answer for each cavity.
pub(super) fn cavities(case: &Solid, answers: &[CavityAnswer]) -> Vec<CavityFigures> {
    let each = answers.iter().map(|answer| CavityFigures {
        name: case.parts[answer.region].name.clone(),
        pressure_pa: answer.pressure,
        volume_at_rest_m3: answer.volume_at_rest,
        volume_m3: answer.volume,
    });
    each.collect()
}

/// The error of the solver for a part of the body.
pub(super) fn refused(case: &Solid, error: &RegionError) -> Option<Error> {
    let part = |number: usize| case.parts.get(number);
    match error {
        RegionError::Outside { region, outside } => part(*region).map(|part| {
            let found = format!(
                "{:?}, which reaches {} m out of the body",
                part.name,
                rounded(*outside, 3)
            );
            bad(
                &part.found_at,
                &part.key,
                found,
                "a part inside of the body",
            )
        }),
        RegionError::Overlap {
            regions: [one, other],
        } => part(*one).zip(part(*other)).map(|(one, other)| {
            let found = format!("{:?}, which overlaps {:?}", other.name, one.name);
            bad(
                &other.found_at,
                &other.key,
                found,
                "parts that are apart from each other",
            )
        }),
        RegionError::Nowhere { region } => part(*region).map(|part| {
            let found = format!("{:?}, which is nowhere in the body", part.name);
            let expected = match part.place {
                PartPlace::Layer(_) => "layers that are thinner than the body together",
                _ => "a part that no other part covers",
            };
            bad(&part.found_at, &part.key, found, expected)
        }),
        RegionError::NoSurface(_) => None,
        RegionError::NothingBelowLayers { .. } => {
            let is_layer = |part: &&SolidPart| matches!(part.place, PartPlace::Layer(_));
            case.parts.iter().rfind(is_layer).map(|part| {
                let found = format!("{:?}, below which nothing is left", part.name);
                let expected = "layers that are thinner than the body together; its innermost tissue is `tissue`";
                bad(&part.found_at, &part.key, found, expected)
            })
        }
    }
}
