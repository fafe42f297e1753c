"""Late draws as commands: those that differ in vertices, indices and modelview matrix only are made together.

A few of them are made at once; many stay arrays of all until someone looks at them (`pipeline.alike_draws`).
"""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterator, Sequence
from itertools import chain, groupby, islice, repeat
from typing import cast

import numpy as np

from softshadow.context.arrays import SLOTS, TEXCOORD
from softshadow.context.late_forms import LateDraw, MovedDraw, matrices_of
from softshadow.context.precision import Precision
from softshadow.pipeline.alike_draws import AlikeDraws, each_of
from softshadow.pipeline.alike_vertices import Attribute, GivenVertices, JoinedVertices
from softshadow.pipeline.commands import Command, Draw, Vertices, moved_draws
from softshadow.pipeline.geometry.separate import separated
from softshadow.pipeline.new_texels import TEXELS, NewTexels, texel_arrays

MANY = 24  # draws that are alike: to handle arrays of fewer takes longer than to make these draws


class LateCommands(Collection[Command]):
    """Late draws in their order, which are made when someone looks at them, and new texels of textures among them.

    Parameters
    ----------
    draws : sequence         of LateDraw and MovedDraw
    keys : sequence of int   those of draws that are alike are equal
    precision : Precision    makes the arrays
    texels : sequence        of (number of draws before, NewTexels), in their order; there is a draw before the first

    Attributes
    ----------
    parts : list             each of draws that differ from each other in vertices, indices and modelview matrix only:
                             `AlikeDraws` or a list. The vertices of each part have arrays of the same attributes.
    turns : list             (number of a part, number of its next draws), in drawing order; where the number is
                             `TEXELS`, that of the next new texels
    texels : list            new texels, in their order
    vertices : list          those of the draws that are no pairs
    indices : list           those of all draws
    """

    def __init__(
        self,
        draws: Sequence[LateDraw | MovedDraw],
        keys: Sequence[int],
        precision: Precision,
        texels: Sequence[tuple[int, NewTexels]] = (),
    ) -> None:
        self._joined: list[JoinedVertices] = []
        self.vertices: list[Vertices] = []
        self.indices: list[np.ndarray] = []
        self.texels = [command for _, command in texels]
        if len(set(keys)) == 1 and not texels:
            self.turns, self.parts = [(0, len(draws))], self._parts([list(draws)], precision)
            return
        numbers: dict[int, int] = {}
        alike: list[list[LateDraw | MovedDraw]] = []
        for key, draw in zip(keys, draws, strict=True):
            number = numbers.setdefault(key, len(alike))
            if number == len(alike):
                alike.append([])
            alike[number].append(draw)
        self.turns, start = [], 0
        for end in (*[n_before for n_before, _ in texels], len(keys)):
            self.turns += [(numbers[key], len(list(same))) for key, same in groupby(keys[start:end])]
            self.turns.append((TEXELS, 1))
            start = end
        self.turns.pop()  # none are left behind the last draws
        self.parts = self._parts(alike, precision)

    @property
    def arrays(self) -> list[np.ndarray]:
        """The arrays of pairs, and new texels."""
        texels = chain.from_iterable(map(texel_arrays, self.texels))
        return [*[array for vertices in self._joined for array in vertices.arrays], *texels]

    def __len__(self) -> int:
        return sum([count for _, count in self.turns])

    def __iter__(self) -> Iterator[Command]:
        rest: list[Iterator[Command]] = [*map(iter, self.parts), iter(self.texels)]
        return chain.from_iterable(islice(rest[number], count) for number, count in self.turns)

    def __contains__(self, command: object) -> bool:
        return any(each is command for each in self)

    def _parts(self, alike: Sequence[list[LateDraw | MovedDraw]], precision: Precision) -> list[Sequence[Draw]]:
        """Return the draws of each part."""
        made: dict[int, Sequence[Draw]] = {}
        pairs: dict[Hashable, list[int]] = {}  # numbers of parts whose vertices have the same attributes
        for number, same in enumerate(alike):
            first = same[0]
            if isinstance(first, MovedDraw):
                made[number] = self._moved(cast(list[MovedDraw], same))
            else:
                pairs.setdefault((first.form.columns, id(first.form.texcoords)), []).append(number)
        for group in pairs.values():
            if len(group) == len(alike[group[0]]) == 1:
                made[group[0]] = [self._pair(cast(LateDraw, alike[group[0]][0]), precision)]
                continue
            group.sort(key=lambda number: len(alike[number]) >= MANY)
            own = self._pairs([cast(list[LateDraw], alike[number]) for number in group], precision)
            made.update(zip(group, own, strict=True))
        return [made[number] for number in range(len(alike))]

    def _moved(self, draws: Sequence[MovedDraw]) -> Sequence[Draw]:
        """Return draws that are alike."""
        like, vertices, indices = draws[0].like, [draw.vertices for draw in draws], [draw.indices for draw in draws]
        matrices, kinds = matrices_of(draws), [draw.modelview_kind for draw in draws]
        own = [each for each in indices if each is not None]
        self.vertices += vertices
        self.indices += own
        if len(draws) < MANY or 0 < len(own) < len(draws):
            return moved_draws(like, zip(vertices, indices, each_of(matrices, len(draws)), kinds, strict=True))
        return AlikeDraws(like, GivenVertices(vertices), matrices, kinds, own or None)

    def _pair(self, draw: LateDraw, precision: Precision) -> Draw:
        """Return the only draw whose vertices have its attributes."""
        joined = _joined((draw,), precision)
        self._joined.append(joined)
        (vertices,) = joined.split()
        made = draw.made(vertices)
        if made.indices is not None:
            self.indices.append(made.indices)
        return made

    def _pairs(self, parts: Sequence[Sequence[LateDraw]], precision: Precision) -> Iterator[Sequence[Draw]]:
        """Yield parts of draws of pairs: their vertices have the same attributes; those of few draws come first."""
        draws = [draw for part in parts for draw in part]
        vertices, matrices = _joined(draws, precision), matrices_of(draws)
        kinds, has_several = [draw.modelview_kind for draw in draws], any(draw.counts for draw in draws)
        self._joined.append(vertices)
        n_few = sum([len(part) for part in parts if len(part) < MANY])
        few = zip(vertices.of(0, n_few).split(), repeat(None), each_of(matrices, n_few), kinds, strict=False)
        start = 0
        for part in parts:
            like, end = part[0].form.like, start + len(part)
            made: Sequence[Draw]
            if end <= n_few:
                made = moved_draws(like, islice(few, len(part)))
            else:
                own = matrices if len(matrices) == 1 else matrices[start:end]
                made = AlikeDraws(like, vertices.of(start, end), own, kinds[start:end])
            yield self._separated(made, part) if has_several else made
            start = end

    def _separated(self, made: Sequence[Draw], pairs: Sequence[LateDraw]) -> Sequence[Draw]:
        """Return draws, of which those of several strips, fans, loops or polygons are draws of separate primitives."""
        if not any(pair.counts for pair in pairs):
            return made
        own = zip(made, pairs, strict=True)
        draws = [separated(draw, pair.counts) if pair.counts else draw for draw, pair in own]
        self.indices += [draw.indices for draw in draws if draw.indices is not None]
        return draws


def _joined(draws: Sequence[LateDraw], precision: Precision) -> JoinedVertices:
    """Return the vertices of draws with the same attributes."""
    form, positions = draws[0].form, [draw.positions for draw in draws]
    names = [name for name in form.columns if name.startswith("texcoord")]
    return JoinedVertices(
        [len(each) // 4 for each in positions],
        precision.rows([*chain.from_iterable(positions)], 4),
        _attribute("color", [draw.color for draw in draws], draws, precision),
        _attribute("normal", [draw.normal for draw in draws], draws, precision),
        form.texcoords,
        {SLOTS[name] - TEXCOORD: _rows(name, 4, draws, precision) for name in names},
    )


def _attribute(
    name: str, values: Sequence[tuple[float, ...]], draws: Sequence[LateDraw], precision: Precision
) -> Attribute:
    """Return the colours or normals of draws; `values` are those of each draw whose vertices carry none."""
    width = len(values[0])
    if name in draws[0].form.columns:
        return Attribute(_rows(name, width, draws, precision), False)
    if len(set(map(id, values))) == 1:
        return Attribute(precision.constant(values[0], 1), True)
    return Attribute(precision.rows([*chain.from_iterable(values)], width), True)


def _rows(name: str, width: int, draws: Sequence[LateDraw], precision: Precision) -> np.ndarray:
    """Return an attribute of all vertices of draws, which is among the changes of their primitives."""
    numbers: list[float] = []
    whole: dict[int, list[float]] = {}  # of primitives, by identity
    for draw in draws:
        primitive, end = draw.primitive, draw.end
        if end is None:
            numbers += primitive.components(name, ())
            continue
        if id(primitive) not in whole:
            whole[id(primitive)] = primitive.components(name, ())
        numbers += whole[id(primitive)][draw.start * width // 4 : end * width // 4]
    return precision.rows(numbers, width)
