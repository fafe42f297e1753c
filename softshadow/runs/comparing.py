"""Compare the visibility of a run with that of another run, or with ray casting."""

from __future__ import annotations

import numpy as np

from softshadow.inspection import Comparison, SoftTruth, compare, soft_truth
from softshadow.inspection.comparison import jumps
from softshadow.inspection.hard_truth import hard_visibility
from softshadow.runs.lights import map_of
from softshadow.space.shadow_parts import DrawnRun, scene_of


def compared(run: DrawnRun, other: DrawnRun) -> Comparison:
    """Return how the visibility of a run differs from that of another run."""
    against = f"{other.technique} on {scene_of(other).name}"
    return _compare(run, map_of(other, "visibility"), map_of(other, "valid"), against)


def compared_with_truth(run: DrawnRun, truth: str | SoftTruth | None) -> Comparison:
    """Return how the visibility of a run differs from what ray casting finds; see `Run.compare`."""
    height, width = map_of(run, "valid").shape
    if truth == "soft":
        truth = soft_truth(scene_of(run), (width, height))
    if isinstance(truth, SoftTruth):
        edges = [jumps(np.where(truth.valid, visibility, -1)) for visibility in truth.visibilities]
        return _compare(run, truth.visibility, truth.valid, str(truth), np.logical_or.reduce(edges))
    if truth != "hard":
        raise ValueError(f'truth={truth!r}: expected "hard" or "soft"')
    visibilities, seen = hard_visibility(scene_of(run), (width, height))
    return _compare(run, np.asarray(np.mean(visibilities, axis=0, dtype=np.float32)), seen, "ray casting")


def _compare(
    run: DrawnRun, visibility: np.ndarray, valid: np.ndarray, against: str, edges: np.ndarray | None = None
) -> Comparison:
    own = map_of(run, "visibility")
    if own.shape != visibility.shape:
        (height, width), (rows, columns) = own.shape, visibility.shape
        raise ValueError(f"compare(): sizes differ, {(width, height)} and {(columns, rows)}; expected the same")
    return compare(own, map_of(run, "valid"), visibility, valid, against, edges)
