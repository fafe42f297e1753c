"""The vertices in the order in which the sweep reaches them: those of the polygon sorted, crossings in a heap.

Vertices at one place come out in libGLU's order, which is that of its sorting (libtess, priorityq.c, priorityq-heap.c).
"""

from __future__ import annotations

from softshadow.tessellation.half_edges import Vertex
from softshadow.tessellation.places import is_before

SHORT = 10  # longer parts are divided; these are sorted by insertion
SEED, FACTOR, WORD = 2016473283, 1539415821, 1 << 64  # of the random pivots


class EventQueue:
    """A queue of vertices; `Vertex.handle` is its place in it: negative for sorted vertices, else that in the heap."""

    def __init__(self, vertices: list[Vertex]) -> None:
        self._removed: set[int] = set()
        for number, vertex in enumerate(vertices):
            vertex.handle = -(number + 1)
        self._sorted = sorted_backwards(vertices)
        self._heap: list[Vertex] = []

    def minimum(self) -> Vertex | None:
        """Return the next vertex, which stays in the queue; None if it is empty."""
        if not self._sorted:
            return self._heap[0] if self._heap else None
        if self._heap and is_before(self._heap[0], self._sorted[-1]):
            return self._heap[0]
        return self._sorted[-1]

    def pop(self) -> Vertex | None:
        """Take the next vertex out of the queue; None if it is empty."""
        vertex = self.minimum()
        if vertex is None:
            return None
        if vertex.handle >= 0:
            self._remove_from_heap(0)
        else:
            self._sorted.pop()
            self._drop_removed()
        return vertex

    def add(self, vertex: Vertex) -> None:
        """Add a vertex where edges cross."""
        self._heap.append(vertex)
        self._float_up(len(self._heap) - 1)

    def remove(self, vertex: Vertex) -> None:
        """Remove a vertex that has become one with another."""
        if vertex.handle >= 0:
            self._remove_from_heap(vertex.handle)
        else:
            self._removed.add(vertex.handle)
            self._drop_removed()

    def _drop_removed(self) -> None:
        while self._sorted and self._sorted[-1].handle in self._removed:
            self._sorted.pop()

    def _remove_from_heap(self, place: int) -> None:
        last = self._heap.pop()
        if place == len(self._heap):
            return
        self._heap[place] = last
        parent = (place - 1) // 2
        if place == 0 or is_before(self._heap[parent], last):
            self._float_down(place)
        else:
            self._float_up(place)

    def _float_up(self, place: int) -> None:
        heap, vertex = self._heap, self._heap[place]
        while place:
            parent = (place - 1) // 2
            if is_before(heap[parent], vertex):
                break
            self._put(heap[parent], place)
            place = parent
        self._put(vertex, place)

    def _float_down(self, place: int) -> None:
        heap, vertex = self._heap, self._heap[place]
        while True:
            child = 2 * place + 1
            if child + 1 < len(heap) and is_before(heap[child + 1], heap[child]):
                child += 1
            if child >= len(heap) or is_before(vertex, heap[child]):
                break
            self._put(heap[child], place)
            place = child
        self._put(vertex, place)

    def _put(self, vertex: Vertex, place: int) -> None:
        self._heap[place] = vertex
        vertex.handle = place


def sorted_backwards(vertices: list[Vertex]) -> list[Vertex]:
    """Return the vertices, the last one first, by a quicksort whose pivots decide the order of equal ones."""
    order, seed = list(vertices), SEED
    waiting = [(0, len(order) - 1)]
    while waiting:
        first, last = waiting.pop()
        while last > first + SHORT:
            seed = (seed * FACTOR + 1) % WORD
            i = first + seed % (last - first + 1)
            pivot = order[i]
            order[i], order[first] = order[first], pivot
            i, j = first - 1, last + 1
            while True:
                i, j = i + 1, j - 1
                while not is_before(order[i], pivot):
                    i += 1
                while not is_before(pivot, order[j]):
                    j -= 1
                if i >= j:
                    break
                order[i], order[j] = order[j], order[i]
            if i - first < last - j:
                waiting.append((j + 1, last))
                last = i - 1
            else:
                waiting.append((first, i - 1))
                first = j + 1
        for i in range(first + 1, last + 1):
            vertex, j = order[i], i
            while j > first and not is_before(vertex, order[j - 1]):
                order[j] = order[j - 1]
                j -= 1
            order[j] = vertex
    return order
