"""The shapes of area lights: rectangle, disc, sphere and segment, each around the position of its light."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softshadow.errors import SceneError
from softshadow.scene.validate import set_fields, validate_number, validate_numbers

# cosine between the edges of a rectangle: more than numbers typed with four digits are off
SQUARE_CORNER = 1e-3
UNIT = 1e-15  # the rounding of a length 1


@dataclass(frozen=True, eq=False, init=False)
class Rectangle:
    """A rectangular light, visible from both sides.

    Attributes
    ----------
    edge_u, edge_v : (3,) float64    its edges, world space: whole edges, from corner to corner, perpendicular

    Raises
    ------
    SceneError                       an edge of length 0, or edges that are not perpendicular
    """

    edge_u: np.ndarray
    edge_v: np.ndarray

    def __init__(self, edge_u: ArrayLike, edge_v: ArrayLike) -> None:
        u, v = _direction("edge_u", edge_u), _direction("edge_v", edge_v)
        cosine = float(u @ v / (np.linalg.norm(u) * np.linalg.norm(v)))
        if abs(cosine) > SQUARE_CORNER:
            raise SceneError(f"edge_v: expected an edge perpendicular to edge_u, got a cosine of {cosine:.3g}")
        set_fields(self, edge_u=u, edge_v=v)

    @property
    def half_axes(self) -> tuple[np.ndarray, np.ndarray]:
        """Two vectors (3,): the rectangle is every ``center + a u + b v`` with a and b from -1 to 1."""
        return self.edge_u / 2, self.edge_v / 2

    @property
    def corners(self) -> np.ndarray:
        """(4, 3) float64: the corners relative to the centre, in order around ``edge_u x edge_v``."""
        u, v = self.half_axes
        return np.stack([-u - v, u - v, u + v, v - u])

    @property
    def bounding_radius(self) -> float:
        """The radius of the smallest sphere around the centre that contains the light."""
        return float(np.linalg.norm(self.corners[0]))

    def scaled(self, factor: float) -> "Rectangle":
        """Return the shape with all lengths multiplied by a positive factor."""
        return Rectangle(factor * self.edge_u, factor * self.edge_v)


@dataclass(frozen=True, eq=False, init=False)
class Disc:
    """A round flat light, visible from both sides.

    Attributes
    ----------
    radius : float
    normal : (3,) float64            unit vector, world space

    Raises
    ------
    SceneError                       a radius that is not positive, or a normal of length 0
    """

    radius: float
    normal: np.ndarray

    def __init__(self, radius: float, normal: ArrayLike) -> None:
        direction = _direction("normal", normal)
        length = float(np.linalg.norm(direction))
        # a normal of length 1 stays as it is, so that a saved disc is the same when it is read
        unit = direction if abs(length - 1) < UNIT else direction / length
        set_fields(self, radius=_radius(radius), normal=unit)

    @property
    def half_axes(self) -> tuple[np.ndarray, np.ndarray]:
        """Two vectors (3,): the disc is every ``center + a u + b v`` with ``a a + b b <= 1``."""
        across = np.eye(3)[np.abs(self.normal).argmin()]
        u = np.cross(across, self.normal)
        u *= self.radius / np.linalg.norm(u)
        return u, np.cross(self.normal, u)

    @property
    def corners(self) -> np.ndarray:
        """(4, 3) float64: four points of the rim, a quarter turn apart, relative to the centre."""
        u, v = self.half_axes
        return np.stack([-u, -v, u, v])

    @property
    def bounding_radius(self) -> float:
        """The radius of the smallest sphere around the centre that contains the light."""
        return self.radius

    def scaled(self, factor: float) -> "Disc":
        """Return the shape with all lengths multiplied by a positive factor."""
        return Disc(factor * self.radius, self.normal)


@dataclass(frozen=True, eq=False, init=False)
class Sphere:
    """A light that is a ball; a point sees it as a disc.

    Attributes
    ----------
    radius : float

    Raises
    ------
    SceneError                       a radius that is not positive
    """

    radius: float

    def __init__(self, radius: float) -> None:
        set_fields(self, radius=_radius(radius))

    @property
    def corners(self) -> np.ndarray:
        """(6, 3) float64: the points farthest along the axes, relative to the centre."""
        return self.radius * np.concatenate([-np.eye(3), np.eye(3)])

    @property
    def bounding_radius(self) -> float:
        """The radius of the smallest sphere around the centre that contains the light."""
        return self.radius

    def scaled(self, factor: float) -> "Sphere":
        """Return the shape with all lengths multiplied by a positive factor."""
        return Sphere(factor * self.radius)


@dataclass(frozen=True, eq=False, init=False)
class Segment:
    """A light that is a line segment.

    Attributes
    ----------
    edge : (3,) float64              from end to end, world space

    Raises
    ------
    SceneError                       an edge of length 0
    """

    edge: np.ndarray

    def __init__(self, edge: ArrayLike) -> None:
        set_fields(self, edge=_direction("edge", edge))

    @property
    def half_axes(self) -> tuple[np.ndarray, np.ndarray]:
        """Two vectors (3,), the second is 0: the segment is every ``center + a u`` with a from -1 to 1."""
        return self.edge / 2, np.zeros(3)

    @property
    def corners(self) -> np.ndarray:
        """(2, 3) float64: the ends, relative to the centre."""
        return np.stack([-self.edge / 2, self.edge / 2])

    @property
    def bounding_radius(self) -> float:
        """The radius of the smallest sphere around the centre that contains the light."""
        return float(np.linalg.norm(self.edge)) / 2

    def scaled(self, factor: float) -> "Segment":
        """Return the shape with all lengths multiplied by a positive factor."""
        return Segment(factor * self.edge)


LightShape = Rectangle | Disc | Sphere | Segment
SHAPES: dict[str, type[LightShape]] = {kind.__name__.lower(): kind for kind in (Rectangle, Disc, Sphere, Segment)}


def _direction(key: str, value: ArrayLike) -> np.ndarray:
    direction = validate_numbers(key, value, 3)
    if not direction.any():
        raise SceneError(f"{key}: expected a length other than 0, got {direction.tolist()}")
    return direction


def _radius(value: float) -> float:
    radius = validate_number("radius", value)
    if radius <= 0:
        raise SceneError(f"radius: expected a positive number, got {radius:g}")
    return radius
