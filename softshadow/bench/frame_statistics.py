"""The amount of work in a frame: numbers of draws, triangles and fragments."""

from __future__ import annotations

from softshadow import gl
from softshadow.bench.workload import Workload
from softshadow.inspection.ledger import Counts, ledger_of


def frame_statistics(workload: Workload) -> Counts:
    """Return the numbers of draws, triangles and fragments of one frame, without its preparation."""
    with gl.create_context(*workload.size) as context:
        frame = workload.program(gl)
        context.end_step("preparation")
        frame()
        context.end_step("frame")
        return ledger_of(context.frame).steps[-1]
