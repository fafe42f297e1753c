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
# # 14. Silhouettes and open meshes
#
# **Goal.** You can find the edges that bound a caster as the light sees it, and you know which meshes have a shadow
# volume of one piece and which do not.
#
# **Slides.** Bucharest (Moldoveanu 2021), lines 130-138. Bratislava (Zimányi & Valient 2004), lines 230-257.
#
# One volume for every lit triangle works, but most of its faces lie inside the union. For a closed mesh it is enough to
# extrude the **silhouette**: the edges between a face that looks towards the light and one that looks away. Every such
# edge becomes one side of the volume; the lit faces are its cap at the light's end.

# %%
import warnings

import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons
from softshadow.scene import casting_faces

warnings.simplefilter("ignore", ss.Warning)  # they are printed below
torus = ss.Scene.named("torus")
caster, light = torus.casters[0], torus.lights[0]

# %% [markdown]
# ## How much is saved

# %%
size = (320, 240)
for generator in ("silhouette", "per-polygon"):
    run = ss.run("volume-zfail", torus, size=size, generator=generator)
    total = run.ledger.total
    print(
        f"{generator:12} {total.triangles:6} triangles {total.all_fragments:8} fragments"
    )

# %% [markdown]
# Both give the same shadows, although the numbers in the stencil buffer differ between the steps. The program of the
# slides extrudes the silhouette of every occluder:

# %%
lessons.code_beside_slide("volume-zpass", step=1)

# %% [markdown]
# ## The silhouette is not one loop
#
# The slides call it *a connected set of edges* (E12). The torus, seen from most sides, has two loops. Look at it in
# space: the report of a run has a 3-D view.

# %%
run = ss.run("volume-zfail", torus, size=size)
lessons.clickable(run)

# %% [markdown]
# ## The buffers after each step

# %%
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Predict, then run
#
# In a closed mesh every edge belongs to two faces. How many edges do the triangles of the torus have? And roughly how
# many of its faces look towards the light: half of them, nearly all, or few?

# %%
my_edges = ...  # from the number of triangles below
my_share = ...  # "half", "nearly all" or "few"
triangles = len(caster.mesh.triangles)
print(triangles, "triangles")

# %%
position = np.linalg.inv(caster.object_to_world) @ light.position
facing = casting_faces(caster.mesh, position).facing
share = float(np.mean(facing))
display(
    lessons.compare_prediction(
        "How many edges?",
        my_edges,
        3 * triangles // 2,
        "Three for each triangle, each of them shared by two.",
    ),
    lessons.compare_prediction(
        "How many faces look towards the light?",
        my_share,
        "half" if 0.35 < share < 0.65 else "nearly all" if share > 0.5 else "few",
        f"{share:.0%} of them.",
    ),
)

# %% [markdown]
# ## Open meshes
#
# A sheet has edges with only one face. Such an edge is always a silhouette edge. A sheet also blocks the light if the
# light shines on its back. So *all* faces of an open mesh cast shadows: those that look away are turned round, and
# every layer counts once (E13). The tube below has no lids:

# %%
tube = ss.run("volume-zfail", "open-tube", size=size)
for warning in tube.warnings:
    print(f"{type(warning).__name__}: {warning}")
print(tube.compare(truth="hard"))

# %% [markdown]
# ## What goes wrong, and its cure
#
# An edge that is divided on one side only, a *T-junction*, is not one edge for the program, and the volume gets a
# crack. Models from files often have vertices that are stored twice, with two normals: they have to be treated as one.

# %%
for name in ("t-junction-leak", "open-mesh-leak", "open-mesh-parity"):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# ## Exercise
#
# Write the rule: the two faces at an edge look towards the light or not (`True`, `False`), or the second one is missing
# (`None`). Is the edge a silhouette edge?


# %%
def is_silhouette(first, second):
    return ...


# %%
cases = [
    ((True, True), False),
    ((True, False), True),
    ((False, True), True),
    ((False, False), False),
    ((True, None), True),
    ((False, None), True),
]
lessons.check_function(is_silhouette, cases)

# %% [markdown]
# The last case is the one that the slides leave out: the lone face looks away, but an open sheet casts with its back,
# too.
#
# ## Sources
#
# Crow 1977; Everitt and Kilgard 2002. Slides: RO1:130-138, SK:230-257. Corrections: E12, E13.
