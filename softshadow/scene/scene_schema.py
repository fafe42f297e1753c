"""The tables of a scene file: what each may hold, and the part of a scene that it makes.

Each table makes its part while it is checked, so that what a camera or a mesh complains about is one more mistake of
the file instead of the first and only one.
"""

import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, Self

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, PrivateAttr, ValidationError, ValidationInfo, model_validator

from softshadow.errors import SceneError, Warning, nearest
from softshadow.scene import shapes
from softshadow.scene.camera import Camera
from softshadow.scene.lights import NO_CONE, Light
from softshadow.scene.loading import load_mesh
from softshadow.scene.mesh import Mesh
from softshadow.scene.placement import placement
from softshadow.scene.scene import Material, SceneObject
from softshadow.scene.validation_errors import EXPECTED, Complaints, mistakes

SHAPES: dict[str, Callable[..., Mesh]] = {
    make.__name__: make
    for make in (
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

COUNTS = ("segments", "rings", "sides", "steps", "cells")
MOST = 1000  # a grid of 1000 x 1000 cells is two million triangles

Triple = Annotated[list[float], Field(min_length=3, max_length=3)]
Color = Annotated[list[Annotated[float, Field(ge=0, le=1)]], Field(min_length=3, max_length=3)]


class Context:
    """What the tables of one file share while they are checked."""

    def __init__(self, folder: Path, materials: dict[str, Any]) -> None:
        self.folder = folder
        self.materials = materials
        self.lights: set[str] = set()
        self.objects: set[str] = set()
        self.notes: list[Warning] = []


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)


class CameraTable(_Table):
    eye: Triple
    target: Triple
    up: Triple = [0, 1, 0]
    fov_y: float = 45
    near: float = 0.1
    far: float = 100
    _built: Camera = PrivateAttr()

    @property
    def built(self) -> Camera:
        """The part of the scene that this table makes."""
        return self._built

    @model_validator(mode="after")
    def _build(self) -> Self:
        with Complaints() as complaints, complaints.about("camera"):
            self._built = Camera(self.eye, self.target, self.up, self.fov_y, self.near, self.far)
        return self


class LightTable(_Table):
    name: str = ""
    position: Triple | None = None
    direction: Triple | None = None
    axis: Triple | None = None
    cutoff: float = NO_CONE
    color: Color = [1, 1, 1]
    _built: Light = PrivateAttr()

    @property
    def built(self) -> Light:
        """The part of the scene that this table makes."""
        return self._built

    @model_validator(mode="after")
    def _build(self, info: ValidationInfo) -> Self:
        with Complaints() as complaints:
            name = _new_name(self.name or "light", not self.name, _context(info).lights, complaints)
            if (self.position is None) == (self.direction is None):
                complaints.add("expected either position (a point) or direction (towards a light at infinity)")
            else:
                with complaints.about(name):
                    place = self.position or [*(self.direction or ()), 0]
                    self._built = Light(place, self.color, name, axis=self.axis, cutoff=self.cutoff)
        return self


class MaterialTable(_Table):
    color: Color = [0.8, 0.8, 0.8]
    specular: Color = [0, 0, 0]
    shininess: Annotated[float, Field(ge=0, le=128)] = 0


class _Placed(_Table):
    name: str = ""
    material: Any = Field(default_factory=dict)
    _built: SceneObject = PrivateAttr()

    @property
    def built(self) -> SceneObject:
        """The part of the scene that this table makes."""
        return self._built

    def _material(self, context: Context) -> Material:
        given = self.material
        if isinstance(given, str):
            if given not in context.materials:
                raise SceneError(f"material: no material is called {given!r}; {nearest(given, context.materials)}")
            given = context.materials[given]
            if not _is_valid(MaterialTable, given):
                return Material()  # its mistakes are named where it is defined
        if not isinstance(given, dict):
            raise SceneError(f"material: expected {EXPECTED['material']}, got {given!r}")
        try:
            table = MaterialTable.model_validate(given)
        except ValidationError as error:
            raise SceneError("\n".join(f"material.{line}" for line in mistakes(error, {"": MaterialTable}))) from None
        return Material(table.color, table.specular, table.shininess)


class ObjectTable(_Placed):
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
        with Complaints() as complaints:
            if (self.shape is None) == (self.mesh is None):
                complaints.add("expected either shape (a built-in shape) or mesh (a model file)")
            elif self.shape is not None:
                with complaints.about():
                    mesh = self._shape(self.shape, complaints)
            elif self.mesh is not None:
                with complaints.about():
                    mesh = self._model(self.mesh, context)
            name = _new_name(self.name or (mesh.name if mesh else "object"), not self.name, context.objects, complaints)
            with complaints.about():
                matrix = placement(self.move, self.turn, self.scale)
            with complaints.about():
                material = self._material(context)
            if mesh is not None and not complaints.lines:
                self._built = SceneObject(mesh, matrix, material, casts=self.casts, receives=self.receives, name=name)
        return self

    def _shape(self, shape: str, complaints: Complaints) -> Mesh | None:
        if shape not in SHAPES:
            raise SceneError(f"shape: no shape is called {shape!r}; {nearest(shape, SHAPES)}")
        make = SHAPES[shape]
        known = {key: item.default for key, item in inspect.signature(make).parameters.items() if key != "name"}
        before = len(complaints.lines)
        for key, value in self.parameters.items():
            if key not in known:
                complaints.add(f"parameters.{key}: {shape} has no such parameter; {nearest(key, known)}")
            elif complaint := _about_parameter(key, value, known[key]):
                complaints.add(complaint)
        for key, default in known.items():
            if default is inspect.Parameter.empty and key not in self.parameters:
                complaints.add(f"parameters.{key}: expected [x, y, z], it is missing")
        if len(complaints.lines) > before:
            return None
        try:
            return make(**self.parameters)
        except ValueError as error:
            raise SceneError(f"parameters.{error}") from None

    def _model(self, mesh: str, context: Context) -> Mesh:
        if self.parameters:
            raise SceneError("parameters: only a shape has parameters; expected none beside mesh")
        file = context.folder / mesh
        if not file.resolve().is_relative_to(context.folder.resolve()):
            raise SceneError(f"mesh: {mesh!r} is outside the folder of the scene file; expected a file inside it")
        try:
            model, notes = load_mesh(file)
        except SceneError as error:
            raise SceneError(f"mesh: {error}") from None
        context.notes += notes
        return model


class ReceiverTable(_Placed):
    corner: Triple
    across: Triple
    up: Triple

    @model_validator(mode="after")
    def _build(self, info: ValidationInfo) -> Self:
        context = _context(info)
        mesh, material = None, None
        with Complaints() as complaints:
            name = _new_name(self.name or "receiver", not self.name, context.objects, complaints)
            try:
                mesh = shapes.quad(self.corner, self.across, self.up, name=name)
            except ValueError as error:
                complaints.add(str(error))
            with complaints.about():
                material = self._material(context)
            if mesh is not None and not complaints.lines:
                self._built = SceneObject(mesh, material=material, casts=False, receives=True)
        return self


class SceneTable(_Table):
    title: str = ""
    camera: CameraTable
    light: Annotated[list[LightTable], Field(min_length=1)]
    object: list[ObjectTable] = []
    receiver: list[ReceiverTable] = []
    materials: dict[str, MaterialTable] = {}
    ambient: Color = [0.2, 0.2, 0.2]
    background: Color = [0.62, 0.72, 0.82]

    @model_validator(mode="after")
    def _not_empty(self) -> Self:
        if not self.object and not self.receiver:
            raise ValueError("expected at least one [[object]] or [[receiver]]")
        return self


def _context(info: ValidationInfo) -> Context:
    assert isinstance(info.context, Context)
    return info.context


def _new_name(name: str, made_up: bool, taken: set[str], complaints: Complaints) -> str:
    """Return the name, with a number behind it when nobody chose it and it is taken."""
    if name in taken and not made_up:
        complaints.add(f"name: {name!r} is used twice; expected a name of its own")
    free = name
    number = 2
    while free in taken:
        free = f"{name} {number}"
        number += 1
    taken.add(free)
    return free


def _about_parameter(key: str, value: Any, default: Any) -> str:
    """Return a complaint when a shape's parameter is not of the kind of its default, else nothing."""
    plain = isinstance(value, int | float) and not isinstance(value, bool) and np.isfinite(value)
    if isinstance(default, bool):
        right, expected = isinstance(value, bool), "true or false"
    elif key in COUNTS:
        right, expected = plain and isinstance(value, int) and 1 <= value <= MOST, f"a whole number from 1 to {MOST}"
    elif default is inspect.Parameter.empty:
        right = isinstance(value, list) and len(value) == 3 and all(isinstance(part, int | float) for part in value)
        expected = "[x, y, z]"
    else:
        right, expected = plain and value > 0, "a positive number"
    return "" if right else f"parameters.{key}: expected {expected}, got {value!r}"


def _is_valid(model: type[BaseModel], value: Any) -> bool:
    try:
        model.model_validate(value)
    except ValidationError:
        return False
    return True
