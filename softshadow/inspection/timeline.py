"""A recorded frame prepared for questions about single pixels: what each command drew to, and with which textures.

The frame is replayed once. After that, a pixel of any framebuffer can be followed through all draws and clears without
drawing anything else: the triangles of each draw are known, and so are the textures it read, as they were then.
"""

from __future__ import annotations

from bisect import bisect_right
from collections import OrderedDict
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Frame
from softshadow.framebuffer import DEFAULT, Framebuffer, Storage
from softshadow.image import Image
from softshadow.inspection.clipped import CutTriangles, cut_triangles
from softshadow.pipeline import commands
from softshadow.pipeline.commands import Clear, Command, Draw
from softshadow.pipeline.execute import execute
from softshadow.pipeline.geometry.geometry import process_geometry
from softshadow.pipeline.records import Geometry
from softshadow.texture import Texture, stored_name

GEOMETRY_BYTES = 256 << 20  # of cached triangles; those of other draws are computed when needed


@dataclass(frozen=True, eq=False)
class Written:
    """The cells of an image at some moment: all of them, or one value where all are equal."""

    image: Image
    cells: np.ndarray
    is_constant: bool

    def at(self, row: int, column: int) -> np.ndarray:
        """Return one cell."""
        cell: np.ndarray = self.cells if self.is_constant else self.cells[row, column]
        return cell


@dataclass(frozen=True, eq=False)
class Event:
    """A command that changes pixels or texels.

    `step` and `title` are those of its step; `draw` is the number of draws before it. Draws and clears have a `target`,
    and draws the `textures` that they may sample. The others have `written`: the images as the command left them. The
    images of targets and of `written` stand for those of the replay: they have no cells.
    """

    index: int
    step: int
    title: str
    draw: int
    command: Command
    target: Framebuffer | None = None
    textures: dict[int, Texture] = field(default_factory=dict)
    written: tuple[Written, ...] = ()


class Timeline:
    """The events of a frame, in order.

    Attributes
    ----------
    events : list of Event
    before : dict              what an image held before its first event, by the identity of the image
    images : list              for each step, the images of all textures at its end, by (texture, face, level)
    left : dict                rows found so far that have left a texel, by image, row, column and last event
    """

    def __init__(self, frame: Frame) -> None:
        self.frame = frame
        self.events: list[Event] = []
        self.before: dict[int, Written] = {}
        self.images: list[dict[tuple[int, int, int], Image]] = []
        self._stand_ins: WeakKeyDictionary[Image, Image] = WeakKeyDictionary()
        self._readers: dict[int, list[tuple[dict[tuple[int, int], Image], tuple[int, int]]]] = {}
        self.left: dict[tuple[int, int, int, int], Any] = {}
        self._cut: dict[int, CutTriangles | None] = {}
        self._geometry: OrderedDict[int, tuple[Geometry, int]] = OrderedDict()
        self._size = size_of(frame)
        self._storage = frame.fresh_storage()
        drawn_to = commands.AttachTexture | commands.CopyToTexture
        self._followed = {command.texture for command in frame.commands if isinstance(command, drawn_to)}
        self.window = self._target(self._storage.window)
        self._replay()

    # -- the replay ----------------------------------------------------------------------------------------------------
    def _replay(self) -> None:
        frame, ends, draws = self.frame, [end for _, end in self.frame.steps], 0
        for index, command in enumerate(frame.commands):
            step = bisect_right(ends, index)
            while len(self.images) < step:
                self.images.append(self._images_now())
            title = frame.steps[step][0] if step < len(ends) else ""
            self._carry_out(Event(index, step, title, draws, command))
            draws += isinstance(command, Draw)
        self.images += [self._images_now()] * (len(ends) - len(self.images))
        self._storage = Storage({})  # what nobody refers to can go
        self._readers.clear()

    def _images_now(self) -> dict[tuple[int, int, int], Image]:
        textures = self._storage.textures
        return {
            (name, *place): self._stand_in(image)
            for name, texture in textures.items()
            for place, image in texture.images.items()
        }

    def _carry_out(self, event: Event) -> None:
        command, storage = event.command, self._storage
        if isinstance(command, Draw | Clear):
            target = storage.framebuffers[command.state.draw_framebuffer]
            for image in [each.image for each in target.attachments.values()]:
                self._keep_for_readers(image)
                self._note_before(image)
            textures = self._textures_of(command) if isinstance(command, Draw) else {}
            self.events.append(replace(event, target=self._target(target), textures=textures))
            execute(command, storage)
            return
        is_target = getattr(command, "texture", None) in (None, *self._followed)
        for image in changed_images(command, storage):
            self._keep_for_readers(image)
            if is_target:
                self._note_before(image)
        execute(command, storage)
        if is_target:
            written = tuple(self._written(image) for image in changed_images(command, storage))
            self.events += [replace(event, written=written)] if written else []

    def _note_before(self, image: Image) -> None:
        if id(self._stand_in(image)) not in self.before:
            self.before[id(self._stand_in(image))] = self._written(image)

    def _textures_of(self, command: Draw) -> dict[int, Texture]:
        """Return the textures that a draw may sample. Their images are copied before anything changes them."""
        units = command.state.units
        if not command.program_name:
            units = tuple(unit for unit in units if unit.targets)
        textures = {}
        for unit in units:
            for target in unit.sampled_targets:
                key = stored_name(target, unit.bound(target))
                texture = self._storage.textures.get(key)
                if texture is not None and texture.images and key not in textures:
                    images = dict(texture.images)
                    textures[key] = Texture(texture.name, texture.target, texture.sampler, images)
                    for place, image in images.items():
                        self._readers.setdefault(id(image), []).append((images, place))
        return textures

    def _keep_for_readers(self, image: Image) -> None:
        """Copy an image that is about to change for the draws that have read it."""
        readers = self._readers.pop(id(image), None)
        if readers:
            copy = image.copy()
            self._stand_ins[copy] = self._stand_in(image)
            for images, place in readers:
                images[place] = copy

    def _written(self, image: Image) -> Written:
        cells = image.read_cells[:, : image.width]
        is_constant = cells.size > 0 and bool((cells == cells[:1, :1]).all())
        return Written(self._stand_in(image), cells[0, 0].copy() if is_constant else cells.copy(), is_constant)

    def _stand_in(self, image: Image) -> Image:
        if image not in self._stand_ins:
            no_cells = np.empty((0, 0), image.format.dtype)
            stencil = self._stand_in(image.stencil) if image.stencil is not None else None
            self._stand_ins[image] = Image(
                image.format, image.width, image.height, no_cells, image.internal_format, stencil, slices=image.slices
            )
        return self._stand_ins[image]

    def _target(self, target: Framebuffer) -> Framebuffer:
        attachments = {
            point: replace(each, image=self._stand_in(each.image)) for point, each in target.attachments.items()
        }
        return replace(target, attachments=attachments, accumulation=None)

    # -- questions -----------------------------------------------------------------------------------------------------
    def stand_in(self, image: Image) -> Image | None:
        """Return what stands for an image of a texture that a draw has read; None for one that was never drawn to."""
        return self._stand_ins.get(image)

    def cut_triangles(self, event: Event) -> CutTriangles | None:
        """Return the triangles of a draw that clipping may have cut away; None if there are none."""
        if event.index not in self._cut:
            assert isinstance(event.command, Draw)
            assert event.target is not None
            self._cut[event.index] = cut_triangles(event.command, event.target)
        return self._cut[event.index]

    def geometry(self, event: Event) -> Geometry:
        """Return the triangles of a draw, culled ones too."""
        if event.index in self._geometry:
            self._geometry.move_to_end(event.index)
            return self._geometry[event.index][0]
        command, target = event.command, event.target
        assert isinstance(command, Draw)
        assert target is not None
        storage = Storage({target.name: target}, event.textures)
        with np.errstate(all="ignore"):  # as in pipeline.draw
            geometry = process_geometry(command, target, storage, replace(command.state.cull, enabled=False))
        arrays = [geometry.window, geometry.values, geometry.source, geometry.provoking, *geometry.triangles]
        size = sum(array.nbytes for array in arrays)
        if size <= GEOMETRY_BYTES // 4:
            self._geometry[event.index] = own_copy(geometry), size
            while sum(size for _, size in self._geometry.values()) > GEOMETRY_BYTES:
                self._geometry.popitem(last=False)
        return geometry

    @property
    def is_current(self) -> bool:
        """Whether the frame is still as it was when it was replayed."""
        return self._size == size_of(self.frame)


def timeline_of(frame: Frame) -> Timeline:
    """Return the timeline of a frame; it is kept with the frame."""
    timeline = frame.answers.get("timeline")
    if not isinstance(timeline, Timeline) or not timeline.is_current:
        timeline = frame.answers["timeline"] = Timeline(frame)
    return timeline


def size_of(frame: Frame) -> tuple[int, int, int]:
    """Return how many commands and steps a frame has, and how many commands it has dropped."""
    return len(frame.commands), len(frame.steps), frame.dropped


def own_copy(geometry: Geometry) -> Geometry:
    """Return a geometry whose arrays are its own: those of a draw lie in scratch memory."""
    back = None if geometry.back is None else geometry.back.copy()
    faces = None if geometry.faces is None else geometry.faces.copy()
    return geometry._replace(
        triangles=type(geometry.triangles)(*(array.copy() for array in geometry.triangles)),
        window=geometry.window.copy(),
        values=geometry.values.copy(),
        back=back,
        source=geometry.source.copy(),
        provoking=geometry.provoking.copy(),
        faces=faces,
    )


def changed_images(command: Command, storage: Storage) -> Iterable[Image]:
    """Return the images that a command other than a draw or a clear writes to, as far as they exist."""
    if isinstance(command, commands.Accumulate):
        return storage.framebuffers[DEFAULT].colors if command.operation == gl.GL_RETURN else ()
    if isinstance(command, commands.DrawDepths):
        return [each.image for each in storage.framebuffers[command.draw.state.draw_framebuffer].attachments.values()]
    if isinstance(command, commands.BlitFramebuffer):
        return [each.image for each in storage.framebuffers[command.draw].attachments.values()]
    if isinstance(command, commands.DefineImage | commands.UpdateImage | commands.CopyToTexture):
        image = storage.textures[command.texture].images.get((command.face, command.level))
        return [each for each in (image, image.stencil if image else None) if each is not None]
    if isinstance(command, commands.GenerateMipmaps):
        return list(storage.textures[command.texture].images.values())
    return ()
