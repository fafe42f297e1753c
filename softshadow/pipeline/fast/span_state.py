"""The fragment state as flat arrays of numbers; equals `shade.shading.shade`, see fast/test_span_shading.py.

The kernels that shade spans take the state as an array of integers, `switches`, and an array of float32, `numbers`:
passing two arrays takes a fraction of a microsecond, and no state has to be compiled. What is not covered here
(cube maps that are seamless or of depths, anisotropic filters with borders, more than four units ...) is shaded by the
textbook.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.image import Format
from softshadow.pipeline.fast.combine_numbers import CONSTANT_COLOR, write_combine
from softshadow.pipeline.fast.fragment_block import COLUMNS, OTHER_TEXEL, PRIMARY, SIZE, TEXEL
from softshadow.pipeline.fast.span_texels import LEVELS, level_offsets
from softshadow.pipeline.shade.blend import FOUR_BYTES, BlendOps, blend_ops
from softshadow.pipeline.shade.float_writes import is_weighted_sum
from softshadow.pixels import LARGEST_UINT
from softshadow.programs.box_filtering import box_wraps
from softshadow.programs.filtering import border_of, in_8_bits, sources_of, unit_of, wraps_of
from softshadow.programs.fixed_function import Unit, has_secondary, repeats_primary
from softshadow.programs.fog import linear_terms, scaled_density
from softshadow.programs.level_of_detail import FILTERS, LARGEST_LEVEL, bias_of
from softshadow.programs.program import needs_blocks
from softshadow.programs.sampling import (
    base_format,
    filters_cube_in_float,
    is_mipmapped,
    n_levels_of_ellipses,
    needs_level_of_detail,
)
from softshadow.programs.texture_environment import MODES, WITHOUT_ALPHA
from softshadow.state import State
from softshadow.texture import Sampler, Texture

UNITS = 4  # texture units at most
# in `switches`
NEEDED, SEPARATE, FOG, FOG_COLUMN, N_UNITS, WRITABLE, BLENDS = range(7)
LOGIC_OP, EQUATION_RGB, EQUATION_ALPHA, SATURATES, SOURCE_TERMS, TARGET_TERMS, COMBINES = 7, 8, 9, 10, 11, 17, 23
STORED_AS = 24  # what colours are in the buffer, see below
UNIT_SWITCHES, SWITCHES_OF_UNIT = 25, 69
(
    PATH, S_COLUMN, WRAP_S, WRAP_T, WIDTH, HEIGHT, ROW_LENGTH, LAST_LEVEL, LOD_MODE, BETWEEN, MIN_LINEAR, MAG_LINEAR,
    CHANNELS, _, _, _, RGB_OPERATION, ALPHA_OPERATION, COMPARISON, CLAMPED, PACKED_LEVELS, IS_DEPTH, IS_SPREAD, READS_R,
    LEVEL_OFFSETS,
) = range(25)  # fmt: skip
COMBINED = 40  # where the two functions of GL_COMBINE begin
SLICES, WRAP_R = 62, 63  # of a 3-D texture
IS_CUBE, BY_RECIPROCAL, BY_PIXEL = 64, 65, 66  # how directions are projected, and what has a level of its own
IS_LINE = 67  # whether the texture is 1-D, so that t has no part in the level of detail
IS_WIDE = 68  # whether a texel is four floats, not four bytes or a depth
# in `numbers`
FOG_COLOR, FOG_SLOPE, FOG_SHIFT, BLEND_COLOR, UNIT_NUMBERS, NUMBERS_OF_UNIT = 0, 3, 4, 5, 9, 16
BORDER, CONSTANT, STEP, LEAST, MOST, BIAS, SCALES = 0, 4, 8, 9, 10, 11, 12
# how a unit is sampled: bytes as integers; one by one in float; the nearest depth compared; with an anisotropic filter
IN_BYTES, IN_FLOAT, NEAREST_DEPTH, IN_ELLIPSES = range(4)
NO_LEVELS, BY_EXPONENT, CONSTANT_LEVEL, BY_LOGARITHM = range(4)
# what a texture environment does to a channel
KEEP, REPLACE, MULTIPLY, DECAL, ADD, BLEND, COMBINE = range(7)
NO_FOG, LINEAR_FOG, EXP_FOG, EXP2_FOG = range(4)
FOGS = {gl.GL_LINEAR: LINEAR_FOG, gl.GL_EXP: EXP_FOG, gl.GL_EXP2: EXP2_FOG}
# of floats, weighted sums are apart; SOURCE_TERMS and TARGET_TERMS say which have weights, or begin with the factors
NO_BLENDING, BLENDING, LOGIC, WEIGHTED_SUM = range(4)
AS_BYTES, AS_FLOATS, AS_HALVES = range(3)  # half floats are floats with fewer bits
# whether units combine: none; each with its own texel; with those of the other one, too
NO_COMBINING, IN_TURN, WITH_OTHER = range(3)
# results of a comparison as bits: less, equal, greater, unordered
COMPARISONS = {
    gl.GL_NEVER: 0, gl.GL_LESS: 1, gl.GL_EQUAL: 2, gl.GL_LEQUAL: 3, gl.GL_GREATER: 4, gl.GL_NOTEQUAL: 13,
    gl.GL_GEQUAL: 6, gl.GL_ALWAYS: 15,
}  # fmt: skip
ON_FACES = (gl.GL_CLAMP_TO_EDGE, gl.GL_CLAMP_TO_EDGE)  # the wrap codes of all cube maps
RGB, ALPHA = 0x00FFFFFF, 0xFF000000


class StateNumbers(NamedTuple):
    """The state of the fragment stage and its samplers: switches int64, numbers float32."""

    switches: np.ndarray
    numbers: np.ndarray


_numbers: dict[object, StateNumbers | None] = {}  # by all that they depend on
KEPT = 256


def span_state(state: State, units: list[Unit], color: Format | None, columns: int) -> StateNumbers | None:
    """Return the numbers of a fixed-function state, or None where it is not covered.

    Parameters
    ----------
    color : format of the only colour buffer, or None where no colour is written
    columns : how many values are interpolated
    """
    if len(units) > UNITS or columns > COLUMNS or (color is not None and not color.is_drawn_to):
        return None
    key = (
        state.fog, state.blend, state.color.mask, has_secondary(state), color,
        *(_unit_key(state, unit) for unit in units),
    )  # fmt: skip
    if key not in _numbers:
        if len(_numbers) >= KEPT:
            _numbers.clear()
        _numbers[key] = _state_numbers(state, units, color)
    return _numbers[key]


def has_four_bytes(color: Format) -> bool:
    """Return whether a format has four bytes per pixel."""
    return color.kind == "unorm8" and color.base in FOUR_BYTES


def _unit_key(state: State, unit: Unit) -> tuple[object, ...]:
    """Return what the numbers of a unit depend on."""
    setting, texture = state.units[unit.index], unit.texture
    image, first = texture.base(), texture.images.get((0, 0))
    assert image is not None
    size = (image.width, image.height, image.slices, image.shape[1], image.format, texture.last_level())
    first_size = None if first is None else (first.width, first.height, first.slices)
    combine = setting.env_mode == gl.GL_COMBINE and (setting.combine, state.lighting.enabled)
    return unit.index, setting.env_mode, setting.env_color, combine, texture.target, texture.sampler, *size, first_size


def _state_numbers(state: State, units: list[Unit], color: Format | None) -> StateNumbers | None:
    switches = np.zeros(UNIT_SWITCHES + UNITS * SWITCHES_OF_UNIT, np.int64)
    numbers = np.zeros(UNIT_NUMBERS + UNITS * NUMBERS_OF_UNIT, np.float32)
    separate = has_secondary(state)
    column = 7 if separate else 4
    needed = (1 << column) - 1
    for n, unit in enumerate(units):
        at, number = UNIT_SWITCHES + n * SWITCHES_OF_UNIT, UNIT_NUMBERS + n * NUMBERS_OF_UNIT
        if not _write_unit(state, unit, switches[at:], numbers[number:]):
            return None
        switches[at + S_COLUMN] = column
        needed |= (0b1111 if switches[at + READS_R] else 0b1011) << column
        column += 4
    switches[SEPARATE], switches[N_UNITS] = separate, len(units)
    if state.fog.enabled:
        switches[FOG], switches[FOG_COLUMN] = FOGS.get(state.fog.mode, NO_FOG), column
        if not switches[FOG]:
            return None
        needed |= 1 << column
        numbers[FOG_COLOR : FOG_COLOR + 3] = np.array(state.fog.color[:3], np.float32).clip(0, 1)
        if state.fog.mode == gl.GL_LINEAR:
            numbers[FOG_SLOPE : FOG_SHIFT + 1] = linear_terms(state.fog)
        else:
            numbers[FOG_SLOPE] = scaled_density(state.fog)
        column += 1
    if any(state.units[unit.index].env_mode == gl.GL_COMBINE for unit in units):
        switches[COMBINES] = WITH_OTHER if _read_other_texels(state, units) else IN_TURN
        if switches[COMBINES] == WITH_OTHER and len(units) > 2:
            return None
        is_repeated = repeats_primary(state, units)
        needed |= 0b1111 << column if is_repeated else 0
        _write_combining(state, units, column * SIZE if is_repeated else int(PRIMARY), switches, numbers)
    switches[NEEDED] = needed
    if color is not None:
        mask = np.array(state.color.mask) & np.array(color.written)
        switches[WRITABLE] = np.where(mask, np.uint8(255), np.uint8(0)).view(np.int32)[0]
        if color.kind == "float":
            switches[STORED_AS] = AS_HALVES if color.encoding == "half" else AS_FLOATS
            _write_float_blending(state, color, switches, numbers)
            return StateNumbers(switches, numbers)
        if not has_four_bytes(color):
            return None
        _write_blending(state, blend_ops(state.blend, color), switches)
    return StateNumbers(switches, numbers)


def _read_other_texels(state: State, units: list[Unit]) -> bool:
    """Return whether a unit with GL_COMBINE reads the texel of another one."""
    names = {gl.GL_TEXTURE0 + unit.index for unit in units}
    combining = [(unit.index, state.units[unit.index]) for unit in units]
    return any(
        not (names - {gl.GL_TEXTURE0 + index}).isdisjoint(
            (*setting.combine.sources_rgb, *setting.combine.sources_alpha)
        )
        for index, setting in combining
        if setting.env_mode == gl.GL_COMBINE
    )


def _write_combining(state: State, units: list[Unit], primary: int, switches: np.ndarray, numbers: np.ndarray) -> None:
    """Write the functions of units with GL_COMBINE; `primary` is the first row of the primary colour."""
    for n, unit in enumerate(units):
        setting = state.units[unit.index]
        if setting.env_mode != gl.GL_COMBINE:
            continue
        sources = {gl.GL_TEXTURE0 + other.index: int(OTHER_TEXEL) for other in units}
        sources[gl.GL_TEXTURE] = sources[gl.GL_TEXTURE0 + unit.index] = int(TEXEL)
        sources |= {gl.GL_PRIMARY_COLOR: primary, gl.GL_PREVIOUS: 0, gl.GL_CONSTANT: CONSTANT_COLOR}
        at, number = UNIT_SWITCHES + n * SWITCHES_OF_UNIT, UNIT_NUMBERS + n * NUMBERS_OF_UNIT
        write_combine(setting.combine, sources, switches[at + COMBINED :], numbers[number + SCALES :])


def _write_unit(state: State, unit: Unit, switches: np.ndarray, numbers: np.ndarray) -> bool:
    """Write the numbers of a unit; return whether it is covered."""
    texture, setting = unit.texture, state.units[unit.index]
    image, sampler = texture.base(), texture.sampler
    assert image is not None
    is_depth, is_wide = image.format.kind == "depth", image.format.kind == "float"
    in_texels = texture.target == gl.GL_TEXTURE_RECTANGLE
    is_flat = in_texels or texture.target == gl.GL_TEXTURE_2D
    is_box, is_cube = texture.target == gl.GL_TEXTURE_3D, texture.target == gl.GL_TEXTURE_CUBE_MAP
    is_line = texture.target == gl.GL_TEXTURE_1D
    if (
        not (is_flat or is_box or is_cube or is_line)
        or (is_depth and not is_flat)
        or filters_cube_in_float(texture)
        or setting.env_mode not in (*MODES, gl.GL_COMBINE)
        or not _holds_texels(image.format)
    ):
        return False
    first = texture.images.get((0, 0)) or image
    wraps = box_wraps(texture, first) if is_box or in_texels else ON_FACES if is_cube else wraps_of(sampler, first)
    if is_line:
        wraps = wraps[0], gl.GL_CLAMP_TO_EDGE  # the only row
    if image.format.has_few_bits and not in_8_bits(image, wraps):
        return False
    within, between = FILTERS[sampler.min_filter]
    linear = gl.GL_LINEAR in (within, sampler.mag_filter)
    compares = is_depth and sampler.compare_mode != gl.GL_NONE
    mixes_bytes = in_8_bits(image, wraps)
    if texture.is_anisotropic:
        if not _covers_ellipses(texture, wraps):
            return False
        switches[PATH] = IN_ELLIPSES
    elif compares and not linear and not needs_blocks(texture):
        switches[PATH] = NEAREST_DEPTH
    elif (
        is_depth
        or is_wide
        or not (mixes_bytes or (not linear and between != gl.GL_LINEAR and gl.GL_CLAMP_TO_BORDER not in wraps))
    ):
        if not is_flat and within != sampler.mag_filter:  # filters of each fragment are those of 2-D textures
            return False
        switches[PATH] = IN_FLOAT
    else:
        switches[PATH] = IN_BYTES
    switches[WRAP_S : WRAP_T + 1] = [-wrap for wrap in wraps] if in_texels else wraps[:2]
    switches[IS_LINE], switches[IS_WIDE] = is_line, is_wide
    if is_cube:
        switches[IS_CUBE : BY_PIXEL + 1] = True, needs_level_of_detail(texture), is_mipmapped(texture)
    if is_box:
        switches[SLICES], switches[WRAP_R] = image.slices, wraps[2]
    last = texture.last_level() - sampler.base_level if between != gl.GL_NONE else 0
    switches[WIDTH : LAST_LEVEL + 1] = image.width, image.height, image.width if is_cube else image.shape[1], last
    switches[BETWEEN], switches[MIN_LINEAR], switches[MAG_LINEAR] = (
        between, within == gl.GL_LINEAR, sampler.mag_filter == gl.GL_LINEAR,
    )  # fmt: skip
    switches[CHANNELS : CHANNELS + 4] = sources_of(image, sampler)
    switches[IS_SPREAD] = switches[CHANNELS : CHANNELS + 4].tolist() != [0, 1, 2, 3]
    switches[RGB_OPERATION : ALPHA_OPERATION + 1] = environment_operations(setting.env_mode, base_format(texture))
    switches[COMPARISON] = 16 | COMPARISONS[sampler.compare_func] if compares else 0
    switches[READS_R] = compares or is_box or is_cube
    switches[CLAMPED], switches[IS_DEPTH] = image.format.largest > 0, is_depth
    switches[PACKED_LEVELS] = last > 0
    switches[LEVEL_OFFSETS : LEVEL_OFFSETS + LEVELS] = level_offsets(image, last, len(texture.faces))
    numbers[BORDER : BORDER + 4] = border_of(image.format, sampler, np.dtype(np.float32))
    numbers[CONSTANT : CONSTANT + 4] = np.array(setting.env_color, np.float32).clip(0, 1)
    numbers[STEP] = unit_of(image.format, np.dtype(np.float32))
    switches[LOD_MODE], numbers[LEAST : BIAS + 1] = level_mode(sampler, needs_blocks(texture))
    return True


def _covers_ellipses(texture: Texture, wraps: tuple[int, ...]) -> bool:
    """Return whether `span_ellipses` covers an anisotropic filter: of 2-D colours, without borders."""
    image, sampler = texture.base(), texture.sampler
    assert image is not None
    has_levels = FILTERS[sampler.min_filter][1] != gl.GL_NONE or n_levels_of_ellipses(texture) == 1
    is_flat = texture.target in (gl.GL_TEXTURE_2D, gl.GL_TEXTURE_RECTANGLE)
    in_image = is_flat and sampler.base_level == 0 and gl.GL_CLAMP_TO_BORDER not in wraps
    return in_image and has_levels and image.format.kind != "depth" and not image.format.has_few_bits


def _holds_texels(format: Format) -> bool:
    """Return whether the texels of a format are stored in 32 bits or as floats, or are kept so beside the image."""
    if format.kind == "depth":
        return format.dtype == np.float32 or format.largest == LARGEST_UINT
    return format.dtype in (np.uint8, np.float32)


def level_mode(sampler: Sampler, needs_levels: bool) -> tuple[int, tuple[float, float, float]]:
    """Return how the level of detail is computed, and its least and largest value and bias."""
    least, most, bias = max(sampler.min_lod, 0.0), sampler.max_lod, bias_of(sampler)
    if not needs_levels:
        return NO_LEVELS, (0.0, 0.0, 0.0)
    if least == most:
        return CONSTANT_LEVEL, (least, most, bias)
    if bias == 0 and least == 0 and most >= LARGEST_LEVEL and FILTERS[sampler.min_filter][1] != gl.GL_LINEAR:
        return BY_EXPONENT, (least, most, bias)
    limited = least > 0 or most < LARGEST_LEVEL
    return BY_LOGARITHM, (least if limited else -np.inf, most if limited else np.inf, bias)


def environment_operations(mode: int, base: int) -> tuple[int, int]:
    """Return what a texture environment does to the colours and to alpha, see `texture_environment`."""
    has_color, has_alpha = base != gl.GL_ALPHA, base not in WITHOUT_ALPHA
    if mode == gl.GL_COMBINE:
        return COMBINE, COMBINE
    if mode == gl.GL_REPLACE:
        return REPLACE if has_color else KEEP, REPLACE if has_alpha else KEEP
    if mode == gl.GL_DECAL:
        return REPLACE if base in (gl.GL_RGB, gl.GL_RED, gl.GL_RG) else DECAL if base == gl.GL_RGBA else KEEP, KEEP
    operation = {gl.GL_MODULATE: MULTIPLY, gl.GL_ADD: ADD, gl.GL_BLEND: BLEND}[mode]
    alpha = operation if base == gl.GL_INTENSITY else MULTIPLY
    return operation if has_color else KEEP, alpha if has_alpha else KEEP


def _write_blending(state: State, ops: BlendOps, switches: np.ndarray) -> None:
    if ops.logic_op:
        switches[BLENDS], switches[LOGIC_OP] = LOGIC, ops.logic_op
        return
    if not state.blend.enabled:
        return
    switches[BLENDS] = BLENDING
    switches[EQUATION_RGB], switches[EQUATION_ALPHA] = ops.equation_rgb, ops.equation_alpha
    constant = int(ops.red) | int(ops.green) << 8 | int(ops.blue) << 16 | int(ops.alpha) << 24
    switches[SOURCE_TERMS : SOURCE_TERMS + 6] = factor_terms(ops.src_rgb, ops.src_alpha, constant)
    switches[TARGET_TERMS : TARGET_TERMS + 6] = factor_terms(ops.dst_rgb, ops.dst_alpha, constant)
    for bit, name in enumerate((ops.src_rgb, ops.src_alpha, ops.dst_rgb, ops.dst_alpha)):
        switches[SATURATES] |= (name == gl.GL_SRC_ALPHA_SATURATE) << bit


def _write_float_blending(state: State, color: Format, switches: np.ndarray, numbers: np.ndarray) -> None:
    """Write how floats are blended, which have no logic operations."""
    if not state.blend.enabled or state.blend.logic_enabled:
        return
    ops = blend_ops(state.blend, color)
    if is_weighted_sum(ops):
        switches[BLENDS] = WEIGHTED_SUM
        switches[SOURCE_TERMS], switches[TARGET_TERMS] = ops.src_rgb != gl.GL_ONE, ops.dst_rgb != gl.GL_ONE
        return
    switches[BLENDS] = BLENDING
    switches[EQUATION_RGB], switches[EQUATION_ALPHA] = ops.equation_rgb, ops.equation_alpha
    switches[SOURCE_TERMS : SOURCE_TERMS + 3] = ops.src_rgb, ops.src_alpha, ops.single_channel
    switches[TARGET_TERMS : TARGET_TERMS + 3] = ops.dst_rgb, ops.dst_alpha, ops.same_factor
    numbers[BLEND_COLOR : BLEND_COLOR + 4] = ops.red, ops.green, ops.blue, ops.alpha


PLAIN = {
    gl.GL_ONE_MINUS_SRC_COLOR: gl.GL_SRC_COLOR, gl.GL_ONE_MINUS_DST_COLOR: gl.GL_DST_COLOR,
    gl.GL_ONE_MINUS_SRC_ALPHA: gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_DST_ALPHA: gl.GL_DST_ALPHA,
    gl.GL_ONE_MINUS_CONSTANT_COLOR: gl.GL_CONSTANT_COLOR, gl.GL_ONE_MINUS_CONSTANT_ALPHA: gl.GL_CONSTANT_ALPHA,
    gl.GL_ONE: gl.GL_ZERO,
}  # fmt: skip


def factor_terms(rgb: int, alpha: int, constant: int) -> np.ndarray:
    """Return the terms of a blend factor (6,) int32, masks of a pixel of four bytes.

    The factor is ``(source & a | target & b | source_alpha & c | target_alpha & d | e) ^ f``, where the alphas are in
    all four bytes: for bytes, 1 - x is ~x.
    """
    terms = [0] * 6
    for name, mask in ((rgb, RGB), (alpha, ALPHA)):
        plain = PLAIN.get(name, name)
        if name != plain:
            terms[5] |= mask
        if plain in (gl.GL_SRC_COLOR, gl.GL_DST_COLOR, gl.GL_SRC_ALPHA, gl.GL_DST_ALPHA):
            terms[(gl.GL_SRC_COLOR, gl.GL_DST_COLOR, gl.GL_SRC_ALPHA, gl.GL_DST_ALPHA).index(plain)] |= mask
        elif plain == gl.GL_CONSTANT_COLOR:
            terms[4] |= constant & mask
        elif plain == gl.GL_CONSTANT_ALPHA:
            terms[4] |= (constant >> 24) * 0x01010101 & mask
    return np.array(terms, np.int64).astype(np.int32)
