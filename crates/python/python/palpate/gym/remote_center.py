"""An arm with a remote centre: its shaft always passes through the trocar, as that of a dVRK's patient side
manipulator does."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

#: Lower and upper limits of yaw, pitch [rad], insertion [m] and roll [rad], about those of a dVRK arm.
LIMITS = np.array([[-1.60, -0.93, 0.005, -4.5], [1.60, 0.93, 0.240, 4.5]])
#: The insertion at which the angles take the tip across the shaft as fast as the insertion takes it along [m].
TYPICAL_INSERTION = 0.2
#: The most that the shaft rolls [rad/s].
ROLL_SPEED = 1.5


class RemoteCenter:
    """Joints of yaw, pitch, insertion and roll about a fixed point. At zero angles the shaft points at `target`.

    Parameters
    ----------
    center : ndarray, shape (3,)
        The remote centre [m].
    target : ndarray, shape (3,)
        Where the shaft points at zero angles [m].
    """

    def __init__(self, center: Floats, target: Floats) -> None:
        self.center = center
        ahead = (target - center) / np.linalg.norm(target - center)
        up = np.array([0.0, 0.0, 1.0]) if abs(ahead[2]) < 0.9 else np.array([0.0, 1.0, 0.0])
        across = np.cross(up, ahead)
        across /= np.linalg.norm(across)
        #: From the arm's frame to the scene's: across, the rest, ahead.
        self.base = np.column_stack([across, np.cross(ahead, across), ahead])

    def joints(self, tip: Floats) -> Floats:
        """Yaw, pitch [rad], insertion [m] and a roll of zero at which the tip is at a place [m], within the limits."""
        way = self.base.T @ (tip - self.center)
        insertion = float(np.linalg.norm(way))
        x, y, z = way / insertion
        found: Floats = np.clip([np.arctan2(x, z), -np.arcsin(y), insertion, 0.0], *LIMITS)
        return found

    def poses(self, joints: Floats) -> tuple[Floats, Floats]:
        """Places of the tips [m] and quaternions (x, y, z, w) from tool to scene, for rows of joints (..., 4)."""
        yaw, pitch, insertion, roll = np.moveaxis(joints, -1, 0)
        ahead = np.stack([np.sin(yaw) * np.cos(pitch), -np.sin(pitch), np.cos(yaw) * np.cos(pitch)], axis=-1)
        tips = self.center + insertion[..., None] * (ahead @ self.base.T)
        # The shaft runs along the tool's +z, away from its tip: half a turn about x.
        turns = (_about(1, yaw), _about(0, pitch), _about(2, roll), _about(0, np.full_like(roll, np.pi)))
        turned = np.broadcast_to(_of_matrix(self.base), (*roll.shape, 4))
        for turn in turns:
            turned = _product(turned, turn)
        return tips, turned


def _about(axis: int, angle: Floats) -> Floats:
    turn = np.zeros((*angle.shape, 4))
    turn[..., axis], turn[..., 3] = np.sin(0.5 * angle), np.cos(0.5 * angle)
    return turn


def _product(a: Floats, b: Floats) -> Floats:
    vector = a[..., 3:] * b[..., :3] + b[..., 3:] * a[..., :3] + np.cross(a[..., :3], b[..., :3])
    scalar = a[..., 3:] * b[..., 3:] - np.sum(a[..., :3] * b[..., :3], axis=-1, keepdims=True)
    return np.concatenate([vector, scalar], axis=-1)


def _of_matrix(matrix: Floats) -> Floats:
    """The eigenvector of the largest eigenvalue [Bar-Itzhack 2000], which no rotation makes singular."""
    (a, b, c), (d, e, f), (g, h, i) = matrix
    symmetric = np.array(
        [
            [a - e - i, b + d, c + g, h - f],
            [b + d, e - a - i, f + h, c - g],
            [c + g, f + h, i - a - e, d - b],
            [h - f, c - g, d - b, a + e + i],
        ]
    )
    vector: Floats = np.linalg.eigh(symmetric)[1][:, -1]
    return vector


def rotated(quaternions: Floats, vector: Floats) -> Floats:
    """A vector turned by rows of quaternions (x, y, z, w)."""
    axis = quaternions[..., :3]
    twice = 2.0 * np.cross(axis, vector)
    turned: Floats = vector + quaternions[..., 3:] * twice + np.cross(axis, twice)
    return turned
