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
# # 6. Projected shadows without the stencil buffer
#
# **Goal.** You can draw the simplest shadow there is, and you know the four ways in which it goes wrong.
#
# **Slides.** Barcelona (Andújar 2021), lines 60-168 and 706-727. Bratislava (Zimányi & Valient 2004), lines 100-183.
#
# Flatten the caster onto the floor by a matrix, draw it dark, and it looks like a shadow (Blinn 1988). Three draws: the
# floor, the flattened caster, the caster. Still simpler, and older, is the *blob*: a dark ellipse below the object,
# which does not depend on the light.

# %%
import warnings

from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)
scene, size = ss.Scene.named("boxes"), (320, 240)
blob = ss.run("blob", scene, size=size)
axes = ss.notebook.show_image(blob)

# %% [markdown]
# ## The slide and the program
#
# The Barcelona slides switch lighting and the depth test off for the shadow:

# %%
lessons.code_beside_slide("planar", step=1)

# %% [markdown]
# With the depth test off, nothing keeps the shadow behind nearer objects, and nothing ends it at the edge of the floor
# (E33). It works only because the floor alone has been drawn so far: the order is receiver, shadow, casters (E60).
#
# ## The buffers after each step

# %%
run = ss.run("planar", scene, size=size, method="depth-off")
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Click a pixel

# %%
lessons.clickable(run)

# %% [markdown]
# ## Predict, then run
#
# The other version keeps the depth test and moves the flattened caster a little towards the eye: `glPolygonOffset(-1,
# -1)`. With an offset of 0, shadow and floor have the same depth up to rounding. Which part of the shadow is visible
# then?

# %%
my_answer = ...  # "all", "nothing", "a part of it, in a pattern"

# %%
whole = int(ss.run("planar", scene, size=size, method="offset").shadow_mask.sum())
fighting = int(
    ss.run(
        "planar", scene, size=size, method="offset", factor=0.0, units=0.0
    ).shadow_mask.sum()
)
print(f"{whole} pixels with the offset, {fighting} without")
part = "a part of it, in a pattern" if fighting else "nothing"
seen = "all" if fighting >= whole else part
lessons.compare_prediction(
    "Which part is visible without the offset?",
    my_answer,
    seen,
    "Rounding decides at each pixel which of two equal depths is smaller.",
)

# %% [markdown]
# ## What goes wrong, and its cure
#
# Each of these is cured by the stencil version of lesson 8, except for one: a caster has no shadow on itself.

# %%
for name in (
    "shadow-outside-receiver",
    "painting-over-nearer",
    "casters-before-shadow",
    "no-self-shadow",
):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# ## Exercise
#
# A light at the height `l_y` over the origin shines on the floor y = 0. Where is the shadow of the point (x, y)?
# (Bratislava, lines 139-152, in two dimensions.) Return `None` for a point that is not below the light.


# %%
def shadow_of(x, y, l_y):
    return ...


# %%
cases = [((1, 2, 4), 2.0), ((1, 0, 4), 1.0), ((0, 3, 4), 0.0), ((-1, 1, 4), -4 / 3)]
cases += [((1, 4, 4), None), ((2, 5, 4), None)]
lessons.check_function(shadow_of, cases, within=1e-12)

# %% [markdown]
# ## Sources
#
# Blinn 1988, "Me and my (fake) shadow". Slides: CA:60-168, CA:706-727, SK:100-183. Corrections: E15, E22, E33, E34,
# E60.
