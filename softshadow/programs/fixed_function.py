"""GL's fixed function as a program: lighting and coordinates per vertex; texturing, specular sum and fog per fragment.

Columns of the varyings: primary RGBA; secondary RGB with GL_SEPARATE_SPECULAR_COLOR or GL_COLOR_SUM; (s, t, r, q) of
every texture unit in use; the fog distance or coordinate; primary RGBA again for GL_PRIMARY_COLOR of GL_COMBINE, which
Mesa interpolates even if it is a constant.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from softshadow import tokens as gl
from softshadow.programs.lighting import Colors, clamp_colors, eye_normals, light_vertices, needs_eye_position
from softshadow.programs.program import Program, Varyings, VertexInputs, needs_blocks
from softshadow.programs.texture_coordinates import (
    IN_EYE_SPACE,
    Normals,
    dot,
    needs_normals,
    reflects_r,
    texture_coordinates,
    transform,
)
from softshadow.state import State
from softshadow.texture import Texture

if TYPE_CHECKING:
    from softshadow.programs.vertex_color_use import ColorUses

POINT_SIZES = (1.0, 255.0)  # llvmpipe's limits
NO_COORDINATE = np.zeros((1, 4), np.float32)


@dataclass(frozen=True)
class Unit:
    """A texture unit in use: its number and its texture."""

    index: int
    texture: Texture


def program(state: State, textures: Mapping[tuple[int, int], Texture]) -> Program:
    """Return the program that the fixed function is in a state.

    Parameters
    ----------
    textures : (unit, target) -> Texture
        The bound textures. A unit uses the first complete one of its enabled targets, in the order of
        `state.texturing.TARGETS`.
    """
    units = units_in_use(state, textures)

    def vertex(vertices: VertexInputs) -> Varyings:
        return process_vertices(state, units, vertices)

    def shade(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
        shade_fragments(state, units, inputs, out)

    blocks = any(needs_blocks(unit.texture) for unit in units)
    return Program("fixed function", vertex, shade, blocks=blocks, units=units)


def units_in_use(state: State, textures: Mapping[tuple[int, int], Texture]) -> list[Unit]:
    """Return the texture units that take part in texturing."""
    units = []
    for index, unit in enumerate(state.units):
        enabled = [textures[index, target] for target in unit.targets if (index, target) in textures]
        if not enabled:
            continue
        from softshadow.programs import sampling  # loads kernels that draws without textures do not need

        units += [Unit(index, texture) for texture in enabled if sampling.is_complete(texture)][:1]
    return units


def has_secondary(state: State) -> bool:
    """Return whether a secondary colour is added after texturing."""
    is_separate = state.lighting.enabled and state.lighting.color_control == gl.GL_SEPARATE_SPECULAR_COLOR
    return is_separate or state.fog.color_sum


def process_vertices(state: State, units: list[Unit], vertices: VertexInputs) -> Varyings:
    """Return the varyings of the vertices; the colour columns are flat under GL_FLAT."""
    lighting, back = state.lighting, None
    if lighting.enabled:
        in_eye_space = any(
            gen.enabled and gen.mode in IN_EYE_SPACE for unit in units for gen in state.units[unit.index].gen
        )
        front, back = light_vertices(lighting, vertices, in_eye_space)
    else:
        front = Colors(clamp_colors(vertices.color), None)
    if state.fog.color_sum:
        front = with_secondary(front, lighting.enabled, vertices)
        back = None if back is None else with_secondary(back, lighting.enabled, vertices)
    settings = [state.units[unit.index] for unit in units]
    normals: Normals | None = None
    if any(needs_normals(setting) for setting in settings):
        normals = Normals(eye_normals(lighting, vertices), any(reflects_r(setting) for setting in settings))
    rest = [
        NO_COORDINATE.repeat(len(vertices.position), axis=0)
        if is_replaced(state, unit.index)
        else texture_coordinates(unit.index, state.units[unit.index], vertices, normals)
        for unit in units
    ]
    if state.fog.enabled:
        rest.append(fog_depth(state, vertices)[:, np.newaxis])
    is_repeated = repeats_primary(state, units)
    if is_repeated:
        rest.append(front.primary)
    values = columns(front, rest, vertices.position.dtype)
    flat = np.zeros(values.shape[1], bool)
    one_color = not lighting.enabled and vertices.color.strides[0] == 0  # Mesa does not interpolate a constant
    column = 7 if has_secondary(state) else 4
    flat[:column] = lighting.shade_model == gl.GL_FLAT or one_color
    one_secondary = not lighting.enabled and (vertices.secondary is None or vertices.secondary.strides[0] == 0)
    flat[4:column] = lighting.shade_model == gl.GL_FLAT or one_secondary
    for unit in units:
        flat[column : column + 4] = has_one_coordinate(state, unit.index, vertices)
        column += 4
    if is_repeated:
        flat[-4:] = lighting.shade_model == gl.GL_FLAT
    varies = is_repeated or (not one_color and needs_vertex_color(state, units))
    flat_input = lighting.shade_model == gl.GL_FLAT and (varies or (has_secondary(state) and not one_secondary))
    back_values = None if back is None else columns(back, rest, values.dtype)
    return Varyings(values, flat, back_values, flat_input, point_sizes(state, vertices))


def needs_vertex_color(state: State, units: list[Unit]) -> bool:
    """Return whether the fragment colours depend on the vertex colours."""
    return not units or any(_color_uses(state, units))


def repeats_primary(state: State, units: list[Unit]) -> bool:
    """Return whether the primary colour is among the varyings twice: lit colours are never constants."""
    if state.lighting.enabled or not any(state.units[unit.index].env_mode == gl.GL_COMBINE for unit in units):
        return False
    return _color_uses(state, units).by_name


def _color_uses(state: State, units: list[Unit]) -> ColorUses:
    from softshadow.programs.sampling import base_format
    from softshadow.programs.vertex_color_use import vertex_color_uses

    return vertex_color_uses([(state.units[unit.index], base_format(unit.texture)) for unit in units])


def with_secondary(colors: Colors, is_lit: bool, vertices: VertexInputs) -> Colors:
    """Return colours with the secondary colour that GL_COLOR_SUM adds: that of the vertices, if they are not lit.

    Lighting has one with GL_SEPARATE_SPECULAR_COLOR; else Mesa's vertex program writes none, which reads as 0.
    """
    if colors.secondary is not None:
        return colors
    if is_lit or vertices.secondary is None:
        return Colors(colors.primary, np.zeros((len(vertices.position), 3), vertices.position.dtype))
    return Colors(colors.primary, clamp_colors(vertices.secondary)[:, :3])


def is_replaced(state: State, unit: int) -> bool:
    """Return whether point sprites replace the coordinates of a unit: Mesa computes none then, also for polygons."""
    return state.points.sprites and state.points.replaced[unit]


def has_one_coordinate(state: State, unit: int, vertices: VertexInputs) -> bool:
    """Return whether all vertices have the same coordinate in a unit; Mesa then does not interpolate it."""
    per_vertex = vertices.texcoords[unit].strides[0] != 0  # a constant is broadcast with stride 0
    generated = any(gen.enabled for gen in state.units[unit].gen)
    return (
        not is_replaced(state, unit)
        and not per_vertex
        and not generated
        and np.array_equal(vertices.texture_matrices[unit], np.eye(4))
    )


def columns(colors: Colors, rest: list[np.ndarray], real: np.dtype) -> np.ndarray:
    """Return the columns of the colours followed by the rest."""
    parts = [colors.primary] if colors.secondary is None else [colors.primary, colors.secondary]
    return np.concatenate(parts + rest, axis=1, dtype=real)


def point_sizes(state: State, vertices: VertexInputs) -> np.ndarray | None:
    """Return the sizes of points (V,) by their distance (GL 2.1, sec. 3.3), None where they do not depend on it."""
    points, real = state.points, vertices.position.dtype.type
    if points.attenuation == (1.0, 0.0, 0.0):
        return None
    distance, (constant, linear, quadratic) = eye_distance(state, vertices), map(real, points.attenuation)
    factor = (distance * quadratic + linear) * distance + constant
    sizes = (real(1) / np.sqrt(factor)) * real(state.polygon.point_size)
    smallest, largest = max(points.smallest, POINT_SIZES[0]), min(points.largest, POINT_SIZES[1])
    return np.minimum(np.maximum(sizes, real(smallest)), real(largest))


def eye_distance(state: State, vertices: VertexInputs) -> np.ndarray:
    """Return |z| in eye space (V,), computed in the order of Mesa's vertex program."""
    if state.lighting.enabled and needs_eye_position(state.lighting, vertices.materials):
        return abs(transform(vertices.modelview, vertices.position)[:, 2])
    return abs(dot(vertices.position, np.asarray(vertices.modelview[2], vertices.position.dtype)))


def fog_depth(state: State, vertices: VertexInputs) -> np.ndarray:
    """Return what fog depends on (V,): the distance, or the fog coordinate, without its sign in Mesa."""
    if state.fog.source == gl.GL_FRAGMENT_DEPTH:
        return eye_distance(state, vertices)
    if vertices.fog_coordinates is None:
        return np.zeros(len(vertices.position), vertices.position.dtype)
    return abs(vertices.fog_coordinates)


def shade_fragments(state: State, units: list[Unit], inputs: np.ndarray, out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the fragment colours, from interpolated inputs (N, k)."""
    out[:] = inputs[:, :4]
    column = 7 if has_secondary(state) else 4
    if units:
        from softshadow.programs import texture_combine
        from softshadow.programs.sampling import base_format, project, project_with_reference, sample
        from softshadow.programs.texture_environment import apply_environment

        texels = {}
        for unit in units:  # sample all units first: a unit may combine another unit's texel
            texels[unit.index] = np.empty_like(out)
            divide = project_with_reference if unit.texture.target == gl.GL_TEXTURE_CUBE_MAP else project
            sample(unit.texture, divide(inputs[:, column : column + 4]), texels[unit.index])
            column += 4
        first = column + int(state.fog.enabled) if repeats_primary(state, units) else 0
        primary = inputs[:, first : first + 4]
        for unit in units:
            setting, texel = state.units[unit.index], texels[unit.index]
            if setting.env_mode == gl.GL_COMBINE:
                sources = texture_combine.Sources(unit.index, texels, primary, out, setting.env_color)
                out[:] = texture_combine.combine(setting.combine, sources)
            else:
                apply_environment(out, texel, setting.env_mode, base_format(unit.texture), setting.env_color)
    if has_secondary(state):
        out[:, :3] += inputs[:, 4:7]
    if state.fog.enabled:
        from softshadow.programs.fog import apply_fog

        apply_fog(out, state.fog, inputs[:, column])
