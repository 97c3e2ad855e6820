//! What a specimen's size does: forces on layers, and parameters from recordings of them.

use std::sync::Arc;

use palpate_characterize::inverse::{
    Body, CONE_ON_LAYER, PUNCH_ON_LAYER, THICKNESSES, sphere_on_layer,
};
use palpate_mechanics::finite_elements::indentation::{
    Block, IndentationRun, IndentationSettings, IndenterShape,
};
use palpate_mechanics::{NeoHookean, PronySeries};

/// Force [N] at `depth` [m] on the piece of a body that is so thick [m].
fn force(body: Body, thickness: f64, depth: f64) -> f64 {
    let Body::Block { block, indenter } = body else {
        panic!("a solid organ is a block");
    };
    let block = Block {
        height: thickness,
        ..block
    };
    let mut run = IndentationRun::new(&IndentationSettings {
        block,
        indenter,
        law: Arc::new(NeoHookean::incompressible(1.0).unwrap()),
        prony: PronySeries::default(),
        deepest: depth,
        halvings: 0,
    })
    .unwrap();
    run.press(depth, depth, |_| ()).unwrap().force
}

/// Forces on the layers of the table over that on a large piece, at a hundredth of the contact's radius.
fn on_layers(body: Body, radius: f64, depth: f64) -> [f64; 3] {
    let Body::Block { block, .. } = body else {
        panic!("a solid organ is a block");
    };
    let large = force(body, block.height, depth);
    THICKNESSES.map(|thickness| force(body, thickness * radius, depth) / large)
}

/// Judge: finite elements. Tolerance: the table's digits, and what meshes of other heights differ by.
#[test]
fn factors_of_layers_are_those_of_finite_elements() {
    let punch = on_layers(Body::under_punch(1.0), 1.0, 0.01);
    let half_angle = 75_f64.to_radians();
    let cone = Body::under_cone(half_angle, 0.01);
    let Body::Block { indenter, .. } = cone else {
        panic!("a solid organ is a block");
    };
    assert!(matches!(indenter.shape, IndenterShape::Cone { .. }));
    let cone = on_layers(cone, indenter.contact_radius(0.01), 0.01);
    println!("{punch:?} {cone:?}");
    for (found, table) in [(punch, PUNCH_ON_LAYER), (cone, CONE_ON_LAYER)] {
        for (found, table) in found.iter().zip(table) {
            assert!((found / table - 1.0).abs() < 0.01, "{found} {table}");
        }
    }
    // A sphere by its own series.
    let sphere = on_layers(Body::under_sphere(1.0), 1.0, 0.02);
    for (found, thickness) in sphere.iter().zip(THICKNESSES) {
        let series =
            sphere_on_layer(0.02_f64.sqrt() / thickness) / sphere_on_layer(0.02_f64.sqrt() / 100.0);
        assert!(
            (found / series - 1.0).abs() < 0.02,
            "{thickness}: {found} {series}"
        );
    }
}
