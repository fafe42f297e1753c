"""Failures of projected planar shadows: coplanar surfaces, and rays that the projection treats as whole lines."""

from dataclasses import replace

import numpy as np

from softshadow.gallery.calls import AlteredCall
from softshadow.gallery.course_stage import as_listed, scene_of
from softshadow.gallery.failure import Failure, Setting
from softshadow.gallery.measures import (
    COUNTED,
    darkened_twice,
    wrong_colors,
    wrong_paint,
)
from softshadow.listings.stage import LOW_LAMP, STAGE, Thing, moved
from softshadow.scene import Scene, SceneObject
from softshadow.scene.shapes import box, floor

# in words: what `wrong_paint` counts
PAINTED = "pixels that are painted where no shadow falls on the floor, or not painted where one does"
BLENDED = {"method": "stencil-blend"}

# a lamp below a slab: no ray that meets the slab returns to the floor
UNDER_A_SLAB = replace(LOW_LAMP, occluder=LOW_LAMP.occluder[:2])
# a post that reaches from below the lamp to above it
BESIDE_A_POST = replace(
    LOW_LAMP, occluder=(Thing(moved(box(0.3, 2.2, 0.3, name="post"), -0.2, 1.1, 0.1), (0.9, 0.4, 0.2)),)
)

# boxes above the floor, so that no lifted shadow covers the place where they stand
IN_THE_AIR = replace(
    STAGE,
    occluder=(
        Thing(moved(box(1.4, 0.7, 1.4, name="lower box"), 0.0, 0.9, 0.0), (0.9, 0.4, 0.2)),
        Thing(moved(box(0.7, 0.7, 0.7, name="upper box"), 0.1, 2.2, -0.1), (0.2, 0.5, 0.9)),
    ),
)

# the same on a floor that their shadows do not leave
OVER_A_WIDE_FLOOR = replace(IN_THE_AIR, receiver=(Thing(floor(9), STAGE.receiver[0].color),))

# a box below the floor, on rays that reach the floor unblocked
UNDER_THE_FLOOR = replace(
    STAGE,
    occluder=(STAGE.occluder[0], Thing(moved(box(0.5, name="box below the floor"), 1.3, -0.4, 1.7), (0.3, 0.8, 0.3))),
)


def with_other_sign(matrix: np.ndarray) -> tuple[np.ndarray]:
    """Return the argument of glMultMatrixd: a projection negated, any other matrix unchanged."""
    affine = (matrix[:, 3] == (0, 0, 0, 1)).all()  # in GL's memory order a row is a column
    return (matrix if affine else -matrix,)


def small_floor() -> Scene:
    """Return the boxes on a floor that is smaller than their shadows."""
    scene = Scene.named("boxes")
    ground = SceneObject(floor(3.4, name="floor"), material=scene.receivers[0].material, casts=False, receives=True)
    return replace(scene, name="boxes on a small floor", objects=(ground, *scene.casters))


FAILURES = (
    Failure(
        "z-fighting", "Shadow and floor fight for each pixel", "planar", "E15, SK:197, CA:100",
        "The flattened caster lies in the plane of the floor, so rounding decides which of the two is nearer.",
        lambda: Scene.named("torus"),
        Setting("planar", {"method": "offset", "factor": 0.0, "units": 0.0}),
        Setting("planar", {"method": "offset"}),
        wrong_paint, PAINTED,
    ),
    Failure(
        "offset-too-large", "The offset lifts the shadow in front of other objects", "planar", "SK:116",
        "A large offset moves the shadow so far towards the eye that it hides objects that are nearer than the floor.",
        lambda: scene_of(OVER_A_WIDE_FLOOR, "boxes over a wide floor"),
        Setting("planar", {"method": "offset", "units": -400000.0}),
        Setting("planar", {"method": "offset"}),
        wrong_paint, PAINTED,
    ),
    Failure(
        "double-blending", "Overlapping layers darken twice", "planar", "SK:199",
        "Front and back of a caster, and casters behind each other, are flattened onto the same pixels, and each layer "
        "darkens them again.",
        lambda: Scene.named("boxes"),
        Setting("planar", BLENDED, (
            AlteredCall("glStencilOp(GL_KEEP, GL_KEEP, GL_ZERO)", "glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP)"),
        )),
        Setting("planar", BLENDED),
        darkened_twice, "pixels that are darker than one layer of shadow",
    ),
    Failure(
        "shadow-outside-receiver", "The shadow extends beyond the floor", "planar", "E16, E33, SK:195",
        "The flattened caster lies in the floor's plane, which continues beyond the edge of the floor.",
        small_floor,
        Setting("planar", BLENDED, (
            AlteredCall("glStencilFunc(GL_EQUAL, 1, 255)", "glStencilFunc(GL_ALWAYS, 1, 255)"),
        )),
        Setting("planar", BLENDED),
        wrong_paint, PAINTED,
    ),
    Failure(
        "anti-shadow", "Objects behind the light cast a shadow", "planar", "E21, SK:175-180",
        "A point behind the light has t < 0: the line through it and the light meets the floor, but no ray does.",
        lambda: scene_of(UNDER_A_SLAB, "lamp under a slab"),
        as_listed("planar-rays", "E21", stage=UNDER_A_SLAB),
        as_listed("planar-rays", stage=UNDER_A_SLAB),
        wrong_paint, PAINTED,
    ),
    Failure(
        "false-shadow", "Objects behind the receiver cast a shadow on it", "planar", "E16, E21",
        "A point behind the receiver has 0 < t < 1: the ray meets the receiver before it reaches the point.",
        lambda: scene_of(UNDER_THE_FLOOR, "a box below the floor"),
        Setting("planar", {"clip": False}),
        Setting("planar"),
        wrong_paint, PAINTED,
    ),
    Failure(
        "wrong-matrix-sign", "The matrix has the wrong sign, and the shadow is missing", "planar", "E35, CA:369-383",
        "S and -S are the same projection, but with -S every caster has w < 0, and GL clips it.",
        lambda: Scene.named("boxes"),
        Setting("planar", {}, (AlteredCall("glMultMatrixd", with_other_sign),)),
        Setting("planar"),
        wrong_paint, PAINTED,
    ),
    Failure(
        "light-direction", "The light's direction is reversed", "planar", "E36, CA:385-396",
        "With the direction of travel instead of that towards the light, casters have w < 0, and GL clips them.",
        lambda: Scene.named("sunlight"),
        Setting("planar", {}, (AlteredCall("glMultMatrixd", with_other_sign),)),
        Setting("planar"),
        wrong_paint, PAINTED,
    ),
    Failure(
        "cpu-division", "Vertices divided by w before GL clips", "planar", "E21, SK:139-153",
        "The corners of a triangle that reaches from below the light to above it are projected to opposite sides, and "
        "the area between them is not its shadow. GL clips at w = 0 before it divides.",
        lambda: scene_of(BESIDE_A_POST, "lamp beside a post"),
        as_listed("planar-rays", "E21", stage=BESIDE_A_POST),
        as_listed("planar-rays", stage=BESIDE_A_POST),
        wrong_paint, PAINTED,
    ),
    Failure(
        "painting-over-nearer", "Shadow is painted over nearer objects", "planar", "E15, RO1:64-68",
        "With the depth test off, the last surface drawn is visible, even where another one is nearer.",
        lambda: scene_of(IN_THE_AIR, "boxes in the air"),
        as_listed("planar-polygons", "E15", stage=IN_THE_AIR),
        as_listed("planar-polygons", stage=IN_THE_AIR),
        wrong_paint, PAINTED, floor=16, why_floor="own-shadow polygons reach a pixel over the edges of their faces",
    ),
    Failure(
        "casters-before-shadow", "The scene is drawn before its shadows", "planar", "E60, SK:163-171",
        "Shadow and floor have equal depths except for rounding. Casters must be drawn after their shadows, so that "
        "shadows need no depth test.",
        lambda: scene_of(IN_THE_AIR, "boxes in the air"),
        as_listed("planar-darken", "E60", stage=IN_THE_AIR),
        as_listed("planar-darken", stage=IN_THE_AIR),
        wrong_paint, PAINTED,
    ),
    Failure(
        "no-self-shadow", "Casters have no shadows on themselves or on each other", "planar", "SK:182-183, RO1:71",
        "The matrix flattens casters onto one plane; shadows appear on this plane only.",
        lambda: Scene.named("torus"),
        Setting("planar"),
        Setting("volume-zfail"),
        wrong_colors, COUNTED,
    ),
    Failure(
        "modulative-lights", "Shadows darken the picture instead of omitting a light", "planar", "E53, RO1:361",
        "Where one light is hidden, the other still shines, but a blended shadow darkens the light of both.",
        lambda: Scene.named("two-lights"),
        Setting("shadow-polygons", {"method": "decal", "combine": "modulate"}),
        Setting("shadow-polygons", {"method": "decal"}),
        wrong_colors, "pixels whose colour is not that of the lights they see",
    ),
)  # fmt: skip
