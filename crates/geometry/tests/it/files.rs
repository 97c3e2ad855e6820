//! Writers of small mesh files, for the round trips and for the damaged files.

use palpate_geometry::{NodeId, TriangleMesh, Vec3};

/// The corner of a cube of 0.125 m: single precision holds it exactly.
pub(crate) fn tetrahedron() -> TriangleMesh {
    let vertices = [Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()].map(|v| 0.125 * v);
    let triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let triangles = triangles.map(|t| t.map(NodeId)).to_vec();
    TriangleMesh::new(vertices.to_vec(), triangles).unwrap()
}

/// All formats: a file name and the bytes of `mesh`.
pub(crate) fn all(mesh: &TriangleMesh) -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("binary.stl", stl_binary(mesh)),
        ("text.stl", stl_text(mesh).into_bytes()),
        ("text.obj", obj(mesh).into_bytes()),
        ("text.ply", ply(mesh, "ascii", |text, _| text.to_vec())),
        (
            "little.ply",
            ply(mesh, "binary_little_endian", |_, little| little.to_vec()),
        ),
        (
            "big.ply",
            ply(mesh, "binary_big_endian", |_, little| {
                little.iter().rev().copied().collect()
            }),
        ),
        ("whole.glb", glb(mesh)),
        ("whole.gltf", gltf(mesh).into_bytes()),
    ]
}

fn stl_binary(mesh: &TriangleMesh) -> Vec<u8> {
    let triangles = mesh.triangle_ids().map(|t| stl_io::Triangle {
        normal: stl_io::Normal::default(),
        vertices: mesh
            .positions(t)
            .map(|p| stl_io::Vertex::new([p.x as f32, p.y as f32, p.z as f32])),
    });
    let triangles: Vec<_> = triangles.collect();
    let mut bytes = Vec::new();
    stl_io::write_stl(&mut bytes, triangles.iter()).unwrap();
    bytes
}

fn stl_text(mesh: &TriangleMesh) -> String {
    let mut text = String::from("solid\n");
    for triangle in mesh.triangle_ids() {
        text += "facet normal nan nan nan\n outer loop\n";
        for p in mesh.positions(triangle) {
            text += &format!("  vertex {} {} {:e}\n", p.x, p.y, p.z);
        }
        text += " endloop\nendfacet\n";
    }
    text + "endsolid\n"
}

fn obj(mesh: &TriangleMesh) -> String {
    let mut text = String::from("# a comment\no organ\n");
    for p in mesh.vertices() {
        text += &format!("v {} {} {}\n", p.x, p.y, p.z);
    }
    for (k, [a, b, c]) in mesh.triangles().iter().enumerate() {
        // Groups must not cut the mesh; numbers come in all their forms.
        let back = a.0 as i64 - mesh.vertices().len() as i64;
        text += &format!("g part{k}\nf {back} {}/1 {}//2\n", b.0 + 1, c.0 + 1);
    }
    text
}

/// A PLY whose values are written by `write` out of their text and their little-endian bytes.
fn ply(mesh: &TriangleMesh, encoding: &str, write: impl Fn(&[u8], &[u8]) -> Vec<u8>) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat {encoding} 1.0\ncomment made by a test\nelement vertex {}\n\
         property double x\nproperty double y\nproperty double z\nproperty uchar red\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.vertices().len(),
        mesh.triangles().len()
    )
    .into_bytes();
    for p in mesh.vertices() {
        for c in p.iter() {
            bytes.extend(write(format!("{c} ").as_bytes(), &c.to_le_bytes()));
        }
        bytes.extend(write(b"255\n", &[255]));
    }
    for triangle in mesh.triangles() {
        bytes.extend(write(b"3", &[3]));
        for node in triangle {
            bytes.extend(write(
                format!(" {}", node.0).as_bytes(),
                &node.0.to_le_bytes(),
            ));
        }
        bytes.extend(write(b"\n", b""));
    }
    bytes
}

/// The numbers of a glTF: positions, then vertex numbers.
fn gltf_buffer(mesh: &TriangleMesh) -> Vec<u8> {
    let positions = mesh
        .vertices()
        .iter()
        .flat_map(|p| p.iter().copied().collect::<Vec<_>>());
    let numbers = mesh.triangles().iter().flatten();
    let mut bytes: Vec<u8> = positions.flat_map(|c| (c as f32).to_le_bytes()).collect();
    bytes.extend(numbers.flat_map(|node| node.0.to_le_bytes()));
    bytes
}

/// The document of a glTF. The mesh hangs on a node that halves it under one that doubles it.
pub(crate) fn gltf_document(mesh: &TriangleMesh, buffer: &str) -> String {
    let (vertices, corners) = (mesh.vertices().len(), 3 * mesh.triangles().len());
    let (first, second) = (12 * vertices, 4 * corners);
    let (low, high) = mesh.bounds();
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
"nodes":[{{"children":[1],"scale":[2,2,2]}},{{"mesh":0,"matrix":[0.5,0,0,0,0,0.5,0,0,0,0,0.5,0,0,0,0,1]}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
"buffers":[{{{buffer}"byteLength":{}}}],
"bufferViews":[{{"buffer":0,"byteLength":{first}}},{{"buffer":0,"byteOffset":{first},"byteLength":{second}}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":{vertices},"type":"VEC3","min":{:?},"max":{:?}}},
{{"bufferView":1,"componentType":5125,"count":{corners},"type":"SCALAR"}}]}}"#,
        first + second,
        low.as_slice(),
        high.as_slice()
    )
}

fn gltf(mesh: &TriangleMesh) -> String {
    // Base64 of the buffer through its bits, slow and plain.
    let bits: String = gltf_buffer(mesh)
        .iter()
        .map(|b| format!("{b:08b}"))
        .collect();
    let digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let coded: String = bits
        .as_bytes()
        .chunks(6)
        .map(|six| {
            let six = format!("{:0<6}", std::str::from_utf8(six).unwrap());
            digits.as_bytes()[usize::from_str_radix(&six, 2).unwrap()] as char
        })
        .collect();
    gltf_document(
        mesh,
        &format!(r#""uri":"data:application/octet-stream;base64,{coded}","#),
    )
}

fn glb(mesh: &TriangleMesh) -> Vec<u8> {
    let mut document = gltf_document(mesh, "").into_bytes();
    while !document.len().is_multiple_of(4) {
        document.push(b' ');
    }
    let buffer = gltf_buffer(mesh);
    let length = 12 + 8 + document.len() + 8 + buffer.len();
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((length as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &document), (b"BIN\0", &buffer)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}
