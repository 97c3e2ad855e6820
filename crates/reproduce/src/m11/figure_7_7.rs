use std::f64::consts::TAU;

use super::bode;
use super::device::{Device, decibels, first_off};
use super::equation_7_6::PLACES;
use crate::Error;
use crate::published::rig_and_device;
use crate::row::Value;
use crate::{Item, Rows};
use palpate_jobs::plot::{Series, Style};

pub(crate) const FIGURE_7_7: Item = Item {
    name: "figure-7-7",
    title: "what the hand feels of the device alone, over frequency",
    seconds: 2.6,
    run,
};

/// The unit of the printed function [N/m].
const PER_MM: f64 = 1e3;

/// A response that is so far off is another [dB].
const OFF: f64 = 1.0;

const SHARE_NOTE: &str = "published: \"less than 3.1 %\" of the caption, which can only be of 1 N/mm, below 100 rad/s; ours: magnitude \
    by sines injected. The printed function is there at rest alone: its mass rules from 3 Hz on";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let devices = Device::both();
    let of_caption = |what| rig_and_device("figure-7-7", what);
    let corner = of_caption("low_frequency").map(|omega| omega / TAU);
    let note = "published: \"100 rad/sec = 15 Hz\"; ours: 100 rad/s";
    rows.add(
        "low_frequency",
        Value {
            published: of_caption("low_frequency_in_hz"),
            ours: corner,
            unit: "Hz",
        },
        note,
    );
    let share = of_caption("share").map(|percent| 1e-2 * percent);
    let level = share.map(|share| 20.0 * share.log10());
    let note = "published: \"30dB\" of the caption, without a sign; ours: 3.1 % as a level, which is of a number with a unit: re 1 N/mm";
    rows.add(
        "level",
        Value {
            published: of_caption("level"),
            ours: level,
            unit: "dB",
        },
        note,
    );
    for device in &devices {
        for (place, frequency) in PLACES {
            let found = device.injected(frequency)[0].norm() / PER_MM;
            let value = Value::beside(share, found, "N/mm");
            rows.add(&format!("{}/{place}", device.name), value, SHARE_NOTE);
        }
        let response = |f: f64| device.port.input_impedance.at(f).norm();
        let value = Value {
            published: of_caption("low_frequency_in_hz"),
            ours: first_off(response, OFF),
            unit: "Hz",
        };
        let note = "published: the end of the caption's low frequencies; ours: where the magnitude is 1 dB off what it is at rest";
        rows.add(&format!("{}/holds_to", device.name), value, note);
    }
    let title = "Input impedance of the device";
    let label = "magnitude [dB re 1 N/mm]";
    let mut magnitude = bode::plot(&devices, (title, label), 0, |g| decibels(g, PER_MM));
    if let (Some(level), Some(corner)) = (level, corner) {
        let claimed = vec![(0.1, level), (corner, level)];
        magnitude.series.push(Series::new(
            "the caption's claim",
            claimed,
            Style::DashedLine,
            5,
        ));
    }
    let note = "the source's circles are printed without numbers; dots: sines injected into the moving machine";
    rows.add_figure(None, &magnitude, note)?;
    let phase = bode::plot(&devices, (title, "phase [degrees]"), 0, bode::leading);
    rows.add_figure(Some("phase"), &phase, note)
}
