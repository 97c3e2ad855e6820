"""MuJoCo, a flex of three dimensions under a mocap body; the force is the sum of `mj_contactForce`."""

import time

import mujoco
import numpy as np

LAW = "saint_venant_kirchhoff"
MESHES = ["coarse", "fine"]
SETTINGS = """Integrator `discrete` (before 4.0: `implicitfast`), steps of 2 ms, CG; elasticity damping 0.02 s; density
1000 kg/m3, no gravity; flex radius 0.1 mm; contact without friction (condim 1), solref 0.004 1, solimp .99 .999 .0001. Tuned: damping and solref, by the sphere on the cube."""
RADIUS = 1e-4  # of the flex [m]
STEP = 0.002  # [s]


def version():
    return mujoco.__version__


def unfit(scene):
    return "a flex has one material" if scene.second else scene.not_a_press()


def model_of(scene, mesh):
    joined = lambda values: " ".join(map(str, np.asarray(values).ravel()))
    volume = np.abs(np.linalg.det(mesh.nodes[mesh.elements][:, 1:] - mesh.nodes[mesh.elements][:, :1])).sum() / 6
    size = f"{scene.radius}" if scene.tool["shape"] == "sphere" else f"{scene.radius} {0.5 * scene.radius}"
    kind = "sphere" if scene.tool["shape"] == "sphere" else "cylinder"
    integrator = "discrete" if int(mujoco.__version__.split(".")[0]) >= 4 else "implicitfast"
    contact = 'condim="1" solref="0.004 1" solimp=".99 .999 .0001"'
    return mujoco.MjModel.from_xml_string(f"""
<mujoco>
  <option timestep="{STEP}" gravity="0 0 0" integrator="{integrator}" solver="CG" tolerance="1e-8"/>
  <size memory="2G"/>
  <worldbody>
    <flexcomp name="body" type="direct" dim="3" radius="{RADIUS}" mass="{1000 * volume}"
      point="{joined(mesh.nodes)}" element="{joined(mesh.elements)}">
      <contact {contact} selfcollide="none"/>
      <elasticity young="{scene.tissue['youngs_modulus_pa']}" poisson="{scene.tissue['poissons_ratio']}" damping="0.02"/>
      <pin id="{joined(mesh.fixed)}"/>
    </flexcomp>
    <body name="tool" mocap="true"><geom name="tool" type="{kind}" size="{size}" {contact}/></body>
  </worldbody>
</mujoco>""")


def run(scene, mesh):
    began = time.perf_counter()
    model = model_of(scene, mesh)
    data = mujoco.MjData(model)
    above = RADIUS + (scene.radius if scene.tool["shape"] == "sphere" else 0.5 * scene.radius)
    times = scene.times(STEP)
    forces, settled, durations, first, six = [], [], [], None, np.zeros(6)
    for now in times:
        data.mocap_pos[0] = [0.0, 0.0, above - scene.depth(now)]
        before = time.perf_counter()
        mujoco.mj_step(model, data)
        after = time.perf_counter()
        durations.append(after - before)
        first = first or after - began
        total = 0.0
        for number in range(data.ncon):
            mujoco.mj_contactForce(model, data, number, six)
            total += abs(six[0] * data.contact[number].frame[2])
        forces.append(total)
        settled.append(mesh.settling(data.flexvert_xpos))
    return {"time": times, "force": np.array(forces), "settled": np.array(settled), "steps_s": durations, "first_s": first}
