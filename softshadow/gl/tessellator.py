"""GLU's tessellator: polygons with holes, crossings and several contours become triangles, handed to callbacks.

The primitives are those of libGLU, corner for corner (`softshadow.tessellation`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from enum import IntEnum
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.gl import glu_tokens as glu
from softshadow.gl.calls import spelled_like_gl
from softshadow.tessellation import faces
from softshadow.tessellation.half_edges import HalfEdge, Mesh, splice, split
from softshadow.tessellation.projection import NO_NORMAL, Vector, convex_sign, project
from softshadow.tessellation.sweep import Sweep

MOST_CACHED = 100  # vertices of a single contour that is drawn without a sweep if it is convex
NULL: Any = object()  # data of a vertex that has none
IS_INSIDE: dict[int, Callable[[int], bool]] = {
    glu.GLU_TESS_WINDING_ODD: lambda winding: bool(winding & 1),
    glu.GLU_TESS_WINDING_NONZERO: lambda winding: winding != 0,
    glu.GLU_TESS_WINDING_POSITIVE: lambda winding: winding > 0,
    glu.GLU_TESS_WINDING_NEGATIVE: lambda winding: winding < 0,
    glu.GLU_TESS_WINDING_ABS_GEQ_TWO: lambda winding: abs(winding) >= 2,
}
# callback: the same one with the data of the polygon as its last argument
WITH_DATA = {
    glu.GLU_TESS_BEGIN: glu.GLU_TESS_BEGIN_DATA,
    glu.GLU_TESS_VERTEX: glu.GLU_TESS_VERTEX_DATA,
    glu.GLU_TESS_END: glu.GLU_TESS_END_DATA,
    glu.GLU_TESS_ERROR: glu.GLU_TESS_ERROR_DATA,
    glu.GLU_TESS_EDGE_FLAG: glu.GLU_TESS_EDGE_FLAG_DATA,
    glu.GLU_TESS_COMBINE: glu.GLU_TESS_COMBINE_DATA,
}
CALLBACKS = {*WITH_DATA, *WITH_DATA.values()}
EDGE_FLAGS = (glu.GLU_TESS_EDGE_FLAG, glu.GLU_TESS_EDGE_FLAG_DATA)


class State(IntEnum):
    """What has begun: nothing, a polygon, or a contour in it."""

    DORMANT = 0
    IN_POLYGON = 1
    IN_CONTOUR = 2


class GLUtesselator:
    """A tessellator of `gluNewTess`: its properties, its callbacks, and the polygon that has begun."""

    def __init__(self) -> None:
        self.state = State.DORMANT
        self.normal: Vector = NO_NORMAL
        self.tolerance, self.winding_rule, self.boundary_only = 0.0, glu.GLU_TESS_WINDING_ODD, False
        self.callbacks: dict[int, Callable[..., Any]] = {}
        self.polygon_data: Any = None
        self.cached: list[tuple[list[float], Any]] = []  # the vertices so far, before a mesh is needed
        self.empties_cache = self.has_failed = False
        self.mesh: Mesh | None = None
        self.last_edge: HalfEdge | None = None

    @property
    def flags_edges(self) -> bool:
        """Whether edge flags are asked for: then all primitives are triangles."""
        return any(which in self.callbacks for which in EDGE_FLAGS)

    def call(self, which: int, *arguments: Any) -> Any:
        """Make a callback, the one with the polygon's data if there is one; NULL without any."""
        with_data = self.callbacks.get(WITH_DATA[which])
        if with_data is not None:
            return with_data(*arguments, self.polygon_data)
        plain = self.callbacks.get(which)
        return NULL if plain is None else plain(*arguments)

    def go_to(self, state: State) -> None:
        """Begin or end what a call needs and the program has left out, with an error for each."""
        while self.state != state:
            if self.state == State.DORMANT:
                self.call(glu.GLU_TESS_ERROR, glu.GLU_TESS_MISSING_BEGIN_POLYGON)
                gluTessBeginPolygon(self, None)
            elif self.state == State.IN_POLYGON and state == State.IN_CONTOUR:
                self.call(glu.GLU_TESS_ERROR, glu.GLU_TESS_MISSING_BEGIN_CONTOUR)
                gluTessBeginContour(self)
            elif self.state == State.IN_CONTOUR:
                self.call(glu.GLU_TESS_ERROR, glu.GLU_TESS_MISSING_END_CONTOUR)
                gluTessEndContour(self)
            else:
                self.call(glu.GLU_TESS_ERROR, glu.GLU_TESS_MISSING_END_POLYGON)
                self.state, self.last_edge, self.mesh = State.DORMANT, None, None

    def begin_mesh(self) -> Mesh:
        """Make a mesh of the vertices so far."""
        mesh = self.mesh = Mesh()
        for coords, data in self.cached:
            self.add_to_mesh(mesh, coords, data)
        self.cached, self.empties_cache = [], False
        return mesh

    def add_to_mesh(self, mesh: Mesh, coords: list[float], data: Any) -> None:
        """Add a vertex to the contour that has begun in the mesh."""
        edge = self.last_edge
        if edge is None:
            edge = mesh.add_edge()
            splice(edge, edge.sym)
        else:
            split(edge)
            edge = edge.lnext
        edge.org.data, edge.org.coords = data, coords
        edge.winding, edge.sym.winding = 1, -1
        self.last_edge = edge

    def combine(self, coords: Sequence[float], data: Sequence[Any], weights: Sequence[float], is_needed: bool) -> Any:
        """Return the data of a vertex where edges cross or vertices meet: what the callback makes of it."""
        given = [None if each is NULL else each for each in data]
        made = self.call(glu.GLU_TESS_COMBINE, np.array(coords, np.float64), given, np.array(weights, np.float32))
        if made is not NULL:
            return made
        if not is_needed:
            return data[0]
        if not self.has_failed:
            self.has_failed = True
            self.call(glu.GLU_TESS_ERROR, glu.GLU_TESS_NEED_COMBINE_CALLBACK)
        return NULL

    def draw(self, mode: int, corners: Sequence[tuple[Any, bool | None]]) -> None:
        """Hand one primitive to the callbacks."""
        self.call(glu.GLU_TESS_BEGIN, mode)
        for data, flag in corners:
            if flag is not None:
                self.call(glu.GLU_TESS_EDGE_FLAG, int(flag))
            self.call(glu.GLU_TESS_VERTEX, data)
        self.call(glu.GLU_TESS_END)

    def draw_convex(self) -> bool:
        """Draw a single convex contour as it is; return False if it is not convex."""
        if len(self.cached) < 3:
            return True
        sign = convex_sign([coords for coords, _ in self.cached], self.normal)
        if sign is None:
            return False
        # of one turn; in the opposite sense its winding number is -1
        if sign == 0 or not IS_INSIDE[self.winding_rule](sign):
            return True
        first, *others = [(data, None) for _, data in self.cached]
        shape = gl.GL_TRIANGLE_FAN if len(self.cached) > 3 else gl.GL_TRIANGLES
        self.draw(gl.GL_LINE_LOOP if self.boundary_only else shape, [first, *(others if sign > 0 else others[::-1])])
        return True

    def draw_by_sweep(self, mesh: Mesh) -> None:
        """Draw the contours of the mesh."""
        project(mesh, self.normal)
        self.has_failed = False
        Sweep(mesh, IS_INSIDE[self.winding_rule], self.combine).run()
        if self.has_failed:
            return
        if self.boundary_only:
            faces.keep_boundary(mesh)
        else:
            faces.triangulate(mesh)
        parts = faces.outlines(mesh) if self.boundary_only else faces.primitives(mesh, self.flags_edges)
        for mode, corners in parts:
            self.draw(mode, corners)


def gluNewTess() -> GLUtesselator:
    """Return a new tessellator."""
    return GLUtesselator()


def gluDeleteTess(tess: GLUtesselator) -> None:
    """End what has begun in a tessellator; its memory is Python's."""
    tess.go_to(State.DORMANT)


def gluTessProperty(tess: GLUtesselator, which: int, data: float) -> None:
    """Set the winding rule, whether only outlines are made, or the tolerance (which GLU ignores)."""
    if which == glu.GLU_TESS_TOLERANCE and 0 <= data <= 1:
        tess.tolerance = float(data)
    elif which == glu.GLU_TESS_WINDING_RULE and data in IS_INSIDE:
        tess.winding_rule = int(data)
    elif which == glu.GLU_TESS_BOUNDARY_ONLY or (which == glu.GLU_TESS_WINDING_RULE and data == int(data) >= 0):
        # libGLU takes an unknown winding rule, too, for whether only outlines are made
        tess.boundary_only = data != 0
    else:
        is_known = which in (glu.GLU_TESS_TOLERANCE, glu.GLU_TESS_WINDING_RULE)
        tess.call(glu.GLU_TESS_ERROR, glu.GLU_INVALID_VALUE if is_known else glu.GLU_INVALID_ENUM)


def gluGetTessProperty(tess: GLUtesselator, which: int, data: Any = None) -> float:
    """Return a property of a tessellator."""
    values = {
        glu.GLU_TESS_TOLERANCE: tess.tolerance,
        glu.GLU_TESS_WINDING_RULE: tess.winding_rule,
        glu.GLU_TESS_BOUNDARY_ONLY: tess.boundary_only,
    }
    if which not in values:
        tess.call(glu.GLU_TESS_ERROR, glu.GLU_INVALID_ENUM)
    value = float(values.get(which, 0.0))
    if data is not None:
        data[0] = value
    return value


def gluTessNormal(tess: GLUtesselator, valueX: float, valueY: float, valueZ: float) -> None:
    """Set the normal of the plane that contours are seen in; zeros let it be computed."""
    tess.normal = float(valueX), float(valueY), float(valueZ)


def gluTessCallback(tess: GLUtesselator, which: int, function: Callable[..., Any] | None) -> None:
    """Set or remove a callback; those of GLU_TESS_..._DATA get the polygon's data as their last argument."""
    if which not in CALLBACKS:
        raise ValueError(f"gluTessCallback(which={which}): expected GLU_TESS_BEGIN … GLU_TESS_COMBINE_DATA")
    if function is None:
        tess.callbacks.pop(which, None)
    elif callable(function):
        tess.callbacks[which] = function
    else:
        raise TypeError(f"gluTessCallback(function={function!r}): expected a function or None")


def gluTessBeginPolygon(tess: GLUtesselator, data: Any) -> None:
    """Begin a polygon of contours; `data` is handed to the callbacks that ask for it."""
    tess.go_to(State.DORMANT)
    tess.state, tess.cached, tess.empties_cache, tess.mesh = State.IN_POLYGON, [], False, None
    tess.polygon_data = data


def gluTessBeginContour(tess: GLUtesselator) -> None:
    """Begin a closed contour."""
    tess.go_to(State.IN_POLYGON)
    tess.state, tess.last_edge = State.IN_CONTOUR, None
    tess.empties_cache = bool(tess.cached)


def gluTessVertex(tess: GLUtesselator, location: Any, data: Any = None) -> None:
    """Add a vertex (x, y, z) to the contour; `data` is what callbacks get for it."""
    tess.go_to(State.IN_CONTOUR)
    coords = np.ravel(np.asarray(location, np.float64))
    if len(coords) != 3:
        raise ValueError(f"gluTessVertex(location={location!r}): expected three numbers")
    if tess.empties_cache:
        tess.begin_mesh()
        tess.last_edge = None
    clamped = np.clip(coords, -glu.GLU_TESS_MAX_COORD, glu.GLU_TESS_MAX_COORD)
    if (np.abs(coords) > glu.GLU_TESS_MAX_COORD).any():
        tess.call(glu.GLU_TESS_ERROR, glu.GLU_TESS_COORD_TOO_LARGE)
    if tess.mesh is None and len(tess.cached) < MOST_CACHED:
        tess.cached.append((clamped.tolist(), data))
    else:
        tess.add_to_mesh(tess.begin_mesh() if tess.mesh is None else tess.mesh, clamped.tolist(), data)


def gluTessEndContour(tess: GLUtesselator) -> None:
    """End the contour: its last vertex is connected with its first one."""
    tess.go_to(State.IN_CONTOUR)
    tess.state = State.IN_POLYGON


def gluTessEndPolygon(tess: GLUtesselator) -> None:
    """End the polygon: hand its triangles, or its outlines, to the callbacks."""
    tess.go_to(State.IN_POLYGON)
    tess.state = State.DORMANT
    if tess.mesh is not None or tess.flags_edges or not tess.draw_convex():
        tess.draw_by_sweep(tess.begin_mesh() if tess.mesh is None else tess.mesh)
    tess.mesh, tess.polygon_data = None, None


def gluBeginPolygon(tess: GLUtesselator) -> None:
    """Begin a polygon and its first contour, as in GLU 1.1."""
    gluTessBeginPolygon(tess, None)
    gluTessBeginContour(tess)


def gluNextContour(tess: GLUtesselator, type: int) -> None:
    """Begin another contour, as in GLU 1.1; GLU ignores its type."""
    gluTessEndContour(tess)
    gluTessBeginContour(tess)


def gluEndPolygon(tess: GLUtesselator) -> None:
    """End a polygon, as in GLU 1.1."""
    gluTessEndContour(tess)
    gluTessEndPolygon(tess)


__all__ = [*spelled_like_gl(globals()), "GLUtesselator"]
