"""Materials that have kept another colour than the current one, though GL_COLOR_MATERIAL is enabled."""

from __future__ import annotations

import numpy as np

from softshadow.frozen import evolve
from softshadow.programs.reflectances import followed
from softshadow.state import State


def with_kept_materials(state: State, colors: np.ndarray) -> State:
    """Return the state for a draw whose vertices have the colours (V, 4), in which materials are what Mesa uses.

    In Mesa a material that was set just before GL_COLOR_MATERIAL was enabled returns with the next glBegin. It stays
    until a colour comes that is another one than before (vbo_exec_copy_to_current). Draws with one colour for all
    vertices use the material; other draws use the colours.
    """
    lighting = state.lighting
    if len(colors) == 0 or colors.strides[0] != 0:
        return state
    color = colors[0].tolist()
    for side, material in (("front", lighting.front), ("back", lighting.back)):
        for field in followed(lighting, side):
            kept = getattr(material, field)
            if [*kept] != color and np.array(kept, colors.dtype).tolist() != color:
                return evolve(state, lighting=evolve(lighting, color_material=False))
    return state
