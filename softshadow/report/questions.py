"""Questions for a reader of a report, made from its run: predict the answer, then reveal it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from softshadow.context import Frame
from softshadow.inspection import PixelHistory, Steps, pixel_history
from softshadow.inspection.explanation import explain
from softshadow.report.fragment_events import FATES, FragmentRecord

FEWEST = 12  # pixels that a question's answer must hold for, so that the pixel is no exception
TOLD_CHANGES = 8
TESTED = {FATES.index(fate): fate for fate in ("drawn", "stencil failed", "depth failed", "alpha failed")}
REJECTED_BY = {"stencil failed": "the stencil test", "depth failed": "the depth test", "alpha failed": "the alpha test"}
NONE = "none: it is drawn"


@dataclass(frozen=True)
class Question:
    """A question about a pixel at the end of a step; `answer` is the number of the right choice."""

    step: int
    x: int
    y: int
    text: str
    choices: tuple[str, ...]
    answer: int
    explanation: str


def questions(steps: Steps, record: FragmentRecord | None) -> list[Question]:
    """Return a few questions; the same run has the same ones."""
    frame = steps[0].frame
    asked = [*_count_questions(steps, frame)]
    if record is not None:
        asked += [*_test_questions(steps, record, frame), *_number_questions(steps, record, frame)]
    return asked + _light_questions(steps, frame)


def middle_of(mask: np.ndarray) -> tuple[int, int]:
    """Return x, y of the chosen pixel (H, W) bool that is nearest to the median of all of them."""
    rows, columns = np.nonzero(mask)
    distance = (rows - np.median(rows)) ** 2 + (columns - np.median(columns)) ** 2
    nearest = int(distance.argmin())
    return int(columns[nearest]), int(rows[nearest])


def _count_questions(steps: Steps, frame: Frame) -> list[Question]:
    """Ask for a stencil value of 0 at the end of the step that counts, once where it is and once where it is not."""
    changes = [
        (step.index, int((step.stencil != steps[step.index - 1].stencil).sum()))
        for step in steps
        if step.index and len(np.unique(step.stencil)) > 1
    ]
    if not changes or max(changed for _, changed in changes) < FEWEST:
        return []
    last = max(index for index, changed in changes if changed >= FEWEST)
    touched = np.logical_or.reduce([step.stencil != 0 for step in steps[: last + 1]])
    asked = []
    for mask, answer in ((steps[last].stencil != 0, 1), (touched & (steps[last].stencil == 0), 0)):
        if mask.sum() < FEWEST:
            continue
        x, y = middle_of(mask)
        history = pixel_history(frame, x, y)
        text = f"Will the stencil value of pixel {x}, {y} be 0 after step {last}, “{steps[last].title}”?"
        value = int(steps[last].stencil[y, x])
        asked.append(
            Question(last, x, y, text, ("yes", "no"), answer, f"it is {value}. {_stencil_changes(history, last)}")
        )
    return asked


def _stencil_changes(history: PixelHistory, last: int) -> str:
    changes = [
        f"{row.stencil_before} → {row.stencil_after} (step {row.step}, "
        f"{_facing(row.front_facing)}{row.object or row.verdict})"
        for row in history
        if row.step <= last and row.stencil_before != row.stencil_after
    ]
    if len(changes) > TOLD_CHANGES:
        changes[TOLD_CHANGES:] = [f"and {len(changes) - TOLD_CHANGES} more"]
    return f"Its changes: {', '.join(changes)}." if changes else "No fragment changed it."


def _facing(front: bool | None) -> str:
    return "" if front is None else "front face of " if front else "back face of "


def _test_questions(steps: Steps, record: FragmentRecord, frame: Frame) -> list[Question]:
    """Ask which test rejects the last fragment, in the last step in which tests have different results."""
    for step in reversed(steps):
        last = record.steps[step.index].last
        fates = [number for number in TESTED if (last == number).sum() >= FEWEST]
        if len(fates) < 2:
            continue
        chosen = next(number for number in (*reversed(fates), fates[0]) if TESTED[number] != "drawn")
        x, y = middle_of(last == chosen)
        rows = [row for row in pixel_history(frame, x, y) if row.step == step.index and row.verdict != "culled"]
        choices = [REJECTED_BY.get(TESTED[number], NONE) for number in fates]
        if len(choices) == 2 and NONE not in choices:
            choices.append(NONE)
        text = f"Which test rejects the last fragment of pixel {x}, {y} in step {step.index}, “{step.title}”?"
        answer = choices.index(REJECTED_BY[TESTED[chosen]])
        return [Question(step.index, x, y, text, tuple(choices), answer, f"{choices[answer]}. {rows[-1].reason}.")]
    return []


def _number_questions(steps: Steps, record: FragmentRecord, frame: Frame) -> list[Question]:
    """Ask for the number of fragments at a pixel of the step with the most of them at one pixel."""
    numbers = [np.sum(list(each.counts.values()), axis=0) for each in record.steps]
    most = [int(np.max(number)) for number in numbers]
    step = int(np.argmax(most))
    if most[step] < 2:
        return []
    common = [n for n in range(2, most[step] + 1) if (numbers[step] == n).sum() >= FEWEST]
    if not common:
        return []
    n = common[-1]
    x, y = middle_of(numbers[step] == n)
    counts = {name: int(each[y, x]) for name, each in record.steps[step].counts.items()}
    choices = tuple(str(each) for each in (n - 2, n - 1, n, n + 1) if each >= 0)
    text = f"How many fragments are tested at pixel {x}, {y} in step {step}, “{steps[step].title}”?"
    said = ", ".join(f"{count} {name}" for name, count in counts.items() if count)
    return [Question(step, x, y, text, choices, choices.index(str(n)), f"{n}: {said}.")]


def _light_questions(steps: Steps, frame: Frame) -> list[Question]:
    """Ask whether a pixel in shadow is lit."""
    maps, last = steps.maps, len(steps) - 1
    if "visibility" not in maps or "valid" not in maps:
        return []
    shadow = np.asarray(maps["valid"] & (maps["visibility"] <= 0))
    if shadow.sum() < FEWEST:
        return []
    x, y = middle_of(shadow)
    reason = explain(pixel_history(frame, x, y), float(maps["visibility"][y, x]), True)
    return [Question(last, x, y, f"Is pixel {x}, {y} lit in the finished picture?", ("lit", "in shadow"), 1, reason)]
