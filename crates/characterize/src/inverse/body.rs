use palpate_mechanics::finite_elements::indentation::{Block, Grip, Indenter, IndenterShape, Side};
use palpate_mechanics::finite_elements::tube::Tube;

/// What was indented, and with what.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Body {
    /// A piece of a solid organ: small against the organ, large against the indenter.
    Block {
        /// The piece.
        block: Block,
        /// The indenter.
        indenter: Indenter,
    },
    /// A hollow organ between fixed ends, with a flat indenter on its side.
    Tube {
        /// The organ.
        tube: Tube,
        /// Radius of the indenter [m].
        radius: f64,
        /// Whether tissue sticks to it.
        face: Grip,
        /// Pressure inside [Pa].
        pressure: f64,
    },
}

/// Radius and height of a piece of tissue in radii of the indenter [-]: as the source's cube of 100 mm
/// under its punch of 1 mm, with the same cross-section (figure 6-8).
pub const BLOCK: [f64; 2] = [56.42, 100.0];

impl Body {
    /// A piece of a solid organ under a flat punch that tissue sticks to, on its face and its side.
    pub fn under_punch(radius: f64) -> Self {
        let shape = IndenterShape::Flat {
            side: Side::Touches(Grip::Stick),
        };
        Self::under(shape, radius, Grip::Stick)
    }

    /// A piece of a solid organ under a sphere without friction.
    pub fn under_sphere(radius: f64) -> Self {
        Self::under(IndenterShape::Sphere, radius, Grip::Slide)
    }

    fn under(shape: IndenterShape, radius: f64, face: Grip) -> Self {
        Self::Block {
            block: Block {
                radius: BLOCK[0] * radius,
                height: BLOCK[1] * radius,
            },
            indenter: Indenter {
                shape,
                radius,
                face,
            },
        }
    }

    /// Radius of the indenter [m].
    pub fn radius(&self) -> f64 {
        match *self {
            Self::Block { indenter, .. } => indenter.radius,
            Self::Tube { radius, .. } => radius,
        }
    }
}
