use crate::LabelMap;

/// The voxels of one label with a margin of one voxel of nothing on every side.
pub(super) struct Block {
    pub(super) size: [usize; 3],
    /// The first index runs fastest.
    pub(super) inside: Vec<bool>,
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
        for (at, _) in map.labels.iter().enumerate().filter(|(_, l)| **l == label) {
            for (k, index) in [at % nx, at / nx % ny, at / nx / ny]
                .into_iter()
                .enumerate()
            {
                low[k] = low[k].min(index);
                high[k] = high[k].max(index);
            }
        }
        if low[0] == usize::MAX {
            return None;
        }
        let size = [0, 1, 2].map(|k| high[k] - low[k] + 3);
        let mut inside = vec![false; size.iter().product()];
        for z in low[2]..=high[2] {
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    let [i, j, k] = [x - low[0] + 1, y - low[1] + 1, z - low[2] + 1];
                    inside[(k * size[1] + j) * size[0] + i] =
                        map.labels[(z * ny + y) * nx + x] == label;
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

    pub(super) fn count(&self) -> usize {
        self.inside.iter().filter(|&&inside| inside).count()
    }

    /// Leaves the largest piece of voxels that share faces. Returns how many other pieces there
    /// were.
    pub(super) fn keep_largest(&mut self) -> usize {
        let mut seen = vec![false; self.inside.len()];
        let mut largest = Vec::new();
        let mut pieces = 0;
        for start in 0..self.inside.len() {
            if self.inside[start] && !seen[start] {
                let piece = self.flood(start, true, &mut seen, 1);
                pieces += 1;
                if piece.len() > largest.len() {
                    largest = piece;
                }
            }
        }
        self.inside.fill(false);
        for at in largest {
            self.inside[at] = true;
        }
        pieces - 1
    }

    /// Fills what is shut in. Returns how many voxels that were.
    pub(super) fn fill_hollows(&mut self) -> usize {
        let before = self.count();
        let mut seen = vec![false; self.inside.len()];
        // What touches along an edge hangs together outside, since it does not inside.
        self.flood(0, false, &mut seen, 2);
        self.inside = seen.into_iter().map(|outside| !outside).collect();
        self.count() - before
    }

    /// The voxels that hang together with `start`, over steps along at most `axes` axes at a time.
    fn flood(&self, start: usize, inside: bool, seen: &mut [bool], axes: usize) -> Vec<usize> {
        let mut found = vec![start];
        seen[start] = true;
        let mut next = 0;
        while next < found.len() {
            self.for_each_neighbor(found[next], axes, |neighbor| {
                if !seen[neighbor] && self.inside[neighbor] == inside {
                    seen[neighbor] = true;
                    found.push(neighbor);
                }
            });
            next += 1;
        }
        found
    }

    fn for_each_neighbor(&self, at: usize, axes: usize, mut visit: impl FnMut(usize)) {
        let [nx, ny, nz] = self.size.map(|n| n as i64);
        let at = at as i64;
        let [x, y, z] = [at % nx, at / nx % ny, at / nx / ny];
        for step in 0..27i64 {
            let [dx, dy, dz] = [step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1];
            let along = [dx, dy, dz].iter().filter(|&&d| d != 0).count();
            let [i, j, k] = [x + dx, y + dy, z + dz];
            let there = (0..nx).contains(&i) && (0..ny).contains(&j) && (0..nz).contains(&k);
            if there && (1..=axes).contains(&along) {
                visit(((k * ny + j) * nx + i) as usize);
            }
        }
    }
}
