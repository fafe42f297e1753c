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
# # 1. Planar shadows
#
# The oldest technique that is still taught (Blinn 1988): flatten the caster onto the floor, and paint it dark. One
# matrix flattens it. The stencil buffer decides *where* the flattened caster may change the picture.

# %%
import numpy as np
from IPython.display import display

import softshadow as ss

scene = ss.Scene.named("boxes")
run = ss.run("planar", scene, size=(320, 240), method="stencil")
run.image.shape, run.depth.dtype, run.stencil.dtype

# %% [markdown]
# A run displays itself as a report, which works without Python, too. Click a pixel in it.

# %%
run

# %% [markdown]
# ## Step by step
#
# A run keeps every buffer after every step: arrays with row 0 at the top, indexed `[y, x]`. The pictures show colour,
# depth (stretched over the range of the drawn depths) and stencil: 0 dark, 1 orange.

# %%
axes = ss.notebook.show_steps(run)

# %% [markdown]
# First, drawing the floor marks its pixels with 1. Then the flattened boxes are drawn with all colours masked; they
# remove the mark from the pixels that they cover. Outside the floor there is no mark to remove. Where the mark is
# gone, the floor is drawn again without the light. The boxes are drawn last.
#
# The state of a step prints as the GL calls that make it. This is the second step:

# %%
print(run[1].state)

# %% [markdown]
# Buffers are ordinary arrays. Here are a row of the stencil buffer across the shadow's edge, the same edge as a picture
# with its neighbourhood, and the changes from one step to the next.

# %%
rows, columns = np.nonzero(run.shadow_mask)
middle = len(rows) // 2
x, y = int(columns[middle]), int(rows[middle])
edge = x + int(np.argmax(run[1].stencil[y, x:] != run[1].stencil[y, x]))
print(run[1].stencil[y, edge - 12 : edge + 12])
print(run.diff(0, 1))
ax = ss.notebook.show_stencil(run[1], region=(edge - 12, y - 8, 24, 16))

# %% [markdown]
# ## Why is this pixel dark?
#
# For every pixel, the run lists the fragments that arrived there, with their results. Take the pixel in the middle of
# the shadow.

# %%
print(run.explain(x, y))
run.pixel(x, y)

# %% [markdown]
# The same on the blackboard: a cut through the eye, the light and the point that the pixel shows. The floor is darker
# where it does not see the light.

# %%
ax = ss.notebook.show_section(run, (x, y))

# %% [markdown]
# ## Two failures
#
# Without the stencil buffer, the flattened caster has to pass the depth test. But it lies exactly *in* the floor, so
# rounding decides at each pixel which of the two is visible.

# %%
fighting = ss.failures["z-fighting"]
display(fighting)
print(fighting.explain())

# %% [markdown]
# If the shadow is blended, so that the floor shines through, every layer of the caster darkens the floor once more. A
# closed box has two layers.

# %%
double = ss.failures["double-blending"]
display(double)
print(double.diff)

# %% [markdown]
# ## A property
#
# The ray caster uses no projections, no stencil buffer and no rounding to pixels. Shadows lie on the floor only, and
# away from the edges of shadows both methods agree.

# %%
assert not run.shadow_mask[~run.valid].any()
comparison = run.compare(truth="hard")
assert not comparison.error[~comparison.band].any()
print(comparison)

# %% [markdown]
# To go on, move the light with `ss.notebook.play("planar", "boxes")`, try another method (`"depth-off"`, `"offset"`,
# `"stencil-blend"`, `"texture"`), another scene (`ss.scene_names()`), your own model (`ss.Scene.from_mesh("bunny.obj",
# light=(2, 5, 3))`), or the next notebook, where casters shadow themselves.
