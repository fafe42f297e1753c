"""Failures of meshes: techniques that assume a closed solid, and meshes that are not."""

from dataclasses import replace
from functools import partial

import numpy as np

from softshadow.gallery.failure import Failure, Setting
from softshadow.gallery.measures import COUNTED, wrong_colors, wrong_on_receivers
from softshadow.gallery.stencil import PARITY, altered
from softshadow.scene import Material, Mesh, Scene, SceneObject
from softshadow.scene.placement import placement

HALF, RIDGE, EAVES, SPAN = 2.0, 1.4, 1.1, 0.8  # of the roof: half its length, two heights, half its width
DROP = 0.06  # how far the vertex that only one slope has lies below the ridge: 1.5 % of the ridge's length


def roof(welded: bool) -> Scene:
    """Return a roof over a floor; its ridge has an extra vertex in the front slope, and if welded in both slopes."""
    left, right = (-HALF, RIDGE, 0.0), (HALF, RIDGE, 0.0)
    middle = (-0.3 * HALF, RIDGE if welded else RIDGE - DROP, 0.0)
    (back_left, back_right), (front_left, front_right) = (((-HALF, EAVES, z), (HALF, EAVES, z)) for z in (-SPAN, SPAN))
    front = [(left, front_left, middle), (middle, front_left, front_right), (middle, front_right, right)]
    whole = [(left, right, back_right), (left, back_right, back_left)]
    divided = [(left, middle, back_left), (middle, right, back_right), (middle, back_right, back_left)]
    corners = np.array(front + (divided if welded else whole)).reshape(-1, 3)
    mesh = Mesh(corners, np.arange(len(corners)).reshape(-1, 3), name="roof")
    scene = Scene.named("boxes")
    slopes = SceneObject(mesh, placement((-0.3, 0, 0), (25, 0, 1, 0)), Material((0.8, 0.35, 0.25)))
    return replace(scene, name="a roof", objects=(*scene.receivers, slopes))


FAILURES = (
    Failure(
        "t-junction-leak", "A vertex on one side of an edge only", "meshes", "E12, SK:250-257",
        "Two faces do not share an edge if only one of them has a vertex in the middle of it. Where this vertex is off "
        "the line, there is a gap that lets light through.",
        partial(roof, welded=True),
        Setting("volume-zfail", make_scene=partial(roof, welded=False)),
        Setting("volume-zfail"),
        wrong_on_receivers, "floor pixels whose colour is not that of the lights they see",
    ),
    Failure(
        "open-mesh-leak", "An open mesh has no far side", "meshes", "E27, SK:374-377",
        "The map stores only faces that look away from the light, and an open mesh has none behind some lit faces.",
        lambda: Scene.named("open-tube"),
        Setting("map", {"cull": "front"}),
        Setting("map"),
        wrong_on_receivers, "floor pixels whose colour is not that of the lights they see",
        why_floor="on the tube itself, of whose single sheet a map lights both sides",
    ),
    Failure(
        "open-mesh-parity", "Every layer of an open mesh counts", "meshes", "E12, E13, E38",
        "All faces of an open mesh cast shadows, as if facing the light, so two walls make an even number.",
        lambda: Scene.named("open-tube"),
        altered("volume-zfail", *PARITY),
        Setting("volume-zfail"),
        wrong_colors, COUNTED,
    ),
)  # fmt: skip
