"""A three-joint arm in MuJoCo presses a liver in palpate, which gets the tip's position and returns the force.

pip install palpate mujoco
python examples/python/couple_to_mujoco.py

In each step of MuJoCo palpate takes the tip's position and returns the force [N], which acts on the arm's last body
in the same step (`xfrc_applied`, at the body's centre of mass, with the torque of the lever arm). The coupling is
explicit: it is stable if the tissue's stiffness times the step squared is far below the moving mass, here 30 N/m, 2
ms and 0.3 kg.
"""

import mujoco
import numpy as np
import palpate

STEP = 0.002  # [s], of both
TIP_RADIUS = 0.004  # [m]

ARM = f"""
<mujoco>
  <option timestep="{STEP}" gravity="0 0 0" integrator="implicitfast"/>
  <default><joint damping="2"/><position kp="400" ctrlrange="-3 3"/></default>
  <worldbody>
    <body name="base" pos="0 0 0">
      <joint name="yaw" axis="0 0 1"/>
      <geom type="capsule" fromto="0 0 0 0 0 0.05" size="0.02" mass="1"/>
      <body name="upper" pos="0 0 0.05">
        <joint name="shoulder" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.015" mass="0.5"/>
        <body name="lower" pos="0.2 0 0">
          <joint name="elbow" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.01" mass="0.3"/>
          <site name="tip" pos="0.2 0 0" size="{TIP_RADIUS}"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <position joint="yaw"/><position joint="shoulder"/><position joint="elbow"/>
  </actuator>
</mujoco>
"""


def tissue() -> palpate.Simulation:
    """A liver under a round tip, at the arm's step."""
    return palpate.Simulation(
        palpate.Scene(
            {
                "organ": {
                    "builtin": "liver",
                    "triangles": 4000,
                    "builtin_tissue": "pig-liver",
                },
                "tool": [
                    {
                        "name": "right",
                        "tip": {"shape": "sphere", "radius_m": TIP_RADIUS},
                    }
                ],
                "model": {"kind": "local", "step_s": STEP},
            }
        )
    )


class Coupling:
    """An arm above the top of an organ, coupled to the organ's force."""

    def __init__(self) -> None:
        self.model = mujoco.MjModel.from_xml_string(ARM)
        self.data = mujoco.MjData(self.model)
        self.organ = tissue()
        self.body = self.model.body("lower").id
        self.site = self.model.site("tip").id
        # Bent, with the tip 10 mm above the highest point of the organ.
        self.data.qpos[:] = self.data.ctrl[:] = [0.0, -0.6, 1.5]
        mujoco.mj_forward(self.model, self.data)
        vertices = self.organ.surface.vertices
        top = vertices[vertices[:, 2].argmax()] + [0.0, 0.0, TIP_RADIUS + 0.01]
        self.to_organ = top - self.data.site_xpos[self.site]
        self.force = np.zeros(3)

    def step(self) -> None:
        """One step of both."""
        tip = self.data.site_xpos[self.site]
        self.force = self.organ.step(tip + self.to_organ)[0]
        lever = tip - self.data.xipos[self.body]
        self.data.xfrc_applied[self.body] = np.concatenate([self.force, np.cross(lever, self.force)])
        mujoco.mj_step(self.model, self.data)

    def joint_torques(self) -> np.ndarray:
        """The tissue's torques at the joints [N m]: the transposed Jacobian of the tip times the force."""
        jacobian = np.zeros((3, self.model.nv))
        mujoco.mj_jacSite(self.model, self.data, jacobian, None, self.site)
        return jacobian.T @ self.force


def main() -> None:
    coupling = Coupling()
    start = coupling.data.ctrl.copy()
    print("time [s]  depth [mm]  force [N]  torque of the elbow [N m]")
    for number in range(1000):
        # Down over half a second, then hold.
        coupling.data.ctrl[1] = start[1] + 0.055 * min(number * STEP / 0.5, 1.0)
        coupling.step()
        if number % 100 == 99:
            state = coupling.organ.state
            print(
                f"{coupling.data.time:8.2f}  {1e3 * state.depths[0]:10.2f}  "
                f"{np.linalg.norm(coupling.force):9.3f}  {coupling.joint_torques()[2]:25.4f}"
            )
    # At rest the actuators balance exactly the tissue's torques at the joints.
    carried = coupling.data.actuator_force
    assert np.linalg.norm(coupling.force) > 0.05
    assert np.allclose(carried, -coupling.joint_torques(), rtol=0.02, atol=1e-4), (
        carried,
        coupling.joint_torques(),
    )


if __name__ == "__main__":
    main()
