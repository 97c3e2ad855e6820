//! Bode plots: lines of formulas, dots of sines that were injected.

use nalgebra::Complex;

use super::device::Device;
use palpate_jobs::plot::{Series, Style};

/// Frequencies of a plot: the lowest, the highest [Hz], and how many dots are in a decade.
const LOWEST: f64 = 0.1;
const HIGHEST: f64 = 100.0;
const DOTS: i32 = 5;
/// Points of a line in a decade.
const FINE: i32 = 200;

/// The frequencies of dots, or of a line [Hz].
fn frequencies(in_a_decade: i32) -> impl Iterator<Item = f64> {
    let decades = (HIGHEST / LOWEST).log10().round() as i32;
    (0..=decades * in_a_decade)
        .map(move |i| LOWEST * 10_f64.powf(f64::from(i) / f64::from(in_a_decade)))
}

/// What is drawn of a response: a magnitude [dB] or a phase [degrees].
pub(super) type Shown = fn(Complex<f64>) -> f64;

/// The curves of `shown` of one of the two functions of each device.
pub(super) fn curves(devices: &[Device; 2], of_function: usize, shown: Shown) -> Vec<Series> {
    let mut series = Vec::new();
    for (color, device) in devices.iter().enumerate() {
        let functions = [
            &device.port.input_impedance,
            &device.port.force_transmission,
        ];
        let function = functions[of_function];
        let line = frequencies(FINE).map(|f| (f, shown(function.at(f))));
        let dots = frequencies(DOTS).map(|f| (f, shown(device.injected(f)[of_function])));
        let name = device.words;
        series.push(Series::new(name, line.collect(), Style::Line, color));
        let name = format!("{name}, sines injected");
        series.push(Series::new(name, dots.collect(), Style::Dots, color));
    }
    series
}

/// Phase of a response that leads [degrees].
pub(super) fn leading(value: Complex<f64>) -> f64 {
    value.arg().to_degrees()
}

/// Phase of a response that lags [degrees]: one that turns against itself is half a turn behind.
pub(super) fn lagging(value: Complex<f64>) -> f64 {
    let degrees = leading(value);
    if degrees > 90.0 {
        degrees - 360.0
    } else {
        degrees
    }
}
