//! Fewer tetrahedra in the same body.

use palpate_geometry::{
    AabbTree, FillSettings, Organ, Surface, TetrahedronMesh, TriangleMesh, Vec3, coarsen,
    deviation, fill,
};

fn organ(organ: Organ, triangles: usize) -> Surface {
    Surface::new(organ.surface_mesh(triangles).unwrap()).unwrap()
}

fn coarse(surface: &Surface, tetrahedra: usize, nodes: usize) -> TetrahedronMesh {
    let fine = fill(
        surface,
        &FillSettings::with_tetrahedron_count(surface, tetrahedra),
    )
    .unwrap();
    coarsen(&fine, surface, nodes, |_| 1.0).unwrap()
}

/// Vertices and edges: the nodes of quadratic elements.
fn nodes(mesh: &TetrahedronMesh) -> usize {
    mesh.vertices().len() + mesh.edges().len()
}

fn boundary(mesh: &TetrahedronMesh) -> TriangleMesh {
    let faces = mesh.boundary().into_iter().map(|(corners, _)| corners);
    TriangleMesh::new(mesh.vertices().to_vec(), faces.collect()).unwrap()
}

/// Judge: the surface. The number of nodes is met to a percent, the volume to rounding of four inflations, and a boundary
/// with elements as large as the body allows stays near the surface: within 4 % of the body's size.
#[test]
#[ignore = "long"]
fn organs_keep_their_shape_with_few_nodes() {
    for (which, triangles, tetrahedra) in [
        (Organ::Liver, 3000, 12_000),
        (Organ::Kidney, 2000, 12_000),
        (Organ::Esophagus, 4000, 12_000),
        (Organ::Diaphragm, 4000, 36_000),
    ] {
        let surface = organ(which, triangles);
        let mesh = coarse(&surface, tetrahedra, 1500);
        let volume = surface.mesh().volume();
        let (low, high) = surface.mesh().bounds();
        let boundary = boundary(&mesh);
        let apart = deviation(&boundary, surface.mesh());
        let off = apart.max / (high - low).norm();
        println!(
            "{which:?}: {} nodes, volume {:+.2e}, off {off:.4}",
            nodes(&mesh),
            mesh.volume() / volume - 1.0
        );
        assert!(nodes(&mesh).abs_diff(1500) < 16, "{}", nodes(&mesh));
        assert!((mesh.volume() / volume - 1.0).abs() < 1e-3);
        assert!(off < 0.04, "{off}");
        // As many handles and pieces as before: Euler's formula, over the vertices that are on it.
        let euler = |mesh: &TriangleMesh| {
            let corners = mesh.triangles().iter().flatten();
            let vertices: std::collections::BTreeSet<_> = corners.collect();
            vertices.len() as i64 - mesh.triangles().len() as i64 / 2
        };
        assert_eq!(euler(&boundary), euler(surface.mesh()), "{which:?}");
    }
}

/// None is flat: the mean square edge of each has a fifth of a regular tetrahedron's volume, or a tenth where the boundary
/// moved outward.
#[test]
fn none_of_few_tetrahedra_is_flat() {
    let surface = organ(Organ::Spleen, 2000);
    for nodes in [500, 1500, 4000] {
        let mesh = coarse(&surface, 12_000, nodes);
        for number in 0..mesh.tetrahedra().len() {
            let [a, b, c, d] = mesh.positions(number);
            let six_fold = (b - a).cross(&(c - a)).dot(&(d - a));
            let edges = [b - a, c - a, d - a, c - b, d - b, d - c];
            let square = edges.iter().map(Vec3::norm_squared).sum::<f64>() / 6.0;
            let shape = std::f64::consts::SQRT_2 * six_fold / square.powf(1.5);
            assert!(shape > 0.1, "{nodes}: {shape}");
        }
    }
}

/// Judge: the slab of 100 × 100 × 15 mm. A filling cuts off its edges by up to a third of its own; what is made of the filling has
/// edges and corners again: the points of the slab's edges lie on its boundary, and its boundary on the slab, to a hundredth of the
/// thickness.
#[test]
fn sharp_edges_come_back() {
    let surface = organ(Organ::Slab, 500);
    let (low, high) = surface.mesh().bounds();
    for nodes in [500, 1500, 4000] {
        let mesh = coarse(&surface, 8 * nodes.max(1500), nodes);
        let boundary = boundary(&mesh);
        let tree = AabbTree::new(&boundary);
        let mut most = 0.0_f64;
        for axis in 0..3 {
            for corner in 0..4 {
                for part in 0..=100 {
                    let mut ends = [corner & 1, corner >> 1].into_iter();
                    let place = Vec3::from_fn(|k, _| match k == axis {
                        true => low[k] + 0.01 * f64::from(part) * (high[k] - low[k]),
                        false if ends.next() == Some(1) => high[k],
                        false => low[k],
                    });
                    most = most.max(tree.nearest(&boundary, &place).distance);
                }
            }
        }
        let back = deviation(&boundary, surface.mesh()).max;
        println!("{nodes}: edges {most:.2e} m off, boundary {back:.2e} m");
        assert!(most < 1.5e-4, "{most}");
        assert!(back < 1.5e-4, "{back}");
    }
}

/// More nodes than there are: nothing changes but the volume.
#[test]
fn a_mesh_that_is_coarse_enough_stays() {
    let surface = organ(Organ::Hemisphere, 500);
    let fine = fill(
        &surface,
        &FillSettings::with_tetrahedron_count(&surface, 500),
    )
    .unwrap();
    let same = coarsen(&fine, &surface, 100_000, |_| 1.0).unwrap();
    assert_eq!(same.tetrahedra(), fine.tetrahedra());
}
