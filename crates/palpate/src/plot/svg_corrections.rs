//! Corrections to the output of the drawing crate: titles stand at the left, the name of the y axis lies above it
//! instead of upright next to it, and the dashes of a finely divided line keep their length.

use kuva::render::render::{Primitive, Scene, TextAnchor};

use super::Plot;

/// Width and height of the layout.
pub(super) const SIZE: [f64; 2] = [750.0, 500.0];

/// Where titles begin.
const LEFT: f64 = 14.0;

/// Moves the titles of `scene`, the drawing of `plot`, to their positions.
pub(super) fn titles(scene: &mut Scene, plot: &Plot) {
    for element in &mut scene.elements {
        if let Primitive::Text {
            x, content, anchor, ..
        } = element
            && (*content == plot.title || *content == plot.y_label)
        {
            *x = LEFT;
            *anchor = TextAnchor::Start;
        }
    }
}

/// Cuts dashed lines into their dashes.
pub(super) fn dash(scene: &mut Scene) {
    for element in std::mem::take(&mut scene.elements) {
        match element {
            Primitive::PolyLine {
                points,
                stroke,
                stroke_width,
                stroke_dasharray: Some(pattern),
            } => {
                scene
                    .elements
                    .extend(dashes(&points, &pattern).into_iter().map(|points| {
                        Primitive::PolyLine {
                            points,
                            stroke: stroke.clone(),
                            stroke_width,
                            stroke_dasharray: None,
                        }
                    }))
            }
            other => scene.elements.push(other),
        }
    }
}

/// The drawn pieces of a line under a pattern of drawn and empty lengths, such as `8 4`.
fn dashes(points: &[(f64, f64)], pattern: &str) -> Vec<Vec<(f64, f64)>> {
    let lengths: Vec<f64> = pattern
        .split_whitespace()
        .filter_map(|word| word.parse().ok())
        .collect();
    if points.is_empty() || lengths.is_empty() || lengths.iter().any(|length| *length <= 0.0) {
        return vec![points.to_vec()];
    }
    let mut pieces = vec![vec![points[0]]];
    let (mut phase, mut left) = (0, lengths[0]);
    for ends in points.windows(2) {
        let (mut from, to) = (ends[0], ends[1]);
        let mut length = distance(from, to);
        while length > left {
            let part = left / length;
            from = (
                from.0 + part * (to.0 - from.0),
                from.1 + part * (to.1 - from.1),
            );
            length -= left;
            if phase % 2 == 0 {
                continue_piece(&mut pieces, from);
            } else {
                pieces.push(vec![from]);
            }
            phase = (phase + 1) % lengths.len();
            left = lengths[phase];
        }
        left -= length;
        if phase % 2 == 0 {
            continue_piece(&mut pieces, to);
        }
    }
    pieces
}

fn continue_piece(pieces: &mut [Vec<(f64, f64)>], point: (f64, f64)) {
    if let Some(piece) = pieces.last_mut() {
        piece.push(point);
    }
}

fn distance(from: (f64, f64), to: (f64, f64)) -> f64 {
    (to.0 - from.0).hypot(to.1 - from.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// However finely a line is divided, its dashes are the same.
    #[test]
    fn dashes_do_not_depend_on_the_points() {
        for parts in [1, 7, 100] {
            let points: Vec<_> = (0..=parts)
                .map(|k| (30.0 * k as f64 / parts as f64, 0.0))
                .collect();
            let ends: Vec<[f64; 2]> = dashes(&points, "8 4")
                .iter()
                .map(|piece| [piece[0].0, piece[piece.len() - 1].0])
                .collect();
            let expected = [[0.0, 8.0], [12.0, 20.0], [24.0, 30.0]];
            assert_eq!(ends.len(), expected.len());
            for (own, expected) in ends.iter().flatten().zip(expected.iter().flatten()) {
                assert!((own - expected).abs() < 1e-9, "{parts}: {ends:?}");
            }
        }
    }
}
