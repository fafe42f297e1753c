"""Failures of soft shadows, judged by the exact visible share of the light."""

from dataclasses import replace

from softshadow.gallery.failure import Failure, Setting
from softshadow.gallery.measures import SHARE, wrong_share
from softshadow.scene import Light, Rectangle, Scene, SceneObject, placement, shapes


def few_depths() -> Scene:
    """Return a slab under an area light, and a camera whose near distance leaves few depths for them."""
    scene = Scene.named("soft-slab")
    return replace(scene, camera=replace(scene.camera, near=0.0005))


def cube_near_light() -> Scene:
    """Return a cube below a light that is larger than its top."""
    scene = Scene.named("soft-slab")
    cube = SceneObject(shapes.box(), placement((0, 2.2, 0)), name="cube")
    light = Light((0, 4, 0), shape=Rectangle((2, 0, 0), (0, 0, 2)))
    return replace(scene, name="cube", lights=(light,), objects=(scene.objects[0], cube))


FAILURES = (
    Failure(
        "wedges-by-depth", "Wedges correct a count that has taken the other side", "soft", "SK:427-436",
        "At the edge of the hard shadow, the depth test counts a point on the side where its wedge does not have it.",
        few_depths,
        Setting("volume-wedges", {"decide": "depth"}),
        Setting("volume-wedges"),
        wrong_share, SHARE,
    ),
    Failure(
        "wedge-overlap", "What two casters hide is added", "soft", "SK:484",
        "Each wedge knows one edge: that two casters hide the same part of the light is not known to any.",
        lambda: Scene.named("soft-overlap"),
        Setting("volume-wedges"),
        Setting("volume-sampled", {"samples": 64}),
        wrong_share, SHARE,
    ),
    Failure(
        "centre-silhouette", "One silhouette for all of the light", "soft", "SK:484",
        "Lower edges of the cube, which hide more of a large light, are not on the silhouette that its centre sees.",
        cube_near_light,
        Setting("volume-wedges"),
        Setting("volume-sampled", {"samples": 256}),
        wrong_share, SHARE,
    ),
)  # fmt: skip
