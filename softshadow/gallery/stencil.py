"""Failures of the state around the count: right volumes, and one call of the stencil, depth or culling state amiss."""

from dataclasses import replace

import numpy as np

from softshadow.gallery.calls import AlteredCall
from softshadow.gallery.course_stage import as_listed, scene_of
from softshadow.gallery.failure import Failure, Setting
from softshadow.gallery.measures import COUNTED, wrong_colors
from softshadow.listings.stage import STAGE
from softshadow.scene import Mesh, Scene, SceneObject
from softshadow.scene.placement import placement
from softshadow.scene.shapes import box

PARITY = (
    ("glStencilOp(GL_KEEP, GL_INCR_WRAP, GL_KEEP)", "glStencilOp(GL_KEEP, GL_INVERT, GL_KEEP)"),
    ("glStencilOp(GL_KEEP, GL_DECR_WRAP, GL_KEEP)", "glStencilOp(GL_KEEP, GL_INVERT, GL_KEEP)"),
)
SHEETS = 256  # as many as make eight bits 0 again


def altered(technique: str, *calls: tuple[str, str | None]) -> Setting:
    """Return a technique with calls of it replaced, or left out."""
    return Setting(technique, {}, tuple(AlteredCall(call, instead) for call, instead in calls))


def stack() -> Scene:
    """Return a stack of sheets over a floor, as many as a counter of eight bits has values."""
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
        "GL_INVERT knows odd and even: a point in two volumes has been inverted twice, and is lit.",
        lambda: Scene.named("overlapping"),
        altered("volume-zfail", *PARITY),
        Setting("volume-zfail"),
        wrong_colors, COUNTED,
    ),
    Failure(
        "mask-1", "The light pass tests one bit of the count", "stencil", "E38, CA:470, CA:482",
        "The last bit of a count is its parity, and two volumes over each other read as none.",
        lambda: Scene.named("overlapping"),
        altered("volume-zfail", ("glStencilFunc(GL_EQUAL, 0, 255)", "glStencilFunc(GL_EQUAL, 0, 1)")),
        Setting("volume-zfail"),
        wrong_colors, COUNTED,
    ),
    Failure(
        "counter-at-least-0", "Dark where the counter is at least 0", "stencil", "E20, SK:267-268",
        "A counter is at least 0 everywhere; a point is in shadow where it is more.",
        lambda: scene_of(STAGE, "two boxes"),
        as_listed("volume-counter", "E20", stage=STAGE),
        as_listed("volume-counter", stage=STAGE),
        wrong_colors, COUNTED,
    ),
    Failure(
        "decr-before-incr", "GL_DECR before GL_INCR", "stencil", "E11, RO1:231",
        "GL_DECR stops at 0, so that what is counted down before it was counted up is lost.",
        lambda: scene_of(STAGE, "two boxes"),
        as_listed("volume-zpass-reversed", "E11", stage=STAGE),
        as_listed("volume-zpass-reversed", stage=STAGE),
        wrong_colors, COUNTED,
    ),
    Failure(
        "overflow-256", "256 volumes around a point are none", "stencil", "E11, RO1:144-150",
        "Eight bits count modulo 256, and GL_INCR_WRAP goes on after 255 with 0.",
        stack,
        Setting("volume-zpass"),
        Setting("volume-zpass", {"ops": "saturate"}),
        wrong_colors, COUNTED,
    ),
    Failure(
        "stencil-test-forgotten", "The stencil test is never enabled", "stencil", "E1, RO1:199-250",
        "With the test disabled nothing is written to the stencil buffer, and nothing is left out by it.",
        lambda: Scene.named("torus"),
        altered("volume-zpass", ("glEnable(GL_STENCIL_TEST)", None)),
        Setting("volume-zpass"),
        wrong_colors, COUNTED,
    ),
    Failure(
        "culling-left-on", "The light pass keeps the culling of the count", "stencil", "E3, RO1:233-265",
        "After the back faces of volumes were counted, front faces are still culled, those of the scene as well.",
        lambda: Scene.named("torus"),
        altered("volume-zpass", ("glDisable(GL_CULL_FACE)", None)),
        Setting("volume-zpass"),
        wrong_colors, COUNTED,
    ),
    Failure(
        "less-in-lit-pass", "The light pass keeps GL_LESS", "stencil", "E2, RO1:265-277",
        "The second drawing of a surface has the depth that is stored already, which is not less.",
        lambda: Scene.named("torus"),
        altered("volume-zpass", ("glDepthFunc(GL_LEQUAL)", "glDepthFunc(GL_LESS)")),
        Setting("volume-zpass"),
        wrong_colors, COUNTED,
    ),
    Failure(
        "missing-clear", "The stencil buffer is not cleared for the second light", "stencil", "E17, E61, RO1:178",
        "Only glClear sets a buffer back, so that the second light counts on from the shadows of the first.",
        lambda: Scene.named("two-lights"),
        altered("volume-zpass", ("glClear(GL_STENCIL_BUFFER_BIT)", None)),
        Setting("volume-zpass"),
        wrong_colors, COUNTED,
    ),
)  # fmt: skip
