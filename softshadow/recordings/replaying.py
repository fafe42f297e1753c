"""`replay`: a frame of a program that apitrace has recorded, as a `Run`."""

from __future__ import annotations

import operator
import os
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from softshadow import errors
from softshadow.context import make_current, thread
from softshadow.errors import CallsLeftOut, DrawsLeftOut, TraceError
from softshadow.recordings.frames import Frames, TracedFrame, find_frames
from softshadow.recordings.left_out import DRAWN_BY_SHADER, LeftOut
from softshadow.recordings.player import Player
from softshadow.recordings.recorded_run import run_of
from softshadow.recordings.steps import check_way
from softshadow.runs import Run
from softshadow.runs.perform import checked_size
from softshadow.traces import Trace

MOST_WARNINGS = 20


@dataclass(frozen=True, eq=False)
class Replayed:
    """A replayed frame: the run, its number, and every call that was left out from the beginning of the trace on."""

    run: Run
    frame: int
    left_out: tuple[LeftOut, ...]


def replay(
    path: str | os.PathLike[str],
    frame: int = 0,
    until: int | None = None,
    steps: str = "auto",
    size: tuple[int, int] | None = None,
) -> Run:
    """Return a frame of a recorded program: its picture, steps, and the history of every pixel.

    The file is a trace of apitrace (docs/replay.md). Earlier frames leave state, textures and what the window shows,
    and are no part of the run. Calls that cannot be carried out are left out and named by the warnings of the run.

    Parameters
    ----------
    path : path of a .trace file
    frame : int                  from 0; -1 is the last one
    until : int                  the number of a call: the frame that contains it, up to this call
    steps : str                  "groups" (the program's debug groups, or draws under one state if it has none),
                                 "draws", "clears", or "auto": the finest with few enough steps to read
    size : (width, height)       of the window; by default, what the frame's viewports need

    Raises
    ------
    SoftShadowError              the file cannot be read, or needs a library that is not installed
    TraceError                   it is damaged or ends before the frame does
    ValueError                   there is no such frame, call or way to divide it
    """
    replayed = replay_frame(path, frame, until, steps, size)
    for entry in replayed.left_out:
        if entry.in_frame:
            warnings.warn(_warning(entry), stacklevel=2)
    return replayed.run


def frames_of(path: str | os.PathLike[str]) -> Frames:
    """Return all frames of a trace, as far as the file can be read."""
    return find_frames(Trace(path))


def replay_frame(
    path: str | os.PathLike[str],
    frame: int = 0,
    until: int | None = None,
    steps: str = "auto",
    size: tuple[int, int] | None = None,
) -> Replayed:
    """Return a frame as `replay` does, with the calls that were left out."""
    check_way(steps)
    if size is not None:
        size = checked_size(size)
    number = _whole("frame", frame)
    last_call = None if until is None else _whole("until", until)
    found = find_frames(Trace(path), number, last_call)
    index = _index_of(found, str(path), number, last_call)
    chosen = found.frames[index]
    for width_and_height in chosen.sizes.values():
        checked_size(size or width_and_height)
    player = _play(str(path), found.frames[: index + 1], chosen.last if last_call is None else last_call, size)
    recording = player.chosen.frame
    options: dict[str, Any] = {"program": Path(path).name, "frame": index}
    if last_call is not None:
        options["until"] = last_call
    messages = _warnings(player, chosen)
    run = run_of("replay", recording, options, messages, steps)
    return Replayed(run, index, tuple(player.left_out))


def _whole(name: str, value: Any) -> int:
    try:
        return operator.index(value)
    except TypeError:
        raise ValueError(f"{name}={value!r}: expected a whole number") from None


def _index_of(found: Frames, path: str, number: int, until: int | None) -> int:
    """Return the index of the frame that was asked for."""
    n_frames, damage = len(found.frames), found.damage
    if until is not None:
        for index, each in enumerate(found.frames):
            if each.first <= until <= each.last:
                return index
        last = found.frames[-1].last
        raise damage or ValueError(f"until={until}: {path} has calls 0 to {last}")
    index = number + n_frames if number < 0 else number
    if not 0 <= index < n_frames:
        if damage is not None:
            raise TraceError(f"{damage} (frame {number} was not reached: there are {n_frames})")
        raise ValueError(f"frame={number}: {path} has {n_frames} frames, 0 to {n_frames - 1}")
    if damage is not None and not found.frames[index].is_complete:
        raise TraceError(
            f"{damage}; frame {index} is not complete: until={found.frames[index].last} shows it up to the last call "
            "that can be read"
        )
    return index


def _play(path: str, frames: list[TracedFrame], last: int, size: tuple[int, int] | None) -> Player:
    """Return a player that has made the calls up to the last one."""
    before = thread.context
    try:
        player = Player(frames, size)
        for call in Trace(path):
            if call.number > last:
                break
            player.play(call)
            if call.number == last:
                break
        player.chosen.finish()
        return player
    finally:
        make_current(before)


def _warning(entry: LeftOut) -> errors.Warning:
    if entry.kind == DRAWN_BY_SHADER:
        return DrawsLeftOut(f"{entry}: this package has the fixed function only")
    return CallsLeftOut(str(entry))


def _warnings(player: Player, chosen: TracedFrame) -> tuple[errors.Warning, ...]:
    """Return what a run tells of calls that were left out, those of its frame first."""
    entries = sorted(player.left_out, key=lambda entry: (not entry.in_frame, entry.kind != DRAWN_BY_SHADER))
    messages = [_warning(entry) for entry in entries[:MOST_WARNINGS]]
    if len(entries) > MOST_WARNINGS:
        messages.append(CallsLeftOut(f"and {len(entries) - MOST_WARNINGS} more kinds of calls"))
    others = [address for address in chosen.sizes if address != chosen.context]
    if others:
        listed = ", ".join(hex(address) for address in others)
        messages.append(CallsLeftOut(f"the picture is that of context {chosen.context:#x}; there are also {listed}"))
    return tuple(messages)
