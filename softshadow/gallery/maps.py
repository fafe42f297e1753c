"""Failures of shadow maps: resolution, depth bias, borders, filtering, and the shader's arithmetic."""

from dataclasses import replace

from softshadow.gallery.calls import AlteredCall
from softshadow.gallery.course_stage import as_listed, scene_of
from softshadow.gallery.failure import Failure, Setting
from softshadow.gallery.measures import (
    COUNTED,
    wrong_colors,
    wrong_flat_colors,
    wrong_flat_light,
    wrong_flat_light_anywhere,
    wrong_inside_faces,
    wrong_on_receivers,
)
from softshadow.listings.stage import STAGE, Thing, moved
from softshadow.scene import Scene
from softshadow.scene.shapes import box, floor

# `why_floor` of failures whose cure is not perfect in large pictures
AT_CREASES = "single pixels within a texel of a crease or an edge"
# texels are so small that the filter stays within the boundary band
FILTERED = {"kernel": 5, "map_size": 2048}
# a floor that extends beyond the light's view on all sides
WIDE = replace(STAGE, receiver=(Thing(floor(9), STAGE.receiver[0].color),), occluder=STAGE.occluder[:1])
LIGHT = "pixels that are lit but dark, or in shadow but bright"
# a panel far above the floor: the mean of both depths is far from either
PANEL = replace(STAGE, occluder=(Thing(moved(box(1.4, 0.04, 1.4, name="panel"), 0.0, 1.0, 0.0), (0.9, 0.4, 0.2)),))
# a box whose shadow lies inside the view of the listings' light
ONE_BOX = replace(STAGE, occluder=STAGE.occluder[:1])

FAILURES = (
    Failure(
        "acne", "Surfaces shadow themselves", "maps", "E49, E52, SK:369-373",
        "Away from a texel's centre a sloping surface may be farther from the light than its own stored depth.",
        lambda: Scene.named("boxes"),
        Setting("map", {"factor": 0.0, "units": 0.0}),
        Setting("map"),
        wrong_inside_faces, COUNTED, why_floor=AT_CREASES,
    ),
    Failure(
        "reversed-comparison", "In shadow where the point is nearer than the map", "maps", "E19, SK:334",
        "Lit points have the stored depth or a smaller one. Farther points are hidden by what is stored.",
        lambda: Scene.named("boxes"),
        Setting("map", {}, (AlteredCall(
            "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL)",
            "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL)",
        ),)),
        Setting("map"),
        wrong_inside_faces, COUNTED, why_floor=AT_CREASES,
    ),
    Failure(
        "constant-bias", "A constant bias on steep surfaces", "maps", "E49, CA:620",
        "Seen from the light, the depth of a steep surface changes by more than the bias within a texel, so that it "
        "shadows itself; a slope-dependent offset grows with the slope.",
        lambda: Scene.named("boxes"),
        Setting("map", {"factor": 0.0, "units": 0.0, "bias": 0.002}),
        Setting("map"),
        wrong_inside_faces, COUNTED, why_floor=AT_CREASES,
    ),
    Failure(
        "peter-panning", "The shadow is detached from its caster", "maps", "E48, E49, CA:620",
        "Points closer behind their caster than the bias count as the caster's own surface, and are lit.",
        lambda: Scene.named("thin-wall"),
        Setting("map", {"map_size": 1024, "factor": 0.0, "units": 0.0, "bias": 0.1}),
        Setting("map", {"map_size": 1024}),
        wrong_inside_faces, COUNTED,
    ),
    Failure(
        "offset-of-far-faces", "An offset on the far faces of casters", "maps", "E27, SK:374-377",
        "Faces that look away from the light need no offset: it moves them below the floor they stand on, and light "
        "leaks in there.",
        lambda: Scene.named("thin-wall"),
        Setting("map", {"surface": "back", "map_size": 256, "factor": 4.0}),
        Setting("map", {"surface": "back", "map_size": 256, "factor": 0.0, "units": 0.0}),
        wrong_colors, COUNTED,
    ),
    Failure(
        "offset-and-bias", "An offset in the map, and a bias as well", "maps", "E48, CA:544, CA:620",
        "Either is enough against self-shadowing; both together let light leak in where floor and box touch.",
        lambda: scene_of(ONE_BOX, "one box"),
        as_listed("map", "E48", stage=ONE_BOX),
        as_listed("map", stage=ONE_BOX),
        wrong_flat_light, LIGHT, flat=True, why_floor=AT_CREASES,
    ),
    Failure(
        "light-view-only", "Texel coordinates from the light's view matrix alone", "maps", "E50, RO2:28-39, RO2:65-83",
        "A view matrix only rotates and translates; texel coordinates also need the projection, the division by w and "
        "a scale.",
        lambda: scene_of(ONE_BOX, "one box"),
        as_listed("map-two-stages", "E50", stage=ONE_BOX),
        as_listed("map-two-stages", stage=ONE_BOX),
        wrong_flat_light, LIGHT, flat=True, why_floor=AT_CREASES,
    ),
    Failure(
        "map-not-cleared", "The map is cleared to 0 instead of 1", "maps", "E51, RO2:43",
        "No depth is less than 0, so nothing is drawn into the map, and every point lies behind its stored depth.",
        lambda: scene_of(ONE_BOX, "one box"),
        as_listed("map-two-stages", "E51", stage=ONE_BOX),
        as_listed("map-two-stages", stage=ONE_BOX),
        wrong_flat_light, LIGHT, flat=True, why_floor=AT_CREASES,
    ),
    Failure(
        "jagged-edges", "Edges have steps as large as a texel", "maps", "SK:382-383, CA:639",
        "All points within a texel get the same result, and a texel of the map covers many pixels of the picture.",
        lambda: Scene.named("boxes"),
        Setting("map", {"map_size": 32}),
        Setting("map", {"map_size": 2048}),
        wrong_on_receivers, "floor pixels whose colour is not that of the lights they see", why_floor=AT_CREASES,
    ),
    Failure(
        "pcf-bias", "An offset for one texel with a filter over many", "maps", "SK:385-401, CA:620",
        "On a slope, texels farther from the point differ more in depth, so the offset's factor must grow with the "
        "filter's radius r, to 2 r + 1.",
        lambda: Scene.named("boxes"),
        Setting("map-pcf", FILTERED | {"factor": 1.0}),
        Setting("map-pcf", FILTERED),
        wrong_inside_faces, COUNTED, why_floor=AT_CREASES,
    ),
    Failure(
        "light-bleeding", "Light where the shadows of two casters overlap", "maps", "Donnelly & Lauritzen 2006",
        "The bound by mean and variance is the share of lit texels if there are two depths; for a receiver behind two "
        "casters it is too large. A reduction counts small bounds as 0, which also narrows every ramp.",
        lambda: Scene.named("soft-overlap"),
        Setting("map-variance", {"map_size": 1024, "blur": 4}),
        Setting("map-variance", {"map_size": 1024, "blur": 4, "bleed": 0.5}),
        wrong_colors, COUNTED,
    ),
    Failure(
        "linear-filtered-depth", "Depths are filtered before they are compared", "maps", "E46, CA:518-519, SK:384",
        "The mean of a near and a far depth belongs to no surface. Points beyond the edge of a caster are compared "
        "with it, and the shadow grows.",
        lambda: scene_of(PANEL, "a panel over a floor"),
        as_listed("map", "E46", stage=PANEL, map_size=24),
        as_listed("map", stage=PANEL, map_size=24),
        wrong_flat_light_anywhere, LIGHT, floor=5,
        why_floor="edges have steps as large as a texel: see jagged-edges", flat=True,
    ),
    Failure(
        "edge-smear", "GL_CLAMP_TO_EDGE extends the map's edge over the scene", "maps", "E47, CA:516-517",
        "Outside the light's view, lookups return the nearest texel at the edge of the map, whatever it holds.",
        lambda: scene_of(WIDE, "a box on a wide floor"),
        as_listed("map", "E47", stage=WIDE),
        as_listed("map", stage=WIDE),
        wrong_flat_light, LIGHT, flat=True, why_floor=AT_CREASES,
    ),
    Failure(
        "omni-light", "One map for a light among its casters", "maps", "E55, RO1:24, CA:803",
        "A frustum covers one direction: objects beside or behind the light are not in the map, and cast no shadow.",
        lambda: Scene.named("light-between"),
        Setting("map"),
        Setting("map-cube"),
        wrong_inside_faces, COUNTED, why_floor=AT_CREASES,
    ),
    Failure(
        "factor-on-whole-color", "The factor dims the whole colour", "maps", "E53, RO2:85",
        "Ambient light also reaches points in shadow; the factor may only multiply the direct light of the source.",
        lambda: scene_of(ONE_BOX, "one box"),
        as_listed("map-two-stages", "E53", stage=ONE_BOX),
        as_listed("map-two-stages", stage=ONE_BOX),
        wrong_flat_colors, "pixels whose colour is neither the lit nor the shadowed one", flat=True,
        why_floor=AT_CREASES,
    ),
    Failure(
        "map-larger-than-window", "The map is larger than the window it is drawn in", "maps", "E62, CA:531-553",
        "Outside the window nothing is drawn, so that part of the map is not copied.",
        lambda: Scene.named("boxes"),
        Setting("map", {"storage": "copy"}),
        Setting("map"),
        wrong_inside_faces, COUNTED, why_floor=AT_CREASES,
    ),
)  # fmt: skip
