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
# # 5. The stencil buffer
#
# **Goal.** You can say, for every fragment, whether the stencil test lets it pass and what it writes into the stencil
# buffer.
#
# **Slides.** Barcelona (Andújar 2021), lines 185-290 and the quiz in lines 667-674. Bucharest (Moldoveanu 2021), lines
# 144-150.
#
# The stencil buffer stores one small integer for each pixel, here a byte: 0 to 255. Two calls control it:
#
# - `glStencilFunc(func, ref, mask)` is the **test**: a fragment passes if `(ref & mask) func (stencil & mask)` is true.
# - `glStencilOp(sfail, zfail, zpass)` is the **update**. It names three operations: for fragments that fail the stencil
#   test, for those that pass it and fail the depth test, and for those that pass both.
#
# If the depth test is disabled, `zpass` applies. The update takes place for any `func`, also for `GL_ALWAYS` and
# `GL_NEVER`, which compare nothing.

# %%
import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons, listings, testing

# %% [markdown]
# ## The slide and the program
#
# The exercise on the slide draws two quads. The first one marks its pixels with 1. The second one is drawn only where
# there is no mark. The lines of the step are marked by ▶. Where a slide has to be corrected, it stands at the left, and
# what runs here at the right.

# %%
lessons.code_beside_slide("stencil-quads", step=0)

# %%
lessons.code_beside_slide("stencil-quads", step=1)

# %% [markdown]
# ## The buffers after each step

# %%
run = lessons.run_listing("stencil-quads")
axes = ss.notebook.show_steps(run)

# %% [markdown]
# In pictures of the stencil buffer, 0 is dark and 1 is orange. The first step writes both buffers. The second step
# writes only the colour buffer, because its three operations are `GL_KEEP`.
#
# ## Click a pixel
#
# The report lists all fragments of the pixel that you click. Try one in the overlap of the two quads.

# %%
lessons.clickable(run)

# %% [markdown]
# ## Predict, then run
#
# Take the pixel in the middle, where the quads overlap. What is its stencil value at the end, and what is its colour?
# Replace the three dots.

# %%
my_stencil = ...  # a number
my_color = ...  # "red" or "green"

# %%
x, y = 64, 64
r, g, b = (int(channel) for channel in run.image[y, x, :3])
display(
    lessons.compare_prediction(
        "The stencil value in the overlap?",
        my_stencil,
        int(run.stencil[y, x]),
        "The first quad wrote 1, and the second one keeps what is there.",
    ),
    lessons.compare_prediction(
        "The colour in the overlap?",
        my_color,
        "red" if r > g else "green",
        "The test of the second quad is 0 == 1, which is false, so its fragment is "
        "discarded.",
    ),
)

# %%
run.pixel(x, y)

# %% [markdown]
# ## What the mask of the test does not do
#
# `GL_REPLACE` writes the whole reference value. The mask of `glStencilFunc` limits only the comparison; only
# `glStencilMask` limits what is written. Predict the value that a quad writes with the reference 7 and the mask 1:

# %%
my_value = ...


# %%
def replace_by_7(gl):
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, 7, 1)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    gl.glRectf(-1, -1, 1, 1)


written = testing.run_here(replace_by_7, (4, 4)).stencil
lessons.compare_prediction(
    "Which value is written by GL_REPLACE with glStencilFunc(GL_ALWAYS, 7, 1)?",
    my_value,
    int(written[0, 0]),
    "All bits of the reference are written; E42 in the list of corrections.",
)

# %% [markdown]
# ## The quiz of the slides
#
# *What is glStencilFunc for?* (Barcelona, lines 667-674.) Answer (a) is right: it decides which fragments pass. Answer
# (d), that it determines the values to write, is crossed out on the slide in favour of `glStencilOp`. It is not quite
# wrong: `GL_REPLACE` writes the reference of `glStencilFunc`, as you have just seen (E44). Answer (a) can be
# demonstrated: with `GL_NEVER` no fragment passes, whatever the operations are.


# %%
def drawn_under(func):
    def program(gl):
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(func(gl), 1, 255)
        gl.glRectf(-1, -1, 1, 1)

    return int(testing.run_here(program, (4, 4)).color[..., 0].astype(bool).sum())


for name in ("GL_ALWAYS", "GL_NEVER", "GL_EQUAL", "GL_GREATER"):
    print(
        f"{name:10}",
        drawn_under(lambda gl, name=name: getattr(gl, name)),
        "of 16 pixels are drawn",
    )

# %% [markdown]
# ## What goes wrong, and its cure
#
# If the stencil test is not enabled, the stencil buffer is neither tested nor written, and no error is reported. This
# is what the Bucharest slides forget before they count (E1).

# %%
failure = ss.failures["stencil-test-forgotten"]
display(failure)
print(failure.explain())

# %% [markdown]
# `glClear` obeys the write mask, but not the test (Barcelona, lines 224-226). The listing `stencil-setup`
# shows both: a clear to 255 under `GL_NEVER` changes all bits, a clear to 0 under `glStencilMask(0x0F)` only four.

# %%
lessons.code_beside_slide("stencil-setup")

# %%
print(
    np.unique(testing.run_here(listings.get("stencil-setup").corrected, (8, 8)).stencil)
)

# %% [markdown]
# The write mask is all ones unless a program changes it. The Bucharest slides say that writing is off at first (lines
# 181, 204, 308): it is only the *test* that is off, and `glStencilFunc` does not switch anything on.
#
# ## Exercise
#
# Draw a frame: the large square without the small one in its middle, in one colour. Use the stencil buffer. Write the
# calls into `program`; the check compares its colours with the solution's.


# %%
def program(gl):
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    # 1. mark the pixels of the small square, without colour:
    #    glRectf(-0.4, -0.4, 0.4, 0.4)

    # 2. draw the large square where there is no mark
    gl.glRectf(-0.8, -0.8, 0.8, 0.8)


# %% tags=["hide-input"]
def solution(gl):
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, 1, 255)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    gl.glColorMask(False, False, False, False)
    gl.glRectf(-0.4, -0.4, 0.4, 0.4)
    gl.glColorMask(True, True, True, True)
    gl.glStencilFunc(gl.GL_EQUAL, 0, 255)
    gl.glRectf(-0.8, -0.8, 0.8, 0.8)


# %%
lessons.check_program(program, solution)

# %% [markdown]
# ## Sources
#
# OpenGL 2.1 specification, sections 4.1.5 (stencil test) and 4.2.5 (clears and masks). Slides: CA:185-290, CA:667-674,
# RO1:144-150. Corrections: E1, E42, E43, E44, E57, E61.
