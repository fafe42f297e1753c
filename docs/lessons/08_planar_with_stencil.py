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
# # 8. Projected shadows with the stencil buffer
#
# **Goal.** You know the four steps of the stencil version, and which problem of the plain projection each of them
# solves.
#
# **Slides.** Barcelona (Andújar 2021), lines 292-359 and 743-794. Bratislava (Zimányi & Valient 2004), lines 195-207.
#
# The plain projection draws the flattened caster as a dark object *in* the floor. Three things go wrong: both have the
# same depth, so rounding decides which one is seen; the shadow does not end where the floor ends; and where two layers
# of the caster overlap, a blended shadow is darkened twice. The stencil buffer solves all three.

# %%
import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons

scene = ss.Scene.named("boxes")
run = ss.run("planar", scene, size=(320, 240), method="stencil")

# %% [markdown]
# ## The slide and the program
#
# The step in which the flattened caster removes the mark:

# %%
lessons.code_beside_slide("planar-stencil", step=1)

# %% [markdown]
# This listing is right as it is printed (E41).
#
# ## The buffers after each step

# %%
axes = ss.notebook.show_steps(run)

# %% [markdown]
# 1. The receiver is drawn and marks its pixels with 1.
# 2. The flattened casters set the mark back to 0. They write neither colour nor depth, and the depth test is off.
# 3. Where the mark is 0, the receiver is drawn again, without the light.
# 4. The casters are drawn.
#
# ## Click a pixel

# %%
lessons.clickable(run)

# %% [markdown]
# ## Predict, then run
#
# Two layers of a box cover one pixel of its shadow. What is the stencil value after the first layer, and after the
# second?

# %%
my_first, my_second = ..., ...

# %%
y, x = (int(n) for n in np.argwhere(run.shadow_mask)[run.shadow_mask.sum() // 2])
removing = [
    row for row in run.pixel(x, y) if row.stencil_before is not None and row.step == 1
]
values = [row.stencil_after for row in removing]
print("stencil value after each fragment of step 1:", values)
display(
    lessons.compare_prediction(
        "After the first layer?", my_first, values[0], "GL_ZERO, where the mark was 1."
    ),
    lessons.compare_prediction(
        "After the second?",
        my_second,
        values[1],
        "The test is 1 == 0 now: the second layer is discarded.",
    ),
)

# %% [markdown]
# ## Each problem, and its cure

# %%
for name in ("z-fighting", "shadow-outside-receiver", "double-blending"):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# ## What stays wrong
#
# Receivers must be planar, and each needs a pass and a matrix of its own. No object casts a shadow on itself or on
# another one. The edge is hard.
# The ray caster shows what is missing:

# %%
compared = run.compare(truth="hard")
print(compared)
display(ss.failures["no-self-shadow"])

# %% [markdown]
# ## Exercise
#
# Write step 2 for a square "shadow" that is flattened already: it must remove the mark of the receiver and change
# nothing else. The check compares colour and stencil with the solution's.


# %%
def receiver(gl):
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, 1, 1)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    gl.glColor3f(0.8, 0.8, 0.7)
    gl.glRectf(-0.9, -0.9, 0.3, 0.9)


def program(gl):
    receiver(gl)
    # your calls
    # the flattened caster; a part of it is beyond the receiver
    gl.glRectf(-0.4, -0.4, 0.6, 0.4)


# %% tags=["hide-input"]
def solution(gl):
    receiver(gl)
    gl.glColorMask(False, False, False, False)
    gl.glStencilFunc(gl.GL_EQUAL, 1, 1)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_ZERO)
    gl.glRectf(-0.4, -0.4, 0.6, 0.4)


# %%
lessons.check_program(program, solution, buffers=("color", "stencil"))

# %% [markdown]
# ## Sources
#
# Blinn 1988, "Me and my (fake) shadow". Slides: CA:292-359, CA:743-794, SK:195-207. Corrections: E33, E41, E60.
