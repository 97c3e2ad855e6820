use palpate_files::tissue::NonlinearSprings;

/// Parameters of a relaxing spring: k₁, k₂ and k₃ of its row of (6.4) [N, mm, s].
pub(super) const OF_BRANCH: usize = 3;
/// Parameters of the static spring: k₀₁ and k₀₂ of (6.4) [N, mm].
pub(super) const STATIC: usize = 2;
/// A step of the integrator times the fastest rate [-]: errors of some 1e-8.
const STEP: f64 = 0.05;
/// The fastest rate that is followed [1/s].
const FASTEST: f64 = 1e3;
/// Millimetres in a metre.
const MM: f64 = 1e3;

/// Forces [N] of (6.4) at `times` [s] for `depths` [m] that are linear in between, from rest.
///
/// Nothing where a spring is faster than 1 kHz.
pub fn springs_force(
    springs: &NonlinearSprings,
    times: &[f64],
    depths: &[f64],
) -> Option<Vec<f64>> {
    let all = springs.values().map(|parameter| parameter.value);
    let mut forces = vec![0.0; times.len()];
    respond(&all, times, depths, &mut |row, _, by| {
        forces[row] += by.force;
    })?;
    Some(forces)
}

/// Contribution of one spring to the force of a sample.
#[derive(Debug, Clone, Copy)]
pub(super) struct Share {
    /// Its force [N].
    pub force: f64,
    /// The change of it with the spring's parameters, in their order [N over the unit of each].
    pub by: [f64; OF_BRANCH],
}

/// Hands `add` the share of each spring in each sample: the row, the first of the spring's parameters among
/// `values`, its share. None where a spring is too fast.
pub(super) fn respond(
    values: &[f64],
    times: &[f64],
    depths: &[f64],
    add: &mut impl FnMut(usize, usize, Share),
) -> Option<()> {
    let (factor, exponent) = (values[0], values[1]);
    for (row, depth) in depths.iter().enumerate() {
        let power = Power::of(MM * depth, exponent);
        let by = [power.value, factor * power.by_exponent, 0.0];
        let force = factor * power.value;
        add(row, 0, Share { force, by });
    }
    let deepest = depths
        .iter()
        .fold(f64::MIN_POSITIVE, |most, d| most.max(MM * d.abs()));
    for (place, k) in values[STATIC..].chunks_exact(OF_BRANCH).enumerate() {
        let branch = Branch {
            rate: k[0],
            exponent: k[1],
        };
        let longest = branch.longest_step(deepest)?;
        let first = STATIC + place * OF_BRANCH;
        let mut state = State::default();
        for row in 0..times.len() {
            if row > 0 {
                let span = times[row] - times[row - 1];
                let course = [depths[row - 1], depths[row]].map(|depth| MM * depth);
                state = branch.follow(state, course, span, longest);
            }
            add(row, first, branch.share(k[2], &state, MM * depths[row]));
        }
    }
    Some(())
}

/// sign(e) |e|ⁿ [mmⁿ] and its changes.
struct Power {
    value: f64,
    by_stretch: f64,
    by_exponent: f64,
}

impl Power {
    fn of(stretch: f64, exponent: f64) -> Self {
        let size = stretch.abs();
        if size == 0.0 {
            return Self {
                value: 0.0,
                by_stretch: if exponent == 1.0 { 1.0 } else { 0.0 },
                by_exponent: 0.0,
            };
        }
        let logarithm = size.ln();
        let power = (exponent * logarithm).exp();
        let value = power.copysign(stretch);
        Self {
            value,
            by_stretch: exponent * power / size,
            by_exponent: value * logarithm,
        }
    }
}

/// A unit mass and a unit damper behind a spring.
struct Branch {
    rate: f64,
    exponent: f64,
}

/// Where the mass is [mm] and how fast [mm/s], and the changes of both with rate and exponent.
#[derive(Debug, Clone, Copy, Default)]
struct State([[f64; 2]; 3]);

impl State {
    /// This and `other` times `by`.
    fn plus(&self, other: &Self, by: f64) -> Self {
        Self(std::array::from_fn(|i| {
            std::array::from_fn(|j| self.0[i][j] + by * other.0[i][j])
        }))
    }
}

impl Branch {
    /// None when the spring is too fast.
    fn longest_step(&self, deepest: f64) -> Option<f64> {
        let stiffness = self.rate * self.exponent * deepest.powf(self.exponent - 1.0);
        let fastest = 1.0 + stiffness.sqrt();
        (fastest <= FASTEST).then(|| STEP / fastest)
    }

    /// While the depth goes from one [mm] to another during `span` [s], in steps up to `longest` [s].
    fn follow(&self, mut state: State, [from, to]: [f64; 2], span: f64, longest: f64) -> State {
        let steps = (span / longest).ceil();
        let at = |step: usize| from + (to - from) * (step as f64 / steps);
        for step in 0..steps as usize {
            state = self.step(&state, [at(step), at(step + 1)], span / steps);
        }
        state
    }

    fn change(&self, state: &State, depth: f64) -> State {
        let [[moved, speed], by_rate, by_exponent] = state.0;
        let power = Power::of(depth - moved, self.exponent);
        let pull = |own: f64, of: &[f64; 2]| own - self.rate * power.by_stretch * of[0] - of[1];
        State([
            [speed, self.rate * power.value - speed],
            [by_rate[1], pull(power.value, &by_rate)],
            [
                by_exponent[1],
                pull(self.rate * power.by_exponent, &by_exponent),
            ],
        ])
    }

    /// A `step` [s] of the classical method of Runge and Kutta, from one depth [mm] to another.
    fn step(&self, state: &State, [from, to]: [f64; 2], step: f64) -> State {
        let middle = 0.5 * (from + to);
        let a = self.change(state, from);
        let b = self.change(&state.plus(&a, 0.5 * step), middle);
        let c = self.change(&state.plus(&b, 0.5 * step), middle);
        let d = self.change(&state.plus(&c, step), to);
        let sum = a.plus(&b, 2.0).plus(&c, 2.0).plus(&d, 1.0);
        state.plus(&sum, step / 6.0)
    }

    fn share(&self, factor: f64, state: &State, depth: f64) -> Share {
        let [[moved, _], by_rate, by_exponent] = state.0;
        let power = Power::of(depth - moved, self.exponent);
        Share {
            force: factor * power.value,
            by: [
                -factor * power.by_stretch * by_rate[0],
                factor * (power.by_exponent - power.by_stretch * by_exponent[0]),
                power.value,
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: central differences of the forces, of a press, a hold and a way back.
    #[test]
    fn changes_are_differences() {
        let values = [0.002, 1.68, 0.025, 2.236, 0.007, 0.08, 2.184, 0.0005];
        let times: Vec<f64> = (0..300).map(|i| 0.05 * f64::from(i)).collect();
        let depths: Vec<f64> = times
            .iter()
            .map(|t| 8e-3 * t.min(1.0).min(0.1 * (14.0 - t)).max(0.0))
            .collect();
        let forces = |values: &[f64]| {
            let mut forces = vec![0.0; times.len()];
            respond(values, &times, &depths, &mut |row, _, by| {
                forces[row] += by.force
            })
            .unwrap();
            forces
        };
        let mut changes = vec![[0.0; 8]; times.len()];
        let mut add = |row: usize, first: usize, share: Share| {
            let count = if first == 0 { STATIC } else { OF_BRANCH };
            changes[row][first..first + count].copy_from_slice(&share.by[..count]);
        };
        respond(&values, &times, &depths, &mut add).unwrap();
        for place in 0..values.len() {
            let step = 1e-5 * values[place];
            let shifted = [step, -step].map(|by| {
                let mut shifted = values;
                shifted[place] += by;
                forces(&shifted)
            });
            let largest = changes.iter().fold(0.0, |m: f64, c| m.max(c[place].abs()));
            for row in 0..times.len() {
                let slope = (shifted[0][row] - shifted[1][row]) / (2.0 * step);
                // The square of the step, and rounding over it.
                let off = (changes[row][place] - slope).abs();
                assert!(off < 1e-7 * largest, "{place} at {row}: {off} of {largest}");
            }
        }
    }
}
