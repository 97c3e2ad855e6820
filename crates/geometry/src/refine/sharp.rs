use super::facets::{Facets, On, common};
use super::relax::{FLAT, SWEEPS, open_around};
use super::shell::{CUT_FLOOR, MOVED_FLOOR, SearchedSurface, dihedral_quality, move_if_valid};
use super::split::SplitNet;
use crate::mesh::edges::{by_edge, sides};
use crate::{NodeId, Surface, TetrahedronError, TetrahedronMesh, Vec3};

/// How far an end of an edge goes to a sharp edge at most, in lengths of the edge [-], and the angles that must be left [rad]: from
/// round to round for edges that nothing helped before.
const ROUNDS: [(f64, f64); 3] = [(0.6, MOVED_FLOOR), (1.0, MOVED_FLOOR), (1.0, CUT_FLOOR)];

/// Makes tetrahedra that fill `surface`, with their boundary vertices on it, follow its sharp edges, which a filling cuts off: corners
/// get a vertex, and where an edge of the boundary crosses a sharp edge, an end of it moves there, or it gets a new vertex.
/// Where a flat tetrahedron would result, the edge stays as it is. Regions of tetrahedra are dropped. Where the surface has no sharp
/// edges, the mesh stays as it is.
///
/// # Errors
/// When the result is no mesh, which does not happen to a valid one.
pub fn follow_sharp_edges(
    mesh: TetrahedronMesh,
    surface: &Surface,
) -> Result<TetrahedronMesh, TetrahedronError> {
    let searched = SearchedSurface::new(surface);
    let Some(facets) = &searched.facets else {
        return Ok(mesh);
    };
    let mut following = Following::new(mesh, &searched, facets);
    following.snap_corners();
    let mut edges = following.edges.clone();
    edges.retain(|edge| following.crosses(*edge));
    for (farthest, floor) in ROUNDS {
        edges = following.resolve(edges, farthest, floor);
        following.relax();
    }
    following.into_mesh()
}

struct Following<'a> {
    searched: &'a SearchedSurface<'a>,
    facets: &'a Facets<'a>,
    net: SplitNet,
    /// Edges of the boundary.
    edges: Vec<[u32; 2]>,
    /// The facets that each vertex lies on; none inside.
    on: Vec<On>,
    on_boundary: Vec<bool>,
}

/// An end of an edge that could move to a sharp edge.
struct Move {
    /// The way to go, as a part of the edge [-].
    part: f64,
    edge: [u32; 2],
    node: u32,
}

impl<'a> Following<'a> {
    fn new(
        mesh: TetrahedronMesh,
        searched: &'a SearchedSurface<'a>,
        facets: &'a Facets<'a>,
    ) -> Self {
        let boundary = mesh.boundary();
        let triangles: Vec<_> = boundary.iter().map(|(corners, _)| *corners).collect();
        let mut edges: Vec<[u32; 2]> = by_edge(&sides(&triangles))
            .map(|sides| [sides[0].low.0, sides[0].high.0])
            .collect();
        edges.sort_unstable();
        let (vertices, tetrahedra) = mesh.into_parts();
        let mut on_boundary = vec![false; vertices.len()];
        for node in triangles.iter().flatten() {
            on_boundary[node.index()] = true;
        }
        let on = vertices.iter().zip(&on_boundary);
        let on = on.map(|(place, on_boundary)| match on_boundary {
            true => searched.facets_at(place),
            false => On::new(),
        });
        let tetrahedra = tetrahedra.iter().map(|corners| corners.map(|node| node.0));
        Self {
            searched,
            facets,
            on: on.collect(),
            net: SplitNet::new(vertices, tetrahedra.collect()),
            edges,
            on_boundary,
        }
    }

    fn into_mesh(self) -> Result<TetrahedronMesh, TetrahedronError> {
        let tetrahedra = self.net.tetrahedra.iter();
        let tetrahedra: Vec<_> = tetrahedra.map(|corners| corners.map(NodeId)).collect();
        TetrahedronMesh::new(self.net.vertices, tetrahedra)
    }

    /// Moves a vertex of the boundary to a place on the surface, unless a tetrahedron would be flat; whether it is there.
    fn moves_to(&mut self, node: u32, target: Vec3, floor: f64) -> bool {
        let star = self.net.star(node);
        let star = star.iter().copied();
        let moves = move_if_valid(&mut self.net.vertices, star, node, target, floor);
        if moves {
            self.on[node as usize] = self.searched.facets_at(&target);
        }
        moves
    }

    /// Gives each corner the vertex within an edge of the boundary that leaves the tetrahedra around it most open.
    fn snap_corners(&mut self) {
        let mut reach = vec![0.0_f64; self.net.vertices.len()];
        for [a, b] in &self.edges {
            let [from, to] = [a, b].map(|node| self.net.vertices[*node as usize]);
            for node in [a, b] {
                let reach = &mut reach[*node as usize];
                *reach = reach.max((to - from).norm());
            }
        }
        for corner in &self.facets.corners {
            let near = |node: &u32| {
                let away = (self.net.vertices[*node as usize] - corner).norm();
                away <= reach[*node as usize]
            };
            let nodes =
                (0..self.net.vertices.len() as u32).filter(|node| self.on_boundary[*node as usize]);
            let candidates: Vec<u32> = nodes
                .filter(near)
                .filter(|node| self.on[*node as usize].len() < 3)
                .collect();
            let open = |node: u32| {
                let star = self.net.star(node);
                let open = star.iter().map(|nodes| {
                    dihedral_quality(&nodes.map(|other| match other == node {
                        true => *corner,
                        false => self.net.vertices[other as usize],
                    }))
                });
                open.fold(f64::INFINITY, f64::min)
            };
            let best = candidates.iter().map(|node| (open(*node), *node));
            let best = best.reduce(|best, next| if next.0 > best.0 { next } else { best });
            if let Some((_, node)) = best {
                self.moves_to(node, *corner, MOVED_FLOOR);
            }
        }
    }

    fn crosses(&self, edge: [u32; 2]) -> bool {
        let [a, b] = edge.map(|node| &self.on[node as usize]);
        common(a, b).is_empty()
    }

    /// Where an edge of the boundary could cross a sharp edge [m], the best place first.
    fn crossings(&self, edge: [u32; 2]) -> Vec<Vec3> {
        let [a, b] = edge.map(|node| (&self.net.vertices[node as usize], &self.on[node as usize]));
        self.facets.crossings(a, b)
    }

    /// Moves ends of the edges that cross a sharp edge, those with the least way first, and cuts the others. Which edges still cross.
    fn resolve(&mut self, mut edges: Vec<[u32; 2]>, farthest: f64, floor: f64) -> Vec<[u32; 2]> {
        let mut ways = Vec::new();
        for &edge in &edges {
            let [from, to] = edge.map(|node| self.net.vertices[node as usize]);
            if let Some(target) = self.crossings(edge).first() {
                for (node, here) in [(edge[0], from), (edge[1], to)] {
                    let part = (target - here).norm() / (to - from).norm();
                    if part <= farthest && self.on[node as usize].len() < 2 {
                        ways.push(Move { part, edge, node });
                    }
                }
            }
        }
        ways.sort_by(|one, other| {
            let order = one.part.total_cmp(&other.part);
            order.then(one.edge.cmp(&other.edge))
        });
        for Move { edge, node, .. } in ways {
            if self.crosses(edge)
                && let Some(target) = self.crossings(edge).first()
            {
                self.moves_to(node, *target, floor);
            }
        }
        edges.retain(|edge| self.crosses(*edge));
        edges.retain(|edge| !self.cut(*edge));
        edges
    }

    /// Puts a vertex into an edge, unless a flat tetrahedron would come; whether it did.
    fn cut(&mut self, edge: [u32; 2]) -> bool {
        let crossings = self.crossings(edge);
        let is_cut = self
            .net
            .split_if_valid(edge, crossings, CUT_FLOOR)
            .is_some();
        if is_cut && let Some(place) = self.net.vertices.last() {
            self.on.push(self.searched.facets_at(place));
            self.on_boundary.push(true);
        }
        is_cut
    }

    /// Opens flat tetrahedra: vertices inside move, and those of the boundary that lie on one facet, along that.
    fn relax(&mut self) {
        for _ in 0..SWEEPS {
            let flat = self.net.tetrahedra.iter().filter(|nodes| {
                dihedral_quality(&nodes.map(|node| self.net.vertices[node as usize])) < FLAT
            });
            let mut nodes: Vec<u32> = flat.flatten().copied().collect();
            nodes.sort_unstable();
            nodes.dedup();
            nodes.retain(|node| self.on[*node as usize].len() < 2);
            let mut any = false;
            for node in nodes {
                let star = self.net.star(node);
                let start = self.net.vertices[node as usize];
                let searched = self.on_boundary[node as usize].then_some(self.searched);
                any |= open_around(&mut self.net.vertices, node, &star, |target| {
                    searched.map_or(target, |searched| searched.slide(&start, &target))
                });
            }
            if !any {
                break;
            }
        }
    }
}
