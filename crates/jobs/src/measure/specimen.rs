use palpate_files::protocol::{Measured, MeasuredTissue, PublishedOrgan};
use palpate_files::recording::{IndenterShape, RecordingHeader};
use palpate_files::{BuiltinTissue, Tissue};
use palpate_measure::{Shape, VirtualSpecimen};
use palpate_mechanics::{IndentationCurve, Material};
use palpate_servo::Vec3;

use super::specimen_cache;
use crate::Error;

/// Table 5-1: organ, depth [mm], least, mean and largest force [N].
const TABLE_5_1: &str = include_str!("../../../../published/table_5_1_static_force.csv");
/// How long the source held before it took a force for steady (section 5.4.2) [s].
const STEADY: f64 = 40.0;

/// The specimen of a protocol, pressed down to `deepest` [m], and warnings about it.
pub(crate) fn of(
    measured: &Measured,
    deepest: f64,
    at_step: &mut dyn FnMut(f64),
) -> Result<(VirtualSpecimen, Vec<String>), Error> {
    let (mut specimen, warnings) = match &measured.tissue {
        MeasuredTissue::Tissue(choice) => {
            let tissue = choice.read()?;
            let radius = measured.indenter_radius_m;
            let specimen = specimen_cache::of_tissue(&tissue, radius, deepest, at_step)?;
            (specimen, [tissue.source.warnings, tissue.warnings].concat())
        }
        MeasuredTissue::Published(organ) => published(*organ, measured.indenter_radius_m)?,
        MeasuredTissue::Real => {
            return Err(Error::input(
                "a real specimen is measured by a force sensor; name one in [sensor]",
            ));
        }
    };
    specimen.factor = measured.factor;
    specimen.shape = Shape {
        normal: Vec3::from(measured.surface.normal).normalize(),
        radius: measured.surface.radius_m,
    };
    describe(measured, &mut specimen.header);
    specimen.header.source = Some("a virtual specimen of palpate".to_owned());
    Ok((specimen, warnings))
}

/// The header entries for a real specimen of a protocol.
pub(crate) fn real(measured: &Measured) -> RecordingHeader {
    let mut header = RecordingHeader {
        indenter_shape: Some(IndenterShape::Flat),
        indenter_radius_m: Some(measured.indenter_radius_m),
        ..RecordingHeader::default()
    };
    describe(measured, &mut header);
    header
}

fn describe(measured: &Measured, header: &mut RecordingHeader) {
    if measured.organ.is_some() {
        header.organ.clone_from(&measured.organ);
    }
    header.subject.clone_from(&measured.subject);
    header.weight_kg = measured.weight_kg;
    header.site.clone_from(&measured.site);
    header.condition = measured.condition;
}

/// An organ whose static force is the mean of table 5-1, and which relaxes as its built-in tissue does.
fn published(organ: PublishedOrgan, radius: f64) -> Result<(VirtualSpecimen, Vec<String>), Error> {
    let (builtin, relaxation) = match organ {
        PublishedOrgan::Liver => (BuiltinTissue::PigLiver, "that of table 6-3"),
        PublishedOrgan::Kidney => (BuiltinTissue::PigKidney, "that of table 6-3"),
        PublishedOrgan::Spleen => (
            BuiltinTissue::PigSpleen,
            "no printed one, but its built-in tissue's",
        ),
        PublishedOrgan::Esophagus => (BuiltinTissue::PigEsophagus, "that of section 6.4.5"),
    };
    let material = Material::from_tissue(&Tissue::builtin(builtin))?;
    let name = organ.to_string();
    let (depths, forces): (Vec<f64>, Vec<f64>) = mean_forces(&name).unzip();
    let response = IndentationCurve::through(&depths, &forces);
    let mut specimen = VirtualSpecimen::of_response(&response, material.prony, STEADY, radius);
    specimen.header.organ = Some(name.clone());
    let warnings = vec![format!(
        "{name}: the mean forces of table 5-1 are taken for what is left after {STEADY} s, and the relaxation is \
         {relaxation}; the laws of tables 6-4 and 6-5 do not give these forces back"
    )];
    Ok((specimen, warnings))
}

/// Depths [m] and mean forces [N] of `organ` in table 5-1.
fn mean_forces(organ: &str) -> impl Iterator<Item = (f64, f64)> {
    let rows = TABLE_5_1.lines().filter_map(|line| {
        let mut cells = line.split(',');
        let (organ, depth) = (cells.next()?, cells.next()?);
        // Behind the least.
        let mean = cells.nth(1)?;
        Some((organ, 1e-3 * depth.parse::<f64>().ok()?, mean.parse().ok()?))
    });
    rows.filter(move |(of, ..)| *of == organ)
        .map(|(_, depth, mean)| (depth, mean))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_read() {
        for organ in ["liver", "kidney", "spleen", "esophagus"] {
            assert!(mean_forces(organ).count() >= 3, "{organ}");
        }
        assert_eq!(mean_forces("kidney").last(), Some((0.008, 0.4541)));
    }
}
