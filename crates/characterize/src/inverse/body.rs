use palpate_files::recording::{
    IndenterFriction, IndenterShape as RecordedShape, RecordingHeader, Specimen, Support,
};
use palpate_mechanics::contact::{Friction, FrictionLaw};
use palpate_mechanics::finite_elements::indentation::{Base, Block, Indenter, IndenterShape, Side};
use palpate_mechanics::finite_elements::tube::Tube;

use super::law::CandidateLaw;
use crate::Error;

/// The indented body and its indenter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Body {
    /// A piece of a solid organ, indented in its middle.
    Block {
        /// The piece.
        block: Block,
        /// The indenter.
        indenter: Indenter,
    },
    /// A layer of tissue on an elastic base, indented in its middle.
    Layer {
        /// The layer.
        block: Block,
        /// The indenter.
        indenter: Indenter,
        /// The base that it is bonded to.
        base: LayerBase,
    },
    /// A hollow organ between fixed ends, with a flat indenter on its side.
    Tube {
        /// The organ.
        tube: Tube,
        /// Radius of the indenter [m].
        radius: f64,
        /// Whether tissue sticks to it.
        face: Friction,
        /// Pressure inside [Pa].
        pressure: f64,
    },
}

/// The elastic base of a bonded layer. It relaxes as the layer does, and lies on a rigid plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerBase {
    /// Thickness [m].
    pub thickness: f64,
    /// Stiffness.
    pub modulus: BaseModulus,
    /// Standard error of that, over it [-].
    pub error: f64,
}

/// How stiff a base is: a neo-Hookean one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BaseModulus {
    /// Its instantaneous Young's modulus [Pa].
    Young(f64),
    /// Its modulus at rest over that of the layer [-].
    Ratio(f64),
}

impl LayerBase {
    /// Its shear modulus at rest over that of a layer of `law` with this `modulus` [Pa] [-]; one under an infinite modulus,
    /// which stands for one that is not known yet.
    pub(super) fn stiffness(&self, law: CandidateLaw, modulus: f64) -> f64 {
        match self.modulus {
            BaseModulus::Young(_) if modulus.is_infinite() => 1.0,
            BaseModulus::Young(young) => young / (3.0 * law.shear() * modulus),
            BaseModulus::Ratio(ratio) => ratio,
        }
    }
}

/// Radius and thickness of a specimen that states neither, in radii of the contact [-]: as the source's cube of
/// 100 mm under its punch of 1 mm, with the same cross-section (figure 6-8).
pub const BLOCK: [f64; 2] = [56.42, 100.0];
/// Radius of a specimen that states its thickness alone, over that [-]: at its rim the strain by the indenter is negligible.
const WIDE: f64 = 5.0;
/// Least radius of a layer on a base that states its thickness alone, over that [-]: a layer that is a hundred times as
/// stiff spreads a load over ∛100 of its thickness.
const WIDE_ON_BASE: f64 = 25.0;
/// Lengths that differ by less than this part are one [-]: rounding of a file's numbers.
const ALIKE: f64 = 1e-9;

impl Body {
    /// A large piece of a solid organ under a flat punch that tissue sticks to, on its face and its side.
    pub fn under_punch(radius: f64) -> Self {
        let shape = IndenterShape::Flat {
            side: Side::Touches(FrictionLaw::Bonded),
        };
        Self::large(Indenter {
            shape,
            radius,
            face: FrictionLaw::Bonded,
        })
    }

    /// A large piece of a solid organ under a sphere without friction.
    pub fn under_sphere(radius: f64) -> Self {
        Self::large(Indenter {
            shape: IndenterShape::Sphere,
            radius,
            face: FrictionLaw::Frictionless,
        })
    }

    /// A large piece of a solid organ under a cone without friction that goes in to `deepest` [m], with `half_angle`
    /// [rad] between its axis and its side.
    pub fn under_cone(half_angle: f64, deepest: f64) -> Self {
        Self::large(Indenter {
            shape: IndenterShape::Cone {
                half_angle,
                apex_radius: 0.0,
            },
            radius: deepest * half_angle.tan(),
            face: FrictionLaw::Frictionless,
        })
    }

    fn large(indenter: Indenter) -> Self {
        let block = Block {
            radius: BLOCK[0] * indenter.radius,
            height: BLOCK[1] * indenter.radius,
            base: Base::Bonded,
        };
        Self::Block { block, indenter }
    }

    /// The body that the header of a recording describes, indented to `deepest` [m]. A solid specimen of unstated
    /// size is large.
    ///
    /// # Errors
    /// When the indenter, a tube or the base of a layer is not known, or the specimen is thinner than it was pressed or
    /// narrower than the indenter.
    pub fn of(header: &RecordingHeader, deepest: f64) -> Result<Self, Error> {
        let known = |value: Option<f64>, key| value.ok_or(Error::Unknown { key });
        let radius = || known(header.indenter_radius_m, "indenter_radius_m");
        let shape = header.indenter_shape.unwrap_or(RecordedShape::Flat);
        let large = match (header.specimen, shape) {
            (Some(Specimen::Tube), RecordedShape::Flat) => return tube(header, radius()?),
            (Some(Specimen::Tube), _) => return Err(Error::TubeIndenter),
            (_, RecordedShape::Flat) => Self::under_punch(radius()?),
            (_, RecordedShape::Sphere) => Self::under_sphere(radius()?),
            (_, RecordedShape::Cone) => {
                let angle = known(header.indenter_half_angle_deg, "indenter_half_angle_deg")?;
                Self::under_cone(angle.to_radians(), deepest)
            }
        };
        large.with(friction(header)).cut_to(header, deepest)
    }

    /// The same under an indenter of this `friction`; as it is without one.
    fn with(mut self, friction: Option<Friction>) -> Self {
        if let (Self::Block { indenter, .. }, Some(friction)) = (&mut self, friction) {
            indenter.face = friction.into();
            if let IndenterShape::Flat { side } = &mut indenter.shape {
                *side = Side::Touches(friction.into());
            }
        }
        self
    }

    /// The same with the specimen's sizes that the header states.
    fn cut_to(self, header: &RecordingHeader, deepest: f64) -> Result<Self, Error> {
        let Self::Block {
            mut block,
            indenter,
        } = self
        else {
            return Ok(self);
        };
        let is_layer = header.specimen == Some(Specimen::Layer);
        if let Some(thickness) = header.thickness_m {
            let wide = if is_layer { WIDE_ON_BASE } else { WIDE };
            block.radius = block.radius.max(wide * thickness);
            block.height = thickness;
            if deepest >= thickness {
                return Err(Error::DeeperThanThick {
                    depth: deepest,
                    thickness,
                });
            }
        }
        // A square has the cross-section of a round specimen.
        let of_width = |width: f64| width / std::f64::consts::PI.sqrt();
        let width = header.specimen_width_m.map(of_width);
        if let Some(radius) = header.specimen_radius_m.or(width) {
            block.radius = radius;
            let least = indenter.contact_radius(deepest);
            if radius <= least {
                return Err(Error::Narrow { radius, least });
            }
        }
        if header.support == Some(Support::Lubricated) {
            block.base = Base::Lubricated;
        }
        if is_layer {
            let base = base(header, &indenter)?;
            return Ok(Self::Layer {
                block,
                indenter,
                base,
            });
        }
        Ok(Self::Block { block, indenter })
    }

    /// Radius of the indenter, or of what a cone touches at the depth that it was made for [m].
    pub fn radius(&self) -> f64 {
        match *self {
            Self::Block { indenter, .. } | Self::Layer { indenter, .. } => indenter.radius,
            Self::Tube { radius, .. } => radius,
        }
    }

    /// Whether it is the large piece under a punch whose forces are tabulated.
    pub(super) fn is_tabulated(&self) -> bool {
        let (Self::Block { block, indenter }, Self::Block { block: large, .. }) =
            (self, Self::under_punch(self.radius()))
        else {
            return false;
        };
        let alike = |a: f64, b: f64| (a - b).abs() <= ALIKE * b;
        let side = Side::Touches(FrictionLaw::Bonded);
        indenter.shape == IndenterShape::Flat { side }
            && indenter.face == FrictionLaw::Bonded
            && alike(block.radius, large.radius)
            && alike(block.height, large.height)
            && block.base == large.base
    }
}

/// Friction of the indenter, from a header.
fn friction(header: &RecordingHeader) -> Option<Friction> {
    header.indenter_friction.map(|own| match own {
        IndenterFriction::Bonded => Friction::Bonded,
        IndenterFriction::Frictionless => Friction::Frictionless,
    })
}

/// Base of a layer, from its header.
fn base(header: &RecordingHeader, indenter: &Indenter) -> Result<LayerBase, Error> {
    let unknown = |key| Error::Unknown { key };
    let layer = header.thickness_m.ok_or(unknown("thickness_m"))?;
    let young = header.base_modulus_pa.map(BaseModulus::Young);
    let modulus = young.or(header.base_modulus_ratio.map(BaseModulus::Ratio));
    // A block of these proportions is as good as a half-space.
    let large = BLOCK[1] * indenter.radius.max(WIDE_ON_BASE * layer / BLOCK[0]);
    Ok(LayerBase {
        thickness: header.base_thickness_m.unwrap_or(large),
        modulus: modulus.ok_or(unknown("base_modulus_pa"))?,
        error: header.base_modulus_error.unwrap_or(0.0),
    })
}

fn tube(header: &RecordingHeader, radius: f64) -> Result<Body, Error> {
    let known = |value: Option<f64>, key| value.ok_or(Error::Unknown { key });
    Ok(Body::Tube {
        tube: Tube {
            length: known(header.length_m, "length_m")?,
            inner_radius: known(header.inner_radius_m, "inner_radius_m")?,
            outer_radius: known(header.outer_radius_m, "outer_radius_m")?,
        },
        radius,
        face: friction(header).unwrap_or(Friction::Bonded),
        pressure: header.pressure_pa.unwrap_or(0.0),
    })
}
