"""Fields of the rows of a history that a draw and its state tell: lights, origins of primitives, colours."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.image import Image
from softshadow.inspection.one_pixel import Fragment
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.shade.blend import to_unorm8
from softshadow.state import State


def source_color(fragment: Fragment, image: Image | None) -> tuple[float, ...] | None:
    """Return red, green and blue of a fragment before blending, in the units of the buffer."""
    if fragment.color is None:
        return None
    if image is None or image.format.kind != "unorm8":
        return tuple(float(c) for c in fragment.color[0, :3])
    return tuple(int(c) for c in to_unorm8(fragment.color[0, :3]))


def lights_of(state: State, names: Sequence[str]) -> tuple[str, ...]:
    """Return the lights that a draw adds: the given names, or GL's."""
    if not state.lighting.enabled:
        return ()
    return tuple(
        names[number] if number < len(names) else f"GL_LIGHT{number}"
        for number, light in enumerate(state.lighting.lights)
        if light.enabled
    )


def origin_fields(command: Draw, triangle: int) -> dict[str, Any]:
    """Return what a triangle was made from, as far as the draw says it."""
    origin = command.origin
    if origin is None:
        return {}
    primitive = triangle // 2 if command.mode == gl.GL_QUADS else triangle
    owner = 0 if origin.owners is None else _at(origin.owners, primitive)
    number = primitive if origin.numbers is None else _at(origin.numbers, primitive)
    has_owner = owner is not None and 0 <= owner < len(origin.casters)
    fields: dict[str, Any] = {
        "part": origin.part,
        "caster": origin.casters[owner] if has_owner and owner is not None else "",
    }
    if origin.feature in ("face", "edge") and number is not None and number >= 0:
        fields[origin.feature] = number
    return fields


def _at(numbers: np.ndarray, place: int) -> int | None:
    return int(numbers[place]) if place < len(numbers) else None
