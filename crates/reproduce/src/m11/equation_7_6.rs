use std::f64::consts::TAU;

use nalgebra::Complex;

use super::device::Device;
use crate::Error;
use crate::published::DEVICE_7_6;
use crate::row::Value;
use crate::{Item, Rows};

pub(crate) const EQUATION_7_6: Item = Item {
    name: "equation-7-6",
    title: "input impedance and force transmission of the device",
    seconds: 0.1,
    run,
};

/// Where the source's claims are looked at: name, and frequency [Hz].
pub(super) const PLACES: [(&str, f64); 4] = [
    ("1_hz", 1.0),
    ("8_hz", 8.0),
    ("15_hz", 15.0),
    ("100_rad_per_s", 100.0 / TAU),
];

const NOTE: &str = "published: magnitude of (7.6) by its printed coefficients; ours: what the same machine, as equations of motion, \
    answers to sines of the hand and of the motor, in time, in steps of 50 µs";

const UNIT_NOTE: &str = "no unit is printed: in N/mm the device has 96.4 g, 2.6 N s/m and 32 N/m; in N/m it would weigh 0.1 g. Ours: \
    read back from the sines injected at 1 and 15 Hz";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let cells = ["m", "b", "k", "g2_num", "g2_c4", "g2_c2", "g2_c0"];
    let cells = cells.map(|column| DEVICE_7_6.first(column));
    let [
        Some(m),
        Some(b),
        Some(k),
        Some(above),
        Some(c4),
        Some(c2),
        Some(c0),
    ] = cells
    else {
        rows.add_missing("g1", "N/mm", "the printed coefficients cannot be read");
        return Ok(());
    };
    let device = Device::printed();
    add_coefficients(rows, &device, [m, b, k]);
    for (name, frequency) in PLACES {
        let s = Complex::new(0.0, TAU * frequency);
        let printed = [
            (s * s * m + s * b + k).norm(),
            (Complex::from(above) / (s * s * s * s * c4 + s * s * c2 + c0)).norm(),
        ];
        let [g1, g2] = device.injected(frequency);
        let g1 = Value::beside(Some(printed[0]), 1e-3 * g1.norm(), "N/mm");
        rows.add_pipeline_only(&format!("g1/{name}"), g1, NOTE);
        let g2 = Value::beside(Some(printed[1]), g2.norm(), "1");
        rows.add_pipeline_only(&format!("g2/{name}"), g2, NOTE);
    }
    add_modes(rows, [c4, c2, c0]);
    Ok(())
}

/// Mass, damping and stiffness from two sines: G₁ = k − m ω² + i b ω.
fn add_coefficients(rows: &mut Rows<'_>, device: &Device, printed: [f64; 3]) {
    let omega = [1.0, 15.0].map(|frequency| TAU * frequency);
    let [slow, fast] = [1.0, 15.0].map(|frequency| device.injected(frequency)[0] * 1e-3);
    let mass = (slow.re - fast.re) / (omega[1].powi(2) - omega[0].powi(2));
    let found = [
        ("mass", mass, "N s²/mm"),
        ("damping", fast.im / omega[1], "N s/mm"),
        ("stiffness", slow.re + mass * omega[0].powi(2), "N/mm"),
    ];
    for ((name, ours, unit), printed) in found.into_iter().zip(printed) {
        let value = Value::beside(Some(printed), ours, unit);
        rows.add_pipeline_only(&format!("g1/{name}"), value, UNIT_NOTE);
    }
}

/// Where c₄ s⁴ + c₂ s² + c₀ is zero.
fn add_modes(rows: &mut Rows<'_>, [c4, c2, c0]: [f64; 3]) {
    let root = (c2 * c2 - 4.0 * c4 * c0).sqrt();
    let fast = (c2 + root) / (2.0 * c4);
    let slow = c0 / (c4 * fast);
    let note = "roots of the printed denominator, which nothing damps; the source names none. Its coefficients come of inertias \
                about joints [kg m²] beside stiffnesses of the tip [N/m]: with one unit the two masses swing at \
                `two_masses/mode`";
    rows.add("g2/first_mode", Value::own(slow.sqrt() / TAU, "Hz"), note);
    rows.add("g2/second_mode", Value::own(fast.sqrt() / TAU, "Hz"), note);
    let mode = palpate_measure::phantom::TwoMass::consistent().structural_frequency();
    let note = "of two masses made of what the printed coefficients must have been made of: 79.5 g, 4.1 g, 3545 N/m";
    rows.add("two_masses/mode", Value::own(mode, "Hz"), note);
}
