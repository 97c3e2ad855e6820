//! The mechanics of a cut.

use assert_no_alloc::{assert_no_alloc, violation_count};
use nalgebra::Matrix3;
use palpate_geometry::{AabbTree, Organ};
use palpate_mechanics::surface_response::slit::{
    CutBody, DiscForce, RIM_COMPLIANCE, Slit, SlitFacet, SlitLoad,
};
use palpate_mechanics::surface_response::{Share, SurfaceResponse, TouchId};
use palpate_mechanics::{Error, Vec3};

use crate::boundary_response::Held;
use crate::contacts::{Random, tries};
use crate::slit_bodies::{
    Judged, MM, NU, Table, at_borders, at_ends, block, block_grid, block_table, mm, on_bottom,
    plate, plate_table, slit_of, square, squares, tube, tube_grid, tube_table,
};
use crate::slit_judge::{Grid, mirrored};

/// Judge: finite elements whose nodes on the slit are doubled. Tolerance: what is asked of the rim.
#[test]
#[ignore = "slow: ten minutes"]
fn the_rim_is_that_of_finite_elements() {
    let bodies = [
        Judged {
            name: "block",
            grid: block(),
            holds: on_bottom,
            cuts: &[[12.0, 3.0]],
        },
        Judged {
            name: "plate",
            grid: plate(),
            holds: at_borders,
            cuts: &[[12.0, 2.5], [12.0, 1.25]],
        },
        Judged {
            name: "tube",
            grid: tube(),
            holds: at_ends,
            cuts: &[[12.0, 2.5], [12.0, 1.25]],
        },
    ];
    for body in bodies {
        let judge = body.compliances(&squares());
        let tables: [fn() -> Table; 2] = match body.name {
            "block" => [|| block_table(2.0), || block_table(3.0)],
            "plate" => [|| plate_table(2.0), || plate_table(3.0)],
            _ => [|| tube_table(36), || tube_table(24)],
        };
        for table in tables {
            let off = body.off(&table(), &squares(), &judge);
            assert!(off < 0.25, "{}: {off}", body.name);
        }
    }
}

/// What no constant was looked at with: other lengths, depths and another ν. Judge and tolerance: as above.
#[test]
#[ignore = "slow: five minutes"]
fn other_slits_are_those_of_finite_elements() {
    let lines = |grid: Grid| {
        let z = [-2.5, -2.1, -1.6, -1.25, -0.8, -0.4, 0.0];
        let wall = grid.lines[2].len() == z.len();
        let [x, _, own] = grid.lines;
        let y = [
            0.625, 1.25, 2.5, 3.5, 4.25, 5.0, 6.25, 7.75, 9.0, 10.25, 13.0, 20.0,
        ];
        Grid {
            lines: [x, mirrored(&mm(&y)), if wall { mm(&z) } else { own }],
            around: grid.around,
            poissons_ratio: 0.3,
        }
    };
    let block = Judged {
        name: "block",
        grid: lines(block()),
        holds: on_bottom,
        cuts: &[[8.5, 1.7], [18.0, 4.5]],
    };
    let tube = Judged {
        name: "tube",
        grid: lines(tube()),
        holds: at_ends,
        cuts: &[[18.0, 2.5], [8.5, 2.5], [18.0, 1.6]],
    };
    let squares = [squares()[0], squares()[2], squares()[3]];
    for body in [block, tube] {
        let judge = body.compliances(&squares);
        let mut table = match body.name {
            "block" => block_grid(2.5),
            _ => tube_grid(28),
        };
        table.poissons_ratio = 0.3;
        let edge = (body.name == "tube").then_some(1.75 * MM);
        let off = body.off(&Table::new(table, body.holds, edge), &squares, &judge);
        assert!(off < 0.25, "{}: {off}", body.name);
    }
}

/// Judge: finite elements of a block that is cut through most of its depth. What a square beside the slit yields
/// more goes with the reciprocal of its distance, of which the mechanics make use. What the block's end and bottom add
/// is nearly the same at both places, and not in their difference. Tolerance: a fifth, for the next term is of the
/// order of distance over depth, 0.13, and the lines of the grid are 0.3 mm apart.
#[test]
#[ignore = "slow: three minutes"]
fn a_rim_yields_with_the_reciprocal_of_the_distance() {
    for nu in [0.45, 0.3] {
        let x = [
            0.3125, 0.625, 0.9375, 1.25, 1.875, 2.5, 3.125, 3.75, 6.0, 10.0, 20.0,
        ];
        let y = [0.3125, 0.625, 1.25, 2.5, 5.0, 10.0, 16.0, 20.0];
        let z = [
            -20.0, -15.0, -10.0, -7.0, -4.5, -3.0, -2.0, -1.2, -0.6, -0.3, 0.0,
        ];
        let body = Judged {
            name: "block",
            grid: Grid {
                lines: [mirrored(&mm(&x)), mirrored(&mm(&y)), mm(&z)],
                around: None,
                poissons_ratio: nu,
            },
            holds: on_bottom,
            cuts: &[[40.1, 15.0]],
        };
        let squares = [0.625, 1.25].map(|x| square([x, x + 1.25], [-0.625, 0.625]));
        let found = body.compliances(&squares);
        let more = [0, 1].map(|k| [1, 2, 0].map(|axis| found[1][k][axis] - found[0][k][axis]));
        let [near, far] = squares.each_ref().map(|square| 1.0 / square.middle()[0]);
        for ((axis, expected), name) in RIM_COMPLIANCE
            .iter()
            .enumerate()
            .zip(["across", "along", "outward"])
        {
            let slope = (more[0][axis] - more[1][axis]) / (near - far);
            println!("nu {nu}, {name}: {slope:.3}, taken {expected}");
            assert!(
                (expected / slope - 1.0).abs() < 0.2,
                "{name}: {slope} {expected}"
            );
        }
    }
}

/// Judge: as above, on a coarser grid, whose slit opens some percent less. Tolerances: what is asked; and two
/// meshes of which no line is the other's agree in a tenth of the stiffness.
#[test]
#[ignore = "long"]
fn the_rim_of_a_block_is_that_of_finite_elements() {
    let x = [1.25, 2.5, 5.0, 6.0, 8.5, 13.0, 20.0];
    let y = [1.25, 3.0, 4.75, 7.25, 11.0, 20.0];
    let z = [-20.0, -12.0, -6.5, -4.0, -3.0, -2.0, -1.0, 0.0];
    let grid = Grid {
        lines: [mirrored(&mm(&x)), mirrored(&mm(&y)), mm(&z)],
        ..block()
    };
    let mut body = Judged {
        name: "block",
        grid,
        holds: on_bottom,
        cuts: &[[12.0, 3.0]],
    };
    // The slit ends on lines of the grid.
    body.grid.lines[1] = mirrored(&mm(&[1.25, 3.0, 4.75, 6.0, 7.25, 11.0, 20.0]));
    let squares = &squares()[..3];
    let judge = body.compliances(squares);
    let tables = [3.0, 2.25].map(block_table);
    for table in &tables {
        let off = body.off(table, squares, &judge);
        assert!(off < 0.25, "{off}");
    }
    let slits = tables
        .each_ref()
        .map(|table| table.cut(&slit_of([12.0, 3.0]), 8));
    for square in squares {
        let found = [0, 1].map(|k| tables[k].felt(&slits[k], square));
        for axis in 0..3 {
            let [one, other] = found.map(|[own, more]| own[axis] / (own[axis] + more[axis]));
            assert!((one / other - 1.0).abs() < 0.1, "{one} {other}");
        }
    }
}

/// Judge: facets do not know how finely the slit is cut into them. Tolerance: a tenth, for the finest are a quarter
/// of the depth and the coarsest of its size.
#[test]
fn facets_of_any_length_are_one_slit() {
    let table = block_table(3.0);
    let square = &squares()[0];
    let felt = |facets| table.felt(&table.cut(&slit_of([12.0, 3.0]), facets), square)[1];
    let finest = felt(16);
    for facets in [4, 6, 8, 12] {
        for (found, finest) in felt(facets).iter().zip(finest) {
            assert!(
                (found / finest - 1.0).abs() < 0.1,
                "{facets}: {found} {finest}"
            );
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
        slit.put(&self.response, [share].into_iter(), None, &mut load);
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
                let now = slit.added_compliance(&load);
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

/// Judge: a matrix has one inverse, in whatever order its rows are eliminated. A slit that is cut from its other end
/// is the same. Tolerance: rounding.
#[test]
fn a_slit_may_be_cut_from_either_end() {
    let kidney = Kidney::new();
    let triangle = kidney.solid.free[100];
    let normal = kidney
        .solid
        .surface
        .mesh()
        .area_vector(triangle)
        .normalize();
    let along = Vec3::x() - normal * normal.x;
    for depth in [3.0 * MM, f64::INFINITY] {
        let facets = [0, 1, 2, 3, 4, 5].map(|k| SlitFacet {
            middle: kidney.solid.centroid(triangle) + along * (2.0 * MM * f64::from(k)),
            along,
            normal,
            length: 2.0 * MM * along.norm(),
            depth,
        });
        let mut slits = [0, 1].map(|_| Slit::new(&kidney.response, facets.len()));
        for number in 0..facets.len() {
            let ends = [number, facets.len() - 1 - number];
            for (slit, number) in slits.iter_mut().zip(ends) {
                slit.open(&kidney.body(), &facets[number]).unwrap();
            }
        }
        for touch in [97, 100, 103] {
            let [one, other] = slits
                .each_ref()
                .map(|slit| slit.added_compliance(&kidney.load(slit, touch)));
            assert!((one - other).norm() < 1e-9 * one.norm(), "{one} {other}");
        }
    }
}

/// Judge: the slit as it was, to the last bit.
#[test]
fn going_back_is_exact() {
    let kidney = Kidney::new();
    let mut random = Random(9);
    let mut slit = Slit::new(&kidney.response, 12);
    let facets: Vec<_> = (0..12)
        .map(|k| kidney.facet(40 + k / 3, &mut random))
        .collect();
    let mut loads = Vec::new();
    for facet in &facets {
        loads.push(kidney.load(&slit, 30));
        slit.open(&kidney.body(), facet).unwrap();
    }
    let whole = kidney.load(&slit, 30);
    for (count, load) in loads.iter().enumerate().rev() {
        slit.truncate(count);
        assert_eq!(&kidney.load(&slit, 30), load);
    }
    assert_eq!(
        slit.added_compliance(&kidney.load(&slit, 30)),
        Matrix3::zeros()
    );
    for facet in &facets {
        slit.open(&kidney.body(), facet).unwrap();
    }
    assert_eq!(kidney.load(&slit, 30), whole);
    slit.clear();
    assert_eq!(slit.facets(), 0);
}

/// Judges: reciprocity; Betti's theorem, by which the field of the jumps is what the slit adds between loads; and
/// an organ that does not notice far away. Tolerance: rounding to 24 bits.
#[test]
fn compliance_and_field_are_one() {
    let kidney = Kidney::new();
    let mut random = Random(3);
    let mut slit = Slit::new(&kidney.response, 6);
    for number in 0..6 {
        let mut facet = kidney.facet(100 + number, &mut random);
        facet.depth = 3.0 * MM;
        slit.open(&kidney.body(), &facet).unwrap();
    }
    let touches: Vec<u32> = (0..kidney.solid.free.len() as u32).step_by(9).collect();
    let force = random.vector();
    let loaded = kidney.load(&slit, 101);
    let mut jumps = slit.jumps();
    slit.jump([(&loaded, force)].into_iter(), &mut jumps);
    assert!((0..6).all(|facet| slit.opening(facet, &jumps).is_some()));
    assert!(slit.opening(6, &jumps).is_none());
    let mut field = vec![0.0; 3 * kidney.response.parts().triangles];
    slit.add_field(&jumps, &mut field);
    let most = slit.added_compliance(&loaded).norm();
    let mut scratch = [slit.load(), slit.load()];
    for touch in touches {
        let load = kidney.load(&slit, touch);
        let between = slit.between(&load, &loaded);
        assert_eq!(between, slit.between(&loaded, &load).transpose());
        let further = slit.compliance(&kidney.response, TouchId(touch), TouchId(101), &mut scratch);
        assert_eq!(between, further);
        let triangle = kidney.response.touchable()[touch as usize].triangle;
        let values = &field[3 * triangle.index()..][..3];
        let moved = Vec3::from_fn(|axis, _| f64::from(values[axis]));
        assert!((moved - between * force).norm() < 1e-5 * most);
        let away = kidney.solid.centroid(triangle) - kidney.solid.centroid(kidney.solid.free[101]);
        if away.norm() > 50.0 * MM {
            assert!(slit.added_compliance(&load).norm() < 1e-2 * most);
        }
    }
}

#[test]
fn what_is_no_facet_is_refused() {
    let kidney = Kidney::new();
    let good = kidney.facet(7, &mut Random(1));
    let mut slit = Slit::new(&kidney.response, 1);
    let spoil: [fn(&mut SlitFacet); 8] = [
        |facet| facet.length = 0.0,
        |facet| facet.length = f64::NAN,
        |facet| facet.depth = -1.0,
        |facet| facet.middle.x = f64::NAN,
        |facet| facet.middle.x += 0.5,
        |facet| facet.normal = Vec3::zeros(),
        |facet| facet.along = facet.normal,
        |facet| facet.normal = -facet.normal,
    ];
    for spoil in spoil {
        let mut facet = good;
        spoil(&mut facet);
        let refused = slit.open(&kidney.body(), &facet).unwrap_err().to_string();
        assert!(refused.contains("cannot be opened"), "{refused}");
        assert_eq!(slit.facets(), 0);
    }
    slit.open(&kidney.body(), &good).unwrap();
    let refused = slit.open(&kidney.body(), &good).unwrap_err();
    assert_eq!(refused, Error::SlitTooLarge { most: 1 });
}

#[test]
fn a_step_of_a_cut_allocates_nothing() {
    let kidney = Kidney::new();
    let mut random = Random(2);
    let facets = [0, 1, 2].map(|k| kidney.facet(60 + k, &mut random));
    let mut slit = Slit::new(&kidney.response, 3);
    let (mut load, mut jumps) = (slit.load(), slit.jumps());
    let mut field = vec![0.0; 3 * kidney.response.parts().triangles];
    let share = Share {
        triangle: TouchId(60),
        weight: 1.0,
    };
    let spot = DiscForce {
        place: facets[0].middle,
        normal: facets[0].normal,
        radius: 2.0 * MM,
    };
    let before = violation_count();
    let sum = assert_no_alloc(|| {
        let mut sum = 0.0;
        for facet in &facets {
            slit.open(&kidney.body(), facet).unwrap();
            slit.put(
                &kidney.response,
                [share].into_iter(),
                Some(&spot),
                &mut load,
            );
            sum += slit.added_compliance(&load).norm();
            slit.jump([(&load, Vec3::z())].into_iter(), &mut jumps);
            slit.add_field(&jumps, &mut field);
        }
        slit.truncate(1);
        sum
    });
    assert!(sum.is_finite() && sum > 0.0);
    assert_eq!(violation_count(), before);
}
