use super::bode;
use super::device::{Device, decibels};
use super::equation_7_6::PLACES;
use crate::Error;
use crate::row::Rows;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let devices = Device::both()?;
    for device in &devices {
        for (place, frequency) in PLACES {
            let found = device.injected(frequency)[1].norm();
            rows.add(&format!("{}/{place}", device.name), found);
        }
        let response = |f: f64| device.port.force_transmission.at(f).norm();
        for percent in [1_u8, 10] {
            let share = 1e-2 * f64::from(percent);
            let is_off = |f: &f64| (response(*f) / response(0.0) - 1.0).abs() > share;
            let end = (1..100_000).map(|i| 0.01 * f64::from(i)).find(is_off);
            let name = format!("{}/within_{percent}_percent_to", device.name);
            rows.add(&name, end);
        }
    }
    let magnitude = bode::curves(&devices, 1, |g| decibels(g, 1.0));
    rows.figure("").draw(magnitude)?;
    let phase = bode::curves(&devices, 1, bode::lagging);
    rows.figure("phase").draw(phase)
}
