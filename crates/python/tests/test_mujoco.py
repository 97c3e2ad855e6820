"""The example that couples an arm of MuJoCo to the tissue."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

pytest.importorskip("mujoco")

EXAMPLE = Path(__file__).parents[3] / "examples/python/couple_to_mujoco.py"


@pytest.fixture(scope="module")
def example() -> ModuleType:
    spec = importlib.util.spec_from_file_location("couple_to_mujoco", EXAMPLE)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_arm_carries_what_the_tissue_does(example: ModuleType, capsys: pytest.CaptureFixture[str]) -> None:
    """At rest the actuators' torques are those of the force through the tip's Jacobian, which the example asserts."""
    example.main()
    assert len(capsys.readouterr().out.splitlines()) == 11


def test_a_free_arm_is_pushed_out_of_the_tissue(example: ModuleType) -> None:
    """Momentum: without actuators and damping, the impulse of the tissue is what the tip gains along each joint."""
    coupling = example.Coupling()
    model, data = coupling.model, coupling.data
    model.actuator_gainprm[:] = model.actuator_biasprm[:] = 0.0
    model.dof_damping[:] = 0.0
    # As it stands, the tip is 3 mm in the organ.
    coupling.to_organ = coupling.to_organ - [0.0, 0.0, 0.013]
    coupling.step()
    assert coupling.force[2] > 0.01
    # A step from rest: M dv = J' F dt, up to the arm's turn within it, a thousandth.
    gained = np.zeros(model.nv)
    import mujoco

    mujoco.mj_mulM(model, data, gained, data.qvel)
    assert np.allclose(gained, coupling.joint_torques() * example.STEP, rtol=0.01, atol=1e-9)
    for _ in range(200):
        coupling.step()
    assert coupling.organ.state.depths[0] == 0.0 and np.linalg.norm(coupling.force) == 0.0
