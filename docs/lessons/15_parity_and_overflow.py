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
# # 15. Parity and overflow
#
# **Goal.** You know what a counter of n bits can tell apart, when one bit is enough, and which order of operations
# keeps a saturating counter right.
#
# **Slides.** Barcelona (Andújar 2021), lines 398-492. Bucharest (Moldoveanu 2021), lines 195-236. Bratislava (Zimányi &
# Valient 2004), lines 261-268.
#
# The stencil buffer has eight bits, so two counts that differ by 256 look the same. With one bit, only even and odd can
# be told apart. And `GL_INCR` and `GL_DECR` do not wrap around: they stop at 255 and at
# 0, so the order matters.

# %%
import warnings

from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)  # they are printed below
size = (320, 240)
overlapping = ss.Scene.named("overlapping")

# %% [markdown]
# ## The slide and the program
#
# As printed, step 3 of the Barcelona listing draws dark where `stencil & 1` is 1, and step 4 draws lit where it is 0.

# %%
lessons.code_beside_slide("volume-five-passes", step=3)

# %% [markdown]
# ## Predict, then run
#
# Two casters stand behind each other, seen from the light. What is the count on the floor where both shadows overlap,
# and what does its lowest bit say?

# %%
my_count, my_bit = ..., ...

# %%
run = ss.run("volume-zpass", overlapping, size=size)
largest = int(run.stencil[run.valid].max())
display(
    lessons.compare_prediction(
        "The largest count?",
        my_count,
        largest,
        "One for each volume that contains the point.",
    ),
    lessons.compare_prediction(
        "Its lowest bit?", my_bit, largest & 1, "0, as if the point were in no volume."
    ),
)

# %% [markdown]
# ## The buffers after each step

# %%
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Click a pixel
#
# The technique `volume-parity` inverts one bit (`GL_INVERT`) at each face, in one pass, without culling. Find a pixel
# where it is wrong.

# %%
parity = ss.run("volume-parity", overlapping, size=size)
lessons.clickable(parity)

# %%
for warning in parity.warnings:
    print(f"{type(warning).__name__}: {warning}")

# %% [markdown]
# For one closed caster whose volume does not overlap itself, parity is exactly right: a line of sight enters and leaves
# it in turn. This holds for every convex caster.

# %%
one = ss.Scene(
    "one box",
    overlapping.camera,
    overlapping.lights,
    [overlapping.objects[0], overlapping.casters[0]],
)
compared = ss.run("volume-parity", one, size=size).compare(truth="hard")
print(
    int((compared.error > 0)[~compared.band].sum()),
    "pixels are wrong off the edges of shadows",
)

# %% [markdown]
# ## What goes wrong, and its cure
#
# `GL_DECR` stops at 0. If a back face is counted before the front face, the decrement is lost, and the increment that
# follows leaves a count that is too large by 1 (E11). With wrapping operations the order does not matter.

# %%
for name in ("decr-before-incr", "overflow-256", "parity-overlap"):
    failure = ss.failures[name]
    display(failure)
    print(
        failure.reason,
        f"{failure.number_wrong} pixels are wrong, with the cure {failure.number_cured}.",
    )

# %% [markdown]
# 256 volumes around a point count as none in eight bits. No operation helps; the cure is to count them in groups, or to
# merge casters.
#
# ## Exercise
#
# Write the two counters for a sequence of +1 and −1 steps: one that wraps around at `2**bits`, and one that saturates.


# %%
def wrapping(steps, bits):
    return ...


def saturating(steps, bits):
    return ...


# %%
up_first, down_first = [+1, +1, -1], [-1, +1, +1]
display(
    lessons.check_function(
        wrapping,
        [
            ((up_first, 8), 1),
            ((down_first, 8), 1),
            (([+1] * 256, 8), 0),
            (([-1], 8), 255),
        ],
    )
)
lessons.check_function(
    saturating,
    [((up_first, 8), 1), ((down_first, 8), 2), (([+1] * 256, 8), 255), (([-1], 8), 0)],
)

# %% [markdown]
# ## Sources
#
# OpenGL 2.1 specification, section 4.1.5. Slides: CA:398-492, RO1:195-236, SK:261-268. Corrections: E9, E11, E20, E38.
