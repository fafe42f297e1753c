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
# # 18. Percentage-closer filtering
#
# **Goal.** You know why depths must not be averaged, what is averaged instead, and what a wide filter costs.
#
# **Slides.** Bratislava (Zimányi & Valient 2004), lines 382-401. Barcelona (Andújar 2021), lines 516-519.
#
# The edge of a shadow map's shadow has steps as large as a texel. Colour textures hide their texels by *filtering*: the
# mean of the neighbouring texels. For depths this is wrong: the mean of a near and a far depth is the depth of a
# surface that does not exist. Percentage-closer filtering (Reeves, Salesin and Cook 1987) reverses the order: first
# compare, then take the mean of the results.

# %%
import warnings

import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)
scene, size = ss.Scene.named("boxes"), (320, 240)
run = ss.run("map-pcf", scene, size=size, map_size=128)

# %% [markdown]
# ## The slide and the program
#
# The Barcelona listing asks for `GL_LINEAR` on a texture that is read as plain depth (E46). The corrected program uses
# `GL_NEAREST`, or a texture whose lookup *compares*.

# %%
lessons.code_beside_slide("map", step=0)

# %% [markdown]
# ## The buffers after each step

# %%
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Click a pixel
#
# At the edge, the history lists every tap: its texel, the stored depth, and the result of its comparison.

# %%
lessons.clickable(run)

# %% [markdown]
# ## Predict, then run
#
# A square of 3 × 3 comparisons is averaged, with equal weights. Which values of the visibility are possible?

# %%
my_values = ...  # how many different ones

# %%
square = ss.run("map-pcf", scene, size=size, map_size=128, kernel=3)
values = np.unique(square.visibility[square.valid].round(4))
print(values)
lessons.compare_prediction(
    "How many different values of the visibility are there?",
    my_values,
    len(values),
    "0 to 9 of the nine comparisons can pass.",
)

# %% [markdown]
# ## What the filter does, and what it does not
#
# The edge becomes soft by as many texels as the filter has, everywhere the same: at the foot of a caster as well as far
# behind it. A real penumbra grows with the distance. So PCF hides the texels; it does not make a soft shadow.

# %%
for kernel in (1, 3, 5, 9):
    blurred = ss.run("map-pcf", scene, size=size, map_size=128, kernel=kernel)
    partly = int(
        ((blurred.visibility > 0) & (blurred.visibility < 1))[blurred.valid].sum()
    )
    print(f"{kernel} x {kernel} texels: {partly:5} pixels are partly lit")

# %% [markdown]
# ## What goes wrong, and its cure
#
# The bias theorem of the last lesson is about one texel. A filter compares with texels that are farther away, so its
# slope offset must grow with its width.

# %%
for name in ("jagged-edges", "linear-filtered-depth", "pcf-bias", "constant-width"):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# ## Exercise
#
# Write percentage-closer filtering for one pixel. `stored` is a square array of depths from the map, `own` the depth of
# the point. A point is lit by a texel if it is not farther than what the texel stores.


# %%
def percentage_closer(stored, own):
    return ...


# %%
near_and_far = np.array([[0.2, 0.2, 0.9], [0.2, 0.9, 0.9], [0.9, 0.9, 0.9]])
cases = [
    ((near_and_far, 0.5), 6 / 9),
    ((near_and_far, 0.1), 1.0),
    ((near_and_far, 0.95), 0.0),
    ((near_and_far, 0.9), 6 / 9),
]
lessons.check_function(percentage_closer, cases, within=1e-12)

# %% [markdown]
# Now compare with the mean of the depths: `near_and_far.mean()` is 0.59, so every point between 0.5 and 0.59 would be
# lit completely, and every one behind it not at all.
#
# ## Sources
#
# Reeves, Salesin and Cook 1987, "Rendering antialiased shadows with depth maps". Slides: SK:382-401, CA:516-519.
# Corrections: E46, E49.
