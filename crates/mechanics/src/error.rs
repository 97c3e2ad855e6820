mod is_input;

/// Errors of models and solvers.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// Young's modulus is not a positive number.
    #[error("Young's modulus is {youngs_modulus} Pa; give a positive number")]
    YoungsModulusOutOfRange {
        /// The value given [Pa].
        youngs_modulus: f64,
    },
    /// Poisson's ratio is that of no solid, or of an incompressible one.
    #[error(
        "Poisson's ratio is {poissons_ratio}; give one above -1 and below 0.5 (0.49 is nearly incompressible)"
    )]
    PoissonsRatioOutOfRange {
        /// The value given [-].
        poissons_ratio: f64,
    },
    /// C10 is not a positive number.
    #[error("C10 is {c10} Pa; give a positive number, half the shear modulus at rest")]
    NeoHookeanOutOfRange {
        /// The value given [Pa].
        c10: f64,
    },
    /// C10 + C01 is not a positive number.
    #[error(
        "C10 is {c10} Pa and C01 is {c01} Pa; give numbers whose sum, half the shear modulus at rest, is positive"
    )]
    MooneyRivlinOutOfRange {
        /// The value given [Pa].
        c10: f64,
        /// The value given [Pa].
        c01: f64,
    },
    /// γ is not a positive number, or α not above −1.
    #[error(
        "gamma is {gamma} Pa and alpha is {alpha}; give a positive gamma, the shear modulus at rest, and an alpha above -1"
    )]
    ExponentialOutOfRange {
        /// The value given [Pa].
        gamma: f64,
        /// The value given [-].
        alpha: f64,
    },
    /// The terms of Ogden's law are not one to three, or their moduli do not sum to a positive number.
    #[error(
        "Ogden's law has {order} terms whose mu sum to {shear} Pa; give one to three terms whose mu, the shear modulus at rest, sum to a positive number"
    )]
    OgdenOutOfRange {
        /// Number of terms.
        order: usize,
        /// Sum of the values of μ given [Pa].
        shear: f64,
    },
    /// The coefficients of a reduced polynomial are not one to three, or the first is not positive.
    #[error(
        "the reduced polynomial has {order} coefficients and C10 is {c10} Pa; give one to three finite coefficients, and a positive C10, half the shear modulus at rest"
    )]
    ReducedPolynomialOutOfRange {
        /// Number of coefficients.
        order: usize,
        /// The value of C10 given [Pa].
        c10: f64,
    },
    /// The bulk modulus is not a positive number.
    #[error(
        "the bulk modulus is {bulk_modulus} Pa; give a positive number, or make the law incompressible"
    )]
    BulkModulusOutOfRange {
        /// The value given [Pa].
        bulk_modulus: f64,
    },
    /// The relaxation function is none.
    #[error(
        "the Prony series has {terms} terms that sum to {sum}; give at most 8 with g >= 0 and tau > 0 whose g sum to less than 1"
    )]
    NoRelaxation {
        /// Sum of g [-].
        sum: f64,
        /// Number of terms.
        terms: usize,
    },
    /// Too many subdivisions of the triangles near a contact.
    #[error("{levels} levels of enhancement; give at most 6, which make 4096 triangles of one")]
    TooManyLevels {
        /// The number given.
        levels: usize,
    },
    /// Too few particles to fill two shells, or more than a step could ever solve.
    #[error("{particles} particles; give between 12 and 600 (34 is the source's number)")]
    ParticlesOutOfRange {
        /// The number given.
        particles: usize,
    },
    /// The particles do not determine the displacement.
    #[error(
        "{particles} particles in the {form} form do not determine the displacement at Poisson's ratio {poissons_ratio}; use the weak form or more particles"
    )]
    Undetermined {
        /// The number given.
        particles: usize,
        /// Weak or strong.
        form: &'static str,
        /// Poisson's ratio [-].
        poissons_ratio: f64,
    },
    /// The local model without calibration lacks something.
    #[error(
        "the local model without calibration does not have {asked}; ask for a tip that slips, the weak form, the template, every step and the direct solver, or for calibration = \"fitted\""
    )]
    NotWithoutCalibration {
        /// The missing feature.
        asked: &'static str,
    },
    /// An element names a node that does not exist.
    #[error("element {element} names a node beyond the {nodes} of the mesh")]
    NodeOutOfRange {
        /// The element's number, from 0.
        element: usize,
        /// How many nodes there are.
        nodes: usize,
    },
    /// A mesh without elements.
    #[error("the mesh has no elements; give at least one")]
    NoElements,
    /// An element has no volume or a negative one.
    #[error(
        "element {element} is inverted or has no volume; repair the mesh or number its nodes the other way round"
    )]
    InvertedElement {
        /// The element's number, from 0.
        element: usize,
    },
    /// Elements of displacements alone cannot be this incompressible.
    #[error(
        "elements without a pressure field lock at Poisson's ratio {poissons_ratio}; use mixed elements or at most 0.49"
    )]
    Locking {
        /// Poisson's ratio [-].
        poissons_ratio: f64,
    },
    /// The factors do not fit into memory.
    #[error("there is no memory for the factors of {unknowns} unknowns; use a coarser mesh")]
    NoMemoryForFactors {
        /// Number of unknowns.
        unknowns: usize,
    },
    /// The solution cannot be followed further.
    #[error(
        "no equilibrium was found beyond a depth of {:.4} mm ({failure}); give smaller depths", 1e3 * depth
    )]
    NoEquilibrium {
        /// The last depth that was reached [m].
        depth: f64,
        /// Why.
        failure: crate::finite_elements::Failure,
    },
    /// A path of equilibria ends.
    #[error(
        "no equilibrium was found beyond {factor} of the full load ({failure}); use a finer mesh or a smaller load"
    )]
    NoPath {
        /// The last part of the load that was reached [-].
        factor: f64,
        /// Why.
        failure: crate::finite_elements::Failure,
    },
    /// A tube without a length, a hole or a wall.
    #[error(
        "the tube is {length} m long with radii of {inner_radius} m and {outer_radius} m; give a positive length and 0 < inner < outer"
    )]
    TubeOutOfRange {
        /// Length [m].
        length: f64,
        /// Inner radius [m].
        inner_radius: f64,
        /// Outer radius [m].
        outer_radius: f64,
    },
    /// A pressure that would suck the tube flat, or none.
    #[error(
        "the pressure is {pressure} Pa; give zero or more, for a tube that is sucked in buckles out of round, which this model leaves out"
    )]
    PressureOutOfRange {
        /// The value given [Pa].
        pressure: f64,
    },
    /// No tube stands still under this pressure.
    #[error(
        "the tube balloons at {limit} Pa, below the {pressure} Pa asked for; lower the pressure or stiffen the tissue"
    )]
    LimitPointExceeded {
        /// The value given [Pa].
        pressure: f64,
        /// The greatest pressure of an equilibrium [Pa].
        limit: f64,
    },
    /// A block that an indenter cannot be pressed into.
    #[error(
        "a block of radius {radius} m and height {height} m under an indenter of radius {indenter} m; give positive lengths and a block wider than the indenter"
    )]
    BlockTooSmall {
        /// Radius of the block [m].
        radius: f64,
        /// Height of the block [m].
        height: f64,
        /// Radius of the indenter [m].
        indenter: f64,
    },
    /// Without a side, the punch would have tissue inside it.
    #[error(
        "tissue enters the punch at a depth of {depth} m, where a punch without a side means nothing; let its side stick or slide"
    )]
    TissueEntersPunch {
        /// The depth at which it does [m].
        depth: f64,
    },
    /// The surface goes over itself.
    #[error(
        "a face without friction folds the tissue under it at a depth of {depth} m, beyond which the answer means nothing; let the face stick or ask for less"
    )]
    SurfaceFolds {
        /// The depth at which it does [m].
        depth: f64,
    },
    /// A depth that no indenter can reach.
    #[error(
        "a depth of {depth} m in a block {height} m high; give depths from 0 to less than the height"
    )]
    ImpossibleDepth {
        /// The depth given [m].
        depth: f64,
        /// The block's height [m].
        height: f64,
    },
    /// The times of a history are in no order.
    #[error("the times of the depth history do not ascend from 0; sort them, one for each depth")]
    TimesDoNotAscend,
    /// A length that is none.
    #[error("{name} is {found} m; give a positive length")]
    NotALength {
        /// Whose length.
        name: &'static str,
        /// The value given [m].
        found: f64,
    },
    /// A depth that is no number.
    #[error("the depth is {depth} m; give a number")]
    DepthIsNoNumber {
        /// The value given [m].
        depth: f64,
    },
    /// A patch on a hemisphere leaves nothing free above the base.
    #[error(
        "the patch has a radius of {patch_radius} m, and the fixed base is {quarter} m from the pole; give a radius below 0.99 of that"
    )]
    PatchReachesBase {
        /// The value given [m].
        patch_radius: f64,
        /// Arc from the pole to the base [m].
        quarter: f64,
    },
    /// A law has no stress at this stretch.
    #[error(
        "the stretch is {stretch}, where the law has no stress; give a positive one, nearer to 1"
    )]
    StretchOutOfRange {
        /// The value given [-].
        stretch: f64,
    },
    /// The tetrahedra of a solid cannot be made.
    #[error(transparent)]
    Tetrahedra(#[from] palpate_geometry::TetrahedronError),
    /// No triangle of the boundary is fixed.
    #[error(
        "the anchor holds no triangle of the body, which can move without force; give a plane, box or sphere that takes in a part of its surface"
    )]
    NothingFixed,
    /// A piece of the body is not fixed.
    #[error(
        "the body has {pieces} pieces, and the one at {place:?} m is not fixed; fix each of them, or join them"
    )]
    UnfixedPiece {
        /// A vertex of the piece [m].
        place: [f64; 3],
        /// How many pieces there are.
        pieces: usize,
    },
    /// The patch is away from the boundary.
    #[error(
        "the centre of the patch lies {distance} m off the surface, more than its radius of {radius} m; move it to the surface"
    )]
    PatchOffSurface {
        /// Distance of its centre [m].
        distance: f64,
        /// Its radius [m].
        radius: f64,
    },
    /// The whole boundary lies within the radius of the patch.
    #[error("the patch of radius {radius} m takes in the whole body; give a smaller radius")]
    PatchCoversBody {
        /// Its radius [m].
        radius: f64,
    },
    /// No triangle of the boundary lies in the patch.
    #[error(
        "the patch of radius {radius} m holds no triangle of the tetrahedra's boundary; give a larger radius, or fix the mesh there"
    )]
    EmptyPatch {
        /// Its radius [m].
        radius: f64,
    },
    /// The anchor and the patch have nodes in common.
    #[error(
        "{:.0} % of the patch lies in the anchor; move the patch, or make the anchor smaller", 100.0 * part
    )]
    PatchIsFixed {
        /// Part of the nodes of the patch [-].
        part: f64,
    },
    /// The patch goes farther than the body is long.
    #[error(
        "the patch moves by {displacement} m, but the body is {extent} m long; give a displacement in metres that is smaller"
    )]
    DisplacementBeyondBody {
        /// Length of the displacement [m].
        displacement: f64,
        /// Largest extent of the body [m].
        extent: f64,
    },
    /// More unknowns than a computer has memory for.
    #[error(
        "the solid has {unknowns} unknowns, more than {most}; give a coarser mesh, or a larger patch"
    )]
    TooManyUnknowns {
        /// Number of unknowns.
        unknowns: usize,
        /// The most that are solved.
        most: usize,
    },
    /// A solid cannot be followed further.
    #[error(
        "no equilibrium was found beyond {:.1} % of the displacement and the loads ({failure}); give smaller ones, or a larger patch if there is one", 100.0 * part
    )]
    NoSolid {
        /// The part that was reached [-].
        part: f64,
        /// Why.
        failure: crate::finite_elements::Failure,
    },
    /// A punch that the mesh of a tube has no place for.
    #[error(
        "the punch has a radius of {radius} m; give a positive one of at most {largest} m, 0.8 of the tube's outer radius or half length"
    )]
    PunchOutOfRange {
        /// The value given [m].
        radius: f64,
        /// The largest one [m].
        largest: f64,
    },
    /// A depth outside the tube's bore.
    #[error(
        "a depth of {depth} m in a tube with a bore of {bore} m; give depths from 0 to less than the bore"
    )]
    TubeDepthOutOfRange {
        /// The value given [m].
        depth: f64,
        /// Inner diameter [m].
        bore: f64,
    },
    /// Nothing keeps the tube from moving aside.
    #[error("the tube's ends are guided, so that a punch pushes it away; hold them")]
    GuidedEnds,
    /// The system gives less memory than may be used.
    #[error(
        "the system has no {} of memory left for the response; close other programs, or give fewer triangles, or fewer that can be touched", gigabytes(*bytes)
    )]
    NoMemory {
        /// Memory requested [bytes].
        bytes: usize,
    },
    /// More memory than may be used.
    #[error(
        "the response takes {} of memory and {} may be used; give fewer triangles, or fewer that can be touched", gigabytes(*needed), gigabytes(*memory)
    )]
    NotEnoughMemory {
        /// Memory needed [bytes].
        needed: usize,
        /// Memory limit [bytes].
        memory: usize,
    },
    /// Triangles are to be touched that cannot move.
    #[error(
        "{triangles} of the triangles that can be touched lie in the anchor; touch others, or make the anchor smaller"
    )]
    TouchableIsFixed {
        /// How many.
        triangles: usize,
    },
    /// A triangle so thin that its normal is rounding.
    #[error("triangle {triangle} is too thin to have a normal; repair the mesh")]
    SliverTriangle {
        /// Its number, from 0.
        triangle: usize,
    },
    /// The caller cancelled the work.
    #[error("the solution was cancelled; run it again")]
    Cancelled,
    /// Numbers that are no response of a solid.
    #[error("the response of the surface is none, for {fault}; make it again from the mesh")]
    InvalidResponse {
        /// Why.
        fault: &'static str,
    },
    /// No room for another facet of a slit.
    #[error(
        "the slit has {most} facets, for which there is room; make longer ones, or room for more"
    )]
    SlitTooLarge {
        /// The most there can be.
        most: usize,
    },
    /// See [`crate::finite_elements::solid::SolidError`].
    #[error(transparent)]
    Solid(#[from] crate::finite_elements::solid::SolidError),
    /// See [`crate::regions::RegionError`].
    #[error(transparent)]
    Region(#[from] crate::regions::RegionError),
    /// See [`crate::FibreError`].
    #[error(transparent)]
    Fibres(#[from] crate::FibreError),
    /// See [`crate::finite_elements::Mismatch`].
    #[error(transparent)]
    Mismatch(#[from] crate::finite_elements::Mismatch),
    /// A body was not brought into equilibrium.
    #[error(
        "no equilibrium was found ({failure}); fix the body, move its supports in smaller steps or use a finer mesh"
    )]
    NotInEquilibrium {
        /// Why.
        failure: crate::finite_elements::Failure,
    },
    /// A triangle that the surface does not have.
    #[error(
        "{what} triangle {triangle} is none of the {triangles} triangles of the surface; give numbers below {triangles}"
    )]
    TriangleOutOfRange {
        /// Fixed or touchable.
        what: &'static str,
        /// The number given, from 0.
        triangle: usize,
        /// How many triangles there are.
        triangles: usize,
    },
    /// The triangles that can be touched are not sorted.
    #[error(
        "touchable triangle {triangle} follows {before}; sort the touchable triangles in ascending order and name each once"
    )]
    TouchableNotAscending {
        /// The number that is out of order.
        triangle: usize,
        /// The number before it.
        before: usize,
    },
    /// No triangle can be touched.
    #[error("no triangle can be touched; give at least one touchable triangle")]
    NothingTouchable,
    /// A surface that is not the one of the response.
    #[error(
        "the surface has {surface} triangles and the response {response}; give the surface that the response was solved for"
    )]
    OtherSurface {
        /// Triangles of the surface.
        surface: usize,
        /// Triangles of the response.
        response: usize,
    },
    /// An invalid facet of a slit.
    #[error("the slit cannot be opened, for {fault}; give a facet on the surface, along it")]
    InvalidSlit {
        /// Why.
        fault: &'static str,
    },
}

/// In words, with digits enough for little ones.
fn gigabytes(bytes: usize) -> String {
    let gigabytes = bytes as f64 * 1e-9;
    match gigabytes < 0.1 {
        true => format!("{gigabytes:.4} GB"),
        false => format!("{gigabytes:.1} GB"),
    }
}
