//! Files of tetrahedra: written here, or by the crate, and read back.

use std::fmt::Write;

use palpate_geometry::vtk::{CellKind, Cells, FieldValues, PointField, unstructured_grid};
use palpate_geometry::{
    ImportedTetrahedra, LengthUnit, ReadError, TetrahedronMesh, Vec3, read_tetrahedra,
};

/// Eighths of a metre, which text and single precision hold exactly.
fn block() -> TetrahedronMesh {
    TetrahedronMesh::block(Vec3::zeros(), Vec3::new(0.25, 0.125, 0.125), [2, 1, 1]).unwrap()
}

/// All formats: a file name and bytes that hold the block.
pub(crate) fn all() -> Vec<(&'static str, Vec<u8>)> {
    let mesh = block();
    vec![
        ("two.msh", msh_2(&mesh, false).into_bytes()),
        ("two_quadratic.msh", msh_2(&mesh, true).into_bytes()),
        ("four.msh", msh_4(&mesh).into_bytes()),
        ("lists.vtk", vtk_lists(&mesh).into_bytes()),
        ("offsets.vtk", vtk_offsets(&mesh).into_bytes()),
        ("text.vtu", vtu_text(&mesh).into_bytes()),
        ("own.vtu", vtu_own(&mesh)),
    ]
}

/// Numbers of the regions: 4 of the first tetrahedra, 9 of the others.
fn numbers(mesh: &TetrahedronMesh) -> Vec<i64> {
    let count = mesh.tetrahedra().len();
    (0..count)
        .map(|k| if k < count / 3 { 4 } else { 9 })
        .collect()
}

fn spaced(values: impl IntoIterator<Item = impl ToString>) -> String {
    let words: Vec<_> = values.into_iter().map(|v| v.to_string()).collect();
    words.join(" ")
}

/// Numbered from 7 on in steps of 3, with a triangle first. With nodes on the edges their positions
/// are nonsense, since they are not to be used.
fn msh_2(mesh: &TetrahedronMesh, quadratic: bool) -> String {
    let tag = |n: u32| 7 + 3 * n;
    let count = mesh.vertices().len() as u32;
    let extra = if quadratic { 1 } else { 0 };
    let mut text = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    text += "$PhysicalNames\n2\n2 5 \"skin\"\n3 9 \"$Nodes in a name\"\n$EndPhysicalNames\n";
    writeln!(text, "$Nodes\n{}", count + extra).unwrap();
    for (n, p) in mesh.vertices().iter().enumerate() {
        writeln!(text, "{} {} {} {:e}", tag(n as u32), p.x, p.y, p.z).unwrap();
    }
    if quadratic {
        writeln!(text, "{} 9 9 9", tag(count)).unwrap();
    }
    writeln!(
        text,
        "$EndNodes\n$Elements\n{}",
        mesh.tetrahedra().len() + 1
    )
    .unwrap();
    writeln!(text, "1 2 2 0 1 {} {} {}", tag(0), tag(1), tag(2)).unwrap();
    for (k, corners) in mesh.tetrahedra().iter().enumerate() {
        let (kind, middles) = if quadratic { (11, 6) } else { (4, 0) };
        let nodes = corners.iter().map(|n| tag(n.0));
        let nodes = spaced(nodes.chain(std::iter::repeat_n(tag(count), middles)));
        writeln!(text, "{} {kind} 2 {} 1 {nodes}", k + 2, numbers(mesh)[k]).unwrap();
    }
    text + "$EndElements\n"
}

/// Two blocks of nodes and two of elements, points first.
fn msh_4(mesh: &TetrahedronMesh) -> String {
    let (nodes, half) = (mesh.vertices().len(), mesh.vertices().len() / 2);
    let mut text = String::from("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n");
    text = text.replace("0 0 0 1\n", "0 0 0 2\n");
    text += "1 0 0 0 1 1 1 1 4 0\n2 0 0 0 1 1 1 2 9 4 1 -7\n$EndEntities\n";
    writeln!(text, "$Nodes\n2 {nodes} 1 {nodes}").unwrap();
    for (entity, range) in [(2, 0..half), (3, half..nodes)] {
        writeln!(text, "{entity} 1 0 {}", range.len()).unwrap();
        for n in range.clone() {
            writeln!(text, "{}", n + 1).unwrap();
        }
        for p in &mesh.vertices()[range] {
            writeln!(text, "{} {} {}", p.x, p.y, p.z).unwrap();
        }
    }
    let cells = mesh.tetrahedra().len();
    writeln!(
        text,
        "$EndNodes\n$Elements\n3 {} 1 {}\n0 1 15 1\n1 1",
        cells + 1,
        cells + 1
    )
    .unwrap();
    let first = numbers(mesh).iter().filter(|number| **number == 4).count();
    for (k, corners) in mesh.tetrahedra().iter().enumerate() {
        match k {
            0 => writeln!(text, "3 1 4 {first}").unwrap(),
            k if k == first => writeln!(text, "3 2 4 {}", cells - first).unwrap(),
            _ => {}
        }
        writeln!(text, "{} {}", k + 2, spaced(corners.map(|n| n.0 + 1))).unwrap();
    }
    text + "$EndElements\n"
}

fn vtk_start(mesh: &TetrahedronMesh, version: &str, title: &str) -> String {
    let mut text = format!("# vtk DataFile Version {version}\n{title}\nASCII\n");
    text += "DATASET UNSTRUCTURED_GRID\n";
    writeln!(text, "POINTS {} double", mesh.vertices().len()).unwrap();
    for p in mesh.vertices() {
        write!(text, "{} {} {} ", p.x, p.y, p.z).unwrap();
    }
    text
}

fn vtk_types(mesh: &TetrahedronMesh) -> String {
    let types = std::iter::repeat_n(10, mesh.tetrahedra().len());
    let types = spaced(std::iter::once(5).chain(types));
    format!(
        "\nCELL_TYPES {}\n{types}\nPOINT_DATA 0\nCELL_DATA {}\nSCALARS u float 1\nLOOKUP_TABLE default\n{}\n\
         FIELD FieldData 1\nMaterialIDs 1 {} int\n{}\n",
        mesh.tetrahedra().len() + 1,
        mesh.tetrahedra().len() + 1,
        spaced(vec![0.5; mesh.tetrahedra().len() + 1]),
        mesh.tetrahedra().len() + 1,
        spaced(std::iter::once(77).chain(numbers(mesh)))
    )
}

fn vtk_lists(mesh: &TetrahedronMesh) -> String {
    let mut text = vtk_start(mesh, "3.0", "");
    let cells = mesh.tetrahedra().len();
    write!(text, "\nCELLS {} {}\n3 0 1 2", cells + 1, 5 * cells + 4).unwrap();
    for corners in mesh.tetrahedra() {
        write!(text, "\n4 {}", spaced(corners.map(|n| n.0))).unwrap();
    }
    text + &vtk_types(mesh)
}

fn vtk_offsets(mesh: &TetrahedronMesh) -> String {
    let mut text = vtk_start(mesh, "5.1", "with metadata");
    let cells = mesh.tetrahedra().len();
    let offsets = spaced((0..=cells).map(|k| 3 + 4 * k));
    let nodes = spaced(mesh.tetrahedra().iter().flatten().map(|n| n.0));
    write!(
        text,
        "\nMETADATA\nINFORMATION 0\n\nCELLS {} {}\nOFFSETS vtktypeint64\n0 {offsets}\n\
         CONNECTIVITY vtktypeint64\n0 1 2 {nodes}\n",
        cells + 2,
        3 + 4 * cells
    )
    .unwrap();
    text + &vtk_types(mesh)
}

fn vtu_text(mesh: &TetrahedronMesh) -> String {
    let cells = mesh.tetrahedra().len();
    let points = spaced(mesh.vertices().iter().flat_map(|p| [p.x, p.y, p.z]));
    let nodes = spaced(mesh.tetrahedra().iter().flatten().map(|n| n.0));
    let offsets = spaced((1..=cells).map(|k| 4 * k));
    let types = spaced(std::iter::repeat_n(10, cells));
    let array = |name: &str, values: &str| {
        format!("<DataArray type='Int64' Name=\"{name}\" format=\"ascii\">\n{values}\n</DataArray>")
    };
    format!(
        "<?xml version=\"1.0\"?>\n<!-- a comment with <Points> -->\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n\
         <UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{cells}\">\n\
         <PointData>{}</PointData>\n<CellData>{}</CellData>\n<Points>{}</Points>\n<Cells>{}\n{}{}</Cells>\n\
         </Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
        mesh.vertices().len(),
        array("u", "1 2 3"),
        array("gmsh:physical", &spaced(numbers(mesh))),
        array("Points", &points),
        array("connectivity", &nodes),
        array("offsets", &offsets),
        array("types", &types),
    )
}

fn vtu_own(mesh: &TetrahedronMesh) -> Vec<u8> {
    let nodes: Vec<u32> = mesh.tetrahedra().iter().flatten().map(|n| n.0).collect();
    let cells = Cells {
        kind: CellKind::Tetrahedron,
        nodes: &nodes,
    };
    let numbers: Vec<f64> = numbers(mesh).into_iter().map(|n| n as f64).collect();
    let point_fields = [PointField {
        name: "position & <place>",
        values: FieldValues::Vectors(mesh.vertices()),
    }];
    let cell_fields = [PointField {
        name: "region",
        values: FieldValues::Scalars(&numbers),
    }];
    unstructured_grid(mesh.vertices(), &cells, &point_fields, &cell_fields)
}

fn read(
    name: &str,
    bytes: &[u8],
    unit: Option<LengthUnit>,
) -> Result<ImportedTetrahedra, ReadError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    read_tetrahedra(&path, unit)
}

#[test]
fn every_format_gives_the_tetrahedra_back() {
    for (name, bytes) in all() {
        let imported = read(name, &bytes, None).unwrap();
        let regions = numbers(&block())
            .into_iter()
            .map(|number| u32::from(number == 9));
        let expected = block().with_regions(regions.collect()).unwrap();
        assert_eq!(imported.mesh, expected, "{name}");
        let found: Vec<_> = imported
            .regions
            .iter()
            .map(|r| (r.number, r.tetrahedra))
            .collect();
        assert_eq!(found, [(4, 4), (9, 8)], "{name}");
        let named = name
            .starts_with("two")
            .then(|| "$Nodes in a name".to_owned());
        assert_eq!(imported.regions[1].name, named, "{name}");
        assert_eq!((imported.unit, imported.turned), (LengthUnit::Metre, 0));
        assert!(imported.warnings.is_empty());
        let small = read(name, &bytes, Some(LengthUnit::Millimetre)).unwrap();
        assert!((small.mesh.volume() / block().volume() - 1e-9).abs() < 1e-20);
        assert!(small.warnings[0].contains("check mesh_unit"));
    }
}

#[test]
fn a_quadratic_grid_has_its_corners_read_back() {
    let mut nodes: Vec<u32> = (0..10).collect();
    nodes.extend([1, 2, 3, 4, 10, 11, 12, 13, 14, 15]);
    let mut positions = vec![Vec3::repeat(0.1); 16];
    positions[..4].copy_from_slice(&[Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()]);
    positions[4] = Vec3::repeat(1.0);
    let cells = Cells {
        kind: CellKind::QuadraticTetrahedron,
        nodes: &nodes,
    };
    let bytes = unstructured_grid(&positions, &cells, &[], &[]);
    let mesh = read("quadratic.vtu", &bytes, Some(LengthUnit::Metre))
        .unwrap()
        .mesh;
    assert_eq!((mesh.vertices().len(), mesh.tetrahedra().len()), (5, 2));
}

#[test]
fn inverted_ones_are_turned_and_flat_ones_refused() {
    let start = "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\n\
                 POINTS 5 float\n0 0 0 .1 0 0 0 .1 0 0 0 .1 .1 .1 0\nCELLS 2 10\n";
    let turned = format!("{start}4 0 1 2 3 4 4 1 2 3\nCELL_TYPES 2\n10 10\n");
    let imported = read("turned.vtk", turned.as_bytes(), None).unwrap();
    assert_eq!(imported.turned, 1);
    assert!((imported.mesh.volume() - 1e-3 / 3.0).abs() < 1e-18);
    let flat = format!("{start}4 0 1 2 3 4 0 1 2 4\nCELL_TYPES 2\n10 10\n");
    let message = read("flat.vtk", flat.as_bytes(), None)
        .unwrap_err()
        .to_string();
    assert!(message.contains("tetrahedron 1 has no volume"), "{message}");
}

fn file(name: &str) -> String {
    let all = all();
    let found = all.into_iter().find(|(n, _)| *n == name).unwrap().1;
    String::from_utf8(found).unwrap()
}

/// Each with the file that is changed, what is changed to what, and words of the message.
const BAD: [(&str, &str, &str, &[&str]); 21] = [
    (
        "two.msh",
        "$MeshFormat\n",
        "$Mesh\n",
        &["line 1", "`$Mesh`", "`$MeshFormat`"],
    ),
    (
        "two.msh",
        "2.2 0 8",
        "2.2 1 8",
        &["binary", "Mesh.Binary = 0"],
    ),
    (
        "two.msh",
        "2.2 0 8",
        "4.0 0 8",
        &["line 2", "`4.0`", "version 2.2 or 4.1"],
    ),
    (
        "two.msh",
        "7 0 0 0e0",
        "7 0 x 0e0",
        &["line 11", "`x`", "a number"],
    ),
    (
        "two.msh",
        "7 0 0 0e0",
        "10 0 0 0e0",
        &["line 12", "`10`", "not there before"],
    ),
    (
        "two.msh",
        "2 4 2 4 1 7",
        "2 4 2 4 1 8",
        &["cell 1", "vertex 8", "12 of the file"],
    ),
    (
        "two.msh",
        "2 4 2 4 1",
        "2 5 2 4 1",
        &["cell 1", "a hexahedron (type 5)"],
    ),
    (
        "two.msh",
        "$EndElements",
        "",
        &["ends at line", "`$EndElements`"],
    ),
    (
        "four.msh",
        "3 2 4 8",
        "3 2 4 9",
        &["`$EndElements`", "the number of an element"],
    ),
    ("two.msh", " 4 2 ", " 2 2 ", &["no tetrahedra"]),
    (
        "lists.vtk",
        "# vtk",
        "# VTK",
        &["line 1", "`# vtk DataFile Version`"],
    ),
    (
        "lists.vtk",
        "ASCII",
        "BINARY",
        &["binary VTK", "File Type Ascii"],
    ),
    (
        "lists.vtk",
        "UNSTRUCTURED_GRID",
        "POLYDATA",
        &["line 4", "POLYDATA"],
    ),
    (
        "lists.vtk",
        "POINTS 12",
        "POINTS 99999999999",
        &["`CELLS`", "a number"],
    ),
    (
        "lists.vtk",
        "4 0 3 9 10",
        "4 0 3 9 99",
        &["vertex 99", "12 of the file"],
    ),
    (
        "lists.vtk",
        "5 10",
        "5 12",
        &["cell 1", "a hexahedron (type 12)"],
    ),
    (
        "offsets.vtk",
        "CONNECTIVITY",
        "CONNECTED",
        &["`CONNECTED`", "`CONNECTIVITY`"],
    ),
    (
        "offsets.vtk",
        "0 3 7",
        "0 3 8",
        &["5 nodes of a tetrahedron", "4 were expected"],
    ),
    (
        "text.vtu",
        "UnstructuredGrid\"",
        "PolyData\"",
        &["line 3", "`PolyData`"],
    ),
    (
        "text.vtu",
        "ascii",
        "appended",
        &["compressed or appended", "Data Mode Ascii"],
    ),
    ("own.vtu", "UInt64", "UInt32", &["bytes", "cut short"]),
];

#[test]
fn bad_files_are_refused_with_their_place() {
    for (name, old, new, words) in BAD {
        let text = file(name);
        assert!(text.contains(old), "`{old}` is in {name}:\n{text}");
        let changed = text.replace(old, new);
        let message = match read(name, changed.as_bytes(), None) {
            Ok(_) => panic!("{name} with `{new}` is read"),
            Err(error) => error.to_string(),
        };
        println!("{message}");
        assert!(message.contains(name), "{message}");
        for word in words {
            assert!(message.contains(word), "{name}, `{new}`: {message}");
        }
    }
    let stl = read("a.stl", b"solid", None).unwrap_err().to_string();
    assert!(stl.contains("`stl`") && stl.contains(".msh"), "{stl}");
    assert!(
        read("a.msh", b"", None)
            .unwrap_err()
            .to_string()
            .contains("empty")
    );
    let far = file("lists.vtk").replace("0.25", "250");
    let message = read("far.vtk", far.as_bytes(), None)
        .unwrap_err()
        .to_string();
    assert!(message.contains("set mesh_unit"), "{message}");
}
