"""The passes of the techniques as counted in ledgers of runs, and the completed table of the course."""

import warnings
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from softshadow.course.passes import ROWS, Row
from softshadow.runs import run
from softshadow.scene import Light, Rectangle, Scene, SceneObject, placement, shapes
from softshadow.scene.lights import WIDEST_CONE
from softshadow.techniques.light_camera import light_camera

SIZE = (24, 18)  # pixels: how many there are does not matter


class Counted(NamedTuple):
    """How often a frame draws a receiver and a caster (with its volume), and its number of passes."""

    receiver: int
    caster: int
    passes: int


def scene_of(lights: int, casters: int, area: bool = False) -> Scene:
    """Return boxes above a floor, all in front of every light."""
    floor = SceneObject(shapes.floor(12), casts=False, receives=True, name="floor")
    boxes = [
        SceneObject(shapes.box(0.6), placement((0.9 * number - 1, 1, 0)), name=f"box {number}")
        for number in range(casters)
    ]
    shape = Rectangle((0.4, 0, 0), (0, 0, 0.4)) if area else None
    color = (0.3, 0.3, 0.3)
    lamps = tuple(Light((2 - k, 6, 1 + k), color, f"light {k}", shape=shape) for k in range(lights))
    return replace(Scene.named("boxes"), objects=(floor, *boxes), lights=lamps)


def count(row: Row, scene: Scene) -> Counted:
    """Return the draws and the passes of a technique of the table on a scene, from the ledger of a run."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        passes = run(row.technique, scene, SIZE, **row.options).ledger.total.passes

    def most(names: set[str]) -> int:
        return max(sum(name in each for each in passes) for name in names)

    receivers, casters = ({thing.name for thing in things} for things in (scene.receivers, scene.casters))
    return Counted(most(receivers), most(casters), len(passes))


def unseen_passes(scene: Scene) -> int:
    """Return how many passes the lights of a scene take for what they do not see (`Row.unseen`)."""
    vertices = np.concatenate([thing.world_positions for thing in scene.objects])
    passes = 0
    for light in scene.lights:
        if light.is_spot:
            passes += 1 + (light.cutoff < WIDEST_CONE)
        else:
            passes += bool(light_camera(scene, light).has_behind(vertices))
    return passes


def markdown_table() -> str:
    """Return the completed table; the counts of draws and passes are measured now, with one, two and three lights."""
    rows = [
        "| technique | receiver | occluder | light | draws of receiver, of occluder | passes, N lights | "
        "counted: 1, 2, 3 lights | on the slide |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for row in ROWS:
        counted = [count(row, scene_of(lights, 2)) for lights in (1, 2, 3)]
        label = " ".join([f"`{row.technique}`", *(f"{key}={value}" for key, value in row.options.items())])
        rows.append(
            f"| {label} | {row.receiver} | {row.occluder} | {row.light} | ×{counted[0].receiver}, "
            f"×{counted[0].caster} | {row.formula} | {', '.join(str(each.passes) for each in counted)} | "
            f"{row.in_slides or '–'} |"
        )
    return "\n".join(rows)
