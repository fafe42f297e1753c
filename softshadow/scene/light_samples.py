"""Points of an area light that stand for all of it: what techniques that draw one hard shadow per point draw with."""

from dataclasses import replace
from typing import Literal, get_args

import numpy as np

from softshadow.errors import SceneError, nearest
from softshadow.scene.light_shapes import Disc, Segment, Sphere
from softshadow.scene.lights import Light
from softshadow.scene.sample_patterns import cube_to_ball, sobol, square_to_disc, strata

Pattern = Literal["corners", "grid", "jittered", "sobol", "random"]
PATTERNS: tuple[Pattern, ...] = get_args(Pattern)


def light_samples(light: Light, n: int, pattern: Pattern = "grid", seed: int = 0) -> np.ndarray:
    """Return n points of an area light, of equal weight; the same arguments give the same points.

    One point is the centre, with every pattern.

    A disc is sampled through a map of the square onto it that keeps areas. A sphere is filled inside, more densely
    towards its surface, so that the points fill the disc that any receiver sees evenly: they are no points of the
    surface.

    Parameters
    ----------
    pattern : str                "corners": 4 of a rectangle, 2 of a segment, 4 of a disc's rim, 6 of a sphere;
                                 "grid": the centres of n equal parts, k x k for n = k k, and in columns of different
                                 length for other n;
                                 "jittered": a random point of each of these parts;
                                 "sobol": the first n points of a Sobol sequence with randomly flipped bits;
                                 "random": independent points
    seed : int                   of jittered, sobol and random

    Returns
    -------
    (n, 3) float64               world space

    Raises
    ------
    ValueError                   n < 1, or an unknown pattern
    SceneError                   a light without a shape and n > 1, a light at infinity, or a number that the pattern
                                 "corners" does not have
    """
    if isinstance(n, bool) or not isinstance(n, int | np.integer) or n < 1:
        raise ValueError(f"n={n!r}: expected a number of points, 1 or more")
    if pattern not in PATTERNS:
        raise ValueError(f"pattern={pattern!r}: {nearest(str(pattern), PATTERNS)}")
    if light.is_directional:
        raise SceneError(f"{light.name}: a light at infinity has no points; expected a position with w > 0")
    center = light.position[:3]
    if n == 1:
        return center[None].copy()
    if light.shape is None:
        raise SceneError(f"{light.name}: a light without a shape has one point, not {n}; expected a shape or n=1")
    if pattern == "corners":
        corners = light.shape.corners
        if n != len(corners):
            raise SceneError(
                f"{light.name}: n={n}: expected 1 or {len(corners)}, the number of corners of a "
                f"{type(light.shape).__name__.lower()}"
            )
        return center + corners
    if isinstance(light.shape, Sphere):
        return center + light.shape.radius * cube_to_ball(_pattern_points(n, pattern, seed, 3))
    u, v = light.shape.half_axes
    columns = n if isinstance(light.shape, Segment) else None
    unit = _pattern_points(n, pattern, seed, 2, columns)
    a, b = (square_to_disc(unit) if isinstance(light.shape, Disc) else 2 * unit - 1).T
    return center + a[:, None] * u + b[:, None] * v


def sample_lights(light: Light, n: int, pattern: Pattern = "grid", seed: int = 0) -> tuple[Light, ...]:
    """Return the light as n point lights at its `light_samples`, for techniques that draw one light after the other.

    They differ from it in position and name ("lamp 1", "lamp 2" ...), and have no shape. Each has the full colour: a
    technique divides by n when it adds them up. A light without a shape is its own and only sample, whatever n is.
    """
    if light.shape is None:
        return (light,)
    return tuple(
        replace(light, position=position, shape=None, name=f"{light.name} {number}")
        for number, position in enumerate(light_samples(light, n, pattern, seed), start=1)
    )


def _pattern_points(n: int, pattern: Pattern, seed: int, dimensions: int, columns: int | None = None) -> np.ndarray:
    """Return n points (n, dimensions) of the unit square or cube; a grid has `columns`, or as many as rows."""
    if pattern == "sobol":
        return sobol(n, dimensions, seed)
    generator = np.random.default_rng(0 if pattern == "grid" else seed)
    random = generator.random((n, dimensions))
    if pattern == "random":
        return random
    inside = random if pattern == "jittered" else np.full((n, dimensions), 0.5)
    points = strata(n, columns or round(np.sqrt(n)), inside[:, :2])
    if dimensions == 2:
        return points
    # the third coordinate: each of n slices once, in an order that has nothing to do with rows and columns
    return np.column_stack([points, (generator.permutation(n) + inside[:, 2]) / n])
