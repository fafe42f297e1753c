# ---
# jupyter:
#   jupytext:
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # 17. The bias
#
# **Goal.** You know why a surface shadows itself, how much offset is enough, and what too much of it costs.
#
# **Slides.** Bratislava (Zimányi & Valient 2004), lines 331 and 369-377. Barcelona (Andújar 2021), lines 524-557 and
# 620.
#
# A texel stores *one* depth for a whole patch of the scene. If the surface slopes away from the light, half of the
# patch lies farther away than the stored depth. Compared with it, this half is "farther than what the light sees": the
# surface shadows itself, in stripes. This is **shadow acne**.

# %%
import warnings

import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)
torus = ss.Scene.named("torus")
acne = ss.failures["acne"]
display(acne)
print(acne.explain())

# %% [markdown]
# ## The slide and the program
#
# The Barcelona slides move the surfaces away from the light while the map is drawn: `glPolygonOffset(factor, units)`
# adds `factor · m + units · r`, where m is the larger of the slopes |∂z/∂x| and |∂z/∂y|, and r here is two steps of the
# depth buffer (lesson 4). The same slides also subtract 0.01 in the shader, "only if the offset was not used" (E48).

# %%
lessons.code_beside_slide("map-bias", step=1)

# %% [markdown]
# ## The theorem
#
# On a plane, a point is at most half a texel away from the sample in each direction. So its depth differs from the
# stored one by at most ½|∂z/∂x| + ½|∂z/∂y| ≤ m. An offset of `factor = 1` is enough. A constant, which ignores the
# slope, is too small for some plane (E49). The scene is a floor alone, so every dark pixel is the floor's own shadow.

# %%
floor = ss.Scene(
    "floor alone",
    ss.Camera((2.6, 3.0, 4.8), (0, 0, 0)),
    [ss.Light((1, 0.35, 0.2, 0))],
    [ss.SceneObject(torus.objects[0].mesh, name="floor")],
)
dark = {}
for factor in (0.0, 0.25, 0.5, 0.75, 1.0):
    run = ss.run("map", floor, size=(320, 240), map_size=64, factor=factor, units=0.0)
    dark[factor] = int(run.shadow_mask.sum())
    print(f"factor {factor:4}: {dark[factor]:6} pixels in shadow")
assert dark[1.0] == 0

# %% [markdown]
# ## The bits of the map
#
# The theorem is about exact numbers, but a map stores whole numbers of 16, 24 or 32 bits, or floats (`map_format`).
# Rounding moves a stored depth by up to half a step. That is what the *units* are for: one unit is two steps. To see
# rounding alone, let the light stand above the floor: there is no slope, so the factor adds nothing. The same scene
# with the light at eight heights; the number of pixels in shadow is that of the worst height:


# %%
def below(height):
    return ss.Scene("floor", floor.camera, [ss.Light((0, height, 0))], floor.objects)


def maps_of_heights(**options):
    heights = (4, 4.5, 5, 5.5, 6, 6.5, 7, 7.5)
    same = {"size": (80, 60), "map_size": 64, "factor": 0.0, **options}
    return [ss.run("map", below(height), **same) for height in heights]


worst = {}
for name in ("d16", "d24", "d32", "d32f"):
    for units in (0.0, 1.0, 256.0):
        runs = maps_of_heights(map_format=name, units=units)
        worst[name, units] = max(int(run.shadow_mask.sum()) for run in runs)
    counts = [worst[name, units] for units in (0.0, 1.0, 256.0)]
    print(f"{name:4}: {counts} dark pixels with 0, 1, 256 units")
assert worst["d16", 1.0] == worst["d24", 1.0] == 0 < worst["d32", 1.0]

# %% [markdown]
# One unit is enough for 16 and 24 bits. It is not enough for 32 bits, although this map rounds least: the depth that is
# compared with it is a float, which has 24 bits, and its rounding stays. One unit of this map is 2⁻³¹ of the range; 256
# of them are 2⁻²³, two steps of a float between ½ and 1. So more bits than 24 do not make the bias smaller. Fewer bits
# do make it larger: one unit of 16 bits is 256 times one of 24.

# %%
exact = maps_of_heights(map_format="d32f", units=0.0)
for name in ("d16", "d24"):
    pairs = zip(maps_of_heights(map_format=name, units=0.0), exact, strict=True)
    error = max(np.abs(a.maps["ZS"].astype(float) - b.maps["ZS"]).max() for a, b in pairs)
    print(f"{name}: stored depths are wrong by up to 2^{np.log2(error):.2f}")

# %% [markdown]
# ## Predict, then run
#
# The map becomes four times as large, 256 × 256, and the factor stays 0. How does the number of dark pixels change?

# %%
my_guess = ...  # "about a quarter", "about the same", "none"

# %%
finer = int(
    ss.run(
        "map", floor, size=(320, 240), map_size=256, factor=0.0, units=0.0
    ).shadow_mask.sum()
)
print(f"{dark[0.0]} with 64 x 64 texels, {finer} with 256 x 256")
lessons.compare_prediction(
    "How does the number change?",
    my_guess,
    "about the same" if 0.5 < finer / dark[0.0] < 2 else "not about the same",
    "Half of every patch is behind its sample, however small the patch is: the stripes "
    "become finer, not fewer.",
)

# %% [markdown]
# ## The buffers after each step

# %%
run = ss.run("map", torus, size=(320, 240), map_size=256)
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Click a pixel
#
# The history of a pixel has the texel, the stored depth, the pixel's own depth and the offset.

# %%
lessons.clickable(run)

# %% [markdown]
# ## What goes wrong, and its cure
#
# If the offset is too large, the stored surface moves away from the light through the floor: the shadow leaves the foot
# of its caster. If the offset *and* the bias of the shader are used, their sum does the same (E48).

# %%
for name in ("peter-panning", "constant-bias", "offset-and-bias"):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# ## Other cures: which surface is stored
#
# The Bratislava slides name two more. Store the faces that look *away* from the light: then the lit side is far from
# what is stored, and acne moves to the unlit side, where nothing is lost. But thin walls and open meshes leak (E27). Or
# store the *mean* of the two nearest depths (Woo 1992), which lies inside the caster.

# %%
for surface in ("front", "back", "midpoint"):
    stored = ss.run(
        "map",
        torus,
        size=(320, 240),
        map_size=256,
        factor=0.0,
        units=0.0,
        surface=surface,
    )
    wrong = stored.compare(truth="hard").parts["all"].wrong
    print(
        f"surface={surface!r}, without any offset: {wrong} pixels differ from ray casting"
    )

# %% [markdown]
# ## Window depth or distance
#
# The Bratislava slides say that the pixels of the map hold "their distance to the source" (SK:331). A depth buffer
# holds window depth instead (E69). Both can be compared, and `map-distance` does what the slide says: a program writes
# the distance in world units into a float texture. What differs is where the steps are.
#
# The scene: three plates at distances 3, 6 and 12 from a lamp, and above each of them a tile. The gap between plate and
# tile is 0.4 everywhere; along a slanted ray it is a little longer.


# %%
def pair(name, distance, x):
    height = 12 - distance
    plate = ss.shapes.floor(0.3 * distance)
    tile = ss.shapes.floor(0.1 * distance)
    return [
        ss.SceneObject(
            plate, ss.placement((x, height, 0)), receives=True, name=f"{name} plate"
        ),
        ss.SceneObject(
            tile,
            ss.placement((x, height + 0.4, 0)),
            material=ss.Material((0.9, 0.6, 0.2)),
            name=f"{name} tile",
        ),
    ]


plates = ss.Scene(
    "plates",
    ss.Camera((-1.2, 14, 16), (-1.2, 4.9, 0), fov_y=36),
    [ss.Light((0, 12, 0), name="lamp")],
    pair("near", 3, 1) + pair("middle", 6, 0) + pair("far", 12, -4),
)
same = {"size": (320, 240), "map_size": 512}
depth_map = ss.run("map", plates, factor=0.0, units=0.0, bias=0.005, **same)
distance_map = ss.run("map-distance", plates, bias=0.05, normal_bias=0.0, **same)
ax = ss.notebook.show_image(distance_map)

# %% [markdown]
# Take a pixel in the shadow of each tile. Its history tells what the map stores, and what is compared with it, so the
# gap can be measured in both maps. The last two columns are, in world units, the difference between two neighbouring
# numbers that the map can store: 2⁻²⁴ for the depth, the next float for the distance.

# %%
on_plates = {}
for y, x in np.argwhere(depth_map.shadow_mask & distance_map.shadow_mask):
    plate = distance_map.pixel(x, y).rows[-1].object
    on_plates.setdefault(plate, []).append((int(x), int(y)))
places = {plate: pixels[len(pixels) // 2] for plate, pixels in on_plates.items()}


def gap(run, x, y):
    """Return what is stored, and by how much the point itself is farther."""
    rows = reversed(run.pixel(x, y).rows)
    lookup = next(row.lookups[0] for row in rows if row.lookups)
    return lookup.stored, lookup.depth + run.options["bias"] - lookup.stored


print("plate         gap in depth  gap in distance   step of depth  step of distance")
steps = {}
for plate, place in places.items():
    _, in_depth = gap(depth_map, *place)
    stored, in_distance = gap(distance_map, *place)
    steps[plate] = in_distance / in_depth * 2**-24, float(np.spacing(np.float32(stored)))
    print(f"{plate:12} {in_depth:13.5f} {in_distance:16.3f}", end=" ")
    print("{:15.1e} {:17.1e}".format(*steps[plate]))
assert steps["near plate"][0] < steps["near plate"][1]
assert steps["far plate"][0] > steps["far plate"][1]

# %% [markdown]
# **Precision.** The depth map has its finest steps near the lamp, finer than those of a float; at the far plate they
# are coarser. One step of window depth *z* is 2⁻²⁴ · *d*² (*f* − *n*) / *nf* in world units: four times as much at
# twice the distance *d* along the view. A float has 24 bits at any distance, so its step is the same share of the
# distance, to within a factor of two.
#
# **The bias.** By the same law, a constant bias in window depth is a larger distance far from the lamp than near it. In
# the distance map it is the same distance everywhere. Now let the bias of both maps grow until all shadows are lost.

# %%
my_first_lost = ...  # in the depth map: "near plate", "far plate" or "all at once"

# %%
lost = {}
for technique, no_offset, biases in (
    ("map", {"factor": 0.0, "units": 0.0}, (0.005, 0.01, 0.02, 0.03, 0.1, 0.2)),
    ("map-distance", {"normal_bias": 0.0}, (0.03, 0.1, 0.2, 0.3, 0.38, 0.45)),
):
    for bias in biases:
        dark = ss.run(technique, plates, bias=bias, **no_offset, **same).shadow_mask
        in_shadow = [plate for plate, (x, y) in places.items() if dark[y, x]]
        print(
            f"{technique:12} bias {bias:5}: in shadow: {', '.join(in_shadow) or 'none'}"
        )
        lost.setdefault(technique, []).append(set(places) - set(in_shadow))
first_lost = {technique: next(filter(None, sets)) for technique, sets in lost.items()}
assert first_lost["map-distance"] == set(places)
lessons.compare_prediction(
    "Which shadow is lost first in the depth map?",
    my_first_lost,
    min(first_lost["map"]) if len(first_lost["map"]) == 1 else "all at once",
    "The same difference of window depth is the largest distance where the map is "
    "coarsest, far from the lamp. In the distance map all three are lost between 0.38 "
    "and 0.45, as the gap is 0.4 to 0.43 everywhere.",
)

# %% [markdown]
# Neither of them follows the *slope*: a constant distance is too small for a steep surface, as a constant depth is
# (E49). `glPolygonOffset` does follow it, but it moves window depth only. `map-distance` moves the points along their
# normals instead (`normal_bias`): half the diagonal of a texel is enough for flat faces of any slope.
#
# ## Exercise
#
# Write the offset that a plane needs. `dz_dx` and `dz_dy` are the changes of its depth over one texel.


# %%
def enough(dz_dx, dz_dy):
    return ...


# %%
cases = [((0.2, 0.1), 0.15), ((-0.2, 0.1), 0.15), ((-0.4, -0.4), 0.4), ((0.0, 0.0), 0.0)]
lessons.check_function(enough, cases, within=1e-12)

# %% [markdown]
# `glPolygonOffset` uses max(|∂z/∂x|, |∂z/∂y|) instead, which is never smaller.
#
# ## Sources
#
# Woo 1992, "The shadow depth map revisited"; Brabec, Annen & Seidel 2002, "Practical shadow mapping". Slides: SK:331,
# SK:369-377, CA:524-557, CA:620. Corrections: E27, E31, E32, E48, E49, E52, E69.
