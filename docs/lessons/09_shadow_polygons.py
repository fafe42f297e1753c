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
# # 9. Shadow polygons
#
# **Goal.** You know how shadows are computed in the scene itself, not in the picture: once, for all cameras.
#
# **Slides.** Bucharest (Moldoveanu 2021), lines 32-71.
#
# A face that looks away from the light is in its **own shadow** as a whole: the face itself is the shadow polygon. A
# face that looks towards the light projects a polygon onto other faces: their **cast shadow**. It is clipped to the
# face that it falls on, and drawn there as a detail (Atherton, Weiler and Greenberg 1978).

# %%
import warnings

from IPython.display import display

import softshadow as ss
from softshadow import lessons
from softshadow.techniques.detail_polygons import shadow_polygons

warnings.simplefilter("ignore", ss.Warning)
scene, size = ss.Scene.named("boxes"), (320, 240)

# %% [markdown]
# ## The slide and the program
#
# The slides project all polygons onto the scene and draw them with the depth test off (E15, E16).

# %%
lessons.code_beside_slide("planar-polygons", step=1)

# %% [markdown]
# ## The buffers after each step

# %%
run = ss.run("shadow-polygons", scene, size=size)
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Click a pixel

# %%
lessons.clickable(run)

# %% [markdown]
# ## Predict, then run
#
# Three boxes on a floor, one light. How many faces (triangles) of a box are in their own shadow, if the light sees
# three of its six sides?

# %%
my_faces = ...

# %%
found = shadow_polygons(scene, scene.lights[0])
for thing, polygons in zip(scene.objects, found, strict=True):
    print(
        f"{thing.name:8} {len(polygons.own):3} faces in their own shadow, "
        f"{len(polygons.cast):3} cast on it"
    )
own = [
    len(polygons.own)
    for thing, polygons in zip(scene.objects, found, strict=True)
    if thing.casts
]
lessons.compare_prediction(
    "How many triangles of a box are in their own shadow?",
    my_faces,
    own[0],
    "Two for each side that looks away.",
)

# %% [markdown]
# ## Silhouettes instead of faces
#
# Flattened faces overlap. If the outline of each object is flattened instead (Bucharest, line 70), every point of the
# shadow is covered once.

# %%
for form in ("faces", "silhouettes"):
    drawn = ss.run("shadow-polygons", scene, size=size, form=form)
    print(
        f"{form:12} {drawn.ledger.total.triangles:5} triangles, "
        f"{int(drawn.shadow_mask.sum())} pixels in shadow"
    )

# %% [markdown]
# ## Independent of the camera
#
# The polygons are computed in world space. Another camera draws the same ones, and its shadows are right as well:

# %%
elsewhere = ss.Scene(
    "from above", ss.Camera((0.5, 7, 1), (0, 0, 0)), scene.lights, scene.objects
)
print(ss.run("shadow-polygons", elsewhere, size=size).compare(truth="hard"))

# %% [markdown]
# ## What goes wrong, and its cure

# %%
for name in ("painting-over-nearer", "modulative-lights"):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# Large scenes are not drawn like this, because every face is compared with every other one.
#
# ## Exercise
#
# In which kind of shadow is a point? `facing`: its face looks towards the light; `blocked`: another surface lies
# between.


# %%
def kind_of_shadow(facing, blocked):
    return ...  # "lit", "own" or "cast"


# %%
cases = [
    ((True, False), "lit"),
    ((True, True), "cast"),
    ((False, False), "own"),
    ((False, True), "own"),
]
lessons.check_function(kind_of_shadow, cases)

# %% [markdown]
# ## Sources
#
# Atherton, Weiler and Greenberg 1978, "Polygon shadow generation". Slides: RO1:32-71. Corrections: E15, E16.
