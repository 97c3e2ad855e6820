//! Every kind of element, looked at alone.

use super::ElementKind;

const KINDS: [ElementKind; 3] = [ElementKind::Quad9, ElementKind::Hex27, ElementKind::Tet10];

/// Places inside the element, near its corners and outside.
fn places(kind: ElementKind) -> Vec<[f64; 3]> {
    let mut all = vec![
        [0.11, 0.23, 0.31],
        [-0.4, 0.7, 0.2],
        [0.9, -0.8, 1.2],
        [0.0; 3],
    ];
    all.extend(kind.quadrature().iter().map(|point| point.at));
    for at in &mut all {
        if kind.dimension() == 2 {
            at[2] = 0.0;
        }
    }
    all
}

fn shape(kind: ElementKind, at: [f64; 3]) -> Vec<f64> {
    let mut values = vec![0.0; kind.nodes()];
    kind.shape(at, &mut values);
    values
}

fn corner_shape(kind: ElementKind, at: [f64; 3]) -> Vec<f64> {
    let mut values = vec![0.0; kind.corners().len()];
    kind.corner_shape(at, &mut values);
    values
}

fn slopes(kind: ElementKind, at: [f64; 3]) -> Vec<[f64; 3]> {
    let mut slopes = vec![[0.0; 3]; kind.nodes()];
    kind.shape_gradients(at, &mut slopes);
    slopes
}

/// Powers of x, y, z whose sum is at most `degree`, or each of which is in a tensor product.
fn powers(kind: ElementKind, degree: i32) -> Vec<[i32; 3]> {
    let deepest = if kind.dimension() == 2 { 0 } else { degree };
    let mut all = Vec::new();
    for i in 0..=degree {
        for j in 0..=degree {
            for k in 0..=deepest {
                if kind != ElementKind::Tet10 || i + j + k <= degree {
                    all.push([i, j, k]);
                }
            }
        }
    }
    all
}

fn monomial(at: [f64; 3], powers: [i32; 3]) -> f64 {
    (0..3).map(|i| at[i].powi(powers[i])).product()
}

#[test]
fn a_function_is_one_at_its_node_and_zero_at_the_others() {
    for kind in KINDS {
        for node in 0..kind.nodes() {
            let values = shape(kind, kind.node_coordinates(node));
            for (other, value) in values.iter().enumerate() {
                let exact = f64::from(u8::from(other == node));
                assert!((value - exact).abs() < 1e-14, "{kind:?} {node} {other}");
            }
        }
        for (corner, &node) in kind.corners().iter().enumerate() {
            let values = corner_shape(kind, kind.node_coordinates(node));
            for (other, value) in values.iter().enumerate() {
                let exact = f64::from(u8::from(other == corner));
                assert!((value - exact).abs() < 1e-14, "{kind:?} corner {corner}");
            }
        }
    }
}

/// Sums of nodal values give back every polynomial of the degree: two, and one for the pressure.
#[test]
fn polynomials_are_complete() {
    for kind in KINDS {
        for at in places(kind) {
            for powers in powers(kind, 2) {
                let found: f64 = shape(kind, at)
                    .iter()
                    .enumerate()
                    .map(|(node, value)| value * monomial(kind.node_coordinates(node), powers))
                    .sum();
                let exact = monomial(at, powers);
                assert!((found - exact).abs() < 1e-13, "{kind:?} {at:?} {powers:?}");
            }
            for powers in powers(kind, 1) {
                let found: f64 = corner_shape(kind, at)
                    .iter()
                    .zip(kind.corners())
                    .map(|(value, &node)| value * monomial(kind.node_coordinates(node), powers))
                    .sum();
                let exact = monomial(at, powers);
                assert!((found - exact).abs() < 1e-13, "{kind:?} {at:?} {powers:?}");
            }
        }
    }
}

/// Central differences; of quadratics along an axis they are exact but for rounding.
#[test]
fn gradients_are_those_of_the_functions() {
    let step = 1e-3;
    for kind in KINDS {
        for at in places(kind) {
            let slopes = slopes(kind, at);
            for axis in 0..kind.dimension() {
                let moved = |by: f64| {
                    let mut at = at;
                    at[axis] += by;
                    shape(kind, at)
                };
                let (up, down) = (moved(step), moved(-step));
                for node in 0..kind.nodes() {
                    let found = (up[node] - down[node]) / (2.0 * step);
                    assert!((found - slopes[node][axis]).abs() < 1e-11, "{kind:?}");
                }
            }
            let sums = |axis: usize| slopes.iter().map(|slope| slope[axis]).sum::<f64>();
            assert!((0..3).all(|axis| sums(axis).abs() < 1e-13), "{kind:?}");
        }
    }
}

/// Degree five: along each axis for products, in all for tetrahedra. Judge: the integrals by hand.
#[test]
fn quadrature_is_exact_to_degree_five() {
    let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
    for kind in KINDS {
        for powers in powers(kind, 5) {
            let found: f64 = kind
                .quadrature()
                .iter()
                .map(|point| point.weight * monomial(point.at, powers))
                .sum();
            let exact: f64 = if kind == ElementKind::Tet10 {
                // i! j! k! / (i + j + k + 3)!
                powers.map(factorial).iter().product::<f64>()
                    / factorial(powers.iter().sum::<i32>() + 3)
            } else {
                let along = |n: i32| {
                    if n % 2 == 0 {
                        2.0 / f64::from(n + 1)
                    } else {
                        0.0
                    }
                };
                powers
                    .iter()
                    .take(kind.dimension())
                    .map(|&n| along(n))
                    .product()
            };
            assert!(
                (found - exact).abs() < 1e-14,
                "{kind:?} {powers:?}: {found} {exact}"
            );
        }
    }
}
