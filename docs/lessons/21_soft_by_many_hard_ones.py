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
# # 21. Soft shadows by many hard ones
#
# **Goal.** You know how to make a soft shadow from hard shadows of points of the light, how fast its error falls, and
# what it costs.
#
# **Slides.** Bratislava (Zimányi & Valient 2004), lines 42-51, 121-126 and 312-322.
#
# Replace the area light by n points, draw n hard shadows, and take the mean. Every hard technique can be used:
# flattened casters (Heckbert and Herf 1997), volumes (Brotman and Badler 1984), maps. The visibility has n + 1 values,
# so the shadow has n + 1 shades.

# %%
import warnings

import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)
scene, size = ss.Scene.named("soft-slab"), (240, 180)
truth = ss.soft_truth(scene, size)

# %% [markdown]
# ## The slide and the program
#
# The courses have no listing of it. Each point of the light takes one frame of a hard technique, such as the stencil
# count:

# %%
lessons.code_beside_slide("volume-zpass", step=1)

# %% [markdown]
# ## Predict, then run
#
# 4, 16, 64 points: by which factor does the error fall each time? Random points would halve it (the error of a mean of
# n numbers falls with √n).

# %%
my_factor = ...  # "less than 2", "about 2", "more than 2"

# %%
errors = {}
for samples in (4, 16, 64):
    run = ss.run("volume-sampled", scene, size=size, samples=samples)
    errors[samples] = run.compare(truth=truth).parts["penumbra"].rms
    print(f"{samples:3} points: RMS error in the penumbra {errors[samples]:.4f}")
factor = float(np.sqrt(errors[4] / errors[64]))
lessons.compare_prediction(
    "By which factor does the error fall when there are four times as many points?",
    my_factor,
    "less than 2" if factor < 1.8 else "about 2" if factor < 2.2 else "more than 2",
    f"{factor:.2f}. The points are a regular grid here; with pattern='sobol' the error "
    "falls faster.",
)

# %% [markdown]
# ## The buffers after each step

# %%
few = ss.run("volume-sampled", scene, size=size, samples=4)
axes = ss.notebook.show_steps(few)

# %% [markdown]
# ## Click a pixel

# %%
lessons.clickable(few)

# %% [markdown]
# ## Nested planes
#
# Gooch and others (1999) do not move the light but the receiver: hard shadows on several parallel planes are laid over
# each other. It costs as many passes, but the projection changes only by a shift. The width does not follow the size of
# the light: it is a drawing, not a measurement.

# %%
for name, options in (
    ("planar-accumulated", {"samples": 16}),
    ("planar-nested", {}),
    ("volume-sampled", {"samples": 16}),
    ("map-sampled", {"samples": 16}),
):
    compared = ss.run(name, scene, size=size, **options).compare(truth=truth)
    print(
        f"{name:20} RMS {compared.parts['all'].rms:.4f}, in the penumbra "
        f"{compared.parts['penumbra'].rms:.4f}"
    )

# %% [markdown]
# ## What goes wrong, and its cure

# %%
for name in ("banding", "corners-only", "blurred-contact"):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# ## Exercise
#
# Write the mean of hard shadows: `shadows` has one array for each point of the light, with 1 for lit and 0 for shadow.


# %%
def soft(shadows):
    return ...


# %%
one, two = np.array([1, 0, 0]), np.array([1, 1, 0])
lessons.check_function(
    soft,
    [
        (([one, two],), [1, 0.5, 0]),
        (([one],), [1, 0, 0]),
        (([one, two, two, two],), [1, 0.75, 0]),
    ],
)

# %% [markdown]
# ## Sources
#
# Brotman and Badler 1984; Haeberli and Akeley 1990, "The accumulation buffer"; Heckbert and Herf 1997; Gooch and others
# 1999. Slides: SK:42-51, SK:121-126, SK:312-322. Correction: E26.
