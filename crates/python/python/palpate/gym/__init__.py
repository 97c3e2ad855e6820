"""Gymnasium environments: a tip that palpates, pulls or cuts an organ.

``import palpate.gym`` registers

- ``palpate/Palpation-v0``: find the stiff spot under the surface (`PalpationEnv`),
- ``palpate/Traction-v0``: grasp tissue and hold an even pull (`TractionEnv`),
- ``palpate/Cutting-v0``: cut along a line, and no deeper (`CuttingEnv`).

Each takes any `palpate.Scene` with the task, and has a vectorised form (`TouchVectorEnv`) that steps many organs of one
prepared model on several threads::

    environments = gymnasium.make_vec("palpate/Palpation-v0", num_envs=16, vectorization_mode="vector_entry_point")

The same seed is the same episode to the bit, alone and vectorised. An action lasts `substeps` steps of the model, ten
of 5 ms.
"""

import importlib.util

if importlib.util.find_spec("gymnasium") is None:
    raise ImportError("palpate.gym needs gymnasium, which is not installed; `pip install palpate[gym]`")

from palpate.gym.environment import CuttingEnv, PalpationEnv, TouchEnv, TractionEnv
from palpate.gym.randomization import Randomization
from palpate.gym.registration import register
from palpate.gym.touch import EpisodeState
from palpate.gym.vector import CuttingVectorEnv, PalpationVectorEnv, TouchVectorEnv, TractionVectorEnv

__all__ = [
    "CuttingEnv",
    "CuttingVectorEnv",
    "EpisodeState",
    "PalpationEnv",
    "PalpationVectorEnv",
    "Randomization",
    "TouchEnv",
    "TouchVectorEnv",
    "TractionEnv",
    "TractionVectorEnv",
]

register()
