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
# # 20. Silhouette maps
#
# **Goal.** You know how a shadow map can have straight edges without more texels, and where it cannot.
#
# **Slides.** Bratislava (Zimányi & Valient 2004), lines 420-424.
#
# A shadow map is good inside a shadow and outside it, and bad at the edge, where one texel covers many pixels. So
# store, for each texel that the silhouette passes through, one point of the silhouette. A pixel that falls into such a
# texel is compared with the neighbour on its side of the silhouette: the texel is cut into four parts by lines from the
# stored point (Sen, Cammarano and Hanrahan 2003).

# %%
import warnings

from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)
scene, size = ss.Scene.named("boxes"), (320, 240)
run = ss.run("map-silhouette", scene, size=size, map_size=64)

# %% [markdown]
# ## The slide and the program
#
# The slides describe the technique in words. The depth map is that of every shadow map:

# %%
lessons.code_beside_slide("map", step=1)

# %% [markdown]
# ## The buffers after each step

# %%
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Click a pixel
#
# At an edge, the history tells the texel's silhouette point and on which side of it the pixel is.

# %%
lessons.clickable(run)

# %% [markdown]
# ## Predict, then run
#
# Both maps have 64 × 64 texels. How many times as many wrong pixels does the plain map have on the floor: about 1, 3,
# or 10 or more?

# %%
my_factor = ...  # 1, 3 or 10

# %%
on_the_floor = (
    ss.testing.cast_truth(scene, size).objects == 0
)  # the floor is the first object


def wrong_on_the_floor(name, texels):
    compared = ss.run(name, scene, size=size, map_size=texels).compare(truth="hard")
    return int((abs(compared.error) > 0.5)[on_the_floor].sum())


wrong = {name: wrong_on_the_floor(name, 64) for name in ("map", "map-silhouette")}
print(wrong)
factor = wrong["map"] / wrong["map-silhouette"]
lessons.compare_prediction(
    "How many times as many?",
    my_factor,
    10 if factor > 6 else 3 if factor > 1.7 else 1,
    f"{factor:.1f} times here.",
)

# %% [markdown]
# ## More texels, on the floor

# %%
for texels in (32, 128, 512):
    errors = [wrong_on_the_floor(name, texels) for name in ("map", "map-silhouette")]
    print(f"{texels:4} texels: map {errors[0]:5}, silhouette map {errors[1]:5}")

# %% [markdown]
# ## What goes wrong, and its cure
#
# One point in a texel is one edge. Where two silhouettes cross the same texel, only one of them is stored; a smaller
# texel helps. And the edge is straight, but still hard.

# %%
for name in ("jagged-edges",):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# ## Exercise
#
# The lines that cut a texel lead from its silhouette point to those of its four neighbours. Write the simplest case:
# the silhouette is a vertical line through the point (px, py). On which side of it is (x, y)?


# %%
def side(x, y, px, py):
    return ...  # "left" or "right"


# %%
lessons.check_function(
    side,
    [
        ((0.2, 0.5, 0.3, 0.9), "left"),
        ((0.4, 0.5, 0.3, 0.9), "right"),
        ((0.9, 0.1, 0.3, 0.2), "right"),
    ],
)

# %% [markdown]
# ## Sources
#
# Sen, Cammarano and Hanrahan 2003, "Shadow silhouette maps". Slides: SK:420-424.
