"""A planar mesh of half-edges: each edge is two of them, one per direction.

Vertices, faces and edges stand in rings, whose order decides in which order triangles come out. The operations are
those of Guibas and Stolfi 1985, "Primitives for the manipulation of general subdivisions", as in libGLU (mesh.c).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any


class Vertex:
    """A corner: its place in the plane of the sweep (s, t) and in space, and the caller's data."""

    __slots__ = ("coords", "data", "edge", "handle", "next", "prev", "s", "t")

    def __init__(self) -> None:
        self.next = self.prev = self
        self.edge: Any = None  # one that begins here
        self.s = self.t = 0.0
        self.coords = [0.0, 0.0, 0.0]
        self.data: Any = None
        self.handle = 0  # of the event queue


class Face:
    """A region of the plane, bounded by the loop of `edge`."""

    __slots__ = ("edge", "inside", "marked", "next", "prev", "trail")

    def __init__(self) -> None:
        self.next = self.prev = self
        self.edge: Any = None
        self.trail: Face | None = None
        self.marked = self.inside = False


class HalfEdge:
    """One direction of an edge.

    `onext` is the next edge counter-clockwise around the origin, `lnext` the next one around the face on the left; the
    names of the others follow the same pattern (o: origin, d: destination, l: left face, r: right face).
    """

    __slots__ = ("is_second", "lface", "lnext", "next", "onext", "org", "region", "sym", "winding")

    def __init__(self, is_second: bool) -> None:
        self.is_second = is_second
        self.next: HalfEdge = self
        self.sym: HalfEdge = self
        self.onext: HalfEdge = self
        self.lnext: HalfEdge = self
        self.org: Any = None
        self.lface: Any = None
        self.region: Any = None  # of the sweep, below this edge
        self.winding = 0  # change of the winding number from right to left

    @property
    def dst(self) -> Vertex:
        """The vertex at the end."""
        end: Vertex = self.sym.org
        return end

    @property
    def rface(self) -> Face:
        """The face on the right."""
        face: Face = self.sym.lface
        return face

    @property
    def oprev(self) -> HalfEdge:
        """The next edge clockwise around the origin."""
        return self.sym.lnext

    @property
    def lprev(self) -> HalfEdge:
        """The edge before this one around the left face."""
        return self.onext.sym

    @property
    def dprev(self) -> HalfEdge:
        """The next edge clockwise around the destination."""
        return self.lnext.sym

    @property
    def rprev(self) -> HalfEdge:
        """The edge before this one around the right face."""
        return self.sym.onext

    @property
    def dnext(self) -> HalfEdge:
        """The next edge counter-clockwise around the destination."""
        return self.sym.onext.sym

    def around_origin(self) -> Iterator[HalfEdge]:
        """Iterate over the edges with this origin, beginning with this one."""
        edge = self
        while True:
            yield edge
            edge = edge.onext
            if edge is self:
                return

    def around_left_face(self) -> Iterator[HalfEdge]:
        """Iterate over the edges of the left face, beginning with this one."""
        edge = self
        while True:
            yield edge
            edge = edge.lnext
            if edge is self:
                return

    def add_winding(self, other: HalfEdge) -> None:
        """Add the winding of an edge that coincides with this one."""
        self.winding += other.winding
        self.sym.winding += other.sym.winding


class Mesh:
    """The heads of the rings of vertices, faces and edges; an empty mesh has nothing else."""

    def __init__(self) -> None:
        self.vertices, self.faces = Vertex(), Face()
        self.edges = _edge_pair()
        self.edges.next, self.edges.sym.next = self.edges, self.edges.sym

    def all_vertices(self) -> Iterator[Vertex]:
        """Iterate over the vertices."""
        vertex = self.vertices.next
        while vertex is not self.vertices:
            yield vertex
            vertex = vertex.next

    def all_faces(self) -> Iterator[Face]:
        """Iterate over the faces; one may be deleted, or divided, while it is looked at."""
        face = self.faces.next
        while face is not self.faces:
            following = face.next
            yield face
            face = following

    def add_edge(self) -> HalfEdge:
        """Add an edge with two vertices of its own, in a face of its own."""
        edge = _edge_before(self.edges)
        _begin_vertex(edge, self.vertices)
        _begin_vertex(edge.sym, self.vertices)
        _begin_face(edge, self.faces)
        return edge


def splice(one: HalfEdge, other: HalfEdge) -> None:
    """Join the origins of two edges if they are two vertices, or divide their common one; the same for left faces."""
    if one is other:
        return
    joins_vertices, joins_loops = other.org is not one.org, other.lface is not one.lface
    if joins_vertices:
        _end_vertex(other.org, one.org)
    if joins_loops:
        _end_face(other.lface, one.lface)
    _exchange(other, one)
    if not joins_vertices:
        _begin_vertex(other, one.org)
        one.org.edge = one
    if not joins_loops:
        _begin_face(other, one.lface)
        one.lface.edge = one


def delete(edge: HalfEdge) -> None:
    """Remove an edge; its faces become one, or its loop becomes two."""
    back, joins_loops = edge.sym, edge.lface is not edge.rface
    if joins_loops:
        _end_face(edge.lface, edge.rface)
    if edge.onext is edge:
        _end_vertex(edge.org, None)
    else:
        edge.rface.edge = edge.oprev
        edge.org.edge = edge.onext
        _exchange(edge, edge.oprev)
        if not joins_loops:
            _begin_face(edge, edge.lface)
    if back.onext is back:
        _end_vertex(back.org, None)
        _end_face(back.lface, None)
    else:
        edge.lface.edge = back.oprev
        back.org.edge = back.onext
        _exchange(back, back.oprev)
    first = edge.sym if edge.is_second else edge
    following, previous = first.next, first.sym.next
    following.sym.next, previous.sym.next = previous, following


def split(edge: HalfEdge) -> HalfEdge:
    """Divide an edge by a new vertex; return the second part, from the new vertex to the old destination."""
    new = _edge_before(edge)
    _exchange(new, edge.lnext)
    new.org = edge.dst
    _begin_vertex(new.sym, new.org)
    new.lface = new.sym.lface = edge.lface
    new = new.sym
    _exchange(edge.sym, edge.sym.oprev)
    _exchange(edge.sym, new)
    edge.sym.org = new.org
    new.dst.edge = new.sym
    new.sym.lface = edge.rface
    new.winding, new.sym.winding = edge.winding, edge.sym.winding
    return new


def connect(one: HalfEdge, other: HalfEdge) -> HalfEdge:
    """Return a new edge from the destination of one edge to the origin of another, on the left of both."""
    new = _edge_before(one)
    back, joins_loops = new.sym, other.lface is not one.lface
    if joins_loops:
        _end_face(other.lface, one.lface)
    _exchange(new, one.lnext)
    _exchange(back, other)
    new.org, back.org = one.dst, other.org
    new.lface = back.lface = one.lface
    one.lface.edge = back
    if not joins_loops:
        _begin_face(new, one.lface)
    return new


def _edge_pair() -> HalfEdge:
    edge, back = HalfEdge(False), HalfEdge(True)
    edge.sym, back.sym = back, edge
    edge.lnext, back.lnext = back, edge
    return edge


def _edge_before(following: HalfEdge) -> HalfEdge:
    """Return a new edge, which stands before another one in the ring of edges."""
    edge = _edge_pair()
    if following.is_second:
        following = following.sym
    previous = following.sym.next
    edge.sym.next, previous.sym.next = previous, edge
    edge.next, following.sym.next = following, edge.sym
    return edge


def _exchange(one: HalfEdge, other: HalfEdge) -> None:
    """Exchange the successors of two edges around their origins: Guibas and Stolfi's Splice."""
    after_one, after_other = one.onext, other.onext
    after_one.sym.lnext, after_other.sym.lnext = other, one
    one.onext, other.onext = after_other, after_one


def _begin_vertex(edge: HalfEdge, following: Vertex) -> None:
    """Make a new vertex the origin of an edge, and of those around it."""
    vertex, previous = Vertex(), following.prev
    vertex.prev, previous.next, vertex.next, following.prev = previous, vertex, following, vertex
    vertex.edge = edge
    for each in edge.around_origin():
        each.org = vertex


def _begin_face(edge: HalfEdge, following: Face) -> None:
    """Make a new face the left one of an edge, and of its loop."""
    face, previous = Face(), following.prev
    face.prev, previous.next, face.next, following.prev = previous, face, following, face
    face.edge, face.inside = edge, following.inside
    for each in edge.around_left_face():
        each.lface = face


def _end_vertex(vertex: Vertex, replacement: Vertex | None) -> None:
    for edge in vertex.edge.around_origin():
        edge.org = replacement
    vertex.next.prev, vertex.prev.next = vertex.prev, vertex.next


def _end_face(face: Face, replacement: Face | None) -> None:
    for edge in face.edge.around_left_face():
        edge.lface = replacement
    face.next.prev, face.prev.next = face.prev, face.next
