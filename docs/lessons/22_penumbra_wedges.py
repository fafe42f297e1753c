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
# # 22. Penumbra wedges
#
# **Goal.** You can follow the technique step by step: a hard shadow from the light's centre, then a correction from
# each silhouette edge inside its wedge.
#
# **Slides.** Bratislava (Zimányi & Valient 2004), lines 427-486.
#
# Every silhouette edge makes a penumbra around the side of the hard shadow volume. The region where it does so is a
# **wedge**: bounded by planes that touch the light and contain the edge. The hard shadow is drawn first. Then each
# wedge is drawn, and every visible point inside it gets the part of the light that this edge covers or uncovers,
# compared with the hard shadow (Assarsson and Akenine-Möller 2003).

# %%
import warnings

import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)
scene, size = ss.Scene.named("soft-slab"), (240, 180)
run = ss.run("volume-wedges", scene, size=size)
truth = ss.soft_truth(scene, size)

# %% [markdown]
# ## The slide and the program
#
# The slides that introduce wedges are missing, and those on their rasterization are empty. The first half is the
# stencil count of the lessons before:

# %%
lessons.code_beside_slide("volume-zpass", step=1)

# %% [markdown]
# ## The buffers after each step

# %%
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Click a pixel

# %%
lessons.clickable(run)

# %% [markdown]
# ## What each wedge adds at a pixel

# %%
penumbra = truth.valid & (truth.visibility > 0.2) & (truth.visibility < 0.8)
y, x = (int(n) for n in np.argwhere(penumbra)[penumbra.sum() // 2])
print(run.contributions(x, y))

# %% [markdown]
# ## Predict, then run
#
# A flat caster that is parallel to the light: how large is the largest error of the wedges against the exact visible
# area?

# %%
my_error = ...  # 0, 0.1 or 0.5

# %%
compared = run.compare(truth=truth)
print(compared)
lessons.compare_prediction(
    "How large is the largest error?",
    my_error,
    round(float(compared.parts["all"].max), 2),
    "One flat caster has no edges that hide each other, so the sum over its edges is "
    "the area itself.",
    within=0.01,
)

# %% [markdown]
# ## What goes wrong, and its cure
#
# What two casters hide is added, even where both hide the same part of the light. And one silhouette, that of the
# centre, stands for all of the light.

# %%
for name in ("wedge-overlap", "centre-silhouette", "wedges-by-depth"):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# The wedge of an edge whose ends are at very different distances is needlessly large, and costs fragments (the slides'
# last point): the ledger has the number.

# %%
run.ledger

# %% [markdown]
# ## Exercise
#
# In two dimensions the light is the interval [−1, 1], and a caster covers everything to the left of the image e of its
# edge. The hard shadow of the centre says 0 (shadow) if e > 0, else 1. Write the correction that the edge's wedge adds
# to get the visible share of the light.


# %%
def correction(e):
    return ...


# %%
cases = [((-1.0,), 0.0), ((0.5,), 0.25), ((-0.5,), -0.25), ((1.0,), 0.0), ((0.9,), 0.05)]
lessons.check_function(correction, cases, within=1e-12)

# %% [markdown]
# ## Sources
#
# Assarsson and Akenine-Möller 2003, "A geometry-based soft shadow volume algorithm using graphics hardware". Slides:
# SK:427-486. Corrections: E28, E29.
