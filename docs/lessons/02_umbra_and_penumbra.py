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
# # 2. Umbra and penumbra
#
# **Goal.** You can say how the width of a penumbra changes when light, occluder or receiver move, and check it by
# measuring.
#
# **Slides.** Barcelona (Andújar 2021), lines 37-54 and the quiz in lines 676-686. Bratislava (Zimányi & Valient 2004),
# lines 55-70.
#
# A point of a surface either sees a **point** light or does not: it is lit or in the **umbra**, the full shadow. It may
# see an **area** light in part: then it is in the **penumbra**. Let a light of width s, the edge of an occluder at the
# distance d_b from it, and a receiver at the distance d_r be parallel. Then similar triangles give the width of the
# penumbra:
#
#     w = s · (d_r − d_b) / d_b

# %%
import warnings
from dataclasses import replace

import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)
scene, size = ss.Scene.named("soft-slab"), (320, 240)
truth = ss.soft_truth(scene, size)

# %% [markdown]
# ## The truth
#
# `soft_truth` computes the visible share of the light at every pixel, as an exact area. Umbra, penumbra and lit pixels:

# %%
share = truth.visibility[truth.valid]
print(
    f"umbra {np.mean(share == 0):.1%}, penumbra "
    f"{np.mean((share > 0) & (share < 1)):.1%}, lit {np.mean(share == 1):.1%}"
)
ax = ss.notebook.show_map(truth.visibility, "visibility", title="Visible share")

# %% [markdown]
# ## The slide and the program
#
# No listing of the courses draws soft shadows. Soft techniques start from a program for hard shadows, which has one
# light at one point:

# %%
lessons.code_beside_slide("volume-zpass", step=3)

# %% [markdown]
# The simplest soft technique takes many points of the light, draws a hard shadow for each, and adds them.

# %%
run = ss.run("volume-sampled", scene, size=size, samples=16)
axes = ss.notebook.show_image(run)

# %% [markdown]
# ## Click a pixel

# %%
lessons.clickable(ss.run("volume-wedges", scene, size=(240, 180)))

# %% [markdown]
# ## Predict, then run
#
# The quiz of the slides (lines 676-686): which of these can make the penumbra wider? (a) a larger light, (b) more
# distance between occluder and receiver, (c) the light nearer to the occluder.

# %%
my_answer = ...  # such as "a", "a and b", "a, b and c"


# %%
def penumbra_share(changed):
    seen = ss.soft_truth(changed, size)
    values = seen.visibility[seen.valid]
    return float(np.mean((values > 0) & (values < 1)))


def with_light(scale=1.0, height=1.0):
    light = scene.lights[0]
    shape = replace(
        light.shape,
        edge_u=np.multiply(light.shape.edge_u, scale),
        edge_v=np.multiply(light.shape.edge_v, scale),
    )
    position = light.position * (1, height, 1, 1)
    return replace(scene, lights=(replace(light, shape=shape, position=position),))


before = penumbra_share(scene)
larger, nearer = (
    penumbra_share(with_light(scale=1.5)),
    penumbra_share(with_light(height=0.85)),
)
slab = scene.casters[0]
lift = np.eye(4)
lift[1, 3] = 0.3
raised = tuple(
    replace(each, object_to_world=lift @ each.object_to_world)
    if each.name == slab.name
    else each
    for each in scene.objects
)
apart = penumbra_share(replace(scene, objects=raised))
print(
    f"as it is {before:.3f}, larger light {larger:.3f}, occluder higher {apart:.3f}, "
    f"light nearer {nearer:.3f}"
)
wider = [
    letter
    for letter, now in zip("abc", (larger, apart, nearer), strict=True)
    if now > before
]
lessons.compare_prediction(
    "Which can make the penumbra wider?",
    my_answer,
    " and ".join([", ".join(wider[:-1]), wider[-1]]),
    "All three: each of them makes s larger, or (d_r − d_b)/d_b.",
)

# %% [markdown]
# The slides also let occluder and receiver come closer (line 53), but do not say which of them moves (E54). The formula
# covers every case.
#
# ## The buffers after each step
#
# A point light has no penumbra, whatever technique draws it: a run with one sample is a hard shadow, bit for bit.

# %%
one = ss.run("volume-sampled", scene, size=size, samples=1)
print(sorted(set(np.unique(one.visibility[one.valid]).tolist())))
axes = ss.notebook.show_steps(one)

# %% [markdown]
# ## What goes wrong, and its cure
#
# If there are few samples, bands are visible. And the corners of a light are not the whole light: four samples at the
# corners give five grey levels, and count a point as lit although a part of the light is hidden (E26).

# %%
for name in ("banding", "corners-only"):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# ## Exercise
#
# Write the width of the penumbra. `s` is the width of the light, `d_b` and `d_r` are the distances of occluder and
# receiver from the light.


# %%
def penumbra_width(s, d_b, d_r):
    return ...


# %%
cases = [
    ((1, 2, 4), 1.0),
    ((0, 2, 4), 0.0),
    ((2, 2, 4), 2.0),
    ((1, 1, 4), 3.0),
    ((1, 4, 4), 0.0),
]
lessons.check_function(penumbra_width, cases, within=1e-12)

# %% [markdown]
# ## Sources
#
# Slides: CA:37-54, CA:676-686, SK:42-70. Corrections: E26, E54.
