"""PyBullet's deformable body of finite elements; the force is that of the constraint that moves the tool."""

import importlib.metadata
import pathlib
import tempfile
import time

import numpy as np
import pybullet as bullet

from meshes import legacy_vtk

LAW = "stable_neo_hookean_logarithm"
MESHES = ["coarse", "fine"]
SETTINGS = """Deformable world, steps of 1 ms; lengths ten times as large, for its collisions (forces are a hundred times
as large, and divided); shear modulus 4/3 of Lamé's and lambda + 5/6 mu, without which its law is a quarter too soft;
damping 0.01, margin 2 mm of the enlarged (a quarter of it changes the force by half a percent), face contact, no friction. Tuned: scale, damping and margin, by the sphere on the
cube."""
STEP = 0.001  # [s]
SCALE = 10.0
MARGIN = 0.002  # [m], enlarged


def version():
    return importlib.metadata.version("pybullet")


def unfit(scene):
    return "a body has one material" if scene.second else scene.not_a_press()


def run(scene, mesh):
    began = time.perf_counter()
    bullet.connect(bullet.DIRECT)
    try:
        return pressed(scene, mesh, began)
    finally:
        bullet.disconnect()


def pressed(scene, mesh, began):
    bullet.resetSimulation(bullet.RESET_USE_DEFORMABLE_WORLD)
    bullet.setGravity(0, 0, 0)
    bullet.setTimeStep(STEP)
    mu, lam = scene.lame
    corners = mesh.nodes[mesh.elements]
    volume = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])).sum() / 6
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "body.vtk"
        path.write_text(legacy_vtk(SCALE * mesh.nodes, mesh.elements))
        body = bullet.loadSoftBody(
            str(path),
            mass=1000.0 * volume * SCALE,
            useNeoHookean=1,
            NeoHookeanMu=4 / 3 * mu,
            NeoHookeanLambda=lam + 5 / 6 * mu,
            NeoHookeanDamping=0.01,
            collisionMargin=MARGIN,
            frictionCoeff=0.0,
            useFaceContact=1,
            useSelfCollision=0,
        )
    for node in mesh.fixed:
        bullet.createSoftBodyAnchor(body, int(node), -1, -1)
    ball = scene.tool["shape"] == "sphere"
    above = SCALE * (scene.radius if ball else 0.5 * scene.radius) + MARGIN
    if ball:
        shape = bullet.createCollisionShape(bullet.GEOM_SPHERE, radius=SCALE * scene.radius)
    else:
        shape = bullet.createCollisionShape(bullet.GEOM_CYLINDER, radius=SCALE * scene.radius, height=SCALE * scene.radius)
    tool = bullet.createMultiBody(1.0, shape, basePosition=[0, 0, above])
    bullet.changeDynamics(tool, -1, lateralFriction=0.0)
    held = bullet.createConstraint(tool, -1, -1, -1, bullet.JOINT_FIXED, [0, 0, 0], [0, 0, 0], [0, 0, above])
    times = scene.times(STEP)
    forces, settled, durations, first = [], [], [], None
    for now in times:
        bullet.changeConstraint(held, [0, 0, above - SCALE * scene.depth(now)], maxForce=1e6)
        before = time.perf_counter()
        bullet.stepSimulation()
        after = time.perf_counter()
        durations.append(after - before)
        first = first or after - began
        forces.append(abs(bullet.getConstraintState(held)[2]) / SCALE**2)
        _, places = bullet.getMeshData(body, -1, flags=bullet.MESH_DATA_SIMULATION_MESH)
        settled.append(mesh.settling(np.array(places) / SCALE))
    return {"time": times, "force": np.array(forces), "settled": np.array(settled), "steps_s": durations, "first_s": first}
