"""The value that z-pass counts from: the number of volumes around the point where the line of sight begins.

0 is right while no volume reaches the near rectangle; the number of volumes around the eye is right while the border of
no volume crosses the near rectangle; otherwise each pixel needs a value of its own (E10). There are two ways to find
it: count the volumes around each point of the near rectangle, or draw the volumes once more with every depth passing.
From the near rectangle to infinity, a line of sight leaves a volume once more than it enters it if it began inside.

Paper: Everitt & Kilgard 2002, sec. 2; the second way is that of the Doom 3 source (2011), "preload".
"""

import warnings
from collections.abc import Sequence
from typing import Annotated, Any, Literal

import numpy as np

from softshadow.errors import NearClipZPass
from softshadow.scene import Light, Scene, SceneObject
from softshadow.techniques import drawing
from softshadow.techniques.near_rectangle import eye_count, near_counts, shadows_near_rectangle
from softshadow.techniques.shadow_volumes import CasterVolume, draw_volumes
from softshadow.techniques.technique import Steps

Start = Annotated[
    Literal["none", "eye", "near-plane", "preload"],
    "what counting starts from: 0, the number of volumes around the eye, or that around each pixel's point of the "
    "near rectangle, found by ray casting (near-plane) or by drawing the volumes with every depth passing (preload)",
]


def set_start_value(
    gl: Any,
    scene: Scene,
    light: Light,
    volumes: list[CasterVolume],
    *,
    start: Start,
    size: tuple[int, int],
    far: str,
    ops: tuple[int, int],
) -> Steps:
    """Write the start value into the stencil buffer, which is 0 before; `ops` count up and down."""
    casters = [item.caster for item in volumes]
    if start == "eye":
        gl.glClearStencil(limited(gl, eye_count(scene, light, casters), ops))
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        gl.glClearStencil(0)
        yield drawing.title("start from the count at the eye", scene, light)
    elif start == "near-plane":
        counts = near_counts(scene, light, casters, size, far)
        write_stencil(gl, limited(gl, counts, ops), size)
        name = drawing.title("near-plane count", scene, light)
        yield drawing.title("start from the counts on the near rectangle", scene, light), {name: counts}
    elif start == "preload":
        up, down = ops
        gl.glCullFace(gl.GL_FRONT)
        gl.glStencilOp(gl.GL_KEEP, up, up)
        draw_volumes(gl, volumes)
        yield drawing.title("preload back faces", scene, light)
        gl.glCullFace(gl.GL_BACK)
        gl.glStencilOp(gl.GL_KEEP, down, down)
        draw_volumes(gl, volumes)
        yield drawing.title("preload front faces", scene, light)


def limited(gl: Any, count: Any, ops: tuple[int, int]) -> Any:
    """Return what the stencil buffer holds after counting up so often from 0; `count` is a number or an array."""
    largest = 2 ** int(gl.glGetIntegerv(gl.GL_STENCIL_BITS)) - 1
    return count & largest if ops[0] == gl.GL_INCR_WRAP else np.minimum(count, largest)


def write_stencil(gl: Any, values: np.ndarray, size: tuple[int, int]) -> None:
    """Write the values (h, w), first row = bottom, that are not 0, as rectangles one pixel high."""
    width, height = size
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glPushMatrix()
    gl.glLoadIdentity()
    gl.glOrtho(0, width, 0, height, -1, 1)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glPushMatrix()
    gl.glLoadIdentity()
    gl.glDisable(gl.GL_CULL_FACE)
    gl.glDisable(gl.GL_DEPTH_TEST)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    for value in np.unique(values[values > 0]).tolist():
        gl.glStencilFunc(gl.GL_ALWAYS, value, 0xFF)
        with drawing.made_of(gl, "start value", ""):
            drawing.draw_polygons(gl, row_spans(values == value))
    gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_CULL_FACE)
    gl.glPopMatrix()
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glPopMatrix()
    gl.glMatrixMode(gl.GL_MODELVIEW)


def row_spans(mask: np.ndarray) -> np.ndarray:
    """Return (N, 4, 2) float32: rectangles, in pixels, round the spans of True in each row of a mask (h, w)."""
    changes = np.diff(np.pad(mask, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    row, first = np.nonzero(changes == 1)
    end = np.nonzero(changes == -1)[1]
    corners = [(first, row), (end, row), (end, row + 1), (first, row + 1)]
    return np.ascontiguousarray(np.moveaxis(np.array(corners, np.float32), 2, 0))


def warn_of_a_wrong_start(
    scene: Scene, light: Light, casters: Sequence[SceneObject], start: Start, size: tuple[int, int], far: str
) -> None:
    """Warn if one start value for all pixels is not the count on the whole near rectangle (E10, E40)."""
    if start not in ("none", "eye"):
        return
    constant = eye_count(scene, light, casters) if start == "eye" else 0
    names = [caster.name for caster in casters if shadows_near_rectangle(caster, light, scene.camera, size, far)]
    if not constant and not names:
        return
    if constant and (near_counts(scene, light, casters, size, far) == constant).all():
        return
    shadowed = f"lies at least partly in the shadow of {', '.join(names)}" if names else "lies in no shadow"
    warnings.warn(
        f"light {light.name!r}: the camera's near rectangle {shadowed}; z-pass starts from {constant} there and shows "
        "shadow as light and light as shadow (start='near-plane' and volume-zfail do not)",
        NearClipZPass,
        stacklevel=3,
    )
