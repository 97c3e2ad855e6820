use std::collections::BTreeMap;

use super::*;

fn tool(kind: ToolKind) -> scene::Tool {
    scene::Tool {
        kind,
        trocar_m: Some([0.0, 0.0, 0.1]),
        ..scene::Tool::default()
    }
}

fn place([x, y, z, ..]: &[f32; 6]) -> Vec3 {
    Vec3::new(f64::from(*x), f64::from(*y), f64::from(*z))
}

fn normal([.., x, y, z]: &[f32; 6]) -> Vec3 {
    Vec3::new(f64::from(*x), f64::from(*y), f64::from(*z))
}

/// Judge: topology, and the theorem of divergence. Each edge is there as often in one direction as in the
/// other, once every triangle is turned the way of its normals, and what is inside has a volume.
#[test]
fn every_part_bounds_a_solid() {
    for (_, kind) in ToolKind::WORDS {
        for part in ToolShape::of(&tool(*kind)).parts() {
            let mut edges: BTreeMap<([i64; 3], [i64; 3]), i64> = BTreeMap::new();
            let mut volume = 0.0;
            let named = format!("{kind} {:?}", part.motion);
            for corners in part.corners.chunks(3) {
                let [mut a, mut b, c] = [0, 1, 2].map(|k| place(&corners[k]));
                let seen: Vec3 = corners.iter().map(normal).sum();
                if (b - a).cross(&(c - a)).dot(&seen) < 0.0 {
                    std::mem::swap(&mut a, &mut b);
                }
                for corner in corners {
                    assert!((normal(corner).norm() - 1.0).abs() < 1e-5, "{named}");
                }
                volume += a.dot(&b.cross(&c)) / 6.0;
                let key = |v: &Vec3| -> [i64; 3] { v.map(|c| (c / 2e-7).round() as i64).into() };
                for (from, to) in [(a, b), (b, c), (c, a)] {
                    let (from, to) = (key(&from), key(&to));
                    if from < to {
                        *edges.entry((from, to)).or_default() += 1;
                    } else if to < from {
                        *edges.entry((to, from)).or_default() -= 1;
                    }
                }
            }
            let open = edges.values().filter(|&&count| count != 0).count();
            assert_eq!(open, 0, "{named} of {} edges", edges.len());
            assert!(volume > 1e-10, "{named}: {volume}");
        }
    }
}

/// Judge: the scene's word. The tips are as far apart as the jaws open, half as far at half the angle, and
/// together when shut.
#[test]
fn jaws_open_as_far_as_they_say() {
    for kind in [ToolKind::Grasper, ToolKind::Scissors] {
        let tool = tool(kind);
        let apart = |grip: f64| {
            let picture = ToolPicture::new(&tool, [0.0; 3], [0.0, 0.0, 0.0, 1.0]).gripping(grip);
            let ends: Vec<Vec3> = picture
                .shape
                .parts()
                .iter()
                .filter(|part| matches!(part.motion, Motion::Turned { .. }))
                .map(|part| {
                    picture
                        .placed(part)
                        .transform_point(&Vec3::zeros().into())
                        .coords
                })
                .collect();
            ends[0].x - ends[1].x
        };
        let jaws = JawSize::of(&tool);
        let half_angle = 2.0 * jaws.length * (0.5 * jaws.angle()).sin();
        // Rounding of a sine.
        assert!((apart(0.0) - jaws.opening).abs() < 1e-12, "{kind}");
        assert!((apart(0.5) - half_angle).abs() < 1e-12, "{kind}");
        assert!(apart(1.0).abs() < 1e-12, "{kind}");
    }
}

/// A shut jaw stays on its side, so that two do not pass through one another.
#[test]
fn shut_jaws_touch() {
    let jaws = JawSize::of(&tool(ToolKind::Grasper));
    for part in ToolShape::of(&tool(ToolKind::Grasper)).parts() {
        if let Motion::Turned { side } = part.motion {
            let below = part.corners.iter().map(place);
            let below = below.filter(|place| place.z < 0.7 * jaws.length);
            let least = below
                .map(|place| side * place.x)
                .fold(f64::INFINITY, f64::min);
            assert!((0.0..1e-4).contains(&least), "{side}: {least}");
        }
    }
}

/// A tool whose trocar is nearer or farther is the same: nothing is made anew while it moves.
#[test]
fn a_way_through_the_trocar_makes_nothing_anew() {
    let tool = tool(ToolKind::Scissors);
    let at = |z: f64| ToolPicture::new(&tool, [0.0, 0.0, z], [0.0, 0.0, 0.0, 1.0]);
    assert_eq!(at(0.0).shape, at(0.03).shape);
    assert_ne!(at(0.0), at(0.03));
}
