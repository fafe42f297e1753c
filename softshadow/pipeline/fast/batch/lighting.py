"""The state of lighting as numbers; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

The state of each `Lighting` becomes rows of numbers once (`LightingRows`); what a draw adds, its matrices, is in
`place_lights`. The kernels that light vertices are in `light_block`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.programs.lighting import (
    enabled_lights,
    has_highlights,
    in_object_space,
    needs_eye_position,
    normalize,
)
from softshadow.programs.reflectances import followed, vector
from softshadow.state import Lighting, LightState, MaterialState

# columns of a light: colours, position, spot, attenuation
AMBIENT, DIFFUSE, SPECULAR, POSITION, SPOT_DIRECTION, SPOT_EXPONENT, COSINE = 0, 3, 6, 9, 13, 16, 17
CONSTANT, LINEAR, QUADRATIC, HAS_SPOT, HAS_POLYNOMIAL, LIGHT_COLUMNS = 18, 19, 20, 21, 22, 23
NO_SPOT = (0.0,) * 5  # direction, exponent and cosine of a light that shines in all directions
# columns of a material; the last three are the light model's ambient colour
MATERIAL_AMBIENT, MATERIAL_DIFFUSE, MATERIAL_SPECULAR, EMISSION, SHININESS, MODEL_AMBIENT = 0, 4, 8, 12, 16, 17
REFLECTANCES = MODEL_AMBIENT  # columns of a side that vertices may have instead
REFLECTANCE_COLUMNS: dict[str, int | slice] = {
    "ambient": slice(MATERIAL_AMBIENT, MATERIAL_DIFFUSE), "diffuse": slice(MATERIAL_DIFFUSE, MATERIAL_SPECULAR),
    "specular": slice(MATERIAL_SPECULAR, EMISSION), "emission": slice(EMISSION, SHININESS), "shininess": SHININESS,
}  # fmt: skip
# flags of a Lighting
N_LIGHTS, LOCAL_VIEWER, NORMALIZES, RESCALES, HIGHLIGHTS, NEEDS_EYE, OBJECT_SPACE, FOLLOWS_FRONT, FOLLOWS_BACK = range(
    9
)
FOLLOWS_AMBIENT, FOLLOWS_DIFFUSE, FOLLOWS_SPECULAR, FOLLOWS_EMISSION = 1, 2, 4, 8  # bits of the last two flags
FOLLOWS = {
    "ambient": FOLLOWS_AMBIENT, "diffuse": FOLLOWS_DIFFUSE, "specular": FOLLOWS_SPECULAR, "emission": FOLLOWS_EMISSION,
}  # fmt: skip
# columns of a light of a draw: position or direction, half vector
PLACED, HALF_VECTOR, PLACED_COLUMNS = 0, 3, 6


class LightingRows(NamedTuple):
    """A `Lighting` as numbers: lights (N, 23), the enabled ones; materials (2, 20), front and back; flags (9,)."""

    lights: np.ndarray
    materials: np.ndarray
    flags: np.ndarray


def lighting_rows(lighting: Lighting, names: frozenset[str]) -> LightingRows:
    """Return the numbers that kernels read of a `Lighting`; `names` are those of materials that vertices have."""
    enabled = enabled_lights(lighting)
    lights = np.array([_light(light) for light in enabled], np.float32).reshape(-1, LIGHT_COLUMNS)
    materials = np.array([_material(side, lighting) for side in (lighting.front, lighting.back)], np.float32)
    follows = [sum(FOLLOWS[name] for name in followed(lighting, side)) for side in ("front", "back")]
    flags = (
        len(enabled), lighting.local_viewer, lighting.normalize, lighting.rescale_normal,
        has_highlights(lighting, names), needs_eye_position(lighting, names),
        in_object_space(lighting, length_preserving=True), *follows,
    )  # fmt: skip
    return LightingRows(lights, materials, np.array(flags, np.int64))


def _light(light: LightState) -> tuple[float, ...]:
    """Return the columns of a light."""
    colors = *light.ambient[:3], *light.diffuse[:3], *light.specular[:3]
    coefficients = light.constant_attenuation, light.linear_attenuation, light.quadratic_attenuation
    has_polynomial = coefficients != (1.0, 0.0, 0.0) and light.position[3] != 0
    has_spot = light.spot_cutoff != 180
    return *colors, *light.position, *(_spot(light) if has_spot else NO_SPOT), *coefficients, has_spot, has_polynomial


def _spot(light: LightState) -> tuple[float, ...]:
    """Return direction, exponent and the cosine of the cutoff of a spotlight."""
    direction, cutoff = normalize(normalize(vector(light.spot_direction))), np.float32(light.spot_cutoff)
    return (
        *direction.tolist(),
        light.spot_exponent,
        max(ZERO, np.float32(math.cos(np.float32(cutoff * math.pi / 180.0)))),
    )


def _material(material: MaterialState, lighting: Lighting) -> tuple[float, ...]:
    colors = (*material.ambient, *material.diffuse, *material.specular, *material.emission)
    return (*colors, material.shininess, *lighting.model_ambient[:3])


@kernel
def root_of(x):
    """Return 1 / sqrt(x), both rounded."""
    return ONE / np.sqrt(x)


@kernel
def dot3(a, b, c, x, y, z):
    """Return the dot product of two vectors, added from the last component to the first."""
    return (c * z + b * y) + a * x


@kernel
def unit_of(x, y, z):
    """Return a vector normalized as in Mesa's C code; 0 stays 0."""
    squared = (x * x + y * y) + z * z
    if squared == ZERO:
        return x, y, z
    factor = ONE / np.sqrt(squared)
    return x * factor, y * factor, z * factor


@kernel
def positive(x):
    """Return x, or 0 if it is negative or NaN."""
    return x if x > ZERO else ZERO


@inlined
def place_lights(lights, n_lights, modelview, to_object, object_space, placed):
    """Write the position or direction of each light in the space of the normals, and its half vector if it is one."""
    for n in range(n_lights):
        x, y, z, w = lights[n, POSITION], lights[n, POSITION + 1], lights[n, POSITION + 2], lights[n, POSITION + 3]
        eye_x, eye_y, eye_z = ZERO, ZERO, ONE
        if object_space:
            m = to_object
            x, y, z = (
                ((m[0, 0] * x + m[0, 1] * y) + m[0, 2] * z) + m[0, 3] * w,
                ((m[1, 0] * x + m[1, 1] * y) + m[1, 2] * z) + m[1, 3] * w,
                ((m[2, 0] * x + m[2, 1] * y) + m[2, 2] * z) + m[2, 3] * w,
            )
            eye_x, eye_y, eye_z = modelview[2, 0], modelview[2, 1], modelview[2, 2]
        if lights[n, POSITION + 3] == ZERO:
            x, y, z = unit_of(x, y, z)
            half_x, half_y, half_z = unit_of(x + eye_x, y + eye_y, z + eye_z)
            placed[n, HALF_VECTOR], placed[n, HALF_VECTOR + 1], placed[n, HALF_VECTOR + 2] = half_x, half_y, half_z
        else:
            over_w = ONE / w
            x, y, z = x * over_w, y * over_w, z * over_w
        placed[n, PLACED], placed[n, PLACED + 1], placed[n, PLACED + 2] = x, y, z


@kernel
def clamped(value):
    """Return a number of a colour that is not lit in [0, 1]; NaN becomes 0."""
    value = value if value > ZERO else ZERO
    return value if value < ONE else ONE


@kernel
def clamped_lit(value):
    """Return a number of a lit colour in [0, 1]; NaN becomes 1."""
    value = value if value < ONE else ONE
    return value if value > ZERO else ZERO
