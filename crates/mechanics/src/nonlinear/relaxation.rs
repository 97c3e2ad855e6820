//! Relaxation at every integration point, by the series of the element's tissue.
//!
//! ```text
//! P = F S + p cof F,   S : C = 0
//! ```
//!
//! takes the second Piola-Kirchhoff stress of distortion S and the pressure p apart. Each is what it was at once less what
//! its branches have relaxed towards, S = γ Sₑ − Sₕ, as in `finite_elements::relaxation`: over a step, in which Sₑ goes
//! linearly, the share γ of the elastic stress still follows, and Sₕ is history (`material::prony`).
//!
//! Where an element is flat or inside out, C⁻¹ is taken as if its volume were a tenth of that at rest: the history stays
//! finite.

use super::elements::{POINTS, Pack};
use super::kernel::Deformed;
use super::lanes::{Columns, LANES, Lanes, Scalar, cofactors, contraction, dot, transposed_times};
use crate::finite_elements::Mismatch;
use crate::material::prony::Share;
use crate::{Error, PronySeries};

/// S (xx, yy, zz, yz, xz, xy), and p.
pub(super) const VALUES: usize = 7;

/// History at a point [Pa].
pub(super) type StressHistory<T> = [Lanes<T>; VALUES];

/// Smallest J² that is divided by [-].
const FLATTEST: f64 = 1e-2;

/// How the elements relax.
#[derive(Debug, Clone)]
pub(super) struct Relaxation {
    series: Vec<PronySeries>,
    /// Of each lane of each pack.
    of_lanes: Vec<[usize; LANES]>,
    /// Most terms of a series.
    terms: usize,
    elements: usize,
}

/// Shares of the branches of each series in a step: series × terms, and the share γ of each series.
#[derive(Debug, Clone)]
pub(super) struct StepShares {
    terms: Vec<Share>,
    follows: Vec<f64>,
}

impl Relaxation {
    /// `numbers` are those of the series of each element; none where no series has a term.
    pub(super) fn new(
        series: &[PronySeries],
        numbers: &[usize],
        elements: usize,
    ) -> Result<Option<Self>, Error> {
        let known = numbers.iter().filter(|number| **number < series.len());
        let found = known.count();
        if found != elements {
            return Err(Mismatch::WrongLength {
                what: "the list of the elements' series",
                found,
                expected: elements,
            }
            .into());
        }
        let terms = series.iter().map(|series| series.terms().len());
        let terms = terms.max().unwrap_or(0);
        let packs = numbers.chunks(LANES);
        let of_lanes = packs.map(|own| std::array::from_fn(|lane| own[lane.min(own.len() - 1)]));
        Ok((terms > 0).then(|| Self {
            series: series.to_vec(),
            of_lanes: of_lanes.collect(),
            terms,
            elements,
        }))
    }

    /// The history of all points at rest: for each the elastic stress at the last time, then its branches.
    pub(super) fn at_rest(&self) -> Vec<StressHistory<f32>> {
        vec![StressHistory::default(); self.of_lanes.len() * POINTS * (1 + self.terms)]
    }

    pub(super) fn shares(&self) -> StepShares {
        StepShares {
            terms: vec![Share::default(); self.series.len() * self.terms],
            follows: vec![1.0; self.series.len()],
        }
    }

    /// Copies the history of points of another body to those of this one: `place` gives the element and point there for an element
    /// and point here.
    pub(super) fn carry(
        &self,
        from: &Self,
        before: &[StressHistory<f32>],
        stored: &mut [StressHistory<f32>],
        place: impl Fn(usize, usize) -> Option<(usize, usize)>,
    ) {
        let terms = 1 + self.terms.min(from.terms);
        for (pack, own) in stored
            .chunks_exact_mut(POINTS * (1 + self.terms))
            .enumerate()
        {
            for (lane, point) in (0..LANES * POINTS).map(|k| (k / POINTS, k % POINTS)) {
                let element = (pack * LANES + lane).min(self.elements - 1);
                let Some((other, there)) = place(element, point) else {
                    continue;
                };
                let first = (other / LANES * POINTS + there) * (1 + from.terms);
                let others = &before[first..][..terms];
                let own = &mut own[point * (1 + self.terms)..][..terms];
                for (own, other_values) in own.iter_mut().zip(others) {
                    for (value, other_value) in own.iter_mut().zip(other_values) {
                        value.0[lane] = other_value.0[other % LANES];
                    }
                }
            }
        }
    }

    /// Prepares a step of `elapsed` [s].
    #[inline(always)]
    pub(super) fn begin(
        &self,
        elapsed: f64,
        stored: &[StressHistory<f32>],
        shares: &mut StepShares,
        deformed: &mut [Deformed<f32>],
    ) {
        for (number, series) in self.series.iter().enumerate() {
            let own = &mut shares.terms[number * self.terms..][..self.terms];
            own.fill(Share::default());
            shares.follows[number] = 1.0;
            for (own, share) in own.iter_mut().zip(series.shares(elapsed)) {
                shares.follows[number] -= share.g * share.new;
                *own = share;
            }
        }
        let points = stored.chunks_exact(POINTS * (1 + self.terms));
        for ((deformed, lanes), stored) in deformed.iter_mut().zip(&self.of_lanes).zip(points) {
            deformed.relaxes = true;
            deformed.follows = gather(lanes, |series| shares.follows[series]);
            deformed.history = [StressHistory::default(); POINTS];
            for term in 0..self.terms {
                let of = |value: fn(&Share) -> f64| {
                    gather(lanes, |series| {
                        value(&shares.terms[series * self.terms + term])
                    })
                };
                let (decay, old) = (of(|s| s.g * s.decay), of(|s| s.g * s.old));
                for (history, own) in deformed
                    .history
                    .iter_mut()
                    .zip(stored.chunks_exact(1 + self.terms))
                {
                    let (elastic, branch) = (&own[0], &own[1 + term]);
                    for (value, sum) in history.iter_mut().enumerate() {
                        *sum += decay * branch[value] + old * elastic[value];
                    }
                }
            }
        }
    }

    /// Stores the stress at the end of the step. Returns whether an element is inside out.
    #[inline(always)]
    pub(super) fn end(
        &self,
        packs: &[Pack<f32>],
        deformed: &[Deformed<f32>],
        shares: &StepShares,
        stored: &mut [StressHistory<f32>],
    ) -> bool {
        let mut is_inverted = false;
        let points = stored.chunks_exact_mut(POINTS * (1 + self.terms));
        let each = packs.iter().zip(deformed).zip(&self.of_lanes);
        for (((pack, deformed), lanes), stored) in each.zip(points) {
            for (point, own) in stored.chunks_exact_mut(1 + self.terms).enumerate() {
                let (now, volume) = pack.elastic(deformed, point);
                is_inverted |= volume.0.iter().any(|j| *j <= 0.0);
                let (before, branches) = own.split_at_mut(1);
                for (term, branch) in branches.iter_mut().enumerate() {
                    let of = |value: fn(&Share) -> f64| {
                        gather(lanes, |series| {
                            value(&shares.terms[series * self.terms + term])
                        })
                    };
                    let (decay, old, new) = (of(|s| s.decay), of(|s| s.old), of(|s| s.new));
                    for (value, sum) in branch.iter_mut().enumerate() {
                        *sum = decay * *sum + old * before[0][value] + new * now[value];
                    }
                }
                before[0] = now;
            }
        }
        is_inverted
    }
}

#[inline(always)]
fn gather(lanes: &[usize; LANES], value: impl Fn(usize) -> f64) -> Lanes<f32> {
    Lanes(lanes.map(|series| value(series) as f32))
}

impl<T: Scalar> Pack<T> {
    /// Sₑ and pₑ [Pa] at an integration point, and J there [-].
    #[inline(always)]
    fn elastic(&self, deformed: &Deformed<T>, point: usize) -> (StressHistory<T>, Lanes<T>) {
        let f = &deformed.gradients[point];
        let two = Lanes::splat(2.0);
        let (first, second) = (two * self.moduli.c10, two * self.moduli.c01);
        let c = transposed_times(f, f);
        let minors = cofactors(&c);
        let volume = dot(&f[0], &cofactors(f)[0]);
        let trace = c[0][0] + c[1][1] + c[2][2];
        // F⁻¹ P without the part of cof F.
        let diagonal = first + second * trace;
        let mut stress: Columns<T> = c;
        for (i, column) in stress.iter_mut().enumerate() {
            for (j, entry) in column.iter_mut().enumerate() {
                *entry = -(second * *entry);
                if i == j {
                    *entry += diagonal;
                }
            }
        }
        let flattest = T::of(FLATTEST);
        let square = (volume * volume).map(|value| if value > flattest { value } else { flattest });
        let mean = contraction(&stress, &c) * Lanes::splat(1.0 / 3.0) / square;
        let at = |i: usize, j: usize| stress[j][i] - mean * minors[j][i];
        let pressure = (deformed.pressures[point] + deformed.history[point][6]) / deformed.follows;
        let elastic = [
            at(0, 0),
            at(1, 1),
            at(2, 2),
            at(1, 2),
            at(0, 2),
            at(0, 1),
            pressure + mean * volume,
        ];
        (elastic, volume)
    }
}
