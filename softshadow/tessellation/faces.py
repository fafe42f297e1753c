"""What comes out of a divided mesh: triangles in fans and strips, or the outlines of its faces (libtess, render.c)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from softshadow import tokens as gl
from softshadow.tessellation.half_edges import Face, HalfEdge, Mesh, connect, delete
from softshadow.tessellation.places import goes_left, goes_right, is_before, side

Corner = tuple[Any, bool | None]  # data of a vertex, and a new edge flag before it


class Group(NamedTuple):
    """Triangles that make one primitive, from an edge on."""

    size: int
    start: HalfEdge
    mode: int


def triangulate(mesh: Mesh) -> None:
    """Divide the faces inside, which are monotone, into triangles."""
    for face in mesh.all_faces():
        if face.inside:
            _triangulate_monotone(face)


def _triangulate_monotone(face: Face) -> None:
    """Divide a face whose upper and lower chain go from left to right."""
    up = face.edge
    while is_before(up.dst, up.org):
        up = up.lprev
    while is_before(up.org, up.dst):
        up = up.lnext
    low = up.lprev
    while up.lnext is not low:
        if is_before(up.dst, low.org):
            while low.lnext is not up and (goes_left(low.lnext) or side(low.org, low.dst, low.lnext.dst) <= 0):
                low = connect(low.lnext, low).sym
            low = low.lprev
        else:
            while low.lnext is not up and (goes_right(up.lprev) or side(up.dst, up.org, up.lprev.org) >= 0):
                up = connect(up, up.lprev).sym
            up = up.lnext
    while low.lnext.lnext is not up:
        low = connect(low.lnext, low).sym


def keep_boundary(mesh: Mesh) -> None:
    """Delete the edges between two faces inside, or two outside."""
    edge = mesh.edges.next
    while edge is not mesh.edges:
        following = edge.next
        if edge.rface.inside == edge.lface.inside:
            delete(edge)
        edge = following


def outlines(mesh: Mesh) -> Iterator[tuple[int, list[Corner]]]:
    """Yield the outline of each face inside as a line loop."""
    for face in mesh.all_faces():
        if face.inside:
            yield gl.GL_LINE_LOOP, [(edge.org.data, None) for edge in face.edge.around_left_face()]


def primitives(mesh: Mesh, flags_edges: bool) -> Iterator[tuple[int, list[Corner]]]:
    """Yield the triangles: fans and strips as large as possible, then single ones; with edge flags, all single."""
    lonely: Face | None = None
    for face in mesh.all_faces():
        face.marked = False
    for face in mesh.all_faces():
        if not face.inside or face.marked:
            continue
        group = Group(1, face.edge, gl.GL_TRIANGLES) if flags_edges else _largest_group(face.edge)
        if group.mode == gl.GL_TRIANGLES:
            single = group.start.lface
            single.trail, lonely, single.marked = lonely, single, True
        else:
            yield group.mode, [(data, None) for data in (_fan if group.mode == gl.GL_TRIANGLE_FAN else _strip)(group)]
    if lonely is not None:
        yield gl.GL_TRIANGLES, list(_triangles(lonely, flags_edges))


def _largest_group(edge: HalfEdge) -> Group:
    best = Group(1, edge, gl.GL_TRIANGLES)
    for measure in (_fan_around, _strip_along):
        for start in (edge, edge.lnext, edge.lprev):
            group = measure(start)
            if group.size > best.size:
                best = group
    return best


def _is_taken(face: Face) -> bool:
    return not face.inside or face.marked


def _fan_around(edge: HalfEdge) -> Group:
    """Return the largest fan around the origin of an edge."""
    trail: list[Face] = []
    current = edge
    while not _is_taken(current.lface):
        _mark(current.lface, trail)
        current = current.onext
    current = edge
    while not _is_taken(current.rface):
        _mark(current.rface, trail)
        current = current.oprev
    _unmark(trail)
    return Group(len(trail), current, gl.GL_TRIANGLE_FAN)


def _strip_along(edge: HalfEdge) -> Group:
    """Return the largest strip that an edge lies in; it must begin so that its triangles keep their winding."""
    trail: list[Face] = []
    tail = edge
    while not _is_taken(tail.lface):
        _mark(tail.lface, trail)
        tail = tail.dprev
        if _is_taken(tail.lface):
            break
        _mark(tail.lface, trail)
        tail = tail.onext
    n_tail = len(trail)
    head = edge
    while not _is_taken(head.rface):
        _mark(head.rface, trail)
        head = head.oprev
        if _is_taken(head.rface):
            break
        _mark(head.rface, trail)
        head = head.dnext
    size, n_head = len(trail), len(trail) - n_tail
    _unmark(trail)
    if n_tail % 2 == 0:
        return Group(size, tail.sym, gl.GL_TRIANGLE_STRIP)
    if n_head % 2 == 0:
        return Group(size, head, gl.GL_TRIANGLE_STRIP)
    return Group(size - 1, head.onext, gl.GL_TRIANGLE_STRIP)


def _mark(face: Face, trail: list[Face]) -> None:
    face.marked = True
    trail.append(face)


def _unmark(trail: list[Face]) -> None:
    for face in trail:
        face.marked = False


def _fan(group: Group) -> Iterator[Any]:
    edge = group.start
    yield edge.org.data
    yield edge.dst.data
    while not _is_taken(edge.lface):
        edge.lface.marked = True
        edge = edge.onext
        yield edge.dst.data


def _strip(group: Group) -> Iterator[Any]:
    edge = group.start
    yield edge.org.data
    yield edge.dst.data
    while not _is_taken(edge.lface):
        edge.lface.marked = True
        edge = edge.dprev
        yield edge.org.data
        if _is_taken(edge.lface):
            return
        edge.lface.marked = True
        edge = edge.onext
        yield edge.dst.data


def _triangles(face: Face | None, flags_edges: bool) -> Iterator[Corner]:
    """Yield the corners of single triangles; an edge flag where it changes: true on the outline of the polygon."""
    flag: bool | None = None
    while face is not None:
        for edge in face.edge.around_left_face():
            is_outline, change = not edge.rface.inside, None
            if flags_edges and is_outline is not flag:
                flag = change = is_outline
            yield edge.org.data, change
        face = face.trail
