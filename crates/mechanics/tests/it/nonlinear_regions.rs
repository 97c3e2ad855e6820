//! Bodies of several tissues at large deformation, beside finite elements.

use std::sync::Arc;

use nalgebra::Matrix3;
use palpate_geometry::TetrahedronMesh;
use palpate_mechanics::finite_elements::{
    ElementMesh, FiniteElementModel, FiniteElementState, FiniteElementWorkspace, Formulation,
    Supports, equilibrate,
};
use palpate_mechanics::nonlinear::{
    Conditions, Coupling, Moduli, NonlinearModel, NonlinearState, SpreadLoad, StepSettings, advance,
};
use palpate_mechanics::{Law, NeoHookean, Vec3};

const SIZE: [f64; 3] = [0.06, 0.06, 0.03];
const RATIO: f64 = 0.45;
const RADIUS: f64 = 0.015;

fn block(cells: [usize; 3]) -> TetrahedronMesh {
    TetrahedronMesh::block(Vec3::zeros(), Vec3::from(SIZE), cells).unwrap()
}

fn load(model: &NonlinearModel) -> SpreadLoad {
    let mut load = model.spread_load();
    let top = Vec3::new(0.5 * SIZE[0], 0.5 * SIZE[1], SIZE[2]);
    model.boundary().spread(&top, &Vec3::z(), RADIUS, &mut load);
    load
}

fn pace(iterations: usize) -> StepSettings {
    StepSettings {
        iterations,
        elapsed: 0.0,
    }
}

fn base(place: &Vec3) -> bool {
    place.z < 1e-9
}

/// Mean displacement [m] under `force` [N] of the mesh with `cells`.
fn judge(cells: [usize; 3], c10: &Tissue, force: Vec3) -> Vec3 {
    let mesh = block(cells);
    let moduli: Vec<_> = (0..mesh.tetrahedra().len())
        .map(|_| Moduli::mooney_rivlin(1.0, 0.0, RATIO).unwrap())
        .collect();
    let carrier = NonlinearModel::new(&mesh, &moduli, |_, p| base(p), |_, _| false).unwrap();
    let load_of = load(&carrier);
    let laws: Vec<Arc<dyn Law>> = (0..mesh.tetrahedra().len())
        .map(|t| {
            let c10 = c10(&(mesh.positions(t).iter().sum::<Vec3>() / 4.0));
            let bulk = 4.0 * c10 * (1.0 + RATIO) / (3.0 * (1.0 - 2.0 * RATIO));
            Arc::new(NeoHookean::compressible(c10, bulk).unwrap()) as Arc<dyn Law>
        })
        .collect();
    let elements = ElementMesh::from_tetrahedra(&mesh);
    let fixed = elements.nodes_where(base);
    let regions: Vec<u32> = (0..elements.len() as u32).collect();
    let model =
        FiniteElementModel::with_regions(elements, &laws, &regions, Formulation::Displacement)
            .unwrap();
    let mut state = FiniteElementState::at_rest(&model);
    let mut workspace = FiniteElementWorkspace::new(&model).unwrap();
    for part in [0.25, 0.5, 0.75, 1.0] {
        let mut loads = vec![0.0; model.size()];
        for &(node, weight) in &load_of.nodes {
            for axis in 0..3 {
                loads[3 * node as usize + axis] = part * weight * force[axis];
            }
        }
        let mut supports = Supports::none(&model).load(&loads);
        for axis in 0..3 {
            supports = supports.fix(&model, fixed.iter().copied(), axis, 0.0);
        }
        equilibrate(&model, &supports, &mut state, &mut workspace).unwrap();
    }
    load_of
        .nodes
        .iter()
        .map(|&(node, weight)| weight * state.displacement(&model, node as usize))
        .sum()
}

/// Force that moves the load's mean by `way` [m], on a mesh with `cells`, whose elements have the mean of what is in them.
fn found(cells: [usize; 3], c10: &Tissue, way: Vec3) -> Vec3 {
    let mesh = block(cells);
    let places = samples();
    let moduli: Vec<_> = (0..mesh.tetrahedra().len())
        .map(|t| {
            let corners = mesh.positions(t);
            let parts = places.iter().map(|at| {
                let c10 = c10(&(0..4).map(|k| corners[k] * at[k]).sum());
                let moduli = Moduli::mooney_rivlin(c10, 0.0, RATIO).unwrap();
                (moduli, 1.0 / places.len() as f64)
            });
            Moduli::mixed(parts)
        })
        .collect();
    let model = NonlinearModel::on_boundary(&mesh, &moduli, |_, place| base(place)).unwrap();
    let load = load(&model);
    let mut state = NonlinearState::at_rest(&model, 1);
    let mut workspace = model.workspace(1);
    for step in 1..=30 {
        let coupling = Coupling {
            nodes: &load.nodes,
            along: None,
            displacement: (f64::from(step) / 20.0).min(1.0) * way,
            compliance: Matrix3::zeros(),
            advance: way / 20.0,
            offset: Vec3::zeros(),
        };
        advance(
            &model,
            Conditions::of_tools(&[Some(coupling)]),
            pace(6),
            &mut state,
            &mut workspace,
        );
    }
    println!(
        "{cells:?}, {} nodes: {:?}",
        model.nodes().len(),
        state.force(0)
    );
    state.force(0)
}

/// A layer of 5 mm that is four times as stiff, and a ball of 9 mm that is ten times as stiff and 3 mm below the surface, in
/// a block that is pressed and pulled aside. The elements are larger than either and do not end where they end. Judge:
/// finite elements that do, loaded with the force that was found, by a fiftieth of the load's radius, for the laws differ
/// beyond. Tolerance 5 %, of which the judge has 1.
#[test]
#[ignore = "long"]
fn small_moves_of_layers_and_inclusions_are_those_of_finite_elements() {
    let [pressed, pulled] = SMALL;
    for (case, way) in CASES.iter().zip([pulled, pressed]) {
        as_finite_elements(case, way, [8, 8, 4], 0.05);
    }
}

/// The other two. Aside, the ball moves by 6.2 % too little with elements of 7.5 mm, and by 3.1 % with elements of 6 mm.
#[test]
#[ignore = "slow: a minute"]
fn more_small_moves_are_those_of_finite_elements() {
    let [layer, ball] = &CASES;
    let [pressed, pulled] = SMALL;
    as_finite_elements(layer, pressed, [8, 8, 4], 0.05);
    as_finite_elements(ball, pulled, [8, 8, 4], 0.07);
    as_finite_elements(ball, pulled, [10, 10, 5], 0.05);
}

const SMALL: [Vec3; 2] = [Vec3::new(0.0, 0.0, -3e-4), Vec3::new(3e-4, 0.0, 0.0)];

fn as_finite_elements(
    (name, c10): &(&str, &'static Tissue),
    way: Vec3,
    cells: [usize; 3],
    most: f64,
) {
    let force = found(cells, c10, way);
    let moved = judge([12, 12, 6], c10, force);
    let error = (moved - way).norm() / way.norm();
    println!("{name} {way:?}: {error:.4}");
    assert!(error < most, "{name}: {error}");
}

/// As above, and by a third of the load's radius. Judge: the same elements of the same law, a third of the size. Tolerance
/// 5 %.
#[test]
#[ignore = "by hand: the finer mesh takes more memory than a test allows it"]
fn large_moves_of_layers_and_inclusions_converge() {
    for (name, c10) in CASES {
        for way in [Vec3::new(0.0, 0.0, -4e-3), Vec3::new(8e-3, 0.0, 0.0)] {
            let coarse = found([8, 8, 4], c10, way);
            let fine = found([15, 15, 9], c10, way);
            let error = (coarse - fine).norm() / fine.norm();
            println!("{name} {way:?}: {error:.4}");
            assert!(error < 0.05, "{name}: {error}");
        }
    }
}

/// c₁₀ [Pa] at a place.
type Tissue = dyn Fn(&Vec3) -> f64 + Sync;

const CASES: [(&str, &Tissue); 2] = [
    ("layer", &|p| if p.z > 0.025 { 8000.0 } else { 2000.0 }),
    ("ball", &|p| {
        let off = p - Vec3::new(0.03, 0.03, 0.018);
        if off.norm() < 0.009 { 20_000.0 } else { 2000.0 }
    }),
];

/// Closed form: the parts of a column without lateral contraction are in series, u = F/A Σ t/E, where ever they meet.
/// Tolerance 2 %: the elements where they meet, a sixth of all, have the mean of two bounds, of which one would be exact and
/// the other is a fifth off.
#[test]
fn parts_of_a_column_are_in_series() {
    let heights = [0.0, 0.011, 0.0205, 0.03];
    let moduli = [2000.0, 8000.0, 4000.0];
    let mesh = block([2, 2, 12]);
    let places = samples();
    let of = |z: f64| moduli[(0..3).find(|k| z < heights[k + 1]).unwrap_or(2)];
    let all: Vec<_> = (0..mesh.tetrahedra().len())
        .map(|t| {
            let corners = mesh.positions(t);
            Moduli::mixed(places.iter().map(|at| {
                let z = (0..4).map(|k| corners[k].z * at[k]).sum();
                let moduli = Moduli::mooney_rivlin(0.25 * of(z), 0.0, 0.0).unwrap();
                (moduli, 1.0 / places.len() as f64)
            }))
        })
        .collect();
    let model = NonlinearModel::on_boundary(&mesh, &all, |_, place| base(place)).unwrap();
    // Far wider than the block, so that its weights are even.
    let mut load = model.spread_load();
    let top = Vec3::new(0.5 * SIZE[0], 0.5 * SIZE[1], SIZE[2]);
    model.boundary().spread(&top, &Vec3::z(), 10.0, &mut load);
    let mut state = NonlinearState::at_rest(&model, 1);
    let mut workspace = model.workspace(1);
    let way = 3e-5 * Vec3::z();
    let coupling = Coupling {
        nodes: &load.nodes,
        along: None,
        displacement: way,
        compliance: Matrix3::zeros(),
        advance: Vec3::zeros(),
        offset: Vec3::zeros(),
    };
    for _ in 0..10 {
        advance(
            &model,
            Conditions::of_tools(&[Some(coupling)]),
            pace(10),
            &mut state,
            &mut workspace,
        );
    }
    let each = heights.windows(2).zip(moduli);
    let soft: f64 = each.map(|(z, modulus)| (z[1] - z[0]) / modulus).sum();
    let expected = way.z * SIZE[0] * SIZE[1] / soft;
    let found = state.force(0).z;
    println!("{found} N, in series {expected} N");
    assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
}

fn samples() -> Vec<[f64; 4]> {
    const PARTS: usize = 6;
    let mut all = Vec::new();
    for i in 0..PARTS {
        for j in 0..PARTS - i {
            for k in 0..PARTS - i - j {
                let at = [i, j, k].map(|n| (n as f64 + 0.25) / PARTS as f64);
                all.push([1.0 - at.iter().sum::<f64>(), at[0], at[1], at[2]]);
            }
        }
    }
    all
}
