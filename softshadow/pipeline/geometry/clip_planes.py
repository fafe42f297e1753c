"""The user's clip planes in clip space (GL 2.1, sec. 2.12): those of eye space times the inverse projection."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from softshadow.pipeline.commands import Draw
from softshadow.programs.inverse import inverse
from softshadow.state import ClipPlanes

NO_PLANES = np.empty((0, 4), np.float32)


def user_planes(command: Draw) -> np.ndarray:
    """Return the enabled clip planes (P, 4) of a draw."""
    return planes_in_clip_space(command.state.clip_planes, command.projection, command.projection_kind)


def planes_in_clip_space(planes: ClipPlanes, projection: np.ndarray, projection_kind: int) -> np.ndarray:
    """Return the enabled planes (P, 4)."""
    enabled = enabled_planes(planes)
    return in_clip_space(enabled, inverse(projection, projection_kind)[np.newaxis]) if enabled else NO_PLANES


def enabled_planes(planes: ClipPlanes) -> list[tuple[float, ...]]:
    """Return the equations of the enabled planes in eye space."""
    return [equation for on, equation in zip(planes.enabled, planes.equations, strict=True) if on]


def in_clip_space(planes: Sequence[tuple[float, ...]], inverses: np.ndarray) -> np.ndarray:
    """Return planes of eye space (P, 4); `inverses`: of the projection of each, or of all (P or 1, 4, 4)."""
    a, b, c, d = np.array(planes, np.float32).T[:, :, np.newaxis]
    with np.errstate(all="ignore"):  # also at glRasterPos and while draws are queued, not only in pipeline.draw
        result: np.ndarray = ((a * inverses[:, 0] + b * inverses[:, 1]) + c * inverses[:, 2]) + d * inverses[:, 3]
    return result
