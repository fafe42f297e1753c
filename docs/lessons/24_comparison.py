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
# # 24. The final comparison
#
# **Goal.** You can choose a technique: by receivers, occluders, lights, passes, and by its error.
#
# **Slides.** Barcelona (Andújar 2021), lines 796-803: the final table, filled in by hand. Bucharest (Moldoveanu 2021),
# lines 359-369. Bratislava (Zimányi & Valient 2004), lines 290-310.
#
# The last slide of the Barcelona course asks four questions of each technique. Here the answers come from running them.

# %%
import warnings

from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)
scene, size = ss.Scene.named("boxes"), (320, 240)
techniques = ("planar", "volume-zpass", "volume-zfail", "map", "map-cube")
runs = {name: ss.run(name, scene, size=size) for name in techniques}

# %% [markdown]
# ## The slide and the program
#
# The technique with the fewest passes in the courses' table is the shadow map: one pass from the light, one from the
# eye.

# %%
lessons.code_beside_slide("map", step=2)

# %% [markdown]
# ## Passes, counted
#
# A pass begins when an object is drawn again, or into another buffer.

# %%
print(f"{'technique':14} {'passes':>6} {'draws':>6} {'triangles':>10} {'fragments':>10}")
for name, run in runs.items():
    total = run.ledger.total
    print(
        f"{name:14} {len(total.passes):6} {total.draws:6} {total.triangles:10} "
        f"{total.all_fragments:10}"
    )

# %% [markdown]
# The slides sum up what speaks for volumes and against them: exact edges, self-shadowing, any scene; but the scene and
# the volumes are drawn several times, most of the work is in fragments that change the stencil buffer only, and the
# edges are hard. Both sides stand in the tables of this lesson: count the fragments above, and the wrong pixels below.
# "All types of lights" means point lights and lights at infinity; "robust" means z-fail with closed casters (E24).
#
# ## Predict, then run
#
# With a second light, what happens to the number of passes of z-fail? The scene without light is drawn once; what is
# drawn again for every light?

# %%
my_passes = ...

# %%
two = ss.run("volume-zfail", "two-lights", size=size)
one_light = ss.Scene(
    "one light", two.scene.camera, two.scene.lights[:1], two.scene.objects
)
one = ss.run("volume-zfail", one_light, size=size)
n_one, n_two = (len(run.ledger.total.passes) for run in (one, two))
print(f"one light: {n_one} passes")
lessons.compare_prediction(
    "How many passes with two lights?",
    my_passes,
    n_two,
    "Front faces, back faces and the lit scene, for each light.",
)

# %% [markdown]
# ## Errors

# %%
for name, run in runs.items():
    compared = run.compare(truth="hard")
    print(
        f"{name:14} {compared.parts['all'].wrong:5} of {compared.parts['all'].pixels} "
        "pixels differ from ray casting"
    )

# %% [markdown]
# Soft shadows, against the exact visible area of the light:

# %%
soft = ss.Scene.named("soft-slab")
truth = ss.soft_truth(soft, size)
for name in (
    "volume-zfail",
    "planar-accumulated",
    "volume-sampled",
    "volume-wedges",
    "map-pcf",
    "map-pcss",
    "map-sampled",
):
    parts = ss.run(name, soft, size=size).compare(truth=truth).parts
    print(
        f"{name:19} RMS {parts['all'].rms:.4f}, in the penumbra "
        f"{parts['penumbra'].rms:.4f}"
    )

# %% [markdown]
# ## The buffers after each step

# %%
axes = ss.notebook.show_steps(runs["map"])

# %% [markdown]
# ## Click a pixel

# %%
lessons.clickable(runs["volume-zfail"])

# %% [markdown]
# ## What goes wrong with each
#
# Planar shadows fall on planes only. Counting needs closed casters and a start. Maps need a frustum, a bias and texels.
# The gallery has a picture of each:

# %%
for name in ("no-self-shadow", "eye-in-shadow", "acne"):
    display(ss.failures[name])

# %% [markdown]
# ## Exercise
#
# Choose a technique of this course for each task: "planar", "volume-zfail", "map" or "map-cube".


# %%
def choose(task):
    return ...


# %%
tasks = {
    "one flat floor, hardly any time": "planar",
    "exact edges, the eye anywhere, closed models": "volume-zfail",
    "leaves with holes in their texture, one lamp outside": "map",
    "the same leaves, the lamp among them": "map-cube",
}
lessons.check_function(choose, [((task,), name) for task, name in tasks.items()])

# %% [markdown]
# ## Sources
#
# Slides: CA:796-803, RO1:359-369, SK:290-310. Corrections: E18, E24. The completed table with all techniques is on the
# page of the techniques, counted from ledgers.
