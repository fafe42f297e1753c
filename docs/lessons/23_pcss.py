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
# # 23. Percentage-closer soft shadows
#
# **Goal.** You can follow the three parts of the technique at a pixel: blocker search, penumbra estimate, filter; and
# you know what the mean of blockers gets wrong.
#
# **Slides.** None of the courses has it; it joins what they have: shadow maps (Bratislava, Zimányi & Valient 2004,
# lines 324-401) and the width of the penumbra (Barcelona, Andújar 2021, lines 43-54).
#
# Percentage-closer filtering blurs every edge by the same width. A penumbra has the width w = s · (d_r − d_b)/d_b. A
# lookup in a shadow map has both distances: d_r is that of the point, d_b the stored one. So: search the neighbourhood
# for blockers, take the mean of their depths, compute w, and filter as widely as that (Fernando 2005).

# %%
import warnings

import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)
scene, size = ss.Scene.named("soft-slab"), (240, 180)
truth = ss.soft_truth(scene, size)
run = ss.run("map-pcss", scene, size=size)

# %% [markdown]
# ## The slide and the program
#
# The first pass is that of every shadow map:

# %%
lessons.code_beside_slide("map", step=1)

# %% [markdown]
# ## The buffers after each step
#
# Besides the picture there are maps: how far the blockers are, how wide the penumbra is, and how many blockers were
# found.

# %%
axes = ss.notebook.show_steps(run)
print(sorted(run.maps))

# %% [markdown]
# ## Click a pixel

# %%
lessons.clickable(run)

# %% [markdown]
# ## Predict, then run
#
# The light is made twice as wide. What happens to the estimated width of the penumbra?

# %%
my_factor = ...

# %%
from dataclasses import replace

light = scene.lights[0]
shape = replace(
    light.shape,
    edge_u=2 * np.asarray(light.shape.edge_u),
    edge_v=2 * np.asarray(light.shape.edge_v),
)
wide = replace(scene, lights=(replace(light, shape=shape),))
name = next(name for name in run.maps if "penumbra" in name)


def middle_width(drawn):
    widths = drawn.maps[name]
    return float(np.median(widths[np.isfinite(widths) & (widths > 0)]))


ratio = middle_width(ss.run("map-pcss", wide, size=size)) / middle_width(run)
lessons.compare_prediction(
    "By which factor does the width grow?",
    my_factor,
    round(ratio, 1),
    "w is proportional to s.",
    within=0.15,
)

# %% [markdown]
# ## How exact is it?

# %%
for technique in ("map", "map-pcf", "map-pcss"):
    compared = ss.run(technique, scene, size=size).compare(truth=truth)
    print(
        f"{technique:9} RMS {compared.parts['all'].rms:.4f}, in the penumbra "
        f"{compared.parts['penumbra'].rms:.4f}"
    )

# %% [markdown]
# One slab, parallel to the light and the floor, is the best case: there is one blocker distance, and its mean is right.
#
# ## What goes wrong, and its cure
#
# Two blockers at different distances count as one between them. And a blocker that the map does not store, because
# another one is nearer to the light, has no effect.

# %%
for name_of_failure in ("mean-blocker", "constant-width"):
    failure = ss.failures[name_of_failure]
    display(failure)
    print(failure.reason)

# %% [markdown]
# ## Exercise
#
# Write the first two parts for one pixel: the mean of those stored depths that are nearer than the point (`own`), and
# the width. Return 0 if nothing blocks.


# %%
def penumbra(stored, own, light_size):
    return ...


# %%
cases = [
    ((np.array([2.0, 2.0, 9.0]), 4.0, 1.0), 1.0),
    ((np.array([9.0, 9.0]), 4.0, 1.0), 0.0),
    ((np.array([1.0, 3.0]), 4.0, 0.5), 0.5),
]
lessons.check_function(penumbra, cases, within=1e-12)

# %% [markdown]
# ## Sources
#
# Fernando 2005, "Percentage-closer soft shadows". Slides: SK:324-401, CA:43-54.
