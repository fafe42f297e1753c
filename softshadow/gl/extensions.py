"""Names of extensions that were promoted to core GL: ``glActiveTextureARB``, ``GL_INCR_WRAP_EXT``.

A name with the suffix of an extension means the core name if it was promoted unchanged.
"""

from __future__ import annotations

import re
from collections.abc import Container, Iterable
from difflib import get_close_matches
from fnmatch import translate
from functools import cache

# core names that were promoted unchanged, by suffix of their extension; * and ? as in file names
PROMOTED = {
    "ARB": """
        GL_ACTIVE_TEXTURE GL_CLIENT_ACTIVE_TEXTURE GL_MAX_TEXTURE_UNITS GL_TEXTURE? GL_TEXTURE[123]?
        glActiveTexture glClientActiveTexture glMultiTexCoord*
        GL_COMBINE* GL_SOURCE[012]_* GL_OPERAND[012]_* GL_ADD_SIGNED GL_INTERPOLATE GL_SUBTRACT GL_CONSTANT
        GL_PRIMARY_COLOR GL_PREVIOUS GL_RGB_SCALE GL_DOT3_RGB GL_DOT3_RGBA
        GL_DEPTH_COMPONENT16 GL_DEPTH_COMPONENT24 GL_DEPTH_COMPONENT32 GL_DEPTH_TEXTURE_MODE GL_TEXTURE_DEPTH_SIZE
        GL_TEXTURE_COMPARE_MODE GL_TEXTURE_COMPARE_FUNC GL_COMPARE_R_TO_TEXTURE
        GL_TEXTURE_CUBE_MAP GL_TEXTURE_CUBE_MAP_[NP]* GL_TEXTURE_BINDING_CUBE_MAP GL_MAX_CUBE_MAP_TEXTURE_SIZE
        GL_TEXTURE_RECTANGLE GL_PROXY_TEXTURE_RECTANGLE GL_TEXTURE_BINDING_RECTANGLE GL_MAX_RECTANGLE_TEXTURE_SIZE
        GL_CLAMP_TO_BORDER GL_MIRRORED_REPEAT GL_RGB16F GL_RGB32F GL_RGBA16F GL_RGBA32F GL_TRANSPOSE_*
        GL_COLOR_SUM GL_FOG_COORDINATE_ARRAY_BUFFER_BINDING
        GL_MULTISAMPLE GL_MULTISAMPLE_BIT GL_SAMPLES GL_SAMPLE_*
        GL_CURRENT_QUERY GL_QUERY_[CR]* GL_SAMPLES_PASSED glBeginQuery glEndQuery glGenQueries glDeleteQueries glIsQuery
        glGetQuery*
        GL_DRAW_BUFFER? GL_MAX_DRAW_BUFFERS glDrawBuffers
        GL_ARRAY_BUFFER* GL_ELEMENT_ARRAY_BUFFER* GL_[!F]*_ARRAY_BUFFER_BINDING GL_BUFFER_SIZE GL_BUFFER_USAGE
        GL_STREAM_* GL_STATIC_* GL_DYNAMIC_*
        GL_READ_ONLY GL_WRITE_ONLY GL_READ_WRITE GL_BUFFER_ACCESS GL_BUFFER_MAPPED GL_BUFFER_MAP_POINTER
        glGenBuffers glBindBuffer glBufferData glBufferSubData glDeleteBuffers glIsBuffer glGetBuffer* glMapBuffer
        glUnmapBuffer
        GL_PIXEL_PACK_BUFFER* GL_PIXEL_UNPACK_BUFFER* GL_HALF_FLOAT GL_TEXTURE_COMPRESSION_HINT GL_TEXTURE_COMPRESSED
        GL_TEXTURE_COMPRESSED_IMAGE_SIZE GL_NUM_COMPRESSED_TEXTURE_FORMATS GL_COMPRESSED_TEXTURE_FORMATS
        GL_COMPRESSED_ALPHA GL_COMPRESSED_LUMINANCE GL_COMPRESSED_LUMINANCE_ALPHA GL_COMPRESSED_INTENSITY
        GL_COMPRESSED_RGB GL_COMPRESSED_RGBA glCompressedTexImage?D glCompressedTexSubImage?D glGetCompressedTexImage
        GL_POINT_SIZE_MIN GL_POINT_SIZE_MAX GL_POINT_FADE_THRESHOLD_SIZE GL_POINT_DISTANCE_ATTENUATION
        glPointParameterf glPointParameterfv GL_POINT_SPRITE GL_COORD_REPLACE GL_NORMAL_MAP GL_REFLECTION_MAP
        GL_PROXY_TEXTURE_CUBE_MAP GL_MAX_TEXTURE_COORDS GL_MAX_TEXTURE_IMAGE_UNITS
        glWindowPos[23]* glSampleCoverage glLoadTransposeMatrix? glMultTransposeMatrix?
        glUniform[1234]* glUniformMatrix4fv glGetUniformLocation glGetUniformfv glGetUniformiv
    """,
    "EXT": """
        GL_FRAMEBUFFER GL_FRAMEBUFFER_A* GL_FRAMEBUFFER_BINDING GL_FRAMEBUFFER_COMPLETE GL_FRAMEBUFFER_I*
        GL_FRAMEBUFFER_UNSUPPORTED GL_DRAW_FRAMEBUFFER* GL_READ_FRAMEBUFFER* GL_RENDERBUFFER* GL_COLOR_ATTACHMENT*
        GL_DEPTH_ATTACHMENT GL_STENCIL_ATTACHMENT GL_MAX_COLOR_ATTACHMENTS GL_MAX_RENDERBUFFER_SIZE
        GL_INVALID_FRAMEBUFFER_OPERATION GL_STENCIL_INDEX8
        glBindFramebuffer glBindRenderbuffer glBlitFramebuffer glCheckFramebufferStatus glDeleteFramebuffers
        glDeleteRenderbuffers glFramebufferRenderbuffer glFramebufferTexture2D glGenFramebuffers glGenRenderbuffers
        glGenerateMipmap glGetFramebufferAttachmentParameteriv glGetRenderbufferParameteriv glIsFramebuffer
        glIsRenderbuffer glRenderbufferStorage
        GL_DEPTH_STENCIL GL_DEPTH24_STENCIL8 GL_UNSIGNED_INT_24_8 GL_INCR_WRAP GL_DECR_WRAP
        GL_BLEND_COLOR GL_BLEND_*_ALPHA GL_BLEND_*_RGB GL_BLEND_EQUATION GL_CONSTANT GL_CONSTANT_ALPHA
        GL_CONSTANT_COLOR GL_ONE_MINUS_CONSTANT_* GL_FUNC_* GL_MIN GL_MAX
        glBlendColor glBlendEquation glBlendEquationSeparate glBlendFuncSeparate
        GL_BGR GL_BGRA GL_ALPHA? GL_ALPHA1? GL_INTENSITY GL_INTENSITY? GL_INTENSITY1? GL_LUMINANCE? GL_LUMINANCE1?
        GL_LUMINANCE*_ALPHA? GL_LUMINANCE*_ALPHA1? GL_RGB[0-9] GL_RGB1? GL_RGBA[0-9] GL_RGBA1? GL_RGB5_A1 GL_RGB10_A2
        GL_SRGB* GL_SLUMINANCE* GL_COMPRESSED_SRGB GL_COMPRESSED_SRGB_ALPHA GL_COMPRESSED_SLUMINANCE
        GL_COMPRESSED_SLUMINANCE_ALPHA GL_COMPRESSED_RED_RGTC1 GL_COMPRESSED_SIGNED_RED_RGTC1
        glAreTexturesResident glPrioritizeTextures GL_[!F]*_ARRAY_POINTER
        GL_TEXTURE_[!CD]*_SIZE GL_TEXTURE_PRIORITY GL_TEXTURE_RESIDENT GL_TEXTURE_LOD_BIAS GL_TEXTURE_FILTER_CONTROL
        GL_TEXTURE_CUBE_MAP GL_TEXTURE_CUBE_MAP_[NP]* GL_TEXTURE_BINDING_CUBE_MAP GL_MAX_CUBE_MAP_TEXTURE_SIZE
        GL_TEXTURE_3D GL_PROXY_TEXTURE_[123]D GL_MAX_3D_TEXTURE_SIZE GL_TEXTURE_DEPTH GL_TEXTURE_WRAP_R
        GL_PACK_IMAGE_HEIGHT GL_PACK_SKIP_IMAGES GL_UNPACK_IMAGE_HEIGHT GL_UNPACK_SKIP_IMAGES
        glBindTexture glCopyTexImage[12]D glCopyTexSubImage[123]D glDeleteTextures glGenTextures glIsTexture
        glTexImage3D glTexSubImage[123]D
        GL_COMBINE* GL_SOURCE[012]_* GL_OPERAND[012]_* GL_ADD_SIGNED GL_INTERPOLATE GL_PRIMARY_COLOR GL_PREVIOUS
        GL_RGB_SCALE GL_LIGHT_MODEL_COLOR_CONTROL GL_SEPARATE_SPECULAR_COLOR GL_SINGLE_COLOR GL_RESCALE_NORMAL
        GL_VERTEX_ARRAY GL_NORMAL_ARRAY GL_COLOR_ARRAY GL_TEXTURE_COORD_ARRAY GL_[!F]*_ARRAY_SIZE GL_[!F]*_ARRAY_STRIDE
        GL_[!F]*_ARRAY_TYPE GL_EDGE_FLAG_ARRAY
        GL_INDEX_ARRAY glArrayElement glDrawArrays glDrawRangeElements glMultiDrawArrays glMultiDrawElements
        GL_PIXEL_PACK_BUFFER* GL_PIXEL_UNPACK_BUFFER* GL_UNSIGNED_BYTE_3_3_2 GL_UNSIGNED_SHORT_4_4_4_4
        GL_UNSIGNED_SHORT_5_5_5_1 GL_UNSIGNED_INT_8_8_8_8 GL_UNSIGNED_INT_10_10_10_2
        GL_POINT_SIZE_MIN GL_POINT_SIZE_MAX GL_POINT_FADE_THRESHOLD_SIZE glPointParameterf glPointParameterfv
        GL_NORMAL_MAP GL_REFLECTION_MAP GL_PROXY_TEXTURE_CUBE_MAP GL_MAX_TEXTURE_LOD_BIAS
        GL_COLOR_SUM GL_CURRENT_SECONDARY_COLOR GL_SECONDARY_COLOR_ARRAY glSecondaryColor*
        GL_FOG_COORDINATE GL_FOG_COORDINATE_SOURCE GL_FRAGMENT_DEPTH GL_CURRENT_FOG_COORDINATE
        GL_FOG_COORDINATE_ARRAY GL_FOG_COORDINATE_ARRAY_TYPE GL_FOG_COORDINATE_ARRAY_STRIDE glFogCoord*
        GL_PROVOKING_VERTEX GL_FIRST_VERTEX_CONVENTION GL_LAST_VERTEX_CONVENTION
        GL_QUADS_FOLLOW_PROVOKING_VERTEX_CONVENTION glProvokingVertex
    """,
    "NV": """
        GL_TEXTURE_RECTANGLE GL_PROXY_TEXTURE_RECTANGLE GL_TEXTURE_BINDING_RECTANGLE GL_MAX_RECTANGLE_TEXTURE_SIZE
        GL_NORMAL_MAP GL_REFLECTION_MAP GL_POINT_SPRITE GL_COORD_REPLACE GL_DEPTH_STENCIL GL_UNSIGNED_INT_24_8
        GL_HALF_FLOAT GL_DEPTH_CLAMP GL_QUERY_WAIT GL_QUERY_NO_WAIT GL_QUERY_BY_REGION_WAIT GL_QUERY_BY_REGION_NO_WAIT
        glBeginConditionalRender glEndConditionalRender
    """,
    "ATI": """
        GL_DRAW_BUFFER? GL_MAX_DRAW_BUFFERS glDrawBuffers GL_STENCIL_BACK_F* GL_STENCIL_BACK_PASS_*
    """,
    "SGIS": """
        GL_CLAMP_TO_BORDER GL_CLAMP_TO_EDGE GL_GENERATE_MIPMAP GL_GENERATE_MIPMAP_HINT GL_TEXTURE_BASE_LEVEL
        GL_TEXTURE_MAX_L* GL_TEXTURE_MIN_LOD
    """,
    "SGIX": "GL_DEPTH_COMPONENT16 GL_DEPTH_COMPONENT24 GL_DEPTH_COMPONENT32",
    "IBM": "GL_MIRRORED_REPEAT",
}


LEAST_SIMILARITY = 0.85  # accepts typing errors like 'glStencilFnc', but not glReadPixels for glDrawPixels


def plain_name(name: str, known: Container[str]) -> str | None:
    """Return the core name that a name with a suffix means, or None."""
    for suffix in PROMOTED:
        plain = name.removesuffix(f"_{suffix}" if name.startswith("GL_") else suffix)
        if plain != name and plain in known and _is_promoted(plain, suffix):
            return plain
    return None


@cache
def _promoted(suffix: str) -> re.Pattern[str]:
    return re.compile("|".join(translate(pattern) for pattern in PROMOTED[suffix].split()))


def _is_promoted(plain: str, suffix: str) -> bool:
    return _promoted(suffix).match(plain) is not None


def extension_names(known: Iterable[str]) -> list[str]:
    """Return all promoted names with their suffixes, for ``from softshadow.gl import *``."""
    return sorted(
        f"{plain}_{suffix}" if plain.startswith("GL_") else f"{plain}{suffix}"
        for plain in known
        for suffix in PROMOTED
        if _is_promoted(plain, suffix)
    )


def missing_message(name: str, known: Iterable[str]) -> str:
    """Return the message for a missing name, with the most similar name that exists."""
    close = get_close_matches(name, list(known), n=1, cutoff=LEAST_SIMILARITY)
    return f"{name} is not part of this subset of OpenGL" + (f"; did you mean {close[0]!r}?" if close else "")
