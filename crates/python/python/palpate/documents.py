"""The documents of palpate as typed dictionaries, by which editors complete and type checkers check them.

A variable is checked that has the type of a document::

    from palpate import documents

    scene: documents.Scene = {"organ": {"builtin": "liver", "builtin_tissue": "pig-liver"}}

Every key is named with each unit that it is read in. Written by ``tests/typed_dicts.py`` from the JSON Schemas.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, TypedDict

if TYPE_CHECKING:
    from typing_extensions import Required


class Draw(TypedDict):
    """A value that is drawn anew for each attempt, by the name of its draw."""

    draw: str


class Estimate(TypedDict, total=False):
    """A value and its standard error."""

    value: Required[float]
    standard_error: float


class SceneCutting(TypedDict, total=False):
    """How the organ is cut. (default: the defaults of its keys)"""

    depth_cm: float | Draw
    """How deep a cut goes: at most in an organ with layers, always in one without. (default: with layers, no limit)"""
    depth_m: float | Draw
    depth_mm: float | Draw
    depth_nm: float | Draw
    depth_um: float | Draw
    force_limit_gf: float | Draw
    """The normal force at which any tool begins to cut. (default: none does)"""
    force_limit_kgf: float | Draw
    force_limit_kn: float | Draw
    force_limit_mn: float | Draw
    force_limit_n: float | Draw
    force_limit_nn: float | Draw
    force_limit_un: float | Draw
    mode: Literal["split", "snap"] | Draw
    """How the surface gives way. (default "split")"""
    toughness_j_per_m2: float | Draw
    """The work of a cut per area of its face, in layers that have no toughness of their own. (default 164.0)"""
    toughness_kj_per_m2: float | Draw
    width_cm: float | Draw
    """How far an opening gapes in its middle. (default 0.0015)"""
    width_m: float | Draw
    width_mm: float | Draw
    width_nm: float | Draw
    width_um: float | Draw


class SceneDrawOnSurface(TypedDict, total=False):
    """A place, evenly over a part of the surface of the organ or of a neighbour. (default: another key says how)"""

    facing: Sequence[float] | Draw
    """The normals there are within 60 degrees of this direction. (default: all)"""
    max_cm: Sequence[float] | Draw
    """The corner with the largest coordinates. (required)"""
    max_m: Sequence[float] | Draw
    max_mm: Sequence[float] | Draw
    max_nm: Sequence[float] | Draw
    max_um: Sequence[float] | Draw
    min_cm: Sequence[float] | Draw
    """The corner of a box with the smallest coordinates. (required)"""
    min_m: Sequence[float] | Draw
    min_mm: Sequence[float] | Draw
    min_nm: Sequence[float] | Draw
    min_um: Sequence[float] | Draw
    neighbour: int | Draw
    """The surface is that of the `[[neighbour]]` with this number, from 1 in the order of the file. (default: it is the organ's)"""


class SceneDraw(TypedDict, total=False):
    """Values that are drawn for each attempt, by name. `{ draw = "NAME" }` takes one in place of any value. (default: every attempt is the same)"""

    below: str | Draw
    """A place below that of the draw `on_surface` with this name. (default: another key says how)"""
    depth_cm: float | str | Draw
    """How far below, against the normal there. (default: nothing but `below` has it)"""
    depth_m: float | str | Draw
    depth_mm: float | str | Draw
    depth_nm: float | str | Draw
    depth_um: float | str | Draw
    on_surface: SceneDrawOnSurface
    """A place, evenly over a part of the surface of the organ or of a neighbour. (default: another key says how)"""
    one_of: Any | Draw
    """Each of these as often as the others. (default: another key says how)"""
    uniform: Any | Draw
    """Evenly between the two numbers, or in the box of which the vectors are corners. (default: another key says how)"""


class SceneModelEnhancement(TypedDict, total=False):
    """Hybrid model: how the area around a contact is refined. (default: it is not)"""

    area: Literal["none", "edge", "vertex"] | Draw
    """The area that is refined. (default "none")"""
    levels: int | Draw
    """How often each triangle is divided into four. (default 1)"""
    smoothing: Literal["none", "shepard", "moving_least_squares"] | Draw
    """How displacements are spread over it. (default "none")"""


class SceneModel(TypedDict, total=False):
    """How the organ is moved. (default: the defaults of its keys)"""

    assembly: Literal["every_step", "reused"] | Draw
    """Local model: when the equations are put together. (default "every_step")"""
    calibration: Literal["fitted", "none"] | Draw
    """Local model: what makes a force of the solution. (default "fitted")"""
    enhancement: SceneModelEnhancement
    """Hybrid model: how the area around a contact is refined. (default: it is not)"""
    force_scale: float | Draw
    """Factor on every force that a device displays; forces are recorded without it. (default 1.0)"""
    form: Literal["weak", "strong"] | Draw
    """Local model: the form of the equations. (default "weak")"""
    gravity_m_per_s2: Sequence[float] | Draw
    """Nonlinear model: the acceleration by which the organ hangs under its own weight. (default: the mesh is the organ as it hangs)"""
    hand_over: Literal["local_model", "linear", "hold"] | Draw
    """What the servo loop gets between two steps. (default "local_model")"""
    integration_points: int | Draw
    """Local model: at how many points the equations are integrated: 130, 415 or 957. (default 415)"""
    kind: Literal["local", "hybrid", "nonlinear", "auto"] | Draw
    """Which model. (default "local")"""
    mechanical_triangles: int | Draw
    """Hybrid model: how many triangles carry the mechanics at most; the shown surface keeps its own. (default: chosen by the model)"""
    nodes: int | Draw
    """Nonlinear model: about how many nodes carry the mechanics. (default: chosen by the model)"""
    particles: int | Draw
    """Local model: how many particles stand around a tool. (default 34)"""
    placement: Literal["template", "source"] | Draw
    """Local model: where the particles stand. (default "template")"""
    response: Literal["automatic", "boundary_elements", "finite_elements"] | Draw
    """Hybrid model: how the response of the organ is solved. (default "automatic")"""
    solver: Literal["direct", "gmres"] | Draw
    """Local model: how the equations are solved. (default "direct")"""
    step_h: float | Draw
    """The period of the model's steps. (default 0.005)"""
    step_min: float | Draw
    step_ms: float | Draw
    step_s: float | Draw
    step_us: float | Draw


class SceneNeighbourAnchorBoxes(TypedDict, total=False):
    """Boxes along the axes. (default: none)"""

    max_cm: Sequence[float] | Draw
    """The corner with the largest coordinates. (required)"""
    max_m: Sequence[float] | Draw
    max_mm: Sequence[float] | Draw
    max_nm: Sequence[float] | Draw
    max_um: Sequence[float] | Draw
    min_cm: Sequence[float] | Draw
    """The corner with the smallest coordinates. (required)"""
    min_m: Sequence[float] | Draw
    min_mm: Sequence[float] | Draw
    min_nm: Sequence[float] | Draw
    min_um: Sequence[float] | Draw


class SceneNeighbourAnchorPlanes(TypedDict, total=False):
    """Half-spaces, each of which its normal points away from. (default: none)"""

    normal: Required[Sequence[float] | Draw]
    """The direction away from it, of any length but zero. (required)"""
    point_cm: Sequence[float] | Draw
    """A point of its border. (required)"""
    point_m: Sequence[float] | Draw
    point_mm: Sequence[float] | Draw
    point_nm: Sequence[float] | Draw
    point_um: Sequence[float] | Draw


class SceneNeighbourAnchorSpheres(TypedDict, total=False):
    """Balls. (default: none)"""

    center_cm: Sequence[float] | Draw
    """Its centre. (required)"""
    center_m: Sequence[float] | Draw
    center_mm: Sequence[float] | Draw
    center_nm: Sequence[float] | Draw
    center_um: Sequence[float] | Draw
    radius_cm: float | Draw
    """Its radius. (required)"""
    radius_m: float | Draw
    radius_mm: float | Draw
    radius_nm: float | Draw
    radius_um: float | Draw


class SceneNeighbourAnchor(TypedDict, total=False):
    """Where it is fixed, if it bends: its surface in one of these regions of the scene. (default: the attachment of a built-in organ)"""

    boxes: Sequence[SceneNeighbourAnchorBoxes]
    """Boxes along the axes. (default: none)"""
    planes: Sequence[SceneNeighbourAnchorPlanes]
    """Half-spaces, each of which its normal points away from. (default: none)"""
    spheres: Sequence[SceneNeighbourAnchorSpheres]
    """Balls. (default: none)"""


class SceneNeighbourTissueLumpedBlatz(TypedDict, total=False):
    """What earlier versions call `column`. (default: none)"""

    alpha: Required[float | Estimate | Draw]
    """alpha. (required)"""
    effective_area_cm2: float | Estimate | Draw
    """Cross-section of the column. (required)"""
    effective_area_m2: float | Estimate | Draw
    effective_area_mm2: float | Estimate | Draw
    effective_length_cm: float | Estimate | Draw
    """Length of the column. (required)"""
    effective_length_m: float | Estimate | Draw
    effective_length_mm: float | Estimate | Draw
    effective_length_nm: float | Estimate | Draw
    effective_length_um: float | Estimate | Draw
    gamma_gpa: float | Estimate | Draw
    """gamma. (required)"""
    gamma_kpa: float | Estimate | Draw
    gamma_mmhg: float | Estimate | Draw
    gamma_mpa: float | Estimate | Draw
    gamma_pa: float | Estimate | Draw


class SceneNeighbourTissueLumpedKelvin(TypedDict, total=False):
    """Two springs and a damper (6.3). (default: none)"""

    b_n_s_per_m: float | Estimate | Draw
    """Damping. (required)"""
    b_n_s_per_mm: float | Estimate | Draw
    k1_n_per_m: float | Estimate | Draw
    """Instantaneous stiffness. (required)"""
    k1_n_per_mm: float | Estimate | Draw
    k2_n_per_m: float | Estimate | Draw
    """Stiffness after relaxation. (required)"""
    k2_n_per_mm: float | Estimate | Draw
    tau_h: float | Estimate | Draw
    """Time constant, when it was fitted. (default: it was not fitted)"""
    tau_min: float | Estimate | Draw
    tau_ms: float | Estimate | Draw
    tau_s: float | Estimate | Draw
    tau_us: float | Estimate | Draw


class SceneNeighbourTissueLumpedNonlinearSprings(TypedDict, total=False):
    """Three nonlinear springs (6.4), in newtons, millimetres and seconds. (default: none)"""

    k01: Required[float | Estimate | Draw]
    """Factor of the spring of the static force, in N/mm^k02. (required)"""
    k02: Required[float | Estimate | Draw]
    """Exponent of the spring of the static force. (required)"""
    k11: Required[float | Estimate | Draw]
    """First parameter of the first relaxing spring. (required)"""
    k12: Required[float | Estimate | Draw]
    """Second parameter of the first relaxing spring. (required)"""
    k13: Required[float | Estimate | Draw]
    """Third parameter of the first relaxing spring. (required)"""
    k21: Required[float | Estimate | Draw]
    """First parameter of the second relaxing spring. (required)"""
    k22: Required[float | Estimate | Draw]
    """Second parameter of the second relaxing spring. (required)"""
    k23: Required[float | Estimate | Draw]
    """Third parameter of the second relaxing spring. (required)"""


class SceneNeighbourTissueLumped(TypedDict, total=False):
    """Parameters of models without geometry. (default: none)"""

    blatz: SceneNeighbourTissueLumpedBlatz
    """What earlier versions call `column`. (default: none)"""
    column: SceneNeighbourTissueLumpedBlatz
    """The exponential law on a column of effective size (6.2). (default: none)"""
    kelvin: SceneNeighbourTissueLumpedKelvin
    """Two springs and a damper (6.3). (default: none)"""
    nonlinear_springs: SceneNeighbourTissueLumpedNonlinearSprings
    """Three nonlinear springs (6.4), in newtons, millimetres and seconds. (default: none)"""


class SceneNeighbourTissueProny(TypedDict, total=False):
    """G(t) = G0 (1 - sum of g (1 - exp(-t/tau))): its relaxation, a table for each term. (default: it does not relax)"""

    g: Required[float | Draw]
    """The part of the instantaneous modulus that relaxes; all parts together are less than 1. (required)"""
    g_standard_error: float | Draw
    """Its standard error. (default: unknown)"""
    tau_h: float | Draw
    """Time constant of the relaxation. (required)"""
    tau_min: float | Draw
    tau_ms: float | Draw
    tau_s: float | Draw
    tau_standard_error_h: float | Draw
    """Its standard error. (default: unknown)"""
    tau_standard_error_min: float | Draw
    tau_standard_error_ms: float | Draw
    tau_standard_error_s: float | Draw
    tau_standard_error_us: float | Draw
    tau_us: float | Draw
    """Time constant of the relaxation. (required)"""


class SceneNeighbourTissueSource(TypedDict, total=False):
    """Where the numbers come from. (default: unknown)"""

    method: str | Draw
    """How the numbers were found. (default: unknown)"""
    recordings: Sequence[str] | Draw
    """The recordings that were fitted. (default [])"""
    version: str | Draw
    """The version of the program that found them. (default: unknown)"""
    warnings: Sequence[str] | Draw
    """Warnings, in sentences. Programs that use the tissue pass them on. (default [])"""


class SceneNeighbourTissue(TypedDict, total=False):
    """Nonlinear model: what it is made of, a tissue file or a table with a tissue's keys. It then bends, is touched as the organ is, and stays out of it. (default: it is rigid, unless `builtin_tissue` names one)"""

    alpha: float | Estimate | Draw
    """`exponential`: alpha. (default: another law)"""
    alpha_1: float | Estimate | Draw
    """`ogden`: alpha of the first term. (default: another law)"""
    alpha_2: float | Estimate | Draw
    """`ogden`: alpha of the second term. (default: one term)"""
    alpha_3: float | Estimate | Draw
    """`ogden`: alpha of the third term. (default: two terms)"""
    c01_gpa: float | Estimate | Draw
    """`mooney_rivlin`: C01; c10_pa + c01_pa is half the shear modulus. (default: another law)"""
    c01_kpa: float | Estimate | Draw
    c01_mmhg: float | Estimate | Draw
    c01_mpa: float | Estimate | Draw
    c01_pa: float | Estimate | Draw
    c10_gpa: float | Estimate | Draw
    """`neo_hookean`, `reduced_polynomial`: C10, half the shear modulus; `holzapfel_gasser_ogden`: that of the matrix; `mooney_rivlin`: C10. (default: another law)"""
    c10_kpa: float | Estimate | Draw
    c10_mmhg: float | Estimate | Draw
    c10_mpa: float | Estimate | Draw
    c10_pa: float | Estimate | Draw
    c20_gpa: float | Estimate | Draw
    """`reduced_polynomial`: C20. (default: one term)"""
    c20_kpa: float | Estimate | Draw
    c20_mmhg: float | Estimate | Draw
    c20_mpa: float | Estimate | Draw
    c20_pa: float | Estimate | Draw
    c30_gpa: float | Estimate | Draw
    """`reduced_polynomial`: C30. (default: two terms)"""
    c30_kpa: float | Estimate | Draw
    c30_mmhg: float | Estimate | Draw
    c30_mpa: float | Estimate | Draw
    c30_pa: float | Estimate | Draw
    density_g_cm3: float | Estimate | Draw
    """Its density. (default 1060.0)"""
    density_g_per_cm3: float | Estimate | Draw
    density_kg_m3: float | Estimate | Draw
    density_kg_per_m3: float | Estimate | Draw
    dispersion: float | Estimate | Draw
    """`holzapfel_gasser_ogden`: kappa, the dispersion of the fibres of a family around its direction. (default: another law)"""
    fibre_angle_deg: float | Estimate | Draw
    """`holzapfel_gasser_ogden`: the angle gamma of the two families to the reference axis, on either side of it; at 0 and at 90 they are one, of twice k1. The problem says where the axis is. (default: another law)"""
    fibre_angle_rad: float | Estimate | Draw
    gamma_gpa: float | Estimate | Draw
    """`exponential`: gamma, a third of Young's modulus at small strain. (default: another law)"""
    gamma_kpa: float | Estimate | Draw
    gamma_mmhg: float | Estimate | Draw
    gamma_mpa: float | Estimate | Draw
    gamma_pa: float | Estimate | Draw
    k1_gpa: float | Estimate | Draw
    """`holzapfel_gasser_ogden`: k1, the stiffness of each of its two families of fibres. (default: another law)"""
    k1_kpa: float | Estimate | Draw
    k1_mmhg: float | Estimate | Draw
    k1_mpa: float | Estimate | Draw
    k1_pa: float | Estimate | Draw
    k2: float | Estimate | Draw
    """`holzapfel_gasser_ogden`: k2, how fast the fibres stiffen. (default: another law)"""
    law: Required[Literal["linear", "neo_hookean", "mooney_rivlin", "exponential", "ogden", "reduced_polynomial", "holzapfel_gasser_ogden"] | Draw]
    """Its elastic law. (required)"""
    lumped: SceneNeighbourTissueLumped
    """Parameters of models without geometry. (default: none)"""
    mu_1_gpa: float | Estimate | Draw
    """`ogden`: mu of the first term; all mu together are the shear modulus. (default: another law)"""
    mu_1_kpa: float | Estimate | Draw
    mu_1_mmhg: float | Estimate | Draw
    mu_1_mpa: float | Estimate | Draw
    mu_1_pa: float | Estimate | Draw
    mu_2_gpa: float | Estimate | Draw
    """`ogden`: mu of the second term. (default: one term)"""
    mu_2_kpa: float | Estimate | Draw
    mu_2_mmhg: float | Estimate | Draw
    mu_2_mpa: float | Estimate | Draw
    mu_2_pa: float | Estimate | Draw
    mu_3_gpa: float | Estimate | Draw
    """`ogden`: mu of the third term. (default: two terms)"""
    mu_3_kpa: float | Estimate | Draw
    mu_3_mmhg: float | Estimate | Draw
    mu_3_mpa: float | Estimate | Draw
    mu_3_pa: float | Estimate | Draw
    name: str | Draw
    """What people call it. (default: it has no name)"""
    poissons_ratio: float | Estimate | Draw
    """`linear`: Poisson's ratio. (default: another law)"""
    prony: Sequence[SceneNeighbourTissueProny]
    """G(t) = G0 (1 - sum of g (1 - exp(-t/tau))): its relaxation, a table for each term. (default: it does not relax)"""
    source: SceneNeighbourTissueSource
    """Where the numbers come from. (default: unknown)"""
    youngs_modulus_gpa: float | Estimate | Draw
    """`linear`: Young's modulus. All moduli are instantaneous: `prony` says how they fall. (default: another law)"""
    youngs_modulus_kpa: float | Estimate | Draw
    youngs_modulus_mmhg: float | Estimate | Draw
    youngs_modulus_mpa: float | Estimate | Draw
    youngs_modulus_pa: float | Estimate | Draw


class SceneNeighbour(TypedDict, total=False):
    """Bodies that are shown with the organ: rigid ones, and those that bend. (default: none)"""

    anchor: SceneNeighbourAnchor
    """Where it is fixed, if it bends: its surface in one of these regions of the scene. (default: the attachment of a built-in organ)"""
    at_cm: Sequence[float] | Draw
    """Where its origin comes to, after it is scaled and turned about it. (default [0.0, 0.0, 0.0])"""
    at_m: Sequence[float] | Draw
    at_mm: Sequence[float] | Draw
    at_nm: Sequence[float] | Draw
    at_um: Sequence[float] | Draw
    builtin: Literal["esophagus", "liver", "kidney", "stomach", "spleen", "diaphragm", "hemisphere", "cube", "slab"] | Draw
    """A shape that comes with the program. (required without `mesh`)"""
    builtin_tissue: Literal["pig-liver", "pig-kidney", "pig-spleen", "pig-esophagus"] | Draw
    """The same, of a tissue that comes with the program. (default: it is rigid, unless `tissue` says what it is made of)"""
    collides: bool | Draw
    """Whether it stops the tips of tools and an organ of the nonlinear model. (default false)"""
    friction: float | Draw
    """Coulomb's coefficient between it and an organ of the nonlinear model, if it collides or bends. (default 0.0)"""
    mesh: str | Draw
    """A mesh file: STL, OBJ, PLY or glTF. (default: `builtin` names a shape)"""
    mesh_unit: Literal["m", "cm", "mm", "um", "in"] | Draw
    """The unit of the coordinates in the mesh file. (default: the file's own unit, or a guess from its size, with a warning)"""
    nodes: int | Draw
    """About how many nodes carry its mechanics, if it bends. (default 500)"""
    scale: float | Draw
    """How much larger it is than its shape. (default 1.0)"""
    stiffness_n_per_m: float | Draw
    """The force on a tip per depth in it, where it collides. (default 1000.0)"""
    stiffness_n_per_mm: float | Draw
    tissue: str | SceneNeighbourTissue | Draw
    """Nonlinear model: what it is made of, a tissue file or a table with a tissue's keys. It then bends, is touched as the organ is, and stays out of it. (default: it is rigid, unless `builtin_tissue` names one)"""
    triangles: int | Draw
    """About how many triangles a built-in shape has. (default: the shape's own number)"""
    turn_deg: Sequence[float] | Draw
    """How it is turned about x, then y, then z of the scene, counter-clockwise. (default [0.0, 0.0, 0.0])"""
    turn_rad: Sequence[float] | Draw


class SceneOrganInclusionBall(TypedDict, total=False):
    """A ball. One of the three shapes or `mesh` has to be there. (default: another shape is there)"""

    center_cm: Sequence[float] | Draw
    """Its centre. (required)"""
    center_m: Sequence[float] | Draw
    center_mm: Sequence[float] | Draw
    center_nm: Sequence[float] | Draw
    center_um: Sequence[float] | Draw
    radius_cm: float | Draw
    """Its radius. (required)"""
    radius_m: float | Draw
    radius_mm: float | Draw
    radius_nm: float | Draw
    radius_um: float | Draw


class SceneOrganInclusionCapsule(TypedDict, total=False):
    """All points within a distance of a line segment. (default: another shape is there)"""

    from_cm: Sequence[float] | Draw
    """One end of the segment. (required)"""
    from_m: Sequence[float] | Draw
    from_mm: Sequence[float] | Draw
    from_nm: Sequence[float] | Draw
    from_um: Sequence[float] | Draw
    radius_cm: float | Draw
    """The distance. (required)"""
    radius_m: float | Draw
    radius_mm: float | Draw
    radius_nm: float | Draw
    radius_um: float | Draw
    to_cm: Sequence[float] | Draw
    """The other end. (required)"""
    to_m: Sequence[float] | Draw
    to_mm: Sequence[float] | Draw
    to_nm: Sequence[float] | Draw
    to_um: Sequence[float] | Draw


class SceneOrganInclusionCavity(TypedDict, total=False):
    """In place of a tissue: a cavity that tissue encloses, such as a gall bladder; `{}` is an empty one. Of the models of a scene only the nonlinear one has it. (default: it is of a tissue)"""

    constant_volume: bool | Draw
    """Whether it is full of a fluid that keeps its volume. (default false)"""
    pressure_gpa: float | Draw
    """The pressure on its wall, which stays constant; of a fluid that keeps its volume, its pressure before anything else loads the body. (default: none: the cavity is empty, or its fluid under no pressure)"""
    pressure_kpa: float | Draw
    pressure_mmhg: float | Draw
    pressure_mpa: float | Draw
    pressure_pa: float | Draw


class SceneOrganInclusionEllipsoid(TypedDict, total=False):
    """An ellipsoid. (default: another shape is there)"""

    center_cm: Sequence[float] | Draw
    """Its centre. (required)"""
    center_m: Sequence[float] | Draw
    center_mm: Sequence[float] | Draw
    center_nm: Sequence[float] | Draw
    center_um: Sequence[float] | Draw
    radii_cm: Sequence[float] | Draw
    """Its semi-axes. (required)"""
    radii_m: Sequence[float] | Draw
    radii_mm: Sequence[float] | Draw
    radii_nm: Sequence[float] | Draw
    radii_um: Sequence[float] | Draw
    turn_deg: Sequence[float] | Draw
    """How it is turned about x, then y, then z of the scene, counter-clockwise. (default [0.0, 0.0, 0.0])"""
    turn_rad: Sequence[float] | Draw


class SceneOrganInclusion(TypedDict, total=False):
    """Parts of another tissue, such as a tumour or a vessel, which the hybrid and the nonlinear model solve and the local one estimates, and cavities, which the nonlinear model has. (default: none)"""

    ball: SceneOrganInclusionBall
    """A ball. One of the three shapes or `mesh` has to be there. (default: another shape is there)"""
    builtin_tissue: Literal["pig-liver", "pig-kidney", "pig-spleen", "pig-esophagus"] | Draw
    """A tissue that comes with the program. (default: `tissue`, `cavity` or `stiffness_ratio` is there)"""
    capsule: SceneOrganInclusionCapsule
    """All points within a distance of a line segment. (default: another shape is there)"""
    cavity: SceneOrganInclusionCavity
    """In place of a tissue: a cavity that tissue encloses, such as a gall bladder; `{}` is an empty one. Of the models of a scene only the nonlinear one has it. (default: it is of a tissue)"""
    ellipsoid: SceneOrganInclusionEllipsoid
    """An ellipsoid. (default: another shape is there)"""
    mesh: str | Draw
    """A mesh file with a closed surface in the organ, as of a tumour or a vessel. (default: another shape is there)"""
    mesh_unit: Literal["m", "cm", "mm", "um", "in"] | Draw
    """The unit of the coordinates in the mesh file. (default: the file's own unit, or a guess from its size, with a warning)"""
    name: str | Draw
    """What people call it. (default: its number)"""
    stiffness_ratio: float | Draw
    """In place of a tissue: of a ball, an ellipsoid or a capsule of the organ's tissue so many times as stiff. Its effect on the force is estimated and needs no preparation, so that it may be drawn for each attempt; where it stays, a tissue is more accurate. (default: it is of a tissue)"""
    tissue: str | SceneNeighbourTissue | Draw
    """A tissue file, or a table with a tissue's keys. (default: `builtin_tissue` names one)"""


class SceneOrganLayer(TypedDict, total=False):
    """Its layers from outside to inside, at most 6, above `tissue`. A blade opens a layer where it goes as deep as its lower face, and any tool where it is bare and the normal force exceeds `perforation_force_n`. The hybrid and the nonlinear model feel its tissue; with the local one the organ answers as `tissue` does. (default: it is of one tissue)"""

    builtin_tissue: Literal["pig-liver", "pig-kidney", "pig-spleen", "pig-esophagus"] | Draw
    """A tissue that comes with the program. (default: that of the organ)"""
    name: str | Draw
    """What people call it. (default: its number)"""
    perforation_force_gf: float | Draw
    """The normal force on a tool at which it gives way where it is bare. (default: it withstands every force)"""
    perforation_force_kgf: float | Draw
    perforation_force_kn: float | Draw
    perforation_force_mn: float | Draw
    perforation_force_n: float | Draw
    perforation_force_nn: float | Draw
    perforation_force_un: float | Draw
    thickness_cm: float | Draw
    """Its thickness. (required)"""
    thickness_m: float | Draw
    thickness_mm: float | Draw
    thickness_nm: float | Draw
    thickness_um: float | Draw
    tissue: str | SceneNeighbourTissue | Draw
    """A tissue file, or a table with a tissue's keys. (default: `builtin_tissue` names one)"""
    toughness_j_per_m2: float | Draw
    """The work of a cut through it per area of the cut's face. (default: that of `[cutting]`)"""
    toughness_kj_per_m2: float | Draw


class SceneOrganNodule(TypedDict, total=False):
    """Earlier form of an `inclusion` with a `ball` and a `stiffness_ratio`, which is still read. (default: none)"""

    center_cm: Sequence[float] | Draw
    """Its centre. (required)"""
    center_m: Sequence[float] | Draw
    center_mm: Sequence[float] | Draw
    center_nm: Sequence[float] | Draw
    center_um: Sequence[float] | Draw
    radius_cm: float | Draw
    """Its radius. (required)"""
    radius_m: float | Draw
    radius_mm: float | Draw
    radius_nm: float | Draw
    radius_um: float | Draw
    stiffness_ratio: Required[float | Draw]
    """Its modulus over that of the organ. (required)"""


class SceneOrganRegionLayer(TypedDict, total=False):
    """A layer below the outer surface; several lie one below the other, from outside inwards, in the order of the file. A layer or another shape has to be there. (default: another shape is there)"""

    thickness_cm: float | Draw
    """Its thickness. (required)"""
    thickness_m: float | Draw
    thickness_mm: float | Draw
    thickness_nm: float | Draw
    thickness_um: float | Draw


class SceneOrganRegion(TypedDict, total=False):
    """Layers, in the order of the file after those of `layer`, and inclusions and cavities, after those of `inclusion`: all in one list. (default: none)"""

    ball: SceneOrganInclusionBall
    """A ball. (default: another shape is there)"""
    builtin_tissue: Literal["pig-liver", "pig-kidney", "pig-spleen", "pig-esophagus"] | Draw
    """A tissue that comes with the program. (default: `tissue`, `cavity` or `stiffness_ratio` is there)"""
    capsule: SceneOrganInclusionCapsule
    """All points within a distance of a line segment. (default: another shape is there)"""
    cavity: SceneOrganInclusionCavity
    """In place of a tissue: a cavity that tissue encloses, such as a gall bladder; `{}` is an empty one. Of the models of a scene only the nonlinear one has it. (default: it is of a tissue)"""
    ellipsoid: SceneOrganInclusionEllipsoid
    """An ellipsoid. (default: another shape is there)"""
    label: int | Draw
    """The number of a region in the file of a volume mesh: for `palpate solve` alone, for the organ of a scene is a surface. (default: another shape is there)"""
    layer: SceneOrganRegionLayer
    """A layer below the outer surface; several lie one below the other, from outside inwards, in the order of the file. A layer or another shape has to be there. (default: another shape is there)"""
    mesh_unit: Literal["m", "cm", "mm", "um", "in"] | Draw
    """The unit of the coordinates in the mesh file. (default: the file's own unit, or a guess from its size, with a warning)"""
    name: str | Draw
    """What people call it. (default: its group or number)"""
    stiffness_ratio: float | Draw
    """In place of a tissue: of a ball, an ellipsoid or a capsule of the organ's tissue so many times as stiff. Its effect on the force is estimated and needs no preparation, so that it may be drawn for each attempt; where it stays, a tissue is more accurate. (default: it is of a tissue)"""
    surface: str | Draw
    """A mesh file with a closed surface in the body, as of a tumour or a vessel. (default: another shape is there)"""
    tissue: str | SceneNeighbourTissue | Draw
    """A tissue file, or a table with a tissue's keys. (default: `builtin_tissue` names one)"""


class SceneOrgan(TypedDict, total=False):
    """The organ that is touched. As a list, `[[organ]]`, the first is this one, and further ones are bodies beside it that bend, as a `[[neighbour]]` with a tissue does. (required)"""

    anchor: SceneNeighbourAnchor
    """The fixed part: triangles whose centroid lies in one of these regions, and with the nonlinear model the nodes of its mesh to which the nearest point of the surface does. (default: the attachment of a built-in organ; none of a mesh, which only the local model allows)"""
    at_cm: Sequence[float] | Draw
    """Where its origin comes to, after it is scaled and turned about it. (default: as its mesh does; of a further organ alone)"""
    at_m: Sequence[float] | Draw
    at_mm: Sequence[float] | Draw
    at_nm: Sequence[float] | Draw
    at_um: Sequence[float] | Draw
    builtin: Literal["esophagus", "liver", "kidney", "stomach", "spleen", "diaphragm", "hemisphere", "cube", "slab"] | Draw
    """A shape that comes with the program. (required without `mesh`)"""
    builtin_tissue: Literal["pig-liver", "pig-kidney", "pig-spleen", "pig-esophagus"] | Draw
    """A tissue that comes with the program. (required without `tissue`)"""
    friction: float | Draw
    """A further organ: Coulomb's coefficient between it and other organs. (default: 0.0)"""
    inclusion: Sequence[SceneOrganInclusion]
    """Parts of another tissue, such as a tumour or a vessel, which the hybrid and the nonlinear model solve and the local one estimates, and cavities, which the nonlinear model has. (default: none)"""
    layer: Sequence[SceneOrganLayer]
    """Its layers from outside to inside, at most 6, above `tissue`. A blade opens a layer where it goes as deep as its lower face, and any tool where it is bare and the normal force exceeds `perforation_force_n`. The hybrid and the nonlinear model feel its tissue; with the local one the organ answers as `tissue` does. (default: it is of one tissue)"""
    mesh: str | Draw
    """A mesh file: STL, OBJ, PLY or glTF. (default: `builtin` names a shape)"""
    mesh_unit: Literal["m", "cm", "mm", "um", "in"] | Draw
    """The unit of the coordinates in the mesh file. (default: the file's own unit, or a guess from its size, with a warning)"""
    nodes: int | Draw
    """A further organ: about how many nodes carry its mechanics; `model.nodes` says it of the first. (default: 500 of a further organ)"""
    nodule: Sequence[SceneOrganNodule]
    """Earlier form of an `inclusion` with a `ball` and a `stiffness_ratio`, which is still read. (default: none)"""
    region: Sequence[SceneOrganRegion]
    """Layers, in the order of the file after those of `layer`, and inclusions and cavities, after those of `inclusion`: all in one list. (default: none)"""
    scale: float | Draw
    """How much larger it is than its shape. (default: as its mesh does; of a further organ alone)"""
    self_contact: bool | Draw
    """Nonlinear model: whether its parts stay out of one another where it folds or closes. (default false)"""
    self_friction: float | Draw
    """Coulomb's coefficient between its parts, with `self_contact`. (default 0.0)"""
    tissue: str | SceneNeighbourTissue | Draw
    """A tissue file, or a table with a tissue's keys. (default: `builtin_tissue` names one)"""
    touchable: SceneNeighbourAnchor
    """Where tools may touch it; the hybrid model prepares no more than this. (default: everywhere)"""
    triangles: int | Draw
    """About how many triangles a built-in shape has. (default: the shape's own number)"""
    turn_deg: Sequence[float] | Draw
    """How it is turned about x, then y, then z of the scene, counter-clockwise. (default: as its mesh does; of a further organ alone)"""
    turn_rad: Sequence[float] | Draw


class SceneTaskCut(TypedDict, total=False):
    """Done when a line is cut. (default: another goal)"""

    center_cm: Sequence[float] | Draw
    """The centre of a circle, which takes the place of a straight line. (default: the line is straight)"""
    center_m: Sequence[float] | Draw
    center_mm: Sequence[float] | Draw
    center_nm: Sequence[float] | Draw
    center_um: Sequence[float] | Draw
    from_cm: Sequence[float] | Draw
    """Where a straight line should begin. (required without `center_m`)"""
    from_m: Sequence[float] | Draw
    from_mm: Sequence[float] | Draw
    from_nm: Sequence[float] | Draw
    from_um: Sequence[float] | Draw
    layers: int | Draw
    """How many layers from outside are cut; at most those of the organ. (default: all but the innermost)"""
    normal: Sequence[float] | Draw
    """The normal of the circle's plane, out of the organ. (default: the line is straight)"""
    radius_cm: float | Draw
    """The radius of the circle. (default: the line is straight)"""
    radius_m: float | Draw
    radius_mm: float | Draw
    radius_nm: float | Draw
    radius_um: float | Draw
    to_cm: Sequence[float] | Draw
    """Where it should end. (required without `center_m`)"""
    to_m: Sequence[float] | Draw
    to_mm: Sequence[float] | Draw
    to_nm: Sequence[float] | Draw
    to_um: Sequence[float] | Draw
    tolerance_cm: float | Draw
    """The largest distance from the line that counts. (required)"""
    tolerance_m: float | Draw
    tolerance_mm: float | Draw
    tolerance_nm: float | Draw
    tolerance_um: float | Draw


class SceneTaskFind(TypedDict, total=False):
    """Done when a place is marked. At most one of `find`, `traction`, `cut` and `touch`. (default: everybody does what they like)"""

    diameter_tolerance_cm: float | Draw
    """The largest error of the stated diameter that counts. (default: a quarter of the diameter, with a `radius_m`)"""
    diameter_tolerance_m: float | Draw
    diameter_tolerance_mm: float | Draw
    diameter_tolerance_nm: float | Draw
    diameter_tolerance_um: float | Draw
    radius_cm: float | Draw
    """Its radius; with it the trainee also states a diameter after marking the place. (default: only the place counts)"""
    radius_m: float | Draw
    radius_mm: float | Draw
    radius_nm: float | Draw
    radius_um: float | Draw
    target_cm: Sequence[float] | Draw
    """The place on or under the surface that is meant. (required)"""
    target_m: Sequence[float] | Draw
    target_mm: Sequence[float] | Draw
    target_nm: Sequence[float] | Draw
    target_um: Sequence[float] | Draw
    tolerance_cm: float | Draw
    """How far from it, along the surface, still counts. (required)"""
    tolerance_m: float | Draw
    tolerance_mm: float | Draw
    tolerance_nm: float | Draw
    tolerance_um: float | Draw


class SceneTaskTouch(TypedDict, total=False):
    """Done when a place of a neighbour was touched for long enough, with the organ out of the way. (default: another goal)"""

    force_gf: float | Draw
    """The force that is wanted. (required)"""
    force_kgf: float | Draw
    force_kn: float | Draw
    force_mn: float | Draw
    force_n: float | Draw
    force_nn: float | Draw
    force_un: float | Draw
    hold_h: float | Draw
    """For how long in all, within both tolerances, with neither tip nor shaft of the tool at the organ. (required)"""
    hold_min: float | Draw
    hold_ms: float | Draw
    hold_s: float | Draw
    hold_us: float | Draw
    holder: str | Draw
    """The grasper that has to hold the organ meanwhile. (default: none has to)"""
    injury_force_gf: float | Draw
    """A force above it injures what is touched: the attempt is over, and failed. (default: nothing is injured)"""
    injury_force_kgf: float | Draw
    injury_force_kn: float | Draw
    injury_force_mn: float | Draw
    injury_force_n: float | Draw
    injury_force_nn: float | Draw
    injury_force_un: float | Draw
    target_cm: Sequence[float] | Draw
    """The place that is meant, on a neighbour that collides. (required)"""
    target_m: Sequence[float] | Draw
    target_mm: Sequence[float] | Draw
    target_nm: Sequence[float] | Draw
    target_um: Sequence[float] | Draw
    tear_force_gf: float | Draw
    """A pull of the holder above it tears the tissue: the attempt is over, and failed. (default: it never tears)"""
    tear_force_kgf: float | Draw
    tear_force_kn: float | Draw
    tear_force_mn: float | Draw
    tear_force_n: float | Draw
    tear_force_nn: float | Draw
    tear_force_un: float | Draw
    tolerance_cm: float | Draw
    """The largest distance of the tip from it that counts. (required)"""
    tolerance_gf: float | Draw
    """The largest distance from it that counts. (required)"""
    tolerance_kgf: float | Draw
    tolerance_kn: float | Draw
    tolerance_m: float | Draw
    """The largest distance of the tip from it that counts. (required)"""
    tolerance_mm: float | Draw
    tolerance_mn: float | Draw
    """The largest distance from it that counts. (required)"""
    tolerance_n: float | Draw
    tolerance_nm: float | Draw
    """The largest distance of the tip from it that counts. (required)"""
    tolerance_nn: float | Draw
    """The largest distance from it that counts. (required)"""
    tolerance_um: float | Draw
    """The largest distance of the tip from it that counts. (required)"""
    tolerance_un: float | Draw
    """The largest distance from it that counts. (required)"""
    tool: Required[str | Draw]
    """The tool that touches. (required)"""


class SceneTaskTraction(TypedDict, total=False):
    """Done when a force was held for long enough. (default: another goal)"""

    direction: Sequence[float] | Draw
    """Where to pull. (default: anywhere)"""
    direction_tolerance_deg: float | Draw
    """The largest angle from `direction` that still counts. (default: 30 degrees, with a `direction`)"""
    direction_tolerance_rad: float | Draw
    force_gf: float | Draw
    """The force that is wanted. (required)"""
    force_kgf: float | Draw
    force_kn: float | Draw
    force_mn: float | Draw
    force_n: float | Draw
    force_nn: float | Draw
    force_un: float | Draw
    hold_h: float | Draw
    """For how long in all, within the tolerance. (required)"""
    hold_min: float | Draw
    hold_ms: float | Draw
    hold_s: float | Draw
    hold_us: float | Draw
    tear_force_gf: float | Draw
    """A pull above it tears the tissue: the attempt is over, and failed. (default: it never tears)"""
    tear_force_kgf: float | Draw
    tear_force_kn: float | Draw
    tear_force_mn: float | Draw
    tear_force_n: float | Draw
    tear_force_nn: float | Draw
    tear_force_un: float | Draw
    tolerance_gf: float | Draw
    """The largest distance from it that counts. (required)"""
    tolerance_kgf: float | Draw
    tolerance_kn: float | Draw
    tolerance_mn: float | Draw
    tolerance_n: float | Draw
    tolerance_nn: float | Draw
    tolerance_un: float | Draw
    tool: str | Draw
    """The tool that pulls. (default: any)"""


class SceneTask(TypedDict, total=False):
    """What there is to do, and how a performance is judged. (default: nothing)"""

    cut: SceneTaskCut
    """Done when a line is cut. (default: another goal)"""
    expert: str | Draw
    """An expert's session to compare with: its folder, or a folder of several. (default: none)"""
    find: SceneTaskFind
    """Done when a place is marked. At most one of `find`, `traction`, `cut` and `touch`. (default: everybody does what they like)"""
    force_limit_gf: float | Draw
    """The force above which tissue would be harmed; forces above it count against the trainee. (default: no force counts)"""
    force_limit_kgf: float | Draw
    force_limit_kn: float | Draw
    force_limit_mn: float | Draw
    force_limit_n: float | Draw
    force_limit_nn: float | Draw
    force_limit_un: float | Draw
    instructions: str | Draw
    """What the trainee reads. (default: nothing)"""
    picture: str | Draw
    """A picture of it for the start screen: a PNG file. (default: none)"""
    time_limit_h: float | Draw
    """How long it may take. (default: as long as it takes)"""
    time_limit_min: float | Draw
    time_limit_ms: float | Draw
    time_limit_s: float | Draw
    time_limit_us: float | Draw
    title: str | Draw
    """What it is called. (default: it has no title)"""
    touch: SceneTaskTouch
    """Done when a place of a neighbour was touched for long enough, with the organ out of the way. (default: another goal)"""
    traction: SceneTaskTraction
    """Done when a force was held for long enough. (default: another goal)"""


class SceneToolJaws(TypedDict, total=False):
    """The jaws of a grasper, or the blades of scissors. Shut, they end at the tip and run along the shaft. (default: those of a short instrument of 5 mm shaft)"""

    force_gf: float | Draw
    """The most with which each presses on what is between them; of a grasper. (default: 4.0)"""
    force_kgf: float | Draw
    force_kn: float | Draw
    force_mn: float | Draw
    force_n: float | Draw
    force_nn: float | Draw
    force_un: float | Draw
    friction: float | Draw
    """Coulomb's coefficient of tissue on their faces; of a grasper. (default: 0.4)"""
    length_cm: float | Draw
    """From the joint to the end. (default 0.012)"""
    length_m: float | Draw
    length_mm: float | Draw
    length_nm: float | Draw
    length_um: float | Draw
    opening_cm: float | Draw
    """Between their ends when they are open. (default 0.010)"""
    opening_m: float | Draw
    opening_mm: float | Draw
    opening_nm: float | Draw
    opening_um: float | Draw
    width_cm: float | Draw
    """Across, along the tool's y; of a grasper. (default: 0.004)"""
    width_m: float | Draw
    width_mm: float | Draw
    width_nm: float | Draw
    width_um: float | Draw


class SceneToolTipContact(TypedDict, total=False):
    """How it holds the tissue that it touches; a table for a tip that sticks and slides: `contact = { coulomb = 0.3 }`. (default "stick")"""

    coulomb: Required[float | Draw]
    """Coulomb's coefficient, beyond which it slides. (required)"""


class SceneToolTip(TypedDict, total=False):
    """The end that touches. (default: a flat tip of 1 mm radius that sticks)"""

    contact: Literal["stick", "slip"] | SceneToolTipContact | Draw
    """How it holds the tissue that it touches; a table for a tip that sticks and slides: `contact = { coulomb = 0.3 }`. (default "stick")"""
    friction: float | Draw
    """Coulomb's coefficient of a tip that sticks, as in the table `contact`; of the nonlinear model also that of the shaft. (default: it never slides)"""
    radius_cm: float | Draw
    """Its radius, not its diameter. (required)"""
    radius_m: float | Draw
    radius_mm: float | Draw
    radius_nm: float | Draw
    radius_um: float | Draw
    shape: Required[Literal["flat", "sphere"] | Draw]
    """Its shape. (required)"""


class SceneTool(TypedDict, total=False):
    """The tools: one, or one for each hand. (default: one probe, which the mouse moves)"""

    device: Literal["mouse", "virtual", "none", "haply", "openhaptics", "force_dimension"] | Draw
    """What moves it. (default "mouse")"""
    jaws: SceneToolJaws
    """The jaws of a grasper, or the blades of scissors. Shut, they end at the tip and run along the shaft. (default: those of a short instrument of 5 mm shaft)"""
    kind: Literal["probe", "grasper", "scissors", "hook"] | Draw
    """What it can do. (default "probe")"""
    mesh: str | Draw
    """What it looks like: a mesh file in the tool's frame, the tip at the origin and the shaft along +z. (default: as its kind does)"""
    mesh_unit: Literal["m", "cm", "mm", "um", "in"] | Draw
    """The unit of the coordinates in the mesh file. (default: the file's own unit, or a guess from its size, with a warning)"""
    name: str | Draw
    """Its name, which motions and sessions use. (default: the hand that is free, "right" first)"""
    tip: SceneToolTip
    """The end that touches. (default: a flat tip of 1 mm radius that sticks)"""
    trocar_cm: Sequence[float] | Draw
    """The point through which its shaft always passes. (default: it moves freely)"""
    trocar_friction_gf: float | Draw
    """Friction of its shaft in the trocar, which a hand feels along the shaft. Only with `trocar_m`. (default: 0.0)"""
    trocar_friction_kgf: float | Draw
    trocar_friction_kn: float | Draw
    trocar_friction_mn: float | Draw
    trocar_friction_n: float | Draw
    trocar_friction_nn: float | Draw
    trocar_friction_un: float | Draw
    trocar_m: Sequence[float] | Draw
    """The point through which its shaft always passes. (default: it moves freely)"""
    trocar_mm: Sequence[float] | Draw
    trocar_nm: Sequence[float] | Draw
    trocar_stiffness_n_per_m: float | Draw
    """How the abdominal wall resists a shaft that leans away from the organ: force on the hand per way of the hand across. Only with `trocar_m`. (default: 0.0)"""
    trocar_stiffness_n_per_mm: float | Draw
    trocar_um: Sequence[float] | Draw
    """The point through which its shaft always passes. (default: it moves freely)"""


class SceneVariant(TypedDict, total=False):
    """What was drawn of a scene with `[draw]`. The program writes it. (default: nothing)"""

    drawn: Mapping[str, Any]
    """What was drawn, by name. (default: nothing)"""
    seed: Required[int | Draw]
    """The seed that it was drawn with. (required)"""


class SceneView(TypedDict, total=False):
    """The camera; without these keys it is placed so that the organ fills the picture. (default: the defaults of its keys)"""

    eye_cm: Sequence[float] | Draw
    """Where the eye is. (default: so that the organ fills the picture)"""
    eye_m: Sequence[float] | Draw
    eye_mm: Sequence[float] | Draw
    eye_nm: Sequence[float] | Draw
    eye_um: Sequence[float] | Draw
    field_of_view_deg: float | Draw
    """The angle from the lower to the upper edge of the picture. (default 0.7853981633974483)"""
    field_of_view_rad: float | Draw
    shading: Literal["plain", "texture", "sphere_map", "cube_map"] | Draw
    """How the organ is drawn. (default "cube_map")"""
    target_cm: Sequence[float] | Draw
    """What it looks at. (default: so that the organ fills the picture)"""
    target_m: Sequence[float] | Draw
    target_mm: Sequence[float] | Draw
    target_nm: Sequence[float] | Draw
    target_um: Sequence[float] | Draw
    up: Sequence[float] | Draw
    """The direction that is up in the picture. (default: chosen by the viewer)"""


class Scene(TypedDict, total=False):
    """An organ, what it is made of, what moves it, the tools that touch it, and what there is to do."""

    cutting: SceneCutting
    """How the organ is cut. (default: the defaults of its keys)"""
    draw: Mapping[str, SceneDraw]
    """Values that are drawn for each attempt, by name. `{ draw = "NAME" }` takes one in place of any value. (default: every attempt is the same)"""
    format: Literal[1]
    """The version of the format."""
    model: SceneModel
    """How the organ is moved. (default: the defaults of its keys)"""
    neighbour: Sequence[SceneNeighbour]
    """Bodies that are shown with the organ: rigid ones, and those that bend. (default: none)"""
    organ: Required[SceneOrgan | Sequence[SceneOrgan]]
    """The organ that is touched. As a list, `[[organ]]`, the first is this one, and further ones are bodies beside it that bend, as a `[[neighbour]]` with a tissue does. (required)"""
    task: SceneTask
    """What there is to do, and how a performance is judged. (default: nothing)"""
    tool: Sequence[SceneTool]
    """The tools: one, or one for each hand. (default: one probe, which the mouse moves)"""
    variant: SceneVariant
    """What was drawn of a scene with `[draw]`. The program writes it. (default: nothing)"""
    view: SceneView
    """The camera; without these keys it is placed so that the organ fills the picture. (default: the defaults of its keys)"""


class TissueTissueLumpedBlatz(TypedDict, total=False):
    """What earlier versions call `column`. (default: none)"""

    alpha: Required[float | Estimate]
    """alpha. (required)"""
    effective_area_cm2: float | Estimate
    """Cross-section of the column. (required)"""
    effective_area_m2: float | Estimate
    effective_area_mm2: float | Estimate
    effective_length_cm: float | Estimate
    """Length of the column. (required)"""
    effective_length_m: float | Estimate
    effective_length_mm: float | Estimate
    effective_length_nm: float | Estimate
    effective_length_um: float | Estimate
    gamma_gpa: float | Estimate
    """gamma. (required)"""
    gamma_kpa: float | Estimate
    gamma_mmhg: float | Estimate
    gamma_mpa: float | Estimate
    gamma_pa: float | Estimate


class TissueTissueLumpedKelvin(TypedDict, total=False):
    """Two springs and a damper (6.3). (default: none)"""

    b_n_s_per_m: float | Estimate
    """Damping. (required)"""
    b_n_s_per_mm: float | Estimate
    k1_n_per_m: float | Estimate
    """Instantaneous stiffness. (required)"""
    k1_n_per_mm: float | Estimate
    k2_n_per_m: float | Estimate
    """Stiffness after relaxation. (required)"""
    k2_n_per_mm: float | Estimate
    tau_h: float | Estimate
    """Time constant, when it was fitted. (default: it was not fitted)"""
    tau_min: float | Estimate
    tau_ms: float | Estimate
    tau_s: float | Estimate
    tau_us: float | Estimate


class TissueTissueLumpedNonlinearSprings(TypedDict, total=False):
    """Three nonlinear springs (6.4), in newtons, millimetres and seconds. (default: none)"""

    k01: Required[float | Estimate]
    """Factor of the spring of the static force, in N/mm^k02. (required)"""
    k02: Required[float | Estimate]
    """Exponent of the spring of the static force. (required)"""
    k11: Required[float | Estimate]
    """First parameter of the first relaxing spring. (required)"""
    k12: Required[float | Estimate]
    """Second parameter of the first relaxing spring. (required)"""
    k13: Required[float | Estimate]
    """Third parameter of the first relaxing spring. (required)"""
    k21: Required[float | Estimate]
    """First parameter of the second relaxing spring. (required)"""
    k22: Required[float | Estimate]
    """Second parameter of the second relaxing spring. (required)"""
    k23: Required[float | Estimate]
    """Third parameter of the second relaxing spring. (required)"""


class TissueTissueLumped(TypedDict, total=False):
    """Parameters of models without geometry. (default: none)"""

    blatz: TissueTissueLumpedBlatz
    """What earlier versions call `column`. (default: none)"""
    column: TissueTissueLumpedBlatz
    """The exponential law on a column of effective size (6.2). (default: none)"""
    kelvin: TissueTissueLumpedKelvin
    """Two springs and a damper (6.3). (default: none)"""
    nonlinear_springs: TissueTissueLumpedNonlinearSprings
    """Three nonlinear springs (6.4), in newtons, millimetres and seconds. (default: none)"""


class TissueTissueProny(TypedDict, total=False):
    """G(t) = G0 (1 - sum of g (1 - exp(-t/tau))): its relaxation, a table for each term. (default: it does not relax)"""

    g: Required[float]
    """The part of the instantaneous modulus that relaxes; all parts together are less than 1. (required)"""
    g_standard_error: float
    """Its standard error. (default: unknown)"""
    tau_h: float
    """Time constant of the relaxation. (required)"""
    tau_min: float
    tau_ms: float
    tau_s: float
    tau_standard_error_h: float
    """Its standard error. (default: unknown)"""
    tau_standard_error_min: float
    tau_standard_error_ms: float
    tau_standard_error_s: float
    tau_standard_error_us: float
    tau_us: float
    """Time constant of the relaxation. (required)"""


class TissueTissueSource(TypedDict, total=False):
    """Where the numbers come from. (default: unknown)"""

    method: str
    """How the numbers were found. (default: unknown)"""
    recordings: Sequence[str]
    """The recordings that were fitted. (default [])"""
    version: str
    """The version of the program that found them. (default: unknown)"""
    warnings: Sequence[str]
    """Warnings, in sentences. Programs that use the tissue pass them on. (default [])"""


class TissueTissue(TypedDict, total=False):
    """What an organ is made of. (required)"""

    alpha: float | Estimate
    """`exponential`: alpha. (default: another law)"""
    alpha_1: float | Estimate
    """`ogden`: alpha of the first term. (default: another law)"""
    alpha_2: float | Estimate
    """`ogden`: alpha of the second term. (default: one term)"""
    alpha_3: float | Estimate
    """`ogden`: alpha of the third term. (default: two terms)"""
    c01_gpa: float | Estimate
    """`mooney_rivlin`: C01; c10_pa + c01_pa is half the shear modulus. (default: another law)"""
    c01_kpa: float | Estimate
    c01_mmhg: float | Estimate
    c01_mpa: float | Estimate
    c01_pa: float | Estimate
    c10_gpa: float | Estimate
    """`neo_hookean`, `reduced_polynomial`: C10, half the shear modulus; `holzapfel_gasser_ogden`: that of the matrix; `mooney_rivlin`: C10. (default: another law)"""
    c10_kpa: float | Estimate
    c10_mmhg: float | Estimate
    c10_mpa: float | Estimate
    c10_pa: float | Estimate
    c20_gpa: float | Estimate
    """`reduced_polynomial`: C20. (default: one term)"""
    c20_kpa: float | Estimate
    c20_mmhg: float | Estimate
    c20_mpa: float | Estimate
    c20_pa: float | Estimate
    c30_gpa: float | Estimate
    """`reduced_polynomial`: C30. (default: two terms)"""
    c30_kpa: float | Estimate
    c30_mmhg: float | Estimate
    c30_mpa: float | Estimate
    c30_pa: float | Estimate
    density_g_cm3: float | Estimate
    """Its density. (default 1060.0)"""
    density_g_per_cm3: float | Estimate
    density_kg_m3: float | Estimate
    density_kg_per_m3: float | Estimate
    dispersion: float | Estimate
    """`holzapfel_gasser_ogden`: kappa, the dispersion of the fibres of a family around its direction. (default: another law)"""
    fibre_angle_deg: float | Estimate
    """`holzapfel_gasser_ogden`: the angle gamma of the two families to the reference axis, on either side of it; at 0 and at 90 they are one, of twice k1. The problem says where the axis is. (default: another law)"""
    fibre_angle_rad: float | Estimate
    gamma_gpa: float | Estimate
    """`exponential`: gamma, a third of Young's modulus at small strain. (default: another law)"""
    gamma_kpa: float | Estimate
    gamma_mmhg: float | Estimate
    gamma_mpa: float | Estimate
    gamma_pa: float | Estimate
    k1_gpa: float | Estimate
    """`holzapfel_gasser_ogden`: k1, the stiffness of each of its two families of fibres. (default: another law)"""
    k1_kpa: float | Estimate
    k1_mmhg: float | Estimate
    k1_mpa: float | Estimate
    k1_pa: float | Estimate
    k2: float | Estimate
    """`holzapfel_gasser_ogden`: k2, how fast the fibres stiffen. (default: another law)"""
    law: Required[Literal["linear", "neo_hookean", "mooney_rivlin", "exponential", "ogden", "reduced_polynomial", "holzapfel_gasser_ogden"]]
    """Its elastic law. (required)"""
    lumped: TissueTissueLumped
    """Parameters of models without geometry. (default: none)"""
    mu_1_gpa: float | Estimate
    """`ogden`: mu of the first term; all mu together are the shear modulus. (default: another law)"""
    mu_1_kpa: float | Estimate
    mu_1_mmhg: float | Estimate
    mu_1_mpa: float | Estimate
    mu_1_pa: float | Estimate
    mu_2_gpa: float | Estimate
    """`ogden`: mu of the second term. (default: one term)"""
    mu_2_kpa: float | Estimate
    mu_2_mmhg: float | Estimate
    mu_2_mpa: float | Estimate
    mu_2_pa: float | Estimate
    mu_3_gpa: float | Estimate
    """`ogden`: mu of the third term. (default: two terms)"""
    mu_3_kpa: float | Estimate
    mu_3_mmhg: float | Estimate
    mu_3_mpa: float | Estimate
    mu_3_pa: float | Estimate
    name: str
    """What people call it. (default: it has no name)"""
    poissons_ratio: float | Estimate
    """`linear`: Poisson's ratio. (default: another law)"""
    prony: Sequence[TissueTissueProny]
    """G(t) = G0 (1 - sum of g (1 - exp(-t/tau))): its relaxation, a table for each term. (default: it does not relax)"""
    source: TissueTissueSource
    """Where the numbers come from. (default: unknown)"""
    youngs_modulus_gpa: float | Estimate
    """`linear`: Young's modulus. All moduli are instantaneous: `prony` says how they fall. (default: another law)"""
    youngs_modulus_kpa: float | Estimate
    youngs_modulus_mmhg: float | Estimate
    youngs_modulus_mpa: float | Estimate
    youngs_modulus_pa: float | Estimate


class Tissue(TypedDict, total=False):
    """What an organ is made of."""

    format: Literal[1]
    """The version of the format."""
    tissue: Required[TissueTissue]
    """What an organ is made of. (required)"""


class ProtocolRig(TypedDict, total=False):
    """How the rig goes about it. (default: the rig's own settings)"""

    approach_speed_m_per_s: float
    """How fast the indenter goes to the tissue. (default: the rig's own)"""
    approach_speed_mm_per_min: float
    approach_speed_mm_per_s: float
    breath_h: float
    """How long a breath is held at most. (default: the rig's own)"""
    breath_min: float
    breath_ms: float
    breath_s: float
    breath_us: float
    contact_force_gf: float
    """The rise of the force that is a contact. (default: the rig's own)"""
    contact_force_kgf: float
    contact_force_kn: float
    contact_force_mn: float
    contact_force_n: float
    contact_force_nn: float
    contact_force_un: float
    depth_limit_cm: float
    """The deepest that it may go. (default: the rig's own)"""
    depth_limit_m: float
    depth_limit_mm: float
    depth_limit_nm: float
    depth_limit_um: float
    device: Literal["virtual", "haply", "openhaptics", "force_dimension"]
    """What carries the indenter. (default: the rig's own)"""
    force_limit_gf: float
    """The largest force on the tissue. (default: the rig's own)"""
    force_limit_kgf: float
    force_limit_kn: float
    force_limit_mn: float
    force_limit_n: float
    force_limit_nn: float
    force_limit_un: float
    gains: Literal["tuned", "gentle"]
    """How hard the indenter is driven. (default: the rig's own)"""
    indenter_axis: Sequence[float]
    """The direction from the tip to the device, in the rig's axes; it leads up. (default: the rig's own)"""
    lateral_limit_cm: float
    """How far sideways the indenter may be moved from where the rig began. (default: the rig's own)"""
    lateral_limit_m: float
    lateral_limit_mm: float
    lateral_limit_nm: float
    lateral_limit_um: float
    recovery_h: float
    """How long tissue rests between two stimuli. (default: the rig's own)"""
    recovery_min: float
    recovery_ms: float
    recovery_s: float
    recovery_us: float
    speed_limit_m_per_s: float
    """The fastest that it may be. (default: the rig's own)"""
    speed_limit_mm_per_min: float
    speed_limit_mm_per_s: float
    stop_at_relative_interval: float
    """A ramp and hold ends when half the 95 % interval of the modulus and of each number of the relaxation is at most this part of its value. (default: whole stimuli)"""


class ProtocolSensor(TypedDict, total=False):
    """What measures the force. (default: the virtual sensor)"""

    axes: Sequence[str]
    """The indenter's x, y and z among the sensor's axes; of a real sensor. (default: the same axes)"""
    baud: int
    """`serial`: bits per second. (default: 115200)"""
    channels: str
    """`ni_daq`: the six channels as NI-DAQmx names them. (default: another kind)"""
    columns: Sequence[str]
    """`serial`: the fields of a line: "fz", or all of "fx", "fy", "fz", "tx", "ty" and "tz", and "sequence" or "skip". (default: another kind)"""
    counts_per_newton: float
    """`net_ft`, `serial`: counts per newton. (default: another kind)"""
    counts_per_newton_metre: float
    """`net_ft`, `serial`: counts per newton metre. (default: another kind, or a line without torques)"""
    kind: Literal["virtual", "ni_daq", "net_ft", "serial"]
    """What measures the force. (default "virtual")"""
    matrix: Sequence[float]
    """`ni_daq`: the 36 numbers of the calibration certificate, row by row in N and N m per volt. (default: another kind)"""
    range_gf: Sequence[float]
    """The largest force on each axis; of a real sensor. (default: the rig's own)"""
    range_kgf: Sequence[float]
    range_kn: Sequence[float]
    range_mn: Sequence[float]
    range_mn_m: Sequence[float]
    """The largest torque about each axis; of a real sensor. (default: the rig's own)"""
    range_n: Sequence[float]
    """The largest force on each axis; of a real sensor. (default: the rig's own)"""
    range_n_m: Sequence[float]
    """The largest torque about each axis; of a real sensor. (default: the rig's own)"""
    range_n_mm: Sequence[float]
    range_nn: Sequence[float]
    """The largest force on each axis; of a real sensor. (default: the rig's own)"""
    range_un: Sequence[float]
    range_v: float
    """`ni_daq`: the largest voltage that is measured. (default: 10.0)"""
    rate_hz: float
    """`ni_daq`: how often they are sampled. (default: 10000.0)"""
    rate_khz: float
    separator: Literal[",", ";", "tab", "space"]
    """`serial`: what stands between two fields. (default: a comma)"""
    timeout_h: float
    """How long a reading may be missing; of a real sensor. (default: the rig's own)"""
    timeout_min: float
    timeout_ms: float
    timeout_s: float
    timeout_us: float
    tip_distance_cm: float
    """From the sensor's origin, about which torques are, to the tip. (default: the rig's own)"""
    tip_distance_m: float
    tip_distance_mm: float
    tip_distance_nm: float
    tip_distance_um: float


class ProtocolSpecimen(TypedDict, total=False):
    """What is measured; every stimulus is done to each. (required)"""

    alive: bool
    """Whether a heart beats in it and breath moves it. (default false)"""
    builtin_tissue: Literal["pig-liver", "pig-kidney", "pig-spleen", "pig-esophagus"]
    """A tissue that comes with the program. (required without `tissue`)"""
    condition: Literal["in_vivo", "ex_vivo", "in_vitro"]
    """The state of the tissue. (default: not said)"""
    factor: float
    """How much stiffer than its tissue it is. (default 1.0)"""
    indenter_radius_cm: float
    """The radius, not the diameter, of the indenter. (default 0.001)"""
    indenter_radius_m: float
    indenter_radius_mm: float
    indenter_radius_nm: float
    indenter_radius_um: float
    measure_normal: bool
    """Whether the surface is touched around the place first, and the normal that is measured there taken. (default false)"""
    normal: Sequence[float]
    """The direction out of the tissue, along which the indenter approaches, presses and withdraws; it leads up. (default [0.0, 0.0, 1.0])"""
    organ: str
    """The organ, for its recordings. (default: not said)"""
    place_cm: Sequence[float]
    """Where the indenter is moved before it approaches, from where the rig begins: x right, y away from the user, z up. (default [0.0, 0.0, 0.0])"""
    place_m: Sequence[float]
    place_mm: Sequence[float]
    place_nm: Sequence[float]
    place_um: Sequence[float]
    published: Literal["liver", "kidney", "spleen", "esophagus"]
    """The organ of a pig that answers as it was published (tables 5-1 and 6-3), in place of a tissue. (default: it is of its tissue)"""
    site: str | int
    """The place on the organ. (default: not said)"""
    subject: str | int
    """The animal, person or body. (default: not said)"""
    surface_normal: Sequence[float]
    """The normal of a virtual specimen's surface where the rig begins. (default [0.0, 0.0, 1.0])"""
    surface_radius_cm: float
    """The radius of curvature of a virtual specimen's surface. (default: it is plane)"""
    surface_radius_m: float
    surface_radius_mm: float
    surface_radius_nm: float
    surface_radius_um: float
    tissue: str | TissueTissue
    """A tissue file, or a table with a tissue's keys. (default: `builtin_tissue` names one)"""
    weight_g: float
    """The subject's weight. (default: not said)"""
    weight_kg: float


class ProtocolStimulus(TypedDict, total=False):
    """The stimuli of each specimen. (required)"""

    amplitude_cm: float
    """`sine`, chirps: from the middle to an end. (default: another kind)"""
    amplitude_m: float
    amplitude_mm: float
    amplitude_nm: float
    amplitude_um: float
    cycles: float
    """`sine`: how often it swings in all. (default: 10.0)"""
    depth_cm: float
    """`ramp_and_hold`: the depth of the hold. (required without `depths_m`)"""
    depth_m: float
    depth_mm: float
    depth_nm: float
    depth_um: float
    depths_cm: Sequence[float]
    """`ramp_and_hold`: a depth for each of several holds. (default: one depth)"""
    depths_m: Sequence[float]
    depths_mm: Sequence[float]
    depths_nm: Sequence[float]
    depths_um: Sequence[float]
    duration_h: float
    """Chirps: how long they swing. (default: 15.0)"""
    duration_min: float
    duration_ms: float
    duration_s: float
    duration_us: float
    end_frequency_hz: float
    """Chirps: with which frequency they end. (default: another kind)"""
    end_frequency_khz: float
    frequencies_hz: Sequence[float]
    """`sine`: a frequency for each of several sines. (default: one frequency)"""
    frequencies_khz: Sequence[float]
    frequency_hz: float
    """`sine`: how often it swings; chirps: with which frequency they begin. (default: another kind, or several frequencies)"""
    frequency_khz: float
    hold_h: float
    """`ramp_and_hold`: how long it stays. (default 20.0)"""
    hold_min: float
    hold_ms: float
    hold_s: float
    hold_us: float
    kind: Required[Literal["ramp_and_hold", "sine", "chirp_linear", "chirp_exponential", "uniaxial", "uniaxial_tension", "planar_tension", "simple_shear", "other"]]
    """What the indenter does: `ramp_and_hold`, `sine`, `chirp_linear` or `chirp_exponential`. (required)"""
    pre_indentation_cm: float
    """`sine`, chirps: the middle. (default: another kind)"""
    pre_indentation_m: float
    pre_indentation_mm: float
    pre_indentation_nm: float
    pre_indentation_um: float
    ramp_h: float
    """`ramp_and_hold`: how long the way takes. (default 0.5)"""
    ramp_min: float
    ramp_ms: float
    ramp_s: float
    ramp_us: float
    repeats: int
    """How often it is done. (default 1)"""


class Protocol(TypedDict, total=False):
    """What the rig measures: every stimulus on every specimen."""

    format: Literal[1]
    """The version of the format."""
    rig: ProtocolRig
    """How the rig goes about it. (default: the rig's own settings)"""
    sensor: ProtocolSensor
    """What measures the force. (default: the virtual sensor)"""
    specimen: Required[Sequence[ProtocolSpecimen]]
    """What is measured; every stimulus is done to each. (required)"""
    stimulus: Required[Sequence[ProtocolStimulus]]
    """The stimuli of each specimen. (required)"""


class IndentationBlock(TypedDict, total=False):
    """The block. (required)"""

    base: Literal["bonded", "lubricated"]
    """What its lower face does. (default "bonded")"""
    height_cm: float
    """Its height. (required)"""
    height_m: float
    height_mm: float
    height_nm: float
    height_um: float
    radius_cm: float
    """Its radius: it is a cylinder. (required)"""
    radius_m: float
    radius_mm: float
    radius_nm: float
    radius_um: float


class IndentationIndenter(TypedDict, total=False):
    """The indenter. (required)"""

    edge_radius_cm: float
    """The radius to which the edge of a flat face, or the apex of a cone, is rounded. The face, its edge and the side are then one surface. (default: they are sharp)"""
    edge_radius_m: float
    edge_radius_mm: float
    edge_radius_nm: float
    edge_radius_um: float
    face: Literal["stick", "slip"]
    """How its face holds tissue. (default "stick")"""
    friction: float
    """Coulomb's coefficient of a face and a side that stick, beyond which tissue slips along them. (default: tissue never slips along them)"""
    half_angle_deg: float
    """The angle between a cone's axis and its side. (default: it is no cone)"""
    half_angle_rad: float
    radius_cm: float
    """Its radius, not its diameter; of a cone that of its base. (required)"""
    radius_m: float
    radius_mm: float
    radius_nm: float
    radius_um: float
    shape: Literal["flat", "sphere", "cone"]
    """Its end. (default "flat")"""
    side: Literal["stick", "slide", "none"]
    """What the side of a flat punch does. (default: `stick`, of a flat punch)"""


class IndentationRamp(TypedDict, total=False):
    """It is pressed in time: to a depth, and held there. (default: `depths_m` says how deep)"""

    depth_cm: float
    """How deep it is pressed. (required)"""
    depth_m: float
    depth_mm: float
    depth_nm: float
    depth_um: float
    hold_h: float
    """How long it stays. (required)"""
    hold_min: float
    hold_ms: float
    hold_s: float
    hold_us: float
    method: Literal["convolution", "full"]
    """How relaxation is taken into account. (default "convolution")"""
    ramp_h: float
    """How long the way takes. (required)"""
    ramp_min: float
    ramp_ms: float
    ramp_s: float
    ramp_us: float
    samples: int
    """How many times are answered for, ends included. (default 200)"""


class Indentation(TypedDict, total=False):
    """A rigid indenter is pressed into a block."""

    accuracy: float
    """The relative error that is asked for. (default 0.01)"""
    block: Required[IndentationBlock]
    """The block. (required)"""
    builtin_tissue: Literal["pig-liver", "pig-kidney", "pig-spleen", "pig-esophagus"]
    """A tissue that comes with the program. (required without `tissue`)"""
    depths_cm: Sequence[float]
    """How deep it is pressed, with instantaneous moduli, for each answer. (required without `ramp`)"""
    depths_m: Sequence[float]
    depths_mm: Sequence[float]
    depths_nm: Sequence[float]
    depths_um: Sequence[float]
    format: Literal[1]
    """The version of the format."""
    indenter: Required[IndentationIndenter]
    """The indenter. (required)"""
    kind: Required[Literal["indentation", "hemisphere", "tube", "uniaxial", "solid"]]
    """What is solved. (required)"""
    ramp: IndentationRamp
    """It is pressed in time: to a depth, and held there. (default: `depths_m` says how deep)"""
    tissue: str | TissueTissue
    """A tissue file, or a table with a tissue's keys. (default: `builtin_tissue` names one)"""


class Hemisphere(TypedDict, total=False):
    """A patch at the pole of a hemisphere is pressed towards its fixed base."""

    accuracy: float
    """The relative error that is asked for. (default 0.01)"""
    builtin_tissue: Literal["pig-liver", "pig-kidney", "pig-spleen", "pig-esophagus"]
    """A tissue that comes with the program. (required without `tissue`)"""
    depth_cm: float
    """How far the patch moves towards the base. (required)"""
    depth_m: float
    depth_mm: float
    depth_nm: float
    depth_um: float
    format: Literal[1]
    """The version of the format."""
    kind: Required[Literal["indentation", "hemisphere", "tube", "uniaxial", "solid"]]
    """What is solved. (required)"""
    patch: Required[Literal["stick", "slip", "bonded"]]
    """The tangential boundary condition of the patch. (required)"""
    patch_radius_cm: float
    """Arc from the pole within which every point of the surface moves. (required)"""
    patch_radius_m: float
    patch_radius_mm: float
    patch_radius_nm: float
    patch_radius_um: float
    radius_cm: float
    """Its radius. (required)"""
    radius_m: float
    radius_mm: float
    radius_nm: float
    radius_um: float
    tissue: str | TissueTissue
    """A tissue file, or a table with a tissue's keys. (default: `builtin_tissue` names one)"""


class TubeIndent(TypedDict, total=False):
    """A flat indenter, pressed radially at mid-length after the last pressure. (default: it is not indented)"""

    contact: Literal["stick", "slip", "bonded"]
    """How it holds the tissue. (default "stick")"""
    depths_cm: Sequence[float]
    """How deep it is pressed, for each answer. (required)"""
    depths_m: Sequence[float]
    depths_mm: Sequence[float]
    depths_nm: Sequence[float]
    depths_um: Sequence[float]
    radius_cm: float
    """The indenter's radius. (required)"""
    radius_m: float
    radius_mm: float
    radius_nm: float
    radius_um: float


class Tube(TypedDict, total=False):
    """A tube with fixed ends is under pressure, and perhaps indented."""

    accuracy: float
    """The relative error that is asked for. (default 0.01)"""
    builtin_tissue: Literal["pig-liver", "pig-kidney", "pig-spleen", "pig-esophagus"]
    """A tissue that comes with the program. (required without `tissue`)"""
    format: Literal[1]
    """The version of the format."""
    indent: TubeIndent
    """A flat indenter, pressed radially at mid-length after the last pressure. (default: it is not indented)"""
    inner_radius_cm: float
    """Its inner radius at rest. (required)"""
    inner_radius_m: float
    inner_radius_mm: float
    inner_radius_nm: float
    inner_radius_um: float
    kind: Required[Literal["indentation", "hemisphere", "tube", "uniaxial", "solid"]]
    """What is solved. (required)"""
    length_cm: float
    """Its length. (required)"""
    length_m: float
    length_mm: float
    length_nm: float
    length_um: float
    outer_radius_cm: float
    """Its outer radius at rest. (required)"""
    outer_radius_m: float
    outer_radius_mm: float
    outer_radius_nm: float
    outer_radius_um: float
    pressure_gpa: float
    """The pressure inside. (default: `pressures_pa`, or 0 with `indent`)"""
    pressure_kpa: float
    pressure_mmhg: float
    pressure_mpa: float
    pressure_pa: float
    pressures_gpa: Sequence[float]
    """Several pressures inside, one after another. (required without `pressure_pa`)"""
    pressures_kpa: Sequence[float]
    pressures_mmhg: Sequence[float]
    pressures_mpa: Sequence[float]
    pressures_pa: Sequence[float]
    tissue: str | TissueTissue
    """A tissue file, or a table with a tissue's keys. (default: `builtin_tissue` names one)"""


class Uniaxial(TypedDict, total=False):
    """A bar is pulled or pressed along its axis, free to widen."""

    accuracy: float
    """The relative error that is asked for. (default 0.01)"""
    builtin_tissue: Literal["pig-liver", "pig-kidney", "pig-spleen", "pig-esophagus"]
    """A tissue that comes with the program. (required without `tissue`)"""
    format: Literal[1]
    """The version of the format."""
    kind: Required[Literal["indentation", "hemisphere", "tube", "uniaxial", "solid"]]
    """What is solved. (required)"""
    pulled_along: Literal["axis", "across", "normal"]
    """With the law `holzapfel_gasser_ogden`: which direction of its fibres the bar is pulled along. (default: `axis`)"""
    stretches: Required[Sequence[float]]
    """Length over length at rest, for each answer. (required)"""
    tissue: str | TissueTissue
    """A tissue file, or a table with a tissue's keys. (default: `builtin_tissue` names one)"""


class SolidAnchorBoxes(TypedDict, total=False):
    """Boxes along the axes. (default: none)"""

    max_cm: Sequence[float]
    """The corner with the largest coordinates. (required)"""
    max_m: Sequence[float]
    max_mm: Sequence[float]
    max_nm: Sequence[float]
    max_um: Sequence[float]
    min_cm: Sequence[float]
    """The corner with the smallest coordinates. (required)"""
    min_m: Sequence[float]
    min_mm: Sequence[float]
    min_nm: Sequence[float]
    min_um: Sequence[float]


class SolidAnchorPlanes(TypedDict, total=False):
    """Half-spaces, each of which its normal points away from. (default: none)"""

    normal: Required[Sequence[float]]
    """The direction away from it, of any length but zero. (required)"""
    point_cm: Sequence[float]
    """A point of its border. (required)"""
    point_m: Sequence[float]
    point_mm: Sequence[float]
    point_nm: Sequence[float]
    point_um: Sequence[float]


class SolidAnchorSpheres(TypedDict, total=False):
    """Balls. (default: none)"""

    center_cm: Sequence[float]
    """Its centre. (required)"""
    center_m: Sequence[float]
    center_mm: Sequence[float]
    center_nm: Sequence[float]
    center_um: Sequence[float]
    radius_cm: float
    """Its radius. (required)"""
    radius_m: float
    radius_mm: float
    radius_nm: float
    radius_um: float


class SolidAnchor(TypedDict, total=False):
    """The fixed part. (default: where a built-in shape grows)"""

    boxes: Sequence[SolidAnchorBoxes]
    """Boxes along the axes. (default: none)"""
    planes: Sequence[SolidAnchorPlanes]
    """Half-spaces, each of which its normal points away from. (default: none)"""
    spheres: Sequence[SolidAnchorSpheres]
    """Balls. (default: none)"""


class SolidFibresAround(TypedDict, total=False):
    """The line that a tube lies around: the reference axis runs around it, and the plane of the families along it. (default: `axis` or `file` says it)"""

    line: Required[Sequence[float]]
    """The direction of the line. (required)"""
    point_cm: Sequence[float]
    """A point of the line. (required)"""
    point_m: Sequence[float]
    point_mm: Sequence[float]
    point_nm: Sequence[float]
    point_um: Sequence[float]


class SolidFibres(TypedDict, total=False):
    """Where the fibres of the tissue point to at rest; the law `holzapfel_gasser_ogden` needs it. (default: the tissue has no fibres)"""

    across: Sequence[float]
    """With `axis`: a second direction in the plane of the two families, such as that across the reference axis. (default: none, which is enough for families at 0 degrees)"""
    around: SolidFibresAround
    """The line that a tube lies around: the reference axis runs around it, and the plane of the families along it. (default: `axis` or `file` says it)"""
    axis: Sequence[float]
    """The reference axis, the same everywhere. (default: `around` or `file` says it)"""
    file: str
    """A table (CSV) of directions, such as one at the middle of each cell of a mesh: `x_m`, `y_m`, `z_m`, the reference axis `axis_x`, `axis_y`, `axis_z`, and `across_x`, `across_y`, `across_z`. A place has those of the nearest row. (default: `axis` or `around` says it)"""


class SolidInclusionBall(TypedDict, total=False):
    """A ball. One of the three shapes or `mesh` has to be there. (default: another shape is there)"""

    center_cm: Sequence[float]
    """Its centre. (required)"""
    center_m: Sequence[float]
    center_mm: Sequence[float]
    center_nm: Sequence[float]
    center_um: Sequence[float]
    radius_cm: float
    """Its radius. (required)"""
    radius_m: float
    radius_mm: float
    radius_nm: float
    radius_um: float


class SolidInclusionCapsule(TypedDict, total=False):
    """All points within a distance of a line segment. (default: another shape is there)"""

    from_cm: Sequence[float]
    """One end of the segment. (required)"""
    from_m: Sequence[float]
    from_mm: Sequence[float]
    from_nm: Sequence[float]
    from_um: Sequence[float]
    radius_cm: float
    """The distance. (required)"""
    radius_m: float
    radius_mm: float
    radius_nm: float
    radius_um: float
    to_cm: Sequence[float]
    """The other end. (required)"""
    to_m: Sequence[float]
    to_mm: Sequence[float]
    to_nm: Sequence[float]
    to_um: Sequence[float]


class SolidInclusionCavity(TypedDict, total=False):
    """In place of a tissue: a cavity that tissue encloses, such as a gall bladder; `{}` is an empty one. Of the models of a scene only the nonlinear one has it. (default: it is of a tissue)"""

    constant_volume: bool
    """Whether it is full of a fluid that keeps its volume. (default false)"""
    pressure_gpa: float
    """The pressure on its wall, which stays constant; of a fluid that keeps its volume, its pressure before anything else loads the body. (default: none: the cavity is empty, or its fluid under no pressure)"""
    pressure_kpa: float
    pressure_mmhg: float
    pressure_mpa: float
    pressure_pa: float


class SolidInclusionEllipsoid(TypedDict, total=False):
    """An ellipsoid. (default: another shape is there)"""

    center_cm: Sequence[float]
    """Its centre. (required)"""
    center_m: Sequence[float]
    center_mm: Sequence[float]
    center_nm: Sequence[float]
    center_um: Sequence[float]
    radii_cm: Sequence[float]
    """Its semi-axes. (required)"""
    radii_m: Sequence[float]
    radii_mm: Sequence[float]
    radii_nm: Sequence[float]
    radii_um: Sequence[float]
    turn_deg: Sequence[float]
    """How it is turned about x, then y, then z of the scene, counter-clockwise. (default [0.0, 0.0, 0.0])"""
    turn_rad: Sequence[float]


class SolidInclusion(TypedDict, total=False):
    """Shapes inside, as in `region`. (default: none)"""

    ball: SolidInclusionBall
    """A ball. One of the three shapes or `mesh` has to be there. (default: another shape is there)"""
    builtin_tissue: Literal["pig-liver", "pig-kidney", "pig-spleen", "pig-esophagus"]
    """A tissue that comes with the program. (default: `tissue`, `cavity` or `stiffness_ratio` is there)"""
    capsule: SolidInclusionCapsule
    """All points within a distance of a line segment. (default: another shape is there)"""
    cavity: SolidInclusionCavity
    """In place of a tissue: a cavity that tissue encloses, such as a gall bladder; `{}` is an empty one. Of the models of a scene only the nonlinear one has it. (default: it is of a tissue)"""
    ellipsoid: SolidInclusionEllipsoid
    """An ellipsoid. (default: another shape is there)"""
    mesh: str
    """A mesh file with a closed surface in the organ, as of a tumour or a vessel. (default: another shape is there)"""
    mesh_unit: Literal["m", "cm", "mm", "um", "in"]
    """The unit of the coordinates in the mesh file. (default: the file's own unit, or a guess from its size, with a warning)"""
    name: str
    """What people call it. (default: its number)"""
    stiffness_ratio: float
    """In place of a tissue: of a ball, an ellipsoid or a capsule of the organ's tissue so many times as stiff. Its effect on the force is estimated and needs no preparation, so that it may be drawn for each attempt; where it stays, a tissue is more accurate. (default: it is of a tissue)"""
    tissue: str | TissueTissue
    """A tissue file, or a table with a tissue's keys. (default: `builtin_tissue` names one)"""


class SolidLayer(TypedDict, total=False):
    """Layers from the outer surface inwards, outside of those of `region`. (default: none)"""

    builtin_tissue: Literal["pig-liver", "pig-kidney", "pig-spleen", "pig-esophagus"]
    """A tissue that comes with the program. (required without `tissue`)"""
    name: str
    """What people call it. (default: its number)"""
    thickness_cm: float
    """Its thickness. (required)"""
    thickness_m: float
    thickness_mm: float
    thickness_nm: float
    thickness_um: float
    tissue: str | TissueTissue
    """A tissue file, or a table with a tissue's keys. (default: `builtin_tissue` names one)"""


class SolidLoadLine(TypedDict, total=False):
    """It acts evenly along a straight line on the surface, such as an edge. (default: another key says where it acts)"""

    from_cm: Sequence[float]
    """One end. (required)"""
    from_m: Sequence[float]
    from_mm: Sequence[float]
    from_nm: Sequence[float]
    from_um: Sequence[float]
    to_cm: Sequence[float]
    """The other end. (required)"""
    to_m: Sequence[float]
    to_mm: Sequence[float]
    to_nm: Sequence[float]
    to_um: Sequence[float]


class SolidLoad(TypedDict, total=False):
    """Forces on the surface that keep their direction while the body turns, and pressures that stay normal to it. (default: none)"""

    box_cm: Sequence[Sequence[float]]
    """It acts evenly on the part of the surface in a box along the axes, of which two opposite corners are given. (default: another key says where it acts)"""
    box_m: Sequence[Sequence[float]]
    box_mm: Sequence[Sequence[float]]
    box_nm: Sequence[Sequence[float]]
    box_um: Sequence[Sequence[float]]
    center_cm: Sequence[float]
    """It acts evenly on the part of the surface in a ball about this centre, of `radius_m`. (default: another key says where it acts)"""
    center_m: Sequence[float]
    center_mm: Sequence[float]
    center_nm: Sequence[float]
    center_um: Sequence[float]
    force_gf: Sequence[float]
    """The whole force. (default: it is a pressure)"""
    force_kgf: Sequence[float]
    force_kn: Sequence[float]
    force_mn: Sequence[float]
    force_n: Sequence[float]
    force_nn: Sequence[float]
    force_un: Sequence[float]
    line: SolidLoadLine
    """It acts evenly along a straight line on the surface, such as an edge. (default: another key says where it acts)"""
    pressure_gpa: float
    """A pressure towards the inside, in place of `force_n`; it stays normal to the surface while the body deforms. It acts on all of the outer surface where no key says where. (default: it is a force)"""
    pressure_kpa: float
    pressure_mmhg: float
    pressure_mpa: float
    pressure_pa: float
    radius_cm: float
    """The radius of the ball about `center_m`. (default: another key says where it acts)"""
    radius_m: float
    radius_mm: float
    radius_nm: float
    radius_um: float
    region: SolidAnchor
    """It acts evenly on the part of the surface in these regions. (default: another key says where it acts)"""


class SolidPatch(TypedDict, total=False):
    """The part of the surface that is moved. A patch, a tool, gravity or a load has to be there. (default: nothing is moved)"""

    center_cm: Sequence[float]
    """Its centre. (required)"""
    center_m: Sequence[float]
    center_mm: Sequence[float]
    center_nm: Sequence[float]
    center_um: Sequence[float]
    contact: Literal["stick", "slip", "bonded"]
    """Their tangential boundary condition. (default "stick")"""
    displacement_cm: Sequence[float]
    """How far they move. (required)"""
    displacement_m: Sequence[float]
    displacement_mm: Sequence[float]
    displacement_nm: Sequence[float]
    displacement_um: Sequence[float]
    radius_cm: float
    """Points of the surface within this distance of the centre move. (required)"""
    radius_m: float
    radius_mm: float
    radius_nm: float
    radius_um: float


class SolidPoint(TypedDict, total=False):
    """Points of the body whose displacement is asked for, with names and measurements. (default: none)"""

    along: Sequence[float]
    """The direction along which it was measured. (default: it was not)"""
    at_cm: Sequence[float]
    """Where it is at rest. (required)"""
    at_m: Sequence[float]
    at_mm: Sequence[float]
    at_nm: Sequence[float]
    at_um: Sequence[float]
    measured_cm: float
    """How far along that direction it was measured to move. (default: it was not)"""
    measured_m: float
    measured_mm: float
    measured_nm: float
    measured_um: float
    name: str
    """What people call it. (default: its number)"""


class SolidRegionLayer(TypedDict, total=False):
    """A layer below the outer surface; several lie one below the other, from outside inwards, in the order of the file. A layer or another shape has to be there. (default: another shape is there)"""

    thickness_cm: float
    """Its thickness. (required)"""
    thickness_m: float
    thickness_mm: float
    thickness_nm: float
    thickness_um: float


class SolidRegion(TypedDict, total=False):
    """Parts with a tissue of their own, and cavities: layers, shapes inside such as a tumour or a vessel, and regions of a volume mesh. Shapes are above layers, and these above regions of the mesh. What is in none of them is of `tissue`. Tetrahedra do not cross their borders. (default: it is of one tissue)"""

    ball: SolidInclusionBall
    """A ball. (default: another shape is there)"""
    builtin_tissue: Literal["pig-liver", "pig-kidney", "pig-spleen", "pig-esophagus"]
    """A tissue that comes with the program. (default: `tissue` or `cavity` is there)"""
    capsule: SolidInclusionCapsule
    """All points within a distance of a line segment. (default: another shape is there)"""
    cavity: SolidInclusionCavity
    """In place of a tissue: a cavity that tissue encloses, such as a gall bladder; `{}` is an empty one. Of the models of a scene only the nonlinear one has it. (default: it is of a tissue)"""
    ellipsoid: SolidInclusionEllipsoid
    """An ellipsoid. (default: another shape is there)"""
    group: str
    """The name of the physical group in a Gmsh file. (default: another shape is there)"""
    label: int
    """The number of a region in the file of a volume mesh: a physical group of Gmsh, or a whole number in the cell data of VTK. (default: another shape is there)"""
    layer: SolidRegionLayer
    """A layer below the outer surface; several lie one below the other, from outside inwards, in the order of the file. A layer or another shape has to be there. (default: another shape is there)"""
    mesh_unit: Literal["m", "cm", "mm", "um", "in"]
    """The unit of the coordinates in the mesh file. (default: the file's own unit, or a guess from its size, with a warning)"""
    name: str
    """What people call it. (default: its group or number)"""
    number: int
    """As `label`. (default: another shape is there)"""
    surface: str
    """A mesh file with a closed surface in the body, as of a tumour or a vessel. (default: another shape is there)"""
    tissue: str | TissueTissue
    """A tissue file, or a table with a tissue's keys. (default: `builtin_tissue` names one)"""


class SolidTool(TypedDict, total=False):
    """Rigid tools that press the body where they meet it, and are dragged along it. They move when gravity, loads and the patch have come to their full size. (default: none)"""

    along: Sequence[float]
    """A second direction, across the first: in which a cylinder or a bar lies, or jaws close. (default: any)"""
    contact: Literal["stick", "slip", "bonded"]
    """How it holds tissue while it presses it; nothing holds what is pulled away. (default "slip")"""
    direction: Sequence[float]
    """Where it points to, into the body. (default [0.0, 0.0, -1.0])"""
    edge_radius_cm: float
    """The radius to which edges, or the apex of a cone, are rounded; sharp ones need fine meshes. (default: edges are sharp)"""
    edge_radius_m: float
    edge_radius_mm: float
    edge_radius_nm: float
    edge_radius_um: float
    friction: float
    """Coulomb's coefficient, in place of `contact`: tissue sticks below this part of the normal force, and slips at it. (default: `contact` says how it holds tissue)"""
    from_cm: Sequence[float]
    """Where it is at the beginning, off the body or just on it. (required)"""
    from_m: Sequence[float]
    from_mm: Sequence[float]
    from_nm: Sequence[float]
    from_um: Sequence[float]
    half_angle_deg: float
    """The angle between a cone's axis and its side. (default: it is no cone)"""
    half_angle_rad: float
    length_cm: float
    """The length of a cylinder, with its ends. (default: it is no cylinder)"""
    length_m: float
    length_mm: float
    length_nm: float
    length_um: float
    lengths_cm: Sequence[float]
    """The three lengths of a bar or of each jaw. (default: it is neither)"""
    lengths_m: Sequence[float]
    lengths_mm: Sequence[float]
    lengths_nm: Sequence[float]
    lengths_um: Sequence[float]
    name: str
    """What people call it. (default: its number)"""
    opening_cm: Sequence[float]
    """How far jaws are apart at the beginning, and at each place of the path. (default: it has no jaws)"""
    opening_m: Sequence[float]
    opening_mm: Sequence[float]
    opening_nm: Sequence[float]
    opening_um: Sequence[float]
    path_cm: Sequence[Sequence[float]]
    """Where it goes, on straight lines; forces are answered for at each of these places. All tools move together. (required)"""
    path_m: Sequence[Sequence[float]]
    path_mm: Sequence[Sequence[float]]
    path_nm: Sequence[Sequence[float]]
    path_um: Sequence[Sequence[float]]
    radius_cm: float
    """Its radius. (default: its shape has none)"""
    radius_m: float
    radius_mm: float
    radius_nm: float
    radius_um: float
    shape: Required[Literal["sphere", "flat_punch", "cone", "cylinder", "bar", "plate", "jaws"]]
    """Its shape. (required)"""


class Solid(TypedDict, total=False):
    """A body of any shape, fixed at one part, and moved or loaded at others."""

    accuracy: float
    """The relative error that is asked for. (default 0.01)"""
    anchor: SolidAnchor
    """The fixed part. (default: where a built-in shape grows)"""
    builtin: Literal["esophagus", "liver", "kidney", "stomach", "spleen", "diaphragm", "hemisphere", "cube", "slab"]
    """A shape that comes with the program. (required without `mesh`)"""
    builtin_tissue: Literal["pig-liver", "pig-kidney", "pig-spleen", "pig-esophagus"]
    """A tissue that comes with the program. (required without `tissue`)"""
    fibres: SolidFibres
    """Where the fibres of the tissue point to at rest; the law `holzapfel_gasser_ogden` needs it. (default: the tissue has no fibres)"""
    fit_stiffness: bool
    """Whether the moduli of all tissues are multiplied by the factor with which the points move as measured, by least squares. (default false)"""
    format: Literal[1]
    """The version of the format."""
    gravity_m_per_s2: Sequence[float]
    """The acceleration by which the body hangs under its own weight; `tissue.density_kg_m3` is its density. (default: it has no weight)"""
    inclusion: Sequence[SolidInclusion]
    """Shapes inside, as in `region`. (default: none)"""
    kind: Required[Literal["indentation", "hemisphere", "tube", "uniaxial", "solid"]]
    """What is solved. (required)"""
    layer: Sequence[SolidLayer]
    """Layers from the outer surface inwards, outside of those of `region`. (default: none)"""
    load: Sequence[SolidLoad]
    """Forces on the surface that keep their direction while the body turns, and pressures that stay normal to it. (default: none)"""
    mesh: str
    """A mesh file: STL, OBJ, PLY or glTF. (default: `builtin` names a shape)"""
    mesh_unit: Literal["m", "cm", "mm", "um", "in"]
    """The unit of the coordinates in the mesh file. (default: the file's own unit, or a guess from its size, with a warning)"""
    patch: SolidPatch
    """The part of the surface that is moved. A patch, a tool, gravity or a load has to be there. (default: nothing is moved)"""
    point: Sequence[SolidPoint]
    """Points of the body whose displacement is asked for, with names and measurements. (default: none)"""
    points_cm: Sequence[Sequence[float]]
    """Points whose nearest material points' `displacement_m` is asked for; they come after those of `point`. (default: none)"""
    points_m: Sequence[Sequence[float]]
    points_mm: Sequence[Sequence[float]]
    points_nm: Sequence[Sequence[float]]
    points_um: Sequence[Sequence[float]]
    region: Sequence[SolidRegion]
    """Parts with a tissue of their own, and cavities: layers, shapes inside such as a tumour or a vessel, and regions of a volume mesh. Shapes are above layers, and these above regions of the mesh. What is in none of them is of `tissue`. Tetrahedra do not cross their borders. (default: it is of one tissue)"""
    tissue: str | TissueTissue
    """A tissue file, or a table with a tissue's keys. (default: `builtin_tissue` names one)"""
    tool: Sequence[SolidTool]
    """Rigid tools that press the body where they meet it, and are dragged along it. They move when gravity, loads and the patch have come to their full size. (default: none)"""
    triangles: int
    """About how many triangles a built-in shape has. (default: the shape's own number)"""
