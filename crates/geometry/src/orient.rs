use crate::mesh::edges::{Side, by_edge, sides};
use crate::{NodeId, Vec3};

/// Turns triangles over until neighbours agree in each piece and a closed piece faces outward; an
/// open piece keeps the sense that most of its triangles had. Returns how many were turned.
pub(crate) fn orient_outward(vertices: &[Vec3], triangles: &mut [[NodeId; 3]]) -> usize {
    let links = links(&sides(triangles), triangles.len());
    let mut turned: Vec<Option<bool>> = vec![None; triangles.len()];
    for first in 0..triangles.len() {
        if turned[first].is_some() {
            continue;
        }
        let piece = flood(first, &links, &mut turned);
        let is_turned = |t: usize| turned[t] == Some(true);
        let inverted = if piece.closed {
            volume_six_fold(vertices, triangles, &piece.triangles, is_turned) < 0.0
        } else {
            2 * piece.triangles.iter().filter(|&&t| is_turned(t)).count() > piece.triangles.len()
        };
        if inverted {
            for &triangle in &piece.triangles {
                turned[triangle] = turned[triangle].map(|turned| !turned);
            }
        }
    }
    let mut count = 0;
    for (corners, _) in triangles
        .iter_mut()
        .zip(&turned)
        .filter(|(_, turned)| **turned == Some(true))
    {
        corners.swap(1, 2);
        count += 1;
    }
    count
}

/// A neighbour over an edge of two triangles.
#[derive(Debug, Clone, Copy)]
struct Link {
    triangle: usize,
    /// Whether the two run along their edge in opposite directions, as they should.
    agrees: bool,
}

/// Neighbours of each triangle, and whether all three of its edges have two triangles.
fn links(sides: &[Side], triangles: usize) -> Vec<Vec<Link>> {
    let mut links = vec![Vec::with_capacity(3); triangles];
    for edge in by_edge(sides) {
        // Which triangles belong together where more than two meet is anybody's guess.
        let [one, other] = edge else { continue };
        let agrees = one.ascending != other.ascending;
        for (from, to) in [(one, other), (other, one)] {
            links[from.triangle.index()].push(Link {
                triangle: to.triangle.index(),
                agrees,
            });
        }
    }
    links
}

struct Piece {
    triangles: Vec<usize>,
    closed: bool,
}

/// Decides for all triangles that can be reached from `first` whether they are turned.
fn flood(first: usize, links: &[Vec<Link>], turned: &mut [Option<bool>]) -> Piece {
    let mut piece = Piece {
        triangles: vec![first],
        closed: true,
    };
    turned[first] = Some(false);
    let mut next = 0;
    while let Some(&triangle) = piece.triangles.get(next) {
        next += 1;
        piece.closed &= links[triangle].len() == 3;
        for link in &links[triangle] {
            if turned[link.triangle].is_none() {
                turned[link.triangle] = turned[triangle].map(|turned| turned == link.agrees);
                piece.triangles.push(link.triangle);
            }
        }
    }
    piece
}

fn volume_six_fold(
    vertices: &[Vec3],
    triangles: &[[NodeId; 3]],
    piece: &[usize],
    is_turned: impl Fn(usize) -> bool,
) -> f64 {
    let origin = vertices[triangles[piece[0]][0].index()];
    piece
        .iter()
        .map(|&t| {
            let [a, b, c] = triangles[t].map(|node| vertices[node.index()] - origin);
            let volume = a.dot(&b.cross(&c));
            if is_turned(t) { -volume } else { volume }
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners() -> Vec<Vec3> {
        vec![Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()]
    }

    fn numbered(triangles: &[[u32; 3]]) -> Vec<[NodeId; 3]> {
        triangles.iter().map(|t| t.map(NodeId)).collect()
    }

    #[test]
    fn every_mixture_of_senses_ends_outward() {
        let outward = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        for mixture in 0..16usize {
            let mut triangles = numbered(&outward);
            for (k, corners) in triangles.iter_mut().enumerate() {
                if mixture >> k & 1 == 1 {
                    corners.swap(1, 2);
                }
            }
            let turned = orient_outward(&corners(), &mut triangles);
            assert_eq!(triangles, numbered(&outward));
            assert_eq!(turned, mixture.count_ones() as usize);
        }
    }

    #[test]
    fn an_open_piece_follows_the_majority() {
        let mut triangles = numbered(&[[0, 1, 2], [0, 1, 3], [1, 2, 3]]);
        let turned = orient_outward(&corners(), &mut triangles);
        assert_eq!(turned, 1);
    }
}
