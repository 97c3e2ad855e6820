//! The openings of a layer, as the shader takes them: around each straight part of a cut, wider in the middle of the
//! cut than at its ends, as an ellipse is.

use bytemuck::{Pod, Zeroable};
use palpate_simulate::interactive::OpenedPart;

/// Parts that are drawn, as in `shader/tissue.wgsl`; the last ones of a longer cut.
pub(super) const MOST: usize = 128;

/// A puncture is this wide, in widths of a cut [-].
const PUNCTURE: f32 = 0.5;

/// A part: its ends [m], with the half width of the opening there in w [m].
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub(crate) struct Opening {
    pub(crate) start: [f32; 4],
    pub(crate) end: [f32; 4],
}

/// Those of the layer below `layers` others, where a cut gapes up to `width` [m].
pub(crate) fn openings(parts: &[OpenedPart], layers: usize, width: f32) -> Vec<Opening> {
    let mut found = Vec::new();
    let mut run: Vec<&OpenedPart> = Vec::new();
    for part in parts {
        if part.begins || part.layers <= layers {
            add(&run, width, &mut found);
            run.clear();
        }
        if part.layers > layers {
            run.push(part);
        }
    }
    add(&run, width, &mut found);
    let beyond = found.len().saturating_sub(MOST);
    found.split_off(beyond)
}

/// The places where a surface was pierced and not cut, `width` [m] being that of a cut.
pub(crate) fn punctures(parts: &[OpenedPart], width: f32) -> Vec<Opening> {
    let is_alone = |number: usize| {
        let next = parts.get(number + 1);
        length(&parts[number]) == 0.0 && next.is_none_or(|next| next.begins)
    };
    let alone = (0..parts.len()).filter(|number| is_alone(*number));
    alone
        .flat_map(|number| openings(&parts[number..=number], 0, width))
        .collect()
}

fn add(run: &[&OpenedPart], width: f32, found: &mut Vec<Opening>) {
    let whole: f32 = run.iter().map(|part| length(part)).sum();
    // No wider than it is long.
    let half = 0.5 * width.min(whole.max(PUNCTURE * width));
    let mut before = 0.0;
    for part in run {
        let after = before + length(part);
        let [start, end] = [before, after].map(|along| {
            let from_middle = if whole > 0.0 {
                2.0 * along / whole - 1.0
            } else {
                0.0
            };
            half * (1.0 - from_middle * from_middle).max(0.02).sqrt()
        });
        before = after;
        if whole > 0.0 && length(part) == 0.0 {
            continue;
        }
        let at = |[x, y, z]: [f32; 3], half| [x, y, z, half];
        found.push(Opening {
            start: at(part.ends[0], start),
            end: at(part.ends[1], end),
        });
    }
}

fn length(part: &OpenedPart) -> f32 {
    let [a, b] = part.ends.map(nalgebra::Vector3::from);
    (b - a).norm()
}
