"""A scene, as every technique draws it: camera, lights, casters and flat receivers."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from softshadow import errors
from softshadow.errors import SceneError
from softshadow.scene.camera import Camera
from softshadow.scene.lights import Light
from softshadow.scene.mesh import Mesh
from softshadow.scene.placement import transform_points
from softshadow.scene.plane import flat_plane
from softshadow.scene.validate import set_fields, validate_number, validate_numbers


@dataclass(frozen=True, eq=False, init=False)
class Material:
    """How a surface reflects and emits light; `color` is both GL's ambient and its diffuse color.

    Attributes
    ----------
    color : (3,) float64         0 to 1
    specular : (3,) float64      0 to 1
    shininess : float            exponent, 0 to 128 as in GL
    emission : (3,) float64      0 to 1: added once, whatever shines on the surface; it lights nothing else
    """

    color: np.ndarray
    specular: np.ndarray
    shininess: float
    emission: np.ndarray

    def __init__(
        self,
        color: ArrayLike = (0.8, 0.8, 0.8),
        specular: ArrayLike = (0, 0, 0),
        shininess: float = 0,
        emission: ArrayLike = (0, 0, 0),
    ) -> None:
        set_fields(
            self,
            color=validate_numbers("material: color", color, 3),
            specular=validate_numbers("material: specular", specular, 3),
            shininess=validate_number("material: shininess", shininess),
            emission=validate_numbers("material: emission", emission, 3),
        )
        if not 0 <= self.shininess <= 128:
            raise SceneError(f"material: shininess: expected 0 to 128, got {self.shininess:g}")


@dataclass(frozen=True, eq=False, init=False, repr=False)
class SceneObject:
    """A mesh placed in the world, with its material.

    Attributes
    ----------
    object_to_world : (4, 4) float64     affine, without a reflection, which would turn every face inside out
    casts : bool                         whether it casts shadows
    receives : bool                      whether planar techniques draw shadows on it, provided that it is flat
    """

    mesh: Mesh
    object_to_world: np.ndarray
    material: Material
    casts: bool
    receives: bool
    name: str

    def __init__(
        self,
        mesh: Mesh,
        object_to_world: ArrayLike | None = None,
        material: Material | None = None,
        *,
        casts: bool = True,
        receives: bool = False,
        name: str = "",
    ) -> None:
        if not isinstance(mesh, Mesh):
            raise TypeError(f"mesh={mesh!r}: expected a Mesh, such as those of Mesh.load and of the shapes")
        name = name or mesh.name
        matrix = np.array(np.eye(4) if object_to_world is None else object_to_world, dtype=np.float64)
        if matrix.shape != (4, 4) or not np.isfinite(matrix).all() or (matrix[3] != (0, 0, 0, 1)).any():
            raise SceneError(f"{name}: object_to_world: expected a finite 4x4 matrix with last row 0 0 0 1")
        if not np.linalg.det(matrix[:3, :3]) > 0:
            raise SceneError(
                f"{name}: object_to_world: expected a positive determinant (neither flattened nor mirrored), "
                f"got {np.linalg.det(matrix[:3, :3]):g}"
            )
        set_fields(
            self,
            mesh=mesh,
            object_to_world=matrix,
            material=material or Material(),
            casts=casts,
            receives=receives,
            name=name,
        )

    def __repr__(self) -> str:
        place = ", ".join(f"{value:g}" for value in self.object_to_world[:3, 3])
        roles = [role for role, is_taken in (("casts", self.casts), ("receives", self.receives)) if is_taken]
        return f"SceneObject({self.name!r}, {self.mesh!r} at ({place}){''.join(f', {role}' for role in roles)})"

    @cached_property
    def plane(self) -> np.ndarray | None:
        """(4,) float64 world plane a, b, c, d, unit normal; None when the mesh is not one flat convex polygon."""
        plane = flat_plane(self.mesh)
        if plane is None:
            return None
        world_plane = plane @ np.linalg.inv(self.object_to_world)
        return world_plane / np.linalg.norm(world_plane[:3])

    @cached_property
    def world_positions(self) -> np.ndarray:
        """(V, 3) float64: the vertices in world space."""
        matrix = self.object_to_world
        return transform_points(self.mesh.positions.astype(np.float64), matrix[:3, :3]) + matrix[:3, 3]


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Scene:
    """What a technique draws: a camera, lights and objects.

    Attributes
    ----------
    lights : tuple of Light             at least one
    objects : tuple of SceneObject      at least one, in drawing order
    ambient : (3,) float64              light that reaches every surface
    background : (3,) float64           colour where nothing is drawn
    notes : tuple of Warning            warnings from reading its files; `warnings()` begins with them

    Raises
    ------
    SceneError                          no light, no object, two lights or objects of the same name
    """

    name: str
    camera: Camera
    lights: tuple[Light, ...]
    objects: tuple[SceneObject, ...]
    title: str
    ambient: np.ndarray
    background: np.ndarray
    notes: tuple[errors.Warning, ...]

    def __init__(
        self,
        name: str,
        camera: Camera,
        lights: Sequence[Light],
        objects: Sequence[SceneObject],
        *,
        title: str = "",
        ambient: ArrayLike = (0.2, 0.2, 0.2),
        background: ArrayLike = (0.62, 0.72, 0.82),
        notes: Sequence[errors.Warning] = (),
    ) -> None:
        if not isinstance(camera, Camera):
            raise TypeError(f"scene {name}: camera={camera!r}: expected a Camera")
        _check_kinds(f"scene {name}: lights", lights, Light)
        _check_kinds(f"scene {name}: objects", objects, SceneObject)
        _check_names(f"scene {name}: lights", [light.name for light in lights])
        _check_names(f"scene {name}: objects", [item.name for item in objects])
        set_fields(
            self,
            name=name,
            camera=camera,
            lights=tuple(lights),
            objects=tuple(objects),
            title=title,
            ambient=validate_numbers("ambient", ambient, 3),
            background=validate_numbers("background", background, 3),
            notes=tuple(notes),
        )

    def __repr__(self) -> str:
        names = ", ".join(item.name for item in self.objects)
        return f"Scene({self.name!r}, {len(self.lights)} light{'s' if len(self.lights) > 1 else ''}, objects: {names})"

    @property
    def casters(self) -> tuple[SceneObject, ...]:
        """The objects that cast shadows."""
        return tuple(item for item in self.objects if item.casts)

    @property
    def receivers(self) -> tuple[SceneObject, ...]:
        """The flat objects that planar techniques draw shadows on."""
        return tuple(item for item in self.objects if item.receives and item.plane is not None)

    if TYPE_CHECKING:
        # softshadow.scene attaches these: their modules import this one

        @staticmethod
        def named(name: str) -> "Scene": ...

        @staticmethod
        def from_mesh(
            path: str | PathLike[str], light: ArrayLike | Light = (2, 5, 3), *, up: str = "y", name: str = ""
        ) -> "Scene": ...

        @staticmethod
        def load(path: str | PathLike[str]) -> "Scene": ...

        def warnings(self, /) -> list[errors.Warning]: ...


def _check_kinds(key: str, things: Any, kind: type) -> None:
    if isinstance(things, str) or not isinstance(things, Sequence) or not all(isinstance(x, kind) for x in things):
        raise TypeError(f"{key}: expected a list of {kind.__name__}, got {things!r}")


def _check_names(key: str, names: list[str]) -> None:
    if not names:
        raise SceneError(f"{key}: expected at least one, got none")
    repeated = sorted(name for name, n in Counter(names).items() if n > 1)
    if repeated:
        raise SceneError(f"{key}: expected different names, got {', '.join(repeated)} twice")
