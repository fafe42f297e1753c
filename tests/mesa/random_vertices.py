"""The triangles that rasterizers get wrong: each kind makes vertices (x, y, z, w) out of ordinary ones."""

from typing import Any, Protocol

Vertex = tuple[float, ...]


class Draw(Protocol):
    """What a kind needs to draw numbers: the writer of a random program."""

    size: tuple[int, int]

    def pick(self, choices: Any) -> Any: ...
    def number(self, low: float, high: float) -> float: ...
    def integer(self, low: int, high: int) -> int: ...


def tiny(draw: Draw, ordinary: list[Vertex]) -> list[Vertex]:
    x, y, z, _ = ordinary[0]
    size = draw.pick([0.002, 0.02, 0.1])
    return [
        (x + draw.number(-size, size), y + draw.number(-size, size), z + draw.number(-size, size), 1.0)
        for _ in ordinary
    ]


def huge(draw: Draw, ordinary: list[Vertex]) -> list[Vertex]:
    scale = draw.pick([10.0, 1e3, 1e5, 1e7])
    return [(x * scale, y * scale, z * draw.pick([1.0, scale]), 1.0) for x, y, z, _ in ordinary]


def repeated(draw: Draw, ordinary: list[Vertex]) -> list[Vertex]:
    return [draw.pick(ordinary[:3]) for _ in ordinary]


def collinear(draw: Draw, ordinary: list[Vertex]) -> list[Vertex]:
    (x0, y0, z0, _), (x1, y1, z1, _) = ordinary[:2]
    places = [draw.pick([0.0, 0.25, 0.5, 1.0, -1.0]) for _ in ordinary]
    return [(x0 + t * (x1 - x0), y0 + t * (y1 - y0), z0 + t * (z1 - z0), 1.0) for t in places]


def coplanar(draw: Draw, ordinary: list[Vertex]) -> list[Vertex]:
    a, b, c = draw.number(-1, 1), draw.number(-1, 1), draw.number(-0.5, 0.5)
    return [(x, y, a * x + b * y + c, 1.0) for x, y, _, _ in ordinary]


def steep(draw: Draw, ordinary: list[Vertex]) -> list[Vertex]:
    return [(x * 0.01, y, z, 1.0) for x, y, z, _ in ordinary]


def grid(draw: Draw, ordinary: list[Vertex]) -> list[Vertex]:
    """On pixel centres, corners and quarters: every edge function meets zero."""
    width, height = draw.size
    return [
        (draw.integer(-4, 4 * width + 4) / (2 * width) - 1, draw.integer(-4, 4 * height + 4) / (2 * height) - 1, z, 1.0)
        for _, _, z, _ in ordinary
    ]


def frustum_plane(draw: Draw, ordinary: list[Vertex]) -> list[Vertex]:
    return [
        (draw.pick([-1.0, 1.0, x]), draw.pick([-1.0, 1.0, y]), draw.pick([-1.0, 1.0, z]), 1.0)
        for x, y, z, _ in ordinary
    ]


def homogeneous(draw: Draw, ordinary: list[Vertex]) -> list[Vertex]:
    return [(x, y, z, draw.pick([1.0, 0.5, 0.0, -1.0, draw.number(-1, 2)])) for x, y, z, _ in ordinary]


def infinite(draw: Draw, ordinary: list[Vertex]) -> list[Vertex]:
    """A shadow volume's side: every second vertex at infinity."""
    return [(x, y, z, float(index % 2)) for index, (x, y, z, _) in enumerate(ordinary)]


WILD = [tiny, huge, repeated, collinear, coplanar, steep, grid, frustum_plane, homogeneous, infinite]
