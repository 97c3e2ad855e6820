use nalgebra::Complex;
use palpate_jobs::plot::{Series, Style};

use super::device::Device;
use crate::Error;
use crate::m06::Printed;
use crate::row::Rows;

const ORGANS: [&str; 2] = ["liver", "kidney"];

/// Frequencies of the rows [Hz]: the source's working range from its beginning to its end.
const PLACES: [(&str, f64); 3] = [("rest", 0.0), ("1_hz", 1.0), ("8_hz", 8.0)];

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let devices = Device::both()?;
    let mut series = Vec::new();
    for (at, organ) in ORGANS.into_iter().enumerate() {
        let Some(stiffness) = secant(organ) else {
            return Err(Error::failed("table 5-1 has no such organ"));
        };
        for (device, style) in devices.iter().zip([Style::Line, Style::DashedLine]) {
            let transparency =
                |f: f64| device.port.transparency(f, Complex::from(stiffness)).norm();
            for (name, frequency) in PLACES {
                let row = format!("{organ}/{}/{name}", device.name);
                rows.add(&row, transparency(frequency));
            }
            let points = (0..=600).map(|i| 10_f64.powf(-1.0 + f64::from(i) / 200.0));
            let points = points.map(|f| (f, transparency(f))).collect();
            let name = format!("{organ}, {}", device.words);
            series.push(Series::new(name, points, style, at));
        }
    }
    rows.figure("").draw(series)
}

/// Mean force over depth at the deepest place of table 5-1 [N/m].
fn secant(organ: &str) -> Option<f64> {
    let printed = Printed::all(organ);
    let deepest = printed.last()?;
    Some(deepest.mean / deepest.depth())
}
