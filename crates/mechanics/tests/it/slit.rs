//! The mechanics of a cut.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use nalgebra::Matrix3;
use palpate_geometry::{AabbTree, Organ, TriangleId};
use palpate_mechanics::Vec3;
use palpate_mechanics::finite_elements::condensed::CondensedProblem;
use palpate_mechanics::surface_response::slit::{CutBody, Slit, SlitFacet, SlitLoad, Spot};
use palpate_mechanics::surface_response::{Share, SurfaceResponse, TipField, TouchId};

use crate::boundary_response::Held;
use crate::contacts::{Random, tries};
use crate::slit_judge::{Cut, Grid, Square, mirrored};

const MM: f64 = 1e-3;

fn mm(lines: &[f64]) -> Vec<f64> {
    lines.iter().map(|x| x * MM).collect()
}

fn square(x: [f64; 2], y: [f64; 2]) -> Square {
    Square {
        low: [x[0] * MM, y[0] * MM],
        high: [x[1] * MM, y[1] * MM],
    }
}

const NU: f64 = 0.45;

/// A block of 40 x 40 x 20 mm.
fn block() -> Grid {
    let x = [0.625, 1.25, 2.5, 3.75, 6.0, 7.25, 8.5, 11.5, 15.0, 20.0];
    let y = [
        0.625, 1.25, 2.5, 3.625, 4.75, 5.375, 6.0, 6.625, 7.25, 9.0, 13.0, 20.0,
    ];
    let z = [
        -20.0, -14.0, -9.0, -6.0, -4.5, -3.6, -3.0, -2.4, -1.7, -1.0, -0.5, 0.0,
    ];
    Grid {
        lines: [mirrored(&mm(&x)), mirrored(&mm(&y)), mm(&z)],
        around: None,
        poissons_ratio: NU,
    }
}

fn plate() -> Grid {
    let z = [-2.5, -2.1, -1.7, -1.25, -0.85, -0.4, 0.0];
    Grid {
        lines: [block().lines[0].clone(), block().lines[1].clone(), mm(&z)],
        ..block()
    }
}

fn tube() -> Grid {
    let half = std::f64::consts::PI * 7.5;
    let x = [
        0.625, 1.25, 2.5, 3.75, 6.0, 7.25, 8.5, 11.5, 15.0, 19.0, half,
    ];
    let y = [
        0.625, 1.25, 2.5, 3.625, 4.75, 5.375, 6.0, 6.625, 7.25, 9.0, 13.0, 20.0,
    ];
    Grid {
        lines: [
            mirrored(&mm(&x)),
            mirrored(&mm(&y)),
            plate().lines[2].clone(),
        ],
        around: Some(7.5 * MM),
        poissons_ratio: NU,
    }
}

fn squares() -> [Square; 4] {
    [
        square([0.0, 2.5], [-1.25, 1.25]),
        square([0.0, 2.5], [4.75, 7.25]),
        square([6.0, 8.5], [-1.25, 1.25]),
        square([3.75, 6.0], [-1.25, 1.25]),
    ]
}

/// How a body answers, by its table.
struct Table {
    solid: Held,
    tree: AabbTree,
    response: SurfaceResponse<f32>,
    tips: TipField,
    grid: Grid,
}

const RADIUS: f64 = 1.41e-3;

impl Table {
    fn new(grid: Grid, holds: impl Fn(&Vec3) -> bool, edge: Option<f64>) -> Self {
        let solid = Held::new(grid.surface(), NU, holds);
        let near = |id: &TriangleId| {
            let c = solid.centroid(*id);
            let off = match grid.around {
                None => (c.x.powi(2) + c.y.powi(2)).sqrt(),
                Some(_) => c.y.abs(),
            };
            off < 14.0 * MM && (edge.is_some() || c.z > -1.0 * MM)
        };
        let touchable: Vec<_> = solid.free.iter().copied().filter(near).collect();
        let response = match edge {
            None => solid.response::<f32>(&touchable),
            Some(edge) => CondensedProblem {
                surface: &solid.surface,
                poissons_ratio: NU,
                held: &solid.held,
                touchable: &touchable,
                edge,
            }
            .solve(usize::MAX, &mut |_| ControlFlow::Continue(()))
            .unwrap(),
        };
        println!(
            "{} triangles, {} touchable",
            solid.surface.mesh().triangles().len(),
            touchable.len()
        );
        Self {
            tree: AabbTree::new(solid.surface.mesh()),
            tips: TipField::new(&response, &solid.surface, RADIUS),
            solid,
            response,
            grid,
        }
    }

    fn cut(&self, depth: f64, facets: usize) -> Slit {
        let mut slit = Slit::new(&self.response, facets);
        let body = CutBody {
            surface: &self.solid.surface,
            tree: &self.tree,
            response: &self.response,
        };
        let length = 12.0 * MM / facets as f64;
        for k in 0..facets {
            let middle = Vec3::new(0.0, (k as f64 + 0.5) * length - 6.0 * MM, 0.0);
            let facet = SlitFacet {
                middle: self.grid.place(&middle),
                along: Vec3::y(),
                normal: Vec3::z(),
                length,
                depth,
            };
            slit.open(&body, &facet).unwrap();
        }
        slit
    }

    /// Compliance of a square uncut, and what the slit adds, along the normal and across.
    fn felt(&self, slit: &Slit, square: &Square) -> [[f64; 2]; 2] {
        let [x, y] = square.middle();
        let at = Vec3::new(x, y, 0.0);
        let place = self.grid.place(&at);
        let axes = self.grid.axes(&at);
        let found = self.tree.nearest(self.solid.surface.mesh(), &place);
        let tip = self
            .tips
            .at(&self.solid.surface, found.triangle, &found.on.barycentric);
        let a = square.radius();
        let mean = 16.0 / (3.0 * PI * PI * a) * (1.0 + NU);
        let further = tip.further_compliance();
        let own = [mean * (1.0 - NU), mean * (1.0 - 0.5 * NU)];
        let spot = Spot {
            place,
            normal: axes[0],
            radius: a,
        };
        let mut load = slit.load();
        slit.put(&self.response, (tip.shares(), Some(&spot)), &mut load);
        let more = slit.further(&load);
        [
            [0, 1].map(|k| own[k] + axes[k].dot(&(further * axes[k]))),
            [0, 1].map(|k| axes[k].dot(&(more * axes[k]))),
        ]
    }
}

/// Uncut compliances and what a slit adds, by finite elements.
type Judged = ([[f64; 2]; 4], Vec<(f64, [[f64; 2]; 4])>);

fn judged(name: &str) -> Judged {
    let (whole, cuts) = match name {
        "block" => (
            [
                [287.19, 434.01],
                [288.59, 436.59],
                [290.79, 440.61],
                [315.22, 451.74],
            ],
            vec![(
                3.0,
                [
                    [117.03, 359.27],
                    [28.60, 93.95],
                    [0.08, 12.12],
                    [1.12, 33.36],
                ],
            )],
        ),
        "plate" => (
            [
                [5557.98, 612.60],
                [4690.78, 603.84],
                [4392.14, 586.84],
                [5085.11, 617.77],
            ],
            vec![
                (
                    2.5,
                    [
                        [4985.59, 723.43],
                        [1460.63, 146.30],
                        [424.66, 81.29],
                        [1111.96, 172.75],
                    ],
                ),
                (
                    1.25,
                    [
                        [1118.05, 378.46],
                        [460.46, 101.61],
                        [83.58, 29.02],
                        [231.56, 64.27],
                    ],
                ),
            ],
        ),
        _ => (
            [
                [1319.57, 1442.35],
                [1234.02, 1312.29],
                [1318.31, 1455.04],
                [1356.70, 1445.26],
            ],
            vec![
                (
                    2.5,
                    [
                        [2693.46, 1738.28],
                        [343.50, 230.06],
                        [318.49, 90.57],
                        [675.05, 286.23],
                    ],
                ),
                (
                    1.25,
                    [
                        [407.91, 353.74],
                        [117.40, 91.14],
                        [4.59, 5.91],
                        [13.69, 15.84],
                    ],
                ),
            ],
        ),
    };
    (whole, cuts)
}

fn lines(step: f64, fine: f64, coarse: f64, end: f64) -> Vec<f64> {
    let mut lines = Vec::new();
    let mut at = 0.0;
    while at < fine - 1e-9 {
        at += step;
        lines.push(at);
    }
    let rest = ((end - at) / coarse).ceil();
    for k in 1..=rest as usize {
        lines.push(at + (end - at) * k as f64 / rest);
    }
    mirrored(&mm(&lines))
}

fn compare(name: &str, table: &Table) {
    let (whole, cuts) = judged(name);
    for (depth, more) in cuts {
        for facets in [8] {
            let slit = table.cut(depth * MM, facets);
            println!("{name} {depth} in {facets} facets");
            for (k, square) in squares().iter().enumerate() {
                let [own, found] = table.felt(&slit, square);
                for axis in 0..2 {
                    let ratio = own[axis] / (own[axis] + found[axis]);
                    let expected = whole[k][axis] / (whole[k][axis] + more[k][axis]);
                    println!(
                        "  {k} {}: uncut {:6.1} ({:6.1}) more {:6.1} ({:6.1}) ratio {ratio:.3} ({expected:.3}) {:+.1} %",
                        ["normal", "across"][axis],
                        own[axis],
                        whole[k][axis],
                        found[axis],
                        more[k][axis],
                        100.0 * (ratio / expected - 1.0)
                    );
                }
            }
        }
    }
}

#[test]
#[ignore = "compare"]
fn compare_block() {
    for step in [2.0, 3.0] {
        let fine = lines(step, 9.0, 5.0, 20.0);
        let z = mm(&[-20.0, -15.0, -10.0, -6.0, -3.0, 0.0]);
        let grid = Grid {
            lines: [fine.clone(), fine, z],
            ..block()
        };
        let table = Table::new(grid, |at| at.z < -19.99 * MM, None);
        compare("block", &table);
    }
}

#[test]
#[ignore = "compare"]
fn compare_plate() {
    for step in [2.0, 3.0] {
        let fine = lines(step, 9.0, 4.0, 20.0);
        let z = mm(&[-2.5, -1.25, 0.0]);
        let grid = Grid {
            lines: [fine.clone(), fine, z],
            ..block()
        };
        let table = Table::new(
            grid,
            |at| at.x.abs() > 19.99 * MM || at.y.abs() > 19.99 * MM,
            Some(1.75 * MM),
        );
        compare("plate", &table);
    }
}

#[test]
#[ignore = "compare"]
fn compare_tube() {
    for around in [36, 24] {
        let half = std::f64::consts::PI * 7.5;
        let x: Vec<f64> = (1..=around / 2)
            .map(|k| half * k as f64 / (around / 2) as f64)
            .collect();
        let step = 2.0 * half / around as f64;
        let y = lines(step, 9.0, 3.0, 20.0);
        let z = mm(&[-2.5, -1.25, 0.0]);
        let grid = Grid {
            lines: [mirrored(&mm(&x)), y, z],
            ..tube()
        };
        let table = Table::new(grid, |at| at.y.abs() > 19.99 * MM, Some(1.75 * MM));
        compare("tube", &table);
    }
}

#[test]
#[ignore = "quarter"]
fn quarter() {
    for nu in [0.45, 0.3] {
        let x = [
            0.3125, 0.625, 0.9375, 1.25, 1.875, 2.5, 3.125, 3.75, 6.0, 10.0, 20.0,
        ];
        let y = [0.3125, 0.625, 1.25, 2.5, 5.0, 10.0, 16.0, 20.0];
        let z = [
            -20.0, -15.0, -10.0, -7.0, -4.5, -3.0, -2.0, -1.2, -0.6, -0.3, 0.0,
        ];
        let grid = Grid {
            lines: [mirrored(&mm(&x)), mirrored(&mm(&y)), mm(&z)],
            around: None,
            poissons_ratio: nu,
        };
        let holds = |at: &Vec3| at.z < -19.99 * MM;
        let squares = [0.0, 0.625, 1.25, 2.5].map(|x| square([x, x + 1.25], [-0.625, 0.625]));
        let whole = grid.compliances(None, holds, &squares);
        let cut = Cut {
            length: 40.1 * MM,
            depth: 15.0 * MM,
        };
        let cut = grid.compliances(Some(cut), holds, &squares);
        let more: Vec<_> = cut
            .iter()
            .zip(&whole)
            .map(|(c, w)| [c[0] - w[0], c[1] - w[1]])
            .collect();
        println!("{nu} {whole:.1?} {more:.1?}");
    }
}

#[test]
#[ignore = "judge"]
fn judge() {
    for (name, grid, depths) in [
        ("block", block(), vec![3.0]),
        ("plate", plate(), vec![2.5, 1.25]),
        ("tube", tube(), vec![2.5, 1.25]),
    ] {
        let holds = |at: &palpate_mechanics::Vec3| match name {
            "block" => at.z < -19.99 * MM,
            "plate" => at.x.abs() > 19.99 * MM || at.y.abs() > 19.99 * MM,
            _ => at.y.abs() > 19.99 * MM,
        };
        let whole = grid.compliances(None, holds, &squares());
        println!("{name} whole {whole:.2?}");
        for depth in depths {
            let cut = Cut {
                length: 12.0 * MM,
                depth: depth * MM,
            };
            let cut = grid.compliances(Some(cut), holds, &squares());
            println!("{name} cut {depth} {cut:.2?}");
            let more: Vec<_> = cut
                .iter()
                .zip(&whole)
                .map(|(c, w)| [c[0] - w[0], c[1] - w[1]])
                .collect();
            println!("{name} cut {depth} more {more:.2?}");
        }
    }
}

/// A kidney by boundary elements, and what is needed to cut it.
struct Kidney {
    solid: Held,
    tree: AabbTree,
    response: SurfaceResponse<f32>,
}

impl Kidney {
    fn new() -> Self {
        let solid = Held::organ(Organ::Kidney, 400, NU);
        Self {
            tree: AabbTree::new(solid.surface.mesh()),
            response: solid.response::<f32>(&solid.free),
            solid,
        }
    }

    fn body(&self) -> CutBody<'_, f32> {
        CutBody {
            surface: &self.solid.surface,
            tree: &self.tree,
            response: &self.response,
        }
    }

    /// A facet on the `number`-th triangle.
    fn facet(&self, number: usize, random: &mut Random) -> SlitFacet {
        let triangle = self.solid.free[number % self.solid.free.len()];
        let normal = self.solid.surface.mesh().area_vector(triangle).normalize();
        SlitFacet {
            middle: self.solid.centroid(triangle),
            along: random.vector(),
            normal,
            length: 1e-3 + 6e-3 * random.unit(),
            depth: 1e-3 + 0.06 * random.unit().powi(3),
        }
    }

    fn load(&self, slit: &Slit, touch: u32) -> SlitLoad {
        let mut load = slit.load();
        let share = Share {
            triangle: TouchId(touch),
            weight: 1.0,
        };
        slit.put(&self.response, ([share].into_iter(), None), &mut load);
        load
    }
}

/// Judge: an elastic body that is cut further yields more. Facets anywhere in any direction, upon one another too.
#[test]
fn random_slits_never_break() {
    let kidney = Kidney::new();
    let mut random = Random(5);
    for round in 0..tries(60) {
        let mut slit = Slit::new(&kidney.response, 24);
        let spread = 1 + round % 7 * 20;
        let start = (random.unit() * 300.0) as usize;
        let mut before = [Matrix3::zeros(); 8];
        for _ in 0..24 {
            let number = start + (random.unit() * spread as f64) as usize;
            slit.open(&kidney.body(), &kidney.facet(number, &mut random))
                .unwrap();
            for (touch, before) in (0..8).map(|k| 35 * k).zip(&mut before) {
                let load = kidney.load(&slit, touch);
                let now = slit.further(&load);
                assert!(now.iter().all(|x| x.is_finite()));
                let least = (now - *before).symmetric_eigenvalues().min();
                let whole = kidney
                    .response
                    .compliance(TouchId(touch), TouchId(touch))
                    .norm();
                assert!(
                    least > -1e-9 * whole,
                    "{least} of {whole}, {round} {} {now} {before}",
                    slit.facets()
                );
                *before = now;
            }
        }
    }
}
