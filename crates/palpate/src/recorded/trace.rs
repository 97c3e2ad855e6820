use std::path::{Path, PathBuf};

use palpate_simulate::Frame;

use super::Comparison;
use crate::failure::Failure;
use crate::plot::{Draw, Plot, Series, Style, write_pair};

/// Points of a curve; more are not visible in a picture.
const POINTS: u64 = 3000;

/// Time, depth and force of each tool, for the plots.
pub(super) struct Traces {
    tools: Vec<(String, Vec<Point>)>,
}

#[derive(Debug, Clone, Copy)]
struct Point {
    time: f64,
    depth: f64,
    force: f64,
}

impl Traces {
    pub(super) fn new(names: &[String]) -> Self {
        let tools = names
            .iter()
            .map(|name| (name.clone(), Vec::new()))
            .collect();
        Self { tools }
    }

    pub(super) fn add(&mut self, frame: &Frame<'_>) {
        if !frame.number.is_multiple_of(frame.steps / POINTS + 1) {
            return;
        }
        for row in frame.rows() {
            let [x, y, z] = row.force_n;
            self.tools[row.tool].1.push(Point {
                time: row.time_s,
                depth: 1e3 * row.depth_m,
                force: 1e3 * (x * x + y * y + z * z).sqrt(),
            });
        }
    }

    /// Draws force against time and against depth; with a recording, also both side by side.
    pub(super) fn draw(
        self,
        folder: &Path,
        comparison: Option<&Comparison>,
    ) -> Result<Vec<PathBuf>, Failure> {
        let recorded = |over| comparison.map(|comparison| comparison.series(over));
        let over_time = self.plot(
            ["Force against time", "Time [s]"],
            |p| (p.time, p.force),
            recorded(0),
        );
        let over_depth = self.plot(
            ["Force against depth", "Depth [mm]"],
            |p| (p.depth, p.force),
            recorded(1),
        );
        let mut files = Vec::new();
        if comparison.is_some() {
            let path = folder.join("beside.png");
            write_pair([&over_time, &over_depth], &path)?;
            files.push(path);
        }
        for (plot, name) in [(over_time, "force.png"), (over_depth, "force-depth.png")] {
            let path = folder.join(name);
            plot.write(&path)?;
            files.push(path);
        }
        Ok(files)
    }

    fn plot(
        &self,
        [title, x_label]: [&str; 2],
        of: impl Fn(&Point) -> (f64, f64),
        recorded: Option<Series>,
    ) -> Plot {
        let present = self.tools.iter().filter(|(_, points)| !points.is_empty());
        let own = present.enumerate().map(|(color, (name, points))| Series {
            name: match recorded {
                Some(_) if color == 0 => "simulated".to_owned(),
                _ => name.clone(),
            },
            points: points.iter().map(&of).collect(),
            style: Style::Line,
            color,
        });
        let series: Vec<Series> = own.collect();
        let series = recorded.into_iter().chain(series);
        Plot {
            title: title.to_owned(),
            x_label: x_label.to_owned(),
            y_label: "Force on the tool [mN]".to_owned(),
            series: series.collect(),
            ..Plot::default()
        }
    }
}
