"""Passes of the penumbra wedges: the visible points, the count of the hard volumes, and what each wedge adds to it.

They share a framebuffer, with the depth of the visible points and a float texture to which everything is added. Volumes
and wedges are closed, and only those of their faces count that are behind the visible point.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Any, Literal

import numpy as np

from softshadow.scene import Light, LightShape, Scene, Sphere
from softshadow.scene.light_coverage import flat_axes
from softshadow.scene.penumbra_wedge import PenumbraWedges, SilhouetteEdges, wedge_polyhedra
from softshadow.techniques import drawing, shadow_volumes
from softshadow.techniques.map_lookups import clear_coordinates, draw_looked_up
from softshadow.techniques.shadow_volumes import CasterVolume, draw_volumes
from softshadow.techniques.visibility_buffer import draw_visibility, set_uniforms, visibility_texture

Decide = Literal["planes", "depth"]

WIDEST = 1024  # texels in a row of the texture of edges


@dataclass(frozen=True)
class WedgeBuffers:
    """Names of the framebuffer and its textures.

    Attributes
    ----------
    framebuffer, depth : int     the depth is a renderbuffer
    positions : int              visible points relative to the light, alpha 1 where there is one
    covered : int                alpha: the share of the light that is covered; red and green: what the wedges take and
                                 give back; blue: how many edges are seen in front of the light
    """

    framebuffer: int
    depth: int
    positions: int
    covered: int


def draw_positions(gl: Any, scene: Scene, light: Light, size: tuple[int, int]) -> tuple[WedgeBuffers, np.ndarray]:
    """Return the buffers, and the visible points (h, w, 3) float32 relative to the light; 0 where there is none."""
    buffers = WedgeBuffers(
        gl.glGenFramebuffers(1), gl.glGenRenderbuffers(1), visibility_texture(gl, size), visibility_texture(gl, size)
    )
    gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, buffers.framebuffer)
    gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, buffers.depth)
    gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_DEPTH_COMPONENT24, *size)
    gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_RENDERBUFFER, buffers.depth)
    attach(gl, buffers.positions)
    gl.glClearColor(0.0, 0.0, 0.0, 0.0)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
    drawing.set_camera(gl, scene.camera, size, "infinite")  # so that the far ends of volumes are not cut off
    gl.glDisable(gl.GL_LIGHTING)
    gl.glUseProgram(gl.program("position"))
    set_light_coordinates(gl, light)
    draw_looked_up(gl, scene.objects)
    clear_coordinates(gl)
    attach(gl, buffers.covered)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    gl.glUseProgram(0)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    return buffers, read_texture(gl, buffers.positions)[..., :3]


def attach(gl: Any, texture: int) -> None:
    """Draw into a texture with the framebuffer that is bound."""
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)


def set_light_coordinates(gl: Any, light: Light) -> None:
    """Set the texture matrix: world space to space around the light's centre; nothing moves for a light at infinity."""
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glLoadIdentity()
    gl.glTranslated(*(-light.position[:3] * light.position[3]))
    gl.glMatrixMode(gl.GL_MODELVIEW)


def read_texture(gl: Any, texture: int) -> np.ndarray:
    """Return the texels (h, w, 4) float32 of a float texture."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    values: np.ndarray = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_FLOAT)
    return values


@dataclass(frozen=True, eq=False)
class EdgeTexture:
    """A texture of the ends of edges, relative to the light.

    Attributes
    ----------
    name : int
    row_height : float           of a texel, in texture coordinates
    places : (E, 2) float32      texture coordinates of each edge's first end; the other end is one texel above it
    """

    name: int
    row_height: float
    places: np.ndarray


# -- edges -------------------------------------------------------------------------------------------------------------


def edge_texture(gl: Any, edges: SilhouetteEdges, light: Light) -> EdgeTexture:
    """Return the texture of silhouette edges."""
    number = np.arange(len(edges.ends))
    width = min(max(len(number), 1), WIDEST)
    rows = 2 * (-(-max(len(number), 1) // width))
    texels = np.zeros((rows, width, 4), np.float32)
    row, column = np.divmod(number, width)
    for end in (0, 1):
        texels[2 * row + end, column, :3] = edges.ends[:, end] - light.position[:3]
    name = visibility_texture(gl, (width, rows), texels)
    places = np.column_stack([(column + 0.5) / width, (2 * row + 0.5) / rows]).astype(np.float32)
    return EdgeTexture(name, 1 / rows, places)


def draw_at_places(gl: Any, polygons: np.ndarray, places: np.ndarray) -> None:
    """Draw polygons (N, corners, 4) with one pair of texture coordinates (N, 2) each."""
    corners = np.ascontiguousarray(np.repeat(places, polygons.shape[1], axis=0))
    gl.glEnableClientState(gl.GL_TEXTURE_COORD_ARRAY)
    gl.glTexCoordPointer(2, gl.GL_FLOAT, 0, corners)
    drawing.draw_polygons(gl, polygons)
    gl.glDisableClientState(gl.GL_TEXTURE_COORD_ARRAY)


# -- what is added -----------------------------------------------------------------------------------------------------


@contextmanager
def behind_points(gl: Any, scene: Scene, buffers: WedgeBuffers, size: tuple[int, int]) -> Iterator[None]:
    """Add up what is drawn behind the visible points, where "less" fails."""
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, buffers.framebuffer)
    drawing.set_camera(gl, scene.camera, size, "infinite")
    gl.glEnable(gl.GL_CULL_FACE)
    gl.glDepthMask(gl.GL_FALSE)
    gl.glDepthFunc(gl.GL_GEQUAL)
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
    yield
    gl.glUseProgram(0)
    gl.glDisable(gl.GL_BLEND)
    gl.glDepthFunc(gl.GL_LESS)
    gl.glDepthMask(gl.GL_TRUE)
    gl.glDisable(gl.GL_CULL_FACE)
    gl.glCullFace(gl.GL_BACK)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)


def use_program(gl: Any, name: str, buffers: WedgeBuffers, edges: EdgeTexture) -> int:
    """Use a program that looks up positions and edges; return its number."""
    program: int = gl.program(name)
    gl.glActiveTexture(gl.GL_TEXTURE1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, edges.name)
    gl.glActiveTexture(gl.GL_TEXTURE0)
    gl.glBindTexture(gl.GL_TEXTURE_2D, buffers.positions)
    gl.glUseProgram(program)
    set_uniforms(gl, program, positions=0, edges=1, edgeRow=edges.row_height)
    return program


def count_volumes(
    gl: Any, volumes: Sequence[CasterVolume], buffers: WedgeBuffers, edges: EdgeTexture, decide: Decide
) -> None:
    """Add the hard count, as z-fail does: back faces behind the visible point count up, front faces there count down.

    With `decide` = "planes", the planes of the sides say whether they are behind the point. The ray meets a side once,
    so it is behind the point if eye and point are on the same side of its plane.
    """
    program = use_program(gl, "volume-side", buffers, edges)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_TRUE)
    for culled, count in ((gl.GL_FRONT, 1.0), (gl.GL_BACK, -1.0)):
        gl.glCullFace(culled)
        set_uniforms(gl, program, outside=count, inside=count)
        draw_volumes(gl, volumes, sides=decide == "depth")
        if decide == "planes":
            # the eye is inside where back faces are seen, and outside where front faces are
            set_uniforms(gl, program, outside=min(count, 0.0), inside=max(count, 0.0))
            gl.glDepthFunc(gl.GL_ALWAYS)
            draw_sides(gl, volumes, edges.places)
            gl.glDepthFunc(gl.GL_GEQUAL)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)


def draw_sides(gl: Any, volumes: Sequence[CasterVolume], places: np.ndarray) -> None:
    """Draw the sides of volumes with the places of their edges, which are in the same order."""
    first = 0
    for item in volumes:
        of_volume = places[first : first + len(item.volume.sides)]
        with drawing.object_space(gl, item.caster):
            shadow_volumes.draw_sides(gl, item, partial(draw_at_places, places=of_volume))
        first += len(of_volume)


def add_wedges(
    gl: Any,
    scene: Scene,
    light: Light,
    silhouettes: SilhouetteEdges,
    wedges: PenumbraWedges,
    buffers: WedgeBuffers,
    edges: EdgeTexture,
) -> None:
    """Add what every edge takes of the light or gives back, at the points in its wedge.

    A wedge is convex: drawn by its back faces, it meets each pixel once, and points in it are in front of them.
    """
    assert light.shape is not None
    triangles, owners = wedge_polyhedra(wedges)
    program = use_program(gl, f"wedge-{type(light.shape).__name__.lower()}", buffers, edges)
    set_uniforms(gl, program, **shape_uniforms(light.shape))
    gl.glCullFace(gl.GL_FRONT)
    gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "wedges")
    with drawing.made_of(gl, "wedge", "edge", owners, scene.casters, silhouettes.casters[owners]):
        draw_at_places(gl, triangles, edges.places[owners])
    gl.glPopDebugGroup()


def shape_uniforms(shape: LightShape) -> dict[str, float | tuple[float, ...]]:
    """Return the uniforms of the wedge programs that describe a light."""
    if isinstance(shape, Sphere):
        return {"radius": shape.radius}
    names = ("axisU", "axisV", "normal")
    return {name: tuple(map(float, axis)) for name, axis in zip(names, flat_axes(shape), strict=True)}


def visible_share(
    gl: Any, scene: Scene, light: Light, size: tuple[int, int], buffers: WedgeBuffers
) -> tuple[int, np.ndarray]:
    """Return a texture of what is not covered, from 0 to 1, and its values (h, w) float32."""
    program = gl.program("wedge-visibility")

    def look_up() -> None:
        gl.glBindTexture(gl.GL_TEXTURE_2D, buffers.covered)
        set_light_coordinates(gl, light)
        if light.axis is None:
            set_uniforms(gl, program, squared=-1.0)
        else:
            axis = tuple(map(float, light.axis))
            set_uniforms(gl, program, axis=axis, squared=float(np.cos(np.radians(light.cutoff)) ** 2))

    visibility, values = draw_visibility(gl, scene, size, program, look_up)
    return visibility, values[..., 3]


def delete_buffers(gl: Any, buffers: WedgeBuffers) -> None:
    """Delete the framebuffer and its textures."""
    gl.glDeleteFramebuffers(1, [buffers.framebuffer])
    gl.glDeleteRenderbuffers(1, [buffers.depth])
    gl.glDeleteTextures([buffers.positions, buffers.covered])
