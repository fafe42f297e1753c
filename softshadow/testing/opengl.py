"""The GL namespace of programs on Mesa: PyOpenGL's names with the array conventions of `softshadow.gl`.

Import it and the modules opengl_* only in a Mesa worker: PyOpenGL selects its platform when it is imported.
Differences from plain PyOpenGL:

- glReadPixels and glGetTexImage return (h, w) or (h, w, channels), first row = bottom row, without row padding, and
  support packed depth and stencil. Uploaded images are read without row padding if they are too small for the padding
  of GL_UNPACK_ALIGNMENT.
- glGen* return a plain int for one name.
- A GL error is raised as GL.GLError, and glGetError still returns its code afterwards, as in `softshadow.gl`.
- `program(name)` compiles the GLSL source of a softshadow program and returns a name for glUseProgram.
"""

import importlib
from collections.abc import Callable
from typing import Any

import OpenGL
from OpenGL import GL, GLU

from softshadow.testing.opengl_answers import ANSWER_CALLS
from softshadow.testing.opengl_arrays import ARRAY_CALLS
from softshadow.testing.opengl_pixels import PIXEL_CALLS
from softshadow.testing.opengl_programs import link_program

CHECKED = OpenGL.ERROR_CHECKING  # else calls are PyOpenGL's own, as fast as they can be
OWN = {**PIXEL_CALLS, **ARRAY_CALLS, **ANSWER_CALLS}
# PyOpenGL defines names with a suffix in a module for each extension
EXTENSIONS = (
    "ARB.multitexture", "ARB.occlusion_query", "ARB.draw_buffers", "ARB.texture_cube_map", "ARB.texture_border_clamp",
    "ARB.texture_mirrored_repeat", "ARB.texture_env_combine", "ARB.texture_env_dot3", "ARB.depth_texture",
    "ARB.shadow", "ARB.texture_float", "ARB.transpose_matrix", "ARB.multisample", "ARB.vertex_buffer_object",
    "EXT.framebuffer_object", "EXT.framebuffer_blit", "EXT.packed_depth_stencil", "EXT.stencil_two_side",
    "EXT.stencil_wrap", "EXT.blend_color", "EXT.blend_minmax", "EXT.blend_subtract", "EXT.blend_func_separate",
    "EXT.blend_equation_separate", "EXT.bgra", "EXT.texture", "EXT.texture_object", "EXT.copy_texture",
    "EXT.subtexture", "EXT.texture_cube_map", "EXT.texture_lod_bias", "EXT.texture_env_combine", "EXT.vertex_array",
    "EXT.separate_specular_color", "EXT.rescale_normal", "EXT.draw_range_elements", "EXT.multi_draw_arrays",
    "NV.depth_clamp", "ATI.separate_stencil", "ATI.draw_buffers", "SGIS.texture_edge_clamp", "SGIS.generate_mipmap",
    "SGIS.texture_border_clamp", "SGIS.texture_lod", "SGIX.depth_texture", "IBM.texture_mirrored_repeat",
    "NV.conditional_render", "ARB.texture_rectangle", "NV.texture_rectangle", "EXT.texture3D",
    "EXT.texture_filter_anisotropic", "EXT.abgr", "ARB.point_parameters", "EXT.point_parameters", "ARB.point_sprite",
    "ARB.window_pos", "ARB.pixel_buffer_object", "EXT.pixel_buffer_object", "ARB.half_float_pixel",
    "ARB.shader_objects", "ARB.vertex_shader", "ARB.vertex_program", "EXT.secondary_color", "EXT.fog_coord",
    "EXT.texture_compression_rgtc",
    "ARB.fragment_shader", "ARB.texture_compression", "EXT.packed_pixels", "EXT.provoking_vertex", "NV.point_sprite",
    "NV.texgen_reflection", "NV.half_float", "NV.packed_depth_stencil", "EXT.texture_sRGB",
    "EXT.texture_compression_s3tc", "EXT.texture_compression_latc", "EXT.texture_shared_exponent", "EXT.packed_float",
)  # fmt: skip

_current: "MesaGL | None" = None


def current() -> "MesaGL":
    """Return the namespace of the current context; RuntimeError if there is none."""
    if _current is None:
        raise RuntimeError("no Mesa context is current")
    return _current


class MesaGL:
    """All functions and tokens of GL and GLU, for one context.

    Parameters
    ----------
    raise_errors : bool          False: a GL error is only recorded, as in plain GL

    Attributes
    ----------
    errors : list of (name of the call, GL error code), in order
    """

    def __init__(self, raise_errors: bool = True) -> None:
        self.errors: list[tuple[str, int]] = []
        self._raise_errors = raise_errors
        self._pending = GL.GL_NO_ERROR
        self._programs: dict[str, int] = {}

    def make_current(self) -> None:
        """Make this the namespace that `current` returns; its context must be current already."""
        global _current
        _current = self

    def __getattr__(self, name: str) -> Any:
        value = OWN.get(name) if CHECKED else None
        if value is None:
            module = GLU if name.startswith(("glu", "GLU_")) else GL
            value = getattr(module, name, None)
        if value is None:
            value = _of_extension(name)
        if value is None:
            raise AttributeError(f"OpenGL has no {name}")
        if CHECKED and callable(value) and name.startswith("gl"):
            value = self._recorded(name, value)
        setattr(self, name, value)  # later accesses do not call __getattr__
        return value

    def _recorded(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: Any, **named: Any) -> Any:
            try:
                return function(*arguments, **named)
            except GL.GLError as error:
                self.errors.append((name, int(error.err)))
                self._pending = self._pending or int(error.err)
                if self._raise_errors:
                    raise
                return None

        return call

    def glGetError(self) -> int:
        """Return the first error code since the last call, including errors that PyOpenGL has raised."""
        code, self._pending = self._pending or int(GL.glGetError()), GL.GL_NO_ERROR
        return code

    def describe_primitives(self, part: str, *details: Any) -> None:
        """Do nothing: descriptions of primitives are for pixel histories, and change no pixel."""

    def program(self, name: str) -> int:
        """Return a GL program compiled from the GLSL of the softshadow program `name`, once per context."""
        if name not in self._programs:
            from softshadow import programs  # loads kernels that most GL programs do not need

            program = programs.get(name)
            self._programs[name] = link_program(name, program.glsl_vertex, program.glsl_fragment)
        return self._programs[name]


def _of_extension(name: str) -> Any:
    """Return a name from one of the extensions that `softshadow.gl` supports, or None."""
    for extension in EXTENSIONS:
        value = getattr(importlib.import_module(f"OpenGL.GL.{extension}"), name, None)
        if value is not None:
            return value
    return None
