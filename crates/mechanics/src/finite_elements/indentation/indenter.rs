/// What a surface does that touches tissue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Grip {
    /// Tissue stays where it was first touched.
    Stick,
    /// Tissue slides without friction.
    Slide,
}

/// What the side of a flat punch does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Touches, with this grip.
    Touches(Grip),
    /// Is not there: right only until tissue would enter the punch.
    Absent,
}

/// The part of an indenter that meets the tissue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IndenterShape {
    /// The flat end of a cylinder, with a sharp edge.
    Flat {
        /// What its side does.
        side: Side,
    },
    /// A sphere.
    Sphere,
}

/// A rigid indenter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Indenter {
    /// Its shape.
    pub shape: IndenterShape,
    /// Radius of the cylinder or the sphere [m].
    pub radius: f64,
    /// What its face, or the sphere, does.
    pub face: Grip,
}
