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
# # 11. Shadow volumes, z-pass
#
# **Goal.** You can predict the stencil count at any pixel from the volumes that its line of sight enters and leaves,
# and you know the four steps of the technique and the GL state of each.
#
# **Slides.** Bucharest (Moldoveanu 2021), lines 75-277. Bratislava (Zimányi & Valient 2004), lines 211-286. Barcelona
# (Andújar 2021), lines 398-492.
#
# The points that a caster hides from the light form a solid: the **shadow volume** (Crow 1977). A point is in shadow if
# it lies in at least one volume. Count along the line of sight, from the eye to the visible surface: +1 where the ray
# enters a volume through a front face, −1 where it leaves one through a back face. The sum is the number of volumes
# that contain the surface point, if the eye itself is in none of them.

# %%
import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons

scene = ss.Scene.named("torus")
run = ss.run("volume-zpass", scene, size=(320, 240))

# %% [markdown]
# ## The slide and the program
#
# The Bucharest slides have four steps, *Pasul 1* to *Pasul 4*. Step 1 here is their *Pasul 2*: front faces are counted.

# %%
lessons.code_beside_slide("volume-zpass", step=1)

# %% [markdown]
# Lines with a red and a green edge differ: they are corrections. As printed, the stencil test and culling are never
# enabled before the count (E1), the lit scene is drawn with `GL_LESS` although its depths are equal to the stored ones
# (E2), and it keeps the culling of the count (E3).
#
# ## The buffers after each step

# %%
axes = ss.notebook.show_steps(run)

# %% [markdown]
# In the stencil pictures, 0 is dark, 1 orange, 2 blue. After the front faces, the buffer does not show the shadow yet:
# they are counted wherever they are in front of the visible surface. The back faces take those counts away again where
# the surface lies behind the volume.
#
# ## Click a pixel
#
# Every row of the table is a fragment: which face of which volume, its depth, the stored depth, the result of the test,
# the stencil value before and after.

# %%
lessons.clickable(run)

# %% [markdown]
# ## Predict, then run
#
# Look at the cut through the eye, the light and one pixel in the shadow. How often does the line of sight enter a
# volume before it meets the surface, and how often does it leave one?

# %%
y, x = (int(n) for n in np.argwhere(run.stencil == run.stencil.max())[0])
ax = ss.notebook.show_section(run, (x, y))

# %%
my_entries, my_exits = ..., ...

# %%
rows = [
    row
    for row in run.pixel(x, y)
    if "volume" in str(row.object) and row.stencil_after != row.stencil_before
]
up = sum(row.stencil_after > row.stencil_before for row in rows)
down = len(rows) - up
display(
    lessons.compare_prediction(
        "How many front faces are counted at this pixel?", my_entries, up
    ),
    lessons.compare_prediction(
        "How many back faces?",
        my_exits,
        down,
        f"The difference, {up - down}, is the number of volumes around the point.",
    ),
)
print(run.explain(x, y))

# %% [markdown]
# ## The theorem
#
# For closed volumes and an eye outside all of them, the count equals the number of volumes that contain the point. The
# ray caster counts the same number without volumes, stencil or pixels: it counts the casting faces between the point
# and the light. Both agree at every pixel that is not on the boundary of a shadow.

# %%
truth = ss.testing.cast_truth(scene, (320, 240))
inside = run.valid & ~truth.band()
assert (run.stencil[inside] == truth.counts[0][inside]).all()
print(
    f"{inside.sum()} pixels compared, "
    f"{(run.stencil[inside] != truth.counts[0][inside]).sum()} differ"
)

# %% [markdown]
# The volumes do not depend on the eye, only on light and casters. So they are computed once for many pictures. What
# *does* depend on the eye is the start of the count: see the next lesson (E25).
#
# ## Five passes instead of four
#
# The Barcelona slides first draw the depth alone, then count, then draw the scene dark and lit. The shadows are the
# same. The scene is drawn once more than in the run of this page, whose passes are:

# %%
run.ledger

# %% [markdown]
# ## What goes wrong, and its cure
#
# The Barcelona listing tests only the lowest bit of the count: `glStencilFunc(GL_EQUAL, 0, 1)`. Where two volumes
# overlap, the count is 2, its lowest bit is 0, and the point counts as lit (E38).

# %%
failure = ss.failures["mask-1"]
display(failure)
print(failure.explain())

# %% [markdown]
# The light pass can also fail as a whole: with `GL_LESS` no second surface passes, because its depth is *equal*.

# %%
display(ss.failures["less-in-lit-pass"])

# %% [markdown]
# ## Exercise
#
# Write the counting rule as a function. It gets the faces that a line of sight meets, in any order, as pairs `(depth,
# facing)` with `facing` "front" or "back", and the depth of the visible surface.


# %%
def count(faces, surface):
    return ...


# %%
faces = [
    (0.30, "front"),
    (0.40, "front"),
    (0.55, "back"),
    (0.80, "back"),
    (0.90, "front"),
    (0.95, "back"),
]
expected = {
    0.25: 0,
    0.35: 1,
    0.50: 2,
    0.60: 1,
    0.85: 0,
    0.92: 1,
}  # by the depth of the surface
lessons.check_function(
    count, [((faces, surface), number) for surface, number in expected.items()]
)

# %% [markdown]
# ## Sources
#
# Crow 1977, "Shadow algorithms for computer graphics". Heidmann 1991, "Real shadows, real time". Slides: RO1:75-277,
# SK:211-286, CA:398-492. Corrections: E1, E2, E3, E4, E9, E20, E25, E38, E39, E58.
