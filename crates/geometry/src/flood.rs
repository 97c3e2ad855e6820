//! Flood fill of voxels, in runs along the first axis, so that memory is read in order.

/// Which voxels are neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Connectivity {
    /// Those that share a face.
    Six,
    /// Those that share a face or an edge.
    Eighteen,
}

/// Visits the connected component of the voxel `start` in a block of `size`, whose first index runs fastest. `take` marks a
/// voxel and returns whether it belongs to the component and was not marked before; it is called several times for a voxel.
/// Returns the number of voxels, with `start`.
pub(crate) fn flood(
    size: [usize; 3],
    start: usize,
    connectivity: Connectivity,
    mut take: impl FnMut(usize) -> bool,
) -> usize {
    let [nx, ny, nz] = size;
    let mut found = 0;
    // Runs of voxels that are taken: their row, and the first and the last.
    let mut open: Vec<(usize, usize, usize)> = Vec::new();
    // Takes what it can of a row from `low` to `high`, and what is connected to that along the row.
    let mut take_row = |row: usize, low: usize, high: usize, open: &mut Vec<_>| {
        let at = |x: usize| row * nx + x;
        let mut x = low;
        while x <= high {
            if !take(at(x)) {
                x += 1;
                continue;
            }
            let mut first = x;
            while x == low && first > 0 && take(at(first - 1)) {
                first -= 1;
            }
            let mut last = x;
            while last + 1 < nx && take(at(last + 1)) {
                last += 1;
            }
            found += last - first + 1;
            open.push((row, first, last));
            x = last + 2;
        }
    };
    take_row(start / nx, start % nx, start % nx, &mut open);
    while let Some((row, first, last)) = open.pop() {
        let (y, z) = (row % ny, row / ny);
        for dz in [-1, 0, 1] {
            for dy in [-1, 0, 1] {
                let wider = match (usize::from(dy != 0) + usize::from(dz != 0), connectivity) {
                    (1, Connectivity::Six) | (2, Connectivity::Eighteen) => 0,
                    (1, Connectivity::Eighteen) => 1,
                    _ => continue,
                };
                let (Some(y), Some(z)) = (y.checked_add_signed(dy), z.checked_add_signed(dz))
                else {
                    continue;
                };
                if y < ny && z < nz {
                    let (low, high) = (first.saturating_sub(wider), (last + wider).min(nx - 1));
                    take_row(y + ny * z, low, high, &mut open);
                }
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: voxel by voxel, by differences of indices.
    #[test]
    fn random_components_are_found() {
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1); // [Knuth 1998, 3.3.4]
            state >> 33
        };
        for case in 0..200 {
            let size = [1 + case % 7, 1 + case % 5, 1 + case % 4];
            let count = size.iter().product::<usize>();
            let free: Vec<bool> = (0..count).map(|_| random() % 100 < 45).collect();
            let Some(start) = free.iter().position(|&is_free| is_free) else {
                continue;
            };
            for (connectivity, axes) in [(Connectivity::Six, 1), (Connectivity::Eighteen, 2)] {
                let mut taken = vec![false; count];
                let found = flood(size, start, connectivity, |at| {
                    free[at] && !std::mem::replace(&mut taken[at], true)
                });
                let mut judge = vec![false; count];
                judge[start] = true;
                let indices =
                    |at: usize| [at % size[0], at / size[0] % size[1], at / size[0] / size[1]];
                for _ in 0..count {
                    for (one, other) in (0..count).flat_map(|a| (0..count).map(move |b| (a, b))) {
                        let [a, b] = [one, other].map(indices);
                        let steps = [0, 1, 2].map(|k| a[k].abs_diff(b[k]));
                        let near =
                            steps.iter().all(|&d| d < 2) && steps.iter().sum::<usize>() <= axes;
                        judge[other] |= near && judge[one] && free[other];
                    }
                }
                assert_eq!(taken, judge, "{size:?} {connectivity:?}");
                assert_eq!(found, judge.iter().filter(|&&is| is).count());
            }
        }
    }
}
