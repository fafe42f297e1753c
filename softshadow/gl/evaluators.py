"""Evaluators: vertices of Bézier curves and surfaces, with colours, normals and texture coordinates.

References: GL 2.1, sec. 5.1; eval.c, vbo_exec_eval.c and vbo_exec_api.c of Mesa 22.3.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, Primitive, current, thread
from softshadow.context.evaluators import Map
from softshadow.gl.bezier import curve, surface, surface_with_tangents
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.conversions import vector
from softshadow.gl.errors import is_one_of, outside_begin
from softshadow.gl.immediate import glBegin, glEnd
from softshadow.gl.similar_pairs import NO_STARTS, PairSeries, first_pairs, similar_pairs
from softshadow.gl.vertex_format import REST, add_vertex, carry_attribute, store_vertices

F32 = np.float32
TEXTURE_MAPS = ("TEXTURE_COORD_4", "TEXTURE_COORD_3", "TEXTURE_COORD_2", "TEXTURE_COORD_1")
ATTRIBUTES = (("normal", ("NORMAL",)), ("color", ("COLOR_4",)), ("texcoord0", TEXTURE_MAPS))  # in Mesa's order
POSITIONS = ("VERTEX_4", "VERTEX_3")
KEPT_MESHES, MOST_KEPT_POINTS = 64, 4096  # a teapot has 32 meshes with some hundred points


def _enabled_map(context: Context, n: int, names: tuple[str, ...]) -> Map | None:
    """Return the first enabled map of several kinds, or None."""
    for name in names:
        target = getattr(gl, f"GL_MAP{n}_{name}")
        if target in context.evaluators.enabled:
            return context.maps[target]
    return None


def _values(a_map: Map, parameters: tuple[np.ndarray, ...]) -> np.ndarray:
    """Return the points of a map (N, k) at parameters (N,)."""
    return (curve if len(parameters) == 1 else surface)(a_map.points, a_map.domain, *parameters)


class Evaluated(NamedTuple):
    """What maps have at N sets of parameters.

    `sizes`: components of the attributes that the maps set; `rows`: their values (N, size), where there are vertices;
    `points` (N, 2 to 4), None where no map of positions is enabled.
    """

    sizes: dict[str, int]
    rows: dict[str, np.ndarray]
    points: np.ndarray | None

    def at(self, places: slice | np.ndarray) -> Evaluated:
        """Return what they have at some of the parameters, by their places."""
        rows = {name: values[places] for name, values in self.rows.items()}
        return Evaluated(self.sizes, rows, None if self.points is None else self.points[places])

    def arrays(self, context: Context) -> dict[str, np.ndarray]:
        """Return the rows of attributes and positions, with all their components; none without positions."""
        if self.points is None:
            return {}
        arrays = {name: _columns(rows, len(context.attribute(name))) for name, rows in self.rows.items()}
        return {name: context.frozen(rows) for name, rows in (arrays | {"position": _columns(self.points, 4)}).items()}


def _evaluated(context: Context, parameters: tuple[np.ndarray, ...]) -> Evaluated:
    """Evaluate the enabled maps at parameters (N,) float32: (u,) or (u, v)."""
    n = len(parameters)
    found = {name: a_map for name, kinds in ATTRIBUTES if (a_map := _enabled_map(context, n, kinds)) is not None}
    position, points = _enabled_map(context, n, POSITIONS), None
    sizes = {name: a_map.points.shape[-1] for name, a_map in found.items()}
    finds_normals = n == 2 and gl.GL_AUTO_NORMAL in context.evaluators.enabled
    if finds_normals:
        sizes["normal"] = 3
    with np.errstate(all="ignore"):
        rows = {name: _values(a_map, parameters) for name, a_map in found.items()}
        if position is not None and finds_normals:
            points, du, dv = surface_with_tangents(position.points, position.domain, *parameters)
            rows["normal"] = _normals(points, du, dv)
        elif position is not None:
            points = _values(position, parameters)
    return Evaluated(sizes, rows, points)


class WaitingVertices:
    """The last vertices of a primitive, whose numbers are computed together when they are needed.

    They are in the primitive already, without their numbers: how many there are decides what Mesa draws, and when. No
    map can change before glEnd.
    """

    def __init__(self, evaluated: Evaluated, points: np.ndarray) -> None:
        self._sizes, self._names, self._position_size = evaluated.sizes, tuple(evaluated.rows), points.shape[1]
        self._parameters: list[float] = []  # one or two of each vertex
        self._places: list[int] = []  # in the positions of the primitive
        self._changes: dict[str, list[int]] = {name: [] for name in self._names}  # the places of values in its changes

    def add(self, context: Context, primitive: Primitive, parameters: tuple[float, ...]) -> bool:
        """Add a vertex; return False, and do nothing, where that is more than to add numbers."""
        place = len(primitive.positions)
        if primitive.position_size != self._position_size or place + 4 >= primitive.limit:
            return False
        if self._names:
            if not _takes_all(context, primitive, self._sizes, 1):
                return False
            for name in self._names:
                changes = primitive.changes[name]
                self._changes[name].append(len(changes))
                changes += [(place, None), (place + 4, context.attribute(name))]
                primitive.steady.pop(name, None)
        primitive.positions += REST
        self._parameters += parameters
        self._places.append(place)
        return True

    def compute(self, context: Context, primitive: Primitive) -> None:
        """Compute the numbers."""
        count = len(self._places)
        if not count:
            return
        evaluated = _evaluated(context, tuple(np.array(self._parameters, F32).reshape(count, -1).T))
        assert evaluated.points is not None
        first, end, positions = self._places[0], self._places[-1] + 4, _columns(evaluated.points, 4)
        if end - first == 4 * count:
            primitive.positions[first:end] = positions.reshape(-1).tolist()
        else:
            for place, position in zip(self._places, positions.tolist(), strict=True):
                primitive.positions[place : place + 4] = position
        for name, values in evaluated.rows.items():
            changes, places = primitive.changes[name], self._changes[name]
            for place, value in zip(places, _padded(values, len(context.attribute(name))), strict=True):
                changes[place] = changes[place][0], value
            places.clear()
        self._parameters.clear()
        self._places.clear()


def _evaluate(*parameters: float) -> None:
    """Add a vertex to the primitive: (u) or (u, v)."""
    context = thread.context
    primitive: Primitive | None = context.primitive
    if primitive is None or (primitive.waiting is not None and primitive.waiting.add(context, primitive, parameters)):
        return
    evaluated = _evaluated(context, tuple(np.array([parameter], F32) for parameter in parameters))
    _add_vertices(context, evaluated, 1)
    if primitive.waiting is None and evaluated.points is not None:
        primitive.waiting = WaitingVertices(evaluated, evaluated.points)


def _add_vertices(context: Context, evaluated: Evaluated, count: int) -> None:
    """Add vertices to the primitive; attributes have their values before again after each."""
    primitive: Primitive | None = context.primitive
    if primitive is None:
        return
    primitive.from_list = False  # Mesa replays such primitives call by call
    points = evaluated.points
    rows = {name: _padded(values, len(context.attribute(name))) for name, values in evaluated.rows.items()}
    for number in range(count):
        for name, size in evaluated.sizes.items():
            _make_room(context, name, size)
        if points is None:
            continue
        before = {name: context.attribute(name) for name in rows}
        for name, values in rows.items():
            primitive.change(name, before[name], values[number])
        add_vertex(context, *points[number].tolist())
        last = number + 1
        if last < count and _takes_all(context, primitive, evaluated.sizes, count - last):
            first, positions = len(primitive.positions), _columns(points, 4)
            for name, values in rows.items():
                primitive.changes[name] += zip(range(first, first + 4 * (count - last), 4), values[last:], strict=True)
            primitive.positions += positions[last:].reshape(-1).tolist()
            if number == 0 and first == 4:
                primitive.arrays = evaluated.arrays(context)
            store_vertices(context, primitive)
            last = count
        for name, value in before.items():
            primitive.change(name, None, value)
            primitive.steady.pop(name, None)
        if last == count:
            return


def _takes_all(context: Context, primitive: Primitive, sizes: dict[str, int], count: int) -> bool:
    """Return whether more vertices like the last one only add numbers: they carry the attributes, and there is room."""
    buffer = context.vertex_buffer
    for name, size in sizes.items():
        if not buffer.active_sizes.get(name, 0) <= size <= buffer.sizes.get(name, 0):
            return False
    return len(primitive.positions) + 4 * count < primitive.limit


def _padded(values: np.ndarray, length: int) -> list[tuple[float, ...]]:
    """Return rows of a vector's components, so many of them: the missing ones are 0 and 1."""
    return list(map(tuple, _columns(values, length).tolist()))


def _columns(values: np.ndarray, length: int) -> np.ndarray:
    """Return the same rows as an array."""
    rest = np.broadcast_to(
        np.array(REST[values.shape[1] : length], F32), (len(values), max(length - values.shape[1], 0))
    )
    return np.concatenate([values[:, :length], rest], axis=1, dtype=F32)


def _make_room(context: Context, name: str, size: int) -> None:
    """Make the vertices carry an attribute of `size` components (vbo_exec_fixup_vertex)."""
    buffer = context.vertex_buffer
    active = buffer.active_sizes.get(name, 0) if name in buffer.sizes else 0
    if size > buffer.sizes.get(name, 0):
        carry_attribute(context, name, size)
    elif size < active:  # Mesa also resets the last component that stays
        value = context.attribute(name)
        reset = (*value[: size - 1], *REST[size - 1 : len(value)])
        primitive: Primitive | None = context.primitive
        if primitive is not None:
            primitive.change(name, value, reset)
        context.set_attribute(name, reset)
        buffer.active_sizes[name] = size


def _normals(points: np.ndarray, du: np.ndarray, dv: np.ndarray) -> np.ndarray:
    """Return the normals (N, 3) of a surface from its tangents."""
    if points.shape[1] == 4:
        du = du[:, :3] * points[:, 3:] - du[:, 3:] * points[:, :3]
        dv = dv[:, :3] * points[:, 3:] - dv[:, 3:] * points[:, :3]
    (x, y, z), (a, b, c) = du[:, :3].T, dv[:, :3].T
    normals = np.stack([y * c - z * b, z * a - x * c, x * b - y * a], axis=1)
    squares = normals * normals
    length = (squares[:, 0] + squares[:, 1]) + squares[:, 2]
    scale = np.where(length != 0, F32(1) / np.sqrt(length), F32(1)).astype(F32)
    scaled: np.ndarray = normals * scale[:, None]
    return scaled


@in_lists
def glEvalCoord1f(u: float) -> None:
    """Add the vertex of the enabled curves at a parameter."""
    _evaluate(float(u))


@in_lists
def glEvalCoord2f(u: float, v: float) -> None:
    """Add the vertex of the enabled surfaces at two parameters."""
    _evaluate(float(u), float(v))


@in_lists
def glEvalCoord1fv(u: Any) -> None:
    """Add the vertex of the enabled curves at a parameter given as a vector."""
    _evaluate(vector(u, 1)[0])


@in_lists
def glEvalCoord2fv(u: Any) -> None:
    """Add the vertex of the enabled surfaces at two parameters given as a vector."""
    _evaluate(*vector(u, 2))


glEvalCoord1d, glEvalCoord2d, glEvalCoord1dv, glEvalCoord2dv = (
    glEvalCoord1f, glEvalCoord2f, glEvalCoord1fv, glEvalCoord2fv,
)  # fmt: skip


def _step(grid: tuple[int, float, float]) -> np.float32:
    n, first, last = grid
    step: np.float32 = (F32(last) - F32(first)) / F32(n)
    return step


@in_lists
def glEvalPoint1(i: int) -> None:
    """Add the vertex of a grid point."""
    grid = current().evaluators.grid1
    _evaluate(float(F32(i) * _step(grid) + F32(grid[1])))


@in_lists
def glEvalPoint2(i: int, j: int) -> None:
    """Add the vertex of a grid point."""
    u, v = current().evaluators.grid2
    _evaluate(float(F32(i) * _step(u) + F32(u[1])), float(F32(j) * _step(v) + F32(v[1])))


def _parameters(grid: tuple[int, float, float], first: int, last: int) -> np.ndarray:
    """Return the parameters of the grid points [first, last], each the one before plus a step; they may be none."""
    step = _step(grid)
    if first > last:
        return np.empty(0, F32)
    return np.cumsum(np.array([F32(grid[1]) + F32(first) * step, *[step] * (last - first)], F32), dtype=F32)


@in_lists
def glEvalMesh1(mode: int, i1: int, i2: int) -> None:
    """Draw grid points of the enabled curves: GL_POINT or GL_LINE."""
    context = outside_begin("glEvalMesh1")
    modes = {gl.GL_POINT: gl.GL_POINTS, gl.GL_LINE: gl.GL_LINE_STRIP}
    if context is None or not is_one_of("glEvalMesh1", "mode", mode, modes, "GL_POINT or GL_LINE"):
        return
    if _enabled_map(context, 1, POSITIONS) is not None:
        _draw(context, _kept_mesh(context, modes[mode], context.evaluators.grid1, (i1, i2)))


@in_lists
def glEvalMesh2(mode: int, i1: int, i2: int, j1: int, j2: int) -> None:
    """Draw grid points of the enabled surfaces: GL_POINT, GL_LINE or GL_FILL."""
    context = outside_begin("glEvalMesh2")
    modes = {gl.GL_POINT: gl.GL_POINTS, gl.GL_LINE: gl.GL_LINE_STRIP, gl.GL_FILL: gl.GL_TRIANGLE_STRIP}
    if context is None or not is_one_of("glEvalMesh2", "mode", mode, modes, "GL_POINT, GL_LINE or GL_FILL"):
        return
    if _enabled_map(context, 2, POSITIONS) is None or i1 > i2 or j1 > j2:
        return
    _draw(context, _kept_mesh(context, modes[mode], context.evaluators.grid2, (i1, i2), (j1, j2)))


class Mesh(NamedTuple):
    """Primitives of one mode between grid points.

    Attributes
    ----------
    evaluated : what the maps have at the points of all primitives, one after the other; `ends` of each of them
    series : the primitives as `similar_pairs` draws them; None if there is none, or without positions
    """

    mode: int
    evaluated: Evaluated
    ends: list[int]
    series: PairSeries | None

    @property
    def sizes(self) -> dict[str, int]:
        """Components of positions and attributes."""
        points = self.evaluated.points
        return self.evaluated.sizes | ({} if points is None else {"position": points.shape[1]})


def _kept_mesh(context: Context, mode: int, grid: Any, *ranges: tuple[int, int]) -> Mesh:
    """Return grid points of the enabled maps: those of an earlier call if all they depend on is the same.

    A program draws the same surfaces in every frame.
    """
    n, enabled = len(ranges), context.evaluators.enabled
    kinds = (*(kinds for _, kinds in ATTRIBUTES), POSITIONS)
    maps = [None if a_map is None else a_map.content for a_map in (_enabled_map(context, n, each) for each in kinds)]
    key = mode, repr(grid), ranges, gl.GL_AUTO_NORMAL in enabled, *maps
    mesh: Mesh | None = context.meshes.get(key)
    if mesh is None:
        mesh = _mesh(context, mode, grid, ranges)
        if mesh.ends[-1] <= MOST_KEPT_POINTS:
            if len(context.meshes) >= KEPT_MESHES:
                context.meshes.clear()
            context.meshes[key] = mesh
    return mesh


def _mesh(context: Context, mode: int, grid: Any, ranges: tuple[tuple[int, int], ...]) -> Mesh:
    if len(ranges) == 1:
        parameters: tuple[np.ndarray, ...] = (_parameters(grid, *ranges[0]),)
        strips = [np.arange(len(parameters[0]))]
    else:
        u, v = (_parameters(each, *limits) for each, limits in zip(grid, ranges, strict=True))
        parameters, numbers = (np.tile(u, len(v)), np.repeat(v, len(u))), np.arange(len(u) * len(v))
        rows = numbers.reshape(len(v), len(u))
        if mode == gl.GL_POINTS:
            strips = [numbers]
        elif mode == gl.GL_LINE_STRIP:
            strips = [*rows, *rows.T]
        else:
            strips = [np.stack(pair, axis=1).reshape(-1) for pair in pairwise(rows)]
    evaluated = _evaluated(context, parameters).at(np.concatenate([np.empty(0, np.int64), *strips]))
    ends = np.cumsum([0, *map(len, strips)]).tolist()
    arrays = evaluated.arrays(context)
    counts = [len(strip) for strip in strips]
    series = PairSeries(arrays, [mode] * len(strips), counts) if arrays and strips else None
    return Mesh(mode, evaluated, ends, series)


def _draw(context: Context, mesh: Mesh) -> None:
    """Draw the primitives of a mesh."""
    similar, n_done, series = None, 0, mesh.series
    if series is not None:
        similar = first_pairs(context, mesh.mode, mesh.sizes, NO_STARTS, series.counts[0])
    for number, (start, end) in enumerate(pairwise(mesh.ends)):
        if number == 1 and series is not None and similar is None:
            similar = similar_pairs(context, mesh.sizes)
        if series is not None and similar is not None and n_done <= number:
            n_done = similar.add(series, number)
        if n_done <= number:
            glBegin(mesh.mode)
            _add_vertices(context, mesh.evaluated.at(slice(start, end)), end - start)
            glEnd()


__all__ = spelled_like_gl(globals())
