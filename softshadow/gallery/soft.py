"""Failures of soft shadows, judged by the exact visible share of the light."""

from dataclasses import replace

from softshadow.gallery.failure import Failure, Setting
from softshadow.gallery.measures import SHARE, wrong_share
from softshadow.scene import Scene


def few_depths() -> Scene:
    """Return a slab under an area light, and a camera whose near distance leaves few depths for them."""
    scene = Scene.named("soft-slab")
    return replace(scene, camera=replace(scene.camera, near=0.0005))


FAILURES = (
    Failure(
        "wedges-by-depth", "Wedges correct a count that has taken the other side", "soft", "SK:427-436",
        "At the edge of the hard shadow, the depth test counts a point on the side where its wedge does not have it.",
        few_depths,
        Setting("volume-wedges", {"decide": "depth"}),
        Setting("volume-wedges"),
        wrong_share, SHARE,
    ),
)  # fmt: skip
