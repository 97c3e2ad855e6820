//! Organs with the static response of table 5-1 and the relaxation of table 6-3.

use palpate_files::recording::Condition;
use palpate_measure::VirtualSpecimen;
use palpate_mechanics::{IndentationCurve, PronySeries};

use crate::Error;
use crate::m06::Printed;
use crate::published::{cell, prony};
use crate::virtual_rig::RADIUS;

/// When the source took a force for steady [s] (section 5.4.2).
pub(super) const STEADY: f64 = 40.0;

/// An organ of whose printed rows each has the force that `force` takes from it [N].
pub(super) fn specimen(
    organ: &str,
    force: impl Fn(&Printed) -> f64,
) -> Result<VirtualSpecimen, Error> {
    let printed = Printed::all(organ);
    let depths = printed.iter().map(Printed::depth);
    let depths: Vec<f64> = depths.collect();
    let forces: Vec<f64> = printed.iter().map(force).collect();
    let response = IndentationCurve::through(&depths, &forces);
    let series = relaxation(organ)?;
    let mut specimen = VirtualSpecimen::of_response(&response, series, STEADY, RADIUS);
    specimen.header.organ = Some(organ.to_owned());
    specimen.header.condition = Some(Condition::InVivo);
    Ok(specimen)
}

/// The same with a heart that beats from somewhere on, and without breath: the source suspended ventilation.
pub(super) fn beating(specimen: VirtualSpecimen, seed: u64) -> VirtualSpecimen {
    let mut alive = specimen.alive(seed);
    alive.breath = None;
    alive
}

fn relaxation(organ: &str) -> Result<PronySeries, Error> {
    match organ {
        "esophagus" => {
            let term =
                ["prony_g1", "relaxation_time_s"].map(|name| format!("section-6-4-5 {name}"));
            Ok(PronySeries::new(&[(cell(&term[0])?, cell(&term[1])?)])?)
        }
        "kidney" => prony("kidney", 5),
        _ => prony("liver", 6),
    }
}
