"""One pixel followed through the events of a timeline: the rows of its history."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Attachment, Framebuffer
from softshadow.image import Image
from softshadow.inspection.clipped import cut_away_at
from softshadow.inspection.history_row import CLEARED, CLIPPED, CULLED, WRITTEN, HistoryRow
from softshadow.inspection.map_lookups import FACES, MapLookup, map_lookups, texels_read
from softshadow.inspection.one_pixel import Cells, Fragment, OnePixel, shown_color
from softshadow.inspection.reasons import clear_reason, culled_reason, cut_reason, fragment_reason, outside
from softshadow.inspection.row_fields import lights_of, origin_fields, source_color
from softshadow.inspection.step import object_of
from softshadow.inspection.timeline import Event, Timeline
from softshadow.pipeline.commands import Clear, Command, CopyToTexture, Draw, DrawDepths
from softshadow.pipeline.records import SCISSORED, VERDICTS
from softshadow.texture import Texture

NO_FRAGMENT = {"draw": None, "object": "", "triangle": None, "front_facing": None, "z": None}
DECIDED = ("passed", "alpha failed")  # the verdicts of fragments whose lookups matter


def images_of(event: Event) -> list[Image]:
    """Return the images that an event may change."""
    if event.target is not None:
        return images_in(event.target)
    return [each.image for each in event.written]


def images_in(target: Framebuffer) -> list[Image]:
    """Return the images of a framebuffer."""
    return [each.image for each in target.attachments.values()]


def writes(event: Event, image: Image) -> bool:
    """Return whether an event may change an image."""
    return any(each is image for each in images_of(event))


def needed_images(events: Sequence[Event], shown: Collection[int]) -> set[int]:
    """Return the identities of images and of all that are drawn to together with them."""
    wanted = set(shown)
    for event in reversed(events):
        images = {id(image) for image in images_of(event)}
        if event.target is not None and images & wanted:
            wanted |= images
    return wanted


@dataclass(frozen=True, eq=False)
class Follower:
    """Follows one pixel through the events of a timeline; `lights` are names of GL_LIGHT0, GL_LIGHT1 ..."""

    timeline: Timeline
    row: int
    column: int
    lights: tuple[str, ...]

    def rows(
        self, of: Collection[Image], before: int | None = None, framebuffer: int | None = None
    ) -> Iterator[HistoryRow]:
        """Yield the rows of all events that may change the pixel of some images.

        Parameters
        ----------
        before : int                 the number of commands that count; all by default
        framebuffer : int            leave out draws and clears through any other framebuffer
        """
        events = [event for event in self.timeline.events if before is None or event.index < before]
        shown = {id(image) for image in of}
        wanted = needed_images(events, shown)
        pixel = OnePixel(self.timeline, self.row, self.column)
        for event in events:
            images = {id(image) for image in images_of(event)}
            if not images & wanted or not self._is_in(event):
                continue
            if event.target is None:
                yield from self._written_rows(event, pixel, wanted, bool(images & shown))
                continue
            rows = self._draw_rows if isinstance(event.command, Draw) else self._clear_rows
            is_shown = images & shown and framebuffer in (None, event.target.name)
            yield from (row for row in rows(event, pixel) if is_shown)

    def _is_in(self, event: Event) -> bool:
        """Return whether what an event may change has this pixel."""
        width, height = (
            event.target.size if event.target else (event.written[0].image.width, event.written[0].image.height)
        )
        return self.row < height and self.column < width

    # -- rows of one event ---------------------------------------------------------------------------------------------
    def _row(self, event: Event, target: Framebuffer, before: Cells, after: Cells, **fields: Any) -> HistoryRow:
        values = NO_FRAGMENT | {
            "step": event.step,
            "title": event.title,
            "framebuffer": target.name,
            "stored_z": before.z,
            "stencil_before": before.stencil or 0,
            "stencil_after": after.stencil or 0,
            "depth_after": after.z,
            "color_before": before.color or (),
            "color_after": after.color or (),
        }
        return HistoryRow(**(values | fields))

    def _written_rows(self, event: Event, pixel: OnePixel, wanted: set[int], is_shown: bool) -> Iterator[HistoryRow]:
        """Yield the row of a copy or a blit, if it has changed the pixel."""
        written = [each for each in event.written if id(each.image) in wanted]
        if is_shown and isinstance(event.command, CopyToTexture):
            yield from self._copied_rows(event, event.command)
        target = self.timeline.window if _is_of(written[0].image, self.timeline.window) else _only(written[0].image)
        before = pixel.cells(target)
        for each in written:
            pixel.write(each.image, each.at(self.row, self.column))
        after = pixel.cells(target)
        if is_shown and after != before:
            yield self._row(event, target, before, after, verdict=WRITTEN, reason=reason_of(event.command))

    def _copied_rows(self, event: Event, command: CopyToTexture) -> Iterator[HistoryRow]:
        """Yield the rows of the pixel that a texel was copied from, since its last clear."""
        column, up = self.column - command.x_offset, self.row - command.y_offset
        if not (0 <= column < command.width and 0 <= up < command.height):
            return
        drawn = [each.target for each in self.timeline.events if each.target and each.index < event.index]
        target = next((each for each in reversed(drawn) if each.name == command.framebuffer), self.timeline.window)
        height = target.size[1]
        row = height - 1 - (command.y + up) if target.flipped else command.y + up
        source = Follower(self.timeline, row, command.x + column, self.lights)
        rows = list(source.rows(images_in(target), event.index, command.framebuffer))
        last_clear = max((n for n, each in enumerate(rows) if each.verdict == CLEARED), default=0)
        yield from rows[last_clear:]

    def _clear_rows(self, event: Event, pixel: OnePixel) -> Iterator[HistoryRow]:
        command, target = event.command, event.target
        assert isinstance(command, Clear)
        assert target is not None
        before = pixel.cells(target)
        if not pixel.inside(event):
            reason = f"glClear: {outside(command.state.scissor)}"
            yield self._row(event, target, before, before, verdict=VERDICTS[SCISSORED], reason=reason)
            return
        pixel.clear(event)
        reason = clear_reason(command, target)
        yield self._row(event, target, before, pixel.cells(target), verdict=CLEARED, reason=reason)

    def _draw_rows(self, event: Event, pixel: OnePixel) -> Iterator[HistoryRow]:
        """Yield a row for every triangle of a draw that meets the line of sight."""
        command, target = event.command, event.target
        assert isinstance(command, Draw)
        assert target is not None
        state = command.state
        common = {"draw": event.draw, "object": object_of(command), "lights": lights_of(state, self.lights)}
        cut = self.timeline.cut_triangles(event)
        away = [] if cut is None else cut_away_at(cut, state.viewport, target, self.row, self.column)
        before = pixel.cells(target)

        def cut_rows(until: float) -> Iterator[HistoryRow]:
            while away and away[0].triangle < until:
                triangle, plane = away.pop(0)
                fields = common | origin_fields(command, triangle) | {"triangle": triangle}
                yield self._row(event, target, before, before, verdict=CLIPPED, reason=cut_reason(plane), **fields)

        for fragment in pixel.draw(event):
            yield from cut_rows(fragment.triangle)
            after = pixel.cells(target)
            fields = common | origin_fields(command, fragment.triangle)
            fields |= self._fragment_fields(event, fragment, before, after)
            yield self._row(event, target, before, after, **fields)
            before = after
        yield from cut_rows(np.inf)

    def _fragment_fields(self, event: Event, fragment: Fragment, before: Cells, after: Cells) -> dict[str, Any]:
        command, target = event.command, event.target
        assert isinstance(command, Draw)
        assert target is not None
        state = command.state
        fields: dict[str, Any] = {
            "triangle": fragment.triangle,
            "front_facing": fragment.front_facing,
            "z": fragment.z,
            "z_before_offset": fragment.z_before_offset,
        }
        if fragment.verdict is None:
            return fields | {"verdict": CULLED, "reason": culled_reason(bool(fragment.front_facing), state)}
        colored = bool(target.colors) and any(state.color.mask)
        z_pair = (fragment.z, fragment.z if before.z is None else before.z)
        stencils = (before.stencil or 0, after.stencil or 0)
        reason = fragment_reason(
            state, fragment.ops, fragment.verdict, z_pair, stencils, fragment.compared_alpha, colored
        )
        return fields | {
            "verdict": VERDICTS[fragment.verdict],
            "reason": reason,
            "alpha": None if fragment.color is None else float(fragment.color[0, 3]),
            "color_source": source_color(fragment, shown_color(target)) if fragment.writes_color else None,
            "color_written": fragment.writes_color,
            "lookups": self._lookups(event, fragment),
        }

    # -- lookups -------------------------------------------------------------------------------------------------------
    def _lookups(self, event: Event, fragment: Fragment) -> tuple[MapLookup, ...]:
        """Return the depths that a fragment looked up, or those behind the result that it looked up."""
        if not fragment.reads or VERDICTS[fragment.verdict or 0] not in DECIDED:
            return ()
        command = event.command
        assert isinstance(command, Draw)
        names = lights_of(command.state, self.lights) or self.lights
        light = names[0] if len(names) == 1 else ""
        visible = None
        if fragment.color is not None and "visibility" in command.program_name:  # these programs return it as alpha
            visible = float(fragment.color[0, 3])
        own = map_lookups(fragment.reads, fragment.place, visible, light)
        textures = {read.texture.name: read.texture for read in fragment.reads}
        if own:
            return tuple(self._with_caster(each, textures[each.texture], event.index) for each in own)
        return tuple(replace(each, light=light or each.light) for each in self._lookups_behind(event, fragment))

    def _with_caster(self, lookup: MapLookup, texture: Texture, before: int) -> MapLookup:
        """Return a lookup with the caster that was drawn into the texel which decides it."""
        tap = lookup.deciding_tap
        image = texture.base(FACES.index(tap.face) if tap.face else 0)
        stands_for = None if image is None else self.timeline.stand_in(image)
        if stands_for is None or not tap.inside:
            return lookup
        if stands_for.format.kind != "depth" and lookup.measure != "distance":  # a mean has no single caster
            return lookup
        row = self._row_left(stands_for, tap.gl_y, tap.x, before)
        return lookup if row is None else replace(lookup, caster=row.caster or row.object, caster_triangle=row.triangle)

    def _lookups_behind(self, event: Event, fragment: Fragment) -> tuple[MapLookup, ...]:
        """Return the lookups of the fragments that left the texels which a fragment has read."""
        for read in fragment.reads:
            texels = texels_read(read.texture, read.coordinates[fragment.place])
            if not texels:
                continue
            texel = max(texels, key=lambda each: each.weight)
            image = self.timeline.stand_in(texel.image)
            lookups = () if image is None else self._lookups_left(image, texel.row, texel.column, event.index)
            if lookups:
                return lookups
        return ()

    def _lookups_left(self, image: Image, row: int, column: int, before: int) -> tuple[MapLookup, ...]:
        """Return the lookups of the fragment that has left a texel as it is before a command."""
        left = self._row_left(image, row, column, before)
        return () if left is None else left.lookups

    def _row_left(self, image: Image, row: int, column: int, before: int) -> HistoryRow | None:
        """Return the row of the fragment that has left a texel as it is before a command; None after a clear."""
        writers = [each.index for each in self.timeline.events if each.index < before and writes(each, image)]
        key = id(image), row, column, max(writers, default=-1)
        if writers and key not in self.timeline.left:
            self.timeline.left[key] = None  # a draw may read what it writes to
            follower = Follower(self.timeline, row, column, self.lights)
            for each in follower.rows([image], key[-1] + 1):
                if each.verdict in ("passed", CLEARED):
                    self.timeline.left[key] = each if each.verdict == "passed" else None
        return self.timeline.left.get(key)


def _is_of(image: Image, target: Framebuffer) -> bool:
    return any(each.image is image for each in target.attachments.values())


def _only(image: Image) -> Framebuffer:
    """Return a framebuffer that has only this image."""
    kinds = {"depth": gl.GL_DEPTH_ATTACHMENT, "stencil": gl.GL_STENCIL_ATTACHMENT}
    return Framebuffer(-1, {kinds.get(image.format.kind, gl.GL_COLOR_ATTACHMENT0): Attachment(image)})


def reason_of(command: Command) -> str:
    """Return what wrote a pixel without fragments of its own: the call of a rectangle, or the name of the command."""
    if isinstance(command, DrawDepths):
        kinds = [
            kind for kind, drawn in (("depths", command.has_depth), ("stencil values", command.has_stencil)) if drawn
        ]
        return f"glDrawPixels or glCopyPixels of {' and '.join(kinds)}"
    return type(command).__name__
