"""The sweep: a vertical line goes over the polygon and divides it into regions that are monotone, inside or outside.

Edges that cross are divided where they do; vertices at one place become one. The method is that of libGLU (libtess,
sweep.c and alg-outline), step by step, so that the same triangles come out.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from softshadow.tessellation.event_queue import EventQueue
from softshadow.tessellation.half_edges import HalfEdge, Mesh, Vertex, connect, delete, splice, split
from softshadow.tessellation.places import are_equal, crossing, goes_left, is_before, side
from softshadow.tessellation.regions import Region, SweepLine

FARTHEST = 4e150  # beyond all coordinates
# (place, data of up to four vertices, their weights, whether data is needed) -> data of the new vertex
Combine = Callable[[Sequence[float], Sequence[Any], Sequence[float], bool], Any]


class Sweep:
    """Marks the faces of a mesh that are inside of the polygon.

    Parameters
    ----------
    mesh : Mesh                 of the contours; its vertices have s and t
    is_inside : callable        whether a winding number is inside
    combine : Combine           makes the data of a vertex where edges cross, or where vertices become one
    """

    def __init__(self, mesh: Mesh, is_inside: Callable[[int], bool], combine: Combine) -> None:
        self._mesh, self._is_inside, self._combine = mesh, is_inside, combine
        self._line = SweepLine()

    def run(self) -> None:
        """Divide the mesh and mark its faces."""
        remove_degenerate_edges(self._mesh, self._merge)
        self._queue = EventQueue(list(self._mesh.all_vertices()))
        for t in (-FARTHEST, FARTHEST):
            self._add_sentinel(t)
        while (vertex := self._queue.pop()) is not None:
            while (following := self._queue.minimum()) is not None and are_equal(following, vertex):
                self._queue.pop()
                self._merge(vertex.edge, following.edge)
            self._reach(vertex)
        while (region := self._line.head.next) is not self._line.head:
            region.leave()
        for face in self._mesh.all_faces():
            edge = face.edge
            if edge.lnext.lnext is edge:  # a face of two edges
                edge.onext.add_winding(edge)
                delete(edge)

    def _add_sentinel(self, t: float) -> None:
        edge = self._mesh.add_edge()
        edge.org.s, edge.org.t, edge.dst.s, edge.dst.t = FARTHEST, t, -FARTHEST, t
        self._line.event = edge.dst
        self._line.insert_below(self._line.head, Region(edge))

    # -- vertices ------------------------------------------------------------------------------------------------------
    def _merge(self, one: HalfEdge, other: HalfEdge) -> None:
        """Make the origins of two edges, which are at one place, one vertex."""
        data = [one.org.data, other.org.data, None, None]
        one.org.data = self._combine(list(one.org.coords), data, (0.5, 0.5, 0.0, 0.0), False)
        splice(one, other)

    def _set_crossing(self, vertex: Vertex, ends: Sequence[Vertex]) -> None:
        """Set the place in space and the data of a vertex where two edges cross; `ends` are those of both."""
        vertex.coords = [0.0, 0.0, 0.0]
        weights = [*_add_weighted(vertex, *ends[:2]), *_add_weighted(vertex, *ends[2:])]
        vertex.data = self._combine(list(vertex.coords), [end.data for end in ends], weights, True)

    # -- regions -------------------------------------------------------------------------------------------------------
    def _add_below(self, above: Region, up: HalfEdge) -> Region:
        region = Region(up)
        self._line.insert_below(above, region)
        up.region = region
        return region

    def _finish(self, region: Region) -> None:
        """Mark the face of a region that ends here."""
        edge = region.up
        edge.lface.inside, edge.lface.edge = region.inside, edge
        region.leave()

    def _finish_left(self, first: Region, last: Region | None) -> HalfEdge:
        """Finish the regions from `first` down to `last`, whose edges end at the event; return the lowest edge.

        The edges are put in order around the event, where that has changed.
        """
        previous, above = first, first.up
        while previous is not last:
            previous.fixes_up = False
            region = previous.below
            edge = region.up
            if edge.org is not above.org:
                if not region.fixes_up:
                    self._finish(previous)
                    break
                edge = connect(above.lprev, edge.sym)
                region.replace_up(edge)
            if above.onext is not edge:
                splice(edge.oprev, edge)
                splice(above, edge)
            self._finish(previous)
            above, previous = region.up, region
        return above

    def _add_right(
        self, region_up: Region, first: HalfEdge, last: HalfEdge, top_left: HalfEdge | None, cleans_up: bool
    ) -> None:
        """Add the edges from `first` to `last`, counter-clockwise around the event, which go to the right."""
        edge = first
        while True:
            self._add_below(region_up, edge.sym)
            edge = edge.onext
            if edge is last:
                break
        previous_edge = region_up.below.up.rprev if top_left is None else top_left
        previous, is_first = region_up, True
        while True:
            region = previous.below
            edge = region.up.sym
            if edge.org is not previous_edge.org:
                break
            if edge.onext is not previous_edge:
                splice(edge.oprev, edge)
                splice(previous_edge.oprev, edge)
            region.winding = previous.winding - edge.winding
            region.inside = self._is_inside(region.winding)
            previous.is_dirty = True
            if not is_first and self._splice_right(previous):
                edge.add_winding(previous_edge)
                previous.leave()
                delete(previous_edge)
            is_first, previous, previous_edge = False, region, edge
        previous.is_dirty = True
        if cleans_up:
            self._clean(previous)

    # -- order of neighbouring edges -----------------------------------------------------------------------------------
    def _splice_right(self, region: Region) -> bool:
        """Correct the order of two edges at their right ends, by dividing one; return whether it was wrong."""
        below = region.below
        up, low = region.up, below.up
        if is_before(up.org, low.org):
            if side(low.dst, up.org, low.org) > 0:
                return False
            if not are_equal(up.org, low.org):
                split(low.sym)
                splice(up, low.oprev)
                region.is_dirty = below.is_dirty = True
            elif up.org is not low.org:
                self._queue.remove(up.org)
                self._merge(low.oprev, up)
        else:
            if side(up.dst, low.org, up.org) < 0:
                return False
            region.above.is_dirty = region.is_dirty = True
            split(up.sym)
            splice(low.oprev, up)
        return True

    def _splice_left(self, region: Region) -> bool:
        """Correct the order of two edges at their left ends, by dividing one; return whether it was wrong."""
        below = region.below
        up, low = region.up, below.up
        if is_before(up.dst, low.dst):
            if side(up.dst, low.dst, up.org) < 0:
                return False
            region.above.is_dirty = region.is_dirty = True
            edge = split(up)
            splice(low.sym, edge)
            edge.lface.inside = region.inside
        else:
            if side(low.dst, up.dst, low.org) > 0:
                return False
            region.is_dirty = below.is_dirty = True
            edge = split(low)
            splice(up.lnext, low.sym)
            edge.rface.inside = region.inside
        return True

    def _cross(self, region: Region) -> bool:
        """Divide the two edges of a region where they cross; return whether all regions were cleaned on the way."""
        up, low, event = region.up, region.below.up, self._line.event
        org_up, org_low, dst_up, dst_low = up.org, low.org, up.dst, low.dst
        if org_up is org_low or min(org_up.t, dst_up.t) > max(org_low.t, dst_low.t):
            return False
        if is_before(org_up, org_low):
            if side(dst_low, org_up, org_low) > 0:
                return False
        elif side(dst_up, org_low, org_up) < 0:
            return False
        place = crossing(dst_up, org_up, dst_low, org_low)
        if is_before(place, event):  # rounding has put it to the left of the sweep
            place.s, place.t = event.s, event.t
        nearest = org_up if is_before(org_up, org_low) else org_low
        if is_before(nearest, place):  # or to the right of an end
            place.s, place.t = nearest.s, nearest.t
        if are_equal(place, org_up) or are_equal(place, org_low):
            self._splice_right(region)
            return False
        if (not are_equal(dst_up, event) and side(dst_up, event, place) >= 0) or (
            not are_equal(dst_low, event) and side(dst_low, event, place) <= 0
        ):
            return self._cross_at_event(region, place)
        split(up.sym)
        split(low.sym)
        splice(low.oprev, up)
        up.org.s, up.org.t = place.s, place.t
        self._queue.add(up.org)
        self._set_crossing(up.org, (org_up, dst_up, org_low, dst_low))
        region.above.is_dirty = region.is_dirty = region.below.is_dirty = True
        return False

    def _cross_at_event(self, region: Region, place: Vertex) -> bool:
        """Divide edges whose crossing would move them over the event: they are led through the event instead."""
        below, event = region.below, self._line.event
        up, low = region.up, below.up
        dst_up, dst_low = up.dst, low.dst
        if dst_low is event:
            split(up.sym)
            splice(low.sym, up)
            region = region.top_left()
            up = region.below.up
            self._finish_left(region.below, below)
            self._add_right(region, up.oprev, up, up, cleans_up=True)
            return True
        if dst_up is event:
            split(low.sym)
            splice(up.lnext, low.oprev)
            below = region
            region = region.top_right()
            edge = region.below.up.rprev
            below.up = low.oprev
            low = self._finish_left(below, None)
            self._add_right(region, low.onext, up.rprev, edge, cleans_up=True)
            return True
        if side(dst_up, event, place) >= 0:
            region.above.is_dirty = region.is_dirty = True
            split(up.sym)
            up.org.s, up.org.t = event.s, event.t
        if side(dst_low, event, place) <= 0:
            region.is_dirty = below.is_dirty = True
            split(low.sym)
            low.org.s, low.org.t = event.s, event.t
        return False

    def _clean(self, region: Region) -> None:
        """Check the order of the edges of all regions that have changed, and where they cross."""
        below, head = region.below, self._line.head
        while True:
            while below.is_dirty:  # the lowest one first
                region, below = below, below.below
            if not region.is_dirty:
                below, region = region, region.above
                if region is head or not region.is_dirty:
                    return
            region.is_dirty = False
            up, low = region.up, below.up
            if up.dst is not low.dst and self._splice_left(region):
                if below.fixes_up:
                    below.leave()
                    delete(low)
                    below = region.below
                    low = below.up
                elif region.fixes_up:
                    region.leave()
                    delete(up)
                    region = below.above
                    up = region.up
            if up.org is not low.org:
                meets_event = up.dst is self._line.event or low.dst is self._line.event
                if up.dst is not low.dst and not region.fixes_up and not below.fixes_up and meets_event:
                    if self._cross(region):
                        return
                else:
                    self._splice_right(region)
            if up.org is low.org and up.dst is low.dst:  # two equal edges
                low.add_winding(up)
                region.leave()
                delete(up)
                region = below.above

    # -- events --------------------------------------------------------------------------------------------------------
    def _reach(self, vertex: Vertex) -> None:
        """Let the sweep line pass a vertex."""
        self._line.event = vertex
        known = next((edge for edge in vertex.edge.around_origin() if edge.region is not None), None)
        if known is None:
            self._connect_left(vertex)
            return
        region_up = known.region.top_left()
        region = region_up.below
        top_left = region.up
        bottom_left = self._finish_left(region, None)
        if bottom_left.onext is top_left:  # no edge goes to the right
            self._connect_right(region_up, bottom_left)
        else:
            self._add_right(region_up, bottom_left.onext, top_left, top_left, cleans_up=True)

    def _connect_right(self, region: Region, bottom_left: HalfEdge) -> None:
        """Connect a vertex without edges to the right with the next vertex there, by a temporary edge."""
        top_left, below = bottom_left.onext, region.below
        up, low = region.up, below.up
        if up.dst is not low.dst:
            self._cross(region)
        is_degenerate = False
        if are_equal(up.org, self._line.event):
            splice(top_left.oprev, up)
            region = region.top_left()
            top_left = region.below.up
            self._finish_left(region.below, below)
            is_degenerate = True
        if are_equal(low.org, self._line.event):
            splice(bottom_left, low.oprev)
            bottom_left = self._finish_left(below, None)
            is_degenerate = True
        if is_degenerate:
            self._add_right(region, bottom_left.onext, top_left, top_left, cleans_up=True)
            return
        edge = connect(bottom_left.lprev, low.oprev if is_before(low.org, up.org) else up)
        self._add_right(region, edge, edge.onext, edge.onext, cleans_up=False)
        edge.sym.region.fixes_up = True
        self._clean(region)

    def _connect_left(self, vertex: Vertex) -> None:
        """Connect a vertex without edges to the left with one there, if it is inside of the polygon."""
        region_up = self._line.find(vertex.edge.sym)
        below = region_up.below
        up, low = region_up.up, below.up
        if side(up.dst, vertex, up.org) == 0:
            self._connect_degenerate(region_up, vertex)
            return
        region = region_up if is_before(low.dst, up.dst) else below
        if not region_up.inside and not region.fixes_up:
            self._add_right(region_up, vertex.edge, vertex.edge, None, cleans_up=True)
            return
        edge = connect(vertex.edge.sym, up.lnext) if region is region_up else connect(low.dnext, vertex.edge).sym
        if region.fixes_up:
            region.replace_up(edge)
        else:
            new = self._add_below(region_up, edge)
            new.winding = new.above.winding + new.up.winding
            new.inside = self._is_inside(new.winding)
        self._reach(vertex)

    def _connect_degenerate(self, region: Region, vertex: Vertex) -> None:
        """Connect a vertex that lies on an edge: divide the edge there."""
        edge = region.up
        if are_equal(edge.org, vertex):
            self._merge(edge, vertex.edge)
            return
        if not are_equal(edge.dst, vertex):
            split(edge.sym)
            if region.fixes_up:
                delete(edge.onext)
                region.fixes_up = False
            splice(vertex.edge, edge)
            self._reach(vertex)
            return
        region = region.top_right()
        below = region.below
        top_right = below.up.sym
        top_left = last = top_right.onext
        if below.fixes_up:
            below.leave()
            delete(top_right)
            top_right = top_left.oprev
        splice(vertex.edge, top_right)
        self._add_right(region, top_right.onext, last, top_left if goes_left(top_left) else None, cleans_up=True)


def _add_weighted(vertex: Vertex, org: Vertex, dst: Vertex) -> tuple[float, float]:
    """Add half of the place in space on an edge to that of a vertex; return the weights of the edge's ends."""
    to_org = abs(org.s - vertex.s) + abs(org.t - vertex.t)
    to_dst = abs(dst.s - vertex.s) + abs(dst.t - vertex.t)
    weights = (
        float(np.float32(0.5 * to_dst / (to_org + to_dst))),
        float(np.float32(0.5 * to_org / (to_org + to_dst))),
    )
    for axis in range(3):
        vertex.coords[axis] += weights[0] * org.coords[axis] + weights[1] * dst.coords[axis]
    return weights


def remove_degenerate_edges(mesh: Mesh, merge: Callable[[HalfEdge, HalfEdge], None]) -> None:
    """Remove edges without length, and contours of fewer than three edges."""
    edge, head = mesh.edges.next, mesh.edges
    while edge is not head:
        following, after = edge.next, edge.lnext
        if are_equal(edge.org, edge.dst) and after.lnext is not edge:
            merge(after, edge)
            delete(edge)
            edge, after = after, after.lnext
        if after.lnext is edge:
            if after is not edge:
                if after is following or after is following.sym:
                    following = following.next
                delete(after)
            if edge is following or edge is following.sym:
                following = following.next
            delete(edge)
        edge = following
