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
# # 2. Shadow volumes
#
# What a caster hides from the light is a solid: it begins at the caster and goes on for ever (Crow 1977). A point is
# in shadow when it lies in such a solid, and the stencil buffer can count, for all pixels at once, how many of them
# it lies in (Heidmann 1991).

# %%
import numpy as np
from IPython.display import display

import softshadow as ss

scene = ss.Scene.named("torus")
run = ss.run("volume-zpass", scene, size=(320, 240))

# %% [markdown]
# ## Counting where the depth test passes
#
# A ray from the eye enters a volume through a front face, and leaves it through a back face. Front faces that are
# nearer than the surface count up, back faces that are nearer count down. What is left at the surface is the number
# of volumes it lies in: 0 dark, 1 orange, 2 blue in the pictures, and purple below 0.

# %%
for step in run:
    display(step)
    values, pixels = np.unique(step.stencil, return_counts=True)
    print("pixels per stencil value:", dict(zip(values.tolist(), pixels.tolist(), strict=True)))

# %% [markdown]
# Between the two counting passes the buffer is not a picture of the shadow yet: front faces are drawn everywhere
# where they are seen. The state of a pass prints as the GL calls that make it.

# %%
print(run["count front faces"].state)

# %% [markdown]
# ## Why is this pixel dark?
#
# Take a pixel with the largest count, and look at all its fragments: which face of which volume was in front of the
# surface, and what the stencil value was before and after.

# %%
y, x = (int(n) for n in np.argwhere(run.stencil == run.stencil.max())[0])
print(run.explain(x, y))
run.pixel(x, y)

# %% [markdown]
# ## Two failures
#
# Counting in front of the surface starts at the near rectangle. If the eye stands in a shadow, the volume's front
# face is behind it, and the count is one too low from the beginning.

# %%
eye = ss.failures["eye-in-shadow"]
display(eye)
print(eye.reason, f"{eye.number_wrong} pixels are wrong, with z-fail {eye.number_cured}.")

# %% [markdown]
# A listing of the course tests the lowest bit of the count only: two volumes over each other then read as light.

# %%
parity = ss.failures["mask-1"]
display(parity)
print(parity.diff)

# %% [markdown]
# ## A property
#
# Counting *behind* the surface instead (z-fail) needs no start value, but volumes with a cap at both ends. Where the
# near rectangle is not in shadow both counts are the same number at every pixel, and it is the number of faces that
# stand between light and surface: the ray caster counts them, too.

# %%
other = ss.run("volume-zfail", scene, size=(320, 240))
assert (run.stencil[run.valid] == other.stencil[other.valid]).all()
comparison = other.compare(truth="hard")
assert not comparison.error[~comparison.band].any()
print(comparison)

# %% [markdown]
# What a step costs, in draws, triangles, fragments and stencil updates:

# %%
other.ledger

# %% [markdown]
# Go on: the options of `ss.describe("volume-zfail")`, the scene `"eye-in-shadow"` with `start="eye"` and
# `start="near-plane"`, your own model (`ss.Scene.from_mesh("bunny.obj", light=(2, 5, 3))`), or the next notebook,
# where a second depth buffer takes the place of geometry.
