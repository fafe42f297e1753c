"""The colours of a lit raster position, in the arithmetic of Mesa's C code, which differs from that of vertices.

References: GL 2.1, sec. 2.14.1 (lighting); rastpos.c of Mesa 22.3, which takes the point in object space for one in
the space of the lights.
"""

from __future__ import annotations

import math

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.programs.inverse import inverse, is_length_preserving
from softshadow.programs.lighting import enabled_lights, in_object_space, normalize, vector
from softshadow.state import Lighting, LightState

F32 = np.float32
SMALLEST_DISTANCE, SMALLEST_ATTENUATION, SMALLEST_HIGHLIGHT = F32(1e-6), F32(1e-3), F32(1e-10)
TOWARDS_EYE = np.array([0, 0, 1], F32)


def raster_colors(
    context: Context, point: np.ndarray, modelview: np.ndarray, kind: int
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return the colour (4) of a raster position at a point (4,) in object space, and the secondary one.

    `kind` is that of the modelview matrix.
    """
    lighting = context.state.lighting
    material, normal = lighting.front, np.array(context.current.normal, F32)
    to_object = inverse(modelview, kind)
    object_space = in_object_space(lighting, is_length_preserving(modelview, kind))
    if not object_space:
        normal = np.array([_dot(normal, to_object[:3, i]) for i in range(3)], F32)
    color = vector(material.emission)[:3] + vector(lighting.model_ambient)[:3] * vector(material.ambient)[:3]
    towards_eye = modelview[2, :3] if object_space else TOWARDS_EYE
    secondary = np.zeros(3, F32)
    for light in enabled_lights(lighting):
        position = vector(light.position)
        position = transformed(to_object, position) if object_space else position
        added, highlight = _contribution(light, position, lighting, point[:3], normal, towards_eye)
        color, secondary = color + added, secondary + highlight
    return _clamped(color, material.diffuse[3]), _clamped(secondary, 1.0)


def _clamped(color: np.ndarray, alpha: float) -> tuple[float, ...]:
    return tuple(float(min(max(channel, F32(0)), F32(1))) for channel in (*color, F32(alpha)))


def transformed(matrix: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Return the product of a matrix (4, 4) and a point (4,), summed from the left."""
    product: np.ndarray = np.add.accumulate(matrix * point, axis=1)[:, 3]
    return product


def _contribution(
    light: LightState,
    position: np.ndarray,
    lighting: Lighting,
    point: np.ndarray,
    normal: np.ndarray,
    towards_eye: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the colour (3,) that a light adds, and the highlight (3,) with GL_SEPARATE_SPECULAR_COLOR."""
    material, nothing = lighting.front, np.zeros(3, F32)
    is_positional = position[3] != 0
    attenuation = F32(1)
    if is_positional:
        direction = position[:3] * (F32(1) / position[3]) - point
        distance = np.sqrt(_dot(direction, direction))
        if distance > SMALLEST_DISTANCE:
            direction = direction * (F32(1) / distance)
        constant, linear, quadratic = vector(
            (light.constant_attenuation, light.linear_attenuation, light.quadratic_attenuation)
        )
        attenuation = F32(1) / (constant + distance * (linear + distance * quadratic))
    else:
        direction = normalize(position[:3])
    if light.spot_cutoff != 180:
        spot = _spot_factor(light, direction, is_positional)
        if spot is None:
            return nothing, nothing
        attenuation = attenuation * spot
    if attenuation < SMALLEST_ATTENUATION:
        return nothing, nothing
    ambient = vector(material.ambient)[:3] * vector(light.ambient)[:3]
    towards_light = _dot(normal, direction)
    if towards_light < 0:
        return attenuation * ambient, nothing
    sum_of_parts = ambient + towards_light * (vector(material.diffuse)[:3] * vector(light.diffuse)[:3])
    if lighting.local_viewer:
        half = normalize(direction - normalize(point))
    else:
        half = normalize(direction + towards_eye)
    towards_half, separate = _dot(normal, half), nothing
    if towards_half > 0:
        highlight = F32(math.pow(towards_half, F32(material.shininess)))
        if highlight > SMALLEST_HIGHLIGHT:
            specular = highlight * (vector(material.specular)[:3] * vector(light.specular)[:3])
            if lighting.color_control == gl.GL_SEPARATE_SPECULAR_COLOR:
                separate = specular
            else:
                sum_of_parts = sum_of_parts + specular
    return attenuation * sum_of_parts, attenuation * separate


def _spot_factor(light: LightState, direction: np.ndarray, is_positional: bool) -> np.float32 | None:
    """Return the factor inside the cone, None outside."""
    cosine = max(F32(0), F32(math.cos(F32(F32(light.spot_cutoff) * math.pi / 180.0))))
    along = -_dot(direction, normalize(normalize(vector(light.spot_direction))))  # twice, as for vertices
    if along < cosine or (not is_positional and along == cosine):
        return None
    return F32(math.pow(along, F32(light.spot_exponent)))


def _dot(a: np.ndarray, b: np.ndarray) -> np.float32:
    product: np.float32 = (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]
    return product
