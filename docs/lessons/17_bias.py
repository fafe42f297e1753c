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
# **Slides.** Bratislava (Zimányi & Valient 2004), lines 369-377. Barcelona (Andújar 2021), lines 524-557 and 620.
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
# adds `factor · m + units · r`, where m is the largest slope of the depth, |∂z/∂x| or |∂z/∂y|, and r the smallest step
# of the depth buffer. The same slides also subtract 0.01 in the shader, "only if the offset was not used" (E48).

# %%
lessons.code_beside_slide("map-bias", step=1)

# %% [markdown]
# ## The theorem
#
# On a plane, a point is at most half a texel away from the sample in each direction. So its depth differs from the
# stored one by at most ½|∂z/∂x| + ½|∂z/∂y| ≤ m. An offset of `factor = 1` is enough, and no constant that ignores the
# slope is (E49). The scene: a floor alone, so that every dark pixel is the floor's own shadow.

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
# Rounding moves a stored depth by up to half a step. That is what the *units* are for: one unit is one step. To see
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
# One unit is enough for 16 and 24 bits. It is not for 32 bits, although this map rounds least: the depth that is
# compared with it is a float, which has 24 bits, and its rounding stays. One unit of this map is 2⁻³² of the range;
# 256 of them are 2⁻²⁴, one step of such a float. So more bits than 24 do not make the bias smaller. Fewer bits do make
# it larger: one unit of 16 bits is 256 times one of 24.

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
# Woo 1992, "The shadow depth map revisited". Slides: SK:369-377, CA:524-557, CA:620. Corrections: E27, E31, E32, E48,
# E49, E52.
