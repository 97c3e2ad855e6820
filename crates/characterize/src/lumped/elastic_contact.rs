//! Linear elastic contact with a half-space, as force curves of microscopes and indenters are usually evaluated: Young's
//! modulus from the approach, and of a sphere that sticks also the work of adhesion, from the retraction.
//!
//! *Approach*: F = E* f(d − d₀), with E* = E/(1 − ν²), ν = ½, and f of a flat face, a sphere [Hertz 1881] or a cone
//! [Sneddon 1965] ([`Contact`]); E and the contact d₀ are fitted together, d₀ from the best of 200 depths of the approach on.
//!
//! *Retraction of a sphere* of radius R [Johnson, Kendall and Roberts 1971], by the radius a of contact:
//!   d − d₀ = a²/R − √(2πwa/E*),  F = 4E*a³/(3R) − √(8πwE*a³),
//! whose least force is −3πwR/2 whatever E. E, w and d₀ are fitted to the samples from the deepest to the pull-off force.
//!
//! *How we know*: `elastic_contact::…`: the force by another form of the same theory and bisection, Hertz without adhesion,
//! the pull-off force; real curves next to the modulus that the instrument's program states.
//!
//! *Limits*: small strain and a half-space; no relaxation, so that the modulus is of that speed; the deepest recording of a
//! specimen alone. On the retraction of a viscous tissue w depends on the speed as much as on the surfaces, and E is only as
//! good as the misfit says.

use std::f64::consts::PI;

use palpate_files::Estimate;
use palpate_files::quantity::plain_quantity;

use super::Contact;
use crate::clean::{SegmentKind, noise};
use crate::fit::{Parameter, Settings, correlated_uncertainty, least_squares};
use crate::{CleanRecording, Error};

/// Samples that are fitted at most; of more, every second, third and so on.
const MAX_SAMPLES: usize = 1500;
/// Contacts that are tried.
const CANDIDATES: usize = 200;
/// How far before the contact samples are fitted, over the deepest press [-].
const BEFORE: f64 = 0.25;
/// How far the contact may be from where it was found, over the deepest press [-].
const SHIFT: f64 = 0.5;
/// A pull-off force, in deviations of the noise and over the largest force, from which adhesion shows [-].
const SHOWS: [f64; 2] = [6.0, 0.01];
/// Of intervals [-].
const LEVEL: f64 = 0.95;

/// A fit of linear elastic contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticContact {
    /// Young's modulus of incompressible tissue [Pa].
    pub youngs_modulus_pa: Estimate,
    /// Half the width of its interval of 95 % [Pa].
    pub reach_pa: Option<f64>,
    /// Where contact begins, next to the contact of the recording [m].
    pub contact_m: Estimate,
    /// The deepest sample below that contact [m].
    pub depth_m: f64,
    /// Mean force shortly before that contact, over the largest [-]: nothing where contact does not begin earlier.
    pub before: f64,
    /// Root mean square of the residual, over the largest force [-].
    pub misfit: f64,
}

/// Contacts that are farther apart than this part of the depth differ [-]: the force of a sphere then by a sixth.
const APART: f64 = 0.1;
/// Less than this part of the largest force is none [-].
const FREE: f64 = 0.02;

impl ElasticContact {
    /// Warning where contact begins much deeper than the first contact of the recording.
    pub fn warning(&self) -> Option<String> {
        let off = self.contact_m.value;
        (off > APART * self.depth_m && self.before.abs() < FREE).then(|| {
            let off = plain_quantity("contact_m", off, None);
            format!(
                "linear_elastic: linear elastic contact begins {off} deeper than the first contact from which relaxation \
                 and laws count, with hardly any force before it: if the tissue was not touched there yet, they are \
                 wrong; cut off what precedes contact, or use --closed-forms"
            )
        })
    }
}

/// Standard deviations in half an interval of 95 % [-].
const NORMAL: f64 = 1.96;

/// A fit of the theory of Johnson, Kendall and Roberts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adhesion {
    /// The elastic part.
    pub elastic: ElasticContact,
    /// Work of adhesion [J/m²].
    pub work_j_per_m2: Estimate,
    /// Half the width of its interval of 95 % [J/m²].
    pub reach_j_per_m2: Option<f64>,
    /// The least force on the retraction [N].
    pub pull_off_n: f64,
}

/// Result of a branch: the work of adhesion [J/m²] where it is sought, and half the width of its interval.
struct Fitted {
    elastic: ElasticContact,
    work: Estimate,
    reach: Option<f64>,
}

/// Depths [m] and forces [N] that are fitted.
struct Branch {
    depth: Vec<f64>,
    force: Vec<f64>,
    /// The largest of either.
    deepest: f64,
    strongest: f64,
}

impl Branch {
    fn of(recording: &CleanRecording, samples: impl Iterator<Item = usize>) -> Option<Self> {
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let samples: Vec<usize> = samples.collect();
        let every = samples.len().div_ceil(MAX_SAMPLES).max(1);
        let of = |values: &[f64]| -> Vec<f64> {
            let thin = samples.iter().step_by(every);
            thin.map(|sample| values[*sample]).collect()
        };
        let branch = Self {
            depth: of(&recording.depth),
            force: of(&recording.force),
            deepest: largest(&recording.depth),
            strongest: largest(&recording.force),
        };
        (branch.depth.len() > noise::ENOUGH && branch.deepest > 0.0 && branch.strongest > 0.0)
            .then_some(branch)
    }

    /// From before the contact to the end of the first ramp, with depth and force from that contact on, and its depth.
    fn approach(recording: &CleanRecording, contact: Contact) -> Option<(Self, f64)> {
        let ramp = recording
            .segments
            .iter()
            .find(|segment| segment.kind == SegmentKind::Ramp)?;
        let begin = Self::of(recording, 0..ramp.end)?.best_contact(contact);
        let near = BEFORE * (recording.depth[ramp.end - 1] - begin);
        let is_near = |sample: &usize| recording.depth[*sample] >= begin - near;
        let mut own = Self::of(recording, (0..ramp.end).filter(is_near))?;
        let free = own.depth.iter().zip(&own.force);
        let free = free.filter(|(depth, _)| **depth < begin);
        let (sum, count) = free.fold((0.0, 0.0), |(sum, count), (_, f)| (sum + f, count + 1.0));
        let zero = if count > 0.0 { sum / count } else { 0.0 };
        own.force.iter_mut().for_each(|force| *force -= zero);
        own.from(begin);
        Some((own, begin))
    }

    /// Depths from another contact on.
    fn from(&mut self, contact: f64) {
        self.depth.iter_mut().for_each(|depth| *depth -= contact);
        self.deepest -= contact;
    }

    /// The depth of the contact whose curve, with a constant force before it, is nearest to the samples. A slow drift
    /// before contact misleads a search in the beginning of the force alone.
    fn best_contact(&self, contact: Contact) -> f64 {
        let low = self.depth.iter().copied().fold(f64::INFINITY, f64::min);
        let high = self.depth.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let count = self.depth.len() as f64;
        let misfit = |begin: f64| {
            let [mut u, mut f, mut uu, mut uf, mut ff] = [0.0; 5];
            for (depth, force) in self.depth.iter().zip(&self.force) {
                let (rise, force) = (contact.unit_force(depth - begin), force / self.strongest);
                u += rise;
                f += force;
                uu += rise * rise;
                uf += rise * force;
                ff += force * force;
            }
            let [square, product] = [uu - u * u / count, uf - u * f / count];
            ff - f * f / count - product.max(0.0) * (product / square)
        };
        let candidates = (0..CANDIDATES).map(|place| {
            let begin = low + (high - low) * place as f64 / CANDIDATES as f64;
            (begin, misfit(begin))
        });
        let best = candidates
            .filter(|(_, misfit)| misfit.is_finite())
            .min_by(|a, b| a.1.total_cmp(&b.1));
        best.map_or(0.0, |(begin, _)| begin)
    }

    /// Mean force in the half of what there is before contact that is next to it, over the largest [-].
    fn before(&self) -> f64 {
        let low = self.depth.iter().copied().fold(0.0, f64::min);
        let both = self.depth.iter().zip(&self.force);
        let next = both.filter(|(depth, _)| (0.5 * low..0.0).contains(*depth));
        let (sum, count) = next.fold((0.0, 0.0), |(sum, count), (_, f)| (sum + f, count + 1.0));
        if count > 0.0 {
            sum / count / self.strongest
        } else {
            0.0
        }
    }

    /// From the first sample of the last retraction to its least force.
    fn retraction(recording: &CleanRecording) -> Option<Self> {
        let back = recording
            .segments
            .iter()
            .rfind(|segment| segment.kind == SegmentKind::Retreat)?;
        let force = |sample: &usize| recording.force[*sample];
        let least = (back.first..back.end).min_by(|a, b| force(a).total_cmp(&force(b)))?;
        Self::of(recording, back.first..=least)
    }

    /// Fits `force(E, w, d)` from `start`, with w fixed at zero where it is not sought.
    fn fit(&self, start: [f64; 2], force: impl Fn(f64, f64, f64) -> f64) -> Result<Fitted, Error> {
        let [modulus, work] = start;
        let seeks_work = work > 0.0;
        let shift = SHIFT * self.deepest;
        let adhesion = Parameter::new("work_of_adhesion_j_per_m2", work);
        let parameters = [
            Parameter::new("youngs_modulus_pa", modulus).within(0.0, f64::INFINITY),
            Parameter::new("contact_m", 0.0)
                .within(-shift, shift)
                .scaled(self.deepest),
            match seeks_work {
                true => adhesion.within(0.0, f64::INFINITY),
                false => adhesion.fixed(),
            },
        ];
        let fit = least_squares(
            &parameters,
            self.depth.len(),
            &Settings::default(),
            |values, residuals| {
                let both = self.depth.iter().zip(&self.force);
                for (residual, (depth, measured)) in residuals.iter_mut().zip(both) {
                    *residual = force(values[0], values[2], depth - values[1]) - measured;
                }
                Some(())
            },
        )?;
        let known = correlated_uncertainty(&fit, &[fit.residuals.len()]);
        let of = |place: usize| Estimate {
            value: fit.parameters[place].value,
            standard_error: known.standard_error(place),
        };
        let reach = |place: usize| {
            let error = known.standard_error(place)?;
            Some(error * known.quantile(place, LEVEL)?)
        };
        let mean_square = fit.sum_of_squares() / self.depth.len() as f64;
        let elastic = ElasticContact {
            youngs_modulus_pa: of(0),
            reach_pa: reach(0),
            contact_m: of(1),
            depth_m: self.deepest,
            before: self.before(),
            misfit: mean_square.sqrt() / self.strongest,
        };
        Ok(Fitted {
            elastic,
            work: of(2),
            reach: reach(2).filter(|_| seeks_work),
        })
    }
}

/// Young's modulus from the approach of the deepest of `recordings`.
///
/// # Errors
/// When the indenter is not stated or nothing was pressed.
pub fn fit_approach(recordings: &[CleanRecording]) -> Result<ElasticContact, Error> {
    let (recording, contact) = deepest(recordings)?;
    let (branch, begin) = Branch::approach(recording, contact).ok_or(Error::NoContactForce)?;
    let start = 0.75 * branch.strongest / contact.unit_force(branch.deepest);
    let force = |modulus: f64, _: f64, depth: f64| contact.unit_force(depth) * modulus / 0.75;
    let mut found = branch.fit([start, 0.0], force)?.elastic;
    found.contact_m.value += begin;
    Ok(found)
}

/// Work of adhesion and Young's modulus from the retraction of the deepest of `recordings`.
///
/// # Errors
/// When the indenter is not stated, nothing was pressed, no pull-off force shows or the indenter is no sphere.
pub fn fit_adhesion(recordings: &[CleanRecording]) -> Result<Adhesion, Error> {
    let (recording, contact) = deepest(recordings)?;
    let mut branch = Branch::retraction(recording).ok_or(Error::NoPullOff)?;
    let least = branch.force.iter().copied().fold(f64::INFINITY, f64::min);
    let [noise, share] = SHOWS;
    let shows = (noise * noise::deviation(&recording.force)).max(share * branch.strongest);
    if least > -shows {
        return Err(Error::NoPullOff);
    }
    let Contact::Sphere(radius) = contact else {
        return Err(Error::AdhesionOfSphere);
    };
    let approach = fit_approach(recordings)?;
    let begin = approach.contact_m.value;
    branch.from(begin);
    let start = [
        approach.youngs_modulus_pa.value,
        -least / (1.5 * PI * radius),
    ];
    let force =
        |modulus: f64, work: f64, depth: f64| adhesive_force(radius, modulus / 0.75, work, depth);
    let mut found = branch.fit(start, force)?;
    found.elastic.contact_m.value += begin;
    // The work follows the few samples around the least force, which need not be theory: what remains of all others is
    // taken as the error of that force too.
    let off = found.elastic.misfit * branch.strongest / (1.5 * PI * radius);
    Ok(Adhesion {
        elastic: found.elastic,
        work_j_per_m2: Estimate {
            standard_error: found.work.standard_error.map(|error| error.hypot(off)),
            ..found.work
        },
        reach_j_per_m2: found.reach.map(|reach| reach.hypot(NORMAL * off)),
        pull_off_n: least,
    })
}

fn deepest(recordings: &[CleanRecording]) -> Result<(&CleanRecording, Contact), Error> {
    let depth = |own: &CleanRecording| own.depth.iter().copied().fold(0.0, f64::max);
    let pressed = recordings.iter().filter(|own| !own.is_piece());
    let most = pressed.max_by(|a, b| depth(a).total_cmp(&depth(b)));
    let most = most.ok_or(Error::NoContactForce)?;
    Ok((most, Contact::of(&most.header)?))
}

/// The force [N] on a sphere of `radius` [m] at `depth` [m] on a half-space with E/(1 − ν²) = `modulus` [Pa] and `work` of
/// adhesion [J/m²], as it goes back; beyond the depth where it lets go, the force there.
pub fn adhesive_force(radius: f64, modulus: f64, work: f64, depth: f64) -> f64 {
    // With x = √a: d = x⁴/R − c x. It grows from x³ = c R/4 on, and is convex.
    let pull = (2.0 * PI * work / modulus).sqrt();
    let least = (0.25 * pull * radius).cbrt();
    let mut root = (radius * depth.abs()).sqrt().sqrt() + (pull * radius).cbrt();
    for _ in 0..100 {
        let off = root.powi(4) / radius - pull * root - depth;
        let slope = 4.0 * root.powi(3) / radius - pull;
        let next = root - off / slope;
        if !(next > least && next < root) {
            break;
        }
        root = next;
    }
    let reaches = least.powi(4) / radius - pull * least < depth;
    let contact = if reaches { root } else { least };
    let cube = contact.powi(6);
    4.0 * modulus * cube / (3.0 * radius) - (8.0 * PI * work * modulus * cube).sqrt()
}
