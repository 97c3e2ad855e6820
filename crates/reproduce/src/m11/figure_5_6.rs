use super::bode;
use super::device::{Device, decibels, first_off};
use crate::Error;
use crate::published::cell;
use crate::row::Rows;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let devices = Device::both()?;
    for device in &devices {
        let response = |f: f64| device.port.force_transmission.at(f).norm();
        let name = format!("{}/unaffected_below", device.name);
        rows.add(&name, first_off(response, 1.0));
    }
    let range = cell("section-5-2-2 range_of_interest")?;
    for device in &devices {
        let off = 100.0 * (device.injected(range)[1].norm() - 1.0);
        rows.add(&format!("{}/at_7_hz", device.name), off);
    }
    let curves = bode::curves(&devices, 1, |g| decibels(g, 1.0));
    rows.figure("").draw(curves)
}
