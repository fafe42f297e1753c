"""Running a technique on a scene: `run` draws and records it, a `Run` is everything that came of it."""

from __future__ import annotations

import operator
import os
import threading
import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from softshadow import errors, techniques
from softshadow import tokens as gl_tokens
from softshadow.context import Context, Frame, make_current
from softshadow.errors import CounterSaturated, StateError
from softshadow.framebuffer import LARGEST_SIDE
from softshadow.inspection import (
    Buffers,
    Comparison,
    Difference,
    Ledger,
    PixelHistory,
    Replay,
    Step,
    Steps,
    compare,
    difference,
    ledger_of,
    pixel_history,
)
from softshadow.inspection.explanation import explain
from softshadow.inspection.hard_truth import hard_visibility
from softshadow.inspection.replay import BUDGET
from softshadow.pipeline.commands import Draw
from softshadow.scene import Scene
from softshadow.techniques import Technique

__all__ = ["Run", "RunLight", "load_run", "run"]

BYTES_PER_PIXEL = 256  # at the peak; measured up to 175, most of it the inputs of shading with a texture
COUNTING_UP = gl_tokens.GL_INCR
# recording warnings replaces the process-wide filters, so one run at a time may do it
_one_at_a_time = threading.RLock()


@dataclass(frozen=True, eq=False)
class RunLight:
    """What a run says about one light: its name, and its visibility (H, W) float32, row 0 on top."""

    name: str
    visibility: np.ndarray


@dataclass(frozen=True, eq=False, repr=False)
class Run:
    """A technique's drawing of a scene, step by step. Arrays are read-only, row 0 on top, indexed [y, x].

    Attributes
    ----------
    technique : str
    scene : Scene
    size : (width, height)
    options : dict               every option of the technique, as given or by default
    warnings : tuple             what the scene and the technique warned of
    steps : Steps                by index or title, as ``run[2]`` and ``run["count back faces"]`` are
    frame : Frame                the recording
    """

    technique: str
    scene: Scene
    size: tuple[int, int]
    options: Mapping[str, Any]
    warnings: tuple[errors.Warning, ...]
    steps: Steps
    frame: Frame

    # -- buffers -------------------------------------------------------------------------------------------------------
    @property
    def image(self) -> np.ndarray:
        """(H, W, 3) uint8: the picture."""
        return self.steps[-1].image

    @property
    def depth(self) -> np.ndarray:
        """(H, W) float32: window z, 1 where nothing was drawn."""
        return self.steps[-1].depth

    @property
    def stencil(self) -> np.ndarray:
        """(H, W) uint8."""
        return self.steps[-1].stencil

    # -- maps ----------------------------------------------------------------------------------------------------------
    @cached_property
    def maps(self) -> dict[str, np.ndarray]:
        """The named buffers of all steps; of equal names the last one."""
        return {name: array for step in self.steps for name, array in step.maps.items()}

    @property
    def visibility(self) -> np.ndarray:
        """(H, W) float32: 1 lit to 0 in shadow, the mean over the lights; 1 where it is not defined."""
        return self._map("visibility")

    @property
    def valid(self) -> np.ndarray:
        """(H, W) bool: where the visibility is defined."""
        return self._map("valid")

    @cached_property
    def shadow_mask(self) -> np.ndarray:
        """(H, W) bool: where at least one light is not fully seen."""
        mask = self.valid & (self.visibility < 1)
        mask.setflags(write=False)
        return mask

    @property
    def lights(self) -> tuple[RunLight, ...]:
        """The visibility of each light, in the order of the scene."""
        several = len(self.scene.lights) > 1
        return tuple(
            RunLight(light.name, self._map(f"visibility of {light.name}" if several else "visibility"))
            for light in self.scene.lights
        )

    def _map(self, name: str) -> np.ndarray:
        if name not in self.maps:
            raise StateError(f"technique {self.technique!r} has no map {name!r} (it has: {', '.join(self.maps)})")
        return self.maps[name]

    # -- steps ---------------------------------------------------------------------------------------------------------
    def __getitem__(self, key: int | str) -> Step:
        """Return a step by its index or title."""
        return self.steps[key]

    def __len__(self) -> int:
        return len(self.steps)

    def __iter__(self) -> Iterator[Step]:
        return iter(self.steps)

    def diff(self, a: int | str, b: int | str) -> Difference:
        """Return what changed between the ends of two steps, by index or title."""
        return difference(self.steps[a].buffers, self.steps[b].buffers)

    # -- questions -----------------------------------------------------------------------------------------------------
    def pixel(self, x: int, y: int) -> PixelHistory:
        """Return every fragment that met a pixel of the window: x from the left, y from the top.

        Raises
        ------
        ValueError                   outside the picture
        """
        return pixel_history(self.frame, x, y)

    def explain(self, x: int, y: int) -> str:
        """Return one sentence: why a pixel is lit, shaded or dark."""
        history = self.pixel(x, y)
        known = "visibility" in self.maps and "valid" in self.maps
        valid = known and bool(self.valid[history.y, history.x])
        return explain(history, float(self.visibility[history.y, history.x]) if known else None, valid)

    @cached_property
    def ledger(self) -> Ledger:
        """Draws, triangles, fragments by verdict and stencil updates of every step; the frame is played once more."""
        return ledger_of(self.frame)

    def compare(self, other: Run | None = None, *, truth: str | None = None) -> Comparison:
        """Return how the visibility differs from that of another run, or from ray casting.

        Parameters
        ----------
        other : Run                  of the same size
        truth : "hard"               rays from the visible points to the lights, in double precision

        Raises
        ------
        TypeError                    neither a run nor a truth, or both
        ValueError                   another size, or a truth that there is not
        """
        if (other is None) == (truth is None) or not isinstance(other, Run | None):
            raise TypeError('compare(): expected another run, or truth="hard"')
        if other is not None:
            if other.size != self.size:
                raise ValueError(f"compare(): sizes differ, {self.size} and {other.size}; expected the same")
            against = f"{other.technique} on {other.scene.name}"
            return compare(self.visibility, self.valid, other.visibility, other.valid, against)
        if truth == "soft":
            raise ValueError('truth="soft": lights of a size are not part of this version; expected "hard"')
        if truth != "hard":
            raise ValueError(f'truth={truth!r}: expected "hard"')
        visible, seen = hard_visibility(self.scene, self.size)
        mean = np.asarray(np.mean(visible, axis=0, dtype=np.float32))
        return compare(self.visibility, self.valid, mean, seen, "ray casting")

    # -- files and display ---------------------------------------------------------------------------------------------
    def save(self, path: str | os.PathLike[str], force: bool = False) -> Path:
        """Write the run, and return the path.

        ``.png`` is the picture, ``.npz`` everything (`load_run` brings it back), ``.html`` the report; a folder gets
        pictures of every step, the GL state of each, and the npz.

        Raises
        ------
        ValueError                   an ending that is none of these
        SoftShadowError              a file is in the way that this package did not write (`force` overwrites it), or
                                     the place cannot be written; nothing half-written is left
        """
        from softshadow.inspection.saving import save

        return save(self, path, force)

    def __repr__(self) -> str:
        width, height = self.size
        return f"Run({self.technique!r}, scene {self.scene.name!r}, {width} x {height}, {len(self.steps)} steps)"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        """Return what a notebook shows: the steps as a contact sheet."""
        from softshadow.inspection.pictures import sheet_of, shown

        return shown(f"{self!r}\n{self.steps!r}", sheet_of(self.steps))


# -- running -----------------------------------------------------------------------------------------------------------
def run(
    technique: str | Technique,
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
    """Return a technique's drawing of a scene, recorded step by step.

    The context it draws in is its own: the caller's current context is current again afterwards.

    Parameters
    ----------
    technique : str or Technique a name of `technique_names`, or a technique of your own
    scene : Scene or str         a scene, or a name of `scene_names`
    size : (width, height)       pixels
    depth_format, stencil_bits, precision, polygon_offset_slope, polygon_offset_unit : as in `gl.create_context`
    keep_bytes : int             how many bytes of buffers to keep; those of other steps are drawn again when asked for
    options                      of the technique; `describe` lists them

    Raises
    ------
    ValueError, TypeError        an unknown technique, scene or option (with the nearest name), a size that is none
    StateError                   a picture that does not fit in memory
    """
    chosen = technique if isinstance(technique, Technique) else techniques.get(technique)
    drawn = Scene.named(scene) if isinstance(scene, str) else scene
    if not isinstance(drawn, Scene):
        raise TypeError(f"scene={scene!r}: expected a Scene or the name of one")
    width, height = checked_size(size)
    given = chosen.validate_options(options)
    context = Context(width, height, depth_format, stencil_bits, precision, polygon_offset_slope, polygon_offset_unit)
    replay = Replay(context.frame, keep_bytes)
    maps, caught = _draw(chosen, drawn, context, replay, given)
    own = [message for message in (*drawn.warnings(), *caught) if isinstance(message, errors.Warning)]
    steps = Steps([Step(i, title, maps[i], context.frame, replay) for i, (title, _) in enumerate(context.frame.steps)])
    if not any(isinstance(message, CounterSaturated) for message in own):
        own += saturated(steps, stencil_bits)
    for message in own:
        warnings.warn(message, stacklevel=2)
    return Run(chosen.name, drawn, (width, height), given, tuple(own), steps, context.frame)


def _draw(
    technique: Technique, scene: Scene, context: Context, replay: Replay, options: Mapping[str, Any]
) -> tuple[list[dict[str, np.ndarray]], list[Any]]:
    """Run the steps in the context; return the maps of each step and the messages of the warnings given meanwhile."""
    from softshadow import gl

    maps: list[dict[str, np.ndarray]] = []
    with _one_at_a_time, warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        before = make_current(context)
        try:
            for index, item in enumerate(technique.steps(gl, scene, size=context.frame.size, **options)):
                title, named = (item, {}) if isinstance(item, str) else item
                context.end_step(title)
                maps.append({name: top_row_first(array) for name, array in named.items()})
                replay.keep_window(index, context.storage.window)
        finally:
            make_current(before)
    for warning in caught:  # what others warned of is theirs
        if not isinstance(warning.message, errors.Warning):
            warnings.warn_explicit(warning.message, warning.category, warning.filename, warning.lineno)
    return maps, [warning.message for warning in caught]


def top_row_first(array: Any) -> np.ndarray:
    """Return an array of GL's, row 0 at the bottom, with row 0 on top, read-only: the one place that flips."""
    flipped = np.ascontiguousarray(np.asarray(array)[::-1])
    flipped = flipped.astype(np.float32) if flipped.dtype == np.float64 else flipped
    flipped.setflags(write=False)
    return flipped


def checked_size(size: Any) -> tuple[int, int]:
    """Return width and height.

    Raises
    ------
    ValueError                   not two whole numbers from 1 to 16384
    StateError                   the buffers would not fit into the memory of the machine
    """
    try:
        width, height = (operator.index(side) for side in size)
    except (TypeError, ValueError):
        raise ValueError(f"size={size!r}: expected (width, height), two whole numbers of pixels") from None
    for name, side in (("width", width), ("height", height)):
        if not 1 <= side <= LARGEST_SIDE:
            raise ValueError(f"size={size!r}: expected a {name} from 1 to {LARGEST_SIDE} pixels")
    needed, there = width * height * BYTES_PER_PIXEL, memory()
    if needed > there:
        raise StateError(
            f"size={size!r}: drawing needs about {needed / 1e9:.1f} GB and this machine has {there / 1e9:.1f}; "
            "expected a smaller picture"
        )
    return width, height


def memory() -> float:
    """Return the bytes of memory of this machine, infinite where the system does not say."""
    try:
        return float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    except (AttributeError, ValueError, OSError):
        return float("inf")


def saturated(steps: Steps, stencil_bits: int) -> list[CounterSaturated]:
    """Return a warning for the first step that left a counter at its largest value while counting with GL_INCR."""
    largest = (1 << stencil_bits) - 1
    for step in steps:
        counted = any(
            COUNTING_UP in (face.sfail, face.zfail, face.zpass)
            for command in step.commands
            if isinstance(command, Draw) and command.state.stencil.enabled
            for face in (command.state.stencil.front, command.state.stencil.back)
        )
        pixels = int(np.count_nonzero(step.stencil == largest)) if counted else 0
        if pixels:
            return [
                CounterSaturated(
                    f"step {step.title!r}: {pixels} pixels have the largest count, {largest}; GL_INCR stops there, so "
                    "counts beyond it are lost, and shadow may turn into light"
                )
            ]
    return []


def load_run(path: str | os.PathLike[str]) -> Run:
    """Return the run that `Run.save` wrote into an npz, with its recording: pixels and steps answer as before.

    Raises
    ------
    SoftShadowError              there is no such file, or it is not a run of this package
    """
    from softshadow.inspection.saving import load

    contents = load(path)
    replay = Replay(contents.frame)
    for index, buffers in enumerate(contents.buffers):
        replay.keep(index, Buffers(*buffers))
    titles = [title for title, _ in contents.frame.steps]
    steps = Steps([Step(i, title, contents.maps[i], contents.frame, replay) for i, title in enumerate(titles)])
    return Run(
        contents.technique, contents.scene, contents.frame.size, contents.options, contents.warnings, steps,
        contents.frame,
    )  # fmt: skip
