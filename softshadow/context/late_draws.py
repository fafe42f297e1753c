"""Draws that are made later, many at once: those of glBegin ... glEnd pairs, and of small arrays and lists.

A program that draws each of many objects under a matrix and in a colour of its own makes hundreds of draws of a few
vertices in a frame. Making one of them (for a pair, with its arrays) and carrying it out takes as long as its calls. So
such draws wait with their numbers or arrays until something else is drawn, or someone looks.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from itertools import groupby

from softshadow.context.late_commands import LateCommands
from softshadow.context.late_forms import LateDraw, LateForm, MovedDraw
from softshadow.context.precision import Precision
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.new_texels import NewTexels, texel_bytes

# a draw that is kept for comparisons keeps the memory of all that waited with it
MOST_NUMBERS = 2048  # of positions
MOST_BYTES, MOST_UPDATES = 1 << 20, 512  # of texels among the draws
MOVED_NUMBERS = 16  # as which a draw counts whose arrays have been made
MOST_FORMS = 1024  # as many as there are states that are found again


def _is_stippled(draw: LateDraw | MovedDraw) -> bool:
    """Return whether a draw is not taken with others, as a pattern goes on from one to the next."""
    return type(draw) is LateDraw and draw.form.like.state.lines.stippled


class LateDraws:
    """Draws that wait.

    Attributes
    ----------
    draws : list             these, in their order
    earlier : dict           draws that others may continue, by their modes, the identity of their state, and the slots
                             of their arrays (`softshadow.gl.moved_draws`)
    forms : dict             the latest ones, by their mode, the identity of their state, and what the vertices carry

    Parameters
    ----------
    precision : Precision    makes the arrays
    """

    def __init__(self, precision: Precision) -> None:
        self._precision = precision
        self.draws: list[LateDraw | MovedDraw] = []
        self.earlier: dict[tuple[int, int, int, tuple[int, ...]], Draw] = {}
        self.forms: dict[tuple[Hashable, ...], LateForm] = {}
        self._texels: list[tuple[int, NewTexels]] = []  # with the number of draws before
        self._n_numbers, self._n_bytes = 0, 0

    def keep_form(self, key: tuple[Hashable, ...], form: LateForm) -> None:
        """Keep a form, which keeps its state, for other draws."""
        if len(self.forms) >= MOST_FORMS:
            self.forms.clear()
        self.forms[key] = form

    def add(self, draw: LateDraw | MovedDraw) -> bool:
        """Let a draw wait; return whether so many wait that they should be taken."""
        self.draws.append(draw)
        self._n_numbers += draw.n_numbers if type(draw) is LateDraw else MOVED_NUMBERS
        return self._n_numbers >= MOST_NUMBERS

    def add_texels(self, command: NewTexels) -> bool:
        """Let new texels wait behind the draws, of which there are some; return False if that does not pay."""
        if command.blocks is not None or len(self._texels) == MOST_UPDATES:
            return False
        n_bytes = self._n_bytes + texel_bytes(command)
        if n_bytes > MOST_BYTES:
            return False
        self._texels.append((len(self.draws), command))
        self._n_bytes = n_bytes
        return True

    def take(self) -> Iterator[LateCommands]:
        """Yield the draws in their order, and forget them."""
        draws, texels, self.draws, self._texels = self.draws, self._texels, [], []
        self._n_numbers, self._n_bytes = 0, 0
        keys = [id(draw[0]) for draw in draws]  # of their form, or of the draw that they are like
        if not any(map(_is_stippled, dict(zip(keys, draws, strict=True)).values())):
            if draws:
                yield LateCommands(draws, keys, self._precision, texels)
            return
        start = 0
        for _, same in groupby(draws, _is_stippled):
            end = start + len(list(same))
            own = [(n_before - start, command) for n_before, command in texels if start < n_before <= end]
            yield LateCommands(draws[start:end], keys[start:end], self._precision, own)
            start = end
