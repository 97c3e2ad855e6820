use crate::mesh::tetrahedra::{faces, matched, pieces, six_fold_volume};
use crate::{NodeId, Vec3};

/// The largest piece whose boundary is manifold, and the volume removed [m³]. Each round removes
/// tetrahedra, so that the loop ends; two rounds are usual where any are needed.
pub(super) fn largest_component(
    vertices: &[Vec3],
    mut tetrahedra: Vec<[NodeId; 4]>,
) -> (Vec<[NodeId; 4]>, f64) {
    let all = volume(vertices, &tetrahedra);
    loop {
        tetrahedra = largest_piece(vertices, tetrahedra);
        let removed = at_pinches(vertices.len(), &tetrahedra);
        if !removed.contains(&true) {
            break;
        }
        tetrahedra = tetrahedra
            .into_iter()
            .zip(removed)
            .filter_map(|(corners, removed)| (!removed).then_some(corners))
            .collect();
    }
    let lost = all - volume(vertices, &tetrahedra);
    (tetrahedra, lost)
}

pub(super) fn volume(vertices: &[Vec3], tetrahedra: &[[NodeId; 4]]) -> f64 {
    tetrahedra
        .iter()
        .map(|corners| six_fold_volume(&corners.map(|node| vertices[node.index()])) / 6.0)
        .sum()
}

fn largest_piece(vertices: &[Vec3], tetrahedra: Vec<[NodeId; 4]>) -> Vec<[NodeId; 4]> {
    let piece = pieces(&tetrahedra);
    let count = piece.iter().max().map_or(0, |most| most + 1);
    if count < 2 {
        return tetrahedra;
    }
    let mut volumes = vec![0.0; count];
    for (corners, &piece) in tetrahedra.iter().zip(&piece) {
        volumes[piece] += volume(vertices, std::slice::from_ref(corners));
    }
    let largest = (0..count).fold(
        0,
        |best, k| if volumes[k] > volumes[best] { k } else { best },
    );
    tetrahedra
        .into_iter()
        .zip(piece)
        .filter_map(|(corners, piece)| (piece == largest).then_some(corners))
        .collect()
}

/// Which tetrahedra are to go: where those around an edge or a vertex of the boundary do not all
/// hang together over faces there, the largest group stays.
fn at_pinches(vertices: usize, tetrahedra: &[[NodeId; 4]]) -> Vec<bool> {
    let mut removed = vec![false; tetrahedra.len()];
    let sorted = faces(tetrahedra);
    let mut on_boundary = vec![false; vertices];
    for alike in matched(&sorted).filter(|alike| alike.len() == 1) {
        for node in alike[0].corners {
            on_boundary[node.index()] = true;
        }
    }
    // The tetrahedra around each vertex of the boundary, by the number of the vertex.
    let mut around: Vec<(NodeId, u32)> = tetrahedra
        .iter()
        .enumerate()
        .flat_map(|(t, corners)| corners.map(|node| (node, t as u32)))
        .filter(|(node, _)| on_boundary[node.index()])
        .collect();
    around.sort_unstable();
    for star in around.chunk_by(|a, b| a.0 == b.0) {
        let hub = star[0].0;
        let numbers: Vec<u32> = star.iter().map(|s| s.1).collect();
        keep_largest_group(tetrahedra, &numbers, &[hub], &mut removed);
        let mut rim: Vec<NodeId> = numbers
            .iter()
            .flat_map(|&t| tetrahedra[t as usize])
            .collect();
        rim.sort_unstable();
        rim.dedup();
        for other in rim {
            if other > hub && on_boundary[other.index()] {
                let both: Vec<u32> = numbers
                    .iter()
                    .copied()
                    .filter(|&t| tetrahedra[t as usize].contains(&other))
                    .collect();
                keep_largest_group(tetrahedra, &both, &[hub, other], &mut removed);
            }
        }
    }
    removed
}

/// Groups `numbers` by the faces that they share and that have all of `hubs`; marks all groups but
/// the largest (of equal ones the first).
fn keep_largest_group(
    tetrahedra: &[[NodeId; 4]],
    numbers: &[u32],
    hubs: &[NodeId],
    removed: &mut [bool],
) {
    let mut group: Vec<usize> = (0..numbers.len()).collect();
    for i in 0..numbers.len() {
        for j in 0..i {
            let (one, other) = (
                tetrahedra[numbers[i] as usize],
                tetrahedra[numbers[j] as usize],
            );
            let shared = one.iter().filter(|node| other.contains(node)).count();
            debug_assert!(
                hubs.iter()
                    .all(|hub| one.contains(hub) && other.contains(hub))
            );
            if shared == 3 && group[i] != group[j] {
                let (from, to) = (group[i].max(group[j]), group[i].min(group[j]));
                for g in &mut group {
                    if *g == from {
                        *g = to;
                    }
                }
            }
        }
    }
    if group.iter().all(|&g| g == 0) {
        return;
    }
    let size = |g: usize| group.iter().filter(|&&other| other == g).count();
    let best = (0..numbers.len()).fold(0, |best, g| if size(g) > size(best) { g } else { best });
    for (k, &t) in numbers.iter().enumerate() {
        if group[k] != best {
            removed[t as usize] = true;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cubes of six tetrahedra, of which a generator keeps a part.
    fn sieve(cells: u32, part: u64, seed: u64) -> (Vec<Vec3>, Vec<[NodeId; 4]>) {
        let points = cells + 1;
        let number = |p: [u32; 3]| NodeId((p[2] * points + p[1]) * points + p[0]);
        let vertices = (0..points.pow(3)).map(|n| {
            let place = [n % points, n / points % points, n / points.pow(2)];
            Vec3::from(place.map(f64::from))
        });
        let mut state = seed;
        let mut keeps = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005);
            state = state.wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % 100 < part
        };
        let mut tetrahedra = Vec::new();
        for cell in 0..cells.pow(3) {
            let low = [cell % cells, cell / cells % cells, cell / cells.pow(2)];
            for [i, j, k] in [
                [0, 1, 2],
                [1, 2, 0],
                [2, 0, 1],
                [0, 2, 1],
                [2, 1, 0],
                [1, 0, 2],
            ] {
                let mut path = [low; 4];
                for (step, axis) in [i, j, k].into_iter().enumerate() {
                    path[step + 1..].iter_mut().for_each(|p| p[axis] += 1);
                }
                let mut corners = path.map(number);
                let odd = [[0, 2, 1], [2, 1, 0], [1, 0, 2]].contains(&[i, j, k]);
                if odd {
                    corners.swap(2, 3);
                }
                if keeps() {
                    tetrahedra.push(corners);
                }
            }
        }
        (vertices.collect(), tetrahedra)
    }

    /// Sieves fall apart over several rounds; none leaves a pinch, and no volume goes unaccounted.
    #[test]
    fn what_is_left_hangs_together_without_pinches() {
        for (part, seed) in [(50, 10), (60, 76), (65, 2), (75, 29)] {
            let (vertices, tetrahedra) = sieve(6, part, seed);
            let all = volume(&vertices, &tetrahedra);
            let (left, lost) = largest_component(&vertices, tetrahedra);
            assert!(!left.is_empty() && !at_pinches(vertices.len(), &left).contains(&true));
            assert_eq!(pieces(&left).iter().max(), Some(&0));
            // Rounding.
            assert!((volume(&vertices, &left) + lost - all).abs() < 1e-9 * all);
        }
    }
}
