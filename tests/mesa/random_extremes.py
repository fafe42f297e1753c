"""Random programs at the limits: coordinates to infinity, odd viewports and windows, large meshes, slivers."""

import numpy as np

from mesa.random_vertices import Vertex
from mesa.random_writer import Writer

NOWHERE = [float("nan"), -0.0]
UNUSUAL = [*NOWHERE, 1e-30, 1000.0]
FAR = [1e-30, 1000.0, 1e10, 1e20, 1e30, 3e38]
INFINITE = [-1e15, float("inf"), float("-inf")]
ODD_SIZES = [(1, 1), (3, 2), (17, 129), (65, 64), (64, 65), (300, 200), (131, 77), (5, 200)]


def odd_window(writer: Writer) -> None:
    """A window of any size."""
    writer.size = writer.pick(ODD_SIZES)
    writer.call("glViewport", 0, 0, *writer.size)
    writer.call("glScissor", 0, 0, *writer.size)


def extreme(writer: Writer) -> None:
    """Viewports that are tiny, far outside, or far larger than the window; reversed depth; huge offsets."""
    width, height = writer.size
    writer.geometry_state()
    if writer.chance(0.3):
        writer.fragment_state()
    boxes = [
        (writer.integer(-5, width), writer.integer(-5, height), writer.integer(0, 3), writer.integer(0, 3)),
        (-3 * width, -2 * height, 7 * width, 5 * height),
        (writer.integer(-9000, 0), writer.integer(-9000, 0), 16384, 16384),
        (0, 0, width, height),
        (width // 2, height // 2, width, height),
    ]
    writer.call("glViewport", *writer.pick(boxes))
    writer.call("glDepthRange", *writer.pick([(0.0, 1.0), (1.0, 0.0), (0.75, 0.25), (0.5, 0.5)]))
    if writer.switch("GL_POLYGON_OFFSET_FILL", 0.4):
        huge = [1e6, -1e6, 1e20, -1e30, 16777216.0, 0.0]
        writer.call("glPolygonOffset", writer.pick(huge), writer.pick(huge))
    if writer.chance(0.3):
        writer.matrices(rotations=writer.chance(0.5))


def far_away(writer: Writer, wild: bool) -> None:
    """Triangles some of whose coordinates are huge, infinite, or no numbers."""
    count = writer.integer(1, 4) * 12
    probability = writer.pick([0.02, 0.1, 0.4])
    # w far below 0, all infinite, or two far places of different kinds in one triangle would be the fault
    # "no place in the window" of known_differences.py
    far = writer.pick(FAR + INFINITE)
    places = [*NOWHERE, far]
    choices = [places, places, places, places if far in FAR else NOWHERE] if writer.spread == 1 else [UNUSUAL] * 4
    vertices = [
        tuple(writer.pick(far) if writer.chance(probability) else a for a, far in zip(vertex, choices, strict=True))
        for vertex in writer.vertices(count, wild)
    ]
    attributes = writer.attributes(count) | {"vertex": vertices}
    mode = writer.pick(writer.primitives)
    writer.draw_arrays(mode, attributes) if writer.chance(0.3) else writer.draw_immediate(mode, attributes)


def sliver(writer: Writer, wild: bool) -> None:
    """Many triangles with nearly or exactly no area, some along rows and columns of pixel centres."""
    corners: list[Vertex] = []
    for _ in range(writer.integer(5, 40)):
        x, y, z = (writer.number(-1, 1) for _ in range(3))
        dx, dy = writer.pick([(0.0, 1.0), (1.0, 0.0), (writer.number(-1, 1), writer.number(-1, 1))])
        thin = writer.pick([0.0, 1e-7, 1e-4, 0.004, 0.02])
        corners.append((x, y, z, 1.0))
        corners.append((x + dx, y + dy, writer.number(-1, 1), 1.0))
        corners.append((x + dx / 2 + thin * dy, y + dy / 2 - thin * dx, writer.number(-1, 1), 1.0))
    writer.draw_immediate("GL_TRIANGLES", writer.attributes(len(corners)) | {"vertex": corners})


def mesh(writer: Writer, wild: bool) -> None:
    """A height field of up to two thousand triangles with shared vertices, as indexed triangles or in strips."""
    columns, rows = writer.integer(2, 32), writer.integer(2, 32)
    grid = np.ones((rows, columns, 4), np.float32)
    grid[..., 0], grid[..., 1] = np.meshgrid(np.linspace(-1.3, 1.3, columns), np.linspace(-1.3, 1.3, rows))
    grid[..., :2] *= writer.spread
    grid[..., 2] = writer.rng.uniform(-0.4, 0.4, (rows, columns)).round(3)
    colors = writer.rng.integers(0, 256, (rows * columns, 4), dtype=np.uint8)
    for capability in ("GL_VERTEX_ARRAY", "GL_COLOR_ARRAY"):
        writer.call("glEnableClientState", capability)
    writer.call("glVertexPointer", 4, "GL_FLOAT", 0, grid.reshape(-1, 4))
    writer.call("glColorPointer", 4, "GL_UNSIGNED_BYTE", 0, colors)
    number = np.arange(rows * columns).reshape(rows, columns)
    if writer.chance(0.5):
        strip = np.stack([number[:-1], number[1:]], axis=-1).reshape(rows - 1, -1).astype(np.uint32)
        for indices in strip:
            writer.call("glDrawElements", "GL_TRIANGLE_STRIP", len(indices), "GL_UNSIGNED_INT", indices)
    else:
        quads = np.stack([number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], axis=-1)
        indices = quads.reshape(-1).astype(np.uint16)
        writer.call("glDrawElements", "GL_QUADS", len(indices), "GL_UNSIGNED_SHORT", indices)
    for capability in ("GL_VERTEX_ARRAY", "GL_COLOR_ARRAY"):
        writer.call("glDisableClientState", capability)
    writer.call("glColor4f", *writer.color())
