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


def post_on_floor() -> Scene:
    """Return a post that stands on the floor, beside an area light."""
    scene = Scene.named("soft-slab")
    post = SceneObject(shapes.box(0.8, 1.2, 0.8), placement((0, 0.6, 0)), name="post")
    light = Light((1.5, 4, 1.0), shape=Rectangle((0.8, 0, 0), (0, 0, 0.8)))
    return replace(scene, name="post", lights=(light,), objects=(scene.objects[0], post))


FAILURES = (
    Failure(
        "banding", "Few points of the light show as bands", "soft", "SK:319-321",
        "With four points the visibility has five values, and every edge of the caster is drawn four times.",
        lambda: Scene.named("soft-slab"),
        Setting("volume-sampled", {"samples": 4}),
        Setting("volume-sampled", {"samples": 256}),
        wrong_share, SHARE,
    ),
    Failure(
        "corners-only", "The corners do not stand for the light between them", "soft", "E26, SK:312-322",
        "Points that see all corners may not see the middle, and near the umbra one of four corners counts for a "
        "quarter of the light although hardly any of it is visible.",
        lambda: Scene.named("soft-slab"),
        Setting("volume-sampled", {"samples": 4, "pattern": "corners"}),
        Setting("volume-sampled", {"samples": 256}),
        wrong_share, SHARE,
    ),
    Failure(
        "constant-width", "A filter of constant width is no penumbra", "soft", "CA:640-646",
        "Percentage-closer filtering is as soft near the caster as far from it, and does not know how large the light "
        "is.",
        lambda: Scene.named("soft-slab"),
        Setting("map-pcf", {"kernel": 15}),
        Setting("map-pcss"),
        wrong_share, SHARE,
    ),
    Failure(
        "blurred-contact", "Nested planes blur the feet of casters", "soft", "SK:324-330",
        "The layers are parallel planes: the softness depends on where the light stands, not on how far a caster is "
        "from the floor, so it is there even where the two touch.",
        post_on_floor,
        Setting("planar-nested"),
        Setting("volume-sampled", {"samples": 64}),
        wrong_share, SHARE,
    ),
    Failure(
        "mean-blocker", "Two blockers count as one between them", "soft", "Fernando 2005",
        "The width of the penumbra is that of a single blocker at the mean of their depths, and what each hides of the "
        "light is lost.",
        lambda: Scene.named("soft-overlap"),
        Setting("map-pcss"),
        Setting("volume-sampled", {"samples": 64}),
        wrong_share, SHARE,
    ),
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
