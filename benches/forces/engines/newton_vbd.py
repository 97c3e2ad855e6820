"""Newton's vertex block descent on the processor; the force is its observable `CONTACT_F`."""

import importlib.metadata
import time

import newton
import numpy as np
import warp

from scene import lame

LAW = "stable_neo_hookean"
MESHES = ["coarse", "fine"]
SETTINGS = """Steps of 1/600 s, 10 iterations, as in its examples; density 1000 kg/m3, no gravity; damping 100 Pa s; contact
1000 N/m for each particle, no friction, particle radius 0.1 mm. Tuned: damping and contact stiffness, by the sphere on
the cube; XPBD blew up with the one setting that was tried."""
STEP = 1 / 600  # [s]
RADIUS = 1e-4  # of a particle [m]


def version():
    return f"{importlib.metadata.version('newton')}, Warp {warp.__version__}"


def unfit(scene):
    return scene.not_a_press(grip="its observables have no force on prescribed nodes")


def run(scene, mesh):
    warp.config.quiet = True
    began = time.perf_counter()
    with warp.ScopedDevice("cpu"):
        return pressed(scene, mesh, began)


def pressed(scene, mesh, began):
    mu, lam = [np.full(len(mesh.elements), value) for value in scene.lame]
    if scene.second:
        stiff = lame(scene.second["youngs_modulus_pa"], scene.tissue["poissons_ratio"])
        for values, value in zip((mu, lam), stiff):
            values[mesh.inside(scene)] = value
    builder = newton.ModelBuilder(gravity=(0.0, 0.0, 0.0))
    builder.add_soft_mesh(
        pos=warp.vec3(0.0, 0.0, 0.0),
        rot=warp.quat_identity(),
        scale=1.0,
        vel=warp.vec3(0.0, 0.0, 0.0),
        vertices=[warp.vec3(*place) for place in mesh.nodes],
        indices=mesh.elements.ravel().tolist(),
        density=1000.0,
        k_mu=mu,
        k_lambda=lam,
        k_damp=100.0,
        particle_radius=RADIUS,
    )
    for node in mesh.fixed:
        builder.particle_mass[node] = 0.0
    ball = scene.tool["shape"] == "sphere"
    above = RADIUS + (scene.radius if ball else 0.5 * scene.radius)
    tool = builder.add_body(xform=warp.transform(warp.vec3(0.0, 0.0, above), warp.quat_identity()), is_kinematic=True)
    config = newton.ModelBuilder.ShapeConfig(ke=1e3, kd=0.0, mu=0.0)
    if ball:
        builder.add_shape_sphere(tool, radius=scene.radius, cfg=config)
    else:
        builder.add_shape_cylinder(tool, radius=scene.radius, half_height=0.5 * scene.radius, cfg=config)
    builder.color()
    model = builder.finalize()
    model.soft_contact_ke, model.soft_contact_kd, model.soft_contact_mu = 1e3, 0.0, 0.0
    pipeline = newton.CollisionPipeline(model, soft_contact_gap=2e-3)
    contacts = pipeline.contacts()
    solver = newton.solvers.SolverVBD(model, iterations=10)
    kinds = newton.solvers.SolverBase.ObservableKind
    observed = solver.observables({kinds.CONTACT_F}, contacts=contacts)
    states, control = [model.state(), model.state()], model.control()
    times = scene.times(STEP)
    forces, settled, durations, first = [], [], [], None
    for now in times:
        pose = np.array([[0.0, 0.0, above - scene.depth(now), 0.0, 0.0, 0.0, 1.0]], dtype=np.float32)
        moving = np.array([[0.0, 0.0, -scene.speed(now, STEP), 0.0, 0.0, 0.0]], dtype=np.float32)
        for state in states:
            state.body_q.assign(pose)
            state.body_qd.assign(moving)
        before = time.perf_counter()
        states[0].clear_forces()
        pipeline.collide(states[0], contacts)
        solver.step(states[0], states[1], control, contacts, STEP, observables=observed)
        after = time.perf_counter()
        durations.append(after - before)
        first = first or after - began
        states.reverse()
        forces.append(abs(float(observed.contact_f.numpy()[:, :3].sum(axis=0)[2])))
        settled.append(mesh.settling(states[0].particle_q.numpy()))
    return {"time": times, "force": np.array(forces), "settled": np.array(settled), "steps_s": durations, "first_s": first}
