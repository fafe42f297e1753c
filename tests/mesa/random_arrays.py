"""Random programs with vertex arrays: every type, size and stride, indices that share vertices, several draws."""

from typing import Any

import numpy as np

from mesa.random_writer import LINES_AND_POINTS, PRIMITIVES, Writer

TYPES = {
    "GL_BYTE": np.int8, "GL_UNSIGNED_BYTE": np.uint8, "GL_SHORT": np.int16, "GL_UNSIGNED_SHORT": np.uint16,
    "GL_INT": np.int32, "GL_UNSIGNED_INT": np.uint32, "GL_FLOAT": np.float32, "GL_DOUBLE": np.float64,
}  # fmt: skip
POSITION_TYPES = ["GL_SHORT", "GL_INT", "GL_FLOAT", "GL_DOUBLE"]
INDEX_TYPES = {"GL_UNSIGNED_BYTE": np.uint8, "GL_UNSIGNED_SHORT": np.uint16, "GL_UNSIGNED_INT": np.uint32}
STEPS = 100  # integer coordinates are hundredths


def pointed_state(writer: Writer) -> None:
    if writer.chance(0.4):
        writer.matrices(rotations=False)
    writer.geometry_state()
    if writer.chance(0.3):
        writer.fragment_state()
    writer.normals = writer.switch("GL_LIGHTING", 0.3)
    if writer.normals:
        writer.call("glEnable", "GL_LIGHT0")
        writer.call("glColorMaterial", "GL_FRONT_AND_BACK", "GL_DIFFUSE")
        writer.switch("GL_COLOR_MATERIAL", 0.7)
    writer.texture_coordinates = 2 if writer.switch("GL_TEXTURE_2D", 0.4) else 0


def pointed(writer: Writer, wild: bool) -> None:
    """Point at arrays, draw from them several times, and in between give vertices one by one."""
    count = writer.integer(3, 20)
    whole = writer.pick(["", "GL_SHORT", "GL_INT"])
    writer.call("glPushMatrix")
    if whole:
        writer.call("glScalef", 1 / STEPS, 1 / STEPS, 1 / STEPS)
    if writer.chance(0.2):
        capabilities = _interleaved(writer, count)
    else:
        capabilities = _separate(writer, count, whole)
    for _ in range(writer.integer(1, 3)):
        _draw(writer, count)
        if writer.chance(0.4):
            writer.call("glColor4f", *writer.color())
            if writer.normals:
                writer.call("glNormal3f", 0.0, 0.6, 0.8)
        if writer.chance(0.2):
            writer.draw_immediate("GL_TRIANGLES", {"vertex": writer.vertices(6, wild), "color": [None] * 6})
        if writer.chance(0.3):
            writer.call("glDisableClientState", capabilities.pop()) if len(capabilities) > 1 else None
    for capability in capabilities:
        writer.call("glDisableClientState", capability)
    writer.call("glPopMatrix")


def _separate(writer: Writer, count: int, whole: str) -> list[str]:
    """Give each attribute an array of its own; return the capabilities that are on, that of positions first."""
    capabilities = ["GL_VERTEX_ARRAY"]
    kind, size = whole or writer.pick(["GL_FLOAT", "GL_DOUBLE"]), writer.pick([2, 3, 4])
    scale = STEPS if whole else 1
    positions = scale * writer.rng.uniform(-1.2 * writer.spread, 1.2 * writer.spread, (count, size)).round(3)
    if size == 4:
        positions[:, 3] = writer.rng.choice([1, 1, 2], count)
    _point(writer, "glVertexPointer", size, kind, positions)
    if writer.chance(0.7):
        capabilities.append("GL_COLOR_ARRAY")
        kind, size = writer.pick(list(TYPES)), writer.pick([3, 4])
        _point(writer, "glColorPointer", size, kind, _colors(writer, TYPES[kind], (count, size)))
    if writer.normals and writer.chance(0.8):
        capabilities.append("GL_NORMAL_ARRAY")
        kind = writer.pick(["GL_BYTE", *POSITION_TYPES])
        normals = writer.rng.uniform(-1, 1, (count, 3)).round(3)
        if np.dtype(TYPES[kind]).kind == "i":
            normals = normals * np.iinfo(TYPES[kind]).max
        _point(writer, "glNormalPointer", 0, kind, normals)
    if writer.texture_coordinates and writer.chance(0.8):
        capabilities.append("GL_TEXTURE_COORD_ARRAY")
        size = writer.pick([1, 2, 3, 4])
        coordinates = writer.rng.uniform(-2, 3, (count, size)).round(2)
        coordinates[:, 3:] = writer.rng.choice([1, 2], (count, 1))
        _point(writer, "glTexCoordPointer", size, writer.pick(POSITION_TYPES), coordinates)
    for capability in capabilities:
        writer.call("glEnableClientState", capability)
    return capabilities


def _point(writer: Writer, pointer: str, size: int, kind: str, values: np.ndarray) -> None:
    """Lay out values as numbers of a type, with a stride or without, and point at them."""
    dtype = np.dtype(TYPES[kind])
    gap = writer.pick([0, 0, 0, 1, 3])
    rows = np.zeros((len(values), values.shape[1] + gap), dtype)
    rows[:, : values.shape[1]] = values.astype(dtype)
    stride = rows.shape[1] * dtype.itemsize if gap or writer.chance(0.2) else 0
    sizes = (size,) if size else ()
    writer.call(pointer, *sizes, kind, stride, rows)


def _colors(writer: Writer, dtype: type, shape: tuple[int, int]) -> np.ndarray:
    """Return colours of a type: steps of 1/255, or any integers."""
    if np.dtype(dtype).kind == "f":
        return np.round(writer.rng.integers(0, 256, shape) / 255, 4)
    limits = np.iinfo(dtype)
    return writer.rng.integers(limits.min, limits.max, shape, dtype=dtype, endpoint=True)


def _interleaved(writer: Writer, count: int) -> list[str]:
    """Point at parts of one array of positions, colours, and what else vertices bring."""
    parts: list[tuple[str, str, int]] = [
        ("GL_VERTEX_ARRAY", "glVertexPointer", 3),
        ("GL_COLOR_ARRAY", "glColorPointer", writer.pick([3, 4])),
    ]
    parts += [("GL_NORMAL_ARRAY", "glNormalPointer", 3)] * writer.normals
    parts += [("GL_TEXTURE_COORD_ARRAY", "glTexCoordPointer", 2)] * bool(writer.texture_coordinates)
    width = sum(size for _, _, size in parts)
    rows = writer.rng.uniform(-1.2 * writer.spread, 1.2 * writer.spread, (count, width)).round(3).astype(np.float32)
    rows[:, 3:6] = np.round(writer.rng.integers(0, 256, (count, 3)) / 255, 4)
    first = 0
    for capability, pointer, size in parts:
        sizes: tuple[Any, ...] = () if pointer == "glNormalPointer" else (size,)
        writer.call(pointer, *sizes, "GL_FLOAT", width * rows.itemsize, rows.reshape(-1)[first:])
        writer.call("glEnableClientState", capability)
        first += size
    return [capability for capability, _, _ in parts]


def _draw(writer: Writer, count: int) -> None:
    mode = writer.pick(PRIMITIVES if writer.chance(0.8) else LINES_AND_POINTS)
    if writer.chance(0.5):
        first = writer.integer(0, count - 1)
        writer.call("glDrawArrays", mode, first, writer.integer(0, count - first))
    else:
        kind = writer.pick(list(INDEX_TYPES))
        indices = writer.rng.integers(0, count, writer.integer(0, 3 * count)).astype(INDEX_TYPES[kind])
        writer.call("glDrawElements", mode, len(indices), kind, indices)
