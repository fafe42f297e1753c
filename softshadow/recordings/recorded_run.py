"""A recording of a program as a `Run`, which has no technique and no scene."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from softshadow import errors
from softshadow.context import Frame
from softshadow.inspection import Replay, Step, Steps
from softshadow.inspection.maps import Maps
from softshadow.recordings.steps import divide
from softshadow.runs import Run


def run_of(
    kind: str, frame: Frame, options: Mapping[str, Any], warnings: tuple[errors.Warning, ...], steps: str
) -> Run:
    """Return the run of a recording.

    Parameters
    ----------
    kind : str                   "replay" or "recording"; it stands in place of the technique
    options : dict               "program" is the name of the program
    steps : str                  how to divide the recording, see `divide`
    """
    divide(frame, steps)
    replay = Replay(frame)
    run_name = " ".join([kind, *(["of", str(options["program"])] if options.get("program") else [])])
    titles = [title for title, _ in frame.steps]
    divided = Steps([Step(index, title, Maps(), frame, replay, run_name) for index, title in enumerate(titles)])
    return Run(kind, None, frame.size, options, warnings, divided, frame)
