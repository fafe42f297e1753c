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
# # 1. What a shadow is
#
# **Goal.** You can say, for any pixel, whether its point is lit, in its own shadow or in a cast shadow, and which
# object casts it. You know the families of techniques that this course is about.
#
# **Slides.** Bucharest (Moldoveanu 2021), lines 9-39. Bratislava (Zimányi & Valient 2004), lines 27-98. Barcelona
# (Andújar 2021), lines 9-37.
#
# A point is in shadow if the light does not see it. Finding shadows is therefore the problem of hidden surfaces once
# more, with the light in place of the eye. An **occluder** hides the light from a **receiver**. A face that looks away
# from the light is in its **own** shadow; where another surface lies between, the shadow is **cast**.

# %%
import warnings

import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)
scene, size = ss.Scene.named("boxes"), (320, 240)
run = ss.run("volume-zfail", scene, size=size)

# %% [markdown]
# ## Own and cast
#
# `shadow_kinds` returns the kind of shadow at each pixel: 0 none, 1 own, 2 cast.

# %%
kinds = run.shadow_kinds()
for kind, name in enumerate(("lit", "own shadow", "cast shadow")):
    print(f"{name:12} {int((kinds[run.valid] == kind).sum()):6} pixels")

# %% [markdown]
# ## The slide and the program
#
# Shadow volumes and shadow maps have three parts: draw the scene without the light, find the shadows, and add the light
# where there are none. The first step of the Bucharest program:

# %%
lessons.code_beside_slide("volume-zpass", step=0)

# %% [markdown]
# ## The buffers after each step

# %%
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Click a pixel
#
# Click at the foot of a box, on its dark side, and on the floor behind it. The sentence above the table names the
# caster.

# %%
lessons.clickable(run)

# %% [markdown]
# ## Predict, then run
#
# What is the colour of a point in shadow, with one white light and some ambient light? Choose: black; the ambient part
# of its colour; half of its lit colour.

# %%
my_color = ...  # "black", "ambient" or "half"

# %%
y, x = (int(n) for n in np.argwhere(run.shadow_mask)[run.shadow_mask.sum() // 2])
ambient, final = run[0].image[y, x, :3], run.image[y, x, :3]
print(run.explain(x, y))
lessons.compare_prediction(
    "What is the colour of a point in shadow?",
    my_color,
    "ambient" if (ambient == final).all() else "something else",
    "Emission and ambient light are there with and without a shadow; only the light's "
    "own part is missing.",
)

# %% [markdown]
# ## Why shadows matter
#
# If only the shadows of a picture are moved, its objects seem to be at other heights (the demonstration of perception
# on the Barcelona slides, lines 21-34). Without a shadow, nobody can tell how high an object is above the floor.

# %%
torus = ss.Scene.named("torus")
pictures = [
    ss.run(name, torus, size=(200, 150)).image for name in ("blob", "volume-zfail")
]
axes = ss.notebook.show_image(
    np.concatenate(pictures, axis=1), title="The torus: left a blob, right its shadow"
)

# %% [markdown]
# ## The families
#
# - **Fake**: the shadow is not computed at all (blobs, lesson 6).
# - **Analytic**, in object space: geometry is computed and drawn. Projected shadows (6 to 8), shadow polygons (9),
#   volumes (10 to 15), wedges (22).
# - **Raster**, in image space: a picture from the light. Shadow maps (16 to 20), filtered and soft ones (18, 23).
#
# ## What goes wrong, and its cure
#
# With several lights, a point may be in the shadow of one and lit by another. Each light needs its own shadows, and its
# own pass that *adds* its light. Dimming the whole colour is wrong (E53):

# %%
for name in ("factor-on-whole-color", "missing-clear"):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# ## Exercise
#
# Write the colour of a point, in one channel, at most 1. `emission` and `ambient` are always there. `lights` has a pair
# for each light: its direct part, and whether the point sees it (1 or 0).


# %%
def color_of(emission, ambient, lights):
    return ...


# %%
cases = [
    ((0.0, 0.2, [(0.5, 1)]), 0.7),
    ((0.0, 0.2, [(0.5, 0)]), 0.2),
    ((0.1, 0.2, [(0.5, 0), (0.3, 1)]), 0.6),
    ((0.0, 0.2, [(0.9, 1), (0.9, 1)]), 1.0),
]
lessons.check_function(color_of, cases, within=1e-12)

# %% [markdown]
# ## Sources
#
# Crow 1977, "Shadow algorithms for computer graphics". Slides: RO1:9-39, SK:27-98, CA:9-37. Corrections: E17, E23, E53.
