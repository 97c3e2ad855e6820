//! Characterization of one specimen from its recordings.
//!
//! ```text
//! CleanRecordings ─▶ relaxation ─▶ laws, given the relaxation ─▶ Characterization
//! ```

mod criteria;
mod fitted;
mod in_loop;
mod tissue;

use std::ops::Range;

use palpate_files::recording::{RecordingHeader, StimulusKind};

use crate::clean::SegmentKind;
use crate::fit::{Draws, simplest};
use crate::inverse::{
    Body, CandidateLaw, Curves, FarField, Indentation, LawDescription, Organ, UnitCurve,
    ZeroErrors, assumption, law_fit, repeated,
};
use crate::lumped::{Contact, UniaxialFit, fit_uniaxial_recordings, mean_modulus};
use crate::viscoelastic::{
    Relaxation, RelaxationRecord, RelaxationSettings, relaxation, relaxation_of_steps,
};
use crate::{CleanRecording, Error, WithoutGeometry};

pub use fitted::{FittedLaw, FittedRecording, FittedRelaxation};

/// What may be chosen about a characterization.
#[derive(Debug, Clone, PartialEq)]
pub struct CharacterizeSettings {
    /// How relaxation is sought.
    pub relaxation: RelaxationSettings,
    /// The laws that are sought; with [`CandidateLaw::DEFAULT`] also the law with fibres, of pieces that state how they lie.
    pub laws: Vec<CandidateLaw>,
    /// How often their fits are made again to see how well they are known.
    pub draws: Option<Draws>,
    /// Whether full viscoelastic runs of finite elements are solved in the loop of the fit, of one law.
    pub in_loop: bool,
    /// Whether only linear elastic contact and adhesion are fitted, in closed form: neither relaxation nor laws. A map of
    /// a surface has too many curves for more.
    pub closed_forms: bool,
}

impl Default for CharacterizeSettings {
    fn default() -> Self {
        Self {
            relaxation: RelaxationSettings::default(),
            laws: CandidateLaw::DEFAULT.to_vec(),
            draws: Some(Draws {
                count: 100,
                seed: 1,
            }),
            in_loop: false,
            closed_forms: false,
        }
    }
}

/// What was found about one specimen. Where nothing was, the reason stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Characterization {
    /// How it relaxes.
    pub relaxation: Result<Relaxation, Error>,
    /// The same if every ramp is taken for a step.
    pub relaxation_of_steps: Result<Relaxation, Error>,
    /// What needs no geometry.
    pub without_geometry: WithoutGeometry,
    /// The laws that were sought, in their order.
    pub laws: Vec<(CandidateLaw, Result<LawDescription, Error>)>,
    /// The same from pieces that were pressed or pulled along one axis; empty without any.
    pub uniaxial: Vec<(CandidateLaw, Result<UniaxialFit, Error>)>,
    /// Warnings about the relaxation.
    pub relaxation_warnings: Vec<String>,
    /// Which parameters of relaxation and laws can be distinguished, in plain sentences.
    pub identifiability: Vec<String>,
    /// Warnings about plain sentences.
    pub warnings: Vec<String>,
}

/// Characterizes one specimen from all its `recordings`; `at_step` receives the current step.
pub fn characterize(
    recordings: &[CleanRecording],
    settings: &CharacterizeSettings,
    at_step: &mut dyn FnMut(&'static str),
) -> Characterization {
    let mesh = recordings.first().and_then(|own| own.header.mesh.as_ref());
    let organ = mesh.map(|_| Err(Error::NoMesh));
    characterize_organ(recordings, organ, settings, at_step)
}

/// The same of a specimen that is a whole `organ`, if it is one, or where that could not be read.
pub fn characterize_organ(
    recordings: &[CleanRecording],
    organ: Option<Result<Organ, Error>>,
    settings: &CharacterizeSettings,
    at_step: &mut dyn FnMut(&'static str),
) -> Characterization {
    if settings.closed_forms {
        return Characterization::of_closed_forms(recordings);
    }
    let pressed: Vec<Pressed> = recordings.iter().filter_map(Pressed::of).collect();
    let deepest = pressed.iter().map(Pressed::deepest).fold(0.0, f64::max);
    let body = body(recordings, deepest);
    let is_organ = organ.is_some();
    let far = organ.filter(|_| deepest > 0.0).map(|organ| {
        at_step("finite elements of the organ");
        organ?.far_field(body.as_ref().map_err(Clone::clone)?, deepest)
    });
    let far = far.transpose();
    let mut curves = body.clone().and_then(|body| {
        let curves = Curves::new(body, CandidateLaw::NeoHookean, deepest);
        Ok(match far.clone()? {
            Some(far) => curves.in_organ(far),
            None => curves,
        })
    });
    at_step("relaxation");
    let of_block = curves.as_mut().ok();
    let of_block = of_block.filter(|curves| !matches!(curves.body(), Body::Tube { .. }));
    let neo_hookean = of_block.and_then(|curves| curves.of(f64::INFINITY, &[]).ok());
    let records = records(&pressed, neo_hookean.as_ref());
    let relaxing = relaxation(&records, settings.relaxation);
    let of_steps = relaxation_of_steps(&records, settings.relaxation);
    at_step("springs and dampers");
    let indentations: Vec<Indentation<'_>> = pressed.iter().map(Pressed::indentation).collect();
    let mut found = Characterization {
        relaxation: relaxing,
        relaxation_of_steps: of_steps,
        without_geometry: WithoutGeometry::of(recordings, &indentations),
        laws: Vec::new(),
        uniaxial: Vec::new(),
        relaxation_warnings: Vec::new(),
        identifiability: Vec::new(),
        warnings: Vec::new(),
    };
    found.warnings = found.without_geometry.warnings();
    found.warnings.extend(match &far {
        Ok(Some(far)) => about_organ(far),
        _ => about_size(recordings, &body, deepest),
    });
    let half_space = curves.as_mut().ok();
    let half_space = half_space.and_then(|own| half_space_factor(own, recordings, deepest));
    found.warnings.extend(half_space);
    let pieces: Vec<CleanRecording> = recordings
        .iter()
        .filter(|own| is_piece(own))
        .cloned()
        .collect();
    // The loop makes the fits again.
    let quick_draws = settings.draws.filter(|_| !settings.in_loop);
    let (laws, angles) = laws_of(&settings.laws, recordings);
    found.warnings.extend(angles);
    for law in laws {
        at_step(law.name().word());
        if !pieces.is_empty() {
            let answer = match settings.in_loop {
                true => Err(Error::NoLoop),
                false => fit_uniaxial_recordings(law, &pieces),
            };
            found.uniaxial.push((law, answer));
            continue;
        }
        let answer = curves.clone().and_then(|curves| {
            if law.name().has_fibres() {
                return Err(Error::FibresUnderIndenter { law: law.name() });
            }
            if settings.in_loop && (is_organ || !matches!(curves.body(), Body::Block { .. })) {
                return Err(Error::NoLoop);
            }
            let relaxation = found.relaxation.as_ref().map_err(Clone::clone)?;
            let mut curves = curves.of_law(law);
            sought(&mut curves, &pressed, relaxation, quick_draws)
        });
        found.laws.push((law, answer));
    }
    if settings.in_loop && pieces.is_empty() && !is_organ {
        in_loop::refine(&mut found, &pressed, body, settings, at_step);
    }
    found.add_warnings(&pressed);
    found
}

fn sought(
    curves: &mut Curves,
    pressed: &[Pressed],
    relaxation: &Relaxation,
    draws: Option<Draws>,
) -> Result<LawDescription, Error> {
    let law = curves.law();
    if matches!(curves.body(), Body::Tube { .. }) && law != CandidateLaw::NeoHookean {
        return Err(Error::TubeLaw { law: law.name() });
    }
    let indentations: Vec<Indentation<'_>> = pressed.iter().map(Pressed::indentation).collect();
    let fit = law_fit(curves, &indentations, &relaxation.series)?;
    let mut description = LawDescription::of(fit, &indentations);
    description.repeated = draws.map(|draws| repeated(&description, curves, &indentations, draws));
    Ok(description)
}

/// The laws that are sought of these recordings: with those that are sought unless others are asked for also the law with
/// fibres, where pieces state how they lie; and the sentence on an angle that none of the laws uses.
fn laws_of(
    asked: &[CandidateLaw],
    recordings: &[CleanRecording],
) -> (Vec<CandidateLaw>, Option<String>) {
    let mut laws = asked.to_vec();
    let states = |own: &CleanRecording| own.header.fibre_axis_angle_deg.is_some();
    let key = recordings.iter().find_map(|own| fibre_key(&own.header));
    let mut pieces = recordings.iter().filter(|own| is_piece(own)).peekable();
    let are_pieces = pieces.peek().is_some();
    if are_pieces && asked == CandidateLaw::DEFAULT && pieces.all(states) {
        laws.push(CandidateLaw::HolzapfelGasserOgden);
    }
    let is_used = laws.iter().any(|law| law.name().has_fibres()) && are_pieces;
    let said = key.filter(|_| !is_used).map(|key| match are_pieces {
        true => format!(
            "`{key}` is stated and no law here has fibres, so that the fits take the tissue as the same in all directions; state \
             `fibre_axis_angle_deg` of all pieces, and leave --law out or give --law holzapfel_gasser_ogden"
        ),
        false => format!(
            "`{key}` is stated of an indentation, whose fits take the tissue as the same in all directions; pull strips in two \
             directions to fit its fibres"
        ),
    });
    (laws, said)
}

/// The first key on fibres that a header states.
fn fibre_key(header: &RecordingHeader) -> Option<&'static str> {
    let each = [
        ("fibre_axis_angle_deg", header.fibre_axis_angle_deg),
        ("fibre_angle_deg", header.fibre_angle_deg),
        ("dispersion", header.dispersion),
    ];
    let mut stated = each.into_iter().filter(|(_, value)| value.is_some());
    stated.next().map(|(key, _)| key)
}

/// Whether a whole piece was pressed or pulled.
fn is_piece(recording: &CleanRecording) -> bool {
    recording
        .header
        .stimulus
        .is_some_and(StimulusKind::is_of_piece)
}

/// What of a recording is fitted: from first contact to where the indenter goes back.
#[derive(Debug, Clone)]
struct Pressed {
    time: Vec<f64>,
    depth: Vec<f64>,
    force: Vec<f64>,
    largest: f64,
    zeros: ZeroErrors,
}

impl Pressed {
    fn of(recording: &CleanRecording) -> Option<Self> {
        let samples = Self::samples(recording)?;
        let of = |values: &[f64]| values.get(samples.clone()).map(<[f64]>::to_vec);
        let largest = recording.filtered_force.get(samples.clone())?;
        let force = recording.force_at_rest();
        Some(Self {
            time: of(&recording.time)?,
            depth: of(&recording.depth)?.iter().map(|d| d.max(0.0)).collect(),
            force: of(&force)?,
            largest: largest.iter().copied().fold(0.0, f64::max),
            zeros: ZeroErrors::of(recording),
        })
    }

    fn samples(recording: &CleanRecording) -> Option<Range<usize>> {
        if is_piece(recording) {
            return None;
        }
        let first = recording.time.iter().position(|t| *t >= 0.0)?;
        let back = recording
            .segments
            .iter()
            .rposition(|s| s.kind != SegmentKind::Retreat);
        let end = back.map_or(recording.time.len(), |place| recording.segments[place].end);
        (first <= end).then_some(first..end)
    }

    /// Whether depth and force are above zero.
    fn has_force(&self) -> bool {
        self.deepest() > 0.0 && self.largest > 0.0
    }

    fn deepest(&self) -> f64 {
        self.depth.iter().copied().fold(0.0, f64::max)
    }

    fn indentation(&self) -> Indentation<'_> {
        Indentation {
            time: &self.time,
            depth: &self.depth,
            force: &self.force,
            zeros: self.zeros,
        }
    }
}

/// The courses of relaxation; the elastic force is taken for that of `curve`, and for a linear one without it.
fn records(pressed: &[Pressed], curve: Option<&UnitCurve>) -> Vec<RelaxationRecord> {
    let shape = |depth: f64| match curve {
        Some(curve) => curve.force.force(depth),
        None => depth,
    };
    // One for all: a sensor's noise is as many newtons in each.
    let largest = pressed.iter().map(|each| each.largest).fold(0.0, f64::max);
    let with_force = pressed.iter().filter(|each| each.has_force());
    let each = with_force.filter_map(|each| {
        let course = RelaxationRecord::new(&each.time, &each.depth, &each.force, largest, shape)?;
        Some(course.with_zeros(&each.depth, each.zeros, largest, shape))
    });
    each.collect()
}

/// The indented body, the same in all recordings.
fn body(recordings: &[CleanRecording], deepest: f64) -> Result<Body, Error> {
    let first = recordings.first().ok_or(Error::NoContactForce)?;
    Body::of(&first.header, deepest)
}

/// Warning about the effect of the organ on the depth, where that is large.
fn about_organ(far: &FarField) -> Option<String> {
    (far.share.abs() > LARGE).then(|| {
        let percent = 100.0 * far.share.abs();
        match far.share > 0.0 {
            true => format!(
                "{percent:.0} % of the depth is the organ that gives way as a whole, by linear finite elements on its mesh: \
                 the laws depend on its shape and on where it is fixed as much"
            ),
            false => format!(
                "the organ is {percent:.0} % stiffer than a large piece, by linear finite elements on its mesh: what is \
                 fixed or ends near the indenter is strained too, which they leave out"
            ),
        }
    })
}

/// What was assumed of the specimen's size.
fn about_size(
    recordings: &[CleanRecording],
    body: &Result<Body, Error>,
    deepest: f64,
) -> Option<String> {
    let first = recordings.first().filter(|_| deepest > 0.0)?;
    assumption(&first.header, body.as_ref().ok()?, deepest)
}

/// By how much (6.1), which is of a half-space, errs on a specimen whose size is stated.
fn half_space_factor(
    curves: &mut Curves,
    recordings: &[CleanRecording],
    deepest: f64,
) -> Option<String> {
    let header = &recordings.first()?.header;
    header.thickness_m?;
    if matches!(curves.body(), Body::Layer { .. }) {
        return Some(
            "mean_elastic_modulus is that of a half-space (6.1), here of layer and base together; the laws are of the layer"
                .to_owned(),
        );
    }
    let curve = curves.of(f64::INFINITY, &[]).ok()?;
    let contact = Contact::of(header).ok()?;
    // E = 6 C₁₀, and the curve is that of C₁₀ = 1 Pa.
    let modulus = mean_modulus(contact, false, deepest, curve.force.force(deepest)).ok()?;
    let factor = modulus / 6.0;
    ((factor - 1.0).abs() > WORTH_A_WARNING).then(|| {
        format!(
            "mean_elastic_modulus is that of a half-space (6.1): on this specimen, at this depth, {factor:.2} times \
             that of neo-Hookean tissue; the laws take the specimen's size into account"
        )
    })
}

impl Characterization {
    fn of_closed_forms(recordings: &[CleanRecording]) -> Self {
        Self {
            relaxation: Err(Error::NotFitted),
            relaxation_of_steps: Err(Error::NotFitted),
            without_geometry: WithoutGeometry::of_closed_forms(recordings),
            laws: Vec::new(),
            uniaxial: Vec::new(),
            relaxation_warnings: Vec::new(),
            identifiability: Vec::new(),
            warnings: Vec::new(),
        }
    }

    /// The law to be preferred: the simplest that no other beats by the information criterion.
    pub fn preferred(&self) -> Option<&LawDescription> {
        let found: Vec<_> = self
            .laws
            .iter()
            .filter_map(|(_, law)| law.as_ref().ok())
            .collect();
        let fits: Vec<_> = found.iter().map(|law| &law.found.fit).collect();
        let nearest = found.iter().min_by(|a, b| a.misfit.total_cmp(&b.misfit))?;
        Some(found[simplest(&fits, nearest.uncertainty.effective_samples).0])
    }

    /// The same for pieces along one axis.
    fn preferred_uniaxial(&self) -> Option<&UniaxialFit> {
        let found: Vec<_> = self
            .uniaxial
            .iter()
            .filter_map(|(_, law)| law.as_ref().ok())
            .collect();
        let fits: Vec<_> = found.iter().map(|law| &law.fit).collect();
        let nearest = found.iter().min_by(|a, b| a.misfit.total_cmp(&b.misfit))?;
        Some(found[simplest(&fits, nearest.uncertainty.effective_samples).0])
    }

    /// The law to be preferred, however it was found.
    pub fn preferred_law(&self) -> Option<CandidateLaw> {
        let pressed = self.preferred().map(|law| law.found.law);
        pressed.or_else(|| self.preferred_uniaxial().map(|law| law.law))
    }

    fn add_warnings(&mut self, pressed: &[Pressed]) {
        let longest = pressed.iter().filter_map(|each| each.time.last().copied());
        let duration = longest.fold(0.0, f64::max);
        if let Ok(relaxation) = &self.relaxation {
            self.relaxation_warnings = relaxation.warnings(duration);
        }
        self.identifiability.clone_from(&self.relaxation_warnings);
        let of_laws = self.laws.iter();
        let pressed =
            of_laws.filter_map(|(law, found)| Some((law, &found.as_ref().ok()?.warnings)));
        let of_pieces = self.uniaxial.iter();
        let pulled =
            of_pieces.filter_map(|(law, found)| Some((law, &found.as_ref().ok()?.warnings)));
        for (law, warnings) in pressed.chain(pulled) {
            let name = law.name().word();
            let named = warnings
                .iter()
                .map(|warning| match warning.starts_with(name) {
                    true => warning.clone(),
                    false => format!("{name}: {warning}"),
                });
            self.identifiability.extend(named);
        }
    }
}

/// Part of the depth from which the effect of an organ gives a warning [-].
const LARGE: f64 = 0.2;
/// Relative change of a modulus from which it gives a warning [-].
const WORTH_A_WARNING: f64 = 0.02;
