"""The shapes of GLUT by the names of their functions, solid or as lines."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from softshadow.windows.glut.polyhedra import draw_cube, draw_polyhedron, draw_sponge
from softshadow.windows.glut.round_shapes import draw_cone, draw_cylinder, draw_sphere, draw_torus
from softshadow.windows.glut.tea_set import TeaSet

POLYHEDRA = ("Dodecahedron", "Icosahedron", "Octahedron", "RhombicDodecahedron", "Tetrahedron")


def shape_calls() -> dict[str, Callable[..., Any]]:
    """Return the functions that draw shapes, for one program."""
    calls: dict[str, Callable[..., Any]] = {}
    tea_set = TeaSet()
    for kind, solid in (("Solid", True), ("Wire", False)):
        named: dict[str, Callable[..., Any]] = {
            "Sphere": draw_sphere, "Cone": draw_cone, "Cylinder": draw_cylinder, "Torus": draw_torus,
            "Cube": draw_cube, "SierpinskiSponge": draw_sponge,
        }  # fmt: skip
        calls |= {f"glut{kind}{name}": partial(draw, solid) for name, draw in named.items()}
        for name in POLYHEDRA:
            calls[f"glut{kind}{name}"] = partial(draw_polyhedron, solid, name.lower())
        for name in ("Teapot", "Teacup", "Teaspoon"):
            calls[f"glut{kind}{name}"] = partial(tea_set.draw, solid, name.lower())
    return calls
