//! Slits in tetrahedra.

use palpate_geometry::{
    AabbTree, FillSettings, Organ, SlitPoint, SlitTetrahedra, Surface, TetrahedronMesh, Vec3,
    coarsen, fill,
};

fn area(mesh: &TetrahedronMesh) -> f64 {
    let faces = mesh.boundary().into_iter().map(|(corners, _)| {
        let [a, b, c] = corners.map(|node| mesh.vertices()[node.index()]);
        0.5 * (b - a).cross(&(c - a)).norm()
    });
    faces.sum()
}

/// Pieces that hang together by shared vertices.
fn pieces(mesh: &TetrahedronMesh) -> usize {
    let mut own: Vec<usize> = (0..mesh.vertices().len()).collect();
    loop {
        let mut changed = false;
        for corners in mesh.tetrahedra() {
            let least = corners.iter().map(|node| own[node.index()]).min().unwrap();
            for node in corners {
                changed |= std::mem::replace(&mut own[node.index()], least) != least;
            }
        }
        if !changed {
            break;
        }
    }
    own.sort_unstable();
    own.dedup();
    own.len()
}

/// Smallest height of a tetrahedron over its longest edge [-].
fn flattest(mesh: &TetrahedronMesh) -> f64 {
    let each = (0..mesh.tetrahedra().len()).map(|number| {
        let at = mesh.positions(number);
        let volume = (at[1] - at[0]).dot(&(at[2] - at[0]).cross(&(at[3] - at[0]))) / 6.0;
        let (mut largest, mut longest) = (0.0_f64, 0.0_f64);
        for k in 0..4 {
            let [a, b, c] = [1, 2, 3].map(|j| at[(k + j) % 4]);
            largest = largest.max(0.5 * (b - a).cross(&(c - a)).norm());
            longest = longest.max((b - a).norm()).max((at[k] - a).norm());
        }
        3.0 * volume / largest / longest
    });
    each.fold(f64::INFINITY, f64::min)
}

/// A block of 40 x 40 x 20 mm, its top at zero, with cells of 5 mm that are not where cuts are.
fn block() -> TetrahedronMesh {
    let n = [8, 8, 4];
    let node = |i: usize, j: usize, k: usize| ((k * (n[1] + 1) + j) * (n[0] + 1) + i) as u32;
    let mut vertices = Vec::new();
    for k in 0..=n[2] {
        for j in 0..=n[1] {
            for i in 0..=n[0] {
                vertices.push(5e-3 * Vec3::new(i as f64 - 4.0, j as f64 - 4.0, k as f64 - 4.0));
            }
        }
    }
    let mut tetrahedra = Vec::new();
    for k in 0..n[2] {
        for j in 0..n[1] {
            for i in 0..n[0] {
                let at = |a, b, c| palpate_geometry::NodeId(node(i + a, j + b, k + c));
                let [first, last] = [at(0, 0, 0), at(1, 1, 1)];
                for [from, to] in [
                    [at(1, 0, 0), at(1, 1, 0)],
                    [at(1, 1, 0), at(0, 1, 0)],
                    [at(0, 1, 0), at(0, 1, 1)],
                    [at(0, 1, 1), at(0, 0, 1)],
                    [at(0, 0, 1), at(1, 0, 1)],
                    [at(1, 0, 1), at(1, 0, 0)],
                ] {
                    tetrahedra.push([first, from, to, last]);
                }
            }
        }
    }
    TetrahedronMesh::new(vertices, tetrahedra).unwrap()
}

fn straight(from: Vec3, to: Vec3, depth: f64) -> Vec<SlitPoint> {
    let point = |place| SlitPoint {
        place,
        normal: Vec3::z(),
        depth,
    };
    vec![point(from), point(to)]
}

/// Judge: the rectangle itself. Whatever its place and size beside the cells, the sides of a slit are twice its area, but for the
/// ends, which vertices may stand off by a fifth of the slit's depth or length.
#[test]
fn a_slit_in_a_block_has_its_area() {
    let whole = block();
    for (number, (from, to, depth)) in [
        ([-9.0, 0.7, 0.0], [11.0, 0.7, 0.0], 6.0),
        ([-9.0, 1.3, 0.0], [11.0, -2.0, 0.0], 3.0),
        ([-9.0, 1.3, 0.0], [11.0, -12.0, 0.0], 1.2),
        ([-9.0, 0.0, 0.0], [11.0, 0.0, 0.0], 5.0),
        ([0.3, 0.2, 0.0], [3.0, 1.1, 0.0], 2.0),
        ([-14.0, -14.0, 0.0], [14.0, 13.0, 0.0], 11.0),
        ([-25.0, 2.1, 0.0], [25.0, 2.1, 0.0], 10.0),
    ]
    .into_iter()
    .enumerate()
    {
        let [from, to] = [from, to].map(|place| 1e-3 * Vec3::from(place));
        let depth = 1e-3 * depth;
        let mut slit = SlitTetrahedra::new(&whole);
        let opened = slit.open(&straight(from, to, depth));
        let (mesh, parents) = slit.into_mesh().unwrap();
        let length = (to - from).norm().min(40e-3);
        let expected = length * depth;
        let walls = 0.5 * (area(&mesh) - area(&whole));
        println!(
            "{number}: {:.1} of {:.1} mm², {} of {} tetrahedra, flattest {:.3} of {:.3}",
            1e6 * walls,
            1e6 * expected,
            mesh.tetrahedra().len(),
            whole.tetrahedra().len(),
            flattest(&mesh),
            flattest(&whole),
        );
        assert!((walls / opened - 1.0).abs() < 1e-9, "{walls} {opened}");
        assert!((walls / expected - 1.0).abs() < 0.06, "{number}");
        assert!(flattest(&mesh) > 0.01, "{number}");
        assert!((mesh.volume() / whole.volume() - 1.0).abs() < 1e-12);
        assert_eq!(parents.len(), mesh.tetrahedra().len());
        assert_eq!(pieces(&mesh), 1);
    }
}

/// Judge: a block that is cut through falls apart.
#[test]
fn a_block_is_cut_in_two() {
    let mut slit = SlitTetrahedra::new(&block());
    let [from, to] = [-25e-3, 25e-3].map(|x| Vec3::new(x, 1.7e-3 + 0.1 * x, 0.0));
    slit.open(&straight(from, to, 30e-3));
    assert_eq!(pieces(&slit.into_mesh().unwrap().0), 2);
}

/// Judge: a slit of many short parts around a bend, and one that is opened piece by piece, both have the area of the sheet.
#[test]
fn a_slit_may_bend() {
    let whole = block();
    let path: Vec<SlitPoint> = (0..=40)
        .map(|k| {
            let turn = f64::from(k) / 40.0 * 2.0;
            SlitPoint {
                place: 11e-3 * Vec3::new(turn.cos(), turn.sin(), 0.0),
                normal: Vec3::z(),
                depth: 4e-3,
            }
        })
        .collect();
    let mut slit = SlitTetrahedra::new(&whole);
    let opened = slit.open(&path);
    let (mesh, _) = slit.into_mesh().unwrap();
    println!("{:.1} mm², flattest {:.3}", 1e6 * opened, flattest(&mesh));
    assert!((opened / (22e-3 * 4e-3) - 1.0).abs() < 0.15, "{opened}");
}

/// Judge: the sheet's area at many places of organs, most of which bend. Paths over rims part less; nowhere is anything inside out
/// or flatter than rounding allows, and the volume stays.
#[test]
#[ignore = "long"]
fn organs_are_slit_anywhere() {
    const PLACES: usize = 25;
    for (which, triangles, depth, least) in [
        (Organ::Liver, 3000, 6e-3, 20),
        (Organ::Kidney, 2000, 4e-3, 24),
        (Organ::Esophagus, 4000, 1.5e-3, 18),
    ] {
        let surface = Surface::new(which.surface_mesh(triangles).unwrap()).unwrap();
        let fine = fill(
            &surface,
            &FillSettings::with_tetrahedron_count(&surface, 12_000),
        )
        .unwrap();
        let whole = coarsen(&fine, &surface, 1500, |_| 1.0).unwrap();
        let tree = AabbTree::new(surface.mesh());
        let (mut worst, mut most, mut whole_ones) = (f64::INFINITY, 0, 0);
        for number in 0..PLACES {
            let start = number * surface.mesh().vertices().len() / PLACES;
            let mut place = surface.mesh().vertices()[start];
            let mut heading = Vec3::new(0.3, f64::from(number as u32).sin(), 0.8);
            let mut path = Vec::new();
            for _ in 0..12 {
                let nearest = tree.nearest(surface.mesh(), &place);
                let normal = surface.mesh().area_vector(nearest.triangle).normalize();
                path.push(SlitPoint {
                    place: nearest.on.position,
                    normal,
                    depth,
                });
                heading = (heading - normal * normal.dot(&heading)).normalize();
                place = nearest.on.position + 2e-3 * heading;
            }
            let mut slit = SlitTetrahedra::new(&whole);
            let part = slit.open(&path) / (22e-3 * depth);
            let (mesh, _) = slit.into_mesh().unwrap();
            worst = worst.min(flattest(&mesh));
            most = most.max(mesh.tetrahedra().len() - whole.tetrahedra().len());
            whole_ones += usize::from((part - 1.0).abs() < 0.25);
            assert!(
                (mesh.volume() / whole.volume() - 1.0).abs() < 2e-3,
                "{number}"
            );
            assert!(flattest(&mesh) > 5e-4, "{number} {}", flattest(&mesh));
        }
        println!("{which:?}: {whole_ones} of {PLACES} whole, {most} more, flattest {worst:.4}");
        assert!(whole_ones >= least, "{which:?}: {whole_ones}");
    }
}

/// A path that ends where it begins cuts a piece out, wherever that is. Judge: the volume of a cylinder, or of a prism with chords as
/// long as a diagonal of a cell.
#[test]
fn a_closed_path_cuts_a_piece_out() {
    let block = block();
    for (number, radius) in [9.1e-3, 12.7e-3, 15.8e-3].into_iter().enumerate() {
        let middle = Vec3::new(0.7e-3, -1.1e-3, 0.0);
        let begin = 0.9 * number as f64;
        let mut path: Vec<SlitPoint> = (0..24)
            .map(|k| begin + std::f64::consts::TAU * f64::from(k) / 24.0)
            .map(|turn| SlitPoint {
                place: middle + radius * Vec3::new(turn.cos(), turn.sin(), 0.0),
                normal: Vec3::z(),
                depth: 30e-3,
            })
            .collect();
        path.push(path[0]);
        let mut slit = SlitTetrahedra::new(&block);
        slit.open(&path);
        let (mesh, _) = slit.into_mesh().unwrap();
        let own = mesh.pieces();
        assert_eq!(own.iter().max(), Some(&1), "{radius}");
        let volume = |piece: usize| -> f64 {
            let numbers = own.iter().enumerate().filter(|(_, own)| **own == piece);
            let each = numbers.map(|(number, _)| {
                let [a, b, c, d] = mesh.positions(number);
                (b - a).dot(&(c - a).cross(&(d - a))) / 6.0
            });
            each.sum()
        };
        let cylinder = std::f64::consts::PI * radius * radius * 20e-3;
        let ratio = volume(0).min(volume(1)) / cylinder;
        let chord = 2.0 * (5e-3_f64.hypot(5e-3) / 2.0 / radius).asin();
        println!(
            "{radius}: {ratio:.4} of 1, {:.4} with chords",
            chord.sin() / chord
        );
        assert!((chord.sin() / chord..1.01).contains(&ratio), "{ratio}");
        assert!((volume(0) + volume(1) - 32e-6).abs() < 1e-12);
    }
}
