"""What the pictures of a run show, in words."""

from __future__ import annotations

from softshadow.inspection import Steps
from softshadow.inspection.step import step_in_words

MOST_DESCRIBED = 8  # steps


def described(steps: Steps, technique: str, size: tuple[int, int]) -> str:
    """Return a line for each step; of a run with many steps, for the first ones and the last."""
    width, height = size
    name = steps[0].run_name or technique
    lines = [f"{name}, {width} x {height} pixels, steps 0 to {len(steps) - 1}."]
    shown = list(steps)
    if len(shown) > MOST_DESCRIBED:
        lines[0] = f"{lines[0][:-1]}, of which 0 to {MOST_DESCRIBED - 2} and the last are described."
        shown = [*shown[: MOST_DESCRIBED - 1], shown[-1]]
    for step in shown:
        before = steps[step.index - 1] if step.index else None
        lines.append(f"Step {step.index}, {step.title}: {step_in_words(step, before)}.")
    return "\n".join(lines)
