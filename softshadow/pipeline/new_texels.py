"""Commands that give a texture new texels, and what they have in common."""

from __future__ import annotations

import numpy as np

from softshadow.pipeline.commands import DefineImage, UpdateImage

NewTexels = DefineImage | UpdateImage
TEXELS = -1  # in place of the number of a part of draws that are alike: the next new texels come there


def texel_arrays(command: NewTexels) -> list[np.ndarray]:
    """Return the arrays of new texels: colours or depths, and stencil values."""
    return [array for array in (command.cells, command.stencil) if array is not None]


def texel_bytes(command: NewTexels) -> int:
    """Return how many bytes new texels take."""
    return sum([array.nbytes for array in texel_arrays(command)])
