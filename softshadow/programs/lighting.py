"""Fixed-function lighting, per vertex: GL's equation in the order of Mesa's vertex program.

Like Mesa, it works in object space if all lights are directional and the modelview matrix only rotates and translates,
because that changes the last bits.

References: GL 2.1 sec. 2.14.1; ffvertex_prog.c, light.c of Mesa 22.3.
"""

from __future__ import annotations

import math
from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from softshadow import tokens as gl
from softshadow.programs.inverse import inverse, is_length_preserving
from softshadow.programs.llvmpipe_math import powers
from softshadow.programs.program import VertexInputs
from softshadow.programs.reflectances import Reflectances, followed, varying, vector
from softshadow.programs.stale_registers import GREEN_BLUE, PRODUCTS, UNWRITTEN, LightRegisters, stale_values
from softshadow.programs.texture_coordinates import dot, normalize_rows, reciprocal_root, transform
from softshadow.state import Lighting, LightState

ZERO, ONE = np.float32(0.0), np.float32(1.0)
TOWARDS_EYE = np.array([0.0, 0.0, 1.0], np.float32)
LARGEST_SHININESS = np.float32(128.0)
SMALLEST_SCALE = np.float32(1e-12)


@dataclass(frozen=True)
class Colors:
    """Lit colours in [0, 1]: primary (V, 4), and secondary (V, 3) with GL_SEPARATE_SPECULAR_COLOR."""

    primary: np.ndarray
    secondary: np.ndarray | None


@dataclass(frozen=True)
class LightAtVertices:
    """The vectors and factors of one light at the vertices, in the space of the normals.

    direction (V, 3) or (3,) towards the light, half vector of the same shape, attenuation (V,) or None for 1; parts are
    the factors of the attenuation: "distance", "spot", "inside" (V,).
    """

    light: LightState
    direction: np.ndarray
    half: np.ndarray
    attenuation: np.ndarray | None
    parts: Mapping[str, np.ndarray]


def power(x: np.ndarray, exponents: np.ndarray) -> np.ndarray:
    """Return x to the power of the exponents, as llvmpipe approximates it."""
    result = np.empty_like(x)
    powers(x, exponents, result)
    return result


def normalize(v: np.ndarray) -> np.ndarray:
    """Return a vector (3,) normalized as in Mesa's C code; 0 stays 0."""
    squared = (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]
    return v * (ONE / np.sqrt(squared)) if squared else v


def enabled_lights(lighting: Lighting) -> list[LightState]:
    """Return the lights that are switched on."""
    return [light for light in lighting.lights if light.enabled]


def needs_eye_position(lighting: Lighting, materials: Container[str] = ()) -> bool:
    """Return whether lighting needs the eye-space positions of the vertices; `materials` as for `has_highlights`."""
    lights = enabled_lights(lighting)
    return any(light.position[3] != 0 for light in lights) or (
        bool(lights) and lighting.local_viewer and has_highlights(lighting, materials)
    )


def has_highlights(lighting: Lighting, materials: Container[str] = ()) -> bool:
    """Return whether a material in use has a shininess other than 0, or one that may differ between vertices.

    `materials` are the names of those that the vertices carry ("front.shininess" ...): Mesa does not look at their
    values.
    """
    if lighting.front.shininess != 0 or "front.shininess" in materials:
        return True
    return lighting.two_side and (lighting.back.shininess != 0 or "back.shininess" in materials)


def in_object_space(lighting: Lighting, length_preserving: bool) -> bool:
    """Return whether the lighting state allows object space: directional lights only and an infinite viewer."""
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
    """Return the front colours of the vertices, and the back colours with GL_LIGHT_MODEL_TWO_SIDE.

    Parameters
    ----------
    in_eye_space : bool          whether a texture unit generates coordinates in eye space: then lighting uses it, too
    """
    modelview = np.asarray(vertices.modelview, np.float32)
    length_preserving = is_length_preserving(modelview, vertices.modelview_kind)
    object_space = not in_eye_space and in_object_space(lighting, length_preserving)
    with np.errstate(all="ignore"):
        to_object = inverse(modelview, vertices.modelview_kind)
        normal = transform_normals(lighting, vertices.normal, to_object, object_space, length_preserving)
        # x, y and z are stored apart, here and in the normals, so that loops run over vertices, not over three numbers
        eye = (
            np.asfortranarray(transform(modelview, vertices.position)[:, :3])
            if needs_eye_position(lighting, vertices.materials)
            else None
        )
        highlights = has_highlights(lighting, vertices.materials)
        lights = [
            at_vertices(light, lighting, eye, modelview, to_object, object_space, highlights)
            for light in enabled_lights(lighting)
        ]
        front_side, back_side = (Reflectances(lighting, vertices, side) for side in ("front", "back"))
        front = shade_side(lighting, front_side, vertices, normal, lights, highlights)
        if not lighting.two_side:
            return front, None
        is_single = vertices.color.dtype == np.float32
        is_stale = is_single and has_stale_products(lighting, vertices.materials, vertices.color)
        stale = stale_products(lighting, front_side, back_side, lights, highlights) if is_stale else []
        return front, shade_side(lighting, back_side, vertices, -normal, lights, highlights, stale)


def eye_normals(lighting: Lighting, vertices: VertexInputs) -> np.ndarray:
    """Return the normals (V, 3) of the vertices in eye space, normalized or rescaled."""
    modelview = np.asarray(vertices.modelview, np.float32)
    with np.errstate(all="ignore"):
        to_object = inverse(modelview, vertices.modelview_kind)
        length_preserving = is_length_preserving(modelview, vertices.modelview_kind)
        return transform_normals(lighting, vertices.normal, to_object, False, length_preserving)


def transform_normals(
    lighting: Lighting, normal: np.ndarray, to_object: np.ndarray, object_space: bool, length_preserving: bool
) -> np.ndarray:
    """Return the normals (V, 3) in eye or object space, normalized or rescaled."""
    if not object_space:
        normal = np.stack([dot(normal, to_object[:3, i]) for i in range(3)]).T
    if lighting.normalize:
        return normalize_rows(normal)
    if lighting.rescale_normal and not object_space and not length_preserving:
        row = to_object[2, :3]
        squared = (row[0] * row[0] + row[1] * row[1]) + row[2] * row[2]
        normal = normal * (ONE / np.sqrt(squared if squared >= SMALLEST_SCALE else ONE))
    return normal


def at_vertices(
    light: LightState,
    lighting: Lighting,
    eye: np.ndarray | None,
    modelview: np.ndarray,
    to_object: np.ndarray,
    object_space: bool,
    highlights: bool,
) -> LightAtVertices:
    """Return the direction, half vector and attenuation of a light at every vertex."""
    position, towards_eye = vector(light.position), TOWARDS_EYE
    if object_space:
        position = transform(to_object, position[np.newaxis])[0]
        towards_eye = modelview[2, :3]
    squared_distance: np.ndarray | None = None
    if light.position[3] == 0:
        direction = normalize(position[:3])
        half = normalize(direction + towards_eye)
    else:
        assert eye is not None
        towards = position[:3] * (ONE / position[3]) - eye
        squared_distance = dot(towards, towards)
        direction = towards * reciprocal_root(squared_distance)[:, np.newaxis]
        half = direction + towards_eye
    if lighting.local_viewer and highlights:
        assert eye is not None
        half = normalize_rows(direction - normalize_rows(eye))
    elif half.ndim == 2:
        half = normalize_rows(half)
    return LightAtVertices(light, direction, half, *attenuation(light, direction, squared_distance))


def attenuation(
    light: LightState, direction: np.ndarray, squared_distance: np.ndarray | None
) -> tuple[np.ndarray | None, dict[str, np.ndarray]]:
    """Return the attenuation, spot factor times distance factor, (V,) or (1,), and the parts of `LightAtVertices`.

    The attenuation is None if the light has none.
    """
    factor: np.ndarray | None = None
    parts: dict[str, np.ndarray] = {}
    if light.spot_cutoff != 180:
        spot_direction = normalize(normalize(vector(light.spot_direction)))
        cosine = max(ZERO, np.float32(math.cos(np.float32(np.float32(light.spot_cutoff) * math.pi / 180.0))))
        spot = dot(np.atleast_2d(-direction), spot_direction)
        inside = np.where(cosine < spot, ONE, ZERO)
        spot_power = power(abs(spot), np.full_like(spot, light.spot_exponent))
        factor = np.where(inside != ZERO, spot_power, ZERO)  # not a product: NaN at the light's own place becomes 0
        parts = {"spot": spot_power, "inside": inside}
    if squared_distance is not None:
        parts["distance"] = reciprocal_root(squared_distance)
    coefficients = (light.constant_attenuation, light.linear_attenuation, light.quadratic_attenuation)
    if coefficients != (1.0, 0.0, 0.0) and squared_distance is not None:
        constant, linear, quadratic = vector(coefficients)
        distance = np.sqrt(squared_distance)
        one = reciprocal_root(squared_distance) * distance  # 1 up to rounding, as in Mesa
        polynomial = (quadratic * squared_distance + linear * distance) + constant * one
        by_distance = ONE / polynomial
        parts["distance"] = polynomial if factor is None else by_distance
        factor = by_distance if factor is None else by_distance * factor
    return factor, parts


def has_stale_products(lighting: Lighting, materials: Iterable[str], color: np.ndarray) -> bool:
    """Return whether back products that may differ between vertices are stale (`stale_registers`).

    They are not if the materials of both sides follow the colour alike: then the register that a back product reads
    was written last by the same product of the front, which has the same value. Arguments as of `varying`.
    """
    front, back = (varying(lighting, side, materials, color).intersection(PRODUCTS) for side in ("front", "back"))
    follows = front == back and back.issubset(followed(lighting, "front")) and back.issubset(followed(lighting, "back"))
    return bool(back) and not follows


def stale_products(
    lighting: Lighting, front: Reflectances, back: Reflectances, lights: list[LightAtVertices], highlights: bool
) -> list[dict[str, np.ndarray]]:
    """Return Mesa's stale green and blue of the varying back products, one mapping for each light."""

    def registers_of(source: LightAtVertices) -> LightRegisters:
        positional = source.light.position[3] != 0
        half_per_vertex = highlights and (positional or lighting.local_viewer)
        return LightRegisters(
            direction=source.direction if positional else None,
            distance=source.parts.get("distance"),
            spot=source.parts.get("spot"),
            inside=source.parts.get("inside"),
            attenuation=source.attenuation,
            half=source.half if half_per_vertex else None,
            front={name: front.product(name, source.light, {}) for name in PRODUCTS if name in front.varying},
        )

    return stale_values([registers_of(source) for source in lights], back.varying, lighting.local_viewer)


def shade_side(
    lighting: Lighting,
    reflectance: Reflectances,
    vertices: VertexInputs,
    normal: np.ndarray,
    lights: list[LightAtVertices],
    highlights: bool,
    stale: Sequence[Mapping[str, np.ndarray]] = (),
) -> Colors:
    """Return the colours of one side: emission and ambient, then each light's ambient, diffuse and specular part."""
    n, shininess = len(vertices.position), reflectance.shininess
    # red, green and blue are stored apart, (3, V), so that loops run over vertices, not over three numbers
    scene = (vector(lighting.model_ambient)[:3] * reflectance("ambient")[:, :3] + reflectance("emission")[:, :3]).T
    rgb = np.broadcast_to(scene, (3, n))
    separate = lighting.color_control == gl.GL_SEPARATE_SPECULAR_COLOR
    highlight = np.zeros((3, n), np.float32)
    for index, source in enumerate(lights):
        green_blue = stale[index] if stale else {}
        diffuse, specular = lit_factors(highlights, shininess, normal, source)
        factor = source.attenuation
        ambient_part = reflectance.product("ambient", source.light, green_blue).T
        if factor is not None:
            diffuse, specular = diffuse * factor, specular * factor
            ambient_part = factor * ambient_part
        rgb = ambient_part + rgb
        rgb = diffuse * reflectance.product("diffuse", source.light, green_blue).T + rgb
        shine = specular * reflectance.product("specular", source.light, green_blue).T
        if separate:
            highlight = shine + highlight
        else:
            rgb = shine + rgb
    primary = np.empty((4, n), np.float32)
    primary[:3], primary[3] = rgb, reflectance("diffuse")[:, 3]
    colors = [clamp_lit_colors(each) for each in ((primary, highlight) if separate else (primary,))]
    if any(values is UNWRITTEN for products in stale for values in products.values()):
        for clamped, each in zip(colors, (primary, highlight), strict=False):
            clamped[GREEN_BLUE] = clamp_colors(each[GREEN_BLUE])  # Mesa's compiler treats these as it likes
    return Colors(colors[0].T, colors[1].T if separate else None)


def lit_factors(
    highlights: bool, shininess: np.ndarray, normal: np.ndarray, source: LightAtVertices
) -> tuple[np.ndarray, np.ndarray]:
    """Return the diffuse and the specular factor (V,) before attenuation; `highlights`: see `has_highlights`."""
    towards_light = dot(normal, source.direction)
    diffuse = np.fmax(towards_light, ZERO)
    shininess = np.asarray(shininess, diffuse.dtype)
    if highlights:
        towards_half = dot(normal, source.half)
    elif source.attenuation is None:
        return diffuse, np.where(towards_light > 0, ONE, ZERO)
    else:
        shininess = towards_half = towards_light  # Mesa's attenuated path reads both from the same register
    raised = power(np.fmax(towards_half, ZERO), np.clip(shininess, -LARGEST_SHININESS, LARGEST_SHININESS))
    return diffuse, np.where(towards_light <= 0, ZERO, raised)


def clamp_colors(colors: np.ndarray) -> np.ndarray:
    """Return colours that are not lit in [0, 1]; NaN becomes 0."""
    distinct = colors[:1] if colors.strides[0] == 0 else colors  # stride 0: one colour for all vertices
    clamped: np.ndarray = np.fmin(np.fmax(distinct, ZERO), ONE)
    return np.broadcast_to(clamped, colors.shape)


def clamp_lit_colors(colors: np.ndarray) -> np.ndarray:
    """Return lit colours in [0, 1]; NaN, as at the place of a light with attenuation, becomes 1 as in Mesa."""
    clamped: np.ndarray = np.fmax(np.fmin(colors, ONE), ZERO)
    return clamped
