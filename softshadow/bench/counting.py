"""How much there is to do in a frame: draws, triangles, fragments."""

from __future__ import annotations

from softshadow import gl
from softshadow.bench.workload import Workload
from softshadow.inspection.ledger import Counts, ledger_of


def count_frame(workload: Workload) -> Counts:
    """Return the counts of one frame, without those of its preparation."""
    with gl.create_context(*workload.size) as context:
        frame = workload.program(gl)
        context.end_step("preparation")
        frame()
        context.end_step("frame")
        return ledger_of(context.frame).steps[-1]
