"""Recordings, scenes and other frozen values as JSON and plain arrays, and back, without pickle.

Only the classes in `KINDS` are created from a file; a file that names another one is refused.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import is_dataclass
from typing import Any

import numpy as np

from softshadow import errors, framebuffer, image, scene, state, texture
from softshadow.context import Frame
from softshadow.errors import SoftShadowError
from softshadow.inspection.validate_recording import stored_fields, validate_fields, validate_image
from softshadow.pipeline import commands

DTYPES = {name: getattr(np, name) for name in ("uint8", "float32", "float64")}


def _of(module: Any, base: type = object) -> dict[str, type]:
    """Return the classes that a module or the modules of a package define, by name."""
    classes = {name: kind for name, kind in vars(module).items() if isinstance(kind, type) and issubclass(kind, base)}
    return {name: kind for name, kind in classes.items() if f"{kind.__module__}.".startswith(f"{module.__name__}.")}


WARNINGS = _of(errors, errors.Warning)
IN_STORAGE = (framebuffer.Storage, framebuffer.Framebuffer, framebuffer.Attachment, image.Image, texture.Texture)
LIGHT_SHAPES = (scene.Rectangle, scene.Disc, scene.Sphere, scene.Segment)
IN_SCENE = (scene.Scene, scene.SceneObject, scene.Mesh, scene.Camera, scene.Light, scene.Material, *LIGHT_SHAPES)
KINDS: dict[str, type] = {
    **{name: kind for name, kind in (_of(commands) | _of(state)).items() if is_dataclass(kind)},
    **{
        kind.__name__: kind
        for kind in (commands.Draw, commands.Vertices, texture.Sampler, image.Format, Frame, *IN_STORAGE, *IN_SCENE)
    },
}
NAMES = {kind: name for name, kind in KINDS.items()}


class Packer:
    """Converts values to JSON; arrays are collected in `arrays`, and a shared object is stored once."""

    def __init__(self) -> None:
        self.arrays: list[np.ndarray] = []
        self.objects: list[Any] = []
        self._seen: dict[int, dict[str, int]] = {}
        self._alive: list[Any] = []  # an id stays unique only while its object lives

    def pack(self, value: Any) -> Any:
        """Return the value as JSON.

        Raises
        ------
        TypeError                    recordings have no values of this type
        """
        if value is None or isinstance(value, bool | int | float | str):
            return value
        if isinstance(value, np.generic):
            return value.item()
        if isinstance(value, bytes):
            return {"bytes": value.hex()}
        if isinstance(value, list | tuple) and type(value) not in NAMES:
            return {"list" if isinstance(value, list) else "tuple": [self.pack(item) for item in value]}
        if isinstance(value, Mapping):
            return {"mapping": [[self.pack(key), self.pack(item)] for key, item in value.items()]}
        if isinstance(value, type):
            return {"dtype": np.dtype(value).name}
        if isinstance(value, errors.Warning):
            return {"warning": type(value).__name__, "message": str(value)}
        if id(value) not in self._seen:
            self._alive.append(value)
            self._seen[id(value)] = self._packed_once(value)
        return self._seen[id(value)]

    def _packed_once(self, value: Any) -> dict[str, int]:
        if isinstance(value, np.ndarray):
            self.arrays.append(value)
            return {"array": len(self.arrays) - 1}
        if type(value) not in NAMES:
            raise TypeError(f"a {type(value).__name__} cannot be saved")
        packed = {name: self.pack(getattr(value, name)) for name in stored_fields(type(value))}
        self.objects.append([NAMES[type(value)], packed])
        return {"object": len(self.objects) - 1}


class Unpacker:
    """Recreates the values that a `Packer` packed; arrays are read-only.

    Raises
    ------
    SoftShadowError, ValueError, KeyError, TypeError, IndexError, RecursionError    no `Packer` wrote this
    """

    def __init__(self, objects: list[Any], arrays: list[np.ndarray]) -> None:
        self.arrays = arrays
        for array in arrays:
            array.setflags(write=False)
        self.objects: list[Any] = []
        for name, packed in objects:  # in the order of packing: an object comes after its parts
            if name not in KINDS:
                raise SoftShadowError(f"a recording has no {name!r}")
            values = {key: self.unpack(value) for key, value in packed.items()}
            validate_fields(KINDS[name], values)
            self.objects.append(KINDS[name](**values))
            if isinstance(self.objects[-1], image.Image):
                validate_image(self.objects[-1])

    def unpack(self, value: Any) -> Any:
        """Return the value that JSON stands for."""
        if not isinstance(value, dict):
            return value
        ((key, content), *_) = value.items()
        if key in ("array", "object"):
            if content < 0:
                raise IndexError(f"{key} {content}")
            return (self.arrays if key == "array" else self.objects)[content]
        if key == "bytes":
            return bytes.fromhex(content)
        if key == "mapping":
            return {self.unpack(name): self.unpack(item) for name, item in content}
        if key == "dtype":
            return DTYPES[content]
        if key == "warning":
            return WARNINGS[content](value["message"])
        items = [self.unpack(item) for item in content]
        return tuple(items) if key == "tuple" else items
