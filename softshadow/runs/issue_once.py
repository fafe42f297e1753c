"""Issue the warnings of a run, each once per line of the program, as Python does.

Python shows equal warnings of a line once, but forgets what it has shown whenever the filters change, and recording
the warnings of a technique changes them. Without this file, an animation would show every warning at each frame.
"""

from __future__ import annotations

import re
import warnings
from types import FrameType
from typing import Any

SHOWN = "softshadow"  # key in a module's registry of warnings: those that were shown, which Python does not forget here
REPEATED = ("always", "all", "error")  # actions of a filter under which equal warnings do not count as one


def issue_once(message: Warning, frame: FrameType) -> None:
    """Issue a warning at the line that a frame of the program has reached, unless it was shown there before."""
    names, line = frame.f_globals, frame.f_lineno
    registry: dict[Any, Any] = names.setdefault("__warningregistry__", {})
    module = names.get("__name__") or "<unknown>"
    shown = registry.get(SHOWN, frozenset())
    key = (line, type(message), str(message))
    if key in shown and action(message, module, line) not in REPEATED:
        return
    warnings.warn_explicit(message, None, frame.f_code.co_filename, line, module, registry)
    registry[SHOWN] = shown | {key}


def action(message: Warning, module: str, line: int) -> str:
    """Return what the filters do with a warning: "default", "always", "error" ..."""
    for name, text, kind, place, number in warnings.filters:
        if (
            issubclass(type(message), kind)
            and (text is None or re.match(text, str(message)))
            and (place is None or re.match(place, module))
            and number in (0, line)
        ):
            return name
    return "default"
