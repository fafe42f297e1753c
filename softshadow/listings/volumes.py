"""Shadow volumes in the stencil buffer: RO1:142-353 (z-pass and z-fail), CA:398-492 (five passes), SK:261-286.

The volumes reach to infinity, except those of E7, which end at a far side (RO1:77-82). The camera of the corrected
listings has no far plane.
"""

from typing import Any

import numpy as np

from softshadow.listings.counting import (
    ambient_scene,
    begin_count,
    count_passes,
    draw_volumes,
    lit_scene,
    start_at_near_plane,
    volumes_around_eye,
)
from softshadow.listings.listing import Listing, Steps
from softshadow.listings.stage import (
    DOWN_THE_AXIS,
    FAR,
    NEAR_SHADOW,
    OVER_THE_TABLE,
    STAGE,
    Stage,
    Thing,
    begin_frame,
    draw,
)  # fmt: skip
from softshadow.scene import casting_faces


def z_pass(gl: Any, corrected: frozenset[str], stage: Stage = STAGE) -> Steps:
    """RO1:169-277: count up at the front faces before the visible surface, down at the back faces."""
    yield from ambient_scene(gl, stage)
    yield from count_passes(gl, corrected, stage)
    if "E3" in corrected:
        gl.glCullFace(gl.GL_BACK)  # E3: or step 4 draws back faces only
    yield from lit_scene(gl, corrected, stage)


def z_pass_decrement_first(gl: Any, corrected: frozenset[str], stage: Stage = STAGE) -> Steps:
    """RO1:195-236 with Pasul 3 before Pasul 2: the slide does not forbid it, and GL_DECR stops at 0."""
    up, down = (gl.GL_INCR_WRAP, gl.GL_DECR_WRAP) if "E11" in corrected else (gl.GL_INCR, gl.GL_DECR)
    yield from ambient_scene(gl, stage)
    begin_count(gl, corrected, gl.GL_FRONT)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, down)
    draw_volumes(gl, stage)
    yield "Pasul 3: count back faces down"

    gl.glCullFace(gl.GL_BACK)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, up)
    draw_volumes(gl, stage)
    yield "Pasul 2: count front faces up"
    yield from lit_scene(gl, corrected, stage)


def z_pass_general(gl: Any, corrected: frozenset[str], stage: Stage = NEAR_SHADOW) -> Steps:
    """RO1:281-289, Cazul general: the eye in shadow; the stencil buffer starts at the number of volumes around it."""
    yield from ambient_scene(gl, stage)
    if "E10" in corrected:
        yield from start_at_near_plane(gl, stage)
    else:
        gl.glClearStencil(volumes_around_eye(stage))
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        yield "start the count at the eye"
    yield from count_passes(gl, corrected, stage)
    if "E3" in corrected:
        gl.glCullFace(gl.GL_BACK)  # E3: or step 4 draws back faces only
    yield from lit_scene(gl, corrected, stage)


def z_fail(gl: Any, corrected: frozenset[str], stage: Stage = DOWN_THE_AXIS) -> Steps:
    """RO1:289-353, Carmack's reverse: count behind the visible surface, back faces up and front faces down."""
    # E8: "volumul este decupat la marginile volumului vizual" (RO1:83): faces behind the far plane are lost
    yield from ambient_scene(gl, stage, None if "E8" in corrected else FAR)
    closed = "E6" in corrected  # E6: the "poligoane de umbră" are only the sides; a closed volume has caps, too
    begin_count(gl, corrected, gl.GL_FRONT)  # nu sunt rasterizate polig PUV
    gl.glStencilOp(gl.GL_KEEP, gl.GL_INCR, gl.GL_KEEP)
    draw_volumes(gl, stage, closed)
    yield "Pasul 2: count back faces up"

    gl.glCullFace(gl.GL_BACK)  # E5: the slide's comment says front faces; its call is right
    gl.glStencilOp(gl.GL_KEEP, gl.GL_DECR, gl.GL_KEEP)
    draw_volumes(gl, stage, closed)
    yield "Pasul 3: count front faces down"

    yield from lit_scene(gl, corrected, stage)


def bounded(gl: Any, corrected: frozenset[str], stage: Stage = OVER_THE_TABLE) -> Steps:
    """RO1:77-82 with depth fail: one volume for each lit polygon, which ends at that polygon scaled from the light."""
    yield from ambient_scene(gl, stage, None)
    for cull, operation, title in (
        (gl.GL_FRONT, gl.GL_INCR, "Pasul 2: count back faces up"),
        (gl.GL_BACK, gl.GL_DECR, "Pasul 3: count front faces down"),
    ):
        begin_count(gl, corrected, cull)
        gl.glStencilOp(gl.GL_KEEP, operation, gl.GL_KEEP)
        for thing in stage.occluder:
            draw_bounded_volumes(gl, thing, stage, by_plane="E7" in corrected)
        yield title
    yield from lit_scene(gl, corrected, stage)


def draw_bounded_volumes(gl: Any, thing: Thing, stage: Stage, by_plane: bool) -> None:
    """Draw the prisms between the lit polygons and their scaled copies, counter-clockwise seen from outside.

    The copy lies where the light is negligible: here beyond all corners of the receiver. E7: its vertices may be that
    far from the light and its plane still nearer, so the distance is that of the plane (`by_plane`).
    """
    light = np.array(stage.light[:3])
    reach = max(np.linalg.norm(each.mesh.positions - light, axis=1).max() for each in stage.receiver)
    for triangle in thing.mesh.triangles[casting_faces(thing.mesh, np.array(stage.light)).facing]:
        generator = thing.mesh.positions[triangle].astype(np.float64)
        normal = np.cross(generator[1] - generator[0], generator[2] - generator[0])
        to_plane = abs((generator[0] - light) @ normal) / np.linalg.norm(normal)
        nearest = np.linalg.norm(generator - light, axis=1).min()
        end = light + (generator - light) * (reach / (to_plane if by_plane else nearest))
        (a, b, c), (far_a, far_b, far_c) = generator.tolist(), end.tolist()
        gl.glBegin(gl.GL_TRIANGLES)
        for corner in (a, b, c, far_a, far_c, far_b):
            gl.glVertex3f(*corner)
        gl.glEnd()
        gl.glBegin(gl.GL_QUADS)
        for corner in (b, a, far_a, far_b, c, b, far_b, far_c, a, c, far_c, far_a):
            gl.glVertex3f(*corner)
        gl.glEnd()


def five_passes(gl: Any, corrected: frozenset[str], stage: Stage = STAGE) -> Steps:
    """CA:398-492, Volums d'ombra: depth, front faces, back faces, dark scene, lit scene."""
    up, down, closed = gl.GL_INCR, gl.GL_DECR, False
    begin_frame(gl, stage, None)
    # 1. Dibuixa l'escena al z-buffer
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    draw(gl, stage.scene)
    yield "1. the scene into the depth buffer"

    if "E40" in corrected:
        yield from start_at_near_plane(
            gl, stage
        )  # E40: the count is right only if the near rectangle lies outside all volumes
        up, down, closed = gl.GL_INCR_WRAP, gl.GL_DECR_WRAP, True

    # 2. Dibuixa al stencil les cares frontals del volum
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glDepthMask(gl.GL_FALSE)
    gl.glStencilFunc(gl.GL_ALWAYS, 0, 0)  # E39: GL_ALWAYS ignores the mask
    gl.glEnable(gl.GL_CULL_FACE)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, up)
    gl.glCullFace(gl.GL_BACK)
    draw_volumes(gl, stage, closed)
    yield "2. count front faces up"

    # 3. Dibuixa al stencil les cares posteriors del volum
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, down)
    gl.glCullFace(gl.GL_FRONT)
    draw_volumes(gl, stage, closed)
    yield "3. count back faces down"

    # 4. Dibuixa al color buffer la part fosca de l'escena
    gl.glDepthMask(gl.GL_TRUE)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
    gl.glCullFace(gl.GL_BACK)
    gl.glDepthFunc(gl.GL_LEQUAL)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
    if "E38" in corrected:
        gl.glStencilFunc(gl.GL_NOTEQUAL, 0, 0xFF)
    else:
        gl.glStencilFunc(gl.GL_EQUAL, 1, 1)  # E38: the last bit is the parity: two volumes look like none
    gl.glDisable(gl.GL_LIGHTING)
    draw(gl, stage.scene)
    yield "4. the dark part of the scene"

    # 5. Dibuixem al color buffer la part clara de l'escena
    gl.glStencilFunc(gl.GL_EQUAL, 0, 0xFF if "E38" in corrected else 1)
    gl.glEnable(gl.GL_LIGHTING)
    draw(gl, stage.scene)
    yield "5. the light part of the scene"

    # 6. Restaura l'estat inicial
    gl.glDepthFunc(gl.GL_LESS)
    gl.glDisable(gl.GL_STENCIL_TEST)
    if "E63" in corrected:
        gl.glDisable(gl.GL_CULL_FACE)  # E63: "initial state" has no culling
    draw_mark(gl)
    yield "6. the initial state again"


def five_passes_in_shadow(gl: Any, corrected: frozenset[str]) -> Steps:
    """CA:398-492 with the eye near the shadows, a case that the slide does not mention."""
    yield from five_passes(gl, corrected, NEAR_SHADOW)


def draw_mark(gl: Any) -> None:
    """Draw a clockwise triangle in a corner, as the next frame might: it shows which state is left behind."""
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()
    gl.glDisable(gl.GL_LIGHTING)
    gl.glColor3f(1.0, 1.0, 1.0)
    gl.glBegin(gl.GL_TRIANGLES)
    for x, y in ((-1.0, 1.0), (-0.8, 1.0), (-1.0, 0.8)):
        gl.glVertex3f(x, y, -1.0)
    gl.glEnd()


def in_out_counter(gl: Any, corrected: frozenset[str], stage: Stage = STAGE) -> Steps:
    """SK:261-286: the two cases of the counter and the eight steps; the light is added to the ambient picture."""
    for title in ambient_scene(gl, stage):  # vyčisti stencil buffer; renderuj scenu bez difuzneho/spec osvetlenia
        yield unnumbered(title)
    for title in count_passes(gl, frozenset({"E1"}), stage):  # "render" predných, potom zadných stien tieňových telies
        yield unnumbered(title)
    gl.glCullFace(gl.GL_BACK)
    # "Counter == 0: osvetleny, Counter >= 0: tineny": both hold at 0. E20: dark is where it is > 0
    gl.glStencilFunc(gl.GL_EQUAL if "E20" in corrected else gl.GL_GREATER, 0, 0xFF)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
    gl.glDepthFunc(gl.GL_LEQUAL)
    gl.glEnable(gl.GL_LIGHTING)
    gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, (0.0, 0.0, 0.0, 1.0))  # len s diffuse/spec zložkou
    draw(gl, stage.scene)
    yield "add the light where the counter is 0"


def unnumbered(title: Any) -> str:
    """Return the title of a step without its number on another slide."""
    return str(title).partition(": ")[2]


COUNTED = "stencil test and culling are enabled before counting"
CULLING = "culling is set back before the lit scene"
ALL_BITS, NO_CULLING = "all bits of the count are tested, not one", "culling is disabled at the end"
EQUAL_DEPTH = "the lit scene is drawn with GL_LEQUAL"
LISTINGS = (
    Listing(
        "volume-zpass", "Shadow volumes, depth pass", "volumes", "RO1:169-277", z_pass,
        {"E1": COUNTED, "E2": EQUAL_DEPTH, "E3": CULLING},
    ),
    Listing(
        "volume-zpass-reversed", "Depth pass, back faces first", "volumes", "RO1:195-236", z_pass_decrement_first,
        {"E1": COUNTED, "E2": EQUAL_DEPTH, "E11": "counters that wrap, not ones that stop at 0"},
    ),
    Listing(
        "volume-zpass-general", "Depth pass, the eye in shadow", "volumes", "RO1:281-289", z_pass_general,
        {
            "E1": COUNTED, "E2": EQUAL_DEPTH, "E3": CULLING,
            "E10": "the count starts from each pixel's point of the near plane, not from the eye",
        },
    ),
    Listing(
        "volume-zfail", "Shadow volumes, depth fail", "volumes", "RO1:289-353", z_fail,
        {"E1": COUNTED, "E2": EQUAL_DEPTH, "E6": "closed volumes: caps at both ends", "E8": "no far plane clips them"},
    ),
    Listing(
        "volume-far-side", "Volumes that end at a scaled polygon", "volumes", "RO1:77-82", bounded,
        {
            "E1": COUNTED, "E2": EQUAL_DEPTH,
            "E7": "the far side's plane, not only its vertices, is as far as the light reaches",
        },
    ),
    Listing(
        "volume-five-passes", "Shadow volumes in five passes", "volumes", "CA:398-492", five_passes,
        {"E38": ALL_BITS, "E63": NO_CULLING},
    ),
    Listing(
        "volume-five-passes-eye", "Five passes, the eye in shadow", "volumes", "CA:398-492", five_passes_in_shadow,
        {"E38": ALL_BITS, "E40": "the count starts from each pixel's point of the near plane", "E63": NO_CULLING},
    ),
    Listing(
        "volume-counter", "The in-out counter", "volumes", "SK:261-286", in_out_counter,
        {"E20": "shadow where the counter is > 0"},
    ),
)  # fmt: skip
