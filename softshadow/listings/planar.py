"""Projected planar shadows: the slides CA:60-168 and CA:292-396 (again CA:706-784), SK:139-180, RO1:64-68.

``dibuixa(receptor)`` is ``draw(gl, stage.receiver)``. ``MatriuProjeccio`` is the matrix of SK:153, whose sign is right,
except in the two listings about the matrix itself. The shader of CA:149-167 becomes fixed function: its uniform
``shadow`` is lighting switched off, its ``modelMatrix`` the modelview matrix.
"""

from typing import Any

import numpy as np

from softshadow.listings.listing import Listing, Steps
from softshadow.listings.projection import along_direction, along_rays, from_origin, from_point, onto_ground
from softshadow.listings.stage import LOW_LAMP, OVER_THE_EDGE, STAGE, Stage, Thing, begin_frame, draw, draw_faces
from softshadow.scene import Mesh, casting_faces

GROUND = (0.0, 1.0, 0.0, 0.0)


def multiply(gl: Any, matrix: np.ndarray) -> None:
    """Call glMultMatrixf with a matrix of rows; GL stores matrices by columns."""
    gl.glMultMatrixf(np.ascontiguousarray(matrix.T, np.float32))


def mark(gl: Any) -> None:
    """Let the draws that follow mark their pixels with 1 in the stencil buffer."""
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, 1, 255)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)


def draw_where_marked(gl: Any) -> None:
    """Let the draws that follow change marked pixels only, and no mark."""
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_EQUAL, 1, 255)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)


def three_steps(
    gl: Any, corrected: frozenset[str], stage: Stage = STAGE, projection: np.ndarray | None = None
) -> Steps:
    """CA:60-96, Ombres per projecció (un pla): receiver, flattened occluder without depth test, occluder."""
    begin_frame(gl, stage)
    if "E33" in corrected:
        mark(gl)  # E33: the flattened occluder may reach beyond the receiver's edge
    # 1. Dibuixar receptor
    draw(gl, stage.receiver)
    yield "1. the receiver"

    # 2. Dibuixar l'oclusor projectat (ombra)
    if "E33" in corrected:
        draw_where_marked(gl)
    gl.glDisable(gl.GL_LIGHTING)
    gl.glDisable(gl.GL_DEPTH_TEST)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glPushMatrix()
    multiply(gl, onto_ground(stage.light) if projection is None else projection)
    draw(gl, stage.occluder)
    gl.glPopMatrix()
    if "E33" in corrected:
        gl.glDisable(gl.GL_STENCIL_TEST)
    yield "2. the flattened occluder"

    # 3. Dibuixar oclusor
    gl.glEnable(gl.GL_LIGHTING)
    gl.glEnable(gl.GL_DEPTH_TEST)
    draw(gl, stage.occluder if "E34" in corrected else stage.emitter)  # E34: printed "dibuixa(emissor)"
    yield "3. the occluder"


def matrix_from_point(gl: Any, corrected: frozenset[str], stage: Stage = STAGE) -> Steps:
    """CA:371-383, Projecció respecte punt: the three steps with this matrix on the ground's plane."""
    # E35: (0, 1, 0, 0), with the light on its positive side, gives w < 0 everywhere
    plane = (0.0, -1.0, 0.0, 0.0) if "E35" in corrected else GROUND
    yield from three_steps(gl, frozenset({"E33", "E34"}), stage, from_point(plane, stage.light))


def matrix_from_origin(gl: Any, corrected: frozenset[str], stage: Stage = STAGE) -> Steps:
    """CA:361-369, Projecció respecte l'origen: between translations that bring the lamp to the origin and back."""
    a, b, c, d = (0.0, -1.0, 0.0, 0.0) if "E35" in corrected else GROUND  # E35: the same sign as for a point
    light = np.array(stage.light[:3])
    moved_plane = (a, b, c, float(d + np.array([a, b, c]) @ light))  # as seen from the lamp
    to_light, back = np.eye(4), np.eye(4)
    to_light[:3, 3], back[:3, 3] = light, -light
    yield from three_steps(gl, frozenset({"E33", "E34"}), stage, to_light @ from_origin(moved_plane) @ back)


def matrix_along_direction(gl: Any, corrected: frozenset[str], stage: Stage = STAGE) -> Steps:
    """CA:385-396, Projecció en la direcció (x,y,z): the three steps with this matrix, the lamp far away."""
    towards = np.array(stage.light[:3]) - np.array(stage.target)
    # E36: "la direcció" reads as the direction in which light travels; w > 0 needs the direction towards the light
    direction = towards if "E36" in corrected else -towards
    yield from three_steps(gl, frozenset({"E33", "E34"}), stage, along_direction(GROUND, direction.tolist()))


def rays(gl: Any, corrected: frozenset[str], stage: Stage = LOW_LAMP) -> Steps:
    """SK:139-153, Projekčné tiene: every vertex along its ray onto y = 0, the lamp low among the casters."""
    begin_frame(gl, stage)
    if "E33" in corrected:
        mark(gl)  # E33: the shadow of a caster that reaches up to the lamp is infinite
    draw(gl, stage.receiver)
    yield "the receiver"

    if "E33" in corrected:
        draw_where_marked(gl)
    gl.glDisable(gl.GL_LIGHTING)
    gl.glDisable(gl.GL_DEPTH_TEST)
    if "E21" in corrected:
        # E21: GL clips w < 0, above the lamp, if it does the division; casters below the ground must be left out
        gl.glPushMatrix()
        multiply(gl, onto_ground(stage.light))
        draw(gl, [thing for thing in stage.occluder if thing.mesh.positions[:, 1].min() >= 0])
        gl.glPopMatrix()
    else:
        draw(gl, [flattened(thing, stage) for thing in stage.occluder])
    if "E33" in corrected:
        gl.glDisable(gl.GL_STENCIL_TEST)
    yield "the occluders along their rays"

    gl.glEnable(gl.GL_LIGHTING)
    gl.glEnable(gl.GL_DEPTH_TEST)
    draw(gl, stage.occluder)
    yield "the occluders"


def flattened(thing: Thing, stage: Stage) -> Thing:
    """Return a thing with its vertices projected onto the ground along the rays of the lamp."""
    mesh = thing.mesh
    return Thing(
        Mesh(along_rays(mesh.positions, stage.light), mesh.triangles, mesh.normals, name=mesh.name), thing.color
    )


def with_offset(gl: Any, corrected: frozenset[str], stage: Stage = STAGE, receiver: bool = True) -> Steps:
    """CA:147-168, CastShadows::paintGL, with or without its receiver."""
    begin_frame(gl, stage)
    if "E33" in corrected:
        mark(gl)  # E33, as in the version without an offset
    # 1. Dibuixar receptor
    if receiver:
        draw(gl, stage.receiver)
    yield "1. the receiver"

    # 2. Dibuixar l'oclusor projectat (ombra)
    if "E33" in corrected:
        draw_where_marked(gl)
    gl.glDisable(gl.GL_LIGHTING)  # phongShader->setUniform("shadow", true)
    gl.glPushMatrix()
    multiply(gl, onto_ground(stage.light))  # phongShader->setUniform("modelMatrix", ...)
    gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
    gl.glPolygonOffset(-1, -1)
    draw(gl, stage.occluder)
    if "E33" in corrected:
        gl.glDisable(gl.GL_STENCIL_TEST)
    yield "2. the flattened occluder"

    # 3. Dibuixar oclusor
    gl.glEnable(gl.GL_LIGHTING)  # phongShader->setUniform("shadow", false)
    gl.glPopMatrix()  # phongShader->setUniform("modelMatrix", identity)
    gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
    draw(gl, stage.occluder)
    yield "3. the occluder"


def with_offset_again(gl: Any, corrected: frozenset[str], stage: Stage = STAGE) -> Steps:
    """CA:706-727, the second printing of CastShadows::paintGL: E68, drawReceiver() is commented out."""
    yield from with_offset(gl, corrected, stage, receiver="E68" in corrected)


def with_stencil(gl: Any, corrected: frozenset[str], stage: Stage = STAGE, mask: int = 1) -> Steps:
    """CA:292-359, Ombres per projecció (amb stencil), right as printed (E41); CA:743-784 has the mask 255 in step 2."""
    begin_frame(gl, stage)
    # 1. Dibuixa el receptor al color buffer i al stencil buffer
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, 1, 1)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    draw(gl, stage.receiver)
    yield "1. the receiver, marked in the stencil buffer"

    # 2. Dibuixa oclusor per netejar l'stencil a les zones a l'ombra
    gl.glDisable(gl.GL_DEPTH_TEST)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glStencilFunc(gl.GL_EQUAL, 1, mask)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_ZERO)
    gl.glPushMatrix()
    multiply(gl, onto_ground(stage.light))
    draw(gl, stage.occluder)
    gl.glPopMatrix()
    yield "2. clear the marks in the shadow"

    # 3. Dibuixa la part fosca del receptor
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glDepthFunc(gl.GL_LEQUAL)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
    gl.glDisable(gl.GL_LIGHTING)
    gl.glStencilFunc(gl.GL_EQUAL, 0, 1)
    draw(gl, stage.receiver)
    yield "3. the dark part of the receiver"

    # 4. Dibuixa l'oclusor
    gl.glEnable(gl.GL_LIGHTING)
    gl.glDepthFunc(gl.GL_LESS)
    gl.glDisable(gl.GL_STENCIL_TEST)
    draw(gl, stage.occluder)
    yield "4. the occluder"


def with_stencil_255(gl: Any, corrected: frozenset[str], stage: Stage = STAGE) -> Steps:
    """CA:743-784: glStencilFunc(GL_EQUAL, 1, 255) in step 2; its comment "1 = 1?" is true for both masks."""
    yield from with_stencil(gl, corrected, stage, mask=255)


def darkened(gl: Any, corrected: frozenset[str], stage: Stage = STAGE) -> Steps:
    """SK:163-171, Základný algoritmus: render the scene, then for each receiver the flattened casters in dark."""
    begin_frame(gl, stage)
    if "E33" in corrected:
        mark(gl)  # E33: the flattened casters may reach beyond the receiver's edge
    draw(gl, stage.receiver)  # render scenu (uplné osvetlenie)
    if "E33" in corrected:
        gl.glDisable(gl.GL_STENCIL_TEST)
    if "E60" not in corrected:
        draw(gl, stage.occluder)  # E60: the scene is the casters, too
    yield "the lit receiver" if "E60" in corrected else "the lit scene"

    if "E33" in corrected:
        draw_where_marked(gl)
    gl.glDisable(gl.GL_LIGHTING)
    if "E60" in corrected:
        gl.glDisable(gl.GL_DEPTH_TEST)  # E60: the depths of receiver and shadow are equal but for rounding
    for _ in stage.receiver:  # pre každý zatienený polygon; here it is one, the ground
        matrix = onto_ground(stage.light)  # vypočítaj projekčnú maticu M
        gl.glPushMatrix()
        multiply(gl, matrix)  # vynasobenie s aktuálnou transformáciou (modelview)
        draw(gl, stage.occluder)  # render vyznačenú (occluder) geometriu, darken/black
        gl.glPopMatrix()
    if "E33" in corrected:
        gl.glDisable(gl.GL_STENCIL_TEST)
    yield "the flattened occluder"

    if "E60" in corrected:
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_LIGHTING)
        draw(gl, stage.occluder)  # E60: casters are drawn after their shadows
        yield "the occluder"


def shadow_polygons(gl: Any, corrected: frozenset[str], stage: Stage = STAGE) -> Steps:
    """RO1:41-68, Umbre planare, functia Update: the scene, then the polygons of own and cast shadows over it."""
    begin_frame(gl, stage)
    if "E16" in corrected:
        mark(gl)  # E16: a projection ends where its receiver does
    draw(gl, stage.receiver)  # 1. Se cere rasterizarea poligoanelor scenei.
    if "E16" in corrected:
        gl.glDisable(gl.GL_STENCIL_TEST)
    draw(gl, stage.occluder)
    yield "1. the polygons of the scene"

    gl.glDisable(gl.GL_LIGHTING)
    if "E15" in corrected:
        gl.glDepthFunc(gl.GL_LEQUAL)  # E15: nearer objects must stay in front of the shadow polygons
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(-1, -1)
    else:
        gl.glDisable(gl.GL_DEPTH_TEST)  # 2. Se dezactivează testul de adâncime
    # 3. Se cere rasterizarea poligoanelor de umbră
    for thing in stage.occluder:
        lit = casting_faces(thing.mesh, np.array(stage.light)).facing
        unlit = np.setdiff1d(np.arange(len(thing.mesh.triangles)), lit)
        draw_faces(gl, thing, thing.mesh.triangles[unlit])  # umbră proprie: the face itself
        if "E16" in corrected:
            draw_where_marked(gl)
        gl.glPushMatrix()
        multiply(gl, onto_ground(stage.light))
        draw_faces(gl, thing, thing.mesh.triangles[lit])  # umbră purtată: a lit face, projected
        gl.glPopMatrix()
        gl.glDisable(gl.GL_STENCIL_TEST)
    yield "2., 3. the shadow polygons"


def projected_faces(gl: Any, corrected: frozenset[str], stage: Stage = OVER_THE_EDGE) -> Steps:
    """RO1:43, "proiectând în scenă, din poziția sursei, toate poligoanele": every lit face, wherever it lies."""
    begin_frame(gl, stage)
    if "E16" in corrected:
        mark(gl)  # E16: a projection ends where its receiver does
    draw(gl, stage.receiver)
    yield "the receiver"

    if "E16" in corrected:
        draw_where_marked(gl)
    gl.glDisable(gl.GL_LIGHTING)
    gl.glDisable(gl.GL_DEPTH_TEST)
    for thing in stage.occluder:
        if "E16" in corrected and thing.mesh.positions[:, 1].max() <= 0:
            continue  # E16: only what lies on the light's side of the receiver casts; here no face lies on both sides
        lit = casting_faces(thing.mesh, np.array(stage.light)).facing
        gl.glPushMatrix()
        multiply(gl, onto_ground(stage.light))
        draw_faces(gl, thing, thing.mesh.triangles[lit])
        gl.glPopMatrix()
    yield "the projected faces"

    gl.glDisable(gl.GL_STENCIL_TEST)
    gl.glEnable(gl.GL_LIGHTING)
    gl.glEnable(gl.GL_DEPTH_TEST)
    draw(gl, stage.occluder)
    yield "the occluders"


ON_RECEIVER = "a stencil mark keeps the shadow on the receiver"
LISTINGS = (
    Listing(
        "planar", "Projection onto one plane, depth test off", "planar", "CA:60-96", three_steps,
        {"E33": ON_RECEIVER, "E34": "the occluder is drawn last, not the lamp"},
    ),
    Listing(
        "planar-origin", "Matrix of a light at the origin", "planar", "CA:361-369", matrix_from_origin,
        {"E35": "the plane is turned over, so that w > 0 for casters"},
    ),
    Listing(
        "planar-point", "Matrix of a light at a point", "planar", "CA:371-383", matrix_from_point,
        {"E35": "the plane is turned over, so that w > 0 for casters"},
    ),
    Listing(
        "planar-direction", "Matrix of a light at infinity", "planar", "CA:385-396", matrix_along_direction,
        {"E36": "the direction points towards the light"},
    ),
    Listing(
        "planar-rays", "Vertices along rays onto the ground", "planar", "SK:139-180", rays,
        {"E21": "casters above the lamp or below the ground cast nothing", "E33": ON_RECEIVER},
    ),
    Listing(
        "planar-offset", "Projection with polygon offset", "planar", "CA:147-168", with_offset, {"E33": ON_RECEIVER},
    ),
    Listing(
        "planar-offset-again", "Projection with polygon offset, printed again", "planar", "CA:706-727",
        with_offset_again, {"E33": ON_RECEIVER, "E68": "the receiver is drawn"},
    ),
    Listing("planar-stencil", "Projection with stencil, mask 1", "planar", "CA:292-359", with_stencil),
    Listing("planar-stencil-255", "Projection with stencil, mask 255", "planar", "CA:743-784", with_stencil_255),
    Listing(
        "planar-darken", "The basic algorithm", "planar", "SK:163-171", darkened,
        {"E33": ON_RECEIVER, "E60": "receiver, shadow, casters, in this order"},
    ),
    Listing(
        "planar-polygons", "Shadow polygons", "planar", "RO1:41-68", shadow_polygons,
        {
            "E15": "GL_LEQUAL and a polygon offset instead of no depth test",
            "E16": "a projection ends where its receiver does",
        },
    ),
    Listing(
        "planar-faces", "Every lit face projected", "planar", "RO1:43", projected_faces,
        {"E16": "faces below the receiver cast nothing on it, and shadows end at its outline"},
    ),
)  # fmt: skip
