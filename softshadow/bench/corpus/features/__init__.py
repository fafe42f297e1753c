"""Single features of GL: what each costs on a mesh that is otherwise drawn in the usual way."""

from __future__ import annotations

from softshadow.bench.corpus.features import arrays, fragments, geometry, passes, pixels, textures
from softshadow.bench.corpus.features.feature import AND, FAMILY, PLAIN, Feature, program_of
from softshadow.bench.corpus.program import Program
from softshadow.errors import nearest

FEATURES: dict[str, Feature] = {
    each.name: each for group in (textures, fragments, geometry, arrays, passes, pixels) for each in group.FEATURES
}
NAMES = tuple(f"{FAMILY}/{name}" for name in (PLAIN, *FEATURES))


def program_with(names: str) -> Program:
    """Return the program of features by their names, as in "fog-exp+scissor".

    Raises
    ------
    ValueError                   unknown name; the message suggests the nearest
    """
    chosen = [] if names == PLAIN else names.split(AND)
    for name in chosen:
        if name not in FEATURES:
            raise ValueError(f"unknown feature {FAMILY}/{name}: {nearest(name, (PLAIN, *FEATURES))}")
    return program_of(tuple(FEATURES[name] for name in chosen))
