"""The listings drawn once each, and which points of their scene see the lamp."""

from functools import cache

import numpy as np

from softshadow import listings
from softshadow.listings.stage import SIZE, Stage, begin_frame
from softshadow.testing import ProgramResult, run_here

DEEPEST = 2**24 - 1
BEGINNING = 1e-4  # of the way to the lamp: a surface does not shade itself by the rounding of its depth


@cache
def corrected(name: str) -> ProgramResult:
    return run_here(listings.get(name).corrected, SIZE)


@cache
def printed(name: str) -> ProgramResult:
    return run_here(listings.get(name).printed, SIZE)


@cache
def without(name: str, number: str) -> ProgramResult:
    return run_here(listings.get(name).without(number), SIZE)


def pixels(ours: np.ndarray, theirs: np.ndarray) -> int:
    """Return in how many pixels two planes differ."""
    differs = ours != theirs
    return int(np.count_nonzero(differs.any(axis=-1) if differs.ndim == 3 else differs))


def in_shadow(stage: Stage, depth: np.ndarray, far: float | None) -> tuple[np.ndarray, np.ndarray]:
    """Return by slabs, not by volumes, which pixels are in shadow, and which hold a surface at all; both (h, w)."""

    def matrices(gl):
        begin_frame(gl, stage, far)
        return [gl.glGetFloatv(gl.GL_PROJECTION_MATRIX).T, gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX).T]

    projection, view = (np.asarray(each, np.float64) for each in run_here(matrices, SIZE).returned)
    width, height = SIZE
    x, y = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    clip = np.stack([2 * x - 1, 2 * y - 1, 2 * depth / DEEPEST - 1, np.ones_like(x)], axis=-1)
    world = clip @ np.linalg.inv(projection @ view).T
    shadowed = np.zeros(depth.shape, bool)
    with np.errstate(all="ignore"):  # the background of a camera without far plane is at infinity
        points = world[..., :3] / world[..., 3:]
        way = np.array(stage.light[:3]) - points
        for thing in stage.occluder:
            low, high = thing.mesh.positions.min(axis=0), thing.mesh.positions.max(axis=0)
            near, away = np.sort([(low - points) / way, (high - points) / way], axis=0)
            shadowed |= np.maximum(near.max(axis=-1), BEGINNING) < np.minimum(away.min(axis=-1), 1)
    surface = depth < DEEPEST
    return shadowed & surface, surface
