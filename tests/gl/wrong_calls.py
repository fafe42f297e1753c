"""Refused calls on textures, framebuffer objects, pixels and programs, each with a single mistake."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

BYTES = np.zeros((4, 4, 4), np.uint8)
FLOATS = np.zeros((4, 4), np.float32)
WORDS = np.zeros((4, 4), np.uint32)
NO_TOKEN = 3


@dataclass(frozen=True)
class World:
    """Names of the objects that `prepare` makes."""

    gl: Any
    texture: int
    depth_texture: int
    unbound: int
    framebuffer: int
    program: int


def prepare(gl: Any) -> World:
    """Bind a 4 x 4 RGBA8 texture; make a depth texture, a framebuffer object around the first, and a program."""
    texture, depth_texture, unbound = (int(name) for name in gl.glGenTextures(3))
    for name, pixels in ((depth_texture, FLOATS), (texture, BYTES)):
        gl.glBindTexture(gl.GL_TEXTURE_2D, name)
        if name == texture:
            upload(gl)
        else:
            upload(gl, internal=gl.GL_DEPTH_COMPONENT24, format=gl.GL_DEPTH_COMPONENT, type=gl.GL_FLOAT, pixels=pixels)
    framebuffer = int(gl.glGenFramebuffers(1))
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    program = gl.program("shadow-map")
    return World(gl, texture, depth_texture, unbound, framebuffer, program)


def upload(gl: Any, **changed: Any) -> None:
    """glTexImage2D of 4 x 4 RGBA8, but for what is changed."""
    given = {
        "target": gl.GL_TEXTURE_2D, "level": 0, "internal": gl.GL_RGBA8, "width": 4, "height": 4, "border": 0,
        "format": gl.GL_RGBA, "type": gl.GL_UNSIGNED_BYTE, "pixels": BYTES,
    } | changed  # fmt: skip
    gl.glTexImage2D(*given.values())


def update(gl: Any, **changed: Any) -> None:
    """glTexSubImage2D of 2 x 2 RGBA, but for what is changed."""
    given = {
        "target": gl.GL_TEXTURE_2D, "level": 0, "x": 0, "y": 0, "width": 2, "height": 2,
        "format": gl.GL_RGBA, "type": gl.GL_UNSIGNED_BYTE, "pixels": BYTES,
    } | changed  # fmt: skip
    gl.glTexSubImage2D(*given.values())


def copy_image(gl: Any, **changed: Any) -> None:
    """glCopyTexImage2D of 2 x 2 pixels, but for what is changed."""
    given = {
        "target": gl.GL_TEXTURE_2D, "level": 0, "internal": gl.GL_RGBA8, "x": 0, "y": 0, "width": 2, "height": 2,
        "border": 0,
    } | changed  # fmt: skip
    gl.glCopyTexImage2D(*given.values())


def copy_part(gl: Any, **changed: Any) -> None:
    """glCopyTexSubImage2D of 2 x 2 pixels, but for what is changed."""
    given = {
        "target": gl.GL_TEXTURE_2D, "level": 0, "x_offset": 0, "y_offset": 0, "x": 0, "y": 0, "width": 2, "height": 2,
    } | changed  # fmt: skip
    gl.glCopyTexSubImage2D(*given.values())


def read(gl: Any, format: int, type: int, width: int = 2) -> None:
    """glReadPixels at the origin."""
    gl.glReadPixels(0, 0, width, 2, format, type)


def attach(world: World, **changed: Any) -> None:
    """glFramebufferTexture2D to the world's framebuffer object, but for what is changed."""
    gl = world.gl
    given = {
        "target": gl.GL_FRAMEBUFFER, "attachment": gl.GL_COLOR_ATTACHMENT0, "textarget": gl.GL_TEXTURE_2D,
        "texture": world.texture, "level": 0,
    } | changed  # fmt: skip
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, world.framebuffer)
    gl.glFramebufferTexture2D(*given.values())


def inside(world: World, call: Callable[[], Any]) -> None:
    """Make a call while the world's framebuffer object is bound."""
    world.gl.glBindFramebuffer(world.gl.GL_FRAMEBUFFER, world.framebuffer)
    call()


def in_use(world: World, name: str, call: Callable[[int], Any]) -> None:
    """Make a call with the location of a uniform of the program in use."""
    world.gl.glUseProgram(world.program)
    call(world.gl.glGetUniformLocation(world.program, name))


WRONG_CALLS: dict[str, Callable[[World], Any]] = {
    "bind: target": lambda w: w.gl.glBindTexture(NO_TOKEN, w.texture),
    "bind: as a cube map": lambda w: w.gl.glBindTexture(w.gl.GL_TEXTURE_CUBE_MAP, w.texture),
    "upload: target": lambda w: upload(w.gl, target=NO_TOKEN),
    "upload: level": lambda w: upload(w.gl, level=-1),
    "upload: level 15": lambda w: upload(w.gl, level=15, width=1, height=1),
    "upload: internal format": lambda w: upload(w.gl, internal=w.gl.GL_FLOAT),
    "upload: width": lambda w: upload(w.gl, width=-1),
    "upload: too wide": lambda w: upload(w.gl, width=16385, pixels=None),
    "upload: border": lambda w: upload(w.gl, border=2),
    "upload: format": lambda w: upload(w.gl, format=NO_TOKEN),
    "upload: colours as depth": lambda w: upload(w.gl, internal=w.gl.GL_DEPTH_COMPONENT24),
    "upload: depth as colours": lambda w: upload(
        w.gl, format=w.gl.GL_DEPTH_COMPONENT, type=w.gl.GL_FLOAT, pixels=FLOATS
    ),
    "upload: packed type": lambda w: upload(w.gl, type=w.gl.GL_UNSIGNED_INT_24_8, pixels=WORDS),
    "upload: packed float type": lambda w: upload(
        w.gl, type=w.gl.GL_FLOAT_32_UNSIGNED_INT_24_8_REV, pixels=bytes(8 * 16)
    ),
    "upload: type of packed format": lambda w: upload(
        w.gl, internal=w.gl.GL_DEPTH24_STENCIL8, format=w.gl.GL_DEPTH_STENCIL
    ),
    "upload: cube map, not a face": lambda w: upload(w.gl, target=w.gl.GL_TEXTURE_CUBE_MAP),
    "upload: oblong face": lambda w: upload(w.gl, target=w.gl.GL_TEXTURE_CUBE_MAP_NEGATIVE_Y, width=2),
    "update: cube map, not a face": lambda w: update(w.gl, target=w.gl.GL_TEXTURE_CUBE_MAP),
    "update: face without image": lambda w: update(w.gl, target=w.gl.GL_TEXTURE_CUBE_MAP_POSITIVE_Z),
    "copy: oblong face": lambda w: copy_image(w.gl, target=w.gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X, width=4),
    "mipmaps: of a face": lambda w: w.gl.glGenerateMipmap(w.gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X),
    "mipmaps: of a cube map without faces": lambda w: w.gl.glGenerateMipmap(w.gl.GL_TEXTURE_CUBE_MAP),
    "parameter: of a face": lambda w: w.gl.glTexParameteri(
        w.gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X, w.gl.GL_TEXTURE_WRAP_S, w.gl.GL_REPEAT
    ),
    "parameter: seamless": lambda w: w.gl.glTexParameteri(
        w.gl.GL_TEXTURE_CUBE_MAP, w.gl.GL_TEXTURE_CUBE_MAP_SEAMLESS, 2
    ),
    "level query: cube map, not a face": lambda w: w.gl.glGetTexLevelParameteriv(
        w.gl.GL_TEXTURE_CUBE_MAP, 0, w.gl.GL_TEXTURE_WIDTH
    ),
    "get image: cube map, not a face": lambda w: w.gl.glGetTexImage(
        w.gl.GL_TEXTURE_CUBE_MAP, 0, w.gl.GL_RGBA, w.gl.GL_FLOAT
    ),
    "update: target": lambda w: update(w.gl, target=NO_TOKEN),
    "update: level": lambda w: update(w.gl, level=-1),
    "update: level without image": lambda w: update(w.gl, level=2),
    "update: level without image, format": lambda w: update(w.gl, level=2, format=NO_TOKEN),
    "update: outside": lambda w: update(w.gl, x=3),
    "update: offset": lambda w: update(w.gl, x=-1),
    "update: width": lambda w: update(w.gl, width=-1),
    "update: format": lambda w: update(w.gl, format=NO_TOKEN),
    "update: depth": lambda w: update(w.gl, format=w.gl.GL_DEPTH_COMPONENT, type=w.gl.GL_FLOAT, pixels=FLOATS),
    "copy: target": lambda w: copy_image(w.gl, target=NO_TOKEN),
    "copy: level": lambda w: copy_image(w.gl, level=-1),
    "copy: number of components": lambda w: copy_image(w.gl, internal=4),
    "copy: internal format": lambda w: copy_image(w.gl, internal=w.gl.GL_FLOAT),
    "copy: width": lambda w: copy_image(w.gl, width=-1),
    "copy: border": lambda w: copy_image(w.gl, border=2),
    "copy part: target": lambda w: copy_part(w.gl, target=NO_TOKEN),
    "copy part: level": lambda w: copy_part(w.gl, level=-1),
    "copy part: level without image": lambda w: copy_part(w.gl, level=1),
    "copy part: outside": lambda w: copy_part(w.gl, x_offset=3),
    "copy part: width": lambda w: copy_part(w.gl, width=-1),
    "parameter: target": lambda w: w.gl.glTexParameteri(NO_TOKEN, w.gl.GL_TEXTURE_MIN_FILTER, w.gl.GL_NEAREST),
    "parameter: name": lambda w: w.gl.glTexParameteri(w.gl.GL_TEXTURE_2D, NO_TOKEN, w.gl.GL_NEAREST),
    "parameter: min filter": lambda w: w.gl.glTexParameteri(w.gl.GL_TEXTURE_2D, w.gl.GL_TEXTURE_MIN_FILTER, 9),
    "parameter: mag filter": lambda w: w.gl.glTexParameteri(
        w.gl.GL_TEXTURE_2D, w.gl.GL_TEXTURE_MAG_FILTER, w.gl.GL_LINEAR_MIPMAP_LINEAR
    ),
    "parameter: wrap": lambda w: w.gl.glTexParameteri(w.gl.GL_TEXTURE_2D, w.gl.GL_TEXTURE_WRAP_S, w.gl.GL_LINEAR),
    "parameter: compare mode": lambda w: w.gl.glTexParameteri(
        w.gl.GL_TEXTURE_2D, w.gl.GL_TEXTURE_COMPARE_MODE, w.gl.GL_LEQUAL
    ),
    "parameter: compare function": lambda w: w.gl.glTexParameteri(
        w.gl.GL_TEXTURE_2D, w.gl.GL_TEXTURE_COMPARE_FUNC, w.gl.GL_NONE
    ),
    "parameter: depth mode": lambda w: w.gl.glTexParameteri(
        w.gl.GL_TEXTURE_2D, w.gl.GL_DEPTH_TEXTURE_MODE, w.gl.GL_RGBA
    ),
    "parameter: base level": lambda w: w.gl.glTexParameteri(w.gl.GL_TEXTURE_2D, w.gl.GL_TEXTURE_BASE_LEVEL, -1),
    "parameter: one number for a colour": lambda w: w.gl.glTexParameteri(
        w.gl.GL_TEXTURE_2D, w.gl.GL_TEXTURE_BORDER_COLOR, 1
    ),
    "query: target": lambda w: w.gl.glGetTexParameteriv(NO_TOKEN, w.gl.GL_TEXTURE_WRAP_S),
    "level query: target": lambda w: w.gl.glGetTexLevelParameteriv(NO_TOKEN, 0, w.gl.GL_TEXTURE_WIDTH),
    "level query: level": lambda w: w.gl.glGetTexLevelParameteriv(w.gl.GL_TEXTURE_2D, -1, w.gl.GL_TEXTURE_WIDTH),
    "get image: depth of colours": lambda w: w.gl.glGetTexImage(
        w.gl.GL_TEXTURE_2D, 0, w.gl.GL_DEPTH_COMPONENT, w.gl.GL_FLOAT
    ),
    "get image: level": lambda w: w.gl.glGetTexImage(w.gl.GL_TEXTURE_2D, -1, w.gl.GL_RGBA, w.gl.GL_FLOAT),
    "get image: stencil of colours": lambda w: w.gl.glGetTexImage(
        w.gl.GL_TEXTURE_2D, 0, w.gl.GL_STENCIL_INDEX, w.gl.GL_UNSIGNED_BYTE
    ),
    "read: format": lambda w: read(w.gl, NO_TOKEN, w.gl.GL_UNSIGNED_BYTE),
    "read: intensity": lambda w: read(w.gl, w.gl.GL_INTENSITY, w.gl.GL_UNSIGNED_BYTE),
    "read: type": lambda w: read(w.gl, w.gl.GL_RGBA, NO_TOKEN),
    "read: width": lambda w: read(w.gl, w.gl.GL_RGBA, w.gl.GL_UNSIGNED_BYTE, -1),
    "read: type of packed format": lambda w: read(w.gl, w.gl.GL_DEPTH_STENCIL, w.gl.GL_UNSIGNED_BYTE),
    "read: packed type": lambda w: read(w.gl, w.gl.GL_RGBA, w.gl.GL_UNSIGNED_INT_24_8),
    "read: packed float type": lambda w: read(w.gl, w.gl.GL_DEPTH_COMPONENT, w.gl.GL_FLOAT_32_UNSIGNED_INT_24_8_REV),
    "read: no depth": lambda w: inside(w, lambda: read(w.gl, w.gl.GL_DEPTH_COMPONENT, w.gl.GL_FLOAT)),
    "read: no stencil": lambda w: inside(w, lambda: read(w.gl, w.gl.GL_STENCIL_INDEX, w.gl.GL_UNSIGNED_BYTE)),
    "pixel store: alignment": lambda w: w.gl.glPixelStorei(w.gl.GL_PACK_ALIGNMENT, 3),
    "pixel store: name": lambda w: w.gl.glPixelStorei(NO_TOKEN, 1),
    "pixel store: row length": lambda w: w.gl.glPixelStorei(w.gl.GL_UNPACK_ROW_LENGTH, -1),
    "active texture": lambda w: w.gl.glActiveTexture(NO_TOKEN),
    "environment: target": lambda w: w.gl.glTexEnvi(NO_TOKEN, w.gl.GL_TEXTURE_ENV_MODE, w.gl.GL_REPLACE),
    "environment: name": lambda w: w.gl.glTexEnvi(w.gl.GL_TEXTURE_ENV, NO_TOKEN, w.gl.GL_REPLACE),
    "environment: mode": lambda w: w.gl.glTexEnvi(w.gl.GL_TEXTURE_ENV, w.gl.GL_TEXTURE_ENV_MODE, w.gl.GL_RGBA),
    "generation: coordinate": lambda w: w.gl.glTexGeni(NO_TOKEN, w.gl.GL_TEXTURE_GEN_MODE, w.gl.GL_EYE_LINEAR),
    "generation: name": lambda w: w.gl.glTexGeni(w.gl.GL_S, NO_TOKEN, w.gl.GL_EYE_LINEAR),
    "environment: name of filter control": lambda w: w.gl.glTexEnvf(
        w.gl.GL_TEXTURE_FILTER_CONTROL, w.gl.GL_TEXTURE_ENV_MODE, 1.0
    ),
    "environment: bias": lambda w: w.gl.glTexEnvf(w.gl.GL_TEXTURE_ENV, w.gl.GL_TEXTURE_LOD_BIAS, 1.0),
    "environment query: name of filter control": lambda w: w.gl.glGetTexEnvfv(
        w.gl.GL_TEXTURE_FILTER_CONTROL, w.gl.GL_TEXTURE_ENV_MODE
    ),
    "generation: sphere map of r": lambda w: w.gl.glTexGeni(w.gl.GL_R, w.gl.GL_TEXTURE_GEN_MODE, w.gl.GL_SPHERE_MAP),
    "generation: sphere map of q": lambda w: w.gl.glTexGeni(w.gl.GL_Q, w.gl.GL_TEXTURE_GEN_MODE, w.gl.GL_SPHERE_MAP),
    "generation: normal map of q": lambda w: w.gl.glTexGeni(w.gl.GL_Q, w.gl.GL_TEXTURE_GEN_MODE, w.gl.GL_NORMAL_MAP),
    "generation: reflection of q": lambda w: w.gl.glTexGenfv(
        w.gl.GL_Q, w.gl.GL_TEXTURE_GEN_MODE, [w.gl.GL_REFLECTION_MAP]
    ),
    "generation: mode": lambda w: w.gl.glTexGeni(w.gl.GL_S, w.gl.GL_TEXTURE_GEN_MODE, NO_TOKEN),
    "bind framebuffer: target": lambda w: w.gl.glBindFramebuffer(NO_TOKEN, 0),
    "attach: to the window": lambda w: w.gl.glFramebufferTexture2D(
        w.gl.GL_FRAMEBUFFER, w.gl.GL_COLOR_ATTACHMENT0, w.gl.GL_TEXTURE_2D, w.texture, 0
    ),
    "attach: target": lambda w: attach(w, target=NO_TOKEN),
    "attach: attachment": lambda w: attach(w, attachment=NO_TOKEN),
    "attach: ninth colour": lambda w: attach(w, attachment=w.gl.GL_COLOR_ATTACHMENT0 + 9),
    "attach: no texture": lambda w: attach(w, texture=55),
    "attach: unbound name": lambda w: attach(w, texture=w.unbound),
    "attach: textarget": lambda w: attach(w, textarget=NO_TOKEN),
    "attach: a face": lambda w: attach(w, textarget=w.gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X),
    "attach: level": lambda w: attach(w, level=-1),
    "attach: level 20": lambda w: attach(w, level=20),
    "status: target": lambda w: w.gl.glCheckFramebufferStatus(NO_TOKEN),
    "draw buffer: of the window": lambda w: w.gl.glDrawBuffer(w.gl.GL_COLOR_ATTACHMENT0),
    "draw buffer: missing in the window": lambda w: w.gl.glDrawBuffer(w.gl.GL_FRONT_RIGHT),
    "draw buffer: token": lambda w: w.gl.glDrawBuffer(7),
    "draw buffer: back of an object": lambda w: inside(w, lambda: w.gl.glDrawBuffer(w.gl.GL_BACK)),
    "draw buffers: token": lambda w: inside(w, lambda: w.gl.glDrawBuffers(1, [7])),
    "draw buffers: nine": lambda w: inside(w, lambda: w.gl.glDrawBuffers(9, [0] * 9)),
    "draw buffers: front": lambda w: inside(w, lambda: w.gl.glDrawBuffers(1, [w.gl.GL_FRONT])),
    "read buffer: token": lambda w: w.gl.glReadBuffer(7),
    "read buffer: back of an object": lambda w: inside(w, lambda: w.gl.glReadBuffer(w.gl.GL_BACK)),
    "bind renderbuffer: target": lambda w: w.gl.glBindRenderbuffer(NO_TOKEN, 0),
    "storage: no renderbuffer": lambda w: w.gl.glRenderbufferStorage(w.gl.GL_RENDERBUFFER, w.gl.GL_RGBA8, 4, 4),
    "use program: name": lambda w: w.gl.glUseProgram(99),
    "location: program": lambda w: w.gl.glGetUniformLocation(99, "bias"),
    "uniform: no program in use": lambda w: w.gl.glUniform1f(0, 1.0),
    "uniform: int for a float": lambda w: in_use(w, "bias", lambda at: w.gl.glUniform1i(at, 1)),
    "uniform: vec2 for a float": lambda w: in_use(w, "bias", lambda at: w.gl.glUniform2f(at, 1, 2)),
    "uniform: vec3 for a vec4": lambda w: in_use(w, "ambient", lambda at: w.gl.glUniform3f(at, 1, 2, 3)),
    "uniform: two for one": lambda w: in_use(w, "ambient", lambda at: w.gl.glUniform4fv(at, 2, [1.0] * 8)),
    "uniform: count": lambda w: in_use(w, "ambient", lambda at: w.gl.glUniform4fv(at, -1, [1.0] * 4)),
    "uniform: float for a sampler": lambda w: in_use(w, "shadowMap", lambda at: w.gl.glUniform1f(at, 1)),
    "uniform: unit of a sampler": lambda w: in_use(w, "shadowMap", lambda at: w.gl.glUniform1i(at, 1000)),
    "uniform: location": lambda w: in_use(w, "bias", lambda at: w.gl.glUniform1f(500, 1)),
    "uniform: matrix for a float": lambda w: in_use(
        w, "bias", lambda at: w.gl.glUniformMatrix4fv(at, 1, False, np.eye(4, dtype=np.float32))
    ),
    "uniform: float for a matrix": lambda w: in_use(w, "lightMatrix", lambda at: w.gl.glUniform1f(at, 1)),
}
