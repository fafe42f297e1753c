"""Number of draws, triangles, fragments by verdict and stencil updates in every step."""

from __future__ import annotations

from dataclasses import dataclass, field

from softshadow import pipeline
from softshadow.context import Frame
from softshadow.inspection.step import object_of
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.execute import execute
from softshadow.pipeline.geometry.draw_primitives import primitive_count
from softshadow.pipeline.records import SCISSORED, VERDICTS, FragmentCounts

# the rasterizer creates no fragments outside the scissor box
COUNTED = tuple(verdict for verdict in VERDICTS if verdict != VERDICTS[SCISSORED])


@dataclass
class Counts:
    """The work of one step.

    `triangles` are counted before clipping and culling; lines and points are included. `fragments` has a number for
    each verdict, except for those outside the scissor box, where no fragments are created. A stencil update is a
    stencil value that changed. Draws into framebuffer objects are included. `passes` has the names of the objects of
    each pass; a new pass begins with a step, with another framebuffer, and when an object is drawn again after another.
    """

    title: str
    draws: int = 0
    triangles: int = 0
    fragments: dict[str, int] = field(default_factory=lambda: dict.fromkeys(COUNTED, 0))
    stencil_updates: int = 0
    passes: list[tuple[str, ...]] = field(default_factory=list)

    @property
    def all_fragments(self) -> int:
        """The number of fragments, whatever their verdict."""
        return sum(self.fragments.values())


@dataclass(frozen=True, repr=False)
class Ledger:
    """The work of every step, in order, and the sum."""

    steps: tuple[Counts, ...]

    @property
    def total(self) -> Counts:
        """The sum over all steps."""
        total = Counts("total")
        for step in self.steps:
            total.draws += step.draws
            total.triangles += step.triangles
            total.stencil_updates += step.stencil_updates
            total.passes += step.passes
            for verdict, count in step.fragments.items():
                total.fragments[verdict] += count
        return total

    def to_dicts(self) -> list[dict[str, object]]:
        """Return the rows of the table, the total last, as plain dictionaries."""
        return [
            {
                "step": each.title,
                "draws": each.draws,
                "triangles": each.triangles,
                "fragments": each.all_fragments,
                **each.fragments,
                "stencil updates": each.stencil_updates,
            }
            for each in (*self.steps, self.total)
        ]

    def __repr__(self) -> str:
        total = self.total
        return f"Ledger({len(self.steps)} steps: {total.draws} draws, {total.all_fragments} fragments)"

    def __str__(self) -> str:
        from softshadow.inspection.tables import text_table

        rows = self.to_dicts()
        return text_table(list(rows[0]), [[str(value) for value in row.values()] for row in rows])

    def _repr_html_(self) -> str:
        from softshadow.inspection.tables import html_table

        rows = self.to_dicts()
        return html_table(list(rows[0]), [[str(value) for value in row.values()] for row in rows])


def ledger_of(frame: Frame) -> Ledger:
    """Return the work of a recorded frame: it is replayed without short cuts, and counted."""
    storage, steps, first = frame.fresh_storage(), [], 0
    for title, end in frame.steps:
        counts, fragments = Counts(title), FragmentCounts.zero()
        for command in frame.commands[first:end]:
            if isinstance(command, Draw):
                pipeline.draw(command, storage, fragments)
                counts.draws += 1
                counts.triangles += primitive_count(command)
            else:
                execute(command, storage)
        by_verdict = dict(zip(VERDICTS, fragments.verdicts.tolist(), strict=True))
        counts.fragments = {verdict: by_verdict[verdict] for verdict in COUNTED}
        counts.stencil_updates = int(fragments.stencil_updates[0])
        counts.passes = passes_of([command for command in frame.commands[first:end] if isinstance(command, Draw)])
        steps.append(counts)
        first = end
    return Ledger(tuple(steps))


def passes_of(draws: list[Draw]) -> list[tuple[str, ...]]:
    """Return the passes of a step, each as the names of its objects; consecutive draws of an object count once."""
    passes: list[list[str]] = []
    target = None
    for command in draws:
        name = object_of(command)
        if not passes or command.state.draw_framebuffer != target or name in passes[-1][:-1]:
            passes.append([name])
        elif passes[-1][-1] != name:
            passes[-1].append(name)
        target = command.state.draw_framebuffer
    return [tuple(names) for names in passes]
