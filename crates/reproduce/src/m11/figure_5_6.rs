use super::bode;
use super::device::{Device, decibels, first_off};
use crate::Error;
use crate::published::rig_and_device;
use crate::row::Value;
use crate::{Item, Rows};

pub(crate) const FIGURE_5_6: Item = Item {
    name: "figure-5-6",
    title: "the indenting device as two masses: force on a tip that is held, over frequency",
    seconds: 1.2,
    run,
};

const NOTE: &str = "published: \"less than 30 Hz\" of section 5.2.2, in which the device does not influence the data; ours: where the force \
    on a held tip is 1 dB off the motor's. The two numbers of one device differ because (7.6) mixes units: its mode is at 27 Hz, where \
    chapter 5 sees none";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let devices = Device::both();
    let published = rig_and_device("section-5-2-2", "unaffected_below");
    for device in &devices {
        let response = |f: f64| device.port.force_transmission.at(f).norm();
        let value = Value {
            published,
            ours: first_off(response, 1.0),
            unit: "Hz",
        };
        rows.add(&format!("{}/unaffected_below", device.name), value, NOTE);
    }
    let range = rig_and_device("section-5-2-2", "range_of_interest");
    for (device, range) in devices.iter().zip([range; 2]) {
        let Some(range) = range else { continue };
        let off = 100.0 * (device.injected(range)[1].norm() - 1.0);
        let note = "how much more than the motor's the force on a held tip is at 7 Hz, the end of the source's range; by sines injected";
        rows.add(
            &format!("{}/at_7_hz", device.name),
            Value::own(off, "%"),
            note,
        );
    }
    let title = "Force on a held tip over the motor's";
    let plot = bode::plot(&devices, (title, "magnitude [dB]"), 1, |g| decibels(g, 1.0));
    let note = "the source prints neither the numbers of its two masses nor those of its circles; ours: the masses that (7.6) must \
                have been made of, and (7.6)";
    rows.add_figure(None, &plot, note)
}
