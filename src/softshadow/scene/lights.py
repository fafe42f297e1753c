"""Lights of a scene: a point, or a direction for a light at infinity."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softshadow.errors import SceneError
from softshadow.scene.checked import keep, numbers


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Light:
    """A point light or a light at infinity.

    Attributes
    ----------
    position : (4,) float64      homogeneous, world space; w = 1 a point, w = 0 the direction towards the light.
                                 Three numbers are taken as a point, any other w > 0 is divided out.
    color : (3,) float64         linear, 0 to 1
    name : str                   what steps and messages call it

    Raises
    ------
    SceneError                   not finite, w < 0, or a direction of length 0
    """

    position: np.ndarray
    color: np.ndarray
    name: str

    def __init__(self, position: ArrayLike, color: ArrayLike = (1, 1, 1), name: str = "light") -> None:
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
        )

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
        kind = "direction" if self.is_directional else "point"
        return f"Light({self.name!r}, {kind} {self.position[:3].tolist()})"
