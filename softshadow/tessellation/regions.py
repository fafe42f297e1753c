"""The regions between the edges that the sweep line crosses, from bottom to top."""

from __future__ import annotations

from typing import Any

from softshadow.tessellation.half_edges import HalfEdge, Vertex, connect, delete
from softshadow.tessellation.places import height, is_before, side


class Region:
    """A region of the sweep line, below the edge `up`, which goes from right to left.

    `is_dirty`: its order relative to the region below must be checked. `fixes_up`: the upper edge is temporary; it
    holds the place of an edge to a vertex further to the right.
    """

    __slots__ = ("fixes_up", "inside", "is_dirty", "next", "prev", "up", "winding")

    def __init__(self, up: HalfEdge | None) -> None:
        self.next = self.prev = self
        self.up: Any = up
        self.winding = 0
        self.inside = self.is_dirty = self.fixes_up = False

    @property
    def above(self) -> Region:
        """The region above this one."""
        return self.next

    @property
    def below(self) -> Region:
        """The region below this one."""
        return self.prev

    def leave(self) -> None:
        """Remove the region from the sweep line."""
        self.up.region = None
        self.next.prev, self.prev.next = self.prev, self.next

    def replace_up(self, edge: HalfEdge) -> None:
        """Replace the temporary upper edge."""
        delete(self.up)
        self.fixes_up = False
        self.up = edge
        edge.region = self

    def top_left(self) -> Region:
        """Return the region above the uppermost edge that begins where the upper edge does."""
        origin, region = self.up.org, self.above
        while region.up.org is origin:
            region = region.above
        if region.fixes_up:
            region.replace_up(connect(region.below.up.sym, region.up.lnext))
            region = region.above
        return region

    def top_right(self) -> Region:
        """Return the region above the uppermost edge that ends where the upper edge does."""
        end, region = self.up.dst, self.above
        while region.up.dst is end:
            region = region.above
        return region


class SweepLine:
    """The regions in a ring; `head` stands for the outside, above the top and below the bottom."""

    def __init__(self) -> None:
        self.head = Region(None)
        self.event = Vertex()  # the vertex that the sweep has reached

    def insert_below(self, region: Region, new: Region) -> None:
        """Insert a region where it belongs, at some place below another one."""
        place = region.prev
        while place is not self.head and not self.is_not_above(place.up, new.up):
            place = place.prev
        new.next, place.next.prev, new.prev, place.next = place.next, new, place, new

    def find(self, edge: HalfEdge) -> Region:
        """Return the region that an edge begins in."""
        region = self.head.next
        while region is not self.head and not self.is_not_above(edge, region.up):
            region = region.next
        return region

    def is_not_above(self, one: HalfEdge, other: HalfEdge) -> bool:
        """Return whether an edge is not above another one at the event; edges go from right to left."""
        event = self.event
        if one.dst is event:
            if other.dst is event:  # compare slopes
                if is_before(one.org, other.org):
                    return side(other.dst, one.org, other.org) <= 0
                return side(one.dst, other.org, one.org) >= 0
            return side(other.dst, event, other.org) <= 0
        if other.dst is event:
            return side(one.dst, event, one.org) >= 0
        return height(one.dst, event, one.org) >= height(other.dst, event, other.org)
