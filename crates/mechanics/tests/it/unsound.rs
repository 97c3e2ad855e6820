//! What a solver must notice: bodies that nothing holds, elements inside out, locking.

use std::sync::Arc;

use palpate_mechanics::finite_elements::hemisphere::{HemisphereProblem, Patch};
use palpate_mechanics::finite_elements::{
    ElementKind, ElementMesh, Failure, FiniteElementModel, Formulation, Supports,
};
use palpate_mechanics::{Error, Law, LinearElastic, NeoHookean};

use crate::bodies::{Body, KINDS, block, face};

const SINGULAR: Error = Error::NotInEquilibrium {
    failure: Failure::Singular,
};

fn laws() -> [Arc<dyn Law>; 3] {
    [
        Arc::new(LinearElastic::new(3.0, 0.3).unwrap()),
        Arc::new(NeoHookean::compressible(1.0, 5.0).unwrap()),
        Arc::new(NeoHookean::incompressible(1.0).unwrap()),
    ]
}

#[test]
fn a_body_that_nothing_holds_is_singular() {
    for kind in KINDS {
        for law in laws() {
            let mut body = Body::new(block(kind, 2, 0.2), law, Formulation::Mixed);
            assert_eq!(body.solve(Supports::none), Err(SINGULAR), "{kind:?}");
            // Sliding on one plane: two shifts and a turn are left, or nothing on an axis.
            let low = face(body.model.mesh(), 0, 0.0);
            let one = body.solve(|model| Supports::none(model).fix(model, low, 0, 0.0));
            assert_eq!(one, Err(SINGULAR), "{kind:?}");
        }
    }
}

/// Six unknowns hold a solid if they are the right ones.
#[test]
fn a_hinge_is_singular_and_three_points_are_not() {
    for kind in [ElementKind::Hex27, ElementKind::Tet10] {
        for law in laws() {
            let mut body = Body::new(block(kind, 2, 0.0), law, Formulation::Mixed);
            let mesh = body.model.mesh();
            let edge = mesh.nodes_where(|x| x.x == 0.0 && x.y == 0.0);
            let corner = |x: f64, y: f64, z: f64| {
                let place = palpate_mechanics::Vec3::new(x, y, z);
                mesh.nodes_where(|n| (n - place).norm() < 1e-9)[0]
            };
            let corners = [
                corner(0.0, 0.0, 0.0),
                corner(1.0, 0.0, 0.0),
                corner(0.0, 1.0, 0.0),
            ];
            let hinge = |model: &FiniteElementModel| {
                (0..3).fold(Supports::none(model), |supports, axis| {
                    supports.fix(model, edge.iter().copied(), axis, 0.0)
                })
            };
            assert_eq!(body.solve(hinge), Err(SINGULAR), "{kind:?}");
            let three = |model: &FiniteElementModel| {
                Supports::none(model)
                    .fix(model, corners, 2, 0.0)
                    .fix(model, [corners[0], corners[1]], 1, 0.0)
                    .fix(model, [corners[0]], 0, 0.0)
            };
            assert_eq!(body.solve(three), Ok(()), "{kind:?}");
        }
    }
}

#[test]
fn elements_inside_out_are_refused() {
    for kind in KINDS {
        let law: Arc<dyn Law> = Arc::new(LinearElastic::new(3.0, 0.3).unwrap());
        let refused = |mesh: ElementMesh| {
            FiniteElementModel::new(mesh, law.clone(), Formulation::Mixed).map(drop)
        };
        let mut mirrored = block(kind, 2, 0.0);
        mirrored.nodes.iter_mut().for_each(|x| x.y = -x.y);
        assert_eq!(
            refused(mirrored),
            Err(Error::InvertedElement { element: 0 })
        );
        let mut flat = block(kind, 2, 0.0);
        flat.nodes.iter_mut().for_each(|x| x.y = 0.0);
        assert_eq!(refused(flat), Err(Error::InvertedElement { element: 0 }));
        let mut stray = block(kind, 2, 0.0);
        let (place, nodes) = (kind.nodes() + 1, stray.nodes.len());
        stray.elements[place] = nodes as u32;
        assert_eq!(
            refused(stray),
            Err(Error::NodeOutOfRange { element: 1, nodes })
        );
        let none = ElementMesh {
            kind,
            nodes: Vec::new(),
            elements: Vec::new(),
        };
        assert_eq!(refused(none), Err(Error::NoElements));
    }
}

/// Pushed through itself in one step, at finite strain.
#[test]
fn a_body_pushed_through_itself_fails() {
    let law = Arc::new(NeoHookean::incompressible(1.0).unwrap());
    for kind in KINDS {
        let mut body = Body::new(block(kind, 2, 0.0), law.clone(), Formulation::Mixed);
        let (low, high) = (
            face(body.model.mesh(), 1, 0.0),
            face(body.model.mesh(), 1, 1.0),
        );
        let found = body.solve(|model| {
            (0..model.dimension())
                .fold(Supports::none(model), |supports, axis| {
                    supports.fix(model, low.iter().copied(), axis, 0.0)
                })
                .fix(model, high, 1, -1.5)
        });
        assert!(found.is_err(), "{kind:?}");
    }
}

#[test]
fn displacements_alone_refuse_to_lock() {
    let made = |nu: f64, formulation| {
        let law = Arc::new(LinearElastic::new(3.0, nu).unwrap());
        FiniteElementModel::new(block(ElementKind::Quad9, 1, 0.0), law, formulation).map(drop)
    };
    assert_eq!(made(0.489, Formulation::Displacement), Ok(()));
    assert_eq!(made(0.499, Formulation::Mixed), Ok(()));
    let found = made(0.495, Formulation::Displacement);
    assert!(
        matches!(found, Err(Error::Locking { poissons_ratio }) if (poissons_ratio - 0.495).abs() < 1e-9)
    );
}

/// Mixed elements do not lock: with G kept, a punch's stiffness tends to a limit as ν → ½, and is off it
/// by a multiple of 1 − 2ν, at any mesh.
#[test]
fn the_incompressible_limit_is_approached_evenly() {
    for halvings in [0, 1] {
        let force = |away: f64| {
            let nu = 0.5 - away;
            let law = LinearElastic::new(2.0 * (1.0 + nu), nu).unwrap();
            let problem = HemisphereProblem {
                radius: 0.05,
                patch_radius: 4e-3,
                patch: Patch::Bonded,
                law,
                depth: 1e-3,
            };
            problem.solve_on(0.2, halvings).unwrap().force
        };
        let limit = force(1e-9);
        let off = [1e-3, 1e-4, 1e-5].map(|away| (force(away) / limit - 1.0).abs() / away);
        println!("{halvings}: {off:?}");
        assert!(
            off.iter()
                .all(|each| (each / off[0] - 1.0).abs() < 0.05 && *each < 10.0)
        );
    }
}
