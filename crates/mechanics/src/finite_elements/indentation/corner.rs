use super::super::element::ElementKind;
use super::super::graded::{Grading, resampled};
use super::super::mesh::ElementMesh;
use super::super::surface::Surface;
use super::indenter::Indenter;
use super::mesh::Block;
use crate::Vec3;

fn env(name: &str, default: f64) -> f64 {
    std::env::var(name).ok().and_then(|s| s.parse().ok()).unwrap_or(default)
}

/// Elements around the edge of a flat punch in rings that shrink towards it.
pub(super) fn corner_block(block: &Block, indenter: &Indenter, parts: usize) -> ElementMesh {
    let radius = indenter.radius;
    let wide = env("WIDE", 0.25) * radius;
    let rings = env("RINGS", 8.0);
    let shrink = env("SHRINK", 0.5);
    let base = env("BASE", 2.0);
    let fine = parts as f64 / base;
    let widths: Vec<f64> = (0..=rings as usize).map(|k| wide * shrink.powi(k as i32)).collect();
    let widths = resampled(&widths, fine);
    let grading = |growth: f64| Grading {
        first: wide / base * growth,
        growth,
        near: env("NEAR", 3.0) * radius,
        far_growth: env("FAR", 1.7),
    };
    let line = |length: f64, growth: f64| resampled(&grading(growth).line(length, 0), fine);
    let outer_line = Grading { near: env("NEAROUT", 3.0) * radius, ..grading(env("GOUT", 1.25)) };
    let inward = line(radius - wide, env("GIN", 1.25));
    let outward = resampled(&outer_line.line(block.radius - radius - wide, 0), fine);
    let down = line(block.height - wide, env("GDOWN", 1.25));
    let even = |from: f64, to: f64, count: usize| -> Vec<f64> {
        (0..=count)
            .map(|i| from + (to - from) * i as f64 / count as f64)
            .collect()
    };
    let mut inner: Vec<f64> = inward.iter().rev().map(|x| radius - wide - x).collect();
    inner[0] = 0.0;
    let outer: Vec<f64> = outward.iter().map(|x| radius + wide + x).collect();
    let middle = even(radius - wide, radius + wide, 2 * parts);
    let upper = even(-wide, 0.0, parts);
    let mut lower: Vec<f64> = down.iter().rev().map(|z| -wide - z).collect();
    lower[0] = -block.height;
    let mut surface = Surface::new(1e-9 * radius);
    let flat = |r: f64, z: f64| [r, z];
    for columns in [&inner, &middle, &outer] {
        surface.add(columns, &lower, flat);
    }
    surface.add(&inner, &upper, flat);
    surface.add(&outer, &upper, flat);
    let narrow: Vec<f64> = widths.iter().rev().copied().collect();
    let shrinking: Vec<f64> = widths.iter().map(|x| -x).collect();
    let side = even(-1.0, 0.0, parts);
    let around = even(-1.0, 1.0, 2 * parts);
    surface.add(&narrow, &side, |x, m| [radius + x, x * m]);
    surface.add(&shrinking, &side, |y, m| [radius + y, -y * m]);
    surface.add(&around, &shrinking, |u, y| [radius - u * y, y]);
    let least = narrow[0];
    let inside = even(radius - least, radius + least, 2 * parts);
    let size = least / parts as f64;
    let quarter = env("QUARTER", 1.0) > 0.0;
    surface.add(&inside, &even(-least, 0.0, parts), |r, z| {
        let [p, q] = [(r - radius) / size, -z / size];
        let near = |x: f64| (2.0 * x).round() / 2.0;
        let moved = match (near(p.abs()), near(q)) {
            (0.5, 0.0) => [0.25, 0.0],
            (0.0, 0.5) => [0.0, 0.25],
            (0.5, 0.5) => [0.375, 0.375],
            _ => return [r, z],
        };
        if !quarter { return [r, z]; }
        [radius + p.signum() * moved[0] * size, -moved[1] * size]
    });
    ElementMesh {
        kind: ElementKind::Quad9,
        nodes: surface
            .points
            .iter()
            .map(|&[r, z]| Vec3::new(r, z, 0.0))
            .collect(),
        elements: surface.faces.into_iter().flatten().collect(),
    }
}
