"""Own and cast shadows as detail polygons, drawn over the faces they lie on.

Where a face looks away from the light it is dark as a whole; where it looks to the light, the faces in front of it are
flattened onto it and cut at its edges. That takes no camera: `shadow_polygons` makes the polygons, `draw` draws them
from any. They lie in the faces, so that the depth test needs help: `offset` moves them a little nearer, `decal` marks
each face first and draws its polygons without the depth test where the mark is.

Paper: Atherton, Weiler & Greenberg 1978, "Polygon shadow generation".
Slides: Moldoveanu "umbre 1", own- and cast-shadow polygons, added to the faces as detail polygons.

Known failures: every face is held against every other, so scenes of too many faces are refused; where the polygons of
two faces meet, corners rounded apart may leave a pixel lit; edges are hard. offset reaches up to a pixel over the edge
of what stands nearer, as over the feet of casters; with factor and units 0 faces and polygons fight. depth-off, the
slides' own way, paints over whatever is nearer. `combine` = modulate takes a share of the whole colour: faces that the
light does not reach anyway get darker than the ambient light leaves them, and shadows of several lights multiply.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from softshadow.scene import Light, Scene, SceneObject
from softshadow.techniques.detail_polygons import FORMS, DetailPolygons, shadow_polygons
from softshadow.techniques.drawing import (
    added,
    begin_frame,
    darken_picture,
    draw_objects,
    draw_polygons,
    draw_triangles,
    light_ambient_only,
    light_by,
    named,
    object_space,
    read_depth,
    read_stencil,
    set_camera,
    title_of,
    visibility_maps,
    within_cone,
)
from softshadow.techniques.planar import DARKNESS
from softshadow.techniques.technique import Option, Steps

OPTIONS = {
    "form": Option("faces", str, "what is flattened: every casting face, or the silhouettes", choices=FORMS),
    "method": Option(
        "offset", str, "how faces and polygons share their planes", choices=("offset", "decal", "depth-off")
    ),
    "factor": Option(-1.0, float, "offset: first argument of glPolygonOffset; negative is nearer"),
    "units": Option(-1.0, float, "offset: second argument of glPolygonOffset"),
    "combine": Option(
        "add",
        str,
        "add every light where its polygons are not, or darken the fully lit scene where they are",
        choices=("add", "modulate"),
    ),
}

# the stencil buffer: shadow in one bit, the face that a decal is drawn on in others
SHADOW, FACE = 0x01, 0x02


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    form: str = "faces",
    method: str = "offset",
    factor: float = -1.0,
    units: float = -1.0,
    combine: str = "add",
) -> Steps:
    """Draw the scene with shadow polygons; see `OPTIONS`."""
    polygons = [shadow_polygons(scene, light, form) for light in scene.lights]  # type: ignore[arg-type]
    yield from draw(gl, scene, size, polygons, method=method, offset=(factor, units), combine=combine)


def draw(
    gl: Any,
    scene: Scene,
    size: tuple[int, int],
    polygons: Sequence[Sequence[DetailPolygons]],
    *,
    method: str = "offset",
    offset: tuple[float, float] = (-1.0, -1.0),
    combine: str = "add",
) -> Steps:
    """Draw the scene from its camera with polygons made before: for each light, for each object.

    They stay right for as long as lights and objects stand still.
    """
    # 1. draw the scene
    begin_frame(gl, scene)
    set_camera(gl, scene.camera, size)
    if combine == "add":
        light_ambient_only(gl, scene)
    else:
        light_by(gl, scene, scene.lights, ambient=True)
    draw_objects(gl, scene.objects)
    depth = read_depth(gl, size)
    valid = depth < 1
    yield "draw the scene without the light" if combine == "add" else "draw the scene with all lights"

    lit = []
    for light, on_objects in zip(scene.lights, polygons, strict=True):
        # 2. draw the polygons into the stencil buffer
        begin_marks(gl)
        for thing, details in zip(scene.objects, on_objects, strict=True):
            if method == "offset":
                with_offset(gl, thing, details, offset)
            elif method == "decal":
                as_decals(gl, thing, details)
            else:
                without_depth(gl, thing, details)
        end_marks(gl)
        lit.append((read_stencil(gl, size) & SHADOW == 0) & within_cone(scene, light, depth, size))
        yield title_of("mark the shadow polygons", scene, light)

        # 3. draw the lit part of the scene, or darken the rest
        if combine == "add":
            add_light(gl, scene, light)
        else:
            gl.glStencilFunc(gl.GL_EQUAL, SHADOW, SHADOW)
            darken_picture(gl, DARKNESS)
        gl.glDisable(gl.GL_STENCIL_TEST)
        title = "add the light where no polygon is" if combine == "add" else "darken the marked pixels"
        yield title_of(title, scene, light), visibility_maps(scene, lit, valid)


# -- polygons over faces -----------------------------------------------------------------------------------------------


def with_offset(gl: Any, thing: SceneObject, details: DetailPolygons, offset: tuple[float, float]) -> None:
    """Mark the polygons of an object where they are seen, a little nearer than the faces they lie on."""
    gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
    gl.glPolygonOffset(*offset)
    draw_own(gl, thing, details)
    draw_cast(gl, thing, details.cast)
    gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)


def as_decals(gl: Any, thing: SceneObject, details: DetailPolygons) -> None:
    """Mark each face where it is seen, then its polygons there without the depth test, then take the mark away."""
    draw_own(gl, thing, details)  # whole faces have the depth of the faces, bit for bit
    for face in np.unique(details.faces):
        gl.glStencilMask(FACE)
        gl.glStencilFunc(gl.GL_ALWAYS, FACE, 0xFF)
        draw_faces(gl, thing, [face])
        gl.glStencilMask(SHADOW)
        gl.glStencilFunc(gl.GL_EQUAL, FACE | SHADOW, FACE)
        gl.glDisable(gl.GL_DEPTH_TEST)
        draw_cast(gl, thing, details.cast[details.faces == face])
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glStencilMask(FACE)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
        draw_faces(gl, thing, [face])
    gl.glStencilMask(0xFF)
    gl.glStencilFunc(gl.GL_ALWAYS, SHADOW, 0xFF)


def without_depth(gl: Any, thing: SceneObject, details: DetailPolygons) -> None:
    """Mark the polygons of an object wherever they are in the picture, behind other faces, too (E15)."""
    gl.glDisable(gl.GL_DEPTH_TEST)
    draw_own(gl, thing, details)
    draw_cast(gl, thing, details.cast)
    gl.glEnable(gl.GL_DEPTH_TEST)


def draw_own(gl: Any, thing: SceneObject, details: DetailPolygons) -> None:
    """Draw the faces in their own shadow, only their dark sides."""
    gl.glEnable(gl.GL_CULL_FACE)
    draw_faces(gl, thing, details.own)
    gl.glFrontFace(gl.GL_CW)
    draw_faces(gl, thing, details.own_reversed)
    gl.glFrontFace(gl.GL_CCW)
    gl.glDisable(gl.GL_CULL_FACE)


def draw_faces(gl: Any, thing: SceneObject, faces: Sequence[int] | np.ndarray) -> None:
    """Draw some faces of an object with the vertices of the object itself."""
    with object_space(gl, thing):
        draw_triangles(gl, thing.mesh.positions, np.ascontiguousarray(thing.mesh.triangles[faces]))


def draw_cast(gl: Any, thing: SceneObject, polygons: np.ndarray) -> None:
    """Draw polygons (N, 3, 3) on an object; the back of a caster is in its own shadow, what does not cast has none."""
    if thing.casts:
        gl.glEnable(gl.GL_CULL_FACE)
    with named(gl, thing):
        draw_polygons(gl, np.ascontiguousarray(polygons, np.float32))
    gl.glDisable(gl.GL_CULL_FACE)


# -- marks and light ---------------------------------------------------------------------------------------------------


def begin_marks(gl: Any) -> None:
    """Let what is drawn leave `SHADOW` in the stencil buffer and nothing else; equal depth passes (E2)."""
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    gl.glDisable(gl.GL_LIGHTING)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glDepthMask(gl.GL_FALSE)
    gl.glDepthFunc(gl.GL_LEQUAL)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, SHADOW, 0xFF)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)


def end_marks(gl: Any) -> None:
    """Let colour and depth be written again."""
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
    gl.glDepthMask(gl.GL_TRUE)
    gl.glDepthFunc(gl.GL_LESS)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)


def add_light(gl: Any, scene: Scene, light: Light) -> None:
    """Add a light where nothing is marked."""
    gl.glStencilFunc(gl.GL_EQUAL, 0, SHADOW)
    light_by(gl, scene, [light], ambient=False)
    with added(gl):
        draw_objects(gl, scene.objects)
