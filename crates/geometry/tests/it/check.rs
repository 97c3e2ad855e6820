//! Mesh checks: shapes whose faults are known, and real meshes.

use std::path::Path;

use palpate_geometry::{
    MeshReport, NodeId, Organ, ProblemKind, TriangleMesh, Vec3, inspect, read_mesh, repair,
};

use crate::data;

fn mesh(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> TriangleMesh {
    let vertices = vertices.iter().map(|&v| Vec3::from(v)).collect();
    let triangles = triangles.iter().map(|t| t.map(NodeId)).collect();
    TriangleMesh::new(vertices, triangles).unwrap()
}

/// The corner of a cube of 0.1 m, moved along x [m].
fn tetrahedron(shift: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let corners = [
        [0.0, 0.0, 0.0],
        [0.1, 0.0, 0.0],
        [0.0, 0.1, 0.0],
        [0.0, 0.0, 0.1],
    ];
    let moved = corners.map(|[x, y, z]| [x + shift, y, z]).to_vec();
    (moved, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
}

fn two_tetrahedra(shift: f64) -> TriangleMesh {
    let (mut vertices, mut triangles) = tetrahedron(0.0);
    let (more, same) = tetrahedron(shift);
    vertices.extend(more);
    triangles.extend(same.iter().map(|t| t.map(|n| n + 4)));
    mesh(&vertices, &triangles)
}

fn kinds(report: &MeshReport) -> Vec<(ProblemKind, usize)> {
    report.problems.iter().map(|p| (p.kind, p.count)).collect()
}

#[test]
fn a_solid_has_no_problem() {
    let (vertices, triangles) = tetrahedron(0.0);
    let report = inspect(&mesh(&vertices, &triangles));
    assert!(report.closed && report.manifold && report.oriented);
    assert_eq!((report.genus, report.components), (Some(0), 1));
    assert!((report.volume_m3 - 1e-3 / 6.0).abs() < 1e-18);
    assert_eq!(kinds(&report), []);
}

#[test]
fn faults_are_counted() {
    let (mut vertices, triangles) = tetrahedron(0.0);
    vertices.push([9.0, 9.0, 9.0]);
    let report = inspect(&mesh(&vertices, &triangles[..3]));
    let expected = [
        (ProblemKind::NotClosed, 3),
        (ProblemKind::UnusedVertices, 1),
    ];
    assert_eq!(kinds(&report), expected);

    let inward: Vec<_> = triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
    let report = inspect(&mesh(&vertices[..4], &inward));
    assert_eq!(kinds(&report), [(ProblemKind::NotOriented, 4)]);
}

#[test]
fn pieces_that_cross_are_told_from_pieces_that_do_not() {
    let apart = inspect(&two_tetrahedra(0.2));
    assert_eq!(kinds(&apart), [(ProblemKind::SeveralPieces, 2)]);
    assert_eq!(apart.genus, Some(0));
    // The sides on the planes y = 0 and z = 0 lie on each other, and the slanted side of the first
    // cuts the upright side of the second: three of each.
    let crossing = inspect(&two_tetrahedra(0.05));
    assert_eq!(crossing.self_intersections, 6);
}

/// Two triangles with the given corners [m] that have `shared` vertices in common.
fn crossing(corners: &[[f64; 3]], other: [u32; 3]) -> usize {
    inspect(&mesh(corners, &[[0, 1, 2], other])).self_intersections
}

#[test]
fn neighbours_that_only_share_what_they_have_in_common_do_not_cross() {
    let flat = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let with = |more: &[[f64; 3]]| [&flat, more].concat();
    // A common edge: opened, flat, folded together.
    assert_eq!(crossing(&with(&[[1.0, 1.0, 1.0]]), [2, 1, 3]), 0);
    assert_eq!(crossing(&with(&[[1.0, 1.0, 0.0]]), [2, 1, 3]), 0);
    assert_eq!(crossing(&with(&[[0.1, 0.1, 0.0]]), [2, 1, 3]), 2);
    // A common vertex: away, through the middle, in the same plane.
    let away = with(&[[-1.0, 0.0, 1.0], [-1.0, 0.0, -1.0]]);
    assert_eq!(crossing(&away, [0, 3, 4]), 0);
    let through = with(&[[0.3, 0.3, 1.0], [0.3, 0.3, -1.0]]);
    assert_eq!(crossing(&through, [0, 3, 4]), 2);
    let in_plane = with(&[[1.0, 1.0, 0.0], [0.2, 0.9, 0.0]]);
    assert_eq!(crossing(&in_plane, [0, 3, 4]), 2);
    // Nothing in common: above, touching with a corner, inside.
    let above = with(&[[0.1, 0.1, 1e-9], [0.2, 0.1, 1e-9], [0.1, 0.2, 1.0]]);
    assert_eq!(crossing(&above, [3, 4, 5]), 0);
    let touching = with(&[[0.25, 0.25, 0.0], [0.25, 0.25, 1.0], [0.5, 0.25, 1.0]]);
    assert_eq!(crossing(&touching, [3, 4, 5]), 2);
    let inside = with(&[[0.1, 0.1, 0.0], [0.2, 0.1, 0.0], [0.1, 0.2, 0.0]]);
    assert_eq!(crossing(&inside, [3, 4, 5]), 2);
}

/// A curved organ, and one whose sides are all in a few planes, where only exact signs decide.
#[test]
fn thirty_thousand_triangles_take_less_than_three_seconds() {
    for organ in [Organ::Liver, Organ::Cube] {
        let mesh = organ.surface_mesh(30_000).unwrap();
        let started = std::time::Instant::now();
        let report = inspect(&mesh);
        let seconds = started.elapsed().as_secs_f64();
        println!("{}: {seconds:.3} s", organ.name());
        assert_eq!(report.self_intersections, 0);
        assert!(seconds < 3.0, "{seconds} s");
    }
}

/// The judge is the JSON beside each mesh, written by an independent program.
#[test]
fn real_meshes_have_the_counts_of_their_records() {
    let Some(folder) = data::folder() else { return };
    let mut seen = 0;
    for entry in sorted(&folder.join("meshes")) {
        let extension = entry
            .extension()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if !["ply", "stl", "obj"].contains(&extension.as_str()) {
            continue;
        }
        seen += 1;
        let started = std::time::Instant::now();
        let report = inspect(&read_mesh(&entry, None).unwrap().mesh);
        println!(
            "{}: {:?} in {:.3} s",
            entry.file_name().unwrap().to_string_lossy(),
            kinds(&report),
            started.elapsed().as_secs_f64()
        );
        let record = record(&entry);
        assert_eq!(record["vertices"], report.vertices, "{}", entry.display());
        assert_eq!(record["triangles"], report.triangles);
        assert_eq!(record["watertight"], report.closed);
        assert_eq!(record["winding_consistent"], report.oriented);
        assert_eq!(record["components"], report.components);
        assert_eq!(record["genus"], report.genus.unwrap());
        assert_eq!(record["self_intersecting_faces"], report.self_intersections);
        let off = report.volume_m3 / record["volume_m3"].as_f64().unwrap() - 1.0;
        // OBJ files are written with fewer digits.
        assert!(
            off.abs() < 1e-6,
            "{}: volume off by {off:e}",
            entry.display()
        );
        let only_slivers =
            |p: &palpate_geometry::MeshProblem| p.kind == ProblemKind::SliverTriangles;
        assert!(report.problems.iter().all(only_slivers));
    }
    assert!(seen > 0);
}

#[test]
fn real_dirty_meshes_have_the_faults_of_their_table() {
    let Some(folder) = data::folder() else { return };
    let dirty = |name: &str| {
        let path = folder.join("dirty").join(name);
        read_mesh(&path, None).unwrap().mesh
    };
    let hole = inspect(&dirty("vhf_liver_capsule_onehole.ply"));
    println!("{hole:?}");
    assert_eq!((hole.vertices, hole.triangles), (15133, 30034));
    assert_eq!((hole.boundary_edges, hole.components), (230, 1));
    assert!(hole.manifold && hole.self_intersections == 0);
    assert!(kinds(&hole).contains(&(ProblemKind::NotClosed, 230)));

    let double = inspect(&dirty("vhm_liver_capsule_doublewall.ply"));
    println!("{double:?}");
    assert!(double.closed && double.manifold && double.oriented);
    assert!((double.volume_m3 - 74.4e-6).abs() < 0.1e-6);
    assert!(kinds(&double).contains(&(ProblemKind::DoubleWall, 1)));

    let spleen = dirty("vhm_spleen_patches_unwelded.ply");
    let before = inspect(&spleen);
    println!("{before:?}");
    assert_eq!((before.boundary_edges, before.components), (1148, 5));
    let (repaired, repairs) = repair(&spleen).unwrap();
    let after = inspect(&repaired);
    println!("{repairs:?} {after:?}");
    assert!(after.closed && after.manifold && after.oriented);
    assert_eq!((after.vertices, after.components), (8438, 1));
}

fn sorted(folder: &Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

fn record(path: &Path) -> serde_json::Value {
    let text = std::fs::read_to_string(path.with_extension("json")).unwrap();
    serde_json::from_str(&text).unwrap()
}
