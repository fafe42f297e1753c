"""Which draws a table takes, so that it equals `geometry.geometry.process_geometry`, see fast/test_batch.py."""

from __future__ import annotations

import sys
from collections.abc import Sequence

import numpy as np

from softshadow import matrices
from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer
from softshadow.pipeline.alike_draws import AlikeDraws, vertex_counts
from softshadow.pipeline.alike_vertices import GivenVertices
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.batch.assembly import MODES, WIDTH_OF_POLYGONS, width_of
from softshadow.pipeline.fast.batch.vertices import GENERATED
from softshadow.pipeline.geometry.draw_primitives import has_no_edges
from softshadow.pipeline.geometry.vertex import to_clip
from softshadow.pipeline.mesa.polygon_rules import effective_modes, offset_is_on, passes_stages
from softshadow.pipeline.mesa.provoking_vertex import first_provokes
from softshadow.pipeline.mesa.rectangles import LAST_NINE, TRIANGLE, start_of_last_nine
from softshadow.programs.inverse import UNKNOWN
from softshadow.programs.lighting import has_stale_products
from softshadow.state import Points, Polygon, State

PLAIN_POINTS = Points()
WORTH_COMPARING = 256  # vertices of a draw from which it is compared with recent ones
STRIPS_WORTH_COMPARING = 4096  # of several strips, which seldom come again under other states
LONG_DRAW = 1 << 13  # vertices from which a draw without colours goes in chunks (fast.depth_only)
LEAST_HEIGHT = 1 / 8  # half pixels that no rounding makes of nothing: steps of window y are 1/256 pixel or less


def leaves_out_triangles(command: Draw) -> bool:
    """Return whether llvmpipe may leave out triangles of a draw of separate triangles (`mesa.rectangles`).

    It leaves out three, of which the last one has no height in the window.
    """
    if command.mode != gl.GL_TRIANGLES or command.indices is not None:
        return False
    positions = command.vertices.position
    first = start_of_last_nine(len(positions))
    if first < 0:
        return False
    last = positions[first + LAST_NINE - TRIANGLE : first + LAST_NINE]
    clip = to_clip(matrices.multiply(command.projection, command.modelview), last).astype(np.float64)
    with np.errstate(all="ignore"):
        heights = clip[:, 1] / clip[:, 3]
    return not (heights.max() - heights.min()) * command.state.viewport.height > LEAST_HEIGHT


def is_filled(polygon: Polygon) -> bool:
    """Return whether polygons are drawn whole: their edges do not matter."""
    return polygon.mode_front == gl.GL_FILL and polygon.mode_back == gl.GL_FILL and not polygon.stippled


def is_outlined_alone(command: Draw) -> bool:
    """Return whether a draw of unfilled or stippled polygons is large, or has edge flags that decide more than edges.

    A large one is looked for on its own, but for joined pairs, whose arrays are new in each frame. Edge flags decide
    how quads are cut where all faces of an unfilled mode are culled, and without any edge there are no fragments.
    """
    if is_filled(command.state.polygon):
        return False
    if len(command.vertices.position) >= WORTH_COMPARING and not command.pairs_mode:
        return True
    return command.vertices.edges is not None and (not passes_stages(command.state) or has_no_edges(command))


def least_compared(command: Draw) -> int:
    """Return how many vertices make a draw worth comparing with recent ones: it may be drawn in several passes.

    Lines and points are not compared.
    """
    if width_of(command.mode) < WIDTH_OF_POLYGONS:
        return sys.maxsize
    return STRIPS_WORTH_COMPARING if command.pairs_mode else WORTH_COMPARING


def is_long(command: Draw) -> bool:
    """Return whether a draw, if it has no colours, is better set up and filled in chunks than together with others."""
    return len(command.vertices.position) >= LONG_DRAW


def can_run(command: Draw) -> bool:
    """Return whether a draw can be processed in a table, as far as its vertices and its primitives decide it."""
    if command.mode not in MODES or command.program_name or command.linear or command.joined_positions is not None:
        return False
    vertices, lights = command.vertices, command.state.lighting
    if vertices.position.dtype != np.float32 or command.modelview_kind & UNKNOWN:
        return False
    if leaves_out_triangles(command) or is_outlined_alone(command):
        return False
    return not (lights.enabled and lights.two_side and has_stale_products(lights, vertices.materials, vertices.color))


def continues_moved(command: Draw) -> bool:
    """Return whether a draw continues a run if it differs from the draw before in vertices and modelview matrix only.

    It is small (`least_compared`), and has arrays of the same attributes. What edge flags decide depends on their
    values (`is_outlined_alone`).
    """
    if command.modelview_kind & UNKNOWN or command.vertices.edges is not None:
        return False
    return not leaves_out_triangles(command)


def continue_moved(draws: Sequence[Draw]) -> bool:
    """Return whether draws are small, and each but the first continues a run, as for `continues_moved`."""
    if type(draws) is not AlikeDraws:
        return max(vertex_counts(draws)) < least_compared(draws[0]) and all(map(continues_moved, draws[1:]))
    like, vertices = draws.like, draws.vertices
    if max(vertices.counts) >= least_compared(like) or any(kind & UNKNOWN for kind in set(draws.kinds)):
        return False
    if isinstance(vertices, GivenVertices) and any(each.edges is not None for each in vertices.vertices):
        return False
    can_leave_out = like.mode == gl.GL_TRIANGLES and any(start_of_last_nine(n) >= 0 for n in set(vertices.counts))
    return not (can_leave_out and any(map(leaves_out_triangles, draws)))


def can_begin_run(command: Draw, target: Framebuffer) -> bool:
    """Return whether a draw can be processed in a table, as far as its state decides it."""
    state = command.state
    if not can_run(command) or not target.attachments:
        return False
    if not _are_covered(command.mode, state):
        return False
    modes = [gen.mode for unit in state.units for gen in unit.gen if gen.enabled]
    return all(mode in GENERATED for mode in modes)


def _are_covered(mode: int, state: State) -> bool:
    """Return whether primitives of a mode can be set up together: unfilled or stippled polygons if they are plain."""
    points, lines, polygon = state.points, state.lines, state.polygon
    if width_of(mode) < WIDTH_OF_POLYGONS or not passes_stages(state):
        return True
    if first_provokes(state) or lines.smooth or points != PLAIN_POINTS:
        return False
    front, back = effective_modes(state)
    if (front, back) == (gl.GL_FILL, gl.GL_FILL):
        return polygon.stippled
    return not polygon.stippled and (front == back or not offset_is_on(polygon))
