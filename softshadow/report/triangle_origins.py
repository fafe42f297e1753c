"""From which edge or face of which caster the triangles of a draw were made, in words for a page."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from softshadow.inspection.history_row import origin_name
from softshadow.inspection.row_fields import origin_fields
from softshadow.pipeline.commands import Draw
from softshadow.report.fragment_events import LINE, Origins


def origins_of(command: Draw, triangles: np.ndarray, facings: Sequence[int]) -> Origins | None:
    """Return the origins of some triangles of a draw, or None if the draw does not tell them."""
    if command.origin is None:
        return None
    found = [origin_fields(command, int(triangle)) for triangle in triangles]
    kinds = [(each["caster"], "edge" if "edge" in each else "face" if "face" in each else "") for each in found]
    distinct = list(dict.fromkeys(kinds))
    names = {
        facing: [
            origin_name(
                command.origin.part, caster, None if facing == LINE else facing == 1, f"{kind} {{number}}" * bool(kind)
            )
            for caster, kind in distinct
        ]
        for facing in facings
    }
    owners = np.array([distinct.index(kind) for kind in kinds], np.int32)
    numbers = np.array([each.get("edge", each.get("face", -1)) for each in found], np.int32)
    return Origins(names, owners, numbers)
