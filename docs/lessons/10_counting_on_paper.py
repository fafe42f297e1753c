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
# # 10. Counting on paper
#
# **Goal.** You can count shadow volumes along a line of sight with a pencil, before any stencil buffer does it for you.
#
# **Slides.** Bratislava (Zimányi & Valient 2004), lines 211-268. Bucharest (Moldoveanu 2021), lines 93-126.
#
# In two dimensions a caster is a segment. Its volume is the region behind it, bounded by the segment and two rays. Draw
# a line from the eye to a point. Where it enters a volume, write +1, and where it leaves one, −1. If the eye is in no
# volume, the sum is the number of volumes around the point. The point is in shadow if the sum is not 0.

# %%
import warnings

from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)
scene, size = ss.Scene.named("overlapping"), (320, 240)
run = ss.run("volume-zpass", scene, size=size)

# %% [markdown]
# ## A cut through the scene
#
# A plane through the eye, the light and the point of one pixel cuts casters and volumes into such a drawing. The
# numbers on the line are the counts.

# %%
card = ss.counting_cards(run, 1, seed=3).cards[0]
x, y = card.x, card.y
ax = ss.notebook.show_section(run, (x, y))

# %% [markdown]
# ## The slide and the program
#
# The Bratislava slides call it an in-out counter. As printed, a point is in shadow if the counter is ≥ 0, which is
# always true (E20):

# %%
lessons.code_beside_slide("volume-counter", step=2)

# %% [markdown]
# ## The buffers after each step

# %%
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Click a pixel

# %%
lessons.clickable(run)

# %% [markdown]
# ## Predict, then run
#
# Count in the cut above: what is the sum at the point?

# %%
my_sum = ...

# %%
print(run.explain(x, y))
lessons.compare_prediction("What is the sum?", my_sum, int(run.stencil[y, x]))

# %% [markdown]
# `softshadow cards volume-zpass --scene overlapping -n 6` prints six such pixels with empty fields, and the answers on
# the back.
#
# ## The start of the count
#
# If the eye is inside a volume, the sum is too small by the number of volumes around the eye. So the Bucharest slides
# start the counter with this number. A count in the stencil buffer begins at the *near plane* instead: see lesson 12.
#
# ## What goes wrong, and its cure

# %%
for name in ("counter-at-least-0", "eye-in-shadow"):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# ## Exercise
#
# Write the rule in one dimension: volumes are intervals `(start, end)` on the line of sight, the eye is at 0. Count the
# faces between the eye and the point, +1 for a start, −1 for an end; then add the number of volumes around the eye.


# %%
def volumes_around(point, volumes):
    return ...


# %%
volumes = [(1, 4), (2, 3), (-1, 2.5), (6, 9)]
cases = [
    ((0.5, volumes), 1),
    ((1.5, volumes), 2),
    ((2.2, volumes), 3),
    ((3.5, volumes), 1),
    ((5, volumes), 0),
    ((7, volumes), 1),
]
lessons.check_function(volumes_around, cases)

# %% [markdown]
# ## Sources
#
# Crow 1977, "Shadow algorithms for computer graphics". Slides: SK:211-268, RO1:93-126. Corrections: E9, E10, E20.
