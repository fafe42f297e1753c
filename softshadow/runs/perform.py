"""`run`: draw a scene with a technique, and record every step."""

from __future__ import annotations

import operator
import os
import sys
import threading
import warnings
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from softshadow import errors, techniques
from softshadow import tokens as gl_tokens
from softshadow.context import Context, make_current
from softshadow.errors import CounterSaturated, StateError
from softshadow.framebuffer import LARGEST_SIDE
from softshadow.inspection import Maps, Replay, Step, Steps
from softshadow.inspection.replay import BUDGET
from softshadow.pipeline.commands import Draw
from softshadow.runs.issue_once import issue_once
from softshadow.runs.lost_counts import lost_counts
from softshadow.runs.result import Run
from softshadow.scene import Scene
from softshadow.techniques import Steps as TechniqueSteps
from softshadow.techniques import Technique

BYTES_PER_PIXEL = 256  # at the peak; up to 175 were measured, mostly for the inputs of shading with a texture
# recording warnings replaces the filters of the whole process, so only one run may do it at a time
_one_at_a_time = threading.RLock()


def run(
    technique: str | Technique | Callable[..., TechniqueSteps],
    scene: Scene | str,
    size: tuple[int, int] = (640, 480),
    *,
    depth_format: str = "d24",
    stencil_bits: int = 8,
    precision: str = "mesa",
    polygon_offset_slope: str = "max",
    polygon_offset_unit: str = "mesa",
    keep_bytes: int = BUDGET,
    **options: Any,
) -> Run:
    """Draw a scene with a technique, and return the recorded run.

    The run has a context of its own; afterwards the caller's context is current again.

    Parameters
    ----------
    technique                    a name of `technique_names`, a Technique, or a generator function
                                 ``steps(gl, scene, *, size, option=default ...)``
    scene : Scene or str         a scene, or a name of `scene_names`
    size : (width, height)       pixels
    depth_format, stencil_bits, precision, polygon_offset_slope, polygon_offset_unit : as in `gl.create_context`
    keep_bytes : int             how many bytes of the steps' buffers to keep; the others are replayed when needed
    options                      of the technique; `describe` lists them

    Raises
    ------
    ValueError, TypeError        an unknown technique, scene or option (with the nearest name), or an invalid size; a
                                 generator that yields no step, or anything else than a title or a title with maps
    StateError                   the buffers do not fit in memory
    """
    technique = techniques.get(technique)
    scene = Scene.named(scene) if isinstance(scene, str) else scene
    if not isinstance(scene, Scene):
        raise TypeError(f"scene={scene!r}: expected a Scene or the name of one")
    width, height = checked_size(size)
    options = technique.validate_options(options)
    offset = polygon_offset_slope, polygon_offset_unit
    context = Context(width, height, depth_format, stencil_bits, precision, *offset, compiles=False)
    replay = Replay(context.frame, keep_bytes)
    maps, caught = _draw(technique, scene, context, replay, options)
    own = [message for message in (*scene.warnings(), *caught) if isinstance(message, errors.Warning)]
    run_name = f"{technique.name} on {scene.name}"
    titles = [title for title, _ in context.frame.steps]
    steps = Steps([Step(i, title, maps[i], context.frame, replay, run_name) for i, title in enumerate(titles)])
    if not any(isinstance(message, CounterSaturated) for message in own):
        own += saturated(steps, stencil_bits)
    own += lost_counts(technique.name, scene, (width, height), options, stencil_bits)
    for message in own:
        issue_once(message, sys._getframe(1))
    return Run(technique.name, scene, (width, height), options, tuple(own), steps, context.frame)


def _draw(
    technique: Technique, scene: Scene, context: Context, replay: Replay, options: Mapping[str, Any]
) -> tuple[list[Maps], list[Any]]:
    """Draw the steps in the context; return the maps of each step, and the warnings that were issued meanwhile."""
    from softshadow import gl

    maps: list[Maps] = []
    with _one_at_a_time, warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        before = make_current(context)
        try:
            for index, item in enumerate(technique.steps(gl, scene, size=context.frame.size, **options) or ()):
                title, named = _title_and_maps(technique.name, item)
                context.end_step(title)
                maps.append(Maps((name, top_row_first(array)) for name, array in named.items()))
                replay.cache_window(index, context.storage.window)
        finally:
            make_current(before)
    if not maps:
        raise ValueError(f'technique {technique.name!r} yielded no step; expected `yield "title"` after each step')
    for warning in caught:  # those of other packages are passed on
        if not isinstance(warning.message, errors.Warning):
            warnings.warn_explicit(warning.message, warning.category, warning.filename, warning.lineno)
    return maps, [warning.message for warning in caught]


def _title_and_maps(technique: str, item: Any) -> tuple[str, Mapping[str, Any]]:
    match item:
        case str():
            return item, {}
        case (str() as title, Mapping() as maps):
            return title, maps
    raise TypeError(f"technique {technique!r} yielded {item!r}; expected a title, or (title, {{name: map}})")


def top_row_first(array: Any) -> np.ndarray:
    """Return an array with its rows flipped, from GL's order to row 0 on top, read-only; rows are flipped only here."""
    flipped = np.ascontiguousarray(np.asarray(array)[::-1])
    flipped = flipped.astype(np.float32) if flipped.dtype == np.float64 else flipped
    flipped.setflags(write=False)
    return flipped


def checked_size(size: Any) -> tuple[int, int]:
    """Return width and height.

    Raises
    ------
    ValueError                   not two whole numbers from 1 to 16384
    StateError                   the buffers would not fit in the machine's memory
    """
    try:
        width, height = (operator.index(side) for side in size)
    except (TypeError, ValueError):
        raise ValueError(f"size={size!r}: expected (width, height), two whole numbers of pixels") from None
    for name, side in (("width", width), ("height", height)):
        if not 1 <= side <= LARGEST_SIDE:
            raise ValueError(f"size={size!r}: expected a {name} from 1 to {LARGEST_SIDE} pixels")
    needed, available = width * height * BYTES_PER_PIXEL, memory()
    if needed > available:
        raise StateError(
            f"size={size!r}: drawing needs about {needed / 1e9:.1f} GB and this machine has {available / 1e9:.1f}; "
            "expected a smaller picture"
        )
    return width, height


def memory() -> float:
    """Return the machine's memory in bytes; infinite if the system does not tell."""
    try:
        return float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    except (AttributeError, ValueError, OSError):
        return float("inf")


def saturated(steps: Steps, stencil_bits: int) -> list[CounterSaturated]:
    """Return a warning for the first step that counts with GL_INCR and leaves a stencil value at the maximum."""
    largest = (1 << stencil_bits) - 1
    for step in steps:
        counts_up = any(
            gl_tokens.GL_INCR in (face.sfail, face.zfail, face.zpass)
            for command in step.commands
            if isinstance(command, Draw) and command.state.stencil.enabled
            for face in (command.state.stencil.front, command.state.stencil.back)
        )
        pixels = int(np.count_nonzero(step.stencil == largest)) if counts_up else 0
        if pixels:
            return [
                CounterSaturated(
                    f"step {step.title!r}: {pixels} pixels have the largest count, {largest}; GL_INCR stops there, so "
                    "higher counts are lost, and shadow may turn into light"
                )
            ]
    return []
