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
# # 19. Lights in all directions, and spot lights
#
# **Goal.** You can say when one shadow map is enough for a light, and what to do when it is not.
#
# **Slides.** Bucharest (Moldoveanu 2021), lines 21-24. Barcelona (Andújar 2021), line 803.
#
# A map is a picture, so it has a field of view of less than 180 degrees. The Bucharest slides divide lights into those
# at infinity, those *outside the scene*, and those *inside the scene*, the hardest case. The exact condition is another
# one: does **one frustum** from the light contain all casters and receivers (E55)? A lamp inside a room has walls on
# all sides, and no frustum contains them.

# %%
import warnings

from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)  # they are printed below
room, size = ss.Scene.named("room"), (320, 240)
run = ss.run("map", room, size=size)
for warning in run.warnings:
    print(f"{type(warning).__name__}: {warning}")

# %% [markdown]
# ## The slide and the program
#
# One frustum, with the field of view of the light's camera:

# %%
lessons.code_beside_slide("map", step=1)

# %% [markdown]
# ## The buffers after each step
#
# With one map, most of the room is outside. Those points are drawn lit, and the map *unknown* marks them.

# %%
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Six maps
#
# `map-cube` draws the depth in all six directions. Each point is looked up in the face of the cube that its direction
# from the light meets.

# %%
cube = ss.run("map-cube", room, size=size)
for name, picture in (("one map", run), ("six maps", cube)):
    parts = picture.compare(truth="hard").parts
    print(
        f"{name:9} {parts['all'].wrong:5} of {parts['all'].pixels} pixels differ from "
        "ray casting"
    )

# %% [markdown]
# ## Click a pixel

# %%
lessons.clickable(ss.run("map-cube", room, size=(240, 180), map_size=256))

# %% [markdown]
# ## Predict, then run
#
# How many passes over the scene does a frame with six maps have: from the light, and from the eye?

# %%
my_passes = ...

# %%
passes = cube.ledger.total.passes
lessons.compare_prediction(
    "How many passes?",
    my_passes,
    len(passes),
    "Six from the light. From the eye three: without the light, a mark where the maps "
    "say lit, and with the light.",
)

# %% [markdown]
# ## A spot light
#
# A spot light shines into a cone. One map along its axis covers the cone, and outside it there is no light anyway.

# %%
spot = ss.run("map", "spotlight", size=size)
print(spot.compare(truth="hard"))

# %% [markdown]
# ## What goes wrong, and its cure

# %%
for name in ("omni-light", "edge-smear"):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# ## Exercise
#
# Write the choice of the cube's face: the axis of the largest component of the direction, with its sign, such as "+x"
# or "-z".


# %%
def face(x, y, z):
    return ...


# %%
cases = [
    ((3, 1, 2), "+x"),
    ((-3, 1, 2), "-x"),
    ((0.1, 0.2, -0.3), "-z"),
    ((0, 5, 1), "+y"),
]
lessons.check_function(face, cases)

# %% [markdown]
# ## Sources
#
# Gerasimov 2004, "Omnidirectional shadow mapping". Slides: RO1:21-24, CA:803. Corrections: E47, E55.
