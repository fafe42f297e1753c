"""A scene: what every technique draws. Camera, lights, objects that cast and planes that receive."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from softshadow import errors
from softshadow.errors import SceneError
from softshadow.scene.camera import Camera
from softshadow.scene.lights import Light
from softshadow.scene.mesh import Mesh
from softshadow.scene.placement import carried
from softshadow.scene.plane import flat_plane
from softshadow.scene.validate import keep, number, numbers


@dataclass(frozen=True, eq=False, init=False)
class Material:
    """How a surface reflects: GL's ambient and diffuse share `color`.

    Attributes
    ----------
    color : (3,) float64         0 to 1
    specular : (3,) float64      0 to 1
    shininess : float            exponent, 0 to 128 as in GL
    """

    color: np.ndarray
    specular: np.ndarray
    shininess: float

    def __init__(
        self, color: ArrayLike = (0.8, 0.8, 0.8), specular: ArrayLike = (0, 0, 0), shininess: float = 0
    ) -> None:
        keep(
            self,
            color=numbers("material: color", color, 3),
            specular=numbers("material: specular", specular, 3),
            shininess=number("material: shininess", shininess),
        )
        if not 0 <= self.shininess <= 128:
            raise SceneError(f"material: shininess: expected 0 to 128, got {self.shininess:g}")


@dataclass(frozen=True, eq=False, init=False)
class SceneObject:
    """A mesh that stands somewhere.

    Attributes
    ----------
    object_to_world : (4, 4) float64     affine, not mirrored (a mirror would turn every face inside out)
    casts : bool                         whether shadow techniques take it as a caster
    receives : bool                      whether planar techniques take it as a receiver; it also has to be flat
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
        name = name or mesh.name
        matrix = np.array(np.eye(4) if object_to_world is None else object_to_world, dtype=np.float64)
        if matrix.shape != (4, 4) or not np.isfinite(matrix).all() or (matrix[3] != (0, 0, 0, 1)).any():
            raise SceneError(f"{name}: object_to_world: expected a finite 4x4 matrix with last row 0 0 0 1")
        if not np.linalg.det(matrix[:3, :3]) > 0:
            raise SceneError(
                f"{name}: object_to_world: expected a positive determinant (neither flattened nor mirrored), "
                f"got {np.linalg.det(matrix[:3, :3]):g}"
            )
        keep(
            self,
            mesh=mesh,
            object_to_world=matrix,
            material=material or Material(),
            casts=casts,
            receives=receives,
            name=name,
        )

    @cached_property
    def plane(self) -> np.ndarray | None:
        """(4,) float64 world plane a, b, c, d, unit normal; None when the mesh is not one flat convex polygon."""
        plane = flat_plane(self.mesh)
        if plane is None:
            return None
        carried = plane @ np.linalg.inv(self.object_to_world)
        return carried / np.linalg.norm(carried[:3])

    @cached_property
    def world_positions(self) -> np.ndarray:
        """(V, 3) float64: the vertices in world space."""
        matrix = self.object_to_world
        return carried(self.mesh.positions.astype(np.float64), matrix[:3, :3]) + matrix[:3, 3]


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Scene:
    """Everything a technique needs to know.

    Attributes
    ----------
    lights : tuple of Light             at least one
    objects : tuple of SceneObject      at least one, in drawing order
    ambient : (3,) float64              light that reaches every surface
    background : (3,) float64           colour where nothing is drawn
    notes : tuple of Warning            what the making of the scene found, first in `warnings()`

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
        parts: tuple[tuple[str, Sequence[Light] | Sequence[SceneObject]], ...] = (
            ("lights", lights),
            ("objects", objects),
        )
        for key, given in parts:
            if not given:
                raise SceneError(f"scene {name}: {key}: expected at least one, got none")
            names = [part.name for part in given]
            twice = sorted({part for part in names if names.count(part) > 1})
            if twice:
                raise SceneError(f"scene {name}: {key}: expected different names, got {', '.join(twice)} twice")
        keep(self, name=name, camera=camera, lights=tuple(lights), objects=tuple(objects), title=title)
        keep(self, ambient=numbers("ambient", ambient, 3), background=numbers("background", background, 3))
        keep(self, notes=tuple(notes))

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

    @classmethod
    def named(cls, name: str) -> "Scene":
        """Return a built-in scene; `scene_names()` lists them."""
        from softshadow.scene.named import named_scene

        return named_scene(name)

    @classmethod
    def from_mesh(cls, path: str | PathLike[str], light: Sequence[float] = (2, 5, 3), **options: Any) -> "Scene":
        """Return a model file on a floor, seen by a camera that frames it; see `loading.scene_from_mesh`."""
        from softshadow.scene.loading import scene_from_mesh

        return scene_from_mesh(path, light, **options)

    @classmethod
    def load(cls, path: str | PathLike[str]) -> "Scene":
        """Return the scene that a TOML file describes; see `files.load_scene`."""
        from softshadow.scene.files import load_scene

        return load_scene(path)

    def warnings(self) -> list[errors.Warning]:
        """Return what is legal but surprising about the scene, as warnings that nobody has issued yet."""
        from softshadow.scene.scene_warnings import surprises

        return [*self.notes, *surprises(self)]
