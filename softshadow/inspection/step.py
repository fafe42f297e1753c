"""The steps of a run: the buffers, maps and GL state after each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, overload

import numpy as np

from softshadow.context import Frame
from softshadow.errors import nearest
from softshadow.inspection.maps import Maps
from softshadow.inspection.pictures import Shown, contact_sheet, depth_picture, map_pictures, notebook_display
from softshadow.inspection.replay import Buffers, Replay
from softshadow.inspection.step_state import StepState, step_state
from softshadow.inspection.words import (
    colors_in_words,
    counts_in_words,
    depths_in_words,
    maps_in_words,
    visibility_in_words,
)
from softshadow.pipeline.commands import Clear, Command, Draw
from softshadow.pipeline.geometry.draw_primitives import primitive_count


@dataclass(frozen=True)
class DrawSummary:
    """One draw of a step: `draw` is its index in the frame, `object` the innermost debug group around it."""

    draw: int
    object: str
    mode: str
    triangles: int
    framebuffer: int


@dataclass(frozen=True, eq=False)
class Step:
    """One step: the window's buffers when it ended, and its commands.

    `maps` are the named buffers that the technique yielded with it, row 0 on top. `run_name` is what its run is called,
    such as "volume-zfail on torus".
    """

    index: int
    title: str
    maps: Maps
    frame: Frame
    replay: Replay
    run_name: str = ""

    @property
    def buffers(self) -> Buffers:
        """Colour with alpha, depth and stencil at the end of the step."""
        return self.replay.after_step(self.index)

    @cached_property
    def image(self) -> np.ndarray:
        """(H, W, 3) uint8, row 0 on top."""
        image = np.ascontiguousarray(self.buffers.color[..., :3])
        image.setflags(write=False)
        return image

    @property
    def depth(self) -> np.ndarray:
        """(H, W) float32 window z, row 0 on top."""
        return self.buffers.depth

    @property
    def stencil(self) -> np.ndarray:
        """(H, W) uint8, row 0 on top."""
        return self.buffers.stencil

    @property
    def first_command(self) -> int:
        """The index of the first command of the step."""
        return self.frame.steps[self.index - 1][1] if self.index else 0

    @property
    def commands(self) -> list[Command]:
        """The recorded commands of the step."""
        return self.frame.commands[self.first_command : self.frame.steps[self.index][1]]

    @cached_property
    def state(self) -> StepState:
        """The state of the last draw or clear up to the end of the step; printed, it is the GL calls that set it.

        It has the matrices, the samplers of bound textures and the uniforms of the program, too.
        """
        end = self.frame.steps[self.index][1]
        for index in range(end - 1, -1, -1):
            command = self.frame.commands[index]
            if isinstance(command, Draw | Clear):
                return step_state(command, self.frame.commands[:index])
        return StepState()

    @property
    def draws(self) -> tuple[DrawSummary, ...]:
        """The draws of the step, in order."""
        first = sum(isinstance(command, Draw) for command in self.frame.commands[: self.first_command])
        draws = [command for command in self.commands if isinstance(command, Draw)]
        return tuple(
            DrawSummary(
                first + i,
                object_of(command),
                command.mode_name,
                primitive_count(command),
                command.state.draw_framebuffer,
            )
            for i, command in enumerate(draws)
        )

    def __repr__(self) -> str:
        return f"Step({self.index}, {self.title!r}, {len(self.draws)} {'draw' if len(self.draws) == 1 else 'draws'})"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Shown:
        """Return what a notebook displays: colour, depth and stencil after the step, and its maps."""
        return notebook_display(repr(self), sheet_of([self]), self.describe())

    def describe(self) -> str:
        """Return what the pictures of the step show, in words: counts of pixels, ranges of depths, what changed.

        Examples
        --------
        >>> import softshadow as ss
        >>> print(ss.run("volume-zfail", "torus", (64, 48))["count back faces"].describe())
        volume-zfail on torus, step 1 of 0 to 3, count back faces. Colour: ...; stencil: 0 in ... pixels, ...
        """
        width, height = self.frame.size
        run = f"{self.run_name}, " if self.run_name else ""
        where = f"{run}step {self.index} of 0 to {len(self.frame.steps) - 1}, {self.title}"
        return f"{where}. {sentence(step_in_words(self))} The window has {width} x {height} pixels."


def step_in_words(step: Step, before: Step | None = None) -> str:
    """Return what the pictures of a step show: those of `shown_buffers`, and the shadows.

    `before` is the step before it, if that was described already: buffers that are the same are not described again.
    """
    maps = step.maps.stored
    parts = [f"map {maps_in_words(maps)}"] if maps else []
    if not maps or not all(draw.framebuffer for draw in step.draws):
        earlier = step.replay.after_step(step.index - 1) if step.index else None
        window = {
            "colour": colors_in_words(step.image, None if earlier is None else earlier.color[..., :3]),
            "depth": depths_in_words(step.depth),
            "stencil": counts_in_words(step.stencil),
        }
        same = [name for name in window if before is not None and same_buffer(name, step, before)]
        parts = [f"{name}: {words}" for name, words in window.items() if name not in same] + parts
        parts += [f"{' and '.join(same)} as before"] if same else []
    if "visibility" in step.maps:
        parts.append(visibility_in_words(step.maps["visibility"], step.maps.get("valid")))
    return "; ".join(parts)


def same_buffer(name: str, one: Step, other: Step) -> bool:
    """Return whether a buffer of the window ("colour", "depth", "stencil") is the same after two steps."""
    attribute = {"colour": "image"}.get(name, name)
    return np.array_equal(getattr(one, attribute), getattr(other, attribute))


def sentence(words: str) -> str:
    """Return words as a sentence, with a large letter and a full stop."""
    return f"{words[:1].upper()}{words[1:]}."


def sheet_of(steps: Sequence[Step]) -> np.ndarray:
    """Return a contact sheet of steps: a picture with colour, depth, stencil and maps after each."""
    rows = [(f"{step.index}  {step.title}", shown_buffers(step)) for step in steps]
    return contact_sheet(rows, size=steps[0].frame.size)


def shown_buffers(step: Step) -> dict[str, np.ndarray]:
    """Return the pictures that show what a step did: the window's buffers and the maps, by name.

    The window is left out of a step that drew into textures only.
    """
    maps = map_pictures(step.maps.stored)
    if maps and all(draw.framebuffer for draw in step.draws):
        return maps
    return {"colour": step.image, "depth": depth_picture(step.depth), "stencil": step.stencil, **maps}


def object_of(command: Draw) -> str:
    """Return the name of the object that a draw belongs to: the innermost debug group around it."""
    return command.label.rsplit("/", 1)[-1]


class Steps(Sequence[Step]):
    """The steps of a run, by index or title."""

    def __init__(self, steps: Sequence[Step]) -> None:
        self._steps = tuple(steps)

    def __len__(self) -> int:
        return len(self._steps)

    def __iter__(self) -> Iterator[Step]:
        return iter(self._steps)

    @property
    def titles(self) -> list[str]:
        """The titles of the steps, in order."""
        return [step.title for step in self._steps]

    def _ipython_key_completions_(self) -> list[str]:
        """Return what completes `run["`."""
        return self.titles

    @property
    def maps(self) -> Maps:
        """The named maps of all steps; if several steps have one of the same name, the last."""
        return Maps((name, array) for step in self._steps for name, array in step.maps.items())

    @overload
    def __getitem__(self, key: int | str) -> Step: ...
    @overload
    def __getitem__(self, key: slice) -> Sequence[Step]: ...
    def __getitem__(self, key: int | str | slice) -> Step | Sequence[Step]:
        """Return a step.

        Raises
        ------
        KeyError                     no step has that title; the message has the nearest one
        IndexError                   there are fewer steps
        TypeError                    the key is neither a number nor a title
        """
        if isinstance(key, str):
            for step in self._steps:
                if step.title == key:
                    return step
            raise KeyError(f"no step has the title {key!r}: {nearest(key, self.titles)}")
        if isinstance(key, slice):
            return self._steps[key]
        if isinstance(key, bool) or not isinstance(key, int | np.integer):
            raise TypeError(f"step {key!r}: expected its number or its title")
        if not -len(self._steps) <= key < len(self._steps):
            raise IndexError(f"step {key}: there are {len(self._steps)}, numbered from 0")
        return self._steps[key]

    def __repr__(self) -> str:
        return "\n".join(f"{step.index}  {step.title}" for step in self._steps)
