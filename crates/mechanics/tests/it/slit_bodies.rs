//! Bodies with a slit, as tables and as finite elements.

use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::ControlFlow;

use nalgebra::Rotation3;
use palpate_geometry::{AabbTree, TriangleId};
use palpate_mechanics::Vec3;
use palpate_mechanics::finite_elements::condensed::CondensedProblem;
use palpate_mechanics::surface_response::slit::{CutBody, DiscForce, Slit, SlitFacet};
use palpate_mechanics::surface_response::{SurfaceResponse, TipField};

use crate::boundary_response::Held;
use crate::slit_judge::{Cut, CutShape, Grid, Square, mirrored};

pub(crate) const MM: f64 = 1e-3;

pub(crate) fn mm(lines: &[f64]) -> Vec<f64> {
    lines.iter().map(|x| x * MM).collect()
}

pub(crate) fn square(x: [f64; 2], y: [f64; 2]) -> Square {
    Square {
        low: [x[0] * MM, y[0] * MM],
        high: [x[1] * MM, y[1] * MM],
    }
}

pub(crate) const NU: f64 = 0.45;

/// A block of 40 x 40 x 20 mm.
pub(crate) fn block() -> Grid {
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

pub(crate) fn plate() -> Grid {
    let z = [-2.5, -2.1, -1.7, -1.25, -0.85, -0.4, 0.0];
    Grid {
        lines: [block().lines[0].clone(), block().lines[1].clone(), mm(&z)],
        ..block()
    }
}

pub(crate) fn tube() -> Grid {
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

pub(crate) fn squares() -> [Square; 4] {
    [
        square([0.0, 2.5], [-1.25, 1.25]),
        square([0.0, 2.5], [4.75, 7.25]),
        square([6.0, 8.5], [-1.25, 1.25]),
        square([3.75, 6.0], [-1.25, 1.25]),
    ]
}

/// How a body answers, by its table.
pub(crate) struct Table {
    pub(crate) solid: Held,
    pub(crate) tree: AabbTree,
    pub(crate) response: SurfaceResponse<f32>,
    pub(crate) tips: TipField,
    pub(crate) grid: Grid,
}

pub(crate) const RADIUS: f64 = 1.41e-3;

impl Table {
    pub(crate) fn new(grid: Grid, holds: impl Fn(&Vec3) -> bool, edge: Option<f64>) -> Self {
        Self::touchable_within(grid, holds, edge, 14.0 * MM)
    }

    /// As [`Self::new`]; triangles nearer than `within` [m] to the middle of the slit can be touched, in a tube
    /// nearer along it.
    pub(crate) fn touchable_within(
        grid: Grid,
        holds: impl Fn(&Vec3) -> bool,
        edge: Option<f64>,
        within: f64,
    ) -> Self {
        let solid = Held::new(grid.surface(), grid.poissons_ratio, holds);
        let near = |id: &TriangleId| {
            let c = solid.centroid(*id);
            let off = match grid.around {
                None => (c.x.powi(2) + c.y.powi(2)).sqrt(),
                Some(_) => c.y.abs(),
            };
            off < within && (edge.is_some() || c.z > -MM)
        };
        let touchable: Vec<_> = solid.free.iter().copied().filter(near).collect();
        let response = match edge {
            None => solid.response::<f32>(&touchable),
            Some(edge) => CondensedProblem {
                surface: &solid.surface,
                poissons_ratio: grid.poissons_ratio,
                fixed: &solid.held,
                touchable: &touchable,
                edge,
                regions: None,
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
            tips: TipField::new(&response, &solid.surface, RADIUS).unwrap(),
            solid,
            response,
            grid,
        }
    }

    pub(crate) fn cut(&self, cut: &Cut, facets: usize) -> Slit {
        let mut slit = Slit::new(&self.response, facets);
        let body = CutBody {
            surface: &self.solid.surface,
            tree: &self.tree,
            response: &self.response,
        };
        let sides = match cut.shape {
            CutShape::Straight => 1,
            CutShape::Square => 4,
        };
        let length = sides as f64 * cut.length / facets as f64;
        for k in 0..facets {
            let (side, number) = (k * sides / facets, k % (facets / sides));
            let turn = Rotation3::from_axis_angle(&Vec3::z_axis(), FRAC_PI_2 * side as f64);
            let aside = if sides == 1 { 0.0 } else { 0.5 * cut.length };
            let along = (number as f64 + 0.5) * length - 0.5 * cut.length;
            let facet = SlitFacet {
                middle: self.grid.place(&(turn * Vec3::new(aside, along, 0.0))),
                along: turn * Vec3::y(),
                normal: Vec3::z(),
                length,
                depth: cut.depth,
            };
            slit.open(&body, &facet).unwrap();
        }
        slit
    }

    /// Compliance of a square uncut, and what the slit adds, along the normal and across.
    pub(crate) fn felt(&self, slit: &Slit, square: &Square) -> [[f64; 3]; 2] {
        let [x, y] = square.middle();
        let at = Vec3::new(x, y, 0.0);
        let place = self.grid.place(&at);
        let axes = self.grid.axes(&at);
        let found = self.tree.nearest(self.solid.surface.mesh(), &place);
        let tip = self
            .tips
            .at(&self.solid.surface, found.triangle, &found.on.barycentric);
        let (a, nu) = (square.radius(), self.grid.poissons_ratio);
        let mean = 16.0 / (3.0 * PI * PI * a) * (1.0 + nu);
        let further = tip.structural_compliance();
        let aside = mean * (1.0 - 0.5 * nu);
        let own = [mean * (1.0 - nu), aside, aside];
        let spot = DiscForce {
            place,
            normal: axes[0],
            radius: a,
        };
        let mut load = slit.load();
        slit.put(&self.response, tip.shares(), Some(&spot), &mut load);
        let more = slit.added_compliance(&load);
        [
            [0, 1, 2].map(|k| own[k] + axes[k].dot(&(further * axes[k]))),
            [0, 1, 2].map(|k| axes[k].dot(&(more * axes[k]))),
        ]
    }
}

pub(crate) fn lines(step: f64, fine: f64, coarse: f64, end: f64) -> Vec<f64> {
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

/// A body of the judge, what holds it, and how it is cut.
pub(crate) struct Judged {
    pub(crate) name: &'static str,
    pub(crate) grid: Grid,
    pub(crate) holds: fn(&Vec3) -> bool,
    /// Length and depth of the slits [mm].
    pub(crate) cuts: &'static [[f64; 2]],
}

pub(crate) fn slit_of([length, depth]: [f64; 2]) -> Cut {
    Cut {
        length: length * MM,
        depth: depth * MM,
        shape: CutShape::Straight,
    }
}

pub(crate) fn on_bottom(at: &Vec3) -> bool {
    at.z < -19.99 * MM
}

pub(crate) fn at_borders(at: &Vec3) -> bool {
    at.x.abs().max(at.y.abs()) > 19.99 * MM
}

pub(crate) fn at_ends(at: &Vec3) -> bool {
    at.y.abs() > 19.99 * MM
}

impl Judged {
    /// Compliances of the squares uncut, and cut to each depth, by finite elements.
    pub(crate) fn compliances(&self, squares: &[Square]) -> Vec<Vec<[f64; 3]>> {
        let cuts = self.cuts.iter().map(|cut| slit_of(*cut));
        std::iter::once(None)
            .chain(cuts.map(Some))
            .map(|cut| self.grid.compliances(cut, self.holds, squares))
            .collect()
    }

    /// The stiffness of each square, cut over uncut, by the table and by finite elements.
    pub(crate) fn ratios(
        &self,
        table: &Table,
        squares: &[Square],
        judge: &[Vec<[f64; 3]>],
    ) -> Vec<Ratio> {
        let mut ratios = Vec::new();
        for (&cut, of_cut) in self.cuts.iter().zip(&judge[1..]) {
            let slit = table.cut(&slit_of(cut), 8);
            for (k, square) in squares.iter().enumerate() {
                let [own, more] = table.felt(&slit, square);
                ratios.extend([0, 1, 2].map(|axis| Ratio {
                    cut,
                    square: k,
                    axis,
                    uncut: [own[axis], judge[0][k][axis]],
                    found: own[axis] / (own[axis] + more[axis]),
                    expected: judge[0][k][axis] / of_cut[k][axis],
                }));
            }
        }
        for ratio in &ratios {
            println!("{}: {ratio}", self.name);
        }
        ratios
    }

    /// How far the stiffness of each square, cut over uncut, is off that of finite elements [-]; the largest.
    pub(crate) fn off(&self, table: &Table, squares: &[Square], judge: &[Vec<[f64; 3]>]) -> f64 {
        let ratios = self.ratios(table, squares, judge);
        ratios
            .iter()
            .map(|ratio| ratio.off().abs())
            .fold(0.0, f64::max)
    }
}

/// Stiffness of a square in one direction, cut over uncut.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ratio {
    /// Length and depth of the slit [mm].
    pub(crate) cut: [f64; 2],
    /// Number of the square.
    square: usize,
    /// 0 along the normal, 1 across the slit, 2 along it.
    axis: usize,
    /// Compliance uncut, times E [1/m], by the table and by finite elements.
    uncut: [f64; 2],
    /// By the table [-].
    found: f64,
    /// By finite elements [-].
    expected: f64,
}

impl Ratio {
    /// Relative error of the stiffness of the cut body [-].
    pub(crate) fn off(&self) -> f64 {
        self.found / self.expected - 1.0
    }

    /// As columns of `docs/theory/cutting.md`: ours over the judge's, of the stiffness cut over uncut, of that of the
    /// uncut body, and of that of the cut one.
    pub(crate) fn in_columns(&self) -> String {
        let ([length, depth], [own, judge]) = (self.cut, self.uncut);
        let (ratio, uncut) = (1.0 + self.off(), judge / own);
        format!(
            "{length} × {depth} mm | {} | {} | {:.3} / {:.3} = {ratio:.2} | {uncut:.2} | {:.2}",
            self.square,
            DIRECTIONS[self.axis],
            self.found,
            self.expected,
            ratio * uncut
        )
    }
}

const DIRECTIONS: [&str; 3] = ["normal", "across", "along"];

impl std::fmt::Display for Ratio {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [length, depth] = self.cut;
        write!(
            f,
            "{length} x {depth} mm, square {} {}: uncut {:.0} ({:.0}), ratio {:.3} ({:.3}) {:+.1} %",
            self.square,
            DIRECTIONS[self.axis],
            self.uncut[0],
            self.uncut[1],
            self.found,
            self.expected,
            100.0 * self.off()
        )
    }
}

/// A table of the block on squares of `step` [mm] around the slit.
pub(crate) fn block_grid(step: f64) -> Grid {
    let fine = lines(step, 9.0, 5.0, 20.0);
    let z = mm(&[-20.0, -15.0, -10.0, -6.0, -3.0, 0.0]);
    Grid {
        lines: [fine.clone(), fine, z],
        ..block()
    }
}

pub(crate) fn block_table(step: f64) -> Table {
    Table::new(block_grid(step), on_bottom, None)
}

pub(crate) fn plate_table(step: f64) -> Table {
    let fine = lines(step, 9.0, 4.0, 20.0);
    let grid = Grid {
        lines: [fine.clone(), fine, mm(&[-2.5, -1.25, 0.0])],
        ..block()
    };
    Table::new(grid, at_borders, Some(1.75 * MM))
}

pub(crate) fn tube_grid(around: usize) -> Grid {
    let half = around / 2;
    let step = PI * 7.5 / half as f64;
    let x: Vec<f64> = (1..=half).map(|k| step * k as f64).collect();
    let y = lines(step, 9.0, 3.0, 20.0);
    Grid {
        lines: [mirrored(&mm(&x)), y, mm(&[-2.5, -1.25, 0.0])],
        ..tube()
    }
}

pub(crate) fn tube_table(around: usize) -> Table {
    Table::new(tube_grid(around), at_ends, Some(1.75 * MM))
}
