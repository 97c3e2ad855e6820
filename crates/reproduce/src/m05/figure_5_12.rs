use palpate_characterize::analyze;
use palpate_characterize::clean::{CleanSettings, clean};
use palpate_files::protocol::Stimulus;

use super::organ::{NOTE, STEADY, beating, specimen};
use super::rig::{Measured, measured};
use crate::Error;
use crate::m06::Printed;
use crate::published::rig_and_device;
use crate::row::Value;
use crate::virtual_rig::RAMP;
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const FIGURE_5_12: Item = Item {
    name: "figure-5-12",
    title: "recordings of the liver under ramps and holds",
    seconds: 0.99,
    run: |rows| run(rows, "liver", &[8, 6, 4, 2]),
};

/// The caption names 5 mm twice.
pub(crate) const FIGURE_5_13: Item = Item {
    name: "figure-5-13",
    title: "recordings of the kidney under ramps and holds",
    seconds: 1.5,
    run: |rows| run(rows, "kidney", &[8, 6, 5, 4, 2, 1]),
};

/// Samples of 1 ms that a point of the picture is the mean of: a heart of 1.5 Hz remains.
const AVERAGED: usize = 25;

const STEADY_NOTE: &str = "published: mean of table 5-1; ours: `analyze` on what the virtual rig recorded, one animal with a heart of 1.5 Hz \
    that moves the surface by 0.4 mm. The specimen is made of the published mean: what is judged is the way from it through approach, \
    device, sensor and analysis. Where the beating surface was met decides over the depth";

const SETTLED_NOTE: &str = "published: \"within 10 % after about 40 s\" of section 5.4.2; ours: the first time after which the filtered \
    force, less the heart's ripple, stays within 10 % of its last tenth. By the source's own relaxation times that is sooner";

const RIPPLE_NOTE: &str = "amplitude of the heart's ripple in the force; the source draws it without numbers, and the virtual heart's 0.4 mm \
    are assumed";

fn run(rows: &mut Rows<'_>, organ: &str, depths: &[u32]) -> Result<(), Error> {
    let alive = beating(specimen(organ, |row| row.mean)?, 1);
    let settled = rig_and_device("section-5-4-2", "settled_after");
    let settings = CleanSettings {
        removes_ripple: true,
        ..CleanSettings::default()
    };
    let mut series = Vec::new();
    for (color, &depth_mm) in depths.iter().enumerate() {
        let stimulus = Stimulus::RampAndHold {
            depth_m: 1e-3 * f64::from(depth_mm),
            ramp_s: RAMP,
            hold_s: STEADY - RAMP,
        };
        let found = measured(&alive, stimulus, (1, u64::from(depth_mm)))?;
        series.push(drawn(&found, depth_mm, color));
        let clean = clean(&found.recording, &settings)?;
        let name = |word: &str| format!("{word}/{depth_mm}_mm");
        let Some(relaxation) = analyze(&clean).relaxation else {
            rows.add_missing(&name("steady"), "N", "no hold is seen in the recording");
            continue;
        };
        let printed = Printed::of(organ, depth_mm).map(|row| row.mean);
        let steady = Value::beside(printed, relaxation.steady_n, "N");
        rows.add_pipeline_only(&name("steady"), steady, STEADY_NOTE);
        let settle = Value::beside(settled, relaxation.settle_s, "s");
        rows.add(&name("settled_after"), settle, SETTLED_NOTE);
        match clean.handling.ripple {
            Some(ripple) => {
                let value = Value::own(1e3 * ripple.amplitude_n, "mN");
                rows.add(&name("ripple"), value, RIPPLE_NOTE);
            }
            None => rows.add_missing(&name("ripple"), "mN", "no ripple is seen in the recording"),
        }
    }
    let plot = Plot {
        title: format!("Force on the pig's {organ}, in vivo"),
        x_label: "time [s]".to_owned(),
        y_label: "force [mN]".to_owned(),
        series,
        ..Plot::default()
    };
    rows.add_figure(
        None,
        &plot,
        format!("{NOTE}; means over 25 ms of what the sensor showed"),
    )
}

/// Forces over time from first contact.
fn drawn(found: &Measured, depth_mm: u32, color: usize) -> Series {
    let times: Vec<f64> = found.times().collect();
    let forces = found.recording.force_n();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let points = times.chunks(AVERAGED).zip(forces.chunks(AVERAGED));
    let points = points.map(|(times, forces)| (mean(times), 1e3 * mean(forces)));
    Series::new(
        format!("{depth_mm} mm"),
        points.collect(),
        Style::FineLine,
        color,
    )
}
