//! Forces of the elements and their change, without a matrix.
//!
//! ```text
//! P = 2 c₁₀ F + 2 c₀₁ (I₁ F − F C) + (p − 2 c₁₀ − 4 c₀₁) cof F,   p = (λ − λ₁) (J̄ − 1) + (2 c₁₀ + λ₁) (J − 1)
//! ```
//!
//! J − 1 is computed from the displacement gradient, so that no digit is lost at small strain.
//!
//! Where tissue relaxes, a share γ of this follows, less a history: γ P − F Sₕ − pₕ cof F (`relaxation`).

use super::elements::{Nodal, POINTS, Pack};
use super::lanes::{
    Columns, Lanes, Scalar, cofactors, contraction, cross, dot, plus, product, scaled,
    transposed_times,
};
use super::relaxation::StressHistory;

/// The deformation of eight elements.
#[derive(Debug, Clone)]
pub(super) struct Deformed<T> {
    /// F at each integration point [-].
    pub(super) gradients: [Columns<T>; POINTS],
    /// γ (p − 2 c₁₀ − 4 c₀₁) − pₕ at each integration point [Pa].
    pub(super) pressures: [Lanes<T>; POINTS],
    /// Whether one of the elements has c₀₁.
    has_second: bool,
    /// Whether they relax: then γ [-], and Sₕ and pₕ at each integration point [Pa].
    pub(super) relaxes: bool,
    pub(super) follows: Lanes<T>,
    pub(super) history: [StressHistory<T>; POINTS],
}

impl<T: Scalar> Default for Deformed<T> {
    fn default() -> Self {
        Self {
            gradients: [Columns::default(); POINTS],
            pressures: [Lanes::default(); POINTS],
            has_second: false,
            relaxes: false,
            follows: Lanes::splat(1.0),
            history: [StressHistory::default(); POINTS],
        }
    }
}

impl<T: Scalar> Deformed<T> {
    /// Subtracts F Sₕ of the volume `weight` [m³] from a stress.
    #[inline(always)]
    fn subtract_history(
        &self,
        f: &Columns<T>,
        point: usize,
        weight: Lanes<T>,
        stress: &mut Columns<T>,
    ) {
        let [xx, yy, zz, yz, xz, xy, _] = self.history[point];
        let history = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        for (own, column) in stress.iter_mut().zip(&product(f, &history)) {
            *own = plus(own, &scaled(column, -weight));
        }
    }
}

/// Deforms every element by the displacements `u` [m] and adds its forces [N], by which it resists, to `forces`.
#[inline(always)]
pub(super) fn forces<T: Scalar>(
    packs: &[Pack<T>],
    u: &[f64],
    deformed: &mut [Deformed<T>],
    forces: &mut [T],
) {
    for (pack, deformed) in packs.iter().zip(deformed) {
        pack.deform(&pack.gather_displacements(u), deformed);
        pack.scatter(&pack.resist(deformed), forces);
    }
}

/// Whether an element is inverted at an integration point.
pub(super) fn are_inverted<T: Scalar>(deformed: &[Deformed<T>]) -> bool {
    let mut gradients = deformed.iter().flat_map(|own| &own.gradients);
    gradients.any(|f| {
        let determinants = dot(&f[0], &cofactors(f)[0]);
        determinants.0.iter().any(|j| *j <= T::of(0.0))
    })
}

/// Adds the change of the forces [N] when the displacements change by `du` [m].
#[inline(always)]
pub(super) fn products<T: Scalar>(
    packs: &[Pack<T>],
    deformed: &[Deformed<T>],
    du: &[T],
    forces: &mut [T],
) {
    for (pack, deformed) in packs.iter().zip(deformed) {
        let nodal = pack.change(deformed, &pack.gather(du));
        pack.scatter(&nodal, forces);
    }
}

impl<T: Scalar> Pack<T> {
    #[inline(always)]
    pub(super) fn deform(&self, nodal: &Nodal<T>, deformed: &mut Deformed<T>) {
        let one = Lanes::splat(1.0);
        let (two, four) = (Lanes::splat(2.0), Lanes::splat(4.0));
        let moduli = &self.moduli;
        let [of_mean, of_point] = moduli.of_dilations();
        let mut sum = Lanes::default();
        for point in 0..POINTS {
            let mut h = self.gradient(nodal, point);
            // J − 1 = tr H + tr cof H + det H.
            let minors = cofactors(&h);
            let traces = [0, 1, 2].map(|i| h[i][i] + minors[i][i]);
            let dilation = traces[0] + traces[1] + traces[2] + dot(&h[0], &minors[0]);
            sum += dilation;
            deformed.pressures[point] = of_point * dilation;
            for (axis, column) in h.iter_mut().enumerate() {
                column[axis] += one;
            }
            deformed.gradients[point] = h;
        }
        let mean = sum * Lanes::splat(1.0 / POINTS as f64);
        let all = of_mean * mean - (two * moduli.c10 + four * moduli.c01);
        for pressure in &mut deformed.pressures {
            *pressure += all;
        }
        if deformed.relaxes {
            for (pressure, history) in deformed.pressures.iter_mut().zip(&deformed.history) {
                *pressure = deformed.follows * *pressure - history[6];
            }
        }
        deformed.has_second = moduli.c01 != Lanes::default();
    }

    /// The forces of the elements on their nodes, with the sign by which they resist [N].
    #[inline(always)]
    pub(super) fn resist(&self, deformed: &Deformed<T>) -> Nodal<T> {
        let mut nodal = Nodal::default();
        for point in 0..POINTS {
            let stress = self.stress(deformed, point);
            self.add_forces(&stress, point, &mut nodal);
        }
        nodal
    }

    /// P at an integration point times its volume [N m].
    #[inline(always)]
    fn stress(&self, deformed: &Deformed<T>, point: usize) -> Columns<T> {
        let f = &deformed.gradients[point];
        let two = Lanes::splat(2.0) * self.quarter * deformed.follows;
        let pressure = deformed.pressures[point] * self.quarter;
        let mut first = two * self.moduli.c10;
        let mut stress = cofactors(f).map(|column| scaled(&column, pressure));
        if deformed.has_second {
            let second = two * self.moduli.c01;
            let c = transposed_times(f, f);
            first += second * (c[0][0] + c[1][1] + c[2][2]);
            let fc = product(f, &c);
            for (column, fc) in stress.iter_mut().zip(&fc) {
                *column = plus(column, &scaled(fc, -second));
            }
        }
        for (column, f) in stress.iter_mut().zip(f) {
            *column = plus(column, &scaled(f, first));
        }
        if deformed.relaxes {
            deformed.subtract_history(f, point, self.quarter, &mut stress);
        }
        stress
    }

    /// The change of the forces when the nodes move by `nodal` [m].
    #[inline(always)]
    pub(super) fn change(&self, deformed: &Deformed<T>, nodal: &Nodal<T>) -> Nodal<T> {
        let mut sum = Lanes::default();
        let mut dilations = [Lanes::default(); POINTS];
        let mut changes = [Columns::default(); POINTS];
        for (point, change) in changes.iter_mut().enumerate() {
            *change = self.gradient(nodal, point);
            dilations[point] = contraction(&cofactors(&deformed.gradients[point]), change);
            sum += dilations[point];
        }
        let [of_mean, of_point] = self.moduli.of_dilations();
        let mean = of_mean * sum * Lanes::splat(1.0 / POINTS as f64);
        let mut forces = Nodal::default();
        for (point, change) in changes.iter().enumerate() {
            let by_dilation =
                (mean + of_point * dilations[point]) * self.quarter * deformed.follows;
            let stress = self.stress_change(deformed, point, change, by_dilation);
            self.add_forces(&stress, point, &mut forces);
        }
        forces
    }

    /// dP at an integration point times its volume [N m], for dF = `change`.
    #[inline(always)]
    fn stress_change(
        &self,
        deformed: &Deformed<T>,
        point: usize,
        change: &Columns<T>,
        by_dilation: Lanes<T>,
    ) -> Columns<T> {
        let f = &deformed.gradients[point];
        let two = Lanes::splat(2.0) * self.quarter * deformed.follows;
        let pressure = deformed.pressures[point] * self.quarter;
        let mut first = two * self.moduli.c10;
        let cofactors = cofactors(f);
        let mut stress = Columns::default();
        for (i, own) in stress.iter_mut().enumerate() {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let turned = plus(&cross(&change[j], &f[k]), &cross(&f[j], &change[k]));
            *own = plus(
                &scaled(&turned, pressure),
                &scaled(&cofactors[i], by_dilation),
            );
        }
        if deformed.has_second {
            let second = two * self.moduli.c01;
            let c = transposed_times(f, f);
            first += second * (c[0][0] + c[1][1] + c[2][2]);
            let along = Lanes::splat(2.0) * contraction(f, change) * second;
            let mixed = transposed_times(f, change);
            // dC = Fᵀ dF + (Fᵀ dF)ᵀ.
            let mut dc = mixed;
            for (i, column) in dc.iter_mut().enumerate() {
                for (j, entry) in column.iter_mut().enumerate() {
                    *entry += mixed[j][i];
                }
            }
            let (change_c, f_dc) = (product(change, &c), product(f, &dc));
            for (i, own) in stress.iter_mut().enumerate() {
                let bent = plus(&change_c[i], &f_dc[i]);
                *own = plus(own, &plus(&scaled(&f[i], along), &scaled(&bent, -second)));
            }
        }
        for (own, change) in stress.iter_mut().zip(change) {
            *own = plus(own, &scaled(change, first));
        }
        if deformed.relaxes {
            deformed.subtract_history(change, point, self.quarter, &mut stress);
        }
        stress
    }
}
