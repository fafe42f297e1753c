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
# The points that a caster hides from the light form a solid, which begins at the caster and extends to infinity (Crow
# 1977). A point is in shadow if it lies in such a solid. The stencil buffer can count, for all pixels at once, how
# many solids contain the visible point (Heidmann 1991).

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
# nearer than the surface count +1, back faces that are nearer count −1. The sum is the number of volumes that contain
# the surface point. In the pictures, 0 is dark, 1 orange, 2 blue, and values below 0 are purple.

# %%
ss.notebook.show_stencil(run["count front faces"])
ax = ss.notebook.show_stencil(run["count back faces"])

# %% [markdown]
# The report of the run has all buffers of all steps. Click a pixel in it.

# %%
run

# %% [markdown]
# Between the two counting passes, the buffer does not show the shadow yet: front faces have been counted wherever
# they are visible. The state of a pass prints as the GL calls that make it.

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
# The line of sight, on the blackboard: +1 where it enters a volume, −1 where it leaves one.

# %%
ax = ss.notebook.show_section(run, (x, y))

# %% [markdown]
# ## Two failures
#
# Counting in front of the surface starts at the near rectangle. If the eye is in a shadow, the volume's front face is
# behind the eye, and the count is one too low from the beginning.

# %%
eye = ss.failures["eye-in-shadow"]
display(eye)
print(eye.reason, f"{eye.number_wrong} pixels are wrong, with z-fail {eye.number_cured}.")

# %% [markdown]
# A listing of the course tests only the lowest bit of the count. Then points in two overlapping volumes read as lit.

# %%
parity = ss.failures["mask-1"]
display(parity)
print(parity.diff)

# %% [markdown]
# ## A property
#
# Counting *behind* the surface instead (z-fail) needs no start value, but volumes with a cap at both ends. If the
# near rectangle is not in shadow, both counts are equal at every pixel. They are the number of faces between the
# light and the surface, which the ray caster counts, too.

# %%
other = ss.run("volume-zfail", scene, size=(320, 240))
assert (run.stencil[run.valid] == other.stencil[other.valid]).all()
comparison = other.compare(truth="hard")
assert not comparison.error[~comparison.band].any()
print(comparison)

# %% [markdown]
# The cost of each step, in draws, triangles, fragments and stencil updates:

# %%
other.ledger

# %% [markdown]
# To go on, move the light with `ss.notebook.play("volume-zpass", "torus")`, try the options of
# `ss.describe("volume-zfail")`, the scene `"eye-in-shadow"` with `start="eye"` and `start="near-plane"`, your own
# model (`ss.Scene.from_mesh("bunny.obj", light=(2, 5, 3))`), or the next notebook, where a second depth buffer
# replaces the volumes.
