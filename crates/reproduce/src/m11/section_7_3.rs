use nalgebra::Complex;

use super::device::Device;
use crate::Error;
use crate::m06::Printed;
use crate::row::Value;
use crate::{Item, Rows};
use palpate_jobs::plot::{Axis, Plot, Series, Style};

pub(crate) const SECTION_7_3: Item = Item {
    name: "section-7-3",
    title: "whether a hand feels the tissue through the device",
    seconds: 0.17,
    run,
};

const ORGANS: [&str; 2] = ["liver", "kidney"];

/// Frequencies of the rows [Hz]: the source's working range from its beginning to its end.
const PLACES: [(&str, f64); 3] = [("rest", 0.0), ("1_hz", 1.0), ("8_hz", 8.0)];

const NOTE: &str = "published: (7.3), z_h = z_tissue, which the text before it calls \"unity\"; ours: |G₁ + G₂ Z|/Z by (7.2), Z the mean \
    force over the depth of 8 mm in table 5-1, without compensation. The device's own spring and mass are more than the liver";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let devices = Device::both();
    let mut series = Vec::new();
    for (at, organ) in ORGANS.into_iter().enumerate() {
        let Some(stiffness) = secant(organ) else {
            rows.add_missing(organ, "1", "table 5-1 has no force at 8 mm");
            continue;
        };
        for (place, device) in devices.iter().enumerate() {
            let felt = |f: f64| device.port.transparency(f, Complex::from(stiffness)).norm();
            for (name, frequency) in PLACES {
                let row = format!("{organ}/{}/{name}", device.name);
                rows.add(&row, Value::beside(Some(1.0), felt(frequency), "1"), NOTE);
            }
            let points = (0..=600).map(|i| 10_f64.powf(-1.0 + f64::from(i) / 200.0));
            let style = match place {
                0 => Style::Line,
                _ => Style::DashedLine,
            };
            series.push(Series::new(
                format!("{organ}, {}", device.words),
                points.map(|f| (f, felt(f))).collect(),
                style,
                at,
            ));
        }
    }
    let plot = Plot {
        title: "Transparency of the device without compensation".to_owned(),
        x_label: "frequency [Hz]".to_owned(),
        y_label: "felt over the tissue's own stiffness [-]".to_owned(),
        x_axis: Axis::Logarithmic,
        y_axis: Axis::Logarithmic,
        series,
        ..Plot::default()
    };
    rows.add_figure(None, &plot, "one would be a device that is not felt")
}

/// Mean force over depth at the deepest place of table 5-1 [N/m].
fn secant(organ: &str) -> Option<f64> {
    let printed = Printed::all(organ);
    let deepest = printed.last()?;
    Some(deepest.mean / (1e-3 * f64::from(deepest.depth_mm)))
}
