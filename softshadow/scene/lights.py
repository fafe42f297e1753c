"""The lights of a scene: point lights, spot lights, area lights and lights at infinity."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softshadow.errors import SceneError
from softshadow.scene.light_shapes import SHAPES, LightShape
from softshadow.scene.validate import set_fields, validate_number, validate_numbers

# GL_SPOT_CUTOFF in degrees: without a cone, and the largest of a cone
NO_CONE, WIDEST_CONE = 180.0, 90.0
# GL's initial attenuation: the light is equally bright at every distance
NO_ATTENUATION = (1.0, 0.0, 0.0)


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Light:
    """A point light, a spot light, an area light, or a light at infinity.

    Attributes
    ----------
    position : (4,) float64      homogeneous, world space; w = 1: a point; w = 0: the direction towards the light.
                                 Three numbers mean a point; any other w > 0 is divided out. The centre of an area
                                 light, from which techniques without penumbra draw.
    color : (3,) float64         linear, 0 to 1
    name : str                   used by steps and messages
    axis : (3,) float64 or None  unit vector along which a spot light shines, world space; None without a cone
    cutoff : float               GL_SPOT_CUTOFF, degrees from the axis to the side of the cone; 180: no cone
    shape : Rectangle, Disc, Sphere, Segment or None     of an area light, around its position
    attenuation : (3,) float64   GL's constant, linear and quadratic factors a, b, c: at distance d the light is
                                 divided by a + b d + c d d. For an area light, d is the distance to its centre.

    Raises
    ------
    SceneError                   not finite, w < 0, or a direction of length 0; an axis without a cutoff or a cutoff
                                 without an axis; a cone, a shape or an attenuation of a light at infinity; a cone and a
                                 shape; negative factors of attenuation, or all 0
    """

    position: np.ndarray
    color: np.ndarray
    name: str
    axis: np.ndarray | None
    cutoff: float
    shape: LightShape | None
    attenuation: np.ndarray

    def __init__(
        self,
        position: ArrayLike,
        color: ArrayLike = (1, 1, 1),
        name: str = "light",
        *,
        axis: ArrayLike | None = None,
        cutoff: float = NO_CONE,
        shape: LightShape | None = None,
        attenuation: ArrayLike = NO_ATTENUATION,
    ) -> None:
        point = validate_numbers(
            f"{name}: position", np.append(position, 1) if np.shape(position) == (3,) else position, 4
        )
        if point[3] < 0 or not point.any():
            raise SceneError(
                f"{name}: position: expected a point (w > 0) or a direction towards the light (w = 0, not all 0), "
                f"got {point.tolist()}"
            )
        set_fields(
            self,
            position=point / point[3] if point[3] else point,
            color=validate_numbers(f"{name}: color", color, 3),
            name=name,
            axis=None if axis is None else _unit(f"{name}: axis", axis),
            cutoff=validate_number(f"{name}: cutoff", cutoff),
            shape=shape,
            attenuation=validate_numbers(f"{name}: attenuation", attenuation, 3),
        )
        self._check_shape_and_attenuation()
        if axis is None and self.cutoff == NO_CONE:
            return
        if self.is_directional:
            raise SceneError(f"{name}: cutoff: a light at infinity has no cone; expected a position with w > 0")
        if axis is None or not 0 < self.cutoff <= WIDEST_CONE:
            raise SceneError(
                f"{name}: expected an axis and a cutoff of more than 0 and at most {WIDEST_CONE:g} degrees, got "
                f"axis={axis!r} and cutoff={cutoff!r}"
            )

    def _check_shape_and_attenuation(self) -> None:
        if self.shape is not None and not isinstance(self.shape, LightShape):
            raise SceneError(f"{self.name}: shape: expected one of {', '.join(SHAPES)} or None, got {self.shape!r}")
        if (self.attenuation < 0).any() or not self.attenuation.any():
            raise SceneError(
                f"{self.name}: attenuation: expected three numbers of at least 0, not all 0, "
                f"got {self.attenuation.tolist()}"
            )
        if self.is_directional and self.shape is not None:
            raise SceneError(f"{self.name}: shape: a light at infinity has none; expected a position with w > 0")
        if self.is_directional and self.is_attenuated:
            raise SceneError(f"{self.name}: attenuation: a light at infinity has no distance; expected w > 0")
        if self.is_spot and self.shape is not None:
            raise SceneError(f"{self.name}: shape: a spot light has none; expected a shape or a cone, not both")

    @property
    def is_attenuated(self) -> bool:
        """Whether the light is weaker far away; GL's initial attenuation is not."""
        return tuple(self.attenuation) != NO_ATTENUATION

    @property
    def corners(self) -> np.ndarray:
        """(n, 3) float64: the corners of an area light in world space; what they are, its shape says.

        Raises
        ------
        SceneError                   the light has no shape
        """
        if self.shape is None:
            raise SceneError(f"{self.name}: corners: expected a light with a shape")
        return self.position[:3] + self.shape.corners

    @property
    def is_spot(self) -> bool:
        """Whether the light has a cone."""
        return self.axis is not None

    def shines_on(self, points: np.ndarray) -> np.ndarray:
        """Return whether world points (..., 3) lie within the cone; always true for lights without one."""
        if self.axis is None:
            return np.ones(np.shape(points)[:-1], bool)
        from_light = points - self.position[:3]
        within: np.ndarray = from_light @ self.axis >= np.cos(np.radians(self.cutoff)) * np.linalg.norm(
            from_light, axis=-1
        )
        return within

    @property
    def is_directional(self) -> bool:
        """Whether the light is at infinity."""
        return bool(self.position[3] == 0)

    def in_object_space(self, object_to_world: np.ndarray) -> np.ndarray:
        """Return the homogeneous light position in object space.

        Parameters
        ----------
        object_to_world : (4, 4) float64     affine, not singular

        Returns
        -------
        (4,) float64                         w is unchanged, exactly 0 or 1
        """
        w = self.position[3]
        position = np.linalg.solve(object_to_world[:3, :3], self.position[:3] - w * object_to_world[:3, 3])
        return np.append(position, w)

    def __repr__(self) -> str:
        kind = "direction" if self.is_directional else "spot" if self.is_spot else "point"
        kind = type(self.shape).__name__.lower() if self.shape is not None else kind
        return f"Light({self.name!r}, {kind} {self.position[:3].tolist()})"


def _unit(key: str, value: ArrayLike) -> np.ndarray:
    """Return a direction (3,) scaled to length 1."""
    direction = validate_numbers(key, value, 3)
    length = float(np.linalg.norm(direction))
    if not length:
        raise SceneError(f"{key}: expected a direction of a length other than 0, got {direction.tolist()}")
    return direction / length
