"""Failures of stencil, depth and culling state: the volumes are right, but one call is wrong or missing."""

from dataclasses import replace
from typing import Any

import numpy as np

from softshadow.gallery.calls import AlteredCall
from softshadow.gallery.course_stage import as_listed, scene_of
from softshadow.gallery.failure import Failure, Setting
from softshadow.gallery.measures import COUNTED, wrong_colors
from softshadow.listings import get
from softshadow.listings.stage import STAGE
from softshadow.scene import Mesh, Scene, SceneObject
from softshadow.scene.placement import placement
from softshadow.scene.shapes import box
from softshadow.techniques import Steps, Technique

PARITY = (
    ("glStencilOp(GL_KEEP, GL_INCR_WRAP, GL_KEEP)", "glStencilOp(GL_KEEP, GL_INVERT, GL_KEEP)"),
    ("glStencilOp(GL_KEEP, GL_DECR_WRAP, GL_KEEP)", "glStencilOp(GL_KEEP, GL_INVERT, GL_KEEP)"),
)
SHEETS = 256  # an 8-bit counter wraps to 0


def altered(technique: str, *calls: tuple[str, str | None]) -> Setting:
    """Return a technique with some of its calls replaced, or omitted (None)."""
    return Setting(technique, {}, tuple(AlteredCall(call, replacement) for call, replacement in calls))


def counted_without_depth_test(gl: Any, scene: Scene, *, size: tuple[int, int]) -> Steps:
    """Draw the listing of z-pass; while it counts, the depth test is disabled."""
    steps = get("volume-zpass").steps(gl)
    yield next(steps)
    gl.glDisable(gl.GL_DEPTH_TEST)
    yield next(steps)
    yield next(steps)
    gl.glEnable(gl.GL_DEPTH_TEST)
    yield from steps


def stack() -> Scene:
    """Return a stack of 256 sheets over a floor."""
    sheet = box(1.2, 0.003, 0.8)
    heights = np.repeat(np.linspace(0.5, 1.8, SHEETS), len(sheet.positions))
    mesh = Mesh(
        np.tile(sheet.positions, (SHEETS, 1)) + heights[:, None] * (0, 1, 0),
        (sheet.triangles + len(sheet.positions) * np.arange(SHEETS)[:, None, None]).reshape(-1, 3),
        np.tile(sheet.normals, (SHEETS, 1)),
        name="stack",
    )
    scene = Scene.named("overlapping")
    sheets = SceneObject(mesh, placement((0, 0, 0), (15, 0, 1, 0)), scene.casters[0].material)
    return replace(scene, name="256 sheets", objects=(*scene.receivers, sheets))


FAILURES = (
    Failure(
        "parity-overlap", "Parity instead of a count", "stencil", "E38, CA:470",
        "GL_INVERT distinguishes odd and even only: in two volumes the bit is inverted twice, and the point is lit.",
        lambda: Scene.named("overlapping"),
        altered("volume-zfail", *PARITY),
        Setting("volume-zfail"),
        wrong_colors, COUNTED,
    ),
    Failure(
        "mask-1", "The light pass tests one bit of the count", "stencil", "E38, CA:470, CA:482",
        "The lowest bit of a count is its parity, so two overlapping volumes look like none.",
        lambda: Scene.named("overlapping"),
        altered("volume-zfail", ("glStencilFunc(GL_EQUAL, 0, 255)", "glStencilFunc(GL_EQUAL, 0, 1)")),
        Setting("volume-zfail"),
        wrong_colors, COUNTED,
    ),
    Failure(
        "counter-at-least-0", "Dark where the counter is at least 0", "stencil", "E20, SK:267-268",
        "A counter is at least 0 everywhere; a point is in shadow where it is greater than 0.",
        lambda: scene_of(STAGE, "two boxes"),
        as_listed("volume-counter", "E20", stage=STAGE),
        as_listed("volume-counter", stage=STAGE),
        wrong_colors, COUNTED,
    ),
    Failure(
        "decr-before-incr", "GL_DECR before GL_INCR", "stencil", "E11, RO1:231",
        "GL_DECR stops at 0, so decrements that come before the increments are lost.",
        lambda: scene_of(STAGE, "two boxes"),
        as_listed("volume-zpass-reversed", "E11", stage=STAGE),
        as_listed("volume-zpass-reversed", stage=STAGE),
        wrong_colors, COUNTED,
    ),
    Failure(
        "overflow-256", "256 volumes around a point count as none", "stencil", "E11, RO1:144-150",
        "Eight bits count modulo 256: GL_INCR_WRAP continues with 0 after 255.",
        stack,
        Setting("volume-zpass"),
        Setting("volume-zpass", {"ops": "saturate"}),
        wrong_colors, COUNTED,
    ),
    Failure(
        "stencil-test-forgotten", "The stencil test is never enabled", "stencil", "E1, RO1:199-250",
        "While the test is disabled, the stencil buffer is neither written nor tested, so all pixels are lit.",
        lambda: Scene.named("torus"),
        altered("volume-zpass", ("glEnable(GL_STENCIL_TEST)", None)),
        Setting("volume-zpass"),
        wrong_colors, COUNTED,
    ),
    Failure(
        "depth-test-off-while-counting", "The depth test is disabled while volumes are counted", "stencil",
        "E43, CA:238-239",
        "Without depth test no depth is written, but every fragment counts as one that passed, so the faces behind "
        "the visible surface are counted as well.",
        lambda: scene_of(STAGE, "two boxes"),
        Setting(Technique("count without depth test", "", "volumes", "", counted_without_depth_test, {})),
        as_listed("volume-zpass", stage=STAGE),
        wrong_colors, COUNTED,
    ),
    Failure(
        "culling-left-on", "The light pass keeps the culling of the count", "stencil", "E3, RO1:233-265",
        "Counting the back faces of volumes leaves front faces culled, those of the scene included.",
        lambda: Scene.named("torus"),
        altered("volume-zpass", ("glDisable(GL_CULL_FACE)", None)),
        Setting("volume-zpass"),
        wrong_colors, COUNTED,
    ),
    Failure(
        "less-in-lit-pass", "The light pass keeps GL_LESS", "stencil", "E2, RO1:265-277",
        "The second pass over a surface has the depth that is already stored, which is not less.",
        lambda: Scene.named("torus"),
        altered("volume-zpass", ("glDepthFunc(GL_LEQUAL)", "glDepthFunc(GL_LESS)")),
        Setting("volume-zpass"),
        wrong_colors, COUNTED,
    ),
    Failure(
        "missing-clear", "The stencil buffer is not cleared for the second light", "stencil", "E17, E61, RO1:178",
        "Only glClear resets a buffer; without it the second light continues from the counts of the first.",
        lambda: Scene.named("two-lights"),
        altered("volume-zpass", ("glClear(GL_STENCIL_BUFFER_BIT)", None)),
        Setting("volume-zpass"),
        wrong_colors, COUNTED,
    ),
)  # fmt: skip
