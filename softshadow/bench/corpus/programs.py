"""All programs of the corpus by name."""

from __future__ import annotations

from softshadow.bench.corpus import (
    blended,
    first_programs,
    flat,
    large_meshes,
    lines_and_points,
    more_calls,
    several_passes,
    shadow_maps,
    small_draws,
    stencil_shadows,
    textured,
)
from softshadow.bench.corpus.features import program_with
from softshadow.bench.corpus.features.feature import FAMILY
from softshadow.bench.corpus.program import Program
from softshadow.errors import nearest

FAMILIES = (
    first_programs, large_meshes, textured, blended, stencil_shadows, shadow_maps, several_passes, lines_and_points,
    flat, more_calls,
)  # fmt: skip
PROGRAMS = {program.name: program for family in FAMILIES for program in family.PROGRAMS}
SMALL_DRAWS = {program.name: program for program in small_draws.PROGRAMS}  # measured apart from the corpus
EVERY = PROGRAMS | SMALL_DRAWS


def get(name: str) -> Program:
    """Return the program with this name ("small-draws/widgets"), or that of features ("features/fog-exp+scissor").

    Raises
    ------
    ValueError                   unknown name; the message suggests the nearest
    """
    family, _, names = name.rpartition("/")
    if family == FAMILY:
        return program_with(names)
    if name not in EVERY:
        raise ValueError(f"unknown program {name if family else f'corpus/{name}'}: {nearest(name, EVERY)}")
    return EVERY[name]
