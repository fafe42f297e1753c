"""glPixelTransfer and glPixelMap: what happens to pixels on their way.

References: GL 2.1, sec. 3.6.3; pixel.c of Mesa 22.3.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current
from softshadow.frozen import evolve
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.conversions import single
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.pixel_memory import destination, source
from softshadow.pixel_transfer import INDEX_MAPS, INTEGER_MAPS, LARGEST_MAP, MAPS
from softshadow.tokens import token_name

LARGEST_UINT, LARGEST_USHORT = 2**32 - 1, 2**16 - 1
# parameter of a colour: (channel, 0 for the scale and 1 for the bias)
OF_COLORS = {
    gl.GL_RED_SCALE: (0, 0),
    gl.GL_RED_BIAS: (0, 1),
    gl.GL_GREEN_SCALE: (1, 0),
    gl.GL_GREEN_BIAS: (1, 1),
    gl.GL_BLUE_SCALE: (2, 0),
    gl.GL_BLUE_BIAS: (2, 1),
    gl.GL_ALPHA_SCALE: (3, 0),
    gl.GL_ALPHA_BIAS: (3, 1),
}
OF_DEPTH = {gl.GL_DEPTH_SCALE: 0, gl.GL_DEPTH_BIAS: 1}
SWITCHES = {gl.GL_MAP_COLOR: "map_color", gl.GL_MAP_STENCIL: "map_stencil"}
INTEGERS = {gl.GL_INDEX_SHIFT: "index_shift", gl.GL_INDEX_OFFSET: "index_offset"}


@in_lists
def glPixelTransferf(pname: int, param: float) -> None:
    """Set a scale, a bias, a switch for the pixel maps, or the shift or offset of indices."""
    _transfer("glPixelTransferf", pname, single(param))


@in_lists
def glPixelTransferi(pname: int, param: int) -> None:
    """Set a scale, a bias, a switch for the pixel maps, or the shift or offset of indices."""
    _transfer("glPixelTransferi", pname, single(param))


def _transfer(operation: str, pname: int, value: float) -> None:
    if (context := outside_begin(operation)) is None:
        return
    before = context.pixel_transfer
    changed: Any
    if pname in OF_COLORS:
        channel, part = OF_COLORS[pname]
        field, scales = "scales", before.scales
        changed = (*scales[:channel], _with(scales[channel], part, value), *scales[channel + 1 :])
    elif pname in OF_DEPTH:
        field, changed = "depth", _with(before.depth, OF_DEPTH[pname], value)
    elif pname in SWITCHES:
        field, changed = SWITCHES[pname], value != 0
    elif pname in INTEGERS:
        field, changed = INTEGERS[pname], int(np.clip(np.nan_to_num(value), -(2**31), 2**31 - 1))
    else:
        fail(gl.GL_INVALID_ENUM, operation, f"pname={token_name(pname)}: expected a parameter of pixel transfer")
        return
    if getattr(before, field) != changed:
        context.flush_vertices()
        context.touched |= gl.GL_PIXEL_MODE_BIT
        context.pixel_transfer = evolve(before, **{field: changed})


def _with(pair: tuple[float, float], part: int, value: float) -> tuple[float, float]:
    return (value, pair[1]) if part == 0 else (pair[0], value)


# -- maps --------------------------------------------------------------------------------------------------------------
def glPixelMapfv(map: int, *arguments: Any) -> None:
    """Set the table of a pixel map from floats: (map, values), or (map, mapsize, values) as in C."""
    _map("glPixelMapfv", map, np.float32, lambda values: values, *arguments)


def glPixelMapuiv(map: int, *arguments: Any) -> None:
    """Set the table of a pixel map from integers, of which 2**32 - 1 is a colour of 1."""
    _map("glPixelMapuiv", map, np.uint32, lambda values: values * (1.0 / LARGEST_UINT), *arguments)


def glPixelMapusv(map: int, *arguments: Any) -> None:
    """Set the table of a pixel map from integers, of which 2**16 - 1 is a colour of 1."""
    step = np.float32(1) / np.float32(LARGEST_USHORT)
    _map("glPixelMapusv", map, np.uint16, lambda values: values.astype(np.float32) * step, *arguments)


def _map(
    operation: str,
    name: int,
    dtype: type[np.generic],
    to_color: Callable[[np.ndarray], np.ndarray],
    *arguments: Any,
) -> None:
    context, values = current(), arguments[-1]
    n_values = int(arguments[0]) if len(arguments) == 2 else int(np.size(values))
    table = None
    if 0 < n_values <= LARGEST_MAP:
        given = _numbers(context, values, dtype, n_values, operation)
        if given is None:
            return
        table = given.astype(np.float32) if name in INTEGER_MAPS else to_color(given).astype(np.float32)
    _set_map(operation, name, n_values, table)


def _numbers(
    context: Context, values: Any, dtype: type[np.generic], n_values: int, operation: str
) -> np.ndarray | None:
    """Return so many numbers from client memory or the bound buffer object; None after an error of GL."""
    memory = source(context, values, n_values * np.dtype(dtype).itemsize, np.dtype(dtype).itemsize, operation)
    if memory is None:
        return None
    if context.unpack_store.buffer:
        return memory[: n_values * np.dtype(dtype).itemsize].view(dtype)
    given = np.ravel(np.frombuffer(memory, dtype) if isinstance(memory, bytes | bytearray) else np.asarray(memory))
    if len(given) < n_values:
        raise ValueError(f"{operation}: mapsize={n_values}, but values has {len(given)} numbers")
    return given[:n_values].astype(dtype)


@in_lists
def _set_map(operation: str, name: int, n_values: int, table: np.ndarray | None) -> None:
    if (context := outside_begin(operation)) is None:
        return
    if table is None:
        fail(gl.GL_INVALID_VALUE, operation, f"mapsize={n_values}: expected 1 to {LARGEST_MAP}")
    elif name in (*INTEGER_MAPS, *INDEX_MAPS) and n_values & (n_values - 1):
        fail(gl.GL_INVALID_VALUE, operation, f"mapsize={n_values}: expected a power of two for {token_name(name)}")
    elif _is_map(operation, name):
        if name == gl.GL_PIXEL_MAP_S_TO_S:
            table = np.rint(table)
        elif name != gl.GL_PIXEL_MAP_I_TO_I:
            table = np.fmax(table, np.float32(0)).clip(0, 1)
        context.flush_vertices()
        maps = {**context.pixel_transfer.maps, name: table}
        context.pixel_transfer = evolve(context.pixel_transfer, maps=maps)


def _is_map(operation: str, name: int) -> bool:
    if name in MAPS:
        return True
    fail(gl.GL_INVALID_ENUM, operation, f"map={token_name(name)}: expected GL_PIXEL_MAP_I_TO_I … GL_PIXEL_MAP_A_TO_A")
    return False


def glGetPixelMapfv(map: int, values: Any = None) -> Any:
    """Return the table of a pixel map, float32."""
    return _get_map("glGetPixelMapfv", map, values, np.float32)


def glGetPixelMapuiv(map: int, values: Any = None) -> Any:
    """Return the table of a pixel map, uint32; of GL_PIXEL_MAP_S_TO_S the bits of its floats, as in Mesa."""
    return _get_map("glGetPixelMapuiv", map, values, np.uint32)


def glGetPixelMapusv(map: int, values: Any = None) -> Any:
    """Return the table of a pixel map, uint16."""
    return _get_map("glGetPixelMapusv", map, values, np.uint16)


def _get_map(operation: str, name: int, values: Any, dtype: type[np.generic]) -> Any:
    context = outside_begin(operation)
    if context is None or not _is_map(operation, name):
        return None
    table = context.pixel_transfer.maps[name]
    if dtype == np.uint32:
        of_floats = name == gl.GL_PIXEL_MAP_S_TO_S
        answer = table.view(np.uint32).copy() if of_floats else _modulo(table * np.float64(LARGEST_UINT))
    elif dtype == np.uint16:
        of_integers = name in INTEGER_MAPS
        scaled = np.clip(table, 0, LARGEST_USHORT) if of_integers else np.rint(table * np.float32(LARGEST_USHORT))
        answer = scaled.astype(np.uint16)
    else:
        answer = table.copy()
    return destination(context, values, answer, operation)


def _modulo(numbers: np.ndarray) -> np.ndarray:
    """Return the whole parts of numbers modulo 2**32."""
    return (numbers.astype(np.int64) & LARGEST_UINT).astype(np.uint32)


# -- glGet -------------------------------------------------------------------------------------------------------------
def queries() -> dict[int, Callable[[Context], Any]]:
    """Return the readers of the state of pixel transfer by token."""
    readers: dict[int, Callable[[Context], Any]] = {gl.GL_MAX_PIXEL_MAP_TABLE: lambda c: LARGEST_MAP}
    for pname, (channel, part) in OF_COLORS.items():
        readers[pname] = lambda c, channel=channel, part=part: c.pixel_transfer.scales[channel][part]  # type: ignore[misc]
    for pname, part in OF_DEPTH.items():
        readers[pname] = lambda c, part=part: c.pixel_transfer.depth[part]  # type: ignore[misc]
    for pname, field in (SWITCHES | INTEGERS).items():
        readers[pname] = lambda c, field=field: getattr(c.pixel_transfer, field)  # type: ignore[misc]
    for name in MAPS:
        size = getattr(gl, f"{token_name(name)}_SIZE")
        readers[size] = lambda c, name=name: len(c.pixel_transfer.maps[name])  # type: ignore[misc]
    return readers


__all__ = spelled_like_gl(globals())
