"""The clip planes of the draws of a run; equal to `geometry.clip_planes.user_planes`, see fast/test_batch.py."""

from __future__ import annotations

from collections.abc import Sequence
from operator import attrgetter
from typing import NamedTuple

import numpy as np

from softshadow.pipeline.alike_draws import of_each
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.clip_planes import NO_PLANES, enabled_planes, in_clip_space
from softshadow.programs.inverse import inverse

PLANES_OF = attrgetter("state.clip_planes")


class Planes(NamedTuple):
    """The clip planes of the draws of a run.

    firsts, ends: the rows [first, end) of each draw; rows (P, 4) float32, in clip space.
    """

    firsts: Sequence[int]
    ends: Sequence[int]
    rows: np.ndarray


def planes_of(draws: Sequence[Draw]) -> Planes:
    """Return the clip planes of draws; those with the same planes and projection share rows."""
    groups = of_each(draws, PLANES_OF)
    if not any(True in group.enabled for group in {id(group): group for group in groups}.values()):
        nothing = [0] * len(draws)
        return Planes(nothing, nothing, NO_PLANES)
    places: dict[tuple[int, ...], tuple[int, int]] = {}
    inverses: dict[tuple[int, ...], np.ndarray] = {}
    planes: list[tuple[float, ...]] = []
    of_planes, of_draws = [], []
    for draw, group in zip(draws, groups, strict=True):
        matrix, kind = draw.projection, draw.projection_kind
        projection = id(matrix), kind
        place = places.get((id(group), *projection))
        if place is None:
            if projection not in inverses:
                inverses[projection] = inverse(matrix, kind)
            enabled = enabled_planes(group)
            place = places[(id(group), *projection)] = len(planes), len(planes) + len(enabled)
            planes += enabled
            of_planes += [inverses[projection]] * len(enabled)
        of_draws.append(place)
    firsts, ends = zip(*of_draws, strict=True)
    return Planes(firsts, ends, in_clip_space(planes, np.array(of_planes)))
