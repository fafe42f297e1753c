"""Why a light does not reach the surface at a pixel, or only in part: the fragment, test or lookup that decided it.

A technique shows its decision in one of a few ways: the pass that adds the light fails the stencil test (volumes,
shadow polygons) or the alpha test (maps), or adds it times what a map has given, or the shadow is painted over the
surface. Which one it is follows from the rows of the pixel's history alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from softshadow.inspection.history_row import CLEARED, HistoryRow
from softshadow.inspection.history_table import color_text
from softshadow.inspection.lookup_words import lookup_words

VOLUME_PARTS = ("volume side", "near cap", "far cap", "cap in the near rectangle", "wedge")
MARKING_PARTS = ("shadow polygon", "face in its own shadow", "flattened face")
PAINTED_PARTS = ("flattened face", "blob", "rectangle over the picture")
SAME = 1e-6


@dataclass(frozen=True)
class Cause:
    """Why a light does not reach a surface, or only in part.

    Attributes
    ----------
    light : str
    kind : str                   "own shadow": the surface is turned away from the light; "cast shadow"; "outside the
                                 cone" of a spot light; "unseen": the map says nothing about the point; "unknown"
    casters : tuple of str       the objects that cast the shadow, as far as the technique tells
    row : HistoryRow or None     the fragment that decided it
    evidence : str               the test or the lookup, in words
    """

    light: str
    kind: str
    casters: tuple[str, ...]
    row: HistoryRow | None
    evidence: str


def surface_row(rows: Sequence[HistoryRow]) -> HistoryRow | None:
    """Return the last fragment of a surface of the scene that wrote colour."""
    return next((row for row in reversed(rows) if row.color_written and not row.part), None)


def cause_of(rows: Sequence[HistoryRow], light: str, surface: HistoryRow) -> Cause:
    """Return why a light does not reach a surface, as far as the rows tell it; the kind is then "cast shadow"."""
    of_surface = [row for row in rows if is_same_surface(row, surface) and not row.part]
    adding = [row for row in of_surface if row.lights == (light,)]
    for row in reversed(adding):
        if row.verdict == "stencil failed":
            return stencil_cause(rows, light, row)
        if row.verdict == "alpha failed" or (row.verdict == "passed" and row.lookups):
            return lookup_cause(light, row)
    painted = [row for row in rows if row.part in PAINTED_PARTS and row.color_written and follows(rows, row, surface)]
    if painted:
        casters = tuple(dict.fromkeys(row.caster for row in painted if row.caster))
        if not casters:  # a rectangle over the picture, where marks are left
            return stencil_cause(rows, light, painted[-1])
        return Cause(light, "cast shadow", casters, painted[-1], f"{painted[-1].name} is painted over it")
    dark = [row for row in of_surface if row.color_written and not row.lights and "stencil test" in row.reason]
    if dark:  # the surface was drawn again without light
        return stencil_cause(rows, light, dark[-1])
    blended = [row for row in adding if row.color_written]
    if blended:
        color = color_text(blended[-1].color_source) if any(blended[-1].color_source or ()) else "black"
        return Cause(light, "cast shadow", (), blended[-1], f"the pass that adds the light blends {color}")
    return Cause(light, "unknown", (), surface, tests_of(surface))


def is_same_surface(row: HistoryRow, surface: HistoryRow) -> bool:
    """Return whether two rows are of the same triangle of the same object."""
    return (row.object, row.triangle) == (surface.object, surface.triangle)


def follows(rows: Sequence[HistoryRow], row: HistoryRow, surface: HistoryRow) -> bool:
    """Return whether a row comes after the surface was first drawn."""
    first = next(n for n, each in enumerate(rows) if is_same_surface(each, surface) and each.color_written)
    return any(each is row for each in rows[first:])


def stencil_cause(rows: Sequence[HistoryRow], light: str, decided: HistoryRow) -> Cause:
    """Return the cause of a stencil test: what has left the value that it compares."""
    number = next(n for n, row in enumerate(rows) if row is decided)
    clears = [n for n, row in enumerate(rows[:number]) if row.verdict == CLEARED and "stencil" in row.reason]
    since = rows[clears[-1] + 1 if clears else 0 : number]
    nets: dict[str, int] = {}
    for row in since:
        if row.part in VOLUME_PARTS:
            nets[row.caster] = nets.get(row.caster, 0) + row.stencil_after - row.stencil_before
    counting = tuple(caster for caster, net in nets.items() if net)
    if counting:
        evidence = f"the count is {decided.stencil_before}, of the volume{'s' if counting[1:] else ''} of "
        return Cause(light, "cast shadow", counting, decided, f"{evidence}{and_list(counting)}; {tests_of(decided)}")
    marks = [row for row in since if row.part in MARKING_PARTS and row.stencil_after != row.stencil_before]
    if marks:
        own = marks[-1].part == "face in its own shadow"
        evidence = f"{marks[-1].name} left the stencil value {marks[-1].stencil_after}; {tests_of(decided)}"
        casters = (marks[-1].caster,) if marks[-1].caster else ()
        return Cause(light, "own shadow" if own else "cast shadow", casters, decided, evidence)
    dark = [row for row in since if row.stencil_after != row.stencil_before and is_same_surface(row, decided)]
    if dark:
        evidence = f"its point was decided to be dark before: {tests_of(dark[-1])}; {tests_of(decided)}"
        return Cause(light, "unseen", (), decided, evidence)
    return Cause(light, "unknown", (), decided, tests_of(decided))


def lookup_cause(light: str, row: HistoryRow) -> Cause:
    """Return the cause of a pass that has looked up a map, or a texture of shadows."""
    if not row.lookups:
        return Cause(light, "cast shadow", (), row, tests_of(row))
    lookup = row.lookups[0]
    casters = (lookup.caster,) if lookup.caster and lookup.lit is not None and lookup.lit < 1 - SAME else ()
    overruled = lookup.visible is not None and lookup.lit is not None and abs(lookup.visible - lookup.lit) > SAME
    return Cause(light, "unseen" if overruled else "cast shadow", casters, row, lookup_words(lookup))


def tests_of(row: HistoryRow) -> str:
    """Return the tests of a row without what followed from them."""
    return row.reason.split(", so ")[0].split(": colour")[0].split(": discarded")[0]


def and_list(names: Sequence[str]) -> str:
    """Return names as "a", "a and b" or "a, b and c"."""
    return " and ".join([", ".join(names[:-1]), names[-1]]) if len(names) > 1 else names[0]
