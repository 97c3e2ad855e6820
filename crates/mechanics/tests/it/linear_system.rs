//! The linear system of a step, for other codes. Judge: multiplication.

use std::sync::Arc;

use palpate_mechanics::NeoHookean;
use palpate_mechanics::finite_elements::{
    FiniteElementModel, FiniteElementState, FiniteElementWorkspace, Formulation, LinearSystem,
    Supports,
};

use crate::bodies::{KINDS, block, face};
use crate::contacts::Random;

#[test]
fn its_solution_gives_back_the_right_side() {
    let mut random = Random(5);
    for kind in KINDS {
        let law = Arc::new(NeoHookean::incompressible(1.0).unwrap());
        let model = FiniteElementModel::new(block(kind, 2, 0.2), law, Formulation::Mixed).unwrap();
        let top = kind.dimension() - 1;
        let supports = (0..kind.dimension()).fold(Supports::none(&model), |supports, axis| {
            supports.fix(&model, face(model.mesh(), top, 0.0), axis, 0.0)
        });
        let state = FiniteElementState::at_rest(&model);
        let mut workspace = FiniteElementWorkspace::new(&model).unwrap();
        let mut system = LinearSystem::assemble(&model, &supports, &state, &mut workspace).unwrap();
        let exact: Vec<f64> = (0..model.size()).map(|_| random.vector().x).collect();
        let mut right = vec![0.0; model.size()];
        for (row, column, value) in system.entries() {
            right[row] += value * exact[column];
            if row != column {
                right[column] += value * exact[row];
            }
        }
        system.factor().unwrap();
        system.solve(&mut right).unwrap();
        for (found, exact) in right.iter().zip(&exact) {
            // Seven digits go to the weak diagonal of the pressures.
            assert!((found - exact).abs() < 1e-7, "{kind:?}: {found} {exact}");
        }
    }
}
