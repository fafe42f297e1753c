"""One pixel of a framebuffer: its cells alone, and draws and clears carried out on nothing else.

The functions are those that draw the picture, so the cells end as the pixel of the buffers.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from softshadow import pipeline
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.image import Image
from softshadow.inspection.timeline import Event, Timeline
from softshadow.pipeline.buffers.clear import clear
from softshadow.pipeline.commands import Clear, Draw
from softshadow.pipeline.geometry.facing import CULL_BACK, CULL_FRONT, culling
from softshadow.pipeline.plan import tests_alpha
from softshadow.pipeline.raster.coverage import triangles_at
from softshadow.pipeline.raster.fragment_ops import FragmentOps, fragment_ops, process_fragment
from softshadow.pipeline.raster.ordered import fragment_depth
from softshadow.pipeline.raster.region import depth_range_of, region_of
from softshadow.pipeline.records import PASSED, Fragments, Geometry
from softshadow.pipeline.shade.blend import compared_alpha
from softshadow.pipeline.shade.color_writes import color_writer
from softshadow.pipeline.shade.discards import without_discarded
from softshadow.pipeline.shade.pixel_blocks import in_blocks
from softshadow.pipeline.shade.visible_spans import spans_of
from softshadow.pixels import depth_as_float
from softshadow.programs.reads import Read, noted_reads
from softshadow.state import Scissor, State

CELL = Fragments(*(np.zeros(1, np.int32) for _ in range(3)))  # the one fragment in the one cell
STORED = 2  # columns of the images of cells: a scissor box can then leave one out


class Cells(NamedTuple):
    """What a pixel holds: red, green and blue, window z, stencil value; None for a buffer that there is not."""

    color: tuple[float, ...] | None
    z: float | None
    stencil: int | None


@dataclass
class Fragment:
    """A fragment at the pixel, and what the tests made of it.

    `z` is window z, `units_z` the same in units of the depth buffer. `verdict` is an index of `VERDICTS`, or None for a
    culled triangle. `color` (1, 4) is known where the fragment was shaded; `reads` are the textures it looked up, and
    `place` is its number among the fragments that were shaded with it.
    """

    triangle: int
    front_facing: bool | None
    units_z: Any
    z: float
    z_before_offset: float | None
    ops: FragmentOps
    verdict: int | None = None
    writes_color: bool = False
    compared_alpha: int = 0
    color: np.ndarray | None = None
    reads: list[Read] = field(default_factory=list)
    place: int = 0


class OnePixel:
    """The cells of one pixel in all images that it needs, while the events of a timeline go by."""

    def __init__(self, timeline: Timeline, row: int, column: int) -> None:
        self.timeline, self.row, self.column = timeline, row, column
        self._images: dict[int, Image] = {}

    def image(self, image: Image) -> Image:
        """Return the image of one cell that stands for an image."""
        if id(image) not in self._images:
            cell = Image.new(image.format, STORED, 1, image.internal_format)
            self._images[id(image)] = cell
            if id(image) in self.timeline.before:
                self.write(image, self.timeline.before[id(image)].at(self.row, self.column))
        return self._images[id(image)]

    def write(self, image: Image, value: Any) -> None:
        """Write a cell as it is stored."""
        self.image(image).cells[0, 0] = value

    def target(self, target: Framebuffer) -> Framebuffer:
        """Return the framebuffer that has the cells instead of the images."""
        attachments = {point: replace(each, image=self.image(each.image)) for point, each in target.attachments.items()}
        return replace(target, attachments=attachments)

    def cells(self, target: Framebuffer) -> Cells:
        """Return what the pixel of a framebuffer holds."""
        buffers = shown_color(target), target.depth, target.stencil
        color, depth, stencil = (None if image is None else self.image(image) for image in buffers)
        return Cells(
            None if color is None else color_values(color),
            None if depth is None else window_z(depth.read_cells[0, 0], depth),
            None if stencil is None else int(stencil.read_cells[0, 0]),
        )

    # -- clears and draws ----------------------------------------------------------------------------------------------
    def inside(self, event: Event) -> bool:
        """Return whether the pixel is inside the scissor box of a draw or a clear."""
        assert isinstance(event.command, Draw | Clear)
        assert event.target is not None
        region = region_of(event.command.state, event.target)
        return region.first_row <= self.row < region.end_row and region.left <= self.column < region.right

    def clear(self, event: Event) -> None:
        """Carry out a clear that the scissor box does not keep away."""
        command, target = event.command, event.target
        assert isinstance(command, Clear)
        assert target is not None
        box, (width, height) = command.state.scissor, target.size
        limits = box.x > 0 or box.y > 0 or box.x + box.width < width or box.y + box.height < height
        scissor = Scissor(box.enabled and limits, 0, 0, 1, 1)  # a box that limits a clear changes how it rounds depths
        state = replace(command.state, scissor=scissor)
        clear(replace(command, state=state), Storage({target.name: self.target(target)}))

    def draw(self, event: Event) -> Iterator[Fragment]:
        """Carry out a draw, and yield its fragments at the pixel, each when the cells hold what it has left there.

        Those of culled triangles are among them.
        """
        command, target = event.command, event.target
        assert isinstance(command, Draw)
        assert target is not None
        geometry = self.timeline.geometry(event)
        fragments = self._fragments_of(geometry, region_of(command.state, target).downwards)
        if not len(fragments.row):
            return
        cells, state = self.target(target), command.state
        culled, _ = culling(state.cull)
        writes_color = bool(cells.colors) and any(state.color.mask)
        shades = writes_color or tests_alpha(state)
        inside = self.inside(event)
        for n in range(len(fragments.row)):
            one = Fragments(*(part[n : n + 1] for part in fragments))
            t = int(one.triangle[0])
            front = geometry.facing(t)
            is_culled = front is not None and bool(culled & (CULL_FRONT if front else CULL_BACK))
            fragment = self._fragment(geometry, t, command.state, cells, front)
            if not is_culled:
                if shades:
                    shade(fragment, geometry, one)
                process(fragment, command.state, cells, inside, writes_color)
            yield fragment

    def _fragments_of(self, geometry: Geometry, downwards: int) -> Fragments:
        triangles = np.empty(len(geometry.triangles.ids), np.int32)
        n = triangles_at(geometry.triangles.corners, self.column, self.row, downwards, triangles)
        every = Fragments(np.full(n, self.row, np.int32), np.full(n, self.column, np.int32), triangles[:n].copy())
        return without_discarded(geometry, every)

    def _fragment(self, geometry: Geometry, t: int, state: State, cells: Framebuffer, front: bool | None) -> Fragment:
        triangles = geometry.triangles
        real = triangles.depth.dtype.type
        ops = fragment_ops(state, cells.depth, cells.stencil, bool(triangles.front[t]))
        where = real(self.row), real(self.column), depth_range_of(state, real), ops.depth_largest
        z, unshifted = real(fragment_depth(triangles.depth, t, *where)), None
        if triangles.depth[t, 3]:
            plane = triangles.depth[t : t + 1].copy()
            plane[0, 3] = 0
            unshifted = window_z(real(fragment_depth(plane, 0, *where)), cells.depth)
        source = int(geometry.source[triangles.ids[t]])
        return Fragment(source, front, z, window_z(z, cells.depth), unshifted, ops)


def shade(fragment: Fragment, geometry: Geometry, one: Fragments) -> None:
    """Shade a fragment, and note its texture reads."""
    with np.errstate(all="ignore"), noted_reads() as reads:
        fragment.color = pipeline.shade(geometry, spans_of(one)).copy()
    fragment.reads = reads
    if geometry.program.blocks:
        _, places = in_blocks(one)
        fragment.place = int(places[0])


def process(fragment: Fragment, state: State, cells: Framebuffer, inside: bool, writes_color: bool) -> None:
    """Test a fragment, and write what it leaves in the cells."""
    depth, stencil = cells.depth, cells.stencil
    if fragment.color is not None:
        alphas, reference = compared_alpha(state, cells.color, fragment.color[:, 3])
        fragment.ops, fragment.compared_alpha = fragment.ops._replace(alpha_ref=reference), int(alphas[0])
    stored_z = fragment.units_z if depth is None else depth.cells[0, 0]
    s = np.uint8(0) if stencil is None else stencil.cells[0, 0]
    verdict, s_after, z_after = process_fragment(
        fragment.ops, inside, fragment.compared_alpha, fragment.units_z, stored_z, s
    )
    fragment.verdict, fragment.writes_color = int(verdict), bool(verdict == PASSED and writes_color)
    if stencil is not None:
        stencil.cells[0, 0] = s_after
    if depth is not None and fragment.ops.depth_write:
        depth.cells[0, 0] = z_after
    if fragment.writes_color:
        assert fragment.color is not None
        for image in cells.colors:
            color_writer(state, image)(spans_of(CELL), fragment.color)


def shown_color(target: Framebuffer) -> Image | None:
    """Return the first colour buffer that draws write to, or if there is none, the first that there is."""
    return target.color or target.first_color


def color_values(image: Image) -> tuple[float, ...]:
    """Return red, green and blue: 0 to 255 of a buffer of bytes, else as stored."""
    cell = image.read_cells[0, 0].reshape(-1)[:3]
    return tuple(int(c) if image.format.kind == "unorm8" else float(c) for c in cell)


def window_z(units: Any, depth: Image | None) -> float:
    """Return the window z that glReadPixels returns for a depth in buffer units."""
    if depth is None:
        return float(units)
    return float(depth_as_float(np.array([units], depth.format.dtype), depth.format)[0])
