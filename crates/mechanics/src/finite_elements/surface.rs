use std::collections::BTreeMap;

use super::graded::halved;

/// Quadratic quadrilaterals in a plane, made block by block; blocks that meet share their points.
#[derive(Debug)]
pub(super) struct Surface {
    pub(super) points: Vec<[f64; 2]>,
    /// Numbered like [`super::ElementKind::Quad9`].
    pub(super) faces: Vec<[u32; 9]>,
    /// Points by place, in steps.
    known: BTreeMap<[i64; 2], u32>,
    /// Points that are closer are one [m].
    step: f64,
}

impl Surface {
    /// No block yet; points closer than `step` [m] will be one.
    pub(super) fn new(step: f64) -> Self {
        Self {
            points: Vec::new(),
            faces: Vec::new(),
            known: BTreeMap::new(),
            step,
        }
    }

    /// Adds the block between the lines `across` and `up`.
    pub(super) fn add(&mut self, across: &[f64], up: &[f64], place: impl Fn(f64, f64) -> [f64; 2]) {
        let (across, up) = (halved(across), halved(up));
        for j in (0..up.len() - 1).step_by(2) {
            for i in (0..across.len() - 1).step_by(2) {
                let node = |n: usize| place(across[i + n % 3], up[j + n / 3]);
                let face = std::array::from_fn(|n| self.point(node(n)));
                self.faces.push(face);
            }
        }
    }

    fn point(&mut self, at: [f64; 2]) -> u32 {
        // Neighbouring blocks differ by rounding: look on both sides of a step's end.
        let key = at.map(|x| (x / self.step).round() as i64);
        let near = (-1..=1).flat_map(|i| (-1..=1).map(move |j| [key[0] + i, key[1] + j]));
        if let Some(&number) = near.into_iter().find_map(|key| self.known.get(&key)) {
            return number;
        }
        let number = self.points.len() as u32;
        self.points.push(at);
        self.known.insert(key, number);
        number
    }
}
