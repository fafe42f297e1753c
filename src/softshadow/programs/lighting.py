"""Fixed-function lighting, per vertex: GL's equation in the order of Mesa's vertex program.

References: GL 2.1 sec. 2.14.1; ffvertex_prog.c, light.c of Mesa 22.3. One of Mesa's habits is kept because it changes
bits: lights that are all directional are carried into object space when the modelview matrix only rotates and
translates.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from softshadow import tokens as gl
from softshadow.programs import VertexInputs
from softshadow.programs.approximations import powers
from softshadow.programs.inverse import inverse, is_length_preserving
from softshadow.programs.texture_coordinates import dot, normalized_rows, reciprocal_root, transform
from softshadow.state import Light, Lighting, Material

ZERO, ONE = np.float32(0.0), np.float32(1.0)
TOWARDS_EYE = np.array([0.0, 0.0, 1.0], np.float32)
LARGEST_SHININESS = np.float32(128.0)
SMALLEST_SCALE = np.float32(1e-12)

COLOR_MATERIAL = {
    gl.GL_AMBIENT: ("ambient",),
    gl.GL_DIFFUSE: ("diffuse",),
    gl.GL_SPECULAR: ("specular",),
    gl.GL_EMISSION: ("emission",),
    gl.GL_AMBIENT_AND_DIFFUSE: ("ambient", "diffuse"),
}


@dataclass(frozen=True)
class Colors:
    """primary (V, 4) and, where the specular part is kept apart, secondary (V, 3); clamped to [0, 1]."""

    primary: np.ndarray
    secondary: np.ndarray | None


@dataclass(frozen=True)
class LightAtVertices:
    """One light seen from the vertices, in the space of the normals.

    direction (V, 3) or (3,) towards the light, half the same halfway to the eye, attenuation (V,) or None for 1.
    """

    light: Light
    direction: np.ndarray
    half: np.ndarray
    attenuation: np.ndarray | None


def power(x: np.ndarray, exponents: np.ndarray) -> np.ndarray:
    raised = np.empty_like(x)
    powers(x, exponents, raised)
    return raised


def vector(values: tuple[float, ...]) -> np.ndarray:
    return np.array(values, np.float32)


def normalized(v: np.ndarray) -> np.ndarray:
    """Return one vector (3,) of unit length, as Mesa's C code makes it; 0 stays 0."""
    squared = (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]
    return v * (ONE / np.sqrt(squared)) if squared else v


def enabled_lights(lighting: Lighting) -> list[Light]:
    return [light for light in lighting.lights if light.enabled]


def needs_eye_position(lighting: Lighting) -> bool:
    """Return whether lighting computes the eye position of the vertices."""
    lights = enabled_lights(lighting)
    return any(light.position[3] != 0 for light in lights) or (
        bool(lights) and lighting.local_viewer and has_highlights(lighting)
    )


def has_highlights(lighting: Lighting) -> bool:
    """Return whether a shininess other than 0 is in use."""
    return lighting.front.shininess != 0 or (lighting.two_side and lighting.back.shininess != 0)


def in_object_space(lighting: Lighting, length_preserving: bool) -> bool:
    """Return whether Mesa lights in object space as far as lighting goes: directional lights, infinite viewer."""
    lights = enabled_lights(lighting)
    return (
        not lighting.local_viewer
        and lighting.color_control != gl.GL_SEPARATE_SPECULAR_COLOR
        and all(light.position[3] == 0 and light.spot_cutoff == 180 for light in lights)
        and length_preserving
    )


def light_vertices(
    lighting: Lighting, vertices: VertexInputs, in_eye_space: bool = False
) -> tuple[Colors, Colors | None]:
    """Return the colours of the vertices, and those of their back side under GL_LIGHT_MODEL_TWO_SIDE.

    Parameters
    ----------
    in_eye_space : bool          whether a texture unit generates coordinates in eye space: then lighting is there too
    """
    modelview = np.asarray(vertices.modelview, np.float32)
    length_preserving = is_length_preserving(modelview, vertices.modelview_kind)
    object_space = not in_eye_space and in_object_space(lighting, length_preserving)
    with np.errstate(all="ignore"):
        to_object = inverse(modelview, vertices.modelview_kind)
        normal = transformed_normals(lighting, vertices.normal, to_object, object_space, length_preserving)
        eye = transform(modelview, vertices.position)[:, :3] if needs_eye_position(lighting) else None
        lights = [
            at_vertices(light, lighting, eye, modelview, to_object, object_space) for light in enabled_lights(lighting)
        ]
        front = shade_side(lighting, lighting.front, "front", vertices, normal, lights)
        back = shade_side(lighting, lighting.back, "back", vertices, -normal, lights) if lighting.two_side else None
    return front, back


def eye_normals(lighting: Lighting, vertices: VertexInputs) -> np.ndarray:
    """Return the normals (V, 3) of the vertices in eye space, normalised or rescaled."""
    modelview = np.asarray(vertices.modelview, np.float32)
    with np.errstate(all="ignore"):
        to_object = inverse(modelview, vertices.modelview_kind)
        length_preserving = is_length_preserving(modelview, vertices.modelview_kind)
        return transformed_normals(lighting, vertices.normal, to_object, False, length_preserving)


def transformed_normals(
    lighting: Lighting, normal: np.ndarray, to_object: np.ndarray, object_space: bool, length_preserving: bool
) -> np.ndarray:
    """Return the normals (V, 3) in the space of lighting, normalised or rescaled."""
    if not object_space:
        normal = np.stack([dot(normal, to_object[:3, i]) for i in range(3)], axis=1)
    if lighting.normalize:
        return normalized_rows(normal)
    if lighting.rescale_normal and not object_space and not length_preserving:
        row = to_object[2, :3]
        squared = (row[0] * row[0] + row[1] * row[1]) + row[2] * row[2]
        normal = normal * (ONE / np.sqrt(squared if squared >= SMALLEST_SCALE else ONE))
    return normal


def at_vertices(
    light: Light,
    lighting: Lighting,
    eye: np.ndarray | None,
    modelview: np.ndarray,
    to_object: np.ndarray,
    object_space: bool,
) -> LightAtVertices:
    """Return direction, half vector and attenuation of a light at every vertex."""
    position, towards_eye = vector(light.position), TOWARDS_EYE
    if object_space:
        position = transform(to_object, position[np.newaxis])[0]
        towards_eye = modelview[2, :3]
    squared_distance: np.ndarray | None = None
    if light.position[3] == 0:
        direction = normalized(position[:3])
        half = normalized(direction + towards_eye)
    else:
        assert eye is not None
        towards = position[:3] * (ONE / position[3]) - eye
        squared_distance = dot(towards, towards)
        direction = towards * reciprocal_root(squared_distance)[:, np.newaxis]
        half = direction + towards_eye
    if lighting.local_viewer and has_highlights(lighting):
        assert eye is not None
        half = normalized_rows(direction - normalized_rows(eye))
    elif half.ndim == 2:
        half = normalized_rows(half)
    return LightAtVertices(light, direction, half, attenuation(light, direction, squared_distance))


def attenuation(light: Light, direction: np.ndarray, squared_distance: np.ndarray | None) -> np.ndarray | None:
    """Return the spot factor times the distance factor (V,) or (1,); None where both are 1 by their settings."""
    factor: np.ndarray | None = None
    if light.spot_cutoff != 180:
        spot_direction = normalized(normalized(vector(light.spot_direction)))
        cosine = max(ZERO, np.float32(math.cos(np.float32(np.float32(light.spot_cutoff) * math.pi / 180.0))))
        spot = dot(np.atleast_2d(-direction), spot_direction)
        inside = np.where(cosine < spot, ONE, ZERO)
        factor = inside * power(abs(spot), np.full_like(spot, light.spot_exponent))
    coefficients = (light.constant_attenuation, light.linear_attenuation, light.quadratic_attenuation)
    if coefficients != (1.0, 0.0, 0.0) and squared_distance is not None:
        constant, linear, quadratic = vector(coefficients)
        distance = np.sqrt(squared_distance)
        one = reciprocal_root(squared_distance) * distance  # but for rounding: Mesa's first component is made so
        by_distance = ONE / ((quadratic * squared_distance + linear * distance) + constant * one)
        factor = by_distance if factor is None else by_distance * factor
    return factor


def shade_side(
    lighting: Lighting,
    material: Material,
    side: str,
    vertices: VertexInputs,
    normal: np.ndarray,
    lights: list[LightAtVertices],
) -> Colors:
    """Return the colours of one side: emission and ambient, then each light's ambient, diffuse and specular part."""
    tracked: tuple[str, ...] = ()
    sides = gl.GL_FRONT_AND_BACK, gl.GL_FRONT if side == "front" else gl.GL_BACK
    if lighting.color_material and lighting.color_material_face in sides:
        tracked = COLOR_MATERIAL[lighting.color_material_mode]

    def reflectance(name: str) -> np.ndarray:
        if name in tracked:
            return vertices.color
        given = vertices.materials.get(f"{side}.{name}")
        return vector(getattr(material, name))[np.newaxis] if given is None else np.asarray(given, np.float32)

    count = len(vertices.position)
    shininess = np.broadcast_to(vertices.materials.get(f"{side}.shininess", np.float32(material.shininess)), count)
    scene = vector(lighting.model_ambient)[:3] * reflectance("ambient")[:, :3] + reflectance("emission")[:, :3]
    rgb = np.broadcast_to(scene, (count, 3))
    separate = lighting.color_control == gl.GL_SEPARATE_SPECULAR_COLOR
    highlight = np.zeros((count, 3), np.float32)
    for source in lights:
        diffuse, specular = lit_factors(lighting, shininess, normal, source)
        factor = source.attenuation
        ambient_part = vector(source.light.ambient)[:3] * reflectance("ambient")[:, :3]
        if factor is not None:
            diffuse, specular = diffuse * factor, specular * factor
            ambient_part = factor[:, np.newaxis] * ambient_part
        rgb = ambient_part + rgb
        rgb = diffuse[:, np.newaxis] * (vector(source.light.diffuse)[:3] * reflectance("diffuse")[:, :3]) + rgb
        shine = specular[:, np.newaxis] * (vector(source.light.specular)[:3] * reflectance("specular")[:, :3])
        if separate:
            highlight = shine + highlight
        else:
            rgb = shine + rgb
    primary = np.empty((count, 4), np.float32)
    primary[:, :3] = rgb
    primary[:, 3] = reflectance("diffuse")[:, 3]
    return Colors(clamped(primary), clamped(highlight) if separate else None)


def lit_factors(
    lighting: Lighting, shininess: np.ndarray, normal: np.ndarray, source: LightAtVertices
) -> tuple[np.ndarray, np.ndarray]:
    """Return the diffuse and the specular factor (V,) before attenuation."""
    towards_light = dot(normal, source.direction)
    diffuse = np.fmax(towards_light, ZERO)
    shininess = np.asarray(shininess, diffuse.dtype)
    if has_highlights(lighting):
        towards_half = dot(normal, source.half)
    elif source.attenuation is None:
        return diffuse, np.where(towards_light > 0, ONE, ZERO)
    else:
        shininess = towards_half = towards_light  # Mesa's attenuated path reads both from the same register
    raised = power(np.fmax(towards_half, ZERO), np.clip(shininess, -LARGEST_SHININESS, LARGEST_SHININESS))
    return diffuse, np.where(towards_light <= 0, ZERO, raised)


def clamped(colors: np.ndarray) -> np.ndarray:
    """Return colours in [0, 1]; NaN becomes 0."""
    within: np.ndarray = np.fmin(np.fmax(colors, ZERO), ONE)
    return within
