"""Checks of a recording that was read from a file: what a context records is right, what a file holds may be anything.

Every value must have the type of its field, and every array the shape that kernels rely on: they check no index.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from functools import cache
from types import NoneType, UnionType
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

import numpy as np

from softshadow.context import Frame
from softshadow.framebuffer import DEPTH_FORMATS, LARGEST_SIDE, NOTHING
from softshadow.image import EXACT_DEPTH, FORMATS, STENCIL8, Image, new_cells
from softshadow.inspection.replay import Buffers
from softshadow.pipeline import commands
from softshadow.pipeline.geometry.separate import is_separated
from softshadow.state import Polygon, State
from softshadow.state.rasterization import SOLID

# what GL calls hold: signed or unsigned numbers of 32 bits
SMALLEST_INT, LARGEST_INT = -(2**31), 2**32 - 1
CREATES = (commands.CreateTexture, commands.CreateFramebuffer, commands.DefineRenderbuffer)
NOT_STORED = {"shown_at"}  # of a draw: what a file says of it might be wrong
OBJECTS = ("texture", "framebuffer", "renderbuffer")
KNOWN_FORMATS = {*FORMATS.values(), *DEPTH_FORMATS.values(), STENCIL8, EXACT_DEPTH, NOTHING}


def stored_fields(kind: Any) -> tuple[str, ...]:
    """Return the names of the fields of a class that a file has."""
    if issubclass(kind, tuple):
        return tuple(name for name in kind._fields if name not in NOT_STORED)
    return tuple(each.name for each in fields(kind) if each.init)


@cache
def _hints(kind: type) -> dict[str, Any]:
    return get_type_hints(kind)


@cache
def _lengths(kind: type) -> dict[str, int]:
    """Return the lengths of the tuples in a group of the state: texture units, lights, clip planes ..."""
    if not kind.__module__.startswith(State.__module__):
        return {}
    initial = vars(kind())
    return {name: len(value) for name, value in initial.items() if isinstance(value, tuple)}


def validate_fields(kind: type, values: Mapping[str, Any]) -> None:
    """Raise a ValueError unless values are those of all fields of a class, each of its type."""
    hints, names = _hints(kind), stored_fields(kind)
    if set(values) != set(names):
        raise ValueError(f"{kind.__name__}: expected the fields {', '.join(sorted(names))}")
    for name, value in values.items():
        if name != "history_bytes":  # nothing more is recorded
            validate_type(f"{kind.__name__}.{name}", value, hints[name])
    for name, length in _lengths(kind).items():
        if len(values[name]) != length:
            raise ValueError(f"{kind.__name__}.{name}: expected {length} values")
    if kind is Polygon and len(values["stipple"]) != len(SOLID):
        raise ValueError(f"Polygon.stipple: expected {len(SOLID)} bytes")


def validate_type(name: str, value: Any, kind: Any) -> None:
    """Raise a ValueError unless a value has a type; `kind` is an annotation."""
    if not _is(value, kind):
        raise ValueError(f"{name}: a {type(value).__name__} is not what was recorded there")


def _is(value: Any, kind: Any) -> bool:
    origin, arguments = get_origin(kind), get_args(kind)
    if kind is Any:
        return True
    if origin in (Union, UnionType):
        return any(_is(value, each) for each in arguments)
    if origin is Literal:
        return value in arguments
    if origin is tuple:
        if not isinstance(value, tuple):
            return False
        if arguments[-1:] == (...,):
            return all(_is(item, arguments[0]) for item in value)
        return len(value) == len(arguments) and all(map(_is, value, arguments))
    if origin is list:
        return isinstance(value, list) and all(_is(item, arguments[0]) for item in value)
    if origin is type:
        return isinstance(value, type)
    if origin is not None and issubclass(origin, Mapping):
        is_mapping = isinstance(value, Mapping)
        return is_mapping and all(_is(key, arguments[0]) and _is(item, arguments[1]) for key, item in value.items())
    if kind is None or kind is NoneType:
        return value is None
    if isinstance(value, int) and not SMALLEST_INT <= value <= LARGEST_INT:
        return False
    return isinstance(value, int | float if kind is float else kind)


def validate_frame(frame: Any) -> None:
    """Raise a ValueError unless a frame can be replayed without an index outside an array."""
    validate_type("the recording", frame, Frame)
    if not all(1 <= side <= LARGEST_SIDE for side in frame.size):
        raise ValueError(f"a window of {frame.size[0]} x {frame.size[1]}")
    if frame.depth_format not in DEPTH_FORMATS or frame.precision not in ("mesa", "exact"):
        raise ValueError(f"depth format {frame.depth_format!r}, precision {frame.precision!r}")
    if not 0 <= frame.stencil_bits <= 8:
        raise ValueError(f"{frame.stencil_bits} stencil bits")
    ends = [0, *(end for _, end in frame.steps), len(frame.commands)]
    if ends != sorted(ends):
        raise ValueError("the steps do not end in order, or after the last command")
    validate_type("a command", tuple(frame.commands), tuple[commands.Command, ...])
    for command in map(drawing, frame.commands):
        if isinstance(command, commands.Draw):
            _validate_draw(command)
        elif isinstance(command, commands.DefineImage | commands.DefineRenderbuffer):
            _validate_definition(command)
    _validate_names(frame)


def drawing(command: commands.Command) -> commands.Command:
    """Return the draw inside a command, or the command itself."""
    return command.draw if isinstance(command, commands.DrawDepths) else command


def validate_buffers(frame: Frame, buffers: Buffers) -> None:
    """Raise a ValueError unless the buffers of a step are those of the frame's window."""
    width, height = frame.size
    _validate_array("color", buffers.color, np.uint8, height, width, 4)
    _validate_array("depth", buffers.depth, np.float32, height, width)
    _validate_array("stencil", buffers.stencil, np.uint8, height, width)


def validate_map(frame: Frame, name: str, values: np.ndarray) -> None:
    """Raise a ValueError unless a map has a number, or several, at each of its places."""
    width, height = frame.size
    of_window = name not in ("visibility", "valid") or values.shape == (height, width)
    if values.dtype.kind not in "biuf" or values.ndim not in (2, 3) or not values.size or not of_window:
        raise ValueError(f"the map {name}: numbers of shape {values.shape}")


def validate_image(image: Image) -> None:
    """Raise a ValueError unless the cells of an image are those of its format and size."""
    _validate_size(image)
    expected = new_cells(0, image.width, image.format)
    _validate_array("cells", image._cells, expected.dtype, image.height * image.slices, *expected.shape[1:])
    if image.stencil is not None:
        sides = (image.width, image.height, image.slices)
        if (image.stencil.width, image.stencil.height, image.stencil.slices) != sides:
            raise ValueError("an image whose stencil values have another size")
        validate_image(image.stencil)


def _validate_array(name: str, array: Any, dtype: Any, *shape: int | None) -> None:
    """Raise a ValueError unless an array has a type and shape; None is any number."""
    fits = isinstance(array, np.ndarray) and array.dtype == np.dtype(dtype) and array.ndim == len(shape)
    if not fits or any(n not in (None, m) for m, n in zip(array.shape, shape, strict=True)):
        sides = " x ".join("n" if n is None else str(n) for n in shape)
        raise ValueError(f"{name}: expected {sides} numbers {np.dtype(dtype).name}")


def _validate_draw(draw: commands.Draw) -> None:
    vertices = draw.vertices
    n = len(vertices.position) if vertices.position.ndim else 0
    for name, array, width in (
        ("positions", vertices.position, 4), ("colors", vertices.color, 4), ("normals", vertices.normal, 3),
        *(("texture coordinates", each, 4) for each in vertices.texcoords),
    ):  # fmt: skip
        _validate_array(name, array, np.float32, n, width)
    for name, array in vertices.materials.items():
        _validate_array(name, array, np.float32, n, *(() if name.endswith("shininess") else (4,)))
    if vertices.edges is not None:
        _validate_array("edge flags", vertices.edges, bool, n)
    if vertices.secondary is not None:
        _validate_array("secondary colors", vertices.secondary, np.float32, n, 4)
    if vertices.fog_coordinates is not None:
        _validate_array("fog coordinates", vertices.fog_coordinates, np.float32, n)
    if draw.indices is not None:
        _validate_array("indices", draw.indices, np.int32, None)
        if draw.indices.size and not (draw.indices.min() >= 0 and draw.indices.max() < n):
            raise ValueError(f"indices: expected 0 to {n - 1}")
    if draw.pairs_mode and not is_separated(draw):
        raise ValueError(f"a draw of pairs of mode {draw.pairs_mode}: expected indices of separate triangles or lines")
    for matrix in (draw.modelview, draw.projection, *draw.texture_matrices):
        _validate_array("a matrix", matrix, matrix.dtype if matrix.dtype.kind == "f" else np.float64, 4, 4)
    if draw.joined_positions is not None:
        _validate_array("positions", draw.joined_positions, np.float32, None, 4)
        if not 0 <= draw.joined_start <= len(draw.joined_positions) - n:
            raise ValueError(f"positions: {n} from {draw.joined_start} on, of {len(draw.joined_positions)}")


def _validate_names(frame: Frame) -> None:
    """Raise a ValueError unless every object is created before a command names it."""
    start = frame.start
    known: dict[str, set[int]] = {
        name: set() if start is None else set(getattr(start, f"{name}s")) for name in OBJECTS
    }  # fmt: skip
    known["read"] = known["draw"] = known["draw_framebuffer"] = known["read_framebuffer"] = known["framebuffer"]
    for command in map(drawing, frame.commands):
        if isinstance(command, CREATES):
            created_name = stored_fields(type(command))[0]
            known[created_name].add(getattr(command, created_name))
        for part in (command, getattr(command, "state", None)):
            for name, created in known.items():
                if getattr(part, name, 0) not in (0, *created):
                    raise ValueError(f"{type(command).__name__}: there is no {name} {getattr(part, name)}")


def _validate_definition(command: commands.DefineImage | commands.DefineRenderbuffer) -> None:
    if command.format is None:
        return
    _validate_size(command)
    for name, format in (("cells", command.format), ("stencil", STENCIL8)):
        array = getattr(command, name, None)
        if array is not None:
            channels = () if format.channels == 1 else (format.channels,)
            rows = command.height * getattr(command, "slices", 1)
            _validate_array(name, array, format.dtype, rows, command.width, *channels)


def _validate_size(image: Any) -> None:
    sides = image.width, image.height, getattr(image, "slices", 1)
    if image.format not in KNOWN_FORMATS or not all(0 <= side <= LARGEST_SIDE for side in sides):
        raise ValueError(f"an image of {' x '.join(map(str, sides))} {image.format}")
