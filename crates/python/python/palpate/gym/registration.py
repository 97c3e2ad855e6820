"""The names that `gymnasium.make` knows."""

from __future__ import annotations

import gymnasium

NAMES = ("Palpation", "Traction", "Cutting")


def register() -> None:
    """Makes the environments known, once."""
    for name in NAMES:
        identity = f"palpate/{name}-v0"
        if identity not in gymnasium.registry:
            gymnasium.register(
                identity,
                entry_point=f"palpate.gym.environment:{name}Env",
                vector_entry_point=f"palpate.gym.vector:{name}VectorEnv",
            )
