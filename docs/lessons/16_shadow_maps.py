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
# # 16. Shadow maps
#
# **Goal.** You can follow one pixel from the window to a texel of the map and back, and you know the two passes, their
# matrices and what each of them writes.
#
# **Slides.** Bucharest (Moldoveanu 2021), "umbre 2", lines 12-85. Bratislava (Zimányi & Valient 2004), lines 324-357.
# Barcelona (Andújar 2021), lines 498-637.
#
# Seen from the light there are no shadows: what the light sees is lit, and everything behind it is not. So draw the
# scene from the light and keep the depth buffer (Williams 1978). Then draw it from the eye, transform every visible
# point into the light's view, and compare: is it **farther** from the light than what the map stores there?

# %%
import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons

scene = ss.Scene.named("torus")
run = ss.run("map", scene, size=(320, 240), map_size=256)

# %% [markdown]
# ## The slide and the program

# %%
lessons.code_beside_slide("map", step=1)

# %% [markdown]
# The slides draw the map in the window and copy it. A map larger than the window is cut off then (E62), so the
# corrected program draws into a framebuffer object.
#
# ## The buffers after each step
#
# The first step draws into a texture; the window stays empty. The map *is* a picture: when a shadow is wrong, look at
# it first.

# %%
ax = ss.notebook.show_map(run, "ZS")

# %%
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Click a pixel

# %%
lessons.clickable(run)

# %% [markdown]
# ## From the pixel to the texel, by hand
#
# The chain of spaces: world → light's view → clip → divide by w → scale and shift from [−1, 1] to [0, 1]. The slides
# write all but the division as one texture matrix (Barcelona, lines 559-575): scale and shift by ½ × projection × view.

# %%
y, x = (int(n) for n in np.argwhere(run.shadow_mask)[run.shadow_mask.sum() // 2])
print(run.explain(x, y))

# %% [markdown]
# ## Predict, then run
#
# The sentence names the texel, the stored depth and the depth of the point. Which of the two depths must be the larger
# one in a shadow? And how often is the scene drawn in one frame, for one light?

# %%
my_larger = ...  # "stored" or "own", that is, of the point that the pixel shows
my_passes = ...

# %%
display(
    lessons.compare_prediction(
        "Which depth is larger in shadow?",
        my_larger,
        "own",
        "Something nearer to the light is stored. One of the courses prints it the "
        "other way round (E19).",
    ),
    lessons.compare_prediction(
        "How often is the scene drawn?",
        my_passes,
        len(run.steps),
        "Once from the light, once from the eye without the light, once with it where "
        "the map says so.",
    ),
)

# %%
run.ledger

# %% [markdown]
# ## The map does not depend on the eye
#
# It is drawn once for any number of views, as long as light and casters stand still.

# %%
elsewhere = ss.Scene(
    "from above", ss.Camera((0.5, 7, 1), (0, 0, 0)), scene.lights, scene.objects
)
again = ss.run("map", elsewhere, size=(320, 240), map_size=256)
assert (again.maps["ZS"] == run.maps["ZS"]).all()

# %% [markdown]
# ## What goes wrong, and its cure
#
# The Bucharest slides ("umbre 2") have only the light's *view* matrix between point and texel: projection, division by
# w and the scale to texels are missing (E50). Nor do they say that the map must be cleared to the largest depth first
# (E51).

# %%
for name in ("light-view-only", "map-not-cleared", "edge-smear"):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# ## Exercise
#
# Write the last part of the chain: from clip coordinates (x, y, z, w) in the light's view to the column and row of the
# texel, and the depth to compare. The map has `size` × `size` texels. Return `None` for a point behind the light (w ≤
# 0), and for one outside the map.


# %%
def texel_of(clip, size):
    return ...  # (column, row, depth)


# %%
cases = [
    (((0.0, 0.0, 0.0, 1.0), 256), (128, 128, 0.5)),
    (((-1.0, -1.0, -1.0, 1.0), 256), (0, 0, 0.0)),
    (((1.0, 0.5, 1.0, 2.0), 4), (3, 2, 0.75)),
    (((0.0, 0.0, 0.0, -1.0), 256), None),
    (((3.0, 0.0, 0.0, 2.0), 256), None),
]
lessons.check_function(texel_of, cases, within=1e-12)

# %% [markdown]
# ## Sources
#
# Williams 1978, "Casting curved shadows on curved surfaces". Slides: RO2:12-85, SK:324-357, CA:498-637. Corrections:
# E19, E46, E47, E50, E51, E53, E62.
