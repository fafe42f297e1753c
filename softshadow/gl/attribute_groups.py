"""The attribute groups of glPushAttrib (GL 2.1, sec. 6.2), and when Mesa regards a group as changed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import is_dataclass
from typing import Any

from softshadow import tokens as gl
from softshadow.frozen import evolve_to, remembered
from softshadow.gl.capabilities import (
    CAPABILITIES,
    CLIP_PLANES,
    LIGHTS,
    TEXTURE_GENERATION,
    UNIT_CAPABILITIES,
    is_on,
    with_capability,
)
from softshadow.gl.fragment_state import extension_back
from softshadow.state import State
from softshadow.state.texturing import BINDINGS

Fields = dict[str, tuple[str, ...]]  # group of the state: its fields, () for all
LIGHT_MODEL = ("enabled", "color_material", "color_material_face", "color_material_mode", "shade_model")
# what each bit restores, in Mesa's order (main/attrib.c); bits without fields restore state outside `State`
GROUPS: dict[int, Fields] = {
    gl.GL_ACCUM_BUFFER_BIT: {"color": ("clear_accum",)},
    gl.GL_COLOR_BUFFER_BIT: {"alpha": (), "blend": (), "color": ("mask", "clear", "dither")},
    gl.GL_CURRENT_BIT: {},
    gl.GL_DEPTH_BUFFER_BIT: {"depth": ("enabled", "func", "write", "clear")},
    gl.GL_ENABLE_BIT: {},
    gl.GL_EVAL_BIT: {},
    gl.GL_FOG_BIT: {"fog": ("enabled", "mode", "density", "start", "end", "color")},
    gl.GL_HINT_BIT: {},
    gl.GL_LIGHTING_BIT: {
        "lighting": (*LIGHT_MODEL, "lights", "model_ambient", "local_viewer", "two_side", "color_control"),
    },
    gl.GL_LINE_BIT: {"lines": (), "polygon": ("line_width",)},
    gl.GL_LIST_BIT: {},
    gl.GL_PIXEL_MODE_BIT: {},
    gl.GL_POINT_BIT: {"points": (), "polygon": ("point_size",)},
    gl.GL_POLYGON_BIT: {
        "cull": (),
        "polygon": (
            "mode_front",
            "mode_back",
            "offset_fill",
            "offset_line",
            "offset_point",
            "factor",
            "units",
            "smooth",
            "stippled",
        ),
    },
    gl.GL_POLYGON_STIPPLE_BIT: {"polygon": ("stipple",)},
    gl.GL_SCISSOR_BIT: {"scissor": ()},
    gl.GL_STENCIL_BUFFER_BIT: {"stencil": ()},
    gl.GL_TRANSFORM_BIT: {"clip_planes": (), "lighting": ("normalize", "rescale_normal"), "depth": ("clamp",)},
    gl.GL_TEXTURE_BIT: {"units": ()},
    gl.GL_VIEWPORT_BIT: {"viewport": ()},
    gl.GL_MULTISAMPLE_BIT: {
        "color": (
            "multisample",
            "alpha_to_coverage",
            "alpha_to_one",
            "sample_coverage",
            "coverage_value",
            "coverage_inverted",
        ),
    },
}
# the fields that Mesa restores by GL calls, which flush the collected vertices; it copies the others
SET_BY_CALLS: dict[int, Fields] = {
    **GROUPS,
    gl.GL_ACCUM_BUFFER_BIT: {},
    gl.GL_COLOR_BUFFER_BIT: {"alpha": (), "blend": (), "color": ("mask", "dither")},
    gl.GL_DEPTH_BUFFER_BIT: {"depth": ("enabled", "func", "write")},
    gl.GL_LIGHTING_BIT: {"lighting": LIGHT_MODEL},
    gl.GL_POINT_BIT: {
        "points": ("smooth", "smallest", "largest", "fade_threshold", "attenuation", "sprites", "origin"),
        "polygon": ("point_size",),
    },
    gl.GL_POLYGON_STIPPLE_BIT: {},
    gl.GL_STENCIL_BUFFER_BIT: {"stencil": ("enabled", "front", "back")},
    gl.GL_TRANSFORM_BIT: {
        "clip_planes": ("enabled",),
        "lighting": ("normalize", "rescale_normal"),
        "depth": ("clamp",),
    },
    gl.GL_TEXTURE_BIT: {},
    gl.GL_VIEWPORT_BIT: {},
}


# group of the state: the bits with fields of it, each with these fields
BITS: dict[str, list[tuple[int, tuple[str, ...]]]] = {}
for _bit, _groups in GROUPS.items():
    for _group, _fields in _groups.items():
        BITS.setdefault(_group, []).append((_bit, _fields))
# GL_TEXTURE_CUBE_MAP_SEAMLESS, which is newer than GL 2.1, belongs to no group; Mesa forgets GL_COLOR_SUM
UNPUSHED = (gl.GL_TEXTURE_CUBE_MAP_SEAMLESS, gl.GL_COLOR_SUM)
PUSHED: dict[str, list[tuple[int, str]]] = {}  # group of the state: (capability, field)
for _cap, (_group, _field) in CAPABILITIES.items():
    if _cap not in UNPUSHED:
        PUSHED.setdefault(_group, []).append((_cap, _field))
PER_UNIT = (*UNIT_CAPABILITIES, *TEXTURE_GENERATION)


def _bits_of_fields(group: str, value: Any) -> dict[str, int]:
    """Return the bits of which each restores a field, for all fields that bits restore."""
    bits: dict[str, int] = {}
    for bit, fields in BITS[group]:
        for field in fields or vars(value):
            bits[field] = bits.get(field, 0) | bit
    for _, field in PUSHED.get(group, ()):
        bits[field] = bits.get(field, 0) | gl.GL_ENABLE_BIT
    return bits


# the same for the groups without other groups in them: restoring these has no side effects
BITS_OF_FIELDS = {
    group: _bits_of_fields(group, value)
    for group, value in vars(State()).items()
    if group in BITS and is_dataclass(value) and not any(map(is_dataclass, vars(value).values()))
}


@remembered
def changed_groups(before: State, after: State) -> int:
    """Return the bits of the groups in which two states differ.

    Materials do not count: they are vertex attributes, and change when pending attributes become current.
    """
    bits, one, other = 0, before.__dict__, after.__dict__
    for group, old in one.items():
        new = other[group]
        if old is not new:
            for bit, fields in BITS.get(group, ()):
                if not bits & bit and _fields_differ(old, new, fields):
                    bits |= bit
    return bits | (gl.GL_ENABLE_BIT if any(_switched(before, after, lights=True)) else 0)


def differ(before: State, after: State, groups: Fields) -> bool:
    """Return whether two states differ in any of these fields."""
    return any(_fields_differ(getattr(before, group), getattr(after, group), names) for group, names in groups.items())


def _fields_differ(old: Any, new: Any, fields: tuple[str, ...]) -> bool:
    """Return whether two values of a group differ in any of these fields; () are all."""
    if old is new:
        return False
    if not fields:
        return bool(old != new)
    one, other = old.__dict__, new.__dict__
    return any(one[field] is not other[field] and one[field] != other[field] for field in fields)


def needs_calls(bit: int, before: State, after: State) -> bool:
    """Return whether Mesa makes GL calls to get from one state to another in one group."""
    lights, others = before.lighting.lights, after.lighting.lights
    if (
        bit == gl.GL_LIGHTING_BIT
        and lights is not others
        and [a.enabled for a in lights] != [b.enabled for b in others]
    ):
        return True
    if bit == gl.GL_ENABLE_BIT:
        return before is not after
    if bit == gl.GL_TEXTURE_BIT:
        return any(
            any(getattr(old, binding) != getattr(new, binding) for binding in BINDINGS.values())
            for old, new in zip(before.units, after.units, strict=True)
        )
    return differ(before, after, SET_BY_CALLS[bit])


@remembered
def with_group(bit: int, now: State, before: State) -> State:
    """Return the state with one group restored from an earlier state."""
    if bit == gl.GL_ENABLE_BIT:
        return _with_capabilities(now, before)
    restored: dict[str, Any] = {}
    for group, fields in GROUPS[bit].items():
        new, old = getattr(now, group), getattr(before, group)
        if new is not old:
            restored[group] = evolve_to(old, new, **{f: getattr(old, f) for f in fields}) if fields else old
    if "stencil" in restored:  # Mesa does not restore the extension's back state
        old = restored["stencil"]
        back = {extension_back(old): getattr(now.stencil, extension_back(now.stencil))}
        restored["stencil"] = evolve_to(now.stencil, old, **back)
    return evolve_to(before, now, **restored) if restored else now


@remembered
def with_groups(bits: tuple[int, ...], now: State, before: State) -> State:
    """Return the state with several groups restored, one after the other."""
    for bit in bits:
        now = with_group(bit, now, before)
    return now


def _with_capabilities(state: State, before: State) -> State:
    switched = list(_switched(before, state, lights=False))
    if not switched:
        return state
    for cap, unit in switched:
        state = with_capability(state, cap, unit, is_on(before, cap, unit))
    groups = {CAPABILITIES[cap][0] for cap, _ in switched if cap in CAPABILITIES}
    return evolve_to(before, state, **{g: evolve_to(getattr(before, g), getattr(state, g)) for g in groups})


def _switched(before: State, after: State, lights: bool) -> Iterator[tuple[int, int]]:
    """Return the (capability, texture unit) pairs of GL_ENABLE_BIT in which two states differ.

    In Mesa, switching a light on or off marks this group as changed, but popping it does not restore lights.
    """
    after_groups = after.__dict__
    for group, old in before.__dict__.items():
        new = after_groups[group]
        if old is not new:
            yield from ((cap, 0) for cap, field in PUSHED.get(group, ()) if getattr(old, field) != getattr(new, field))
    several: list[int] = []
    if lights and before.lighting.lights is not after.lighting.lights:
        several += LIGHTS
    if before.clip_planes is not after.clip_planes:
        several += CLIP_PLANES
    for cap in several:
        if is_on(before, cap, 0) != is_on(after, cap, 0):
            yield cap, 0
    if before.units is not after.units:
        for unit, (old, new) in enumerate(zip(before.units, after.units, strict=True)):
            if old is not new:
                yield from ((cap, unit) for cap in PER_UNIT if is_on(before, cap, unit) != is_on(after, cap, unit))
