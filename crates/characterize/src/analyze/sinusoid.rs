//! The response to a sine, by harmonic regression over whole periods.
//!
//! Depth and force are fitted by a constant, a slope and three exponentials, which take up relaxation,
//! and by Σ aₙ cos nωt + bₙ sin nωt, n = 1 to 3, over the whole periods at the end of the swing; the first is
//! left to the transient where there are three or more. Of the first harmonics, D and F,
//!   stiffness = |F| / |D|,  phase = arg F − arg D,
//! and the area of the loop is ∮ F dd = π Σ n (aₙᶠ bₙᵈ − bₙᶠ aₙᵈ), the energy lost in a period;
//! π |F| |D| sin(phase) where the answer is linear.
//!
//! Standard errors are those of correlated residuals (`fit/correlated.rs`): a sensor drifts and is filtered, a heart
//! beats. Of the first harmonic the error along its amplitude is that of the stiffness, the one across it that of
//! the phase; force and depth both have theirs.
//!
//! *How we know*: `sinusoid::kelvin_solid`, `sinusoid::prony_series`, `sinusoid::area_is_the_integral`,
//! `sinusoid::intervals_hold_the_truth_in_correlated_noise`.
//!
//! *Limits*: the noise of force and depth are taken as independent of one another.

use std::f64::consts::{PI, TAU};

use nalgebra::{DMatrix, Matrix2, Vector2};

use crate::CleanRecording;
use crate::clean::Segment;
use crate::clean::regression::{Regression, regress, relaxation};
use crate::clean::swing::Sine;
use crate::fit::{Fit, Parameter, Stop, correlated_uncertainty};

/// Harmonics fitted.
const HARMONICS: usize = 3;
/// Columns of the fit that take up relaxation.
const RELAXATION: usize = 5;
/// Columns of the fit, two for each harmonic.
const COLUMNS: usize = RELAXATION + 2 * HARMONICS;
/// Fewest samples in a period that show three harmonics.
const FEWEST_SAMPLES: f64 = 8.0;
/// Distortion from which the answer counts as not linear [-].
const DISTORTED: f64 = 0.1;

/// The answer to a sine.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Sinusoid {
    /// Frequency [Hz].
    pub frequency_hz: f64,
    /// Amplitude of the force over that of the depth [N/m].
    pub stiffness_n_per_m: f64,
    /// Its standard error [N/m].
    #[serde(rename = "stiffness_standard_error")]
    pub stiffness_error_n_per_m: f64,
    /// Phase of the force before that of the depth [rad], positive when the force leads.
    pub phase_rad: f64,
    /// Its standard error [rad].
    #[serde(rename = "phase_standard_error")]
    pub phase_error_rad: f64,
    /// Energy lost in a period [J], the area of the loop; positive when lost.
    pub hysteresis_j: f64,
    /// Amplitude of the depth [m], half from peak to peak.
    pub amplitude_m: f64,
    /// Depth around which the indenter swung [m].
    #[serde(rename = "pre_indentation_m")]
    pub depth_m: f64,
    /// Second and third harmonic of the force over the first [-]: zero for a linear answer.
    pub distortion: f64,
    /// The same of the depth [-]: what the device adds.
    #[serde(skip)]
    pub depth_distortion: f64,
    /// Periods that were fitted.
    pub periods: usize,
    /// First sample fitted.
    #[serde(skip)]
    pub first: usize,
    /// One past the last sample fitted.
    #[serde(skip)]
    pub end: usize,
}

impl Sinusoid {
    pub(super) fn of(
        recording: &CleanRecording,
        segment: &Segment,
        frequency: f64,
        warnings: &mut Vec<String>,
    ) -> Option<Self> {
        let time = &recording.time;
        let end_time = time[segment.end - 1];
        let all = (end_time - time[segment.first]) * frequency;
        // A hair is allowed for the last sample of a whole number of periods.
        let periods = (all + 1e-6).floor().max(1.0);
        let periods = if periods >= 3.0 {
            periods - 1.0
        } else {
            periods
        };
        let from = end_time - periods / frequency;
        // The sample at the very beginning is the one at the end, a period later.
        let skipped =
            time[segment.first..segment.end].partition_point(|t| *t <= from + 1e-9 / frequency);
        let samples = segment.first + skipped..segment.end;
        if (samples.len() as f64) < FEWEST_SAMPLES * periods {
            warnings.push(format!(
                "the sine of {frequency:.2} Hz has fewer than 8 samples in a period and is passed over; measure faster"
            ));
            return None;
        }
        // Without the sine's beginning its frequency is known better.
        let whole = Sine::fit(
            &time[samples.clone()],
            &recording.depth[samples.clone()],
            frequency,
        )?;
        let frequency = whole.frequency;
        let depth = Swing::of(
            &time[samples.clone()],
            &recording.depth[samples.clone()],
            frequency,
        )?;
        let force = Swing::of(
            &time[samples.clone()],
            &recording.force[samples.clone()],
            frequency,
        )?;
        let stiffness = force.amplitude() / depth.amplitude();
        let [of_force, of_depth] = [force.relative_errors(), depth.relative_errors()];
        let [stretched, turned] = [0, 1].map(|part| of_force[part].hypot(of_depth[part]));
        let answer = Self {
            frequency_hz: frequency,
            depth_m: depth.mean,
            amplitude_m: depth.amplitude(),
            stiffness_n_per_m: stiffness,
            stiffness_error_n_per_m: stiffness * stretched,
            phase_rad: wrapped(force.phase() - depth.phase()),
            phase_error_rad: turned,
            hysteresis_j: force.area_over(&depth),
            distortion: force.distortion(),
            depth_distortion: depth.distortion(),
            periods: periods as usize,
            first: samples.start,
            end: samples.end,
        };
        if answer.distortion > DISTORTED + answer.depth_distortion {
            warnings.push(format!(
                "the force at {frequency:.2} Hz has harmonics of {:.0} % of its swing: stiffness and phase are those of its first harmonic alone",
                1e2 * answer.distortion
            ));
        }
        warnings.extend(answer.gain());
        Some(answer)
    }

    /// A warning when the loop runs backwards, as no passive tissue makes it.
    fn gain(&self) -> Option<String> {
        // Rounding, of a loop without area.
        let energy = self.stiffness_n_per_m * self.amplitude_m.powi(2);
        if self.hysteresis_j >= -1e-9 * energy {
            return None;
        }
        let (frequency, gained) = (self.frequency_hz, -1e6 * self.hysteresis_j);
        // Two standard errors: one in twenty of the loops without loss.
        Some(match self.phase_rad < -2.0 * self.phase_error_rad {
            true => format!(
                "the sine of {frequency:.2} Hz gives back {gained:.3} µJ per cycle more than it takes, which no passive tissue does: \
                 force is recorded about {:.1} ms later than depth; check the delays of both channels",
                -1e3 * self.phase_rad / (TAU * frequency)
            ),
            false => format!(
                "the energy lost per cycle of the sine of {frequency:.2} Hz, {:.3} µJ, cannot be told from zero",
                -gained
            ),
        })
    }
}

/// The harmonics of a signal.
struct Swing {
    mean: f64,
    /// Coefficients of cosine and sine.
    harmonics: [[f64; 2]; HARMONICS],
    /// Covariance of the first pair.
    covariance: Matrix2<f64>,
}

impl Swing {
    fn of(time: &[f64], values: &[f64], frequency: f64) -> Option<Self> {
        let (start, end) = (time.first()?, time.last()?);
        let row = |sample: usize| {
            let mut row = [0.0; COLUMNS];
            row[..RELAXATION].copy_from_slice(&relaxation((time[sample] - start) / (end - start)));
            for order in 0..HARMONICS {
                let turn = (order + 1) as f64 * TAU * frequency * time[sample];
                let place = RELAXATION + 2 * order;
                (row[place + 1], row[place]) = turn.sin_cos();
            }
            row
        };
        let fit: Regression = regress(values, row)?;
        let mut harmonics = [[0.0; 2]; HARMONICS];
        for (own, pair) in harmonics
            .iter_mut()
            .zip(fit.coefficients[RELAXATION..].chunks(2))
        {
            *own = [pair[0], pair[1]];
        }
        Some(Self {
            mean: values.iter().sum::<f64>() / values.len() as f64,
            harmonics,
            covariance: covariance(&fit.coefficients, values, row),
        })
    }

    fn amplitude(&self) -> f64 {
        self.harmonics[0][0].hypot(self.harmonics[0][1])
    }

    /// Angle of a cosine: a cos ωt + b sin ωt = A cos(ωt + phase).
    fn phase(&self) -> f64 {
        (-self.harmonics[0][1]).atan2(self.harmonics[0][0])
    }

    /// Standard errors of the first amplitude, over it [-], and of its angle [rad].
    fn relative_errors(&self) -> [f64; 2] {
        let [cosine, sine] = self.harmonics[0];
        let size = self.amplitude();
        [Vector2::new(cosine, sine), Vector2::new(-sine, cosine)].map(|direction| {
            let direction = direction / size;
            direction
                .dot(&(self.covariance * direction))
                .max(0.0)
                .sqrt()
                / size
        })
    }

    fn distortion(&self) -> f64 {
        let higher = self.harmonics[1..].iter().flatten();
        higher.map(|x| x * x).sum::<f64>().sqrt() / self.amplitude()
    }

    /// ∮ self d(depth).
    fn area_over(&self, depth: &Self) -> f64 {
        let both = (1..).zip(self.harmonics.iter().zip(&depth.harmonics));
        let terms = both.map(|(order, (force, depth))| {
            f64::from(order) * (force[0] * depth[1] - force[1] * depth[0])
        });
        PI * terms.sum::<f64>()
    }
}

/// Covariance of cosine and sine of the first harmonic, for residuals that may be correlated.
fn covariance(
    coefficients: &[f64],
    values: &[f64],
    row: impl Fn(usize) -> [f64; COLUMNS],
) -> Matrix2<f64> {
    let samples = values.len();
    let mut jacobian = DMatrix::zeros(samples, COLUMNS);
    let mut residuals = Vec::with_capacity(samples);
    for (sample, value) in values.iter().enumerate() {
        let row = row(sample);
        let model: f64 = row.iter().zip(coefficients).map(|(x, c)| x * c).sum();
        residuals.push(model - value);
        for (column, entry) in row.into_iter().enumerate() {
            jacobian[(sample, column)] = entry;
        }
    }
    let parameter = |value: &f64| Parameter::new("coefficient", *value);
    let fit = Fit {
        parameters: coefficients.iter().map(parameter).collect(),
        residuals,
        jacobian,
        iterations: Vec::new(),
        stop: Stop::Converged,
        evaluations: 1,
    };
    let known = correlated_uncertainty(&fit, &[samples]).covariance;
    known
        .fixed_view::<2, 2>(RELAXATION, RELAXATION)
        .into_owned()
}

/// An angle [rad] between −π and π.
pub(super) fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}
