use std::collections::VecDeque;

use super::bits::Bits;
use crate::LabelMap;

/// The voxels of one label with a margin of one voxel of nothing on every side.
///
/// A voxel takes two bits and, while pieces are looked for, those at the front of the search some bytes: 0.1 GB for the
/// largest map, whose labels themselves take 0.8 GB.
pub(super) struct Block {
    pub(super) size: [usize; 3],
    /// The first index runs fastest.
    inside: Bits,
    /// Index of the first voxel in the map; the margin makes it less than zero at the border.
    pub(super) first: [i64; 3],
    /// Whether the label reaches the border of the map.
    pub(super) is_cut: bool,
}

impl Block {
    /// None when the label does not occur.
    pub(super) fn of(map: &LabelMap, label: u16) -> Option<Self> {
        let [nx, ny, _] = map.size;
        let mut low = [usize::MAX; 3];
        let mut high = [0; 3];
        for (row, labels) in map.labels.chunks_exact(nx).enumerate() {
            let is_own = |found: &u16| *found == label;
            let Some(start) = labels.iter().position(is_own) else {
                continue;
            };
            let end = labels.iter().rposition(is_own).unwrap_or(start);
            for (k, [lowest, highest]) in [[start, end], [row % ny; 2], [row / ny; 2]]
                .into_iter()
                .enumerate()
            {
                low[k] = low[k].min(lowest);
                high[k] = high[k].max(highest);
            }
        }
        if low[0] == usize::MAX {
            return None;
        }
        let size = [0, 1, 2].map(|k| high[k] - low[k] + 3);
        let mut inside = Bits::none(size.iter().product());
        for z in low[2]..=high[2] {
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    let [i, j, k] = [x - low[0] + 1, y - low[1] + 1, z - low[2] + 1];
                    if map.labels[(z * ny + y) * nx + x] == label {
                        inside.insert((k * size[1] + j) * size[0] + i);
                    }
                }
            }
        }
        Some(Self {
            size,
            inside,
            first: low.map(|index| index as i64 - 1),
            is_cut: (0..3).any(|k| low[k] == 0 || high[k] + 1 == map.size[k]),
        })
    }

    /// Whether a voxel has the label.
    pub(super) fn is_inside(&self, at: usize) -> bool {
        self.inside.contains(at)
    }

    pub(super) fn count(&self) -> usize {
        self.inside.count()
    }

    /// Leaves the largest piece of voxels that share faces. Returns how many other pieces there
    /// were.
    pub(super) fn keep_largest(&mut self) -> usize {
        let mut seen = self.none();
        let mut largest = (0, 0);
        let mut pieces = 0;
        for start in 0..self.voxels() {
            if self.is_inside(start) && !seen.contains(start) {
                let voxels = self.flood(start, true, &mut seen, 1);
                pieces += 1;
                if voxels > largest.0 {
                    largest = (voxels, start);
                }
            }
        }
        if pieces > 1 {
            let mut piece = self.none();
            self.flood(largest.1, true, &mut piece, 1);
            self.inside = piece;
        }
        pieces - 1
    }

    /// Fills what is shut in. Returns how many voxels that were.
    pub(super) fn fill_hollows(&mut self) -> usize {
        let before = self.count();
        let mut outside = self.none();
        // What touches along an edge hangs together outside, since it does not inside.
        let around = self.flood(0, false, &mut outside, 2);
        let filled = self.voxels() - around - before;
        if filled > 0 {
            for at in (0..self.voxels()).filter(|&at| !outside.contains(at)) {
                self.inside.insert(at);
            }
        }
        filled
    }

    fn voxels(&self) -> usize {
        self.size.iter().product()
    }

    fn none(&self) -> Bits {
        Bits::none(self.voxels())
    }

    /// Marks the voxels that hang together with `start`, over steps along at most `axes` axes at a time, as seen.
    /// Returns how many there are.
    fn flood(&self, start: usize, inside: bool, seen: &mut Bits, axes: usize) -> usize {
        let steps = steps(axes);
        // First in, first out: the front of a search through a block is a surface.
        let mut front = VecDeque::from([start]);
        seen.insert(start);
        let mut found = 1;
        while let Some(at) = front.pop_front() {
            self.for_each_neighbor(at, &steps, |neighbor| {
                if self.is_inside(neighbor) == inside && seen.insert(neighbor) {
                    front.push_back(neighbor);
                    found += 1;
                }
            });
        }
        found
    }

    fn for_each_neighbor(&self, at: usize, steps: &[[i64; 3]], mut visit: impl FnMut(usize)) {
        let [nx, ny, nz] = self.size.map(|n| n as i64);
        let at = at as i64;
        let [x, y, z] = [at % nx, at / nx % ny, at / nx / ny];
        for [dx, dy, dz] in steps {
            let [i, j, k] = [x + dx, y + dy, z + dz];
            let there = (0..nx).contains(&i) && (0..ny).contains(&j) && (0..nz).contains(&k);
            if there {
                visit(((k * ny + j) * nx + i) as usize);
            }
        }
    }
}

/// The steps to neighbours along at most `axes` axes at a time.
fn steps(axes: usize) -> Vec<[i64; 3]> {
    let all = (0..27).map(|step| [step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1]);
    let along = |step: &[i64; 3]| step.iter().filter(|&&d| d != 0).count();
    all.filter(|step| (1..=axes).contains(&along(step)))
        .collect()
}
