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
# # 13. Z-fail: caps and infinity
#
# **Goal.** You can say why counting behind the surface works for every position of the eye, and what it needs: closed
# volumes that no plane cuts open.
#
# **Slides.** Bucharest (Moldoveanu 2021), lines 289-353.
#
# Z-pass counts from the eye to the surface. Z-fail counts from infinity to the surface: **back** faces **behind** the
# surface +1, front faces behind it −1. At infinity no point is in shadow, so the count always starts at 0. "Behind the
# surface" is where the depth test *fails*, which gives the technique its name.

# %%
import warnings
from dataclasses import replace

import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons

scene = ss.Scene.named("eye-in-shadow")
run = ss.run("volume-zfail", scene, size=(320, 240))

# %% [markdown]
# ## The slide and the program

# %%
lessons.code_beside_slide("volume-zfail", step=1)

# %% [markdown]
# Only two things differ from z-pass: which argument of `glStencilOp` counts, and that the volumes are closed. As
# printed, the slides use the "shadow polygons", which are the sides only (E6).
#
# ## The buffers after each step

# %%
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Click a pixel

# %%
lessons.clickable(ss.run("volume-zfail", "torus", size=(240, 180)))

# %% [markdown]
# ## Predict, then run
#
# On the scene of the last lesson, with the eye in shadow, how many pixels are wrong with z-fail, away from the
# boundaries of shadows?

# %%
my_wrong = ...

# %%
compared = run.compare(truth="hard")
wrong = int((compared.error > 0)[~compared.band].sum())
lessons.compare_prediction(
    "How many pixels are wrong?", my_wrong, wrong, "Z-fail counts from infinity."
)

# %% [markdown]
# ## Why caps?
#
# A line of sight that meets the surface and goes on to infinity must leave every volume that contains the surface
# point. It leaves through a side, or through the end. Without the end there is nothing to count. Looking down the axis
# of the volumes shows it, since then many lines of sight leave through the end:

# %%
for name in ("missing-caps", "finite-far-plane"):
    failure = ss.failures[name]
    display(failure)
    print(failure.explain())

# %% [markdown]
# The far plane cuts volumes in the same way: what is behind it is not drawn, and not counted (E8). Two cures: a
# projection without a far plane, whose clip coordinates of points at infinity are still inside, or `GL_DEPTH_CLAMP`. In
# both, the far cap lies *at infinity*: its vertices have w = 0. Here the far plane lies just behind the scene:

# %%
warnings.simplefilter("ignore", ss.Warning)
sunlight = ss.Scene.named("sunlight")
near_end = replace(
    sunlight,
    camera=replace(sunlight.camera, far=float(np.linalg.norm(sunlight.camera.eye)) + 1),
)
for far in ("infinite", "clamp", "finite"):
    compared = ss.run("volume-zfail", near_end, size=(320, 240), far=far).compare(
        truth="hard"
    )
    print(f"far={far!r}: {compared.parts['all'].wrong} pixels differ from ray casting")

# %% [markdown]
# ## The two counts compared
#
# Z-pass and z-fail count different faces. But a whole line, without beginning and end, enters every closed volume as
# often as it leaves it. So the counts differ only by the start of z-pass: zpass + N(near) = zfail, where N(near) is the
# number of volumes around the beginning of the line. Where no volume touches the near rectangle, they are equal:

# %%
torus = ss.Scene.named("torus")
zpass, zfail = (
    ss.run(name, torus, size=(320, 240)) for name in ("volume-zpass", "volume-zfail")
)
assert (zpass.stencil[zpass.valid] == zfail.stencil[zfail.valid]).all()

# %% [markdown]
# ## Exercise
#
# Write the counting rule of z-fail as a function, as you did for z-pass, and check that both give the same number.


# %%
def count_behind(faces, surface):
    return ...


# %%
faces = [
    (0.30, "front"),
    (0.40, "front"),
    (0.55, "back"),
    (0.80, "back"),
    (0.90, "front"),
    (0.95, "back"),
]
expected = {
    0.25: 0,
    0.35: 1,
    0.50: 2,
    0.60: 1,
    0.85: 0,
    0.92: 1,
}  # by the depth of the surface
lessons.check_function(
    count_behind, [((faces, surface), number) for surface, number in expected.items()]
)

# %% [markdown]
# ## Sources
#
# Everitt and Kilgard 2002, "Practical and robust stenciled shadow volumes for hardware-accelerated rendering". The
# slides name John Carmack, who made the technique popular; Bilodeau and Songy had presented it before (E14). Slides:
# RO1:289-353. Corrections: E5, E6, E7, E8, E14, E58.
