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
# # 12. The eye in shadow
#
# **Goal.** You know where z-pass starts to count, why that start is not always 0, and why one number for the whole
# picture is not enough.
#
# **Slides.** Bucharest (Moldoveanu 2021), lines 122-126 and 281-289.
#
# Z-pass counts the faces between the eye and the surface. More exactly: between the **near plane** and the surface,
# since nothing in front of the near plane is drawn. If the line of sight begins inside a volume, the face through which
# it enters this volume lies before the beginning. The face is never counted, and every count on this line is one too
# low.

# %%
import warnings

import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)  # they are printed below
scene = ss.Scene.named("eye-in-shadow")
run = ss.run("volume-zpass", scene, size=(320, 240))
run

# %% [markdown]
# The technique does what the slide says, and it warns:

# %%
for warning in run.warnings:
    print(f"{type(warning).__name__}: {warning}")

# %% [markdown]
# ## Predict, then run
#
# The eye stands under a roof, in one volume. On the open floor, a pixel's point is in no volume. What does z-pass write
# there, in a buffer of 8 bits whose operations wrap around?

# %%
my_value = ...

# %%
truth = ss.testing.cast_truth(scene, (320, 240))
lit = run.valid & ~truth.band() & (truth.counts[0] == 0)
values, pixels = np.unique(run.stencil[lit], return_counts=True)
most = int(values[pixels.argmax()])
lessons.compare_prediction(
    "The stencil value of most lit pixels?",
    my_value,
    most,
    "0 - 1 is 255 in eight bits: the line of sight leaves the volume without having "
    "entered it.",
)

# %% [markdown]
# ## The slide and the program: the general case
#
# The slides set the counter to the number of volumes that contain the *eye*. The right start is the number at the point
# where the pixel's line of sight crosses the near rectangle (E10). In the listing the side of a volume cuts this
# rectangle, so no single number is right:

# %%
lessons.code_beside_slide("volume-zpass-general", step=1)

# %% [markdown]
# Compare four starts on a scene where a volume cuts the near rectangle: 0, the number at the eye, a number for each
# pixel, and z-fail, which needs no start.

# %%
cut = ss.Scene.named("near-cut")
for title, name, options in (
    ("start at 0", "volume-zpass", {"start": "none"}),
    ("start at the eye's number", "volume-zpass", {"start": "eye"}),
    ("start at the near plane", "volume-zpass", {"start": "near-plane"}),
    ("z-fail", "volume-zfail", {}),
):
    compared = ss.run(name, cut, size=(320, 240), **options).compare(truth="hard")
    print(f"{title:26} {compared.parts['all'].wrong:6} pixels differ from ray casting")

# %% [markdown]
# ## Click a pixel
#
# With `start="near-plane"` the first step writes the start values: the casters seen from the light, projected onto the
# near rectangle. Click a pixel to see its start.

# %%
lessons.clickable(ss.run("volume-zpass", cut, size=(240, 180), start="near-plane"))

# %% [markdown]
# ## What goes wrong, and its cure

# %%
for name in ("eye-in-shadow", "constant-eye-count"):
    failure = ss.failures[name]
    display(failure)
    print(
        failure.reason,
        f"{failure.number_wrong} pixels are wrong, with the cure {failure.number_cured}.",
    )

# %% [markdown]
# ## Exercise
#
# Write a test that tells whether a scene is too difficult for z-pass with `start="none"`: it returns whether a volume
# touches the near rectangle. Hint: `run.warnings` of a z-pass run has a `NearClipZPass` exactly then.


# %%
def needs_a_start(scene):
    return ...


# %%
expected = {"boxes": False, "torus": False, "eye-in-shadow": True, "near-cut": True}
lessons.check_function(
    needs_a_start,
    [((ss.Scene.named(name),), answer) for name, answer in expected.items()],
)

# %% [markdown]
# ## Sources
#
# Hornus, Hoberock, Lefebvre and Hart 2005, "ZP+: correct Z-pass stencil shadows". Slides: RO1:122-126, RO1:281-289.
# Corrections: E10, E40.
