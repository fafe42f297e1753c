"""The report of one run: pictures, state and counts of every step, and the exact values under the pointer."""

from __future__ import annotations

import base64
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from softshadow.errors import Warning
from softshadow.inspection import Ledger, Step, Steps
from softshadow.report.commands import options_spelled, scene_spelled
from softshadow.report.page import data_url, named, sections, write_page
from softshadow.scene import Scene


@dataclass(frozen=True, eq=False)
class RunPage:
    """What the report of a run shows."""

    technique: str
    scene: Scene
    size: tuple[int, int]
    options: Mapping[str, Any]
    warnings: tuple[Warning, ...]
    steps: Steps
    ledger: Ledger


def write_run_page(run: RunPage, path: Path) -> None:
    """Write the report of a run as one file."""
    write_page(
        path,
        "run.html",
        run=run,
        heading=f"{run.technique} on {run.scene.name}",
        sections=sections(run.steps, data_url),
        warnings=named(run.warnings),
        ledger=run.ledger.to_dicts(),
        arguments=scene_spelled(run.scene, run.size) + options_spelled(run.technique, run.options),
        buffers=[packed(step) for step in run.steps],
    )


def packed(step: Step) -> dict[str, Any]:
    """Return the exact buffers of a step for the page's script, deflated; the bytes of depth are grouped by place."""
    depth = np.ascontiguousarray(step.depth, np.float32)
    shuffled = np.ascontiguousarray(depth.view(np.uint8).reshape(-1, 4).T)
    buffers = {"colour": step.image, "depth": shuffled, "stencil": step.stencil}
    return {
        name: base64.b64encode(zlib.compress(np.ascontiguousarray(buffer).tobytes(), 9)).decode()
        for name, buffer in buffers.items()
    }
