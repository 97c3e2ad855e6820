use std::f64::consts::TAU;

use palpate_jobs::plot::{Series, Style};

use super::bode;
use super::device::{Device, decibels, first_off};
use super::equation_7_6::PLACES;
use super::printed::PER_MM;
use crate::Error;
use crate::published::cell;
use crate::row::Rows;

/// A response that is so far off is another [dB].
const OFF: f64 = 1.0;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let devices = Device::both()?;
    let corner = cell("figure-7-7 low_frequency")? / TAU;
    rows.add("low_frequency", corner);
    let share = 1e-2 * cell("figure-7-7 share")?;
    let level = 20.0 * share.log10();
    rows.add("level", level);
    for device in &devices {
        for (place, frequency) in PLACES {
            let found = device.injected(frequency)[0].norm() / PER_MM;
            rows.row(&format!("{}/{place}", device.name))
                .published(share)
                .is(found);
        }
        let response = |f: f64| device.port.input_impedance.at(f).norm();
        let name = format!("{}/holds_to", device.name);
        rows.add(&name, first_off(response, OFF));
    }
    let mut magnitude = bode::curves(&devices, 0, |g| decibels(g, PER_MM));
    let claimed = vec![(0.1, level), (corner, level)];
    let name = "the caption's claim";
    magnitude.push(Series::new(name, claimed, Style::DashedLine, 5));
    rows.figure("").draw(magnitude)?;
    let phase = bode::curves(&devices, 0, bode::leading);
    rows.figure("phase").draw(phase)
}
