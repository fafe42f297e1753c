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
# # 3. Shadow maps
#
# Seen from the light there are no shadows. So draw the scene from the light, and keep only the depth buffer. Then
# test every pixel of the camera's picture: is its point farther from the light than the stored depth? (Williams 1978)

# %%
import numpy as np
from IPython.display import display

import softshadow as ss

scene = ss.Scene.named("torus")
run = ss.run("map", scene, size=(320, 240), map_size=256)

# %% [markdown]
# ## Step by step
#
# The first step draws into a texture, so the window stays empty. Its result is the map, with the name *ZS*. The map
# is a picture, too. When a shadow is wrong, look at the map first.

# %%
run

# %%
ZS = run.maps["ZS"]
ax = ss.notebook.show_map(run, "ZS")

# %% [markdown]
# While the map is drawn, `glPolygonOffset` moves everything a little away from the light. Without it, surfaces would
# shadow themselves, as shown below.

# %%
print(run[0].state)

# %% [markdown]
# ## Why is this pixel dark?

# %%
rows, columns = np.nonzero(run.shadow_mask)
middle = len(rows) // 2
x, y = int(columns[middle]), int(rows[middle])
print(run.explain(x, y))
run.pixel(x, y)

# %% [markdown]
# ## Two failures
#
# A texel stores one depth for a patch of a sloping surface, but half of the patch is farther away than this depth.
# Without a bias the surface shadows itself.

# %%
acne = ss.failures["acne"]
display(acne)
print(acne.explain())

# %% [markdown]
# If the bias is too large, the shadow is detached from the foot of its caster.

# %%
panning = ss.failures["peter-panning"]
display(panning)
print(panning.diff)

# %% [markdown]
# ## A property
#
# How much bias is enough? On a plane, the sample of the stored depth is at most half a texel away in each direction,
# so an offset by the larger slope is enough. This is the first argument of `glPolygonOffset`, and 1 is its right
# value. The example is a floor that the light strikes at an angle. Only the floor itself could cast a shadow on it:

# %%
import warnings

warnings.simplefilter("ignore", ss.OpenMesh)  # a floor is an open mesh
floor = ss.Scene(
    "floor alone",
    ss.Camera((2.6, 3.0, 4.8), (0, 0, 0)),
    [ss.Light((1, 0.35, 0.2, 0))],
    [ss.SceneObject(scene.objects[0].mesh, name="floor")],
)
for factor in (0.0, 1.0):
    dark = ss.run("map", floor, size=(320, 240), map_size=64, factor=factor, units=0.0).shadow_mask.sum()
    print(f"factor {factor:g}: {dark} pixels in shadow")
assert dark == 0

# %% [markdown]
# Unlike the stencil count, the map does not depend on the camera. It is drawn once for any number of views.

# %%
elsewhere = ss.Scene("from above", ss.Camera((0.5, 7, 1), (0, 0, 0)), scene.lights, scene.objects)
assert (ss.run("map", elsewhere, size=(320, 240), map_size=256).maps["ZS"] == ZS).all()

# %% [markdown]
# To go on, move the light and the bias with `ss.notebook.play("map", "torus")`, try `map_size`, `bias`, `cull` and the
# other options of `ss.describe("map")`, a light inside the scene (`"room"`), and `run.compare(truth="hard")`, which
# shows where, and at how many pixels, the picture differs from ray casting.
