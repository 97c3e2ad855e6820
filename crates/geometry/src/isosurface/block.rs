use super::bits::Bits;
use crate::LabelMap;
use crate::flood::{Connectivity, flood};

/// The voxels of one label with a margin of one voxel of nothing on every side.
///
/// A voxel takes two bits: 0.1 GB for the largest map, whose labels themselves take 0.8 GB.
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
                let voxels = self.flood(start, true, &mut seen, Connectivity::Six);
                pieces += 1;
                if voxels > largest.0 {
                    largest = (voxels, start);
                }
            }
        }
        if pieces > 1 {
            let mut piece = self.none();
            self.flood(largest.1, true, &mut piece, Connectivity::Six);
            self.inside = piece;
        }
        pieces - 1
    }

    /// Fills enclosed voids. Returns the number of their voxels.
    pub(super) fn fill_voids(&mut self) -> usize {
        let before = self.count();
        let mut outside = self.none();
        // What touches along an edge hangs together outside, since it does not inside.
        let around = self.flood(0, false, &mut outside, Connectivity::Eighteen);
        let filled = self.voxels() - around - before;
        if filled > 0 {
            self.inside = outside.others(self.voxels());
        }
        filled
    }

    fn voxels(&self) -> usize {
        self.size.iter().product()
    }

    fn none(&self) -> Bits {
        Bits::none(self.voxels())
    }

    /// Marks the connected component of `start` as seen. Returns how many there are.
    fn flood(
        &self,
        start: usize,
        inside: bool,
        seen: &mut Bits,
        connectivity: Connectivity,
    ) -> usize {
        flood(self.size, start, connectivity, |at| {
            self.is_inside(at) == inside && seen.insert(at)
        })
    }
}
