"""Lights of a scene: a point, a spot (a point that shines into a cone), or a direction for a light at infinity."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softshadow.errors import SceneError
from softshadow.scene.validate import keep, number, numbers

# degrees: of a light that is no spot, as in GL; and GL's largest for one that is
NO_CONE, WIDEST_CONE = 180.0, 90.0


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Light:
    """A point light, a spot light, or a light at infinity.

    Attributes
    ----------
    position : (4,) float64      homogeneous, world space; w = 1 a point, w = 0 the direction towards the light.
                                 Three numbers are taken as a point, any other w > 0 is divided out.
    color : (3,) float64         linear, 0 to 1
    name : str                   what steps and messages call it
    axis : (3,) float64 or None  unit vector along which a spot light shines, world space; None of any other light
    cutoff : float               degrees from the axis to the side of the cone, GL_SPOT_CUTOFF; 180 is no cone

    Raises
    ------
    SceneError                   not finite, w < 0, or a direction of length 0; a cone that is none, or of a light at
                                 infinity
    """

    position: np.ndarray
    color: np.ndarray
    name: str
    axis: np.ndarray | None
    cutoff: float

    def __init__(
        self,
        position: ArrayLike,
        color: ArrayLike = (1, 1, 1),
        name: str = "light",
        *,
        axis: ArrayLike | None = None,
        cutoff: float = NO_CONE,
    ) -> None:
        point = numbers(f"{name}: position", np.append(position, 1) if np.shape(position) == (3,) else position, 4)
        if point[3] < 0 or not point.any():
            raise SceneError(
                f"{name}: position: expected a point (w > 0) or a direction towards the light (w = 0, not all 0), "
                f"got {point.tolist()}"
            )
        keep(
            self,
            position=point / point[3] if point[3] else point,
            color=numbers(f"{name}: color", color, 3),
            name=name,
            axis=None if axis is None else _unit(f"{name}: axis", axis),
            cutoff=number(f"{name}: cutoff", cutoff),
        )
        if axis is None and self.cutoff == NO_CONE:
            return
        if self.is_directional:
            raise SceneError(f"{name}: cutoff: a light at infinity has no cone; expected a position with w > 0")
        if axis is None or not 0 < self.cutoff <= WIDEST_CONE:
            raise SceneError(
                f"{name}: expected an axis and a cutoff of more than 0 and at most {WIDEST_CONE:g} degrees, got "
                f"axis={axis!r} and cutoff={cutoff!r}"
            )

    @property
    def is_spot(self) -> bool:
        """Whether the light shines into a cone only."""
        return self.axis is not None

    def shines_on(self, points: np.ndarray) -> np.ndarray:
        """Return whether points (..., 3) in world space lie within the cone of a spot light; of others, all do."""
        if self.axis is None:
            return np.ones(np.shape(points)[:-1], bool)
        away = points - self.position[:3]
        within: np.ndarray = away @ self.axis >= np.cos(np.radians(self.cutoff)) * np.linalg.norm(away, axis=-1)
        return within

    @property
    def is_directional(self) -> bool:
        """Whether the light is at infinity."""
        return bool(self.position[3] == 0)

    def in_object_space(self, object_to_world: np.ndarray) -> np.ndarray:
        """Return the light in an object's own space.

        Parameters
        ----------
        object_to_world : (4, 4) float64     affine, not singular

        Returns
        -------
        (4,) float64                         w exactly 0 or 1 as before: no inverse matrix touches it
        """
        w = self.position[3]
        carried = np.linalg.solve(object_to_world[:3, :3], self.position[:3] - w * object_to_world[:3, 3])
        return np.append(carried, w)

    def __repr__(self) -> str:
        kind = "direction" if self.is_directional else "spot" if self.is_spot else "point"
        return f"Light({self.name!r}, {kind} {self.position[:3].tolist()})"


def _unit(key: str, value: ArrayLike) -> np.ndarray:
    """Return a direction (3,) of length 1, or say which key has none."""
    direction = numbers(key, value, 3)
    length = float(np.linalg.norm(direction))
    if not length:
        raise SceneError(f"{key}: expected a direction, got {direction.tolist()}")
    return direction / length
