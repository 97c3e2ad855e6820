//! An organ of any shape under an indenter: its compliance in excess of a large piece.
//!
//! Far from an indenter strain is small, however large it is beneath it. So an organ differs from a large piece of the same
//! tissue by a compliance in series,
//!   d = d_piece + γ F/G,
//! and the curve of the piece becomes that of the organ when its depths are moved, of every law and every shape. γ [1/m] is
//! the difference of two compliances at small strain: that of the organ under a patch of the contact's size, by
//! tetrahedra that fill its mesh, and that of the piece by axisymmetric elements. Both patches are bonded under any indenter:
//! without friction incompressible tissue is as stiff. The tetrahedra are too stiff at the edge
//! of the patch; the same patch on a cube, whose compliance is known, corrects that.
//!
//! Under a sphere or a cone the curvature of the organ moves the depths as well (`curved_contact.rs`), by the mean of what
//! is fitted to patches of the surface a little wider than the contact.
//!
//! *How we know*: `organ::…`: a hemisphere by axisymmetric elements; runs of the whole organ at finite strain.
//!
//! *Limits*: where the organ is hardly thicker or wider than the contact, or bends as a whole by much more than the depth, what is far from the
//! indenter is strained too: [`FarField::share`] says how much of the depth it is.

use std::sync::Arc;

use palpate_files::scene::Region;
use palpate_geometry::{PatchField, Surface, TetrahedronMesh, TriangleId, closest_on_triangle};
use palpate_mechanics::contact::{Friction, FrictionLaw};
use palpate_mechanics::finite_elements::indentation::{
    Base, Block, IndentationProblem, Indenter, IndenterShape, Side, solve,
};
use palpate_mechanics::finite_elements::solid::{
    Body as Solid, MovedPatch, SolidProblem, solve_at,
};
use palpate_mechanics::{LinearElastic, Vec3};

use super::body::Body;
use super::curved_contact::CurvedContact;
use crate::Error;

/// An organ and the location of the indenter.
#[derive(Debug, Clone)]
pub struct Organ {
    /// Its surface.
    pub surface: Surface,
    /// Where it is fixed: in the triangles whose centroid lies in this region.
    pub fixed: Region,
    /// Where the indenter touches it [m]; the nearest point of the surface is taken.
    pub location: Vec3,
}

/// Compliance of an organ in excess of a large piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FarField {
    /// γ: its compliance in series times the shear modulus [1/m]; below zero where it is stiffer.
    pub compliance: f64,
    /// Part of the depth that it takes at small strain [-].
    pub share: f64,
    /// Part of the force that the elements may be off, and that what is far is strained by more than a little [-].
    pub error: f64,
    /// Effect of the organ's curvature on the depth under a sphere or a cone.
    pub(super) contact: Option<CurvedContact>,
}

/// Poisson's ratio of tissue at small strain [-], and Young's modulus for a shear modulus of one.
const RATIO: f64 = 0.4999;
const YOUNG: f64 = 2.0 * (1.0 + RATIO);
/// Depth over the radius of the patch [-]; at small strain the force grows with it.
const DEPTH: f64 = 0.01;
/// Half the edge of the cube that corrects the tetrahedra, over the radius of the patch [-], and its cells along an edge.
const HALF: f64 = 10.0;
const CELLS: usize = 8;
/// Relative accuracy of axisymmetric elements [-].
const ACCURACY: f64 = 0.003;
/// Halvings of the two meshes.
const MESHES: [i32; 2] = [-1, 0];
/// Of the first power of the size of the elements the cube takes away the error; with the second, a third of the difference
/// between both meshes is left beyond the finer one [-].
const BEYOND: f64 = 1.0 / 3.0;
/// Part of that difference that remains as error [-], and the least error [-].
const LEFT: f64 = 0.5;
const LEAST: f64 = 0.005;
/// Error of the force over the share of the depth, because what is far is taken for linear [-]: on a hemisphere, under
/// punches of a tenth and a twentieth of its radius that go in by 1.5 and 2 radii, up to 2.2 % of 7.7 % and 0.9 % of 3.8 %.
const FINITE: f64 = 0.25;
/// Radii of the patches whose curvature is taken, over that of the contact [-]; the second shows how it changes.
const PATCHES: [f64; 2] = [1.5, 2.5];

impl Organ {
    /// Its compliance in excess of the large piece `body`, which is pressed to `deepest` [m].
    ///
    /// # Errors
    /// When the body is a layer or a tube; when the place is not on the surface, or is fixed; when the organ is too hollow for the indenter; or see [`solve_at`].
    pub fn far_field(&self, body: &Body, deepest: f64) -> Result<FarField, Error> {
        let Body::Block { block, indenter } = body else {
            return Err(Error::OrganBody);
        };
        let radius = indenter.contact_radius(deepest);
        let place = self.place(indenter.radius, radius)?;
        let (center, inward) = (place.center, place.inward);
        let (contact, of_curvature) = self.contact(indenter, &place, radius, deepest)?;
        let half = HALF * radius;
        let law = Arc::new(LinearElastic::new(YOUNG, RATIO)?);
        let under = |center: Vec3, inward: Vec3| MovedPatch {
            center,
            radius,
            displacement: DEPTH * radius * inward,
            friction: Friction::Bonded,
        };
        let organ = SolidProblem {
            patch: Some(under(center, inward)),
            ..SolidProblem::new(
                Solid::Surface(self.surface.clone()),
                self.fixed.clone(),
                law.clone(),
            )
        };
        let corner = Vec3::repeat(half);
        let mesh = TetrahedronMesh::block(-corner, corner, [CELLS; 3]);
        let cube = SolidProblem {
            body: Solid::Volume(mesh.expect("a cube has a volume")),
            anchor: below(-0.999 * half),
            patch: Some(under(half * Vec3::z(), -Vec3::z())),
            ..organ.clone()
        };
        let piece = |block: Block| -> Result<f64, Error> {
            let shape = IndenterShape::Flat { side: Side::Absent };
            let problem = IndentationProblem {
                block,
                indenter: Indenter {
                    shape,
                    radius,
                    face: FrictionLaw::Bonded,
                },
                law: law.clone(),
            };
            let depth = DEPTH * radius;
            let found = solve(&problem, &[depth], ACCURACY, &mut |_| ())?;
            Ok(depth / found.answer.points[0].force)
        };
        // A cylinder with the cube's height and volume.
        let like_cube = piece(Block {
            radius: 2.0 * half / std::f64::consts::PI.sqrt(),
            height: 2.0 * half,
            base: Base::Bonded,
        })?;
        let compliance = |problem: &SolidProblem, halvings: i32| -> Result<f64, Error> {
            let found = solve_at(problem, halvings, &mut |_| ())?;
            Ok(DEPTH * radius / found.force_along)
        };
        let [mut coarse, mut fine] = [0.0; 2];
        for (halvings, found) in MESHES.into_iter().zip([&mut coarse, &mut fine]) {
            let too_stiff = compliance(&cube, halvings)? / like_cube;
            *found = compliance(&organ, halvings)? / too_stiff;
        }
        let whole = fine + BEYOND * (fine - coarse);
        let further = whole - piece(*block)?;
        let share = further / whole;
        let elements = (LEFT * (fine / coarse - 1.0).abs()).max(LEAST);
        Ok(FarField {
            compliance: further,
            share,
            error: elements + FINITE * share.abs() + of_curvature,
            contact,
        })
    }

    /// Effect of the curvature under a round indenter, and its relative error of the force [-].
    fn contact(
        &self,
        indenter: &Indenter,
        place: &Place,
        radius: f64,
        deepest: f64,
    ) -> Result<(Option<CurvedContact>, f64), Error> {
        let of_patch = |size: f64| {
            let field = PatchField::new(&self.surface, size * radius);
            let patch = field.at(&self.surface, place.triangle, &place.barycentric);
            CurvedContact::of(indenter, patch.principal_curvatures(), radius)
        };
        let [Some(near), Some(wide)] = [of_patch(PATCHES[0])?, of_patch(PATCHES[1])?] else {
            return Ok((None, 0.0));
        };
        let moved = near.depth(deepest) / deepest - 1.0;
        let changes = wide.depth(deepest) / deepest - 1.0 - moved;
        let error = near.exponent() * (FINITE * moved.abs() + changes.abs());
        Ok((Some(near), error))
    }

    /// The point of the surface that is nearest to the place, if within `reach` [m], and the mean direction into the organ
    /// within `radius` [m] of it.
    fn place(&self, reach: f64, radius: f64) -> Result<Place, Error> {
        let mesh = self.surface.mesh();
        let nearest =
            |triangle: TriangleId, to: &Vec3| closest_on_triangle(&mesh.positions(triangle), to);
        let all = mesh.triangle_ids();
        let points = all.map(|triangle| (triangle, nearest(triangle, &self.location)));
        let from = |point: &Vec3| (point - self.location).norm();
        let (triangle, point) = points
            .min_by(|a, b| from(&a.1.position).total_cmp(&from(&b.1.position)))
            .ok_or(Error::NoContactForce)?;
        let center = point.position;
        if from(&center) > reach {
            return Err(Error::OffMesh {
                distance: from(&center),
                nearest: center.into(),
            });
        }
        let touched =
            |triangle: &TriangleId| (nearest(*triangle, &center).position - center).norm() < radius;
        let under = mesh.triangle_ids().filter(touched);
        let inward = under.map(|triangle| -mesh.area_vector(triangle));
        let inward: Vec3 = inward.sum();
        let inward = inward.try_normalize(0.0).ok_or(Error::NoContactForce)?;
        if self.fixed.contains(center.into()) {
            return Err(Error::PressedWhereFixed);
        }
        Ok(Place {
            triangle,
            barycentric: point.barycentric,
            center,
            inward,
        })
    }
}

/// Where an indenter touches an organ.
struct Place {
    triangle: TriangleId,
    barycentric: [f64; 3],
    center: Vec3,
    inward: Vec3,
}

/// The region below a height [m].
fn below(height: f64) -> Region {
    Region {
        planes: vec![palpate_files::scene::RegionPlane {
            point_m: [0.0, 0.0, height],
            normal: [0.0, 0.0, 1.0],
        }],
        ..Region::default()
    }
}
