"""Failures of shadow maps: a picture with a resolution, a rounding, an outside, and a shader around it."""

from dataclasses import replace

from softshadow.gallery.course_stage import as_listed, scene_of
from softshadow.gallery.failure import Failure, Setting
from softshadow.gallery.measures import (
    COUNTED,
    grown_shadow,
    wrong_colors,
    wrong_flat_colors,
    wrong_flat_light,
    wrong_inside_faces,
    wrong_on_receivers,
)
from softshadow.listings.stage import STAGE, Thing
from softshadow.scene import Scene
from softshadow.scene.shapes import floor

# what the pictures have no pixels for by default
AT_CREASES = "single pixels within a texel of a crease or an edge"
# texels so small that the filter stays within the boundary band
FILTERED = {"kernel": 5, "map_size": 2048}
# beyond the light's view on all sides
WIDE = replace(STAGE, receiver=(Thing(floor(9), STAGE.receiver[0].color),), occluder=STAGE.occluder[:1])
# its shadow stays within what the light of the listings sees
ONE_BOX = replace(STAGE, occluder=STAGE.occluder[:1])

FAILURES = (
    Failure(
        "acne", "Surfaces shadow themselves", "maps", "E49, E52, SK:369-373",
        "Between the centres of two texels a sloping surface is nearer to the light than its own stored depth says.",
        lambda: Scene.named("boxes"),
        Setting("map", {"factor": 0.0, "units": 0.0}),
        Setting("map"),
        wrong_inside_faces, COUNTED, why_floor=AT_CREASES,
    ),
    Failure(
        "constant-bias", "A constant bias where surfaces are steep", "maps", "E49, CA:620",
        "Seen from the light, the depth of a steep surface changes by more than the bias within a texel, so that it "
        "shadows itself; an offset by slope grows with it.",
        lambda: Scene.named("boxes"),
        Setting("map", {"factor": 0.0, "units": 0.0, "bias": 0.002}),
        Setting("map"),
        wrong_inside_faces, COUNTED, why_floor=AT_CREASES,
    ),
    Failure(
        "peter-panning", "The shadow comes off its caster's foot", "maps", "E48, E49, CA:620",
        "What is nearer to its caster than the bias counts as the caster's own surface, and is lit.",
        lambda: Scene.named("thin-wall"),
        Setting("map", {"map_size": 1024, "factor": 0.0, "units": 0.0, "bias": 0.1}),
        Setting("map", {"map_size": 1024}),
        wrong_inside_faces, COUNTED,
    ),
    Failure(
        "offset-of-far-faces", "An offset on the far faces of casters", "maps", "E27, SK:374-377",
        "Faces that look away from the light need no offset: it pushes them into the floor that they stand on, and "
        "light comes in at the foot.",
        lambda: Scene.named("thin-wall"),
        Setting("map", {"surface": "back", "map_size": 256, "factor": 4.0}),
        Setting("map", {"surface": "back", "map_size": 256, "factor": 0.0, "units": 0.0}),
        wrong_colors, COUNTED,
    ),
    Failure(
        "offset-and-bias", "An offset in the map, and a bias besides", "maps", "E48, CA:544, CA:620",
        "Each alone keeps surfaces from shadowing themselves; both together let light in where floor and box touch.",
        lambda: scene_of(ONE_BOX, "one box"),
        as_listed("map", "E48", stage=ONE_BOX),
        as_listed("map", stage=ONE_BOX),
        wrong_flat_light, "pixels that are dark in light, or bright in shadow", flat=True, why_floor=AT_CREASES,
    ),
    Failure(
        "light-view-only", "Points are taken to the map by the light's view alone", "maps", "E50, RO2:28-39, RO2:65-83",
        "A view turns and moves; it is the projection, the division by w and the scale that lead to a texel.",
        lambda: scene_of(ONE_BOX, "one box"),
        as_listed("map-two-stages", "E50", stage=ONE_BOX),
        as_listed("map-two-stages", stage=ONE_BOX),
        wrong_flat_light, "pixels that are dark in light, or bright in shadow", flat=True, why_floor=AT_CREASES,
    ),
    Failure(
        "map-not-cleared", "The map starts at 0 instead of far away", "maps", "E51, RO2:43",
        "No depth is less than 0: nothing is drawn into the map, and all lies behind it.",
        lambda: scene_of(ONE_BOX, "one box"),
        as_listed("map-two-stages", "E51", stage=ONE_BOX),
        as_listed("map-two-stages", stage=ONE_BOX),
        wrong_flat_light, "pixels that are dark in light, or bright in shadow", flat=True, why_floor=AT_CREASES,
    ),
    Failure(
        "jagged-edges", "Edges have steps as large as a texel", "maps", "SK:382-383, CA:639",
        "All points of a texel get the same answer, and a texel of the map covers many pixels of the picture.",
        lambda: Scene.named("boxes"),
        Setting("map", {"map_size": 32}),
        Setting("map", {"map_size": 2048}),
        wrong_on_receivers, "pixels of the floor whose colour is not that of the lights they see",
    ),
    Failure(
        "pcf-bias", "An offset for one texel under a filter of many", "maps", "SK:385-401, CA:620",
        "The farther a texel of the filter lies from the point, the farther off is its depth on a slope: the offset's "
        "factor has to grow with the filter, to 2 r + 1.",
        lambda: Scene.named("boxes"),
        Setting("map-pcf", FILTERED | {"factor": 1.0}),
        Setting("map-pcf", FILTERED),
        wrong_inside_faces, COUNTED, why_floor=AT_CREASES,
    ),
    Failure(
        "linear-filtered-depth", "Depths are filtered before they are compared", "maps", "E46, CA:518-519, SK:384",
        "The mean of a near and a far depth is the depth of nothing that is there: what lies beyond the edge of a "
        "caster's texel is compared with it, and the shadow grows.",
        lambda: scene_of(ONE_BOX, "one box"),
        as_listed("map", "E46", stage=ONE_BOX, map_size=32),
        as_listed("map", stage=ONE_BOX, map_size=32),
        grown_shadow, "pixels of the floor that are dark in light", flat=True, why_floor=AT_CREASES,
    ),
    Failure(
        "edge-smear", "GL_CLAMP_TO_EDGE smears the map's edge over the scene", "maps", "E47, CA:516-517",
        "Beside the light's view the nearest texel of the edge answers, whatever it holds.",
        lambda: scene_of(WIDE, "a box on a wide floor"),
        as_listed("map", "E47", stage=WIDE),
        as_listed("map", stage=WIDE),
        wrong_flat_light, "pixels that are dark in light, or bright in shadow", flat=True, why_floor=AT_CREASES,
    ),
    Failure(
        "omni-light", "One map for a light among its casters", "maps", "E55, RO1:24, CA:803",
        "A frustum looks one way: what stands beside or behind the light is not in its map, and casts no shadow.",
        lambda: Scene.named("light-between"),
        Setting("map"),
        Setting("map-cube"),
        wrong_inside_faces, COUNTED,
    ),
    Failure(
        "factor-on-whole-color", "The factor dims the whole colour", "maps", "E53, RO2:85",
        "Ambient light reaches a shadow undiminished; the factor belongs to the direct light of one source alone.",
        lambda: scene_of(ONE_BOX, "one box"),
        as_listed("map-two-stages", "E53", stage=ONE_BOX),
        as_listed("map-two-stages", stage=ONE_BOX),
        wrong_flat_colors, "pixels whose colour is neither that in light nor that in shadow", flat=True,
        why_floor=AT_CREASES,
    ),
    Failure(
        "map-larger-than-window", "A map drawn in a smaller window", "maps", "E62, CA:531-553",
        "What the window does not hold is not drawn, and nothing of it is copied.",
        lambda: Scene.named("boxes"),
        Setting("map", {"storage": "copy"}),
        Setting("map"),
        wrong_inside_faces, COUNTED, why_floor=AT_CREASES,
    ),
)  # fmt: skip
