"""The built-in scenes: small, quick to draw, and each designed to show one thing, or one failure."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from softshadow.errors import SceneError, nearest
from softshadow.scene import shapes
from softshadow.scene.camera import Camera
from softshadow.scene.light_shapes import Rectangle, Sphere
from softshadow.scene.lights import Light
from softshadow.scene.mesh import Mesh
from softshadow.scene.placement import placement
from softshadow.scene.scene import Material, Scene, SceneObject

SAND, BRICK, SKY, LEAF, GOLD, STONE = (
    (0.85, 0.80, 0.70),
    (0.80, 0.35, 0.25),
    (0.30, 0.50, 0.80),
    (0.35, 0.65, 0.35),
    (0.85, 0.65, 0.20),
    (0.65, 0.65, 0.68),
)


def boxes() -> Scene:
    """Three boxes on a floor: the plain case, where every technique is right."""
    return Scene(
        "boxes",
        Camera((2.6, 3.0, 4.8), (0.25, 0.45, 0.1), fov_y=40, near=1, far=30),
        (Light((-2.2, 4.2, 2.2)),),
        (
            _floor(),
            _caster(shapes.box(), BRICK, (-1.3, 0.5, 0), (20, 0, 1, 0), name="cube"),
            _caster(shapes.box(0.8, 1.6, 0.8), SKY, (0.3, 0.8, -0.9), (35, 0, 1, 0), name="tower"),
            _caster(shapes.box(0.6), LEAF, (1.1, 0.3, 0.8), (-15, 0, 1, 0), name="block"),
        ),
    )


def torus() -> Scene:
    """A torus over a floor: a shadow with a hole, and a caster that shadows itself."""
    return Scene(
        "torus",
        Camera((2.4, 3.0, 4.6), (-0.1, 0.75, 0), fov_y=40, near=1, far=30),
        (Light((1.5, 6, 2)),),
        (
            _floor(),
            _caster(shapes.torus(0.9, 0.33), GOLD, (0, 1.4, 0), (50, 1, 0, 0.3), shine=40),
        ),
    )


def overlapping() -> Scene:
    """Two casters, one behind the other as seen from the light: counts of two, where parity says lit."""
    return Scene(
        "overlapping",
        Camera((2.8, 2.8, 4.8), (0.2, 0.85, 0), fov_y=40, near=1, far=30),
        (Light((-2, 6, 1)),),
        (
            _floor(),
            _caster(shapes.box(1.2, 0.3, 1.2), BRICK, (-0.3, 2.0, 0.3), (15, 0, 1, 0), name="upper"),
            _caster(shapes.sphere(0.5, 24, 12), SKY, (0.1, 0.9, 0.1), name="lower"),
        ),
    )


def light_between() -> Scene:
    """A low light between boxes, and a slab above it: projected onto the floor, the slab casts an anti-shadow."""
    return Scene(
        "light-between",
        Camera((1.4, 3.2, 6.2), (0.1, 1.0, 0.2), fov_y=40, near=1, far=40),
        (Light((0, 1.7, 0.2)),),
        (
            _floor(),
            _caster(shapes.box(0.7, 1.2, 0.7), BRICK, (-1.5, 0.6, 0), (20, 0, 1, 0), name="left"),
            _caster(shapes.box(0.6, 0.9, 0.6), SKY, (1.3, 0.45, 0.5), (-30, 0, 1, 0), name="right"),
            _caster(shapes.sphere(0.3, 24, 12), LEAF, (-0.3, 0.5, 1.2), name="ball"),
            _caster(shapes.box(1.0, 0.15, 0.8), GOLD, (0.3, 2.8, 0), (10, 0, 1, 0), name="slab"),
        ),
    )


def room() -> Scene:
    """A light inside a closed room: six receivers around it, more than one shadow map can cover."""
    x, y, z = 3.0, 3.2, 3.5
    walls: list[tuple[str, Sequence[float], Sequence[float], Sequence[float], Sequence[float]]] = [
        ("floor", (-x, 0, z), (2 * x, 0, 0), (0, 0, -2 * z), SAND),
        ("ceiling", (-x, y, -z), (2 * x, 0, 0), (0, 0, 2 * z), STONE),
        ("back wall", (-x, 0, -z), (2 * x, 0, 0), (0, y, 0), STONE),
        ("front wall", (x, 0, z), (-2 * x, 0, 0), (0, y, 0), STONE),
        ("left wall", (-x, 0, z), (0, 0, -2 * z), (0, y, 0), (0.75, 0.5, 0.45)),
        ("right wall", (x, 0, -z), (0, 0, 2 * z), (0, y, 0), (0.45, 0.6, 0.75)),
    ]
    return Scene(
        "room",
        Camera((0.6, 1.9, 3.3), (-0.1, 1.2, 0), fov_y=70, near=0.2, far=20),
        (Light((0.2, 1.9, -0.4)),),
        (
            *(_receiver(shapes.quad(corner, across, up), color, name) for name, corner, across, up, color in walls),
            _caster(shapes.box(0.8, 1.0, 0.8), BRICK, (-1.5, 0.5, -1.2), (25, 0, 1, 0), name="crate"),
            _caster(shapes.torus(0.4, 0.14, 24, 12), GOLD, (1.5, 1.2, -1.0), (80, 1, 0, 0.4), name="ring"),
            _caster(shapes.sphere(0.3, 24, 12), LEAF, (0.2, 2.7, -1.4), name="lamp"),
        ),
    )


def eye_in_shadow() -> Scene:
    """The eye under a roof: the near rectangle lies inside a volume, so z-pass counts are one too low."""
    return Scene(
        "eye-in-shadow",
        Camera((0.3, 1.3, 4.0), (0, 0.6, -1), fov_y=55, near=0.2, far=40),
        (Light((-1, 9, 1)),),
        (
            _floor(14),
            _caster(shapes.box(3.2, 0.15, 3.4), GOLD, (0.3, 2.4, 3.4), name="roof"),
            _caster(shapes.box(0.9), BRICK, (-0.8, 0.45, -0.5), (25, 0, 1, 0), name="cube"),
            _caster(shapes.sphere(0.45, 24, 12), SKY, (0.8, 0.9, 0), name="ball"),
        ),
    )


def near_cut() -> Scene:
    """The side of a volume cuts the near rectangle: no single start value is right for z-pass."""
    return Scene(
        "near-cut",
        Camera((2.4, 1.3, 4.0), (0.5, 0.6, -1), fov_y=55, near=0.5, far=40),
        (Light((-1, 9, 1)),),
        eye_in_shadow().objects,
    )


def thin_wall() -> Scene:
    """A thin wall on the floor: a depth bias detaches its shadow from its foot, or lets light through."""
    return Scene(
        "thin-wall",
        Camera((1.6, 2.6, 5.0), (0.1, 0.5, 0.5), fov_y=40, near=1, far=30),
        (Light((-1.8, 3.4, -3.2)),),
        (
            _floor(),
            _caster(shapes.wall(2.4, 1.3, 0.03), BRICK, (0, 0, 0), (10, 0, 1, 0)),
            _caster(shapes.cylinder(0.03, 1.6, 16), SKY, (1.5, 0.8, -0.4), name="pole"),
        ),
    )


def staircase() -> Scene:
    """Receivers at several heights: the crate behind the steps must not cast a (false) shadow up onto them."""
    rise, tread, half = 0.35, 0.7, 1.6
    steps = []
    for step in range(4):
        z = 0.6 - step * tread
        low, high = step * rise, (step + 1) * rise
        steps.append(
            _receiver(shapes.quad((-half, low, z), (2 * half, 0, 0), (0, rise, 0)), STONE, f"riser {step + 1}")
        )
        steps.append(
            _receiver(shapes.quad((-half, high, z), (2 * half, 0, 0), (0, 0, -tread)), SAND, f"tread {step + 1}")
        )
    return Scene(
        "staircase",
        Camera((2.6, 3.2, 5.0), (0.1, 0.65, -0.1), fov_y=40, near=1, far=30),
        (Light((-1.8, 5, 4)),),
        (
            _floor(),
            *steps,
            _caster(shapes.torus(0.5, 0.16, 24, 12), GOLD, (0.2, 1.9, 0.2), (75, 1, 0, 0.2)),
            _caster(shapes.box(0.5, 0.9, 0.5), BRICK, (-0.8, 0.45, 1.5), (20, 0, 1, 0), name="post"),
            _caster(shapes.sphere(0.25, 24, 12), SKY, (1.0, 0.25, 1.3), name="ball"),
            _caster(shapes.box(0.6, 0.9, 0.6), LEAF, (0.5, 0.45, -3.4), name="crate behind"),
        ),
    )


def sunlight() -> Scene:
    """A light at infinity: parallel projection, volumes that end in one point, orthographic shadow maps."""
    return Scene(
        "sunlight",
        Camera((2.6, 3.0, 4.8), (0.25, 0.45, 0.1), fov_y=40, near=1, far=30),
        (Light((-0.9, 1.8, 0.8, 0), name="sun"),),
        boxes().objects,
    )


def spotlight() -> Scene:
    """A spot light: outside its cone there is no light, and one shadow map along its axis covers the cone."""
    # many cells, so that GL's lighting per vertex shows the cone
    return Scene(
        "spotlight",
        Camera((2.6, 3.0, 4.8), (0.1, 0.35, 0.1), fov_y=40, near=1, far=30),
        (Light((-2.2, 4.2, 2.2), name="spot", axis=(2.3, -4.0, -2.3), cutoff=20),),
        (_receiver(shapes.floor(12, cells=40), SAND, "floor"), *boxes().objects[1:]),
    )


def two_lights() -> Scene:
    """A warm and a cool light: each has its own shadow, and where they overlap only ambient light is left."""
    return Scene(
        "two-lights",
        Camera((0.5, 3.2, 5.4), (0.1, 0.5, 0), fov_y=40, near=1, far=30),
        (Light((3, 5, 2), (0.75, 0.6, 0.4), "warm"), Light((-3, 4.5, 2.5), (0.3, 0.4, 0.6), "cool")),
        (
            _floor(),
            _caster(shapes.cylinder(0.45, 1.5), STONE, (0, 0.75, 0)),
            _caster(shapes.tetrahedron(0.9), LEAF, (1.4, 0.45, 0.8), (30, 0, 1, 0)),
        ),
    )


def open_tube() -> Scene:
    """An open mesh: a tube without lids, where every face casts, turned towards the light."""
    return Scene(
        "open-tube",
        Camera((2.4, 3.0, 4.4), (0, 0.7, 0), fov_y=40, near=1, far=30),
        (Light((2, 5, 1)),),
        (
            _floor(),
            _caster(shapes.cylinder(0.6, 1.2, capped=False), GOLD, (0, 1.1, 0), (25, 1, 0, 1), name="tube"),
        ),
    )


def soft_slab() -> Scene:
    """A square light, a slab and a floor, all parallel: umbra and penumbra are as wide as the formula says."""
    return Scene(
        "soft-slab",
        Camera((2.9, 3.3, 5.2), (0.2, 0.7, 0.1), fov_y=45, near=1, far=30),
        (Light((0, 4, 0), shape=Rectangle((1, 0, 0), (0, 0, 1))),),
        (
            _floor(),
            # wider than the light, so that its upper edges, at a height of 2, alone bound umbra and penumbra
            _caster(shapes.box(1.5, 0.125, 1.5), BRICK, (0, 1.9375, 0), name="slab"),
        ),
    )


def soft_overlap() -> Scene:
    """Two slabs before the same part of the light: what each of them hides must not be added."""
    return Scene(
        "soft-overlap",
        Camera((2.9, 3.3, 5.2), (0.1, 0.8, 0.1), fov_y=45, near=1, far=30),
        (Light((-0.4, 4.5, 0.3), shape=Rectangle((1.2, 0, 0), (0, 0, 1.2))),),
        (
            _floor(),
            _caster(shapes.box(1.0, 0.1, 1.4), BRICK, (-0.2, 2.4, 0.1), (8, 0, 1, 0), name="upper"),
            _caster(shapes.box(1.7, 0.1, 1.1), SKY, (0.3, 1.1, 0.0), (8, 0, 1, 0), name="lower"),
        ),
    )


def soft_torus() -> Scene:
    """A ball of light over a torus: the silhouette of a curved body differs from place to place on the light."""
    return Scene(
        "soft-torus",
        Camera((2.4, 3.0, 4.6), (-0.1, 0.75, 0), fov_y=40, near=1, far=30),
        (Light((1.5, 5, 2), shape=Sphere(0.7)),),
        (
            _floor(),
            _caster(shapes.torus(0.9, 0.33, 48, 24), GOLD, (0, 1.4, 0), (50, 1, 0, 0.3), shine=40),
        ),
    )


_SCENES: dict[str, Callable[[], Scene]] = {
    build.__name__.replace("_", "-"): build
    for build in (
        boxes,
        torus,
        overlapping,
        light_between,
        room,
        eye_in_shadow,
        thin_wall,
        staircase,
        near_cut,
        sunlight,
        spotlight,
        two_lights,
        open_tube,
        soft_slab,
        soft_overlap,
        soft_torus,
    )
}


def scene_names() -> tuple[str, ...]:
    """Return the names of the built-in scenes."""
    return tuple(_SCENES)


def scene_title(name: str) -> str:
    """Return one sentence on what a built-in scene shows.

    Raises
    ------
    SceneError      there is no such scene; the message suggests the nearest name
    """
    return str(_builder(name).__doc__).strip()


def named_scene(name: str) -> Scene:
    """Return a built-in scene; `scene_names()` lists them.

    Raises
    ------
    SceneError      there is no such scene; the message suggests the nearest name
    """
    return replace(_builder(name)(), title=scene_title(name))


def _builder(name: str) -> Callable[[], Scene]:
    if name not in _SCENES:
        raise SceneError(f"scene: no built-in scene is called {name!r}; {nearest(name, _SCENES)}")
    return _SCENES[name]


def _floor(width: float = 12) -> SceneObject:
    return _receiver(shapes.floor(width), SAND, "floor")


def _receiver(mesh: Mesh, color: Sequence[float], name: str) -> SceneObject:
    return SceneObject(mesh, material=Material(np.array(color)), casts=False, receives=True, name=name)


def _caster(
    mesh: Mesh,
    color: Sequence[float],
    move: Sequence[float],
    turn: Sequence[float] = (0, 0, 1, 0),
    *,
    shine: float = 0,
    name: str = "",
) -> SceneObject:
    specular = np.full(3, 0.5 if shine else 0.0)
    return SceneObject(mesh, placement(move, turn), Material(np.array(color), specular, shine), name=name)
