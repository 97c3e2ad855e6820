use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::DMatrix;
use palpate_mechanics::{IndentationCurve, PronySeries, branch};

use super::curves::UnitCurve;
use crate::CleanRecording;

/// Depth and force over time of one recording.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Indentation<'a> {
    /// Times [s], ascending.
    pub time: &'a [f64],
    /// Depths [m].
    pub depth: &'a [f64],
    /// Forces on the tissue [N].
    pub force: &'a [f64],
    /// How well its zeros are known.
    pub zeros: ZeroErrors,
}

/// How well the zeros of a recording are known: its first contact, and what the sensor shows without load.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ZeroErrors {
    /// Standard error of the depth of the first contact [m], of each recording by itself.
    pub depth: f64,
    /// Standard deviation of that depth because the tissue moves by itself [m], the same in all recordings: an indenter that comes
    /// down slowly touches moving tissue at the top of its motion.
    pub motion: f64,
    /// Standard error of the force without load [N].
    pub force: f64,
}

impl ZeroErrors {
    /// Of a recording.
    pub fn of(recording: &CleanRecording) -> Self {
        let contact = &recording.handling.contact;
        Self {
            depth: contact.depth_error_m.unwrap_or(0.0),
            motion: Self::of_motion(recording.motion().unwrap_or(0.0)),
            force: contact.offset_error_n.unwrap_or(0.0),
        }
    }

    /// The standard deviation of a motion of this `amplitude` [m]: that of a sine [JCGM 101:2008, 6.4.6].
    pub(crate) fn of_motion(amplitude: f64) -> f64 {
        FRAC_1_SQRT_2 * amplitude
    }
}

impl<'a> Indentation<'a> {
    /// With zeros that are known exactly.
    pub fn new(time: &'a [f64], depth: &'a [f64], force: &'a [f64]) -> Self {
        Self {
            time,
            depth,
            force,
            zeros: ZeroErrors::default(),
        }
    }
}

/// Forces [N] of a unit curve times `modulus` [Pa] in an indentation, and their change with the modulus, each
/// shape, and the ratio ρᵢ = gᵢ/(1 − Σ g) and the logarithm of the time of each term.
pub(super) fn forces(
    time: &[f64],
    depth: &[f64],
    curve: &UnitCurve,
    modulus: f64,
    series: &PronySeries,
) -> (Vec<f64>, Vec<Vec<f64>>) {
    let elastic: Vec<f64> = depth.iter().map(|&d| curve.force.force(d)).collect();
    let left = 1.0 - series.terms().iter().map(|(g, _)| g).sum::<f64>();
    let each = series.terms().iter();
    let branches: Vec<_> = each.map(|&(_, tau)| branch(tau, time, &elastic)).collect();
    let mut lost = vec![0.0; time.len()];
    for ((g, _), (values, _)) in series.terms().iter().zip(&branches) {
        for (lost, value) in lost.iter_mut().zip(values) {
            *lost += g * value;
        }
    }
    let unit: Vec<f64> = elastic.iter().zip(&lost).map(|(e, l)| e - l).collect();
    let mut of_modulus = unit.clone();
    if let Some(base) = curve.base.as_ref().filter(|base| base.is_absolute) {
        // Under a stiffer layer the same base is relatively softer.
        let depth = depth.iter().copied();
        let softer = relaxed(time, depth, &base.by_stiffness, 1.0, series);
        of_modulus
            .iter_mut()
            .zip(softer)
            .for_each(|(f, less)| *f -= less);
    }
    let mut columns = vec![of_modulus];
    for by_shape in &curve.by_shape {
        let depth = depth.iter().copied();
        columns.push(relaxed(time, depth, by_shape, modulus, series));
    }
    for ((g, _), (values, slopes)) in series.terms().iter().zip(&branches) {
        let ratio = lost
            .iter()
            .zip(values)
            .map(|(l, h)| modulus * left * (l - h));
        columns.push(ratio.collect());
        columns.push(slopes.iter().map(|s| -modulus * g * s).collect());
    }
    (unit.iter().map(|f| modulus * f).collect(), columns)
}

/// Writes the columns of one recording into the rows from `start` on.
pub(super) fn write(columns: &[Vec<f64>], start: usize, jacobian: &mut DMatrix<f64>) {
    for (place, column) in columns.iter().enumerate() {
        for (row, value) in column.iter().enumerate() {
            jacobian[(start + row, place)] = *value;
        }
    }
}

/// Forces [N] of an elastic `curve` times `modulus` [Pa] over some depths.
fn relaxed(
    time: &[f64],
    depth: impl Iterator<Item = f64>,
    curve: &IndentationCurve,
    modulus: f64,
    series: &PronySeries,
) -> Vec<f64> {
    let elastic: Vec<f64> = depth.map(|d| modulus * curve.force(d)).collect();
    let mut force = elastic.clone();
    for &(g, tau) in series.terms() {
        let lost = branch(tau, time, &elastic).0;
        force
            .iter_mut()
            .zip(lost)
            .for_each(|(f, lost)| *f -= g * lost);
    }
    force
}

/// Part by which stress of an earlier depth counts less at a later one than the product says, per radius of the indenter
/// between them [-]: from 0.1 to 0.5 by finite elements to six radii (`docs/theory/characterization.md`, Limits of the
/// product).
pub(super) const EARLIER: f64 = 0.5;

/// How far a model may be off, each taken for an even distribution.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    /// Part of the force [-].
    pub(super) model: f64,
    /// Part of a force that grows faster with depth than it should [-].
    pub(super) mesh: f64,
    /// Part by which stress of an earlier depth counts less, for the length between the two [1/m].
    pub(super) earlier: f64,
}

/// Systematic influences on the residuals of all `indentations` [N], each column for one standard deviation: the zeros
/// of each recording, and, of all alike, the modulus of a base and the error of the model within its `bounds`.
pub(super) fn systematic(
    indentations: &[Indentation<'_>],
    curve: &UnitCurve,
    modulus: f64,
    series: &PronySeries,
    bounds: Bounds,
) -> Vec<Vec<f64>> {
    let samples: usize = indentations.iter().map(|each| each.time.len()).sum();
    let (mut of_base, mut of_motion) = (Vec::new(), Vec::new());
    let deepest = indentations.iter().flat_map(|each| each.depth);
    let deepest = deepest.copied().fold(f64::MIN_POSITIVE, f64::max);
    let even = 1.0 / 3.0_f64.sqrt();
    let mut of_model = [(); 3].map(|()| Vec::with_capacity(samples));
    let [scale, tilt, history] = &mut of_model;
    let mut columns = Vec::new();
    for each in indentations {
        let start = scale.len();
        let of = |by: f64| {
            let depth = each.depth.iter().map(|d| (d + by).max(0.0));
            relaxed(each.time, depth, &curve.force, modulus, series)
        };
        let force = of(0.0);
        let mut own = |change: Vec<f64>| {
            let mut column = vec![0.0; samples];
            column[start..start + change.len()].copy_from_slice(&change);
            columns.push(column);
        };
        let by_depth = |by: f64| {
            let ends = of(by).into_iter().zip(of(-by));
            ends.map(|(deeper, higher)| 0.5 * (deeper - higher))
        };
        if each.zeros.depth > 0.0 {
            own(by_depth(each.zeros.depth).collect());
        }
        of_motion.extend(by_depth(each.zeros.motion));
        if each.zeros.force > 0.0 {
            own(vec![-each.zeros.force; force.len()]);
        }
        let share = each.depth.iter().map(|d| 2.0 * d / deepest - 1.0);
        tilt.extend(
            force
                .iter()
                .zip(share)
                .map(|(f, share)| even * bounds.mesh * f * share),
        );
        scale.extend(force.iter().map(|f| even * bounds.model * f));
        if let Some(base) = curve.base.as_ref().filter(|base| base.error > 0.0) {
            let depth = each.depth.iter().copied();
            let by = relaxed(each.time, depth, &base.by_stiffness, modulus, series);
            of_base.extend(by.into_iter().map(|by| base.error * by));
        }
        let more = excess_by_memory(each, curve, modulus, series);
        history.extend(more.iter().map(|more| even * bounds.earlier * more));
    }
    let is_there = |column: &Vec<f64>| column.iter().any(|change| *change != 0.0);
    columns.extend([of_motion, of_base].into_iter().filter(is_there));
    columns.extend(of_model);
    columns
}

/// Excess of the force [N m] when stress of an earlier depth counts less by the length between the two:
/// Σ gᵢ ∫ (d(t) − d(s)) Fₑ(d(s)) exp(−(t − s)/τᵢ) ds/τᵢ.
fn excess_by_memory(
    each: &Indentation<'_>,
    curve: &UnitCurve,
    modulus: f64,
    series: &PronySeries,
) -> Vec<f64> {
    let elastic = each.depth.iter().map(|&d| modulus * curve.force.force(d));
    let elastic: Vec<f64> = elastic.collect();
    let moment = elastic.iter().zip(each.depth).map(|(force, d)| force * d);
    let moment: Vec<f64> = moment.collect();
    let mut excess = vec![0.0; elastic.len()];
    for &(g, tau) in series.terms() {
        let [lost, of_moment] = [&elastic, &moment].map(|own| branch(tau, each.time, own).0);
        for (place, excess) in excess.iter_mut().enumerate() {
            *excess += g * (each.depth[place] * lost[place] - of_moment[place]);
        }
    }
    excess
}
