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
# # 4. Polygon offset, z-fighting and the depth range
#
# **Goal.** You can say which of two surfaces in one plane is seen, and decide it with `glPolygonOffset` or
# `glDepthRange`.
#
# **Slides.** Barcelona (Andújar 2021), lines 100-145, and the quizzes in lines 648-665 and 690-703.
#
# Two polygons in one plane have equal depths only in theory. Their vertices differ, so their depths are rounded
# differently. At one pixel the first polygon is nearer, at the next pixel the second: **z-fighting**.
# `glPolygonOffset(factor, units)` adds a small number to the depth of each fragment of a polygon:
#
#     offset = factor · m + units · r
#
# m is the larger of |∂z/∂x| and |∂z/∂y|, and r the smallest difference that is certain to give two different values in
# the depth buffer. A positive offset moves the polygon away from the eye.

# %%
from IPython.display import display

import softshadow as ss
from softshadow import lessons, listings, testing

# %% [markdown]
# ## The slide and the program
#
# The Barcelona slides print the formula twice, with units divided by r and with units multiplied by r (E30), and
# without absolute values (E31). The listing `offset-formula` applies it by hand, to a quad whose depth falls towards
# the right and to one whose depth rises:

# %%
lessons.code_beside_slide("offset-formula", step=0)

# %% [markdown]
# ## The buffers after each step

# %%
run = lessons.run_listing("offset-quiz")
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Click a pixel
#
# The history has z *before* the offset and after it.

# %%
lessons.clickable(run)

# %% [markdown]
# ## Predict, then run
#
# The first quiz of the slides: A is drawn without an offset, then B, which coincides with a part of A, with
# `glPolygonOffset(1, 1)` and `GL_LEQUAL`. Which one is seen where both are?

# %%
my_winner = ...  # "A" or "B"

# %%
y, x = 64, 32
red, green = (int(channel) for channel in run.image[y, x, :2])
lessons.compare_prediction(
    "Which one is seen?",
    my_winner,
    "A" if red > green else "B",
    "B is moved away from the eye, so it fails the depth test where A is.",
)

# %% [markdown]
# ## The size of a unit
#
# On this rasterizer, as on Mesa, r is 2/(2²⁴ − 1) for a depth buffer of 24 bits: two steps (E32).
# Draw a square that faces the eye (m = 0) and read the depth buffer:


# %%
def depth_with(factor, units):
    def program(gl):
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(factor, units)
        gl.glRectf(-1, -1, 1, 1)

    return int(testing.run_here(program, (4, 4)).depth[0, 0])


for units in (0, 1, 2, 10):
    print(
        f"units {units:2}: {depth_with(0, units) - depth_with(0, 0):3} steps of the "
        "depth buffer"
    )

# %% [markdown]
# ## The second quiz: a skeleton seen through its skin
#
# A skeleton inside a closed skin must always be visible (Barcelona, lines 690-703). The slides offer
# four calls and reject all of them; then they split the depth range: the skeleton gets 0 to 0.5, the skin 0.5 to 1, so
# every depth of the skeleton is nearer.


# %%
def skeleton_pixels(program):
    picture = testing.run_here(program, (128, 128)).color
    return int((picture[..., :3].min(axis=-1) > 100).sum())


for name in listings.names():
    if name.startswith("skeleton"):
        listing = listings.get(name)
        print(
            f"{listing.title:42} {skeleton_pixels(listing.printed):4} pixels of the "
            "skeleton"
        )
last = listings.get("skeleton-depth-test").corrected
print(
    f"{'option a, the skeleton drawn last (E45)':42} {skeleton_pixels(last):4} pixels "
    "of the skeleton"
)

# %% [markdown]
# Option (a), the depth test off, fails only because the skin is drawn *last*. If the skeleton is drawn last with the
# depth test off, it is visible as well (E45), but its own faces are not sorted: parts of its back show through its
# front.
#
# ## What goes wrong, and its cure

# %%
for name in ("z-fighting", "offset-too-large"):
    failure = ss.failures[name]
    display(failure)
    print(failure.reason)

# %% [markdown]
# ## Exercise
#
# Write the offset for a plane whose depth changes by `dz_dx` and `dz_dy` from pixel to pixel.


# %%
def offset(dz_dx, dz_dy, factor, units, r=2 / (2**24 - 1)):
    return ...


# %%
cases = [
    ((0.001, 0.0, 1, 0), 0.001),
    ((-0.003, 0.001, 1, 0), 0.003),
    ((0.0, 0.0, 1, 4), 8 / (2**24 - 1)),
    ((0.001, -0.002, -1, -1), -0.002 - 2 / (2**24 - 1)),
]
lessons.check_function(offset, cases, within=1e-12)

# %% [markdown]
# ## Sources
#
# OpenGL 2.1 specification, sections 3.5.5 (polygon offset) and 2.11.1 (depth range). Slides: CA:100-145, CA:648-665,
# CA:690-703. Corrections: E30, E31, E32, E45.
