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
# # 7. The matrices of projected shadows
#
# **Goal.** You can derive the matrix that flattens a caster onto a plane, and you know which sign makes it work.
#
# **Slides.** Barcelona (Andújar 2021), lines 363-396. Bratislava (Zimányi & Valient 2004), lines 139-161.
#
# The shadow of a point P is where the line from the light L through P meets the plane. Write the plane as π = (a, b, c,
# d), with a·x + b·y + c·z + d = 0, and the light as Λ = (L, 1), or Λ = (D, 0) for a direction D towards the light. A
# point on the line is λΛ + μP; it lies on the plane if λ π·Λ + μ π·P = 0. Choose μ = π·Λ and λ = −π·P:
#
#     S = (π·Λ) I − Λ πᵀ
#
# This is one 4×4 matrix for all lights and planes.

# %%
import warnings

import numpy as np
from IPython.display import display

import softshadow as ss
from softshadow import lessons

warnings.simplefilter("ignore", ss.Warning)


def shadow_matrix(plane, light):
    plane, light = np.asarray(plane, float), np.asarray(light, float)
    return (plane @ light) * np.eye(4) - np.outer(light, plane)


ground = (0, 1, 0, 0)  # y = 0, normal upwards
S = shadow_matrix(ground, (-2, 4, 1.5, 1))
print(S)

# %% [markdown]
# Check it: a point between light and ground is mapped onto the ground, on the line from the light.

# %%
point = np.array([0.5, 1.0, 0.2, 1])
x, y, z, w = S @ point
flattened = np.array([x, y, z]) / w
along = (flattened - (-2, 4, 1.5)) / (point[:3] - (-2, 4, 1.5))
print("on the ground:", flattened, " multiples of the way from the light:", along)
assert abs(flattened[1]) < 1e-12
assert np.allclose(along, along[0])

# %% [markdown]
# ## The slide and the program
#
# The Barcelona slides print the matrix for a light at a point and for a direction. They do not say which way the
# plane's normal has to look (E35), or whether the direction leads to the light or away from it (E36).

# %%
lessons.code_beside_slide("planar-point", step=0)

# %% [markdown]
# ## Predict, then run
#
# The plane can also be written (0, −1, 0, 0): the same points, the opposite normal. The matrix becomes −S. What does GL
# draw?

# %%
my_answer = ...  # "the same shadow", "no shadow"

# %%
w_before, w_after = (
    (S @ point)[3],
    (shadow_matrix((0, -1, 0, 0), (-2, 4, 1.5, 1)) @ point)[3],
)
print(f"w is {w_before:g} with one sign and {w_after:g} with the other")
failure = ss.failures["wrong-matrix-sign"]
display(failure)
lessons.compare_prediction(
    "What does GL draw with the opposite sign?",
    my_answer,
    "no shadow",
    "Divided by w, both give the same point. But GL clips before it divides, and "
    "everything with w < 0 is outside.",
)

# %% [markdown]
# ## The buffers after each step

# %%
run = ss.run("planar", "boxes", size=(320, 240), method="offset")
axes = ss.notebook.show_steps(run)

# %% [markdown]
# ## Click a pixel

# %%
lessons.clickable(run)

# %% [markdown]
# ## Three regions
#
# What matters is where a caster is on the line from the light to the plane. Between light and plane it casts a proper
# shadow. *Behind the plane* it still has an image: a **false shadow**. *Behind the light* it has one, too, mirrored: an
# **anti-shadow**. GL's clipping removes the last one by itself, because w < 0 there. The second one has w > 0 and needs
# a clip plane at the receiver (E21).
#
# ## What goes wrong, and its cure

# %%
for name in ("anti-shadow", "false-shadow", "cpu-division", "light-direction"):
    failure = ss.failures[name]
    display(failure)
    print(
        failure.reason,
        f"{failure.number_wrong} pixels are wrong, with the cure {failure.number_cured}.",
    )

# %% [markdown]
# The slides of Bratislava divide on the CPU, ray by ray (lines 139-152). Then nothing is clipped, and triangles that
# reach behind the light are drawn inside out: `cpu-division`.
#
# ## Exercise
#
# Write the matrix for a light in the direction `D` (towards the light) and a plane, without the general formula: as the
# slide has it. It must have w > 0 for points that D shines on.


# %%
def directional_matrix(plane, direction):
    return ...


# %%
cases = [
    ((ground, (1, 2, 3)), shadow_matrix(ground, (1, 2, 3, 0))),
    (((0.6, 0.8, 0, -1), (0, 1, 0)), shadow_matrix((0.6, 0.8, 0, -1), (0, 1, 0, 0))),
]
lessons.check_function(directional_matrix, cases, within=1e-12)

# %% [markdown]
# ## Sources
#
# Blinn 1988, "Me and my (fake) shadow". Slides: CA:363-396, SK:139-180. Corrections: E21, E22, E35, E36, E37.
