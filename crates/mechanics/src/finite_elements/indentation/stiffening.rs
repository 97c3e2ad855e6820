mod linear_sphere;
mod neo_hookean;

use std::sync::Arc;

use super::indenter::{Indenter, IndenterShape, Side};
use super::mesh::{Base, Block};
use super::run::{IndentationRun, IndentationSettings};
use crate::contact::{Friction, Tip, half_space_stiffness, hertz_force};
use crate::{Error, IndentationCurve, Law, LinearElastic, Material, PronySeries, Strain};

/// Ratio of the force of a half-space of some tissue at depth to the closed form at small strain, r(s/a) = F(s)/F₀(s),
/// the same for every size of the tip and every modulus. Under a sphere that differs from 1 in linear tissue, too, for
/// Hertz's surface is a paraboloid.
#[derive(Debug, Clone, PartialEq)]
pub struct Stiffening {
    /// x r(x) over x = s/a, both [-]; none where r = 1.
    equivalent: Option<IndentationCurve>,
}

/// Depths [in radii] at which the force is found, after the first, which gives the law at rest.
const FIRST: f64 = 0.01;
const DEPTHS: [f64; 16] = [
    0.2, 0.4, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0,
];
/// Radius and height of the block in radii of the tip [-].
const BLOCK: f64 = 50.0;

impl Stiffening {
    /// Of a tissue that is linear at every depth, with this Poisson's ratio [-]. Known to a depth of one radius of a
    /// sphere.
    pub fn linear(tip: Tip, bond: Friction, poissons_ratio: f64) -> Self {
        Self {
            equivalent: match tip {
                Tip::Flat { .. } => None,
                Tip::Sphere { .. } => Some(linear_sphere::curve(poissons_ratio, bond)),
            },
        }
    }

    /// Of `tissue` under `tip`, from finite elements on the coarsest mesh (seconds); `at_step` receives the part done
    /// [-]. It ends where no equilibrium is found, and where the force falls: tissue that slides has closed over a
    /// sphere then, which a tip on a shaft prevents.
    ///
    /// # Errors
    /// When the tissue cannot be indented at all.
    pub fn of(
        tissue: &Material,
        tip: Tip,
        bond: Friction,
        at_step: &mut dyn FnMut(f64),
    ) -> Result<Self, Error> {
        if tissue.law.volume().strain == Strain::Small {
            return Ok(Self::linear(tip, bond, tissue.at_rest.poissons_ratio()));
        }
        let at_rest = &tissue.at_rest;
        let flat = Tip::Flat { radius: 1.0 };
        let rest = press(&tissue.law, flat, bond)?.press(0.0, FIRST, |_| ())?;
        // Compliance of the block less that of a half-space: far from the tip, so the same for both.
        let structural = FIRST / rest.force - 1.0 / half_space_stiffness(at_rest, 1.0, bond);
        let tip = of_unit_radius(tip);
        let mut run = press(&tissue.law, tip, bond)?;
        let mut equivalent = IndentationCurve::through(&[FIRST], &[FIRST]);
        let deepest = DEPTHS[DEPTHS.len() - 1];
        let mut before = 0.0;
        for depth in DEPTHS {
            let point = match run.press(0.0, depth, |_| ()) {
                Ok(point) if point.force > before => point,
                _ => break,
            };
            before = point.force;
            let s = depth - structural * point.force;
            equivalent.extend(s, s * point.force / at_small_strain(at_rest, tip, bond, s));
            at_step(depth / deepest);
        }
        Ok(Self {
            equivalent: Some(equivalent),
        })
    }

    /// Of incompressible neo-Hookean tissue, the same for every modulus.
    pub fn neo_hookean(tip: Tip, bond: Friction) -> Self {
        let (depths, equivalent): (Vec<_>, Vec<_>) =
            neo_hookean::points(tip, bond).iter().copied().unzip();
        Self {
            equivalent: Some(IndentationCurve::through(&depths, &equivalent)),
        }
    }

    /// Under a sphere on layers: each of the areas, which ascend, touches here at a depth in radii [-], on the layers so many times
    /// deeper, with so many times the force [-]. Compared with Hertz the area counts, not the depth: layers that bend under the tip
    /// go down with it.
    pub fn on_layers(&self, areas: impl Iterator<Item = (f64, [f64; 2])>) -> Self {
        let points = areas.map(|(x, [deeper, stronger])| {
            let force = self.ratio(x).0 * x.powf(1.5) * stronger;
            let depth = deeper * x;
            (depth, force / depth.sqrt())
        });
        let known = self.deepest();
        let (depths, forces): (Vec<_>, Vec<_>) = points.take_while(|(x, _)| *x <= known).unzip();
        Self {
            equivalent: Some(IndentationCurve::through(&depths, &forces)),
        }
    }

    /// Depth in radii of the tip down to which it is known [-]; beyond, force goes on along its tangent.
    pub fn deepest(&self) -> f64 {
        self.equivalent
            .as_ref()
            .map_or(f64::INFINITY, IndentationCurve::deepest)
    }

    /// r and dr/dx [-] at the depth `x` in radii of the tip [-].
    pub fn ratio(&self, x: f64) -> (f64, f64) {
        match &self.equivalent {
            Some(curve) if x > 0.0 => {
                let ratio = curve.force(x) / x;
                (ratio, (curve.stiffness(x) - ratio) / x)
            }
            _ => (1.0, 0.0),
        }
    }
}

fn of_unit_radius(tip: Tip) -> Tip {
    match tip {
        Tip::Flat { .. } => Tip::Flat { radius: 1.0 },
        Tip::Sphere { .. } => Tip::Sphere { radius: 1.0 },
    }
}

fn press(law: &Arc<dyn Law>, tip: Tip, face: Friction) -> Result<IndentationRun, Error> {
    let shape = match tip {
        Tip::Flat { .. } => IndenterShape::Flat {
            side: Side::Touches(face.into()),
        },
        Tip::Sphere { .. } => IndenterShape::Sphere,
    };
    IndentationRun::new(&IndentationSettings {
        block: Block {
            radius: BLOCK,
            height: BLOCK,
            base: Base::Bonded,
        },
        indenter: Indenter {
            shape,
            radius: 1.0,
            face: face.into(),
        },
        law: law.clone(),
        prony: PronySeries::default(),
        deepest: 1.0,
        halvings: 0,
    })
}

/// F₀ [N] at `depth` [m] of a tip of unit radius.
fn at_small_strain(law: &LinearElastic, tip: Tip, bond: Friction, depth: f64) -> f64 {
    match tip {
        Tip::Flat { radius } => half_space_stiffness(law, radius, bond) * depth,
        Tip::Sphere { radius } => hertz_force(law, radius, depth),
    }
}
