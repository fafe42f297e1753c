"""The commands that a context records: changes of buffers, textures and framebuffers, with all that they depend on.

Commands are data: `softshadow.pipeline.execute` carries them out. A command never changes after its creation, so a list
of commands is a recording: executed in order on fresh storage, it gives every buffer again, bit for bit.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import repeat
from typing import Any, NamedTuple, TypeVar

import numpy as np

from softshadow import tokens
from softshadow.image import Format
from softshadow.pixel_transfer import PixelTransfer
from softshadow.programs.inverse import UNKNOWN
from softshadow.state import Scissor, State
from softshadow.texture import Sampler
from softshadow.tokens import token_name

Value = TypeVar("Value")
PRIMITIVES = ("GL_POINTS", "GL_LINES", "GL_LINE_LOOP", "GL_LINE_STRIP", "GL_TRIANGLES", "GL_TRIANGLE_STRIP",
              "GL_TRIANGLE_FAN", "GL_QUADS", "GL_QUAD_STRIP", "GL_POLYGON")  # fmt: skip
NO_MATERIALS: Mapping[str, np.ndarray] = {}
NO_UNIFORMS: Mapping[str, Any] = {}
CLEAR_BITS = ("GL_COLOR_BUFFER_BIT", "GL_DEPTH_BUFFER_BIT", "GL_STENCIL_BUFFER_BIT", "GL_ACCUM_BUFFER_BIT")


def _compared_by_identity(kind: type[Value]) -> type[Value]:
    """Let a tuple of arrays be equal only to itself, as all commands are (decorator).

    Draws and their vertices are tuples because a program makes thousands in each frame: a dataclass takes twice the
    time, and twice the objects that garbage collection looks through.
    """
    compared: Any = kind
    compared.__eq__, compared.__ne__, compared.__hash__ = object.__eq__, object.__ne__, object.__hash__
    return kind


@_compared_by_identity
class Vertices(NamedTuple):
    """The vertices of a draw, read-only: position (V, 4), color (V, 4), normal (V, 3), one texcoord (V, 4) per unit.

    `materials` holds what glMaterial changed between vertices: "front.diffuse" (V, 4), "back.shininess" (V,) ...
    `edges` (V,) bool are the edge flags; None: all true. `secondary` (V, 4) are the secondary colours, None: all black;
    `fog_coordinates` (V,), None: all 0.
    """

    position: np.ndarray
    color: np.ndarray
    normal: np.ndarray
    texcoords: tuple[np.ndarray, ...]
    materials: Mapping[str, np.ndarray] = NO_MATERIALS
    edges: np.ndarray | None = None
    secondary: np.ndarray | None = None
    fog_coordinates: np.ndarray | None = None


@dataclass(frozen=True, eq=False)
class Origin:
    """What the primitives of a draw were made from, as its caller has described them; it changes no pixel.

    `part` says what they are ("volume side", "near cap", "flattened face" ...); `feature` is "face" or "edge", and
    `numbers` (P,) int32 has the number of this face or edge of a mesh for each primitive, None if these are the numbers
    of the primitives. `casters` are the names of the objects that the meshes belong to, and `owners` (P,) int32 the
    place in them for each primitive, None for the first.
    """

    part: str
    feature: str = ""
    numbers: np.ndarray | None = None
    casters: tuple[str, ...] = ()
    owners: np.ndarray | None = None


@_compared_by_identity
class Draw(NamedTuple):
    """Primitives, with everything that determines their pixels.

    `mode` is GL_POINTS ... GL_POLYGON, `indices` (N,) int32 into the vertices, or None for all in order; `label` names
    the debug groups the draw stands in ("step/torus"); `uniforms` are those of the program in use; the kinds of the
    matrices decide how they are inverted. Material colours that follow glColor are those of the vertices; in `state`
    they may be older. Where Mesa joins draws of several debug groups into one, `joined_positions`
    (N, 4) are those of all of them and `joined_start` is the number of this draw's first vertex among them. `linear`:
    clipping interpolates values without perspective. `offset_mode` is the polygon mode whose offset unfilled
    polygons get if an earlier draw has decided it, else 0. `stipple_place` is the place in the line stipple before the
    draw: Mesa does not begin it anew where the first line of a strip is clipped away. `origin` tells what the
    primitives were made from. Where several strips, fans, loops or polygons are drawn as separate triangles or lines,
    `pairs_mode` is the mode of the glBegin ... glEnd pairs that they come from, else 0; of pairs of several modes it is
    GL_QUAD_STRIP, if that is among them. `shown_at` is (x, y, zoom x,
    zoom y) of a rectangle that shows each texel of the only texture as so many whole pixels, from the corner (x, y) on,
    to the left or downwards for a negative zoom; None where that is not known, as in recordings read from files.
    """

    state: State
    mode: int
    vertices: Vertices
    indices: np.ndarray | None
    modelview: np.ndarray
    projection: np.ndarray
    texture_matrices: tuple[np.ndarray, ...]
    uniforms: Mapping[str, Any] = NO_UNIFORMS
    program_name: str = ""
    label: str = ""
    offset_slope: str = "max"
    offset_unit: str = "mesa"
    modelview_kind: int = UNKNOWN
    projection_kind: int = UNKNOWN
    joined_positions: np.ndarray | None = None
    joined_start: int = 0
    linear: bool = False
    offset_mode: int = 0
    stipple_place: int = 0
    origin: Origin | None = None
    pairs_mode: int = 0
    shown_at: tuple[int, int, int, int] | None = None

    def __repr__(self) -> str:
        number = len(self.vertices.position) if self.indices is None or self.pairs_mode else len(self.indices)
        return f"Draw({self.mode_name}, {number} vertices, label {self.label!r})"

    @property
    def called_mode(self) -> int:
        """The mode that the program gave to glBegin, glDrawArrays ..."""
        return self.pairs_mode or self.mode

    @property
    def mode_name(self) -> str:
        """The name of this mode, "GL_TRIANGLES" ..."""
        return token_name(self.called_mode, PRIMITIVES)


BEHIND_MODELVIEW, KIND = Draw._fields.index("modelview") + 1, Draw._fields.index("modelview_kind")


def draws_like(
    draw: Draw, vertices: Iterable[Vertices], indices: Iterable[np.ndarray | None] | None = None
) -> list[Draw]:
    """Return a draw for each of several vertices, with indices of its own or those of `draw`; else they are alike.

    In half the time of `_replace`.
    """
    state, mode, _, its_indices, *others = draw
    pairs = zip(vertices, repeat(its_indices)) if indices is None else zip(vertices, indices, strict=True)
    return [Draw._make((state, mode, each, own, *others)) for each, own in pairs]


def moved_draws(draw: Draw, moved: Iterable[tuple[Vertices, np.ndarray | None, np.ndarray, int]]) -> list[Draw]:
    """Return a draw for each of several vertices, indices, modelview matrices and their kinds; else they are alike."""
    state, mode, before, behind = draw.state, draw.mode, draw[BEHIND_MODELVIEW:KIND], draw[KIND + 1 :]
    return [
        Draw._make((state, mode, vertices, indices, modelview, *before, kind, *behind))
        for vertices, indices, modelview, kind in moved
    ]


@dataclass(frozen=True, eq=False)
class DrawDepths:
    """glDrawPixels or glCopyPixels of depths, stencil values or both.

    The rectangle is a draw of a quad, whose texture has depths in red and stencil values in green; `color` is that of
    the raster position.
    """

    draw: Draw
    color: tuple[float, float, float, float]
    has_depth: bool
    has_stencil: bool


@dataclass(frozen=True, eq=False)
class Clear:
    """glClear: under scissor, colour mask, depth mask and the front stencil write mask."""

    state: State
    mask: int

    def __repr__(self) -> str:
        return f"Clear({' | '.join(name for name in CLEAR_BITS if self.mask & getattr(tokens, name))})"


@dataclass(frozen=True, eq=False)
class Accumulate:
    """glAccum, between the colour buffer and the accumulation buffer of the window."""

    state: State
    operation: int
    value: float


@dataclass(frozen=True, eq=False)
class BeginQuery:
    """glBeginQuery: count the fragments that pass from here on; `query` 0 ends it."""

    query: int


@dataclass(frozen=True, eq=False)
class DefineImage:
    """glTexImage. `cells` and `stencil` are in the storage's own layout, (height, width[, channels]), None for zeros.

    A framebuffer object that the level is attached to gets the new image. The slices of a 3-D image lie one above the
    other: (slices * height, width[, channels]). `blocks` are those of a compressed image, see `Image`.
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
    slices: int = 1
    blocks: np.ndarray | None = None


@dataclass(frozen=True, eq=False)
class UpdateImage:
    """glTexSubImage. `cells` and `stencil` are in the storage's own layout; None leaves them as they are.

    Of a 3-D image, so many slices change, from `z` on; their cells lie one above the other. `blocks` replace those of a
    compressed image from the one at (x, y) on.
    """

    texture: int
    face: int
    level: int
    x: int
    y: int
    cells: np.ndarray | None
    stencil: np.ndarray | None = None
    z: int = 0
    slices: int = 1
    blocks: np.ndarray | None = None


@dataclass(frozen=True, eq=False)
class CopyToTexture:
    """glCopyTexSubImage from a framebuffer; pixels outside the framebuffer leave their texels untouched.

    `transfer` is what glPixelTransfer changes on the way, None for nothing. `z` is the slice of a 3-D image.
    """

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
    transfer: PixelTransfer | None = None
    z: int = 0


@dataclass(frozen=True, eq=False)
class GenerateMipmaps:
    """glGenerateMipmap, or GL_GENERATE_MIPMAP for one face: all levels after the base level, up to the last.

    The other faces of a cube map get levels of the same sizes, zeros where they had others, as in Mesa.
    """

    texture: int
    faces: tuple[int, ...]
    base: int
    last: int


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


@dataclass(frozen=True, eq=False)
class CreateTexture:
    """The first glBindTexture of a name: it creates the texture object."""

    texture: int
    target: int


@dataclass(frozen=True, eq=False)
class SetSampler:
    """glTexParameter: texture objects keep their sampler, so it is part of the recording."""

    texture: int
    sampler: Sampler


@dataclass(frozen=True, eq=False)
class DeleteTextures:
    """glDeleteTextures."""

    textures: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class CreateFramebuffer:
    """The first glBindFramebuffer of a name: it creates the framebuffer object."""

    framebuffer: int


@dataclass(frozen=True, eq=False)
class DeleteFramebuffers:
    """glDeleteFramebuffers."""

    framebuffers: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class DefineRenderbuffer:
    """glRenderbufferStorage (zeros); without a format, the creation of the renderbuffer."""

    renderbuffer: int
    format: Format | None = None
    internal_format: int = 0
    width: int = 0
    height: int = 0


@dataclass(frozen=True, eq=False)
class DeleteRenderbuffers:
    """glDeleteRenderbuffers."""

    renderbuffers: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class AttachTexture:
    """glFramebufferTexture2D; texture 0 detaches. The texture's own image becomes the buffer."""

    framebuffer: int
    attachment: int
    texture: int
    face: int = 0
    level: int = 0


@dataclass(frozen=True, eq=False)
class AttachRenderbuffer:
    """glFramebufferRenderbuffer; renderbuffer 0 detaches."""

    framebuffer: int
    attachment: int
    renderbuffer: int


@dataclass(frozen=True, eq=False)
class SelectBuffers:
    """glDrawBuffer, glDrawBuffers and glReadBuffer: they belong to the framebuffer object. None leaves it as it is."""

    framebuffer: int
    draw_buffers: tuple[int, ...] | None = None
    read_buffer: int | None = None


Command = (
    Draw
    | DrawDepths
    | Clear
    | Accumulate
    | BeginQuery
    | DefineImage
    | UpdateImage
    | CopyToTexture
    | GenerateMipmaps
    | BlitFramebuffer
    | CreateTexture
    | SetSampler
    | DeleteTextures
    | CreateFramebuffer
    | DeleteFramebuffers
    | DefineRenderbuffer
    | DeleteRenderbuffers
    | AttachTexture
    | AttachRenderbuffer
    | SelectBuffers
)
OF_FRAMEBUFFERS = CreateFramebuffer, AttachTexture, AttachRenderbuffer, SelectBuffers  # they change one
OF_TEXTURES = CreateTexture, DefineImage, UpdateImage, SetSampler, GenerateMipmaps  # they change one and read no other
