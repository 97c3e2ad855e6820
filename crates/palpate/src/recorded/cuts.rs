use palpate_simulate::CutSummary;

/// The cuts, on a line for a person; empty when nothing was cut or perforated.
pub(super) fn line(cuts: &CutSummary) -> String {
    if cuts.count == 0 && cuts.perforations == 0 {
        return String::new();
    }
    let (s, times) = (plural(cuts.count), plural(cuts.perforations as usize));
    let layers: String = cuts
        .layers
        .iter()
        .map(|layer| format!("; {} cut over {:.1} mm", layer.name, 1e3 * layer.length))
        .collect();
    let detached = match cuts.detached_pieces {
        0 => String::new(),
        1 => "; 1 piece detached".to_owned(),
        count => format!("; {count} pieces detached"),
    };
    format!(
        "\n{} cut{s}, {:.1} mm of the surface at rest in all, at most {} triangles behind the blade; {} triangles became {}; {} perforation{times}{detached}{layers}",
        cuts.count,
        1e3 * cuts.length,
        cuts.largest_lag,
        cuts.triangles_before,
        cuts.triangles_after,
        cuts.perforations,
    )
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}
