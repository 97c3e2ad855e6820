use palpate_files::tissue::Lumped;

use crate::analyze::{Hold, holds};
use crate::clean::SegmentKind;
use crate::inverse::Indentation;
use crate::lumped::{
    Adhesion, ColumnFit, Contact, DepthHistory, ElasticContact, KelvinFit, MeanModulus, SpringsFit,
    fit_adhesion, fit_approach, fit_column, fit_kelvin, fit_springs, mean_elastic_modulus,
};
use crate::{CleanRecording, Error};

/// What is found about a specimen without its geometry. Where nothing was, the reason stands.
#[derive(Debug, Clone, PartialEq)]
pub struct WithoutGeometry {
    /// The mean elastic modulus (6.1).
    pub mean_modulus: Result<MeanModulus, Error>,
    /// Linear elastic contact, from the approach of the largest depth.
    pub linear_elastic: Result<ElasticContact, Error>,
    /// The same with adhesion of a sphere, from the retraction.
    pub adhesion: Result<Adhesion, Error>,
    /// Two springs and a damper (6.3), from the recording of the largest depth.
    pub kelvin: Result<KelvinFit, Error>,
    /// The exponential law on a column (6.2): from steady forces where there are three depths, else from the ramps.
    pub column: Result<ColumnFit, Error>,
    /// Nonlinear springs (6.4), from all recordings.
    pub springs: Result<SpringsFit, Error>,
}

/// Depths that differ by less than this part are one [-].
const ALIKE: f64 = 0.05;
/// Depths of holds that make a static response.
const STATIC: usize = 3;
/// Samples of a recording that are enough for springs.
const SAMPLES: usize = 1500;

impl WithoutGeometry {
    /// Of the recordings of one specimen, and of the same as they are fitted.
    pub fn of(recordings: &[CleanRecording], indentations: &[Indentation<'_>]) -> Self {
        let first = recordings.first().ok_or(Error::NoContactForce);
        let contact = first.and_then(|recording| Contact::of(&recording.header));
        let holds: Vec<Hold> = recordings
            .iter()
            .flat_map(|own| holds(own, &mut Vec::new()))
            .collect();
        Self {
            mean_modulus: mean_elastic_modulus(recordings),
            linear_elastic: fit_approach(recordings),
            adhesion: fit_adhesion(recordings),
            kelvin: kelvin(indentations),
            column: contact.and_then(|contact| column(contact, recordings, &holds)),
            springs: springs(indentations),
        }
    }

    /// Closed forms alone, of a half-space.
    pub(crate) fn of_closed_forms(recordings: &[CleanRecording]) -> Self {
        Self {
            mean_modulus: mean_elastic_modulus(recordings),
            linear_elastic: fit_approach(recordings),
            adhesion: fit_adhesion(recordings),
            kelvin: Err(Error::NotFitted),
            column: Err(Error::NotFitted),
            springs: Err(Error::NotFitted),
        }
    }

    /// Warnings about the fits, each by the name of its law in files.
    pub fn warnings(&self) -> Vec<String> {
        let column = self.column.iter().flat_map(|found| &found.warnings);
        let springs = self.springs.iter().flat_map(|found| &found.warnings);
        let column = column.map(|warning| format!("column: {warning}"));
        let springs = springs.map(|warning| format!("nonlinear_springs: {warning}"));
        let apart = self.linear_elastic.as_ref().ok();
        let apart = apart.and_then(ElasticContact::warning);
        column.chain(springs).chain(apart).collect()
    }

    /// The parameters as files hold them.
    pub fn lumped(&self) -> Lumped {
        Lumped {
            kelvin: self.kelvin.as_ref().ok().map(|found| found.kelvin),
            column: self.column.as_ref().ok().map(|found| found.column),
            nonlinear_springs: self.springs.as_ref().ok().map(|found| found.springs),
        }
    }
}

fn kelvin(indentations: &[Indentation<'_>]) -> Result<KelvinFit, Error> {
    let deepest = |each: &&Indentation<'_>| each.depth.iter().copied().fold(0.0, f64::max);
    let most = indentations
        .iter()
        .max_by(|a, b| deepest(a).total_cmp(&deepest(b)));
    let most = most.ok_or(Error::NoContactForce)?;
    fit_kelvin(most.time, most.depth, most.force, DepthHistory::Recorded)
}

fn column(
    contact: Contact,
    recordings: &[CleanRecording],
    holds: &[Hold],
) -> Result<ColumnFit, Error> {
    let mut depths: Vec<f64> = holds.iter().map(|hold| hold.depth_m).collect();
    depths.sort_by(f64::total_cmp);
    depths.dedup_by(|deeper, before| *deeper < (1.0 + ALIKE) * *before);
    if depths.len() >= STATIC {
        let of = |number: fn(&Hold) -> f64| holds.iter().map(number).collect::<Vec<_>>();
        return if_known(fit_column(
            contact,
            &of(|hold| hold.depth_m),
            &of(|hold| hold.steady_n),
        )?);
    }
    let ramps = recordings.iter().flat_map(|own| {
        let ramps = own
            .segments
            .iter()
            .filter(|segment| segment.kind == SegmentKind::Ramp);
        let samples = ramps.flat_map(|segment| segment.first..segment.end);
        samples.map(|sample| (own.depth[sample].max(0.0), own.force[sample]))
    });
    let (depths, forces): (Vec<f64>, Vec<f64>) = ramps.unzip();
    if_known(fit_column(contact, &depths, &forces)?)
}

/// The column, if its modulus is known at all.
fn if_known(found: ColumnFit) -> Result<ColumnFit, Error> {
    let gamma = found.column.gamma_pa;
    match gamma.standard_error {
        Some(error) if error > gamma.value => Err(Error::ColumnUnknown),
        _ => Ok(found),
    }
}

fn springs(indentations: &[Indentation<'_>]) -> Result<SpringsFit, Error> {
    let thinned: Vec<[Vec<f64>; 3]> = indentations
        .iter()
        .map(|each| {
            let every = each.time.len().div_ceil(SAMPLES).max(1);
            let of = |values: &[f64]| values.iter().copied().step_by(every).collect();
            [of(each.time), of(each.depth), of(each.force)]
        })
        .collect();
    let all = thinned
        .iter()
        .map(|[time, depth, force]| Indentation::new(time, depth, force));
    let all: Vec<Indentation<'_>> = all.collect();
    fit_springs(&all)
}
