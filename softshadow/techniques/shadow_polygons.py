"""Own and cast shadows as detail polygons, drawn over the faces they lie on.

A face turned away from the light is dark as a whole. The faces between the light and a face turned towards it are
flattened onto that face and cut at its edges. This needs no camera: `shadow_polygons` computes the polygons, and `draw`
draws them from any camera. They lie in the planes of the faces, so the depth test cannot decide between the two:
`offset` moves the polygons a little nearer, `decal` marks each face first and draws its polygons there without the
depth test.

Paper: Atherton, Weiler & Greenberg 1978, "Polygon shadow generation".
Slides: Moldoveanu "umbre 1", own- and cast-shadow polygons, added to the faces as detail polygons.

Known failures: every face is compared with every other, so scenes with too many faces are refused; where the polygons
of two faces meet, differently rounded corners may leave a pixel lit; edges are hard. offset reaches up to a pixel over
the edge of nearer objects, as over the feet of casters; with factor and units 0 faces and polygons fight for the pixel.
depth-off, the slides' own way, paints over nearer objects. `combine` = modulate takes a share of the whole colour:
faces turned away from the light get darker than the ambient light leaves them, and shadows of several lights multiply.
"""

from collections.abc import Sequence
from typing import Annotated, Any, Literal

import numpy as np

from softshadow.scene import Light, Scene, SceneObject
from softshadow.techniques import drawing
from softshadow.techniques.detail_polygons import DetailPolygons, Form, shadow_polygons
from softshadow.techniques.planar import DARKNESS
from softshadow.techniques.technique import Steps

# bits of the stencil buffer: shadow, and the face that a decal is drawn on
SHADOW, FACE = 0x01, 0x02

Method = Literal["offset", "decal", "depth-off"]
Combine = Literal["add", "modulate"]


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    form: Annotated[Form, "what is flattened: every casting face, or the silhouettes"] = "faces",
    method: Annotated[Method, "how faces and polygons share their planes"] = "decal",
    factor: Annotated[float, "offset: first argument of glPolygonOffset; negative is nearer"] = -1.0,
    units: Annotated[float, "offset: second argument of glPolygonOffset"] = -1.0,
    combine: Annotated[
        Combine, "add every light where its polygons are not, or darken the fully lit scene where they are"
    ] = "add",
) -> Steps:
    """Draw the scene with shadow polygons."""
    polygons = [shadow_polygons(scene, light, form) for light in scene.lights]
    yield from draw(gl, scene, size, polygons, method=method, offset=(factor, units), combine=combine)


def draw(
    gl: Any,
    scene: Scene,
    size: tuple[int, int],
    polygons: Sequence[Sequence[DetailPolygons]],
    *,
    method: Method = "decal",
    offset: tuple[float, float] = (-1.0, -1.0),
    combine: Combine = "add",
) -> Steps:
    """Draw the scene from its camera with polygons computed before, one entry for each light and object.

    The polygons stay right as long as lights and objects do not move.
    """
    # 1. draw the scene
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size)
    if combine == "add":
        drawing.light_ambient_only(gl, scene)
    else:
        drawing.light_by(gl, scene, scene.lights, ambient=True)
    drawing.draw_objects(gl, scene.objects)
    depth = drawing.read_depth(gl, size)
    valid = depth < 1
    yield "draw the scene without the light" if combine == "add" else "draw the scene with all lights"

    lit = []
    for light, on_objects in zip(scene.lights, polygons, strict=True):
        # 2. draw the polygons into the stencil buffer
        begin_marks(gl)
        for thing, details in zip(scene.objects, on_objects, strict=True):
            if method == "offset":
                with_offset(gl, scene, thing, details, offset)
            elif method == "decal":
                as_decals(gl, scene, thing, details)
            else:
                without_depth(gl, scene, thing, details)
        end_marks(gl)
        lit.append((drawing.read_stencil(gl, size) & SHADOW == 0) & drawing.within_cone(scene, light, depth, size))
        yield drawing.title("mark the shadow polygons", scene, light)

        # 3. draw the lit part of the scene, or darken the rest
        if combine == "add":
            add_light(gl, scene, light)
        else:
            gl.glStencilFunc(gl.GL_EQUAL, SHADOW, SHADOW)
            drawing.darken_picture(gl, DARKNESS)
        gl.glDisable(gl.GL_STENCIL_TEST)
        title = "add the light where no polygon is" if combine == "add" else "darken the marked pixels"
        yield drawing.title(title, scene, light), drawing.visibility_maps(scene, lit, valid)


# -- polygons over faces -----------------------------------------------------------------------------------------------


def with_offset(
    gl: Any, scene: Scene, thing: SceneObject, details: DetailPolygons, offset: tuple[float, float]
) -> None:
    """Mark the polygons of an object where they are visible, drawn a little nearer than the faces they lie on."""
    gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
    gl.glPolygonOffset(*offset)
    draw_own(gl, thing, details)
    draw_cast(gl, scene, thing, details)
    gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)


def as_decals(gl: Any, scene: Scene, thing: SceneObject, details: DetailPolygons) -> None:
    """Mark each visible face, draw its polygons there without the depth test, then clear the mark."""
    draw_own(gl, thing, details)  # these are the faces themselves, so their depths are equal bit for bit
    for face in np.unique(details.faces):
        gl.glStencilMask(FACE)
        gl.glStencilFunc(gl.GL_ALWAYS, FACE, 0xFF)
        draw_faces(gl, thing, [face])
        gl.glStencilMask(SHADOW)
        gl.glStencilFunc(gl.GL_EQUAL, FACE | SHADOW, FACE)
        gl.glDisable(gl.GL_DEPTH_TEST)
        draw_cast(gl, scene, thing, details, np.flatnonzero(details.faces == face))
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glStencilMask(FACE)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
        draw_faces(gl, thing, [face])
    gl.glStencilMask(0xFF)
    gl.glStencilFunc(gl.GL_ALWAYS, SHADOW, 0xFF)


def without_depth(gl: Any, scene: Scene, thing: SceneObject, details: DetailPolygons) -> None:
    """Mark the polygons of an object everywhere in the picture, behind other faces, too (E15)."""
    gl.glDisable(gl.GL_DEPTH_TEST)
    draw_own(gl, thing, details)
    draw_cast(gl, scene, thing, details)
    gl.glEnable(gl.GL_DEPTH_TEST)


def draw_own(gl: Any, thing: SceneObject, details: DetailPolygons) -> None:
    """Draw the dark sides of the faces that are in their own shadow."""
    gl.glEnable(gl.GL_CULL_FACE)
    draw_faces(gl, thing, details.own, "face in its own shadow")
    gl.glFrontFace(gl.GL_CW)
    draw_faces(gl, thing, details.own_reversed, "face in its own shadow")
    gl.glFrontFace(gl.GL_CCW)
    gl.glDisable(gl.GL_CULL_FACE)


def draw_faces(gl: Any, thing: SceneObject, faces: Sequence[int] | np.ndarray, part: str = "marked face") -> None:
    """Draw some faces of an object with the vertices of the object itself."""
    with drawing.object_space(gl, thing), drawing.made_of(gl, part, "face", faces, [thing]):
        drawing.draw_triangles(gl, thing.mesh.positions, np.ascontiguousarray(thing.mesh.triangles[faces]))


def draw_cast(
    gl: Any, scene: Scene, thing: SceneObject, details: DetailPolygons, chosen: np.ndarray | slice = slice(None)
) -> None:
    """Draw the chosen polygons on an object: on a caster one-sided, since its back is in its own shadow anyway."""
    if thing.casts:
        gl.glEnable(gl.GL_CULL_FACE)
    origin = details.caster_faces[chosen], scene.casters, details.casters[chosen]
    with drawing.debug_group(gl, thing), drawing.made_of(gl, "shadow polygon", "face", *origin):
        drawing.draw_polygons(gl, np.ascontiguousarray(details.cast[chosen], np.float32))
    gl.glDisable(gl.GL_CULL_FACE)


# -- marks and light ---------------------------------------------------------------------------------------------------


def begin_marks(gl: Any) -> None:
    """Let draws write `SHADOW` into the stencil buffer and change nothing else; equal depth passes (E2)."""
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    gl.glDisable(gl.GL_LIGHTING)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glDepthMask(gl.GL_FALSE)
    gl.glDepthFunc(gl.GL_LEQUAL)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, SHADOW, 0xFF)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)


def end_marks(gl: Any) -> None:
    """Enable writing of colour and depth again."""
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
    gl.glDepthMask(gl.GL_TRUE)
    gl.glDepthFunc(gl.GL_LESS)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)


def add_light(gl: Any, scene: Scene, light: Light) -> None:
    """Add a light where there is no mark."""
    gl.glStencilFunc(gl.GL_EQUAL, 0, SHADOW)
    drawing.light_by(gl, scene, [light], ambient=False)
    with drawing.additive_blending(gl):
        drawing.draw_objects(gl, scene.objects, emission=False)
