use super::bode;
use super::device::{Device, decibels};
use super::equation_7_6::PLACES;
use crate::Error;
use crate::published::rig_and_device;
use crate::row::Value;
use crate::{Item, Rows};

pub(crate) const FIGURE_7_8: Item = Item {
    name: "figure-7-8",
    title: "how much of the motor's force comes to the hand, over frequency",
    seconds: 2.4,
    run,
};

const NOTE: &str =
    "published: \"very close to unity\" under lower frequency; ours: magnitude by sines injected";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let devices = Device::both();
    let published = rig_and_device("figure-7-8", "ratio");
    for device in &devices {
        for (place, frequency) in PLACES {
            let value = Value::beside(published, device.injected(frequency)[1].norm(), "1");
            rows.add(&format!("{}/{place}", device.name), value, NOTE);
        }
        let rest = device.port.force_transmission.at(0.0).norm();
        for percent in [1_u8, 10] {
            let share = 1e-2 * f64::from(percent);
            let is_off =
                |f: &f64| (device.port.force_transmission.at(*f).norm() / rest - 1.0).abs() > share;
            let end = (1..100_000).map(|i| 0.01 * f64::from(i)).find(is_off);
            let value = Value {
                published: None,
                ours: end,
                unit: "Hz",
            };
            let name = format!("{}/within_{percent}_percent_to", device.name);
            rows.add(&name, value, WITHIN_NOTE);
        }
    }
    let note = "the source's circles are printed without numbers; dots: sines injected into the moving machine. The printed \
                function has no damping: at 26.8 Hz it has no end";
    let title = "Force transmission of the device";
    let magnitude = bode::plot(&devices, (title, "magnitude [dB]"), 1, |g| decibels(g, 1.0));
    rows.add_figure(None, &magnitude, note)?;
    let phase = bode::plot(&devices, (title, "phase [degrees]"), 1, bode::lagging);
    rows.add_figure(Some("phase"), &phase, note)
}

const WITHIN_NOTE: &str = "up to where the magnitude is so near to what it is at rest; the source's working range ends at 8 Hz";
