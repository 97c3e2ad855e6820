//! The body at large deformation: a bar that is bent by its end.

use std::sync::Arc;
use std::time::Instant;

use nalgebra::Matrix3;
use palpate_geometry::TetrahedronMesh;
use palpate_mechanics::finite_elements::{
    ElementMesh, FiniteElementModel, FiniteElementState, FiniteElementWorkspace, Formulation,
    Supports, equilibrate,
};
use palpate_mechanics::nonlinear::{
    Conditions, Coupling, Moduli, NonlinearModel, NonlinearState, StepSettings, Workspace, advance,
};
use palpate_mechanics::{NeoHookean, Vec3};

/// Length of the bar, whose sides are a fifth of it [m].
const LENGTH: f64 = 0.1;

/// c₁₀ [Pa].
const C10: f64 = 2000.0;

/// Steps of a hand at 200 mm/s, 1 mm each.
const STEPS: usize = 60;

struct Bar {
    mesh: TetrahedronMesh,
    model: NonlinearModel,
    /// The nodes of its end, with equal weights.
    end: Vec<(u32, f64)>,
}

impl Bar {
    fn new(across: usize, poissons_ratio: f64) -> Self {
        let high = Vec3::new(LENGTH, 0.2 * LENGTH, 0.2 * LENGTH);
        let mesh =
            TetrahedronMesh::block(Vec3::zeros(), high, [5 * across, across, across]).unwrap();
        let moduli = Moduli::mooney_rivlin(C10, 0.0, poissons_ratio).unwrap();
        let moduli = vec![moduli; mesh.tetrahedra().len()];
        let model = NonlinearModel::new(
            &mesh,
            &moduli,
            |_, place| place.x < 1e-9,
            |_, place| place.x > LENGTH - 1e-9,
        )
        .unwrap();
        let places = model.nodes().iter().enumerate();
        let end: Vec<u32> = places
            .filter(|(_, place)| place.x > LENGTH - 1e-9)
            .map(|(node, _)| node as u32)
            .collect();
        let weight = 1.0 / end.len() as f64;
        Self {
            mesh,
            model,
            end: end.into_iter().map(|node| (node, weight)).collect(),
        }
    }

    fn grip(&self, displacement: Vec3) -> [Option<Coupling<'_>>; 1] {
        [Some(Coupling {
            nodes: &self.end,
            along: None,
            displacement,
            advance: Vec3::new(0.0, 1e-3, 0.0),
            compliance: Matrix3::zeros(),
            offset: Vec3::zeros(),
        })]
    }

    /// The equilibrium with the end at `displacement`, from `state`: many steps in one place.
    fn converged(
        &self,
        displacement: Vec3,
        state: &NonlinearState,
        workspace: &mut Workspace,
    ) -> NonlinearState {
        let mut state = state.clone();
        for _ in 0..15 {
            advance(
                &self.model,
                Conditions::of_tools(&self.grip(displacement)),
                StepSettings {
                    iterations: 30,
                    elapsed: 0.0,
                },
                &mut state,
                workspace,
            );
        }
        state
    }

    /// Bends the bar by 60 mm with `iterations` a step: its last state and the largest error of the force against
    /// convergence, in parts of the largest force.
    fn bend(&self, iterations: usize) -> (NonlinearState, f64) {
        let mut state = NonlinearState::at_rest(&self.model, 1);
        let mut workspace = self.model.workspace(1);
        let mut judge = self.model.workspace(1);
        let (mut error, mut largest) = (0.0_f64, 0.0_f64);
        let mut seconds = 0.0;
        for step in 1..=STEPS {
            let displacement = Vec3::new(0.0, 1e-3 * step as f64, 0.0);
            let begun = Instant::now();
            advance(
                &self.model,
                Conditions::of_tools(&self.grip(displacement)),
                StepSettings {
                    iterations,
                    elapsed: 0.0,
                },
                &mut state,
                &mut workspace,
            );
            seconds += begun.elapsed().as_secs_f64();
            if step % 10 == 0 {
                let exact = self.converged(displacement, &state, &mut judge).force(0);
                error = error.max((state.force(0) - exact).norm());
                largest = largest.max(exact.norm());
            }
        }
        println!(
            "{} nodes, {iterations} iterations: error {:.2} %, {:.2} ms a step",
            self.model.nodes().len(),
            100.0 * error / largest,
            1e3 * seconds / STEPS as f64
        );
        (state, error / largest)
    }
}

/// Judge: the same steps, repeated in one place until nothing changes. Half a percent of the force is what a hand does not
/// feel; 0.02 % was found.
#[test]
fn three_iterations_follow_a_fast_hand() {
    let bar = Bar::new(2, 0.45);
    for iterations in [2, 3, 4] {
        let (_, error) = bar.bend(iterations);
        assert!(iterations < 3 || error < 0.005, "{error}");
    }
}

/// Judge: finite elements with another pressure (linear and continuous) and an isochoric law, loaded with the force that
/// was found. At a Poisson's ratio of 0.45 the two laws differ by some 0.5 %; the elements of a coarse bar by 6 %, as
/// refinement shows.
#[test]
fn a_bent_bar_is_that_of_finite_elements() {
    bends_as_finite_elements(2, 0.015);
}

/// As `a_bent_bar_is_that_of_finite_elements`, with three times the nodes.
#[test]
#[ignore = "slow: a minute"]
fn a_finer_bent_bar_is_that_of_finite_elements() {
    bends_as_finite_elements(3, 0.01);
}

fn bends_as_finite_elements(across: usize, most: f64) {
    let bar = Bar::new(across, 0.45);
    let (state, _) = bar.bend(3);
    let goal = Vec3::new(0.0, 1e-3 * STEPS as f64, 0.0);
    let mut workspace = bar.model.workspace(1);
    let force = bar.converged(goal, &state, &mut workspace).force(0);
    let found = mean_displacement_of_finite_elements(&bar, &force);
    let error = (found - goal).norm() / goal.norm();
    println!("force {force:?} N, displacement {found:?} m, error {error:.4}");
    assert!(error < most, "{error}");
}

/// Increments of the load, few enough to be quick and enough for Newton's method to follow a slender bar.
const INCREMENTS: u32 = 40;

fn mean_displacement_of_finite_elements(bar: &Bar, force: &Vec3) -> Vec3 {
    let shear = 2.0 * C10;
    let bulk = 2.0 * shear * 1.45 / (3.0 * (1.0 - 0.9));
    let law = NeoHookean::compressible(C10, bulk).unwrap();
    let elements = ElementMesh::from_tetrahedra(&bar.mesh);
    let fixed = elements.nodes_where(|place| place.x < 1e-9);
    let model = FiniteElementModel::new(elements, Arc::new(law), Formulation::Mixed).unwrap();
    let mut state = FiniteElementState::at_rest(&model);
    let mut workspace = FiniteElementWorkspace::new(&model).unwrap();
    for part in 1..=INCREMENTS {
        let mut load = vec![0.0; model.size()];
        for &(node, weight) in &bar.end {
            for axis in 0..3 {
                let part = f64::from(part) / f64::from(INCREMENTS);
                load[3 * node as usize + axis] = part * weight * force[axis];
            }
        }
        let mut supports = Supports::none(&model).load(&load);
        for axis in 0..3 {
            supports = supports.fix(&model, fixed.iter().copied(), axis, 0.0);
        }
        equilibrate(&model, &supports, &mut state, &mut workspace).unwrap();
    }
    bar.end
        .iter()
        .map(|&(node, weight)| weight * state.displacement(&model, node as usize))
        .sum()
}
