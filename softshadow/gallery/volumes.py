"""Failures of shadow volumes: where the count begins, where a volume ends, and whether it is closed."""

from softshadow.gallery.course_stage import as_listed, scene_of
from softshadow.gallery.failure import Failure, Setting
from softshadow.gallery.measures import COUNTED, wrong_colors
from softshadow.listings.stage import OVER_THE_TABLE
from softshadow.scene import Scene

FAILURES = (
    Failure(
        "eye-in-shadow", "The eye stands in a shadow volume", "volumes", "E10, E40, RO1:173",
        "Z-pass counts from the near plane on; a ray that starts inside a volume leaves it without having entered it.",
        lambda: Scene.named("eye-in-shadow"),
        Setting("volume-zpass"),
        Setting("volume-zpass", {"start": "eye"}),
        wrong_colors, COUNTED,
    ),
    Failure(
        "constant-eye-count", "One start value for a near rectangle that a volume cuts", "volumes", "E10, RO1:281-289",
        "The number of volumes around the eye is right for rays that start inside them, which may not be all rays.",
        lambda: Scene.named("near-cut"),
        Setting("volume-zpass", {"start": "eye"}),
        Setting("volume-zpass", {"start": "near-plane"}),
        wrong_colors, COUNTED,
    ),
    Failure(
        "missing-caps", "Z-fail on volumes without caps", "volumes", "E6, RO1:299-353",
        "Z-fail needs closed volumes: where a ray leaves through an open end, the count is off by one.",
        lambda: Scene.named("torus"),
        Setting("volume-zfail", {"closed": False}),
        Setting("volume-zfail"),
        wrong_colors, COUNTED,
    ),
    Failure(
        "finite-far-plane", "The far plane cuts volumes open", "volumes", "E8, RO1:83",
        "Z-fail counts the faces behind the surface, and faces behind the far plane are clipped.",
        lambda: Scene.named("torus"),
        Setting("volume-zfail", {"far": "finite"}),
        Setting("volume-zfail"),
        wrong_colors, COUNTED,
    ),
    Failure(
        "vertex-distance-cap", "The far cap's vertices are far, but the cap itself is near", "volumes", "E7, RO1:77-82",
        "The middle of a flat cap is nearer to the light than its vertices, so the volume ends too early there.",
        lambda: scene_of(OVER_THE_TABLE, "lamp over a table"),
        as_listed("volume-far-side", "E7", stage=OVER_THE_TABLE),
        as_listed("volume-far-side", stage=OVER_THE_TABLE),
        wrong_colors, COUNTED,
    ),
)  # fmt: skip
