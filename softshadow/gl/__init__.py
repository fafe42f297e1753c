"""OpenGL calls: functions and tokens named and called as in PyOpenGL's ``OpenGL.GL`` and ``OpenGL.GLU``.

The package checks arguments and sets state; `softshadow.pipeline` draws. Every call works on this thread's current
context::

    from softshadow import gl
    gl.create_context(64, 48)
    gl.glEnable(gl.GL_DEPTH_TEST)

References: GL 2.1 specification; the rules of this implementation: docs/exactness.md.
"""

from __future__ import annotations

from inspect import ismodule
from typing import Any

import softshadow
from softshadow.context import Context, current, make_current
from softshadow.gl.accumulation import *
from softshadow.gl.array_draws import *
from softshadow.gl.array_elements import *
from softshadow.gl.attributes import *
from softshadow.gl.bitmaps import *
from softshadow.gl.blits import *
from softshadow.gl.buffers import *
from softshadow.gl.capabilities import *
from softshadow.gl.clears import *
from softshadow.gl.clip_planes import *
from softshadow.gl.color_indices import *
from softshadow.gl.compressed_images import *
from softshadow.gl.conditional_rendering import *
from softshadow.gl.debug_groups import *
from softshadow.gl.errors import *
from softshadow.gl.evaluator_maps import *
from softshadow.gl.evaluators import *
from softshadow.gl.extensions import extension_names, missing_message, plain_name
from softshadow.gl.fog import *
from softshadow.gl.fragment_state import *
from softshadow.gl.framebuffers import *
from softshadow.gl.glu import *
from softshadow.gl.glu_mipmaps import *
from softshadow.gl.glu_mipmaps_1d_3d import *
from softshadow.gl.glu_names import *
from softshadow.gl.glu_tokens import *
from softshadow.gl.immediate import *
from softshadow.gl.lighting import *
from softshadow.gl.lists import *
from softshadow.gl.mapped_buffers import *
from softshadow.gl.materials import *
from softshadow.gl.occlusion import *
from softshadow.gl.pixel_rectangles import *
from softshadow.gl.pixel_transfer import *
from softshadow.gl.pixels import *
from softshadow.gl.pointers import *
from softshadow.gl.points import *
from softshadow.gl.programs import *
from softshadow.gl.pyopengl import *
from softshadow.gl.quadrics import *
from softshadow.gl.queries import *
from softshadow.gl.raster_position import *
from softshadow.gl.rasterization import *
from softshadow.gl.refusals import all_naming_arguments
from softshadow.gl.render_modes import *
from softshadow.gl.renderbuffers import *
from softshadow.gl.sample_coverage import *
from softshadow.gl.secondary_colors import *
from softshadow.gl.stipples import *
from softshadow.gl.tessellator import *
from softshadow.gl.texture_coordinates import *
from softshadow.gl.texture_copies import *
from softshadow.gl.texture_images import *
from softshadow.gl.texture_mipmaps import *
from softshadow.gl.texture_queries import *
from softshadow.gl.texture_residence import *
from softshadow.gl.texture_units import *
from softshadow.gl.textures import *
from softshadow.gl.transforms import *
from softshadow.gl.typed_images import *
from softshadow.gl.vertex_arrays import *
from softshadow.gl.vertex_attributes import *
from softshadow.programs import fixed_function  # of most draws: loaded here, not within the first frame
from softshadow.tokens import *

# calls that programs make most: a function around them would take longer than they do
FREQUENT = (
    "glBegin", "glEnd", "glVertex2f", "glVertex2fv", "glVertex3f", "glVertex3fv", "glVertex4f", "glVertex4fv",
    "glColor3f", "glColor3fv", "glColor4f", "glColor4fv", "glColor3ub", "glColor4ub", "glNormal3f", "glNormal3fv",
    "glTexCoord2f", "glTexCoord2fv", "glArrayElement", "glEnable", "glDisable", "glMatrixMode", "glPushMatrix",
    "glPopMatrix", "glLoadIdentity", "glTranslatef", "glScalef", "glRotatef", "glOrtho", "glPushAttrib",
    "glPopAttrib", "glCallList", "glGetError", "glStencilFunc", "glTexParameteri", "glPolygonOffset", "glLineWidth",
    "glDepthRange", "glShadeModel", "glFogf", "glTexGeni",
)  # fmt: skip
globals().update(all_naming_arguments(globals(), FREQUENT))


def create_context(
    width: int,
    height: int,
    depth_format: str = "d24",
    stencil_bits: int = 8,
    precision: str = "mesa",
    polygon_offset_slope: str = "max",
    polygon_offset_unit: str = "mesa",
    raise_errors: bool = True,
    history_mb: float | None = 64,
) -> Context:
    """Create a context in GL's initial state and make it this thread's current one.

    Used in a ``with`` statement, the previous context is current again at its end.

    Parameters
    ----------
    width, height : int, pixels, 1 to 16384
    depth_format : "d24" (24-bit integers) or "d32f" (float32)
    stencil_bits : 1 to 8; counters saturate at ``2**stencil_bits - 1``
    precision : "mesa" (float32, the bits of llvmpipe) or "exact" (float64, depth not rounded)
    polygon_offset_slope : "max", "length" or "slide" (no absolute value, as printed on the slide)
    polygon_offset_unit : "mesa" (a unit is two steps of fixed-point depth) or "spec" (one)
    raise_errors : raise `GLError` besides recording the error for glGetError
    history_mb : megabytes of recorded commands and arrays to keep at most, None for all; older ones are forgotten, so
        an animation runs in constant memory

    Raises
    ------
    ValueError
        An argument has none of these values.

    Examples
    --------
    >>> from softshadow import gl
    >>> with gl.create_context(4, 3):
    ...     gl.glClearStencil(2)
    ...     gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    ...     gl.glReadPixels(0, 0, 4, 1, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
    array([[2, 2, 2, 2]], dtype=uint8)
    """
    offset = (polygon_offset_slope, polygon_offset_unit)
    if history_mb is not None and not history_mb > 0:
        raise ValueError(f"history_mb={history_mb!r}: expected more than 0, or None")
    history_bytes = None if history_mb is None or history_mb == float("inf") else int(history_mb * (1 << 20))
    context = Context(width, height, depth_format, stencil_bits, precision, *offset, raise_errors, history_bytes)
    context.set_before(make_current(context))
    return context


def __dir__() -> list[str]:
    """Return the public names."""
    own = ("Context", "GLError", "create_context", "describe_primitives", "program", "record", "step")
    spelled = (
        name for name, value in globals().items() if name.startswith(("gl", "GL_", "GLU_")) and not ismodule(value)
    )
    return sorted({*own, *spelled})


def __getattr__(name: str) -> Any:
    if name == "__all__":
        return [*__dir__(), *extension_names(__dir__())]
    if name == "record":  # a run is made of a recording on a higher floor
        return softshadow.record
    if name.startswith(("gl", "GL_")):
        plain = plain_name(name, globals())
        if plain is not None:
            return globals()[plain]
        raise AttributeError(missing_message(name, __dir__()), name=name)
    raise AttributeError(f"module 'softshadow.gl' has no attribute {name!r}", name=name)
