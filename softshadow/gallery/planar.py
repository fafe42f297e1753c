"""Failures of projected planar shadows: two surfaces in one plane, and rays that are lines to a formula."""

from dataclasses import replace

import numpy as np

from softshadow.gallery.calls import AlteredCall
from softshadow.gallery.course_stage import as_listed, scene_of
from softshadow.gallery.failure import Failure, Setting
from softshadow.gallery.measures import (
    COUNTED,
    darkened_twice,
    painted_background,
    painted_casters,
    painted_lit,
    wrong_colors,
    wrong_paint,
    wrong_paint_on_receivers,
)
from softshadow.listings.stage import LOW_LAMP, STAGE, Thing, moved
from softshadow.scene import Scene, SceneObject
from softshadow.scene.shapes import box, floor

BLENDED = {"method": "stencil-blend"}

# a lamp below a slab: rays from it never go up and come down again
UNDER_A_SLAB = replace(LOW_LAMP, occluder=LOW_LAMP.occluder[:2])
# a post that reaches from below the lamp to above it
BESIDE_A_POST = replace(
    LOW_LAMP, occluder=(Thing(moved(box(0.3, 2.2, 0.3, name="post"), -0.2, 1.1, 0.1), (0.9, 0.4, 0.2)),)
)

# boxes above the floor: an offset that lifts shadows lifts none over their feet
IN_THE_AIR = replace(
    STAGE,
    occluder=(
        Thing(moved(box(1.4, 0.7, 1.4, name="lower box"), 0.0, 0.9, 0.0), (0.9, 0.4, 0.2)),
        Thing(moved(box(0.7, 0.7, 0.7, name="upper box"), 0.1, 2.2, -0.1), (0.2, 0.5, 0.9)),
    ),
)

# a box below the floor, on the way of rays that meet the floor in light
UNDER_THE_FLOOR = replace(
    STAGE,
    occluder=(STAGE.occluder[0], Thing(moved(box(0.5, name="box below the floor"), 1.3, -0.4, 1.7), (0.3, 0.8, 0.3))),
)


def with_other_sign(matrix: np.ndarray) -> tuple[np.ndarray]:
    """Return the argument of glMultMatrixd, a projection negated and any other matrix as it is."""
    affine = (matrix[:, 3] == (0, 0, 0, 1)).all()  # in GL's memory order a row is a column
    return (matrix if affine else -matrix,)


def small_floor() -> Scene:
    """Return the boxes on a floor that ends within their shadows."""
    scene = Scene.named("boxes")
    ground = SceneObject(floor(3.4, name="floor"), material=scene.receivers[0].material, casts=False, receives=True)
    return replace(scene, name="boxes on a small floor", objects=(ground, *scene.casters))


FAILURES = (
    Failure(
        "z-fighting", "Shadow and floor fight for each pixel", "planar", "E15, SK:197, CA:100",
        "The flattened caster lies in the plane of the floor, so that rounding decides which of the two is nearer.",
        lambda: Scene.named("torus"),
        Setting("planar", {"method": "offset", "factor": 0.0, "units": 0.0}),
        Setting("planar", {"method": "offset"}),
        wrong_paint, "pixels of the shadow that are not painted, or painted without shadow",
    ),
    Failure(
        "offset-too-large", "The offset lifts the shadow before what stands there", "planar", "SK:116",
        "An offset moves the shadow towards the eye by a part of the depth range, past all that is nearer than that.",
        lambda: scene_of(IN_THE_AIR, "boxes in the air"),
        Setting("planar", {"method": "offset", "units": -400000.0}),
        Setting("planar", {"method": "offset"}),
        painted_casters, "pixels of casters that are painted with the shadow behind them",
    ),
    Failure(
        "double-blending", "Overlapping layers darken twice", "planar", "SK:199",
        "The front and the back of a caster, and casters behind each other, are flattened onto the same pixels, and "
        "each layer takes away its share of the light.",
        lambda: Scene.named("boxes"),
        Setting("planar", BLENDED, (
            AlteredCall("glStencilOp(GL_KEEP, GL_KEEP, GL_ZERO)", "glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP)"),
        )),
        Setting("planar", BLENDED),
        darkened_twice, "pixels darker than one layer makes them",
    ),
    Failure(
        "shadow-outside-receiver", "The shadow hangs in the air beside the floor", "planar", "E16, E33, SK:195",
        "The flattened caster lies in the floor's plane, which does not end where the floor does.",
        small_floor,
        Setting("planar", BLENDED, (
            AlteredCall("glStencilFunc(GL_EQUAL, 1, 255)", "glStencilFunc(GL_ALWAYS, 1, 255)"),
        )),
        Setting("planar", BLENDED),
        painted_background, "pixels of the background that are painted with shadow",
    ),
    Failure(
        "anti-shadow", "What is behind the light casts a shadow", "planar", "E21, SK:175-180",
        "A point behind the light has t < 0: the line through it and the light meets the floor, the ray does not.",
        lambda: scene_of(UNDER_A_SLAB, "lamp under a slab"),
        as_listed("planar-rays", "E21", stage=UNDER_A_SLAB),
        as_listed("planar-rays", stage=UNDER_A_SLAB),
        wrong_paint, "pixels with shadow that have none, or without that have one",
    ),
    Failure(
        "false-shadow", "What is behind the receiver casts a shadow on it", "planar", "E16, E21",
        "A point behind the receiver has 0 < t < 1: its ray has met the receiver before it comes to the point.",
        lambda: scene_of(UNDER_THE_FLOOR, "a box below the floor"),
        Setting("planar", {"clip": False}),
        Setting("planar"),
        painted_lit, "pixels that are painted with shadow and have none",
    ),
    Failure(
        "wrong-matrix-sign", "The matrix has the other sign, and there is no shadow", "planar", "E35, CA:369-383",
        "S and -S project alike, but with -S every caster has w < 0, and GL clips it away.",
        lambda: Scene.named("boxes"),
        Setting("planar", {}, (AlteredCall("glMultMatrixd", with_other_sign),)),
        Setting("planar"),
        wrong_paint, "pixels of the shadow that are not painted, or painted without shadow",
    ),
    Failure(
        "light-direction", "The direction of travel instead of that towards the light", "planar", "E36, CA:385-396",
        "With the direction turned round w is negative for all that is above the floor, and GL clips it away.",
        lambda: Scene.named("sunlight"),
        Setting("planar", {}, (AlteredCall("glMultMatrixd", with_other_sign),)),
        Setting("planar"),
        wrong_paint, "pixels of the shadow that are not painted, or painted without shadow",
    ),
    Failure(
        "cpu-division", "Vertices divided by w before GL clips", "planar", "E21, SK:139-153",
        "A triangle that reaches from below the light to above it is torn: its corners come down on either side, and "
        "what is filled between them is not its shadow; GL clips at w = 0 first and divides then.",
        lambda: scene_of(BESIDE_A_POST, "lamp beside a post"),
        as_listed("planar-rays", "E21", stage=BESIDE_A_POST),
        as_listed("planar-rays", stage=BESIDE_A_POST),
        wrong_paint_on_receivers, "pixels with shadow that have none, or without that have one",
    ),
    Failure(
        "painting-over-nearer", "Shadow is painted over nearer objects", "planar", "E15, RO1:64-68",
        "With the depth test off, whatever is drawn last is seen, also where something stands before it.",
        lambda: scene_of(IN_THE_AIR, "boxes in the air"),
        as_listed("planar-polygons", "E15", stage=IN_THE_AIR),
        as_listed("planar-polygons", stage=IN_THE_AIR),
        painted_casters, "pixels of casters that are painted with the shadow behind them",
    ),
    Failure(
        "casters-before-shadow", "The scene is drawn before its shadows", "planar", "E60, SK:163-171",
        "Shadow and floor have equal depths but for rounding; what casts must be drawn after its shadow, so that the "
        "shadow needs no depth test.",
        lambda: scene_of(IN_THE_AIR, "boxes in the air"),
        as_listed("planar-darken", "E60", stage=IN_THE_AIR),
        as_listed("planar-darken", stage=IN_THE_AIR),
        wrong_paint_on_receivers, "pixels of the floor with shadow that have none, or without that have one",
    ),
    Failure(
        "no-self-shadow", "Nothing but receivers has shadows", "planar", "SK:182-183, RO1:71",
        "A matrix flattens casters onto one plane: on each other and on themselves they have no shadow.",
        lambda: Scene.named("torus"),
        Setting("planar"),
        Setting("volume-zfail"),
        wrong_colors, COUNTED,
    ),
    Failure(
        "modulative-lights", "Shadows darken the picture instead of leaving a light out", "planar", "E53, RO1:361",
        "Where one light is hidden the other still shines, but a shadow that is blended takes its share of both.",
        lambda: Scene.named("two-lights"),
        Setting("shadow-polygons", {"method": "decal", "combine": "modulate"}),
        Setting("shadow-polygons", {"method": "decal"}),
        wrong_colors, "pixels whose colour is not that of the lights they see",
    ),
)  # fmt: skip
