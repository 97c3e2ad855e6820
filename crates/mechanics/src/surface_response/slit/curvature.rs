//! Effect of the curvature of a tube's wall on a slit along it: tables of a shell less a plate.
//!
//! H and T of a shell less those of a plate are smooth: their inverse Fourier integrals are tables over the distance,
//! for one ν and some radii. Lengths are taken in thicknesses and √(R w), by which tables of neighbouring radii are
//! nearly one; entries between them are interpolated.
//!
//! *How we know*: below: Folias' factor; `slit::other_slits_are_those_of_finite_elements`.
//!
//! *Limits*: those of `shell`; waves shorter than √(R w) π/2 are left out.

use std::f64::consts::PI;

use nalgebra::Matrix5;
use palpate_geometry::on_all_cores;

use super::shell::{FourierShell, difference};

/// Radii of the tables, in thicknesses. As these tables are scaled, those of thinner walls are the last.
const RADII: [f64; 9] = [1.0, 1.5, 2.25, 3.4, 5.0, 7.5, 11.0, 17.0, 30.0];

/// Distances of a table end here, in lengths √(R w), of which each step is a part.
const FAR: f64 = 12.0;
const STEP: f64 = 0.1;
const PLACES: usize = 121;

/// Wave numbers fade here and end here, over √(R w), after so many steps.
const FADE: f64 = 4.0;
const LAST: f64 = 6.0;
const WAVES: usize = 60;

/// Places of forces go as far, in the same steps across and along.
const END: f64 = 3.0;
const SPACING: f64 = 0.25;
const SIDE: usize = 13;

/// How the entries fall with the radius, in thicknesses.
const FORCE_POWERS: [f64; 4] = [0.0, 0.5, 1.0, 1.0];
const POWERS: [f64; 6] = [1.0, 1.0, 1.0, 1.0, 2.0, 1.5];

/// Effect of curvature, for one ν.
#[derive(Debug)]
pub(super) struct Curvature {
    /// In H, over the distance.
    jumps: Vec<[[f64; 6]; PLACES]>,
    /// In T, over places across and along.
    forces: Vec<[[[f64; 4]; SIDE]; SIDE]>,
}

/// The medium around a slit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Medium<'a> {
    /// Poisson's ratio [-].
    pub(super) nu: f64,
    /// Effect of the curvature of a wall.
    pub(super) tube: &'a Curvature,
}

impl Curvature {
    pub(super) fn new(nu: f64) -> Self {
        let mut whole = Self {
            jumps: vec![[[0.0; 6]; PLACES]; RADII.len()],
            forces: vec![[[[0.0; 4]; SIDE]; SIDE]; RADII.len()],
        };
        let places = whole.jumps.iter_mut().zip(&mut whole.forces);
        // The thinnest wall takes longest.
        on_all_cores(
            RADII.iter().zip(places).rev(),
            |(&radius, (jumps, forces))| {
                *jumps = jump_influences(nu, radius);
                *forces = of_forces(nu, radius);
            },
        );
        whole
    }

    /// Increments by curvature across and along from a unit force on a face (1 outer, −1 inner) [1/m]: N of a force outward, V of it and of one
    /// across.
    pub(super) fn of_force(
        &self,
        curvature: f64,
        thickness: f64,
        [across, along]: [f64; 2],
        face: f64,
    ) -> [f64; 3] {
        let radius = (1.0 / (curvature.abs() * thickness).max(1e-6)).max(1.0);
        let (low, high, part) = between(radius);
        let scale = thickness * radius.sqrt();
        let at = [across.abs() / scale, along.abs() / scale];
        // Farther they fall.
        let fall = (END / at[0].max(at[1])).min(1.0).powi(2);
        let [(i, p), (j, q)] = at.map(|at| {
            let place = at.min(END) / SPACING;
            let step = (place as usize).min(SIDE - 2);
            (step, place - step as f64)
        });
        let seen = |table: usize, entry: usize| {
            let table = &self.forces[table];
            let row = |i: usize| table[i][j][entry] * (1.0 - q) + table[i][j + 1][entry] * q;
            row(i) * (1.0 - p) + row(i + 1) * p
        };
        let found: [f64; 4] = std::array::from_fn(|entry| {
            let scaled = seen(low, entry) * (1.0 - part) + seen(high, entry) * part;
            scaled * fall / (thickness * radius.powf(FORCE_POWERS[entry]))
        });
        let side = curvature.signum();
        [
            found[0] * side,
            found[1] * across.signum(),
            (found[2] + found[3] * face * side) * side,
        ]
    }

    /// Effect of curvature on the tractions of a unit jump on a unit length at another, `away` from it along the
    /// slit, over E [1/m]: rows and columns are the modes of a facet.
    pub(super) fn jump_influence(&self, curvature: f64, thickness: f64, away: f64) -> Matrix5<f64> {
        let slim = 1.0 / (curvature.abs() * thickness).max(1e-6);
        let [nn, nh, hh, ss, ww, sw] = self.entries(slim.max(1.0), away.abs() / thickness);
        let nh = nh * curvature.signum();
        let sw = sw * curvature.signum() * away.signum();
        Matrix5::new(
            nn, 0.0, nh, 0.0, 0.0, //
            0.0, ss, 0.0, 0.0, sw, //
            nh, 0.0, hh, 0.0, 0.0, //
            0.0, 0.0, 0.0, 0.0, 0.0, //
            0.0, -sw, 0.0, 0.0, ww,
        ) / thickness
    }

    /// The entries at a radius and a distance, both in thicknesses.
    fn entries(&self, radius: f64, distance: f64) -> [f64; 6] {
        let (low, high, part) = between(radius);
        let at = distance / radius.sqrt();
        // Farther they fall as those of a plate.
        let fall = (FAR / at).min(1.0).powi(2);
        let place = at.min(FAR) / STEP;
        let step = (place as usize).min(PLACES - 2);
        let along = place - step as f64;
        let seen = |table: usize, entry: usize| {
            let table = &self.jumps[table];
            table[step][entry] * (1.0 - along) + table[step + 1][entry] * along
        };
        std::array::from_fn(|entry| {
            let scaled = seen(low, entry) * (1.0 - part) + seen(high, entry) * part;
            scaled * fall / radius.powf(POWERS[entry])
        })
    }
}

/// The tables between which a radius lies, and how far it is towards the second.
fn between(radius: f64) -> (usize, usize, f64) {
    let last = RADII.len() - 1;
    match RADII.iter().position(|&other| other > radius) {
        Some(0) => (0, 0, 0.0),
        Some(high) => {
            let (low, high) = (high - 1, high);
            let part = (radius / RADII[low]).ln() / (RADII[high] / RADII[low]).ln();
            (low, high, part)
        }
        None => (last, last, 0.0),
    }
}

/// What forces do, over places across and along, for a wall of thickness one: N of a force outward; and less that of
/// a plate V of it, of a force across in the middle of the wall, and of the couple that is left.
fn of_forces(nu: f64, radius: f64) -> [[[f64; 4]; SIDE]; SIDE] {
    let [shell, plate] = [1.0 / radius, 0.0].map(|curvature| FourierShell {
        nu,
        curvature,
        thickness: 1.0,
    });
    let stiffness = shell.stiffness();
    let scale = radius.sqrt();
    let width = LAST / WAVES as f64;
    let most = (LAST * scale).ceil() as usize;
    let mut sums = [[[0.0; 4]; SIDE]; SIDE];
    for step in 0..=WAVES {
        let x = (step as f64 * width).max(0.02);
        let k = x / scale;
        let end = if step == 0 { 0.5 } else { 1.0 };
        let weight = end * width / scale / (PI * 2.0 * PI * radius);
        let mut lines = [[0.0; 4]; SIDE];
        for n in 0..=most {
            let q = n as f64 / radius;
            let fade = (-((x * x + q * q * radius) / (FADE * FADE)).powi(2)).exp();
            let rows = [shell, plate].map(|waves| waves.term(&stiffness, [k, q]));
            let [Some((_, bent)), Some((_, flat))] = rows else {
                continue;
            };
            let part = fade * weight * if n == 0 { 1.0 } else { 2.0 };
            for (place, line) in lines.iter_mut().enumerate() {
                let (sine, cosine) = (q * scale * SPACING * place as f64).sin_cos();
                line[0] += part * cosine * bent[(0, 0)];
                line[1] -= part * sine * (bent[(3, 0)] - flat[(3, 0)]);
                line[2] -= part * cosine * (bent[(3, 1)] - flat[(3, 1)]);
                line[3] -= part * cosine * (bent[(3, 2)] - flat[(3, 2)]);
            }
        }
        for (across, line) in lines.iter().enumerate() {
            for (along, sum) in sums[across].iter_mut().enumerate() {
                let cosine = (x * SPACING * along as f64).cos();
                for (entry, sum) in sum.iter_mut().enumerate() {
                    *sum += line[entry] * cosine * radius.powf(FORCE_POWERS[entry]);
                }
            }
        }
    }
    sums
}

/// The entries over the distance, for a wall of thickness one.
fn jump_influences(nu: f64, radius: f64) -> [[f64; 6]; PLACES] {
    let width = LAST / WAVES as f64;
    let waves: Vec<[f64; 6]> = (0..=WAVES)
        .map(|step| {
            let x = (step as f64 * width).max(1e-3);
            let found = difference(nu, [radius, 1.0], x / radius.sqrt());
            let fade = (-(x / FADE).powi(4)).exp();
            let turn = [1.0, 2.0, 4.0, 1.0, 1.0, 1.0];
            std::array::from_fn(|k| found[k] * turn[k] * fade * radius.powf(POWERS[k] - 0.5) / PI)
        })
        .collect();
    std::array::from_fn(|place| {
        let at = place as f64 * STEP;
        std::array::from_fn(|entry| {
            let parts = waves.windows(2).enumerate().map(|(step, ends)| {
                let low = step as f64 * width;
                let [low, high] = [low, low + width].map(|x| x * at);
                let [from, to] = [ends[0][entry], ends[1][entry]];
                width
                    * if entry == 5 {
                        of_line([from, to], [low, high]).1
                    } else {
                        of_line([from, to], [low, high]).0
                    }
            });
            parts.sum()
        })
    })
}

/// Means of a straight line between two values times the cosine and the sine of an angle that goes from one to
/// another.
fn of_line([from, to]: [f64; 2], [low, high]: [f64; 2]) -> (f64, f64) {
    let turn = high - low;
    if turn < 1e-3 {
        let middle = 0.5 * (low + high);
        return (
            0.5 * (from + to) * middle.cos(),
            0.5 * (from + to) * middle.sin(),
        );
    }
    let slope = (to - from) / turn;
    let cosine = to * high.sin() - from * low.sin() + slope * (high.cos() - low.cos());
    let sine = from * low.cos() - to * high.cos() + slope * (high.sin() - low.sin());
    (cosine / turn, sine / turn)
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;

    /// Judge: the factor of a slit along a thin tube under an even N [Folias 1965]; the square of what it opens more
    /// at its ends than in a plate. Tolerance: of his series' first term, a tenth.
    #[test]
    fn a_short_slit_bulges_as_folias_says() {
        let (nu, radius) = (1.0 / 3.0, 30.0_f64);
        let tube = Curvature::new(nu);
        let count = 40;
        for half in [0.4, 0.7, 1.0].map(|part: f64| part * radius.sqrt()) {
            let length = 2.0 * half / count as f64;
            let opens = |curvature: f64| {
                let matrix = DMatrix::from_fn(2 * count, 2 * count, |i, j| {
                    let away = (i / 2) as f64 - (j / 2) as f64;
                    let line = 1.0 / (4.0 * PI) / (0.25 - away * away);
                    let hinge = (3.0 + nu) / (3.0 * (1.0 + nu));
                    let flat = line * [1.0, 0.0, 0.0, hinge][2 * (i % 2) + j % 2];
                    let bent = tube.jump_influence(curvature, 1.0, away * length);
                    let bent = if curvature > 0.0 {
                        bent
                    } else {
                        Matrix5::zeros()
                    };
                    flat + bent[(2 * (i % 2), 2 * (j % 2))] * length * length
                });
                let even =
                    DVector::from_fn(2 * count, |i, _| if i % 2 == 0 { length } else { 0.0 });
                matrix.cholesky().unwrap().solve(&even)[0]
            };
            let more = (opens(1.0 / radius) / opens(0.0)).powi(2);
            let expected = 1.0 + 1.61 * half * half / radius;
            assert!((more / expected - 1.0).abs() < 0.1, "{more} {expected}");
        }
    }
}
