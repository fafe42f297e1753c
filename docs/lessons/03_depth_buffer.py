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
# # 3. The depth buffer and its precision
#
# **Goal.** You know what the depth buffer stores, why most of its values lie near the eye, and what the near plane has
# to do with it.
#
# **Slides.** Barcelona (Andújar 2021), lines 100-145 and 185-212. Bucharest (Moldoveanu 2021), lines 144-150.
#
# The depth buffer stores one number for each pixel: the depth of the nearest surface so far. A fragment passes the
# depth test if its depth is less (`GL_LESS`) than the stored one. The number is not the distance. For a distance d from
# the eye, between the planes n and f, window depth is
#
#     z = f/(f − n) · (1 − n/d)
#
# and it is stored as an integer of 16, 24 or 32 bits, or as a float.

# %%
import warnings
from dataclasses import replace

import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons, testing

warnings.simplefilter("ignore", ss.Warning)  # they are printed below


def window_depth(d, near, far):
    return far / (far - near) * (1 - near / d)


print("distance  depth (near 0.1)  depth (near 1)")
for d in (1, 2, 5, 10, 50, 100):
    print(f"{d:8}  {window_depth(d, 0.1, 100):16.4f}  {window_depth(d, 1, 100):14.4f}")

# %% [markdown]
# With the near plane at 0.1, half of all depths belong to the first 0.1 units behind it.
#
# ## The slide and the program
#
# A shadow technique draws the same surfaces twice or more, and the second drawing must pass the depth test. The
# Barcelona program draws the depth alone first:

# %%
lessons.code_beside_slide("volume-five-passes", step=0)

# %% [markdown]
# ## The buffers after each step

# %%
scene, size = ss.Scene.named("boxes"), (320, 240)
run = ss.run("volume-zfail", scene, size=size)
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Click a pixel
#
# Every row has the fragment's depth and the stored depth before it.

# %%
lessons.clickable(run)

# %% [markdown]
# ## Predict, then run
#
# How far apart are two neighbouring values of a buffer with 16 bits at the distance 50, with near 0.1 and far 100? Give
# the order of magnitude: 0.001, 0.01, 0.1 or 1 units.

# %%
my_step = ...

# %%
steps = np.array([0, 1]) / (2**16 - 1) + window_depth(50, 0.1, 100)
near, far = 0.1, 100
distances = near / (1 - steps * (far - near) / far)
gap = float(np.diff(distances)[0])
print(f"{gap:.3f} units")
lessons.compare_prediction(
    "How far apart are they?",
    my_step,
    float(10 ** np.floor(np.log10(gap))),
    "A step of depth is d²/n times a step of the buffer: it grows with the square of "
    "the distance.",
)

# %% [markdown]
# ## The same scene with three near planes

# %%
for near in (1.0, 0.01, 0.0001):
    close = replace(scene, camera=replace(scene.camera, near=near))
    drawn = ss.run("volume-zfail", close, size=size)
    wrong = drawn.compare(truth="hard").parts["all"].wrong
    print(
        f"near {near:6}: {wrong:5} pixels differ",
        *[type(each).__name__ for each in drawn.warnings],
    )

# %% [markdown]
# ## Equal depths
#
# The same vertices under the same state give the same bits, so a second drawing of a surface passes `GL_LEQUAL` or
# `GL_EQUAL` at every pixel. It does not pass `GL_LESS`.


# %%
def twice(func):
    def program(gl):
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        gl.glEnable(gl.GL_DEPTH_TEST)
        for color in ((1, 0, 0), (0, 1, 0)):
            gl.glColor3f(*color)
            gl.glRectf(-1, -1, 1, 1)
            gl.glDepthFunc(getattr(gl, func))

    return "green" if testing.run_here(program, (2, 2)).color[0, 0, 1] else "red"


for func in ("GL_LESS", "GL_LEQUAL", "GL_EQUAL"):
    print(func, twice(func))

# %% [markdown]
# ## What goes wrong, and its cure
#
# The lit pass of the shadow volumes with `GL_LESS`, as the Bucharest slides leave it (E2):

# %%
failure = ss.failures["less-in-lit-pass"]
display(failure)
print(failure.reason)

# %% [markdown]
# If the depth test is *disabled*, every fragment counts as passing, and no depth is written either (E43).
#
# ## Exercise
#
# Write the distance of a window depth: the inverse of the formula above.


# %%
def distance(z, near, far):
    return ...


# %%
cases = [((window_depth(d, 1, 100), 1, 100), d) for d in (1, 2, 50, 100)]
lessons.check_function(distance, cases, within=1e-6)

# %% [markdown]
# ## Sources
#
# OpenGL 2.1 specification, sections 2.11.1 and 4.1.6. Slides: CA:100-145, CA:185-212, RO1:144-150. Corrections: E2,
# E43, E59, E61.
