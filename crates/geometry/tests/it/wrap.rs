//! Envelopes of triangles that are no surface, judged by volumes in closed form and by the asked distance.

use std::f64::consts::PI;

use palpate_geometry::{
    NodeId, Surface, TriangleMesh, Vec3, WrapError, WrapSettings, Wrapped, inspect, wrap,
};

use crate::shapes::ball;

const SETTINGS: WrapSettings = WrapSettings {
    distance: 0.5e-3,
    close_gaps: 2e-3,
    triangles: 40_000,
};

/// Triangles of several meshes, each with vertices of its own; those that `keep` refuses are left out.
fn soup(meshes: &[TriangleMesh], keep: impl Fn(usize, &[Vec3; 3]) -> bool) -> TriangleMesh {
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for mesh in meshes {
        for triangle in mesh.triangle_ids() {
            let corners = mesh.positions(triangle);
            if keep(triangle.index(), &corners) {
                let first = vertices.len() as u32;
                vertices.extend(corners);
                // Every third is turned over.
                let [b, c] = if triangle.index() % 3 == 0 {
                    [2, 1]
                } else {
                    [1, 2]
                };
                triangles.push([first, first + b, first + c].map(NodeId));
            }
        }
    }
    TriangleMesh::new(vertices, triangles).unwrap()
}

fn moved(mesh: &TriangleMesh, by: Vec3, scale: f64) -> TriangleMesh {
    mesh.map_vertices(|vertex| scale * vertex + by).unwrap()
}

/// Closed, one piece, crossing nothing, within `distance` [m], and of `volume` [m³] to 1 %: half the asked distance
/// over a ball of 20 mm is 3.7 %, and voxels err to both sides.
fn check(wrapped: &Wrapped, volume: f64, distance: f64) {
    let mesh = wrapped.surface.mesh();
    let found = mesh.volume() / volume - 1.0;
    println!("{found:+.4} {:?} {:?}", wrapped.to_input, wrapped.of_input);
    assert!(found.abs() < 0.01, "{found}");
    assert!(wrapped.to_input.max <= distance, "{:?}", wrapped.to_input);
    assert_eq!(inspect(mesh).self_intersections, 0);
}

#[test]
fn a_ball_with_double_walls_and_missing_triangles_is_a_ball() {
    let outer = ball(0.02);
    let inner = moved(&outer, Vec3::zeros(), 0.75);
    let count = outer.triangles().len();
    let input = soup(&[outer, inner], |number, _| number % (count / 7) > 2);
    let wrapped = wrap(&input, &SETTINGS).unwrap();
    assert!(wrapped.holes >= 6, "{}", wrapped.holes);
    check(
        &wrapped,
        4.0 / 3.0 * PI * 0.02f64.powi(3),
        SETTINGS.distance,
    );
    // What lies inside is far from the envelope.
    assert!(wrapped.of_input.max > 0.004, "{:?}", wrapped.of_input);
}

#[test]
fn two_crossing_balls_are_their_union() {
    let (radius, apart) = (0.02, 0.025);
    let one = ball(radius);
    let other = moved(&one, Vec3::new(apart, 0.0, 0.0), 1.0);
    let wrapped = wrap(&soup(&[one, other], |_, _| true), &SETTINGS).unwrap();
    // Both balls without one of the two caps of height h that they share twice.
    let h = radius - 0.5 * apart;
    let lens = 2.0 * PI * h * h * (3.0 * radius - h) / 3.0;
    let union = 8.0 / 3.0 * PI * radius.powi(3) - lens;
    // Where they cross, the closing fills a ring: the torus-like fillet of a ball of 1 mm, 0.03 % here.
    check(&wrapped, union, SETTINGS.distance);
}

#[test]
fn two_halves_with_a_gap_are_one_body() {
    let whole = ball(0.02);
    let gap = 1.5e-3;
    let half = |sign: f64| {
        let kept = soup(std::slice::from_ref(&whole), |_, corners| {
            corners.iter().all(|corner| sign * corner.z >= -1e-9)
        });
        moved(&kept, Vec3::new(0.0, 0.0, 0.5 * sign * gap), 1.0)
    };
    let wrapped = wrap(&soup(&[half(1.0), half(-1.0)], |_, _| true), &SETTINGS).unwrap();
    assert_eq!(wrapped.other_pieces, 0);
    // A slice of the gap's width, whose rim the ball of 1 mm rounds inwards a little.
    let volume = 4.0 / 3.0 * PI * 0.02f64.powi(3) + PI * 0.02f64.powi(2) * gap;
    // Amid the gap nothing is nearer than half its width.
    check(&wrapped, volume, 0.5 * gap + 0.1 * SETTINGS.distance);
}

#[test]
fn a_wide_opening_without_a_rim_is_told_with_its_width() {
    // A bit of a ball has no inside.
    let sheet = soup(&[ball(0.02)], |_, corners| {
        corners.iter().all(|corner| corner.z > 0.0194)
    });
    let open = wrap(&sheet, &SETTINGS);
    assert!(matches!(open, Err(WrapError::Open { .. })), "{open:?}");
    // A ball with a double wall, whose sheets meet at the rim of an opening of 20 mm, without a free edge.
    let outer = 0.02;
    let walls = double_walled_cup([outer, 0.018], PI / 6.0);
    let Err(WrapError::Open {
        closing: Some(width),
        ..
    }) = wrap(&walls, &SETTINGS)
    else {
        panic!("an open cup is refused with the width that closes it");
    };
    assert!((0.018..0.024).contains(&width), "{width}");
    let settings = WrapSettings {
        close_gaps: width,
        ..SETTINGS
    };
    let closed = wrap(&walls, &settings).unwrap().surface.mesh().volume();
    // The ball that closes the opening reaches into it.
    let whole = 4.0 / 3.0 * PI * outer.powi(3);
    let part = closed / whole;
    assert!((0.85..1.0).contains(&part), "{part}");
}

/// Two balls of these radii [m], open down to an angle from their upper pole, where a band joins them.
fn double_walled_cup([outer, inner]: [f64; 2], open: f64) -> TriangleMesh {
    const AROUND: usize = 48;
    const ALONG: usize = 32;
    let ring = |radius: f64, angle: f64| {
        (0..AROUND).map(move |n| {
            let (sine, cosine) = (2.0 * PI * n as f64 / AROUND as f64).sin_cos();
            radius * Vec3::new(angle.sin() * cosine, angle.sin() * sine, angle.cos())
        })
    };
    let angle = |n: usize| open + (PI - open) * n as f64 / ALONG as f64;
    // From the lower pole of the outer one up to the rim and down again.
    let up = (0..ALONG).rev().flat_map(|n| ring(outer, angle(n)));
    let down = (0..ALONG).flat_map(|n| ring(inner, angle(n)));
    let mut vertices: Vec<Vec3> = up.chain(down).collect();
    let poles = [outer, inner].map(|radius| {
        vertices.push(-radius * Vec3::z());
        NodeId(vertices.len() as u32 - 1)
    });
    let node = |ring: usize, n: usize| NodeId((ring * AROUND + n % AROUND) as u32);
    let last = 2 * ALONG - 1;
    let mut triangles = Vec::new();
    for n in 0..AROUND {
        triangles.push([poles[0], node(0, n + 1), node(0, n)]);
        triangles.push([poles[1], node(last, n), node(last, n + 1)]);
        for ring in 0..last {
            let [a, b] = [node(ring, n), node(ring, n + 1)];
            let [c, d] = [node(ring + 1, n), node(ring + 1, n + 1)];
            triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
    TriangleMesh::new(vertices, triangles).unwrap()
}

#[test]
fn distances_that_are_none_or_too_small_are_refused() {
    let body = ball(0.02);
    for distance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let settings = WrapSettings {
            distance,
            ..SETTINGS
        };
        let refused = wrap(&body, &settings);
        assert!(
            matches!(refused, Err(WrapError::Distance { .. })),
            "{distance}"
        );
    }
    for close_gaps in [-1.0, f64::NAN, f64::INFINITY] {
        let settings = WrapSettings {
            close_gaps,
            ..SETTINGS
        };
        let refused = wrap(&body, &settings);
        assert!(
            matches!(refused, Err(WrapError::Gaps { .. })),
            "{close_gaps}"
        );
    }
    let settings = WrapSettings {
        distance: 1e-6,
        ..SETTINGS
    };
    let Err(WrapError::TooFine { least, .. }) = wrap(&body, &settings) else {
        panic!("a micrometre fits");
    };
    assert!(least > 1e-6);
}

/// A whole surface stays as it is, but for the asked distance.
#[test]
fn a_surface_is_its_own_envelope() {
    let body = ball(0.02);
    let wrapped = wrap(&body, &SETTINGS).unwrap();
    let volume = Surface::new(body).unwrap().mesh().volume();
    check(&wrapped, volume, SETTINGS.distance);
    assert!(
        wrapped.of_input.max <= SETTINGS.distance,
        "{:?}",
        wrapped.of_input
    );
    assert_eq!((wrapped.holes, wrapped.other_pieces), (0, 0));
}
