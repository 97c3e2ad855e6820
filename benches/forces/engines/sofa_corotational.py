"""SOFA's linear tetrahedra in their turned frames, with Lagrange multipliers in contact; the force is the sum of these
over the nodes of the skin, divided by the step."""

import time

import numpy as np
import Sofa
import SofaRuntime

LAW = "corotated"
MESHES = ["coarse", "fine"]
SETTINGS = """TetrahedronFEMForceField, method `polar`; FreeMotionAnimationLoop with EulerImplicitSolver, SparseLDLSolver,
LinearSolverConstraintCorrection, BlockGaussSeidelConstraintSolver (1e-9, 1,000 iterations) and LocalMinDistance (alarm
2 mm, contact 0.1 mm), no friction; density 1000 kg/m3, no gravity, steps of 10 ms. The skin meets the tool with its points;
with its lines and triangles as well it is 7 to 11 % stiffer, and `lambda`, which is divided by the step to become the force,
counts contacts several times. Tuned: Rayleigh damping, by the sphere on the cube, to none."""
STEP = 0.01  # [s]
CONTACT = 1e-4  # distance at which bodies touch [m]
PLUGINS = """AnimationLoop Collision.Detection.Algorithm Collision.Detection.Intersection Collision.Geometry
Collision.Response.Contact Constraint.Lagrangian.Correction Constraint.Lagrangian.Solver Constraint.Projective
LinearSolver.Direct Mapping.Linear Mass ODESolver.Backward SolidMechanics.FEM.Elastic StateContainer Topology.Container.Dynamic"""


def version():
    return "built from source"


def unfit(scene):
    return scene.not_a_press()


def run(scene, mesh, method="polar"):
    began = time.perf_counter()
    root = Sofa.Core.Node("root")
    root.gravity, root.dt = [0, 0, 0], STEP
    for name in PLUGINS.split():
        SofaRuntime.importPlugin(f"Sofa.Component.{name}")
    root.addObject("FreeMotionAnimationLoop")
    root.addObject("BlockGaussSeidelConstraintSolver", tolerance=1e-9, maxIterations=1000)
    root.addObject("CollisionPipeline")
    root.addObject("BruteForceBroadPhase")
    root.addObject("BVHNarrowPhase")
    root.addObject("LocalMinDistance", alarmDistance=2e-3, contactDistance=CONTACT, angleCone=0.0)
    root.addObject("CollisionResponse", response="FrictionContactConstraint", responseParams="mu=0")

    young = np.full(len(mesh.elements), scene.tissue["youngs_modulus_pa"])
    if scene.second:
        young[mesh.inside(scene)] = scene.second["youngs_modulus_pa"]
    body = root.addChild("body")
    body.addObject("EulerImplicitSolver")
    body.addObject("SparseLDLSolver", template="CompressedRowSparseMatrixMat3x3d")
    body.addObject("TetrahedronSetTopologyContainer", position=mesh.nodes.tolist(), tetrahedra=mesh.elements.tolist())
    state = body.addObject("MechanicalObject", template="Vec3d")
    body.addObject("MeshMatrixMass", massDensity=1000.0, lumping=True, topology="@.")
    body.addObject(
        "TetrahedronFEMForceField",
        method=method,
        youngModulus=young.tolist(),
        poissonRatio=scene.tissue["poissons_ratio"],
    )
    body.addObject("FixedProjectiveConstraint", indices=mesh.fixed.tolist())
    body.addObject("LinearSolverConstraintCorrection")
    skin = body.addChild("skin")
    skin.addObject("TriangleSetTopologyContainer", position=mesh.nodes.tolist(), triangles=mesh.faces.tolist())
    points = skin.addObject("MechanicalObject", template="Vec3d")
    skin.addObject("PointCollisionModel", group=1)
    skin.addObject("IdentityMapping")

    above = CONTACT + (scene.radius if scene.tool["shape"] == "sphere" else 0.0)
    tool = root.addChild("tool")
    moved, rest = add_tool(tool, scene, above)

    Sofa.Simulation.init(root)
    times = scene.times(STEP)
    forces, settled, durations, first = [], [], [], None
    for now in times:
        with moved.position.writeable() as position:
            position[:] = rest - [0.0, 0.0, scene.depth(now)]
        before = time.perf_counter()
        Sofa.Simulation.animate(root, STEP)
        after = time.perf_counter()
        durations.append(after - before)
        first = first or after - began
        # Empty without a contact.
        pushed = points.getData("lambda").array()
        forces.append(abs(float(pushed[:, 2].sum())) / STEP if len(pushed) else 0.0)
        settled.append(mesh.settling(state.position.array()))
    return {"time": times, "force": np.array(forces), "settled": np.array(settled), "steps_s": durations, "first_s": first}


def add_tool(node, scene, above):
    """Its state and its points at the start [m]: a ball by its middle, a punch by the triangles of its end."""
    still = {"moving": True, "simulated": False, "group": 2}
    if scene.tool["shape"] == "sphere":
        rest = np.array([[0.0, 0.0, above]])
        state = node.addObject("MechanicalObject", template="Vec3d", position=rest.tolist())
        node.addObject("SphereCollisionModel", radius=scene.radius, **still)
        return state, rest
    angles = np.linspace(0.0, 2 * np.pi, 64, endpoint=False)
    ring = scene.radius * np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    rest = np.concatenate([[[0.0, 0.0, 0.0]], ring, ring + [0.0, 0.0, 0.5 * scene.radius]]) + [0.0, 0.0, above]
    count = len(ring)
    triangles = []
    for k in range(count):
        a, b = 1 + k, 1 + (k + 1) % count
        triangles += [[0, b, a], [a, b, a + count], [b, b + count, a + count]]
    node.addObject("TriangleSetTopologyContainer", position=rest.tolist(), triangles=triangles)
    state = node.addObject("MechanicalObject", template="Vec3d")
    node.addObject("TriangleCollisionModel", **still)
    return state, rest
