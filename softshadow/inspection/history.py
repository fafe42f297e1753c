"""The history of a pixel: every fragment generated there, in order, with the test that decided its fate.

The recorded commands are replayed, and at the pixel every fragment is shaded, tested and blended by the same functions
that draw the picture. The last row therefore equals the buffers.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from typing import Any, NamedTuple

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

# commands that neither read nor write the window's pixels; all others are assumed to do both
INDEPENDENT_OF_WINDOW = (
    commands.DefineImage, commands.UpdateImage, commands.CreateTexture, commands.SetSampler, commands.DeleteTextures,
    commands.CreateFramebuffer, commands.DeleteFramebuffers, commands.DefineRenderbuffer, commands.DeleteRenderbuffers,
    commands.AttachTexture, commands.AttachRenderbuffer, commands.SelectBuffers,
)  # fmt: skip


@dataclass(frozen=True)
class HistoryRow:
    """The effect of one fragment, one clear, or one culled triangle on the pixel.

    `step` is the index of the step and `title` its title. `draw` is the index of the draw in the frame, and `triangle`
    that of the triangle in the draw, before clipping; a clear has neither. `z` and `stored_z` are window z in [0, 1].
    `verdict` is one of passed, scissor, alpha failed, stencil failed, depth failed, culled, clear, written.
    `color_after` is red, green, blue, 0-255.
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
    """All rows of one pixel, in order; x counts from the left, y from the top, and `gl_y` from the bottom."""

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
        """The pixel in both row orders."""
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
    return PixelHistory(int(x), int(y), height - 1 - int(y), tuple(_replay(frame, int(y), int(x))))


def _replay(frame: Frame, row: int, column: int) -> Iterator[HistoryRow]:
    """Replay the frame and yield the pixel's rows.

    Draws and clears of the window are carried out at this pixel only. Those before the last command that reads the
    window are carried out in full as well, because its result may be used as a texture.
    """
    storage = frame.fresh_storage()
    pixel = Pixel(storage.window, row, column)
    ends = [end for _, end in frame.steps]
    readers = [
        i for i, command in enumerate(frame.commands) if not _draws_to_window(command) and not _ignores_window(command)
    ]
    last_reader = readers[-1] if readers else -1
    draws = 0
    for index, command in enumerate(frame.commands):
        step = bisect_right(ends, index)
        where = (step, frame.steps[step][0] if step < len(ends) else "")
        if _draws_to_window(command):
            cells = pixel.read()
            if isinstance(command, Draw):
                yield from _draw_rows(command, storage, pixel, where, draws)
            elif isinstance(command, Clear):
                yield _clear_row(command, storage, pixel, where)
            if index < last_reader:
                pixel.write(cells)
                execute(command, storage)
        else:
            before = pixel.values()
            execute(command, storage)
            if pixel.values() != before:
                yield pixel.row(where, before, WRITTEN, type(command).__name__)
        draws += isinstance(command, Draw)


def _draws_to_window(command: Command) -> bool:
    return isinstance(command, Draw | Clear) and command.state.draw_framebuffer == DEFAULT


def _ignores_window(command: Command) -> bool:
    """Return whether a command neither reads nor writes the window's pixels, or is a draw or clear elsewhere."""
    if isinstance(command, commands.CopyToTexture):
        return command.framebuffer != DEFAULT
    return isinstance(command, (*INDEPENDENT_OF_WINDOW, Draw, Clear))


class PixelValues(NamedTuple):
    """What the window's buffers hold at a pixel: red, green and blue 0-255, window z, stencil."""

    color: tuple[int, int, int]
    z: float
    stencil: int


class Pixel:
    """One pixel of the window: reads and writes its cells, and creates its rows."""

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
        """Write the stored colour, depth in buffer units, and stencil."""
        self.color.cells[self.place], self.depth.cells[self.place], self.stencil.cells[self.place] = values

    def z(self, units: Any) -> float:
        """Return window z of a depth in buffer units."""
        return window_z(units, self.depth)

    def values(self) -> PixelValues:
        """Return colour, window z and stencil."""
        color, depth, stencil = self.read()
        red, green, blue = (int(channel) for channel in color[:3])
        return PixelValues((red, green, blue), self.z(depth), int(stencil))

    def row(
        self, where: tuple[int, str], before: PixelValues, verdict: str, reason: str, **fragment: Any
    ) -> HistoryRow:
        """Return the row of a change that has just been carried out; `fragment` has the row's other fields."""
        after = self.values()
        step, title = where
        return HistoryRow(
            step=step, title=title, stored_z=before.z, verdict=verdict, stencil_before=before.stencil,
            stencil_after=after.stencil, depth_after=after.z, color_after=after.color, reason=reason,
            **(NO_FRAGMENT | fragment),
        )  # fmt: skip


def window_z(units: Any, depth: Image) -> float:
    """Return the window z that glReadPixels returns for a depth in buffer units."""
    return float(depth_as_float(np.array([units], depth.format.dtype), depth.format)[0])


def _clear_row(command: Clear, storage: Storage, pixel: Pixel, where: tuple[int, str]) -> HistoryRow:
    before = pixel.values()
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
    """Yield a row for every triangle of a draw that covers the pixel, and carry out its fragments there."""
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
        before, (_, stored_z, s) = pixel.values(), pixel.read()
        fragment: dict[str, Any] = {
            "draw": draw,
            "object": object_of(command),
            "triangle": int(geometry.source[triangles.ids[t]]),
            "front_facing": front,
            "z": pixel.z(z),
        }
        if front is not None and culled & (CULL_FRONT if front else CULL_BACK):
            yield pixel.row(where, before, CULLED, culled_reason(front, state), **fragment)
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
        z_pair, s_pair = (fragment["z"], before.z), (before.stencil, int(s_after))
        reason = fragment_reason(state, ops, verdict, z_pair, s_pair, alpha, colored)
        yield pixel.row(where, before, VERDICTS[verdict], reason, color_written=written, **fragment)


def _fragments_at(geometry: Geometry, pixel: Pixel) -> Fragments:
    """Return the fragments of all triangles at the pixel, in drawing order."""
    row, column = pixel.place
    triangles = np.empty(len(geometry.triangles.ids), np.int32)
    n = triangles_at(geometry.triangles.corners, column, row, int(pixel.window.flipped), triangles)
    return Fragments(np.full(n, row, np.int32), np.full(n, column, np.int32), triangles[:n].copy())
