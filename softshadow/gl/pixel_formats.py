"""Valid combinations of pixel format, type and image (GL 4.5 compatibility, sec. 8.4.4)."""

from __future__ import annotations

from softshadow import tokens as gl
from softshadow.image import Format, Image
from softshadow.packed_colors import PACKED_COLORS
from softshadow.pixel_store import COMPONENTS, PACKED_TYPES, TYPES
from softshadow.tokens import token_name

Problem = tuple[int, str]  # GL error code and message
KINDS = {  # of buffers, by the client format of their values; of all others, "color"
    gl.GL_DEPTH_COMPONENT: "depth",
    gl.GL_STENCIL_INDEX: "stencil",
    gl.GL_DEPTH_STENCIL: "depth-stencil",
}


def format_problem(format: int, type: int) -> Problem | None:
    """Return (error code, message) if a client format and type are not a valid combination, else None."""
    if format == gl.GL_DEPTH_STENCIL and type not in PACKED_TYPES:
        expected = " or ".join(token_name(t) for t in PACKED_TYPES)
        return gl.GL_INVALID_ENUM, f"type={token_name(type, TYPE_NAMES)}: expected {expected} for GL_DEPTH_STENCIL"
    if type in PACKED_COLORS and format not in PACKED_COLORS[type].formats:
        expected = " or ".join(token_name(f) for f in PACKED_COLORS[type].formats)
        code = gl.GL_INVALID_ENUM if type == gl.GL_UNSIGNED_INT_5_9_9_9_REV else gl.GL_INVALID_OPERATION
        return code, f"format={token_name(format)}: expected {expected} for {token_name(type)}"
    if type in PACKED_TYPES and format != gl.GL_DEPTH_STENCIL:
        return gl.GL_INVALID_OPERATION, f"format={token_name(format)}: expected GL_DEPTH_STENCIL for {token_name(type)}"
    if format not in COMPONENTS:
        expected = ", ".join(token_name(f) for f in COMPONENTS)
        return gl.GL_INVALID_ENUM, f"format={token_name(format)}: expected one of {expected}"
    if type not in TYPES and type not in PACKED_TYPES and type not in PACKED_COLORS:
        expected = ", ".join(token_name(t) for t in (*TYPES, *PACKED_TYPES, *PACKED_COLORS))
        return gl.GL_INVALID_ENUM, f"type={token_name(type, TYPE_NAMES)}: expected one of {expected}"
    return None


def pixels_problem(format: int, type: int) -> Problem | None:
    """Return what `format_problem` does for pixels that are drawn or stored: indices may also be a bitmap."""
    if type == gl.GL_BITMAP and format in (gl.GL_COLOR_INDEX, gl.GL_STENCIL_INDEX):
        return None
    return format_problem(format, type)


TYPE_NAMES = ("GL_BYTE", "GL_DOUBLE")


def kind_of(format: int) -> str:
    """Return the kind of buffer of a client format: "depth", "stencil", "depth-stencil" or "color"."""
    return KINDS.get(format, "color")


def upload_problem(format: int, stored: Format, has_stencil: bool) -> Problem | None:
    """Return (error code, message) if client pixels of a format cannot be stored in an image, else None."""
    kind = kind_of(format)
    fits = {
        "depth": stored.kind == "depth",
        "depth-stencil": stored.kind == "depth",  # without a stencil image, stencil values are dropped
        "stencil": stored.kind == "stencil" or has_stencil,
        "color": stored.kind in ("unorm8", "float"),
    }[kind]
    if fits:
        return None
    return gl.GL_INVALID_OPERATION, f"format={token_name(format)}: expected a format for {described(stored)}"


def readout_problem(format: int, image: Image) -> Problem | None:
    """Return (error code, message) if an image cannot be read in a client format, else None."""
    if format == gl.GL_COLOR_INDEX:
        return gl.GL_INVALID_OPERATION, "format=GL_COLOR_INDEX: no image has colour indices"
    if format == gl.GL_DEPTH_STENCIL and image.stencil is None:
        return gl.GL_INVALID_OPERATION, "format=GL_DEPTH_STENCIL: expected an image with stencil values"
    return upload_problem(format, image.format, image.stencil is not None)


def described(stored: Format) -> str:
    """Return the word for what an image of this format holds, for messages."""
    return {"depth": "depth", "stencil": "stencil values", "none": "no image"}.get(stored.kind, "colours")
