"""The tables of a scene file as pydantic models; each builds its part of the scene.

The parts are built during validation, so that an error from a camera or a mesh is listed with the other mistakes of the
file, instead of hiding them.
"""

import inspect
import math
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import BaseModel, ConfigDict, Field, PrivateAttr, ValidationError, ValidationInfo, model_validator

from softshadow.errors import SceneError, Warning, nearest
from softshadow.scene import shapes
from softshadow.scene.camera import Camera
from softshadow.scene.light_shapes import SHAPES as LIGHT_SHAPES
from softshadow.scene.light_shapes import LightShape
from softshadow.scene.lights import NO_ATTENUATION, NO_CONE, Light
from softshadow.scene.loading import load_mesh
from softshadow.scene.mesh import Mesh
from softshadow.scene.placement import placement
from softshadow.scene.scene import Material, SceneObject
from softshadow.scene.validation_errors import EXPECTED, ErrorCollector, error_lines

SHAPES: dict[str, Callable[..., Mesh]] = {
    build.__name__: build
    for build in (
        shapes.box,
        shapes.sphere,
        shapes.torus,
        shapes.cylinder,
        shapes.tetrahedron,
        shapes.stairs,
        shapes.wall,
        shapes.floor,
        shapes.quad,
    )
}

INTEGER_PARAMETERS = ("segments", "rings", "sides", "steps", "cells")
LARGEST_INTEGER = 1000
LARGEST_NUMBER = 1e30  # of a size; squares of it are numbers, too
MOST_TRIANGLES = 500_000  # of all shapes in a file: more are no description of a scene, and take minutes to be drawn
MOST_OBJECTS = 500

Triple = Annotated[list[float], Field(min_length=3, max_length=3)]
Color = Annotated[list[Annotated[float, Field(ge=0, le=1)]], Field(min_length=3, max_length=3)]


class LoadContext:
    """What the tables of one file share during validation."""

    def __init__(self, folder: Path, materials: dict[str, Any]) -> None:
        self.folder = folder
        self.materials = materials
        self.light_names: set[str] = set()
        self.object_names: set[str] = set()
        self.notes: list[Warning] = []
        self.triangles = 0  # of the shapes so far


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)


class CameraTable(_Table):
    """[camera] of a scene file."""

    eye: Triple
    target: Triple
    up: Triple = [0, 1, 0]
    fov_y: float = 45
    near: float = 0.1
    far: float = 100
    _built: Camera = PrivateAttr()

    @property
    def built(self) -> Camera:
        """The part of the scene that this table describes."""
        return self._built

    @model_validator(mode="after")
    def _build(self) -> Self:
        with ErrorCollector() as errors, errors.catch("camera"):
            self._built = Camera(self.eye, self.target, self.up, self.fov_y, self.near, self.far)
        return self


class LightTable(_Table):
    """[[light]] of a scene file."""

    name: str = ""
    position: Triple | None = None
    direction: Triple | None = None
    axis: Triple | None = None
    cutoff: float = NO_CONE
    shape: str | None = None
    parameters: dict[str, Any] = {}
    attenuation: Triple = list(NO_ATTENUATION)
    color: Color = [1, 1, 1]
    _built: Light = PrivateAttr()

    @property
    def built(self) -> Light:
        """The part of the scene that this table describes."""
        return self._built

    @model_validator(mode="after")
    def _build(self, info: ValidationInfo) -> Self:
        with ErrorCollector() as errors:
            name = _unique_name(self.name or "light", not self.name, _context(info).light_names, errors)
            if (self.position is None) == (self.direction is None):
                errors.add("expected either position (a point) or direction (towards a light at infinity)")
            else:
                with errors.catch(name):
                    place = self.position or [*(self.direction or ()), 0]
                    self._built = Light(
                        place, self.color, name, axis=self.axis, cutoff=self.cutoff, shape=self._shape(errors),
                        attenuation=self.attenuation,
                    )  # fmt: skip
        return self

    def _shape(self, errors: ErrorCollector) -> LightShape | None:
        if self.shape is None:
            if self.parameters:
                errors.add("parameters: only a shape has parameters; expected none without shape")
            return None
        if self.shape not in LIGHT_SHAPES:
            raise SceneError(f"shape: no shape of lights is called {self.shape!r}; {nearest(self.shape, LIGHT_SHAPES)}")
        kind = LIGHT_SHAPES[self.shape]
        expected = list(inspect.signature(kind).parameters)
        n_before = len(errors.lines)
        for key in self.parameters:
            if key not in expected:
                errors.add(f"parameters.{key}: a {self.shape} has no such parameter; {nearest(key, expected)}")
        for key in expected:
            if key not in self.parameters:
                form = "a positive number" if key == "radius" else "[x, y, z]"
                errors.add(f"parameters.{key}: expected {form}, but it is missing")
        if len(errors.lines) > n_before:
            return None
        try:
            return kind(**self.parameters)
        except SceneError as error:
            raise SceneError(f"parameters.{error}") from None


class MaterialTable(_Table):
    """[materials.NAME] of a scene file, or the material of an object."""

    color: Color = [0.8, 0.8, 0.8]
    specular: Color = [0, 0, 0]
    shininess: Annotated[float, Field(ge=0, le=128)] = 0
    emission: Color = [0, 0, 0]


class _SceneObjectTable(_Table):
    name: str = ""
    material: Any = Field(default_factory=dict)
    _built: SceneObject = PrivateAttr()

    @property
    def built(self) -> SceneObject:
        """The part of the scene that this table describes."""
        return self._built

    def _material(self, context: LoadContext) -> Material:
        value = self.material
        if isinstance(value, str):
            if value not in context.materials:
                raise SceneError(f"material: no material is called {value!r}; {nearest(value, context.materials)}")
            value = context.materials[value]
            if not _is_valid(MaterialTable, value):
                return Material()  # its mistakes are listed under [materials]
        if not isinstance(value, dict):
            raise SceneError(f"material: expected {EXPECTED['material']}, got {value!r}")
        try:
            table = MaterialTable.model_validate(value)
        except ValidationError as error:
            raise SceneError(
                "\n".join(f"material.{line}" for line in error_lines(error, {"": MaterialTable}))
            ) from None
        return Material(table.color, table.specular, table.shininess, table.emission)


class ObjectTable(_SceneObjectTable):
    """[[object]] of a scene file."""

    shape: str | None = None
    parameters: dict[str, Any] = {}
    mesh: str | None = None
    move: Triple = [0, 0, 0]
    turn: Annotated[list[float], Field(min_length=4, max_length=4)] = [0, 0, 1, 0]
    scale: Any = 1
    casts: bool = True
    receives: bool = False

    @model_validator(mode="after")
    def _build(self, info: ValidationInfo) -> Self:
        context = _context(info)
        mesh, matrix, material = None, None, None
        with ErrorCollector() as errors:
            if (self.shape is None) == (self.mesh is None):
                errors.add("expected either shape (a built-in shape) or mesh (a model file)")
            elif self.shape is not None:
                with errors.catch():
                    mesh = self._shape(self.shape, context, errors)
            elif self.mesh is not None:
                with errors.catch():
                    mesh = self._model(self.mesh, context)
            name = _unique_name(
                self.name or (mesh.name if mesh else "object"), not self.name, context.object_names, errors
            )
            with errors.catch():
                matrix = placement(self.move, self.turn, self.scale)
            with errors.catch():
                material = self._material(context)
            if mesh is not None and not errors.lines:
                self._built = SceneObject(mesh, matrix, material, casts=self.casts, receives=self.receives, name=name)
        return self

    def _shape(self, shape: str, context: LoadContext, errors: ErrorCollector) -> Mesh | None:
        if shape not in SHAPES:
            raise SceneError(f"shape: no shape is called {shape!r}; {nearest(shape, SHAPES)}")
        build = SHAPES[shape]
        defaults = {key: item.default for key, item in inspect.signature(build).parameters.items() if key != "name"}
        n_before = len(errors.lines)
        for key, value in self.parameters.items():
            if key not in defaults:
                errors.add(f"parameters.{key}: {shape} has no such parameter; {nearest(key, defaults)}")
            elif message := _parameter_error(key, value, defaults[key]):
                errors.add(message)
        for key, default in defaults.items():
            if default is inspect.Parameter.empty and key not in self.parameters:
                errors.add(f"parameters.{key}: expected [x, y, z], but it is missing")
        if len(errors.lines) > n_before:
            return None
        cells = [value for key, value in self.parameters.items() if key in INTEGER_PARAMETERS]
        context.triangles += 2 * math.prod(cells) * (self.parameters.get("cells", 1))  # cells go in two directions
        if context.triangles > MOST_TRIANGLES:
            raise SceneError(
                f"parameters: with this, the shapes of the file have some {context.triangles} triangles; expected at "
                f"most {MOST_TRIANGLES}"
            )
        try:
            return build(**self.parameters)
        except ValueError as error:
            raise SceneError(f"parameters.{error}") from None

    def _model(self, mesh: str, context: LoadContext) -> Mesh:
        if self.parameters:
            raise SceneError("parameters: only a shape has parameters; expected none with mesh")
        file = context.folder / mesh
        if not file.resolve().is_relative_to(context.folder.resolve()):
            raise SceneError(f"mesh: {mesh!r} is outside the folder of the scene file; expected a file inside it")
        try:
            model, notes = load_mesh(file)
        except SceneError as error:
            raise SceneError(f"mesh: {error}") from None
        context.notes += notes
        return model


class ReceiverTable(_SceneObjectTable):
    """[[receiver]] of a scene file."""

    corner: Triple
    across: Triple
    up: Triple

    @model_validator(mode="after")
    def _build(self, info: ValidationInfo) -> Self:
        context = _context(info)
        mesh, material = None, None
        with ErrorCollector() as errors:
            name = _unique_name(self.name or "receiver", not self.name, context.object_names, errors)
            try:
                mesh = shapes.quad(self.corner, self.across, self.up, name=name)
            except ValueError as error:
                errors.add(str(error))
            with errors.catch():
                material = self._material(context)
            if mesh is not None and not errors.lines:
                self._built = SceneObject(mesh, material=material, casts=False, receives=True)
        return self


class SceneTable(_Table):
    """A whole scene file."""

    title: str = ""
    camera: CameraTable
    light: Annotated[list[LightTable], Field(min_length=1)]
    object: Annotated[list[ObjectTable], Field(max_length=MOST_OBJECTS)] = []
    receiver: Annotated[list[ReceiverTable], Field(max_length=MOST_OBJECTS)] = []
    materials: dict[str, MaterialTable] = {}
    ambient: Color = [0.2, 0.2, 0.2]
    background: Color = [0.62, 0.72, 0.82]

    @model_validator(mode="after")
    def _not_empty(self) -> Self:
        if not self.object and not self.receiver:
            raise ValueError("expected at least one [[object]] or [[receiver]]")
        return self


# the model of each table of a file, by its key; the whole file's is under ""
TABLES: dict[str, type[BaseModel]] = {
    "": SceneTable,
    "camera": CameraTable,
    "light": LightTable,
    "object": ObjectTable,
    "receiver": ReceiverTable,
    "materials": MaterialTable,
}


def _context(info: ValidationInfo) -> LoadContext:
    assert isinstance(info.context, LoadContext)
    return info.context


def _unique_name(name: str, is_default: bool, used: set[str], errors: ErrorCollector) -> str:
    """Return the name, with a number added if it is used already, and add it to `used`.

    Only a default name may be used already; another one is an error.
    """
    if name in used and not is_default:
        errors.add(f"name: {name!r} is used twice; expected a unique name")
    unique, number = name, 1
    while unique in used:
        number += 1
        unique = f"{name} {number}"
    used.add(unique)
    return unique


def _parameter_error(key: str, value: Any, default: Any) -> str:
    """Return an error message if a shape's parameter has not the type of its default, else an empty string."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= LARGEST_NUMBER
    if isinstance(default, bool):
        is_valid, expected = isinstance(value, bool), "true or false"
    elif key in INTEGER_PARAMETERS:
        is_valid = is_number and isinstance(value, int) and 1 <= value <= LARGEST_INTEGER
        expected = f"a whole number from 1 to {LARGEST_INTEGER}"
    elif default is inspect.Parameter.empty:
        is_valid = isinstance(value, list) and len(value) == 3 and all(isinstance(part, int | float) for part in value)
        expected = "[x, y, z]"
    else:
        is_valid, expected = is_number and value > 0, "a positive number"
    return "" if is_valid else f"parameters.{key}: expected {expected}, got {value!r}"


def _is_valid(model: type[BaseModel], value: Any) -> bool:
    try:
        model.model_validate(value)
    except ValidationError:
        return False
    return True
