use std::f64::consts::TAU;

use nalgebra::Complex;
use palpate_measure::phantom::TwoMass;

use super::device::Device;
use super::printed::Printed;
use crate::Error;
use crate::row::Rows;

/// Where the source's claims are looked at: name, and frequency [Hz].
pub(super) const PLACES: [(&str, f64); 4] = [
    ("1_hz", 1.0),
    ("8_hz", 8.0),
    ("15_hz", 15.0),
    ("100_rad_per_s", 100.0 / TAU),
];

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let printed = Printed::read()?;
    let [m, b, k] = printed.g1;
    let [c4, c2, c0] = printed.below;
    let device = Device::printed(&printed);
    add_coefficients(rows, &device);
    for (name, frequency) in PLACES {
        let s = Complex::new(0.0, TAU * frequency);
        let [g1, g2] = device.injected(frequency);
        rows.row(&format!("g1/{name}"))
            .published((s * s * m + s * b + k).norm())
            .is(1e-3 * g1.norm());
        let whole = Complex::from(printed.above) / (s * s * s * s * c4 + s * s * c2 + c0);
        rows.row(&format!("g2/{name}"))
            .published(whole.norm())
            .is(g2.norm());
    }
    let [slow, fast] = printed.modes();
    rows.add("g2/first_mode", slow.sqrt() / TAU);
    rows.add("g2/second_mode", fast.sqrt() / TAU);
    let mode = TwoMass::consistent().structural_frequency();
    rows.add("two_masses/mode", mode);
    Ok(())
}

/// Mass, damping and stiffness from two sines: G₁ = k − m ω² + i b ω.
fn add_coefficients(rows: &mut Rows<'_>, device: &Device) {
    let omega = [1.0, 15.0].map(|frequency| TAU * frequency);
    let [slow, fast] = [1.0, 15.0].map(|frequency| device.injected(frequency)[0] * 1e-3);
    let mass = (slow.re - fast.re) / (omega[1].powi(2) - omega[0].powi(2));
    rows.add("g1/mass", mass);
    rows.add("g1/damping", fast.im / omega[1]);
    rows.add("g1/stiffness", slow.re + mass * omega[0].powi(2));
}
