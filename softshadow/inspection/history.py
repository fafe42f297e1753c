"""The history of a pixel: every fragment that met it, in order, with the test that decided about it.

The recorded commands are played again, and at the one pixel every fragment is shaded, tested and blended by the same
functions that draw the picture. So the last row is what the buffers hold.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from softshadow import pipeline
from softshadow import tokens as gl
from softshadow.context import Frame
from softshadow.framebuffer import DEFAULT, Framebuffer, Storage
from softshadow.image import Image
from softshadow.inspection.reasons import clear_reason, culled_reason, fragment_reason, outside
from softshadow.inspection.step import object_of
from softshadow.inspection.tables import html_table, text_table
from softshadow.pipeline import commands
from softshadow.pipeline.commands import Clear, Command, Draw
from softshadow.pipeline.execute import execute
from softshadow.pipeline.geometry.facing import CULL_BACK, CULL_FRONT, culling
from softshadow.pipeline.geometry.geometry import process_geometry
from softshadow.pipeline.raster.coverage import triangles_at
from softshadow.pipeline.raster.fragment_ops import fragment_ops, process_fragment
from softshadow.pipeline.raster.ordered import fragment_depth
from softshadow.pipeline.raster.region import depth_range_of, region_of
from softshadow.pipeline.records import PASSED, SCISSORED, VERDICTS, Fragments, Geometry
from softshadow.pipeline.shade.blend import compared_alpha
from softshadow.pipeline.shade.color_writes import color_writer
from softshadow.pipeline.shade.visible_spans import spans_of
from softshadow.pixels import depth_as_float

CULLED, CLEARED, WRITTEN = "culled", "clear", "written"
NO_FRAGMENT = {"draw": None, "object": "", "triangle": None, "front_facing": None, "z": None}
Moment = tuple[tuple[int, int, int], float, int]  # red, green and blue; window z; stencil

# commands that neither read nor write the window's pixels; a kind that is not named here counts as doing both
APART = (
    commands.DefineImage, commands.UpdateImage, commands.CreateTexture, commands.SetSampler, commands.DeleteTextures,
    commands.CreateFramebuffer, commands.DeleteFramebuffers, commands.DefineRenderbuffer, commands.DeleteRenderbuffers,
    commands.AttachTexture, commands.AttachRenderbuffer, commands.SelectBuffers,
)  # fmt: skip


@dataclass(frozen=True)
class HistoryRow:
    """What one fragment, one clear, or one culled triangle meant to the pixel.

    `step` is the number of the step and `title` its title; `draw` counts the draws of the frame from 0, `triangle`
    those of the draw as they were handed in; a clear has neither. `z` and `stored_z` are window z in [0, 1]; `verdict`
    is one of passed, scissor, alpha failed, stencil failed, depth failed, culled, clear, written; `color_after` is red,
    green, blue, 0-255.
    """

    step: int
    title: str
    draw: int | None
    object: str
    triangle: int | None
    front_facing: bool | None
    z: float | None
    stored_z: float
    verdict: str
    stencil_before: int
    stencil_after: int
    depth_after: float
    color_after: tuple[int, int, int]
    reason: str
    color_written: bool = False


@dataclass(frozen=True)
class PixelHistory:
    """All rows of one pixel, in order. x counts from the left, y from the top; GL's own y from the bottom."""

    x: int
    y: int
    gl_y: int
    rows: tuple[HistoryRow, ...]

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[HistoryRow]:
        return iter(self.rows)

    def __getitem__(self, index: int) -> HistoryRow:
        return self.rows[index]

    def to_dicts(self) -> list[dict[str, Any]]:
        """Return the rows as plain dictionaries."""
        return [asdict(row) for row in self.rows]

    @property
    def heading(self) -> str:
        return f"pixel x={self.x} y={self.y} (GL y={self.gl_y})"

    def __str__(self) -> str:
        return f"{self.heading}\n{text_table(HEADS, [_cells(row) for row in self.rows])}"

    def _repr_html_(self) -> str:
        return f"<p>{self.heading}</p>" + html_table(HEADS, [_cells(row) for row in self.rows])


HEADS = ("step", "draw", "object", "triangle", "facing", "z", "stored z", "stencil", "colour", "verdict", "reason")


def _cells(row: HistoryRow) -> list[str]:
    changed = row.stencil_before != row.stencil_after
    return [
        str(row.step),
        "-" if row.draw is None else str(row.draw),
        row.object or "-",
        "-" if row.triangle is None else str(row.triangle),
        "-" if row.front_facing is None else "front" if row.front_facing else "back",
        "-" if row.z is None else f"{row.z:.6f}",
        f"{row.stored_z:.6f}",
        f"{row.stencil_before} -> {row.stencil_after}" if changed else str(row.stencil_after),
        "#{:02x}{:02x}{:02x}".format(*row.color_after),
        row.verdict,
        row.reason,
    ]


def pixel_history(frame: Frame, x: int, y: int) -> PixelHistory:
    """Return the history of a pixel of the window.

    Parameters
    ----------
    x, y : int                   column, and row from the top

    Raises
    ------
    ValueError                   outside the window, or not whole numbers
    """
    width, height = frame.size
    for name, value, end in (("x", x, width), ("y", y, height)):
        if isinstance(value, bool) or not isinstance(value, int | np.integer) or not 0 <= value < end:
            raise ValueError(f"{name}={value!r}: expected a whole number from 0 to {end - 1}")
    return PixelHistory(int(x), int(y), height - 1 - int(y), tuple(_play(frame, int(y), int(x))))


def _play(frame: Frame, row: int, column: int) -> Iterator[HistoryRow]:
    """Play the frame and yield the pixel's rows.

    Commands of the window are played at this pixel only, except those before the last one that reads the window's
    pixels: its result may come back as a texture.
    """
    storage = frame.fresh_storage()
    pixel = Pixel(storage.window, row, column)
    ends = [end for _, end in frame.steps]
    readers = [i for i, command in enumerate(frame.commands) if not _of_window(command) and not _apart(command)]
    last_reader = readers[-1] if readers else -1
    draws = 0
    for index, command in enumerate(frame.commands):
        step = bisect_right(ends, index)
        where = (step, frame.steps[step][0] if step < len(ends) else "")
        if _of_window(command):
            before = pixel.read()
            if isinstance(command, Draw):
                yield from _draw_rows(command, storage, pixel, where, draws)
            elif isinstance(command, Clear):
                yield _clear_row(command, storage, pixel, where)
            if index < last_reader:
                pixel.write(before)
                execute(command, storage)
        else:
            standing = pixel.moment()
            execute(command, storage)
            if pixel.moment() != standing:
                yield pixel.row(where, standing, WRITTEN, type(command).__name__)
        draws += isinstance(command, Draw)


def _of_window(command: Command) -> bool:
    return isinstance(command, Draw | Clear) and command.state.draw_framebuffer == DEFAULT


def _apart(command: Command) -> bool:
    """Return whether a command has nothing to do with the window's pixels."""
    if isinstance(command, commands.CopyToTexture):
        return command.framebuffer != DEFAULT
    return isinstance(command, (*APART, Draw, Clear))


class Pixel:
    """One pixel of the window: reads and writes its cells, and makes rows of them."""

    def __init__(self, window: Framebuffer, row: int, column: int) -> None:
        color = window.image(gl.GL_COLOR_ATTACHMENT0)
        depth, stencil = window.depth, window.stencil
        assert color is not None
        assert depth is not None
        assert stencil is not None
        self.window, self.place = window, (row, column)
        self.color, self.depth, self.stencil = color, depth, stencil

    def read(self) -> tuple[np.ndarray, Any, Any]:
        """Return the stored colour, depth in buffer units, and stencil."""
        return self.color.cells[self.place].copy(), self.depth.cells[self.place], self.stencil.cells[self.place]

    def write(self, values: tuple[np.ndarray, Any, Any]) -> None:
        self.color.cells[self.place], self.depth.cells[self.place], self.stencil.cells[self.place] = values

    def z(self, units: Any) -> float:
        """Return window z of a depth in buffer units."""
        return window_z(units, self.depth)

    def moment(self) -> Moment:
        """Return red, green and blue, window z and stencil."""
        color, depth, stencil = self.read()
        red, green, blue = (int(channel) for channel in color[:3])
        return (red, green, blue), self.z(depth), int(stencil)

    def row(self, where: tuple[int, str], before: Moment, verdict: str, reason: str, **fragment: Any) -> HistoryRow:
        """Return the row of what has just happened to the pixel; `fragment` is what else there is to say of it."""
        color, depth, stencil = self.moment()
        step, title = where
        return HistoryRow(
            step=step, title=title, stored_z=before[1], verdict=verdict, stencil_before=before[2],
            stencil_after=stencil, depth_after=depth, color_after=color, reason=reason, **(NO_FRAGMENT | fragment),
        )  # fmt: skip


def window_z(units: Any, depth: Image) -> float:
    """Return window z as the depth read-out delivers it."""
    return float(depth_as_float(np.array([units], depth.format.dtype), depth.format)[0])


def _clear_row(command: Clear, storage: Storage, pixel: Pixel, where: tuple[int, str]) -> HistoryRow:
    before = pixel.moment()
    if not _inside(command.state, pixel):
        return pixel.row(where, before, VERDICTS[SCISSORED], f"glClear: {outside(command.state.scissor)}")
    execute(command, storage)
    return pixel.row(where, before, CLEARED, clear_reason(command, pixel.window))


def _inside(state: Any, pixel: Pixel) -> bool:
    region = region_of(state, pixel.window)
    row, column = pixel.place
    return region.first_row <= row < region.end_row and region.left <= column < region.right


def _draw_rows(
    command: Draw, storage: Storage, pixel: Pixel, where: tuple[int, str], draw: int
) -> Iterator[HistoryRow]:
    """Yield a row for every triangle of a draw that covers the pixel, and change the pixel as its fragments do."""
    with np.errstate(all="ignore"):  # as in pipeline.draw
        geometry = process_geometry(command, pixel.window, storage, replace(command.state.cull, enabled=False))
        if not len(geometry.triangles.ids):
            return
        fragments = _fragments_at(geometry, pixel)
        if not len(fragments.row):
            return
        colors = pipeline.shade(geometry, spans_of(fragments))
    state, window, triangles = command.state, pixel.window, geometry.triangles
    real = pixel.depth.cells.dtype.type
    depth_range = depth_range_of(state, real)
    row, column = pixel.place
    inside, (culled, _) = _inside(state, pixel), culling(state.cull)
    colored = bool(window.colors) and any(state.color.mask)
    for n, t in enumerate(fragments.triangle):
        front = geometry.facing(t)
        ops = fragment_ops(state, window.depth, window.stencil, bool(triangles.front[t]))
        z = real(fragment_depth(triangles.depth, t, real(row), real(column), depth_range, ops.depth_largest))
        before, (_, stored_z, s) = pixel.moment(), pixel.read()
        about: dict[str, Any] = {
            "draw": draw,
            "object": object_of(command),
            "triangle": int(geometry.source[triangles.ids[t]]),
            "front_facing": front,
            "z": pixel.z(z),
        }
        if front is not None and culled & (CULL_FRONT if front else CULL_BACK):
            yield pixel.row(where, before, CULLED, culled_reason(front, state), **about)
            continue
        compared, alpha_ref = compared_alpha(state, window.color, colors[n : n + 1, 3])
        ops, alpha = ops._replace(alpha_ref=alpha_ref), int(compared[0])
        verdict, s_after, depth_after = process_fragment(ops, inside, alpha, z, stored_z, s)
        pixel.stencil.cells[pixel.place] = s_after
        if ops.depth_write:
            pixel.depth.cells[pixel.place] = depth_after
        written = verdict == PASSED and colored
        for image in window.colors if written else ():
            color_writer(state, image)(spans_of(Fragments(*(part[n : n + 1] for part in fragments))), colors[n : n + 1])
        z_pair, s_pair = (about["z"], before[1]), (before[2], int(s_after))
        reason = fragment_reason(state, ops, verdict, z_pair, s_pair, alpha, colored)
        yield pixel.row(where, before, VERDICTS[verdict], reason, color_written=written, **about)


def _fragments_at(geometry: Geometry, pixel: Pixel) -> Fragments:
    """Return the fragments of all triangles at the pixel, in drawing order."""
    row, column = pixel.place
    found = np.empty(len(geometry.triangles.ids), np.int32)
    count = triangles_at(geometry.triangles.corners, column, row, int(pixel.window.flipped), found)
    return Fragments(np.full(count, row, np.int32), np.full(count, column, np.int32), found[:count].copy())
