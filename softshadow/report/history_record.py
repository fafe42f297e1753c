"""The histories of all pixels as JSON for a page: the events of a `FragmentRecord`, with their arrays by number."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from softshadow.context import Frame
from softshadow.inspection import Steps
from softshadow.report.fragment_events import ClearEvent, DrawEvent, FragmentRecord, WriteEvent
from softshadow.report.fragment_record import TooManyFragments, record_fragments
from softshadow.report.packing import Packing

HISTORIES = "histories of the pixels"


def recorded(frame: Frame, packing: Packing) -> FragmentRecord | None:
    """Return the fragments of a frame, or None if there are too many for a page."""
    try:
        return record_fragments(frame)
    except TooManyFragments as reason:
        packing.leave_out(HISTORIES, str(reason))
        return None


def history_json(record: FragmentRecord, steps: Steps, packing: Packing, texts: list[Any]) -> dict[str, Any] | None:
    """Return what templates/history.js reads, or None if the arrays have no room.

    `texts` collects the words of draws; draws of the same words share them.
    """
    arrays = [*record.start.buffers]
    for event in record.events:
        arrays += _arrays(event, steps)
    numbers = packing.add(HISTORIES, arrays)
    if numbers is None:
        return None
    remaining = iter(numbers)
    return {
        "start": [next(remaining) for _ in record.start.buffers],
        "largest": record.largest,
        "single": record.single,
        "events": [_event(event, remaining, texts) for event in record.events],
    }


def _arrays(event: DrawEvent | ClearEvent | WriteEvent, steps: Steps) -> list[np.ndarray]:
    """Return the arrays of an event, in the order in which `_event` takes their numbers.

    Colours are stored as the difference from those at the end of the step, which is mostly 0.
    """
    if isinstance(event, WriteEvent):
        return list(event.buffers)
    if isinstance(event, ClearEvent):
        return []
    end, triangles = steps[event.step].image, event.triangles
    colors = [np.where(written[..., None], color - end, np.uint8(0)) for color, written in event.colors]
    origins = [] if event.origins is None else [event.origins.owners, event.origins.numbers]
    return [triangles.corners, triangles.depth, triangles.sides, triangles.ids, *event.alphas, *colors, *origins]


def _event(event: DrawEvent | ClearEvent | WriteEvent, numbers: Any, texts: list[Any]) -> dict[str, Any]:
    if isinstance(event, WriteEvent):
        return {"kind": "write", "step": event.step, "name": event.name, "buffers": [next(numbers) for _ in range(3)]}
    if isinstance(event, ClearEvent):
        return {"kind": "clear", **asdict(event), "region": list(event.region)}
    return {
        "kind": "draw",
        "step": event.step,
        "draw": event.draw,
        "object": event.object,
        "region": list(event.region)[:4],
        "downwards": event.region.downwards,
        "culled": event.culled,
        "depth_range": event.depth_range,
        "ops": [{name: int(value) for name, value in ops._asdict().items()} for ops in event.ops],
        "words": {facing: _number(words, texts) for facing, words in event.words.items()},
        "colored": event.colored,
        "triangles": {name: next(numbers) for name in ("corners", "depth", "sides", "ids")},
        "alphas": [next(numbers) for _ in event.alphas],
        "colors": [next(numbers) for _ in event.colors],
        "origins": _origins(event, numbers),
    }


def _origins(event: DrawEvent, numbers: Any) -> dict[str, Any] | None:
    if event.origins is None:
        return None
    return {"names": event.origins.names, "owners": next(numbers), "numbers": next(numbers)}


def _number(words: dict[str, str], texts: list[Any]) -> int:
    """Return the number of words among the texts of the page, to which they are added."""
    if words not in texts:
        texts.append(words)
    return texts.index(words)
