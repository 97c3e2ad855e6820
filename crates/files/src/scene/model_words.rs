use crate::words::words;

words! {
    /// How the organ is moved.
    pub enum ModelKind {
        /// Finite spheres around each tool.
        Local = "local",
        /// The response of the whole organ, solved beforehand, with local enhancement.
        Hybrid = "hybrid",
        /// The whole organ at large deformation, solved anew in every step.
        Nonlinear = "nonlinear",
    }
}

words! {
    /// How the hybrid model's response of the whole organ is solved.
    pub enum ResponseMethod {
        /// By finite elements where walls are too thin for boundary elements, else by these.
        Automatic = "automatic",
        /// By boundary elements.
        BoundaryElements = "boundary_elements",
        /// By finite elements, condensed to the surface.
        FiniteElements = "finite_elements",
    }
}

words! {
    /// The form of the equations of the finite spheres.
    pub enum Form {
        /// Integrated over the neighbourhood.
        Weak = "weak",
        /// Collocated at the particles.
        Strong = "strong",
    }
}

words! {
    /// Where the particles of the finite spheres stand.
    pub enum Placement {
        /// On a regular template around the tool.
        Template = "template",
        /// On the triangles of the mesh, as the source places them.
        Source = "source",
    }
}

words! {
    /// What makes a force of the finite spheres' solution.
    pub enum Calibration {
        /// Constants fitted to half-spaces and hemispheres.
        Fitted = "fitted",
        /// Nothing but the particles and where the organ is held.
        None = "none",
    }
}

words! {
    /// How the equations of the finite spheres are solved.
    pub enum Solver {
        /// Factored.
        Direct = "direct",
        /// By GMRES.
        Gmres = "gmres",
    }
}

words! {
    /// When the equations of the finite spheres are put together.
    pub enum Assembly {
        /// Anew in every step.
        EveryStep = "every_step",
        /// Once, for a template that stays the same; only with `placement = "template"`.
        Reused = "reused",
    }
}

words! {
    /// The area that is refined around a contact.
    pub enum EnhancementArea {
        /// Nothing is refined.
        None = "none",
        /// The triangles that share an edge with the touched one.
        Edge = "edge",
        /// The triangles that share a vertex with the touched one.
        Vertex = "vertex",
    }
}

words! {
    /// How displacements are spread over the refined area.
    pub enum Smoothing {
        /// They are not.
        None = "none",
        /// Shepard's method: a mean, weighted by distance.
        Shepard = "shepard",
        /// Moving least squares.
        MovingLeastSquares = "moving_least_squares",
    }
}

words! {
    /// What the model hands over to the servo loop between its steps.
    pub enum HandOver {
        /// A force with its local stiffness.
        LocalModel = "local_model",
        /// A line through the last two forces.
        Linear = "linear",
        /// The last force.
        Hold = "hold",
    }
}

/// The number of points at which a finite sphere's neighbourhood is integrated: 130, 415 or 957.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum IntegrationPoints {
    /// 130 points.
    Few,
    /// 415 points.
    Standard,
    /// 957 points.
    Many,
}
