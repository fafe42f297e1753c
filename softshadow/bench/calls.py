"""Times of single GL calls, on softshadow and through PyOpenGL on Mesa.

A frame makes one call many times, and the next frame the next call; a few calls make others before and after. Frames of
the two renderers are interleaved, so background load hits both equally. PyOpenGL does not check errors here, which it
otherwise does after every call; softshadow always checks.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from statistics import median
from typing import Any

import numpy as np

from softshadow.testing.sessions import MesaSession, OwnSession

SIZE = (640, 480)
ROUNDS = 7
Work = Callable[[], Any]


@dataclass(frozen=True)
class CallTime:
    """Microseconds of a call here and on Mesa (None if it was not measured), and their ratio, each a median."""

    name: str
    softshadow: float
    mesa: float | None = None
    ratio: float | None = None


@dataclass(frozen=True)
class TimedCall:
    """A call, how often a frame makes it, and what is called before and after all of them."""

    name: str
    repeats: int
    call: Work
    before: Work
    after: Work


def nothing() -> None:
    """Do nothing, before or after the calls of a frame."""


def timed_calls(gl: Any) -> list[TimedCall]:
    """Return the calls, prepared in a namespace of GL."""
    _prepare(gl)
    calls: list[TimedCall] = []

    def add(name: str, call: Work, repeats: int = 1000, before: Work = nothing, after: Work = nothing) -> None:
        calls.append(TimedCall(name, repeats, call, before, after))

    _add_matrices(gl, add)
    _add_state(gl, add)
    _add_vertices(gl, add)
    _add_draws(gl, add)
    return calls


def _prepare(gl: Any) -> None:
    """Set a camera and a light; compile list 1 of six lit quads and the empty list 2."""
    gl.glViewport(0, 0, *SIZE)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.gluPerspective(45, SIZE[0] / SIZE[1], 0.5, 20)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.gluLookAt(2, 2, 5, 0, 0, 0, 0, 1, 0)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_LIGHT0)
    gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, [2.0, 4.0, 3.0, 1.0])
    gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 1)
    gl.glNewList(1, gl.GL_COMPILE)
    _six_quads(gl)
    gl.glEndList()
    gl.glNewList(2, gl.GL_COMPILE)
    gl.glEndList()


def _box() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return positions, normals and indices of a small box: 24 vertices, 12 triangles."""
    positions, normals = [], []
    for axis in range(3):
        for sign in (1, -1):
            normal, right, up = np.roll(np.eye(3) * 0.1, axis, axis=0)
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                positions.append(sign * normal + x * right + sign * y * up)
                normals.append(sign * normal * 10)
    indices = np.arange(6)[:, None] * 4 + [0, 1, 2, 0, 2, 3]
    return np.array(positions, np.float32), np.array(normals, np.float32), indices.astype(np.uint32).ravel()


def _six_quads(gl: Any) -> None:
    positions, normals, _ = _box()
    gl.glBegin(gl.GL_QUADS)
    for position, normal in zip(positions.tolist(), normals.tolist(), strict=True):
        gl.glNormal3f(*normal)
        gl.glVertex3f(*position)
    gl.glEnd()


def _alternating(call: Callable[[Any], Any], values: tuple[Any, Any]) -> Work:
    """Return a function that makes a call with one value and with the other, in turns."""
    turn = 0

    def make() -> None:
        nonlocal turn
        turn ^= 1
        call(values[turn])

    return make


def _add_matrices(gl: Any, add: Callable[..., None]) -> None:
    translate, rotate, scale, push, pop = (
        getattr(gl, name) for name in ("glTranslatef", "glRotatef", "glScalef", "glPushMatrix", "glPopMatrix")
    )
    look_at, perspective, mode, identity = gl.gluLookAt, gl.gluPerspective, gl.glMatrixMode, gl.glLoadIdentity
    names, angle = (gl.GL_PROJECTION, gl.GL_MODELVIEW), 0.0

    def turn() -> None:
        nonlocal angle
        angle += 0.5
        rotate(angle % 360, 0.0, 1.0, 0.0)

    def place() -> None:
        push()
        translate(0.1, 0.2, 0.3)
        rotate(30.0, 0.0, 1.0, 0.0)
        scale(0.5, 0.5, 0.5)
        pop()

    kept = {"before": push, "after": pop}
    add("glTranslatef", lambda: translate(0.1, 0.2, 0.3), **kept)
    add("glRotatef", turn, **kept)
    add("glScalef", lambda: scale(1.0, 1.1, 1.0), **kept)
    add("gluLookAt", lambda: look_at(3.0, 2.0, 4.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0), **kept)
    add("gluPerspective", lambda: perspective(45.0, 1.3, 1.0, 10.0), **kept)
    add("glOrtho", lambda: gl.glOrtho(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0), **kept)
    add("glLoadIdentity", identity, **kept)
    add("glPushMatrix + glPopMatrix", lambda: (push(), pop()))
    add("push, translate, rotate, scale, pop", place)
    add("glMatrixMode, twice", lambda: (mode(names[0]), mode(names[1])))


def _add_state(gl: Any, add: Callable[..., None]) -> None:
    enable, disable, blend = gl.glEnable, gl.glDisable, gl.GL_BLEND
    push, pop, everything = gl.glPushAttrib, gl.glPopAttrib, gl.GL_ALL_ATTRIB_BITS
    light, diffuse, specular = gl.GL_LIGHT0, (0.9, 0.8, 0.7, 1.0), (0.5, 0.5, 0.5, 1.0)
    planes, modes = ((1.0, 0.0, 0.0, 0.5), (0.0, 1.0, 0.0, 0.5)), (gl.GL_REPLACE, gl.GL_MODULATE)
    names = [int(name) for name in gl.glGenTextures(2)]
    add("glEnable + glDisable", lambda: (enable(blend), disable(blend)))
    for name, call, values in (
        ("glDepthMask", gl.glDepthMask, (0, 1)),
        ("glDepthFunc", gl.glDepthFunc, (gl.GL_LEQUAL, gl.GL_LESS)),
        ("glCullFace", gl.glCullFace, (gl.GL_FRONT, gl.GL_BACK)),
        ("glStencilFunc", lambda ref: gl.glStencilFunc(gl.GL_ALWAYS, ref, 255), (1, 0)),
        ("glStencilOp", lambda op: gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, op), (gl.GL_INCR, gl.GL_KEEP)),
        ("glBlendFunc", lambda factor: gl.glBlendFunc(factor, gl.GL_ONE), (gl.GL_SRC_ALPHA, gl.GL_ONE)),
        ("glColorMask", lambda on: gl.glColorMask(on, on, on, on), (0, 1)),
        ("glPolygonOffset", lambda units: gl.glPolygonOffset(1.0, units), (2.0, 4.0)),
        ("glBindTexture", lambda texture: gl.glBindTexture(gl.GL_TEXTURE_2D, texture), (names[0], 0)),
        ("glTexEnvi", lambda how: gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, how), modes),
        ("glTexGenfv(GL_OBJECT_PLANE)", lambda plane: gl.glTexGenfv(gl.GL_S, gl.GL_OBJECT_PLANE, plane), planes),
        ("glTexGenfv(GL_EYE_PLANE)", lambda plane: gl.glTexGenfv(gl.GL_S, gl.GL_EYE_PLANE, plane), planes),
        ("glClipPlane", lambda plane: gl.glClipPlane(gl.GL_CLIP_PLANE0, plane), planes),
        ("glFogf", lambda density: gl.glFogf(gl.GL_FOG_DENSITY, density), (0.5, 1.0)),
        ("glLightModelfv", lambda color: gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, color), planes),
        ("glShadeModel", gl.glShadeModel, (gl.GL_FLAT, gl.GL_SMOOTH)),
        ("glLineWidth", gl.glLineWidth, (2.0, 1.0)),
        ("glDepthRange", lambda far: gl.glDepthRange(0.0, far), (0.9, 1.0)),
    ):
        add(name, _alternating(call, values))
    add("glTexParameteri", lambda: gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR))
    add("glRasterPos3f", lambda: gl.glRasterPos3f(0.0, 0.0, 0.0))
    add("glViewport", lambda: gl.glViewport(0, 0, *SIZE))
    add("glLightfv(GL_POSITION)", lambda: gl.glLightfv(light, gl.GL_POSITION, [2.0, 4.0, 3.0, 1.0]))
    add("glLightfv(GL_DIFFUSE)", lambda: gl.glLightfv(light, gl.GL_DIFFUSE, diffuse))
    add("glMaterialfv", lambda: gl.glMaterialfv(gl.GL_FRONT, gl.GL_SPECULAR, specular))
    add("glMaterialf", lambda: gl.glMaterialf(gl.GL_FRONT, gl.GL_SHININESS, 32.0))
    add("glPushAttrib + glPopAttrib", lambda: (push(everything), pop()))
    add("the same, glEnable between them", lambda: (push(everything), enable(blend), pop()))


def _add_vertices(gl: Any, add: Callable[..., None]) -> None:
    vertex, normal, color, coordinate = gl.glVertex3f, gl.glNormal3f, gl.glColor3f, gl.glTexCoord2f
    vertex_of, normal_of, place = gl.glVertex3fv, gl.glNormal3fv, [9.0, 9.0, 9.0]  # outside of the view
    positions, _, _ = _box()
    inside = {"before": lambda: gl.glBegin(gl.GL_TRIANGLES), "after": gl.glEnd}
    add("glColor3f", lambda: color(0.1, 0.2, 0.3))
    add("glVertex3f", lambda: vertex(9.0, 9.0, 9.0), **inside)
    add("glNormal3f + glVertex3f", lambda: (normal(0.0, 1.0, 0.0), vertex(9.0, 9.0, 9.0)), **inside)
    add("glNormal3fv + glVertex3fv", lambda: (normal_of(place), vertex_of(place)), **inside)
    add("glColor3f + glVertex3f", lambda: (color(0.1, 0.2, 0.3), vertex(9.0, 9.0, 9.0)), **inside)
    add("glTexCoord2f + glVertex3f", lambda: (coordinate(0.1, 0.2), vertex(9.0, 9.0, 9.0)), **inside)
    add("glBegin + glEnd", lambda: (gl.glBegin(gl.GL_QUADS), gl.glEnd()))
    add("glEnableClientState", lambda: gl.glEnableClientState(gl.GL_VERTEX_ARRAY))
    add("glVertexPointer", lambda: gl.glVertexPointer(3, gl.GL_FLOAT, 0, positions))
    add("glCallList, empty", lambda: gl.glCallList(2))


def _add_draws(gl: Any, add: Callable[..., None]) -> None:
    positions, normals, indices = _box()
    both, one = gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT, (0, 0, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
    depth = (0, 0, *SIZE, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
    pixel, depths = np.zeros((1, 1, 4), np.uint8), np.zeros(SIZE[::-1], np.float32)

    def arrays(light: bool, color: bool = True) -> Work:
        def before() -> None:
            gl.glClear(both)
            gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
            gl.glEnableClientState(gl.GL_NORMAL_ARRAY)
            gl.glVertexPointer(3, gl.GL_FLOAT, 0, positions)
            gl.glNormalPointer(gl.GL_FLOAT, 0, normals)
            (gl.glEnable if light else gl.glDisable)(gl.GL_LIGHTING)
            gl.glColorMask(color, color, color, color)

        return before

    def plain() -> None:
        gl.glDisableClientState(gl.GL_VERTEX_ARRAY)
        gl.glDisableClientState(gl.GL_NORMAL_ARRAY)
        gl.glDisable(gl.GL_LIGHTING)
        gl.glColorMask(1, 1, 1, 1)

    def elements() -> None:
        gl.glPushMatrix()
        gl.glTranslatef(0.01, 0.0, 0.0)
        gl.glDrawElements(gl.GL_TRIANGLES, 36, gl.GL_UNSIGNED_INT, indices)
        gl.glPopMatrix()

    def quad() -> None:
        gl.glColor3f(0.5, 0.6, 0.7)
        gl.glBegin(gl.GL_QUADS)
        for x, y in ((0, 0), (0.1, 0), (0.1, 0.1), (0, 0.1)):
            gl.glVertex3f(x, y, 0)
        gl.glEnd()
        gl.glTranslatef(0.0, 0.0, 0.001)  # so that the next quad is a draw of its own

    lit = {"before": arrays(True), "after": plain}
    add("glDrawElements, 12 lit triangles", elements, 100, **lit)
    add("the same, unlit", elements, 100, before=arrays(False), after=plain)
    add("the same, depth only", elements, 100, before=arrays(False, color=False), after=plain)
    add("a quad by glBegin, own draw", quad, 100, before=gl.glPushMatrix, after=gl.glPopMatrix)
    add("glCallList of 6 lit quads", lambda: gl.glCallList(1), 100, **lit)
    add("glClear", lambda: gl.glClear(both), 20)
    add("glReadPixels, 1 pixel", lambda: gl.glReadPixels(*one, pixel), 100)
    add("glReadPixels, depth 640x480", lambda: gl.glReadPixels(*depth, depths), 5)


def program(gl: Any) -> Work:
    """Return a function that makes one of the calls many times: the next one whenever it is called."""
    calls, number = timed_calls(gl), -1

    def frame() -> None:
        nonlocal number
        number = (number + 1) % len(calls)
        each = calls[number]
        each.before()
        call = each.call
        for _ in range(each.repeats):
            call()
        each.after()

    return frame


def measure_calls(with_mesa: bool, rounds: int = ROUNDS) -> list[CallTime]:
    """Return the times of all calls.

    Parameters
    ----------
    with_mesa : bool             also measure PyOpenGL on Mesa
    rounds : int                 number of timed frames of each call

    Raises
    ------
    MesaError                    Mesa is missing
    """
    sessions: list[OwnSession | MesaSession] = [OwnSession(program, SIZE)]
    try:
        if with_mesa:
            sessions.append(MesaSession(program, SIZE, checked=False))
        repeats = call_repeats()
        times: list[list[list[float]]] = [[[] for _ in repeats] for _ in sessions]
        for turn in range(-1, rounds):  # the first round is not timed
            for number in range(len(repeats)):
                for session, of_session in zip(sessions, times, strict=True):
                    (timing,) = session.time()
                    if turn >= 0:
                        of_session[number].append(1e6 * timing.cpu / repeats[number][1])
    finally:
        for session in sessions:
            session.close()
    return [_call_time(name, *(of_session[number] for of_session in times)) for number, (name, _) in enumerate(repeats)]


def call_repeats() -> list[tuple[str, int]]:
    """Return the name of each call, and how often a frame makes it."""
    from softshadow import gl

    with gl.create_context(*SIZE):
        return [(each.name, each.repeats) for each in timed_calls(gl)]


def _call_time(name: str, own: list[float], mesa: list[float] | None = None) -> CallTime:
    if mesa is None:
        return CallTime(name, median(own))
    return CallTime(name, median(own), median(mesa), median(a / b for a, b in zip(own, mesa, strict=True)))
