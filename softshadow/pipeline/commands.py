"""The commands that a context records: what changed a buffer, a texture or a framebuffer, with all it depends on.

A command never changes after it was made, so the list of them is a recording: applied in order to fresh storage it
gives every buffer again, bit for bit.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

import numpy as np

from softshadow import pipeline
from softshadow.framebuffer import DEFAULT, NOTHING, Attachment, Framebuffer, Storage, plane_for
from softshadow.image import Format, Image
from softshadow.pipeline.buffers import accumulation, blit, mipmaps
from softshadow.pipeline.buffers import copy as transfer
from softshadow.pipeline.fast.specialize import VERDICT_COUNTS
from softshadow.pipeline.raster.fragment_ops import PASSED
from softshadow.programs.inverse import UNKNOWN
from softshadow.state import Scissor, State
from softshadow.texture import Sampler, Texture


class Command(Protocol):
    """Anything that changes storage, and nothing else."""

    def apply(self, storage: Storage) -> None: ...


@dataclass(frozen=True, eq=False)
class Vertices:
    """The vertices of a draw, read-only: position (V, 4), color (V, 4), normal (V, 3), one texcoord (V, 4) per unit.

    `materials` holds what glMaterial changed from vertex to vertex: "front.diffuse" (V, 4), "back.shininess" (V,) ...
    """

    position: np.ndarray
    color: np.ndarray
    normal: np.ndarray
    texcoords: tuple[np.ndarray, ...]
    materials: Mapping[str, np.ndarray] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Draw:
    """Primitives with everything that decides about their pixels.

    `mode` is GL_POINTS ... GL_POLYGON, `indices` (N,) int32 into the vertices, or None for all in order; `label` names
    the debug groups the draw stands in ("step/torus"); `uniforms` are those of the program in use; the kinds of the
    matrices decide how they are inverted. Quads that share a batch with draws of other debug groups have the positions
    (N, 4) of the whole `batch` and the number of their first vertex in it. `linear` says that clipping interpolates
    values without perspective. `offset_mode` is the polygon mode whose offset unfilled polygons get where an earlier
    draw has decided it, else 0.
    """

    state: State
    mode: int
    vertices: Vertices
    indices: np.ndarray | None
    modelview: np.ndarray
    projection: np.ndarray
    texture_matrices: tuple[np.ndarray, ...]
    uniforms: Mapping[str, Any] = field(default_factory=dict)
    program_name: str = ""
    label: str = ""
    offset_slope: str = "max"
    offset_unit: str = "mesa"
    modelview_kind: int = UNKNOWN
    projection_kind: int = UNKNOWN
    batch: np.ndarray | None = None
    batch_start: int = 0
    linear: bool = False
    offset_mode: int = 0

    def apply(self, storage: Storage) -> None:
        if not storage.active_query:
            pipeline.draw(self, storage)
        else:
            verdicts = np.zeros(VERDICT_COUNTS, np.int64)
            pipeline.draw(self, storage, verdicts)
            storage.queries[storage.active_query] += int(verdicts[PASSED])


@dataclass(frozen=True, eq=False)
class Clear:
    """glClear: under scissor, colour mask, depth mask and the front stencil write mask."""

    state: State
    mask: int

    def apply(self, storage: Storage) -> None:
        pipeline.clear(self, storage)


@dataclass(frozen=True, eq=False)
class Accumulate:
    """glAccum, between the colour buffer and the accumulation buffer of the window."""

    state: State
    operation: int
    value: float

    def apply(self, storage: Storage) -> None:
        accumulation.accumulate(self, storage)


@dataclass(frozen=True, eq=False)
class BeginQuery:
    """Count the fragments that pass from here on; `query` 0 ends the counting."""

    query: int

    def apply(self, storage: Storage) -> None:
        storage.active_query = self.query
        if self.query:
            storage.queries[self.query] = 0


@dataclass(frozen=True, eq=False)
class DefineImage:
    """glTexImage2D. `cells` and `stencil` are in the storage's own layout, (height, width[, channels]), None: zeros.

    A framebuffer object that the level is attached to gets the new image.
    """

    texture: int
    face: int
    level: int
    format: Format
    internal_format: int
    width: int
    height: int
    cells: np.ndarray | None = None
    stencil: np.ndarray | None = None

    def apply(self, storage: Storage) -> None:
        image = Image.new(self.format, self.width, self.height, self.internal_format)
        if self.cells is not None:
            image.view[:] = self.cells
        if self.stencil is not None and image.stencil is not None:
            image.stencil.view[:] = self.stencil
        storage.textures[self.texture].images[self.face, self.level] = image
        storage.reattach(self.texture, self.face, self.level, image)


@dataclass(frozen=True, eq=False)
class UpdateImage:
    """glTexSubImage2D. `cells` and `stencil` are in the storage's own layout; None leaves a plane as it is."""

    texture: int
    face: int
    level: int
    x: int
    y: int
    cells: np.ndarray | None
    stencil: np.ndarray | None = None

    def apply(self, storage: Storage) -> None:
        image = storage.textures[self.texture].images[self.face, self.level]
        for plane, cells in ((image, self.cells), (image.stencil, self.stencil)):
            if plane is not None and cells is not None:
                height, width = cells.shape[:2]
                plane.view[self.y : self.y + height, self.x : self.x + width] = cells


@dataclass(frozen=True, eq=False)
class CopyToTexture:
    """glCopyTexSubImage2D from a framebuffer; pixels outside the framebuffer leave their texels untouched."""

    framebuffer: int
    texture: int
    face: int
    level: int
    x_offset: int
    y_offset: int
    x: int
    y: int
    width: int
    height: int

    def apply(self, storage: Storage) -> None:
        transfer.copy_to_texture(self, storage)


@dataclass(frozen=True, eq=False)
class GenerateMipmaps:
    """glGenerateMipmap, or what GL_GENERATE_MIPMAP does to one face: all levels after the base level, to the last.

    The other faces of a cube map get levels of the same sizes, zeros where they had others, as in Mesa.
    """

    texture: int
    faces: tuple[int, ...]
    base: int
    last: int

    def apply(self, storage: Storage) -> None:
        texture = storage.textures[self.texture]
        images = texture.images
        for level in range(self.base + 1, self.last + 1):
            for face in self.faces:
                images[face, level] = mipmaps.next_level(images[face, level - 1])
            model = images[self.faces[0], level]
            for face in texture.faces:
                standing = images.get((face, level))
                if standing is None or not standing.is_laid_out_as(model):
                    images[face, level] = Image.new(model.format, model.width, model.height, model.internal_format)
                storage.reattach(self.texture, face, level, images[face, level])


@dataclass(frozen=True, eq=False)
class BlitFramebuffer:
    """glBlitFramebuffer between framebuffers; rectangles are (x0, y0, x1, y1) in GL's rows."""

    read: int
    draw: int
    source: tuple[int, int, int, int]
    target: tuple[int, int, int, int]
    mask: int
    filter: int
    scissor: Scissor

    def apply(self, storage: Storage) -> None:
        blit.blit(self, storage)


@dataclass(frozen=True, eq=False)
class CreateTexture:
    texture: int
    target: int

    def apply(self, storage: Storage) -> None:
        storage.textures[self.texture] = Texture(self.texture, self.target)


@dataclass(frozen=True, eq=False)
class SetSampler:
    """glTexParameter: texture objects keep their sampler, so it is part of the recording."""

    texture: int
    sampler: Sampler

    def apply(self, storage: Storage) -> None:
        storage.textures[self.texture].sampler = self.sampler


@dataclass(frozen=True, eq=False)
class DeleteTextures:
    textures: tuple[int, ...]

    def apply(self, storage: Storage) -> None:
        for name in self.textures:
            storage.textures.pop(name, None)


@dataclass(frozen=True, eq=False)
class CreateFramebuffer:
    framebuffer: int

    def apply(self, storage: Storage) -> None:
        storage.framebuffers[self.framebuffer] = Framebuffer(self.framebuffer)


@dataclass(frozen=True, eq=False)
class DeleteFramebuffers:
    framebuffers: tuple[int, ...]

    def apply(self, storage: Storage) -> None:
        for name in self.framebuffers:
            if name != DEFAULT:
                storage.framebuffers.pop(name, None)


@dataclass(frozen=True, eq=False)
class DefineRenderbuffer:
    """glRenderbufferStorage (zeros), or with no format the making of the name."""

    renderbuffer: int
    format: Format | None = None
    internal_format: int = 0
    width: int = 0
    height: int = 0

    def apply(self, storage: Storage) -> None:
        image = Image.new(self.format or NOTHING, self.width, self.height, self.internal_format)
        storage.renderbuffers[self.renderbuffer] = image
        for target in storage.framebuffers.values():
            for point, attachment in target.attachments.items():
                if attachment.renderbuffer == self.renderbuffer:
                    target.attachments[point] = replace(attachment, image=plane_for(image, point))


@dataclass(frozen=True, eq=False)
class DeleteRenderbuffers:
    renderbuffers: tuple[int, ...]

    def apply(self, storage: Storage) -> None:
        for name in self.renderbuffers:
            storage.renderbuffers.pop(name, None)


@dataclass(frozen=True, eq=False)
class AttachTexture:
    """glFramebufferTexture2D; texture 0 detaches. The texture's own image becomes the buffer."""

    framebuffer: int
    attachment: int
    texture: int
    face: int = 0
    level: int = 0

    def apply(self, storage: Storage) -> None:
        attachments = storage.framebuffers[self.framebuffer].attachments
        if self.texture == 0:
            attachments.pop(self.attachment, None)
        else:
            images = storage.textures[self.texture].images
            image = images.get((self.face, self.level)) or Image.new(NOTHING, 0, 0)
            plane = plane_for(image, self.attachment)
            attachments[self.attachment] = Attachment(plane, self.texture, self.face, self.level)


@dataclass(frozen=True, eq=False)
class AttachRenderbuffer:
    """glFramebufferRenderbuffer; renderbuffer 0 detaches."""

    framebuffer: int
    attachment: int
    renderbuffer: int

    def apply(self, storage: Storage) -> None:
        attachments = storage.framebuffers[self.framebuffer].attachments
        if self.renderbuffer == 0:
            attachments.pop(self.attachment, None)
        else:
            plane = plane_for(storage.renderbuffers[self.renderbuffer], self.attachment)
            attachments[self.attachment] = Attachment(plane, renderbuffer=self.renderbuffer)


@dataclass(frozen=True, eq=False)
class SelectBuffers:
    """glDrawBuffer, glDrawBuffers and glReadBuffer: they belong to the framebuffer object. None leaves it as it is."""

    framebuffer: int
    draw_buffers: tuple[int, ...] | None = None
    read_buffer: int | None = None

    def apply(self, storage: Storage) -> None:
        target = storage.framebuffers[self.framebuffer]
        if self.draw_buffers is not None:
            target.draw_buffers = self.draw_buffers
        if self.read_buffer is not None:
            target.read_buffer = self.read_buffer
