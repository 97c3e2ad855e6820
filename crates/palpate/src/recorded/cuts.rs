use palpate_simulate::CutSummary;
use serde::Serialize;

/// What was cut, in a report.
#[derive(Debug, Serialize)]
pub(super) struct CutsAnswer {
    count: usize,
    length_m: f64,
    largest_lag_triangles: usize,
    triangles_before: usize,
    triangles_after: usize,
    perforations: u64,
    /// Per layer, from outside.
    layers: Vec<LayerAnswer>,
}

/// How far a layer was cut.
#[derive(Debug, Serialize)]
struct LayerAnswer {
    name: String,
    length_m: f64,
}

impl CutsAnswer {
    pub(super) fn of(summary: CutSummary) -> Self {
        let [triangles_before, triangles_after] = summary.triangles;
        Self {
            count: summary.count,
            length_m: summary.length,
            largest_lag_triangles: summary.largest_lag,
            triangles_before,
            triangles_after,
            perforations: summary.perforations,
            layers: summary
                .layers
                .into_iter()
                .map(|layer| LayerAnswer {
                    name: layer.name,
                    length_m: layer.length,
                })
                .collect(),
        }
    }

    /// A line for a person; empty when nothing was cut or perforated.
    pub(super) fn line(&self) -> String {
        if self.count == 0 && self.perforations == 0 {
            return String::new();
        }
        let (s, times) = (plural(self.count), plural(self.perforations as usize));
        let layers: String = self
            .layers
            .iter()
            .map(|layer| format!("; {} cut over {:.1} mm", layer.name, 1e3 * layer.length_m))
            .collect();
        format!(
            "\n{} cut{s}, {:.1} mm of the surface at rest in all, at most {} triangles behind the blade; {} triangles became {}; {} perforation{times}{layers}",
            self.count,
            1e3 * self.length_m,
            self.largest_lag_triangles,
            self.triangles_before,
            self.triangles_after,
            self.perforations,
        )
    }
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}
