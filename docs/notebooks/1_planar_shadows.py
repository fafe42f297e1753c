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
# The oldest trick that is still taught (Blinn 1988): flatten the caster onto the floor, and paint it dark. One matrix
# does the flattening. Everything else is about *where* the flattened caster may leave its mark, and that is what the
# stencil buffer is for.

# %%
import numpy as np
from IPython.display import display

import softshadow as ss

scene = ss.Scene.named("boxes")
run = ss.run("planar", scene, size=(320, 240), method="stencil")
run.image.shape, run.depth.dtype, run.stencil.dtype

# %% [markdown]
# ## Step by step
#
# A run keeps every buffer after every step: arrays with row 0 on top, indexed `[y, x]`. Shown are colour, depth
# (stretched over what was drawn) and stencil: 0 dark, 1 orange.

# %%
for step in run:
    display(step)
    values, pixels = np.unique(step.stencil, return_counts=True)
    print("pixels per stencil value:", dict(zip(values.tolist(), pixels.tolist(), strict=True)))

# %% [markdown]
# First the floor marks its pixels with 1. Then the flattened boxes are drawn with all colours masked, and take the
# mark away where they land: off the floor there is none to take. Where the mark is gone, the floor is drawn again
# without the light, and the boxes come last.
#
# The state of a step prints as the GL calls that make it. This is the second step:

# %%
print(run[1].state)

# %% [markdown]
# Buffers are arrays, so anything can be asked of them: here is a row of the stencil buffer through the shadow's edge,
# and what changed from one step to the next.

# %%
rows, columns = np.nonzero(run.shadow_mask)
middle = len(rows) // 2
x, y = int(columns[middle]), int(rows[middle])
print(run[1].stencil[y, x - 30 : x + 31])
print(run.diff(0, 1))

# %% [markdown]
# ## Why is this pixel dark?
#
# Every pixel tells what arrived there, and what became of it. Take that one in the middle of the shadow.

# %%
print(run.explain(x, y))
run.pixel(x, y)

# %% [markdown]
# ## Two failures
#
# Without the stencil buffer the flattened caster keeps the depth test. But it lies exactly *in* the floor, and
# rounding decides pixel by pixel who wins.

# %%
fighting = ss.failures["z-fighting"]
display(fighting)
print(fighting.explain())

# %% [markdown]
# And if the shadow is blended, so that the floor shines through, every layer of the caster darkens once more: a
# closed box has two.

# %%
double = ss.failures["double-blending"]
display(double)
print(double.diff)

# %% [markdown]
# ## A property
#
# The ray caster knows nothing of projections, stencil buffers or rounding to pixels. A shadow never leaves the floor,
# and away from the edges of shadows both say the same.

# %%
assert not run.shadow_mask[~run.valid].any()
comparison = run.compare(truth="hard")
assert not comparison.error[~comparison.band].any()
print(comparison)

# %% [markdown]
# Go on: another method (`"depth-off"`, `"offset"`, `"stencil-blend"`, `"texture"`), another scene
# (`ss.scene_names()`), your own model (`ss.Scene.from_mesh("bunny.obj", light=(2, 5, 3))`), or the next notebook,
# where casters shadow themselves.
