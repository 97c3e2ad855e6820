//! Numbers of the caller that belong to no node, triangle or model are errors, before any expensive work.

use std::ops::ControlFlow;
use std::sync::Arc;

use palpate_geometry::{Organ, TriangleId};
use palpate_mechanics::boundary_elements::{BoundaryProblem, Progress};
use palpate_mechanics::contact::{Friction, FrictionLaw};
use palpate_mechanics::finite_elements::condensed::CondensedProblem;
use palpate_mechanics::finite_elements::hemisphere::{HalfBall, HemisphereProblem, Patch};
use palpate_mechanics::finite_elements::indentation::{
    Base, Block, IndentationRun, IndentationSettings, Indenter, IndenterShape,
};
use palpate_mechanics::finite_elements::rigid_tool::RigidShape;
use palpate_mechanics::finite_elements::{
    Cavity, ElementKind, ElementMesh, FiniteElementModel, FiniteElementState,
    FiniteElementWorkspace, Formulation, LinearSystem, Mismatch, Path, PunchedLines, RigidSurface,
    Sliding, Supports, equilibrate,
};
use palpate_mechanics::surface_response::{
    MovedTriangle, PatchContact, PatchWorkspace, Reciprocity, ResponseParts, SurfaceResponse,
    TipField, TouchId, TouchableTriangle,
};
use palpate_mechanics::{Error, LinearElastic, PronySeries, Vec3};

use crate::bodies::{Body, KINDS, block, face};
use crate::boundary_response::Held;

fn body(kind: ElementKind) -> Body {
    let law = Arc::new(LinearElastic::new(1.0, 0.3).unwrap());
    Body::new(block(kind, 1, 0.0), law, Formulation::Mixed)
}

/// A body whose lower face is fixed.
fn fixed(model: &FiniteElementModel) -> Supports<'static> {
    let low = face(model.mesh(), 1, 0.0);
    (0..model.dimension()).fold(Supports::none(model), |supports, axis| {
        supports.fix(model, low.iter().copied(), axis, 0.0)
    })
}

/// What every solver that takes supports says of them.
fn refused_by_all(body: &mut Body, supports: &Supports<'_>) -> Mismatch {
    let (model, workspace) = (&body.model, &mut body.workspace);
    let found = equilibrate(model, supports, &mut body.state, workspace).unwrap_err();
    let assembled = LinearSystem::assemble(model, supports, &body.state, workspace);
    assert_eq!(assembled.unwrap_err(), found);
    assert_eq!(Path::new(model, supports.clone(), 0.1).unwrap_err(), found);
    let message = found.to_string();
    assert!(message.contains("; "), "cause, then what to do: {message}");
    match found {
        Error::Mismatch(found) => found,
        other => panic!("{other}"),
    }
}

#[test]
fn a_cavity_with_other_sides_is_refused() {
    for (kind, expected) in [
        (ElementKind::Quad9, 3),
        (ElementKind::Hex27, 9),
        (ElementKind::Tet10, 6),
    ] {
        let mut body = body(kind);
        let nodes = body.model.mesh().nodes.len();
        let short = Cavity {
            sides: vec![(0..expected).collect(), (0..expected - 1).collect()],
        };
        let supports = fixed(&body.model).press(&short, 1.0);
        let refused = Mismatch::CavitySide {
            side: 1,
            found: expected as usize - 1,
            expected: expected as usize,
        };
        assert_eq!(refused_by_all(&mut body, &supports), refused);
        let stray = Cavity {
            sides: vec![vec![nodes as u32; expected as usize]],
        };
        let supports = fixed(&body.model).press(&stray, 1.0);
        let found = refused_by_all(&mut body, &supports);
        assert!(matches!(found, Mismatch::NodeBeyondMesh { node, .. } if node == nodes));
        let good = Cavity {
            sides: vec![(0..expected).collect()],
        };
        let too_few = &body.state.unknowns[1..];
        let found = good.volume(&body.model, too_few);
        assert!(matches!(
            found,
            Err(Error::Mismatch(Mismatch::WrongLength { .. }))
        ));
        assert!(good.volume(&body.model, &body.state.unknowns).is_ok());
    }
}

fn sphere(radius: f64) -> RigidSurface {
    RigidSurface::Revolved {
        shape: RigidShape::Sphere { radius },
        height: 2.0,
    }
}

#[test]
fn a_node_slides_on_a_sphere_only_in_axisymmetry() {
    let on = |node: usize| Sliding {
        node,
        surface: sphere(1.0),
        force_ratio: 0.0,
    };
    for kind in [ElementKind::Hex27, ElementKind::Tet10] {
        let mut body = body(kind);
        let mut supports = fixed(&body.model);
        supports.sliding.push(on(0));
        let refused = Mismatch::CannotSlide { node: 0 };
        assert_eq!(refused_by_all(&mut body, &supports), refused);
    }
    let mut body = body(ElementKind::Quad9);
    let nodes = body.model.mesh().nodes.len();
    let top = face(body.model.mesh(), 1, 1.0)[1];
    let low = face(body.model.mesh(), 1, 0.0)[0];
    let mut with = |spheres: &[Sliding]| {
        let mut supports = fixed(&body.model);
        supports.sliding.extend(spheres);
        refused_by_all(&mut body, &supports)
    };
    let flat = Sliding {
        node: top,
        surface: sphere(0.0),
        force_ratio: 0.0,
    };
    assert!(matches!(
        with(&[on(nodes)]),
        Mismatch::NodeBeyondMesh { .. }
    ));
    assert!(matches!(with(&[flat]), Mismatch::SurfaceOutOfRange { .. }));
    let both = |node| Mismatch::SlidesAndIsFixed { node };
    assert_eq!(with(&[on(low)]), both(low));
    assert_eq!(with(&[on(top), on(top)]), both(top));
}

/// A path has no equations for a node that slides; it would have answered as if the node were fixed.
#[test]
fn a_path_refuses_what_slides_and_a_first_step_of_nothing() {
    let body = body(ElementKind::Quad9);
    let model = &body.model;
    let mut supports = fixed(model);
    let node = face(model.mesh(), 1, 1.0)[1];
    supports.sliding.push(Sliding {
        node,
        surface: sphere(1.0),
        force_ratio: 0.0,
    });
    let refused = Path::new(model, supports, 0.1).unwrap_err();
    assert_eq!(refused, Error::from(Mismatch::CannotSlide { node }));
    for first in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = Path::new(model, fixed(model), first).unwrap_err();
        assert!(matches!(
            refused,
            Error::Mismatch(Mismatch::FirstStepOutOfRange { .. })
        ));
    }
}

/// A component beyond those of a node was that of the next node: the wrong row, and no panic.
#[test]
fn only_components_that_exist_are_fixed() {
    for kind in KINDS {
        let mut body = body(kind);
        let (nodes, dimension) = (body.model.mesh().nodes.len(), body.model.dimension());
        let supports = fixed(&body.model).fix(&body.model, [2], dimension, 0.0);
        let refused = Mismatch::ComponentOutOfRange {
            axis: dimension,
            node: 2,
            dimension,
        };
        assert_eq!(refused_by_all(&mut body, &supports), refused);
        let supports = fixed(&body.model).fix(&body.model, [0, nodes], 0, 0.0);
        let found = refused_by_all(&mut body, &supports);
        assert!(matches!(found, Mismatch::NodeBeyondMesh { node, .. } if node == nodes));
    }
}

#[test]
fn lists_of_another_model_are_refused() {
    let mut small = body(ElementKind::Quad9);
    let law = Arc::new(LinearElastic::new(1.0, 0.3).unwrap());
    let large = Body::new(block(ElementKind::Quad9, 2, 0.0), law, Formulation::Mixed);
    let load = vec![0.0; large.model.size()];
    let wrong = fixed(&small.model).load(&load);
    let others = [fixed(&large.model), wrong];
    for supports in &others {
        let found = refused_by_all(&mut small, supports);
        assert!(matches!(found, Mismatch::WrongLength { .. }), "{found}");
    }
    let model = &small.model;
    let supports = fixed(model);
    let mut state = FiniteElementState::at_rest(&large.model);
    let found = equilibrate(model, &supports, &mut state, &mut small.workspace);
    assert!(matches!(
        found,
        Err(Error::Mismatch(Mismatch::WrongLength { .. }))
    ));
    let mut workspace = FiniteElementWorkspace::new(&large.model).unwrap();
    let found = equilibrate(model, &supports, &mut small.state, &mut workspace);
    assert!(matches!(
        found,
        Err(Error::Mismatch(Mismatch::WrongLength { .. }))
    ));
    let workspace = &mut small.workspace;
    let mut system = LinearSystem::assemble(model, &supports, &small.state, workspace).unwrap();
    system.factor().unwrap();
    let found = system.solve(&mut [0.0; 3]);
    assert!(matches!(
        found,
        Err(Error::Mismatch(Mismatch::WrongLength { found: 3, .. }))
    ));
}

#[test]
fn meshes_without_an_element_or_with_a_part_of_one_are_refused() {
    let law = Arc::new(LinearElastic::new(1.0, 0.3).unwrap());
    let made = |mesh: ElementMesh| {
        FiniteElementModel::new(mesh, law.clone(), Formulation::Mixed).map(drop)
    };
    for (columns, rows) in [
        (&[][..], &[][..]),
        (&[0.0], &[0.0, 1.0]),
        (&[0.0, 1.0], &[]),
    ] {
        let none = ElementMesh::grid(columns, rows, |r, z| [r, z]);
        assert_eq!(made(none), Err(Error::NoElements));
    }
    for kind in KINDS {
        let mut cut_off = block(kind, 1, 0.0);
        cut_off.elements.pop();
        let found = made(cut_off);
        assert!(
            matches!(found, Err(Error::Mismatch(Mismatch::WrongLength { .. }))),
            "{kind:?}"
        );
    }
}

#[test]
fn lines_under_a_punch_meet_and_ascend() {
    let good = PunchedLines {
        around: 1,
        inside: vec![0.5, 1.0],
        outside: vec![1.0, 2.0],
        beyond: [vec![2.0, 4.0], vec![2.0, 4.0]],
        heights: vec![0.0, 1.0],
    };
    let place = |x: f64, y: f64, z: f64| Vec3::new(x, y, z);
    assert!(good.body(place).is_ok());
    assert!(good.split(0).body(place).is_ok());
    let spoil: [fn(&mut PunchedLines); 7] = [
        |lines| lines.around = 0,
        |lines| lines.inside.clear(),
        |lines| lines.inside[0] = 0.0,
        |lines| lines.outside[0] = 1.1,
        |lines| lines.beyond[1].truncate(1),
        |lines| lines.heights.reverse(),
        |lines| lines.heights[1] = f64::NAN,
    ];
    for (k, spoil) in spoil.iter().enumerate() {
        let mut lines = good.clone();
        spoil(&mut lines);
        let found = lines.body(place).map(drop);
        assert!(
            matches!(
                found,
                Err(Error::Mismatch(Mismatch::PunchedLinesOutOfOrder { .. }))
            ),
            "{k}"
        );
    }
}

/// A mesh whose lines never end was made until the memory was full.
#[test]
fn sizes_that_no_mesh_has_are_refused() {
    let law = LinearElastic::new(1.0, 0.3).unwrap();
    let hemisphere = HemisphereProblem {
        radius: 0.05,
        patch_radius: 0.01,
        patch: Patch::Slip,
        law,
        depth: 1e-3,
    };
    let ball = |radius| HalfBall {
        radius,
        patch: Patch::Slip,
        law,
    };
    for edge in [0.0, -0.1, 1.5, f64::NAN] {
        let found = [
            hemisphere.solve_on(edge, 0).map(drop),
            ball(10.0).stiffness(edge, 0).map(drop),
        ];
        for found in found {
            assert!(matches!(
                found,
                Err(Error::Mismatch(Mismatch::ElementSizeOutOfRange { .. }))
            ));
        }
    }
    for radius in [0.0, 2.9, f64::NAN, f64::INFINITY] {
        let found = ball(radius).stiffness(0.2, 0);
        assert!(matches!(
            found,
            Err(Error::Mismatch(Mismatch::HalfBallTooSmall { .. }))
        ));
    }
    let endless = IndentationSettings {
        block: Block {
            radius: f64::INFINITY,
            height: 0.1,
            base: Base::Bonded,
        },
        indenter: Indenter {
            shape: IndenterShape::Sphere,
            radius: 1e-3,
            face: FrictionLaw::Bonded,
        },
        law: Arc::new(law),
        prony: PronySeries::default(),
        deepest: 1e-3,
        halvings: 0,
    };
    let found = IndentationRun::new(&endless).map(drop);
    assert!(matches!(found, Err(Error::BlockTooSmall { .. })));
}

/// Of both solvers of a response, none of which may begin its first large matrix.
#[test]
fn triangles_that_are_none_or_out_of_order_are_refused_at_once() {
    let solid = Held::organ(Organ::Kidney, 200, 0.45);
    let triangles = solid.surface.mesh().triangles().len();
    let refused = |held: &[TriangleId], touchable: &[TriangleId], expected: Error| {
        let mut progress = |_: Progress| -> ControlFlow<()> { panic!("work began") };
        let boundary = BoundaryProblem {
            surface: &solid.surface,
            poissons_ratio: 0.45,
            fixed: held,
            touchable,
        };
        let condensed = CondensedProblem {
            surface: &solid.surface,
            poissons_ratio: 0.45,
            fixed: held,
            touchable,
            edge: 0.01,
            regions: None,
        };
        let memory = usize::MAX;
        let found = boundary.solve::<f32>(memory, &mut progress).unwrap_err();
        assert_eq!(found, expected);
        let found = condensed.solve::<f32>(memory, &mut progress).unwrap_err();
        assert_eq!(found, expected);
        assert!(found.to_string().contains("; "), "{found}");
    };
    let (held, free) = (&solid.held[..], &solid.free[..3]);
    let stray = [TriangleId(triangles as u32)];
    let out_of_range = |what| Error::TriangleOutOfRange {
        what,
        triangle: triangles,
        triangles,
    };
    refused(&[held, &stray].concat(), free, out_of_range("fixed"));
    refused(held, &[free, &stray].concat(), out_of_range("touchable"));
    refused(held, &[], Error::NothingTouchable);
    for wrong in [[free[1], free[0]], [free[0], free[0]]] {
        let expected = Error::TouchableNotAscending {
            triangle: wrong[1].index(),
            before: wrong[0].index(),
        };
        refused(held, &wrong, expected);
    }
    let mut progress = |_| ControlFlow::Continue(());
    for edge in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let problem = CondensedProblem {
            surface: &solid.surface,
            poissons_ratio: 0.45,
            fixed: held,
            touchable: free,
            edge,
            regions: None,
        };
        let found = problem.solve::<f32>(usize::MAX, &mut progress);
        assert!(matches!(found, Err(Error::NotALength { .. })), "{edge}");
    }
}

#[test]
fn a_tip_is_put_on_the_surface_of_its_response() {
    let solid = Held::organ(Organ::Kidney, 200, 0.45);
    let response = solid.response::<f32>(&solid.free[..3]);
    let other = Held::organ(Organ::Kidney, 400, 0.45);
    let found = TipField::new(&response, &other.surface, 1e-3);
    assert!(matches!(found, Err(Error::OtherSurface { .. })));
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let found = TipField::new(&response, &solid.surface, radius);
        assert!(matches!(found, Err(Error::NotALength { .. })));
    }
    let stray = TriangleId(solid.surface.mesh().triangles().len() as u32);
    assert_eq!(TouchableTriangle::of(&solid.surface, stray), None);
    let moved = [MovedTriangle {
        triangle: TouchId(3),
        displacement: Vec3::z(),
    }];
    let contact = PatchContact {
        friction: Friction::Bonded,
        reciprocity: Reciprocity::Imposed,
        youngs_modulus: 1e4,
    };
    let mut workspace = PatchWorkspace::new(1);
    assert!(response.press(&moved, &contact, &mut workspace).is_none());
}

/// Numbers of a damaged file whose product no computer can hold.
#[test]
fn a_response_of_too_many_triangles_is_refused() {
    let solid = Held::organ(Organ::Kidney, 200, 0.45);
    let sound = solid.response::<f32>(&solid.free[..3]);
    for triangles in [usize::MAX, usize::MAX / 3, usize::MAX / 27] {
        let parts = ResponseParts {
            triangles,
            ..sound.parts().clone()
        };
        let found = SurfaceResponse::new(parts);
        assert!(matches!(found, Err(Error::InvalidResponse { .. })));
    }
}
