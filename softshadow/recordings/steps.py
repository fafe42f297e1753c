"""The steps of a recorded program, which has none of its own: by debug groups, draws, equal state, or clears."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from softshadow import tokens as gl
from softshadow.context import Frame
from softshadow.errors import nearest
from softshadow.framebuffer import DEFAULT
from softshadow.pipeline.commands import (
    Accumulate,
    BlitFramebuffer,
    Clear,
    Command,
    CopyToTexture,
    Draw,
    DrawDepths,
)

WAYS = ("auto", "groups", "draws", "clears")
MOST_STEPS = 40  # of "auto": a report with more is hard to read
CALL = re.compile(r"(?:, )?((?:call|(?:[\w.-]+ )?line) \d+)$")  # how replays and programs name where a draw comes from
BUFFERS = {
    gl.GL_COLOR_BUFFER_BIT: "colour", gl.GL_DEPTH_BUFFER_BIT: "depth", gl.GL_STENCIL_BUFFER_BIT: "stencil",
    gl.GL_ACCUM_BUFFER_BIT: "accumulation buffer",
}  # fmt: skip
Part = tuple[str, int]  # title of a step, and the number of commands up to its end


def check_way(steps: str) -> None:
    """Raise an error unless there is such a way to divide a frame.

    Raises
    ------
    ValueError                   with the nearest name
    """
    if steps not in WAYS:
        raise ValueError(f"steps={steps!r}: {nearest(str(steps), WAYS)}")


def divide(frame: Frame, steps: str = "auto") -> None:
    """Divide a recording into steps; one that has steps already keeps them.

    Parameters
    ----------
    steps : str                  "groups": the debug groups of the program, or draws under one state if it has none;
                                 "draws": each call that draws or clears; "clears": what follows each clear; "auto":
                                 debug groups, or the first of draws, groups and clears with at most `MOST_STEPS` steps
    """
    check_way(steps)
    if frame.steps:
        return
    commands = frame.commands
    if steps != "auto":
        parts = list(DIVISIONS[steps](commands))
    elif has_groups(commands):
        parts = list(_by_groups(commands))
    else:
        divided = [list(DIVISIONS[way](commands)) for way in ("draws", "groups", "clears")]
        parts = next((each for each in divided if len(each) <= MOST_STEPS), divided[-1])
    if not parts:
        parts = [("nothing is drawn", 0)]
    title, _ = parts[-1]
    frame.steps[:] = [*parts[:-1], (title, len(frame.commands))]


# -- names -------------------------------------------------------------------------------------------------------------
def groups_of(command: Draw) -> list[str]:
    """Return the debug groups of the program around a draw, without the name of its call."""
    names = [CALL.sub("", name) for name in command.label.split("/")]
    return [name for name in names if name]


def has_groups(commands: list[Command]) -> bool:
    """Return whether the program has named draws by debug groups."""
    return any(isinstance(command, Draw) and groups_of(command) for command in commands)


def call_of(command: Command) -> str:
    """Return "call 12" or "line 12" for a draw that is named by where it comes from, else nothing."""
    match = CALL.search(command.label) if isinstance(command, Draw) else None
    return match[1] if match else ""


def title_of(command: Command, number: int) -> str:
    """Return what a command does; `number` counts draws that have no call."""
    if isinstance(command, Clear):
        names = [name for bit, name in BUFFERS.items() if command.mask & bit]
        return f"clear {', '.join(names) or 'nothing'}{_target(command)}"
    if isinstance(command, Draw):
        return f"{call_of(command) or f'draw {number}'}: {command.mode_name}{_target(command)}"
    if isinstance(command, DrawDepths):
        return f"rectangle of {'depths' if command.has_depth else 'stencil values'}{_target(command.draw)}"
    if isinstance(command, CopyToTexture):
        return f"copy to texture {command.texture}"
    return "copy between framebuffers" if isinstance(command, BlitFramebuffer) else "accumulate"


def _target(command: Draw | Clear) -> str:
    name = command.state.draw_framebuffer
    return "" if name == DEFAULT else f" in framebuffer {name}"


# -- ways to divide ----------------------------------------------------------------------------------------------------
def _visible(commands: list[Command]) -> Iterator[tuple[int, Command]]:
    """Yield the commands that change pixels, each with the number of commands up to its end."""
    for index, command in enumerate(commands):
        if isinstance(command, Draw | DrawDepths | Clear | Accumulate | BlitFramebuffer | CopyToTexture):
            yield index + 1, command


def _by_draws(commands: list[Command]) -> Iterator[Part]:
    """Draws of one call, such as a list, are one step."""
    last, number = "", 0
    parts: list[Part] = []
    for end, command in _visible(commands):
        call = call_of(command)
        if call and call == last:
            parts[-1] = (parts[-1][0], end)
        else:
            parts.append((title_of(command, number), end))
        last = call
        number += isinstance(command, Draw)
    yield from parts


def _by_states(commands: list[Command]) -> Iterator[Part]:
    draws: list[Draw] = []
    end_of_draws = number = 0
    for end, command in _visible(commands):
        if draws and (not isinstance(command, Draw) or command.state != draws[-1].state):
            yield _of_draws(draws, number), end_of_draws
            number += len(draws)
            draws = []
        if isinstance(command, Draw):
            draws.append(command)
            end_of_draws = end
        else:
            yield title_of(command, number), end
    if draws:
        yield _of_draws(draws, number), end_of_draws


def _by_clears(commands: list[Command]) -> Iterator[Part]:
    draws: list[Draw] = []
    title, last = "", 0
    number = 0
    for end, command in _visible(commands):
        if isinstance(command, Clear) and draws:
            yield title or _of_draws(draws, number), last
            title, draws = "", []
        if isinstance(command, Clear):
            cleared = title_of(command, number)
            title = f"{title}, {cleared.removeprefix('clear ')}" if title else cleared
        elif isinstance(command, Draw):
            draws.append(command)
            number += 1
        last = end
    if last:
        yield (title or (_of_draws(draws, 0) if draws else "copies")), last


def _by_groups(commands: list[Command]) -> Iterator[Part]:
    """The outermost groups; what stands between two of them belongs to the second."""
    if not has_groups(commands):
        yield from _by_states(commands)
        return
    name, last = "", 0
    for end, command in _visible(commands):
        if not isinstance(command, Draw):
            last = last or end
            continue
        own = (groups_of(command) or ["outside of debug groups"])[0]
        if name and own != name:
            yield name, last
        name, last = own, end
    if last:
        yield name or "clears", last


def _of_draws(draws: list[Draw], number: int) -> str:
    """Return the title of several draws of which the first has a number."""
    first, last = call_of(draws[0]), call_of(draws[-1])
    if first and last:
        place, _, last_number = last.partition(" ")
        where = first if first == last else f"{place}s {first.partition(' ')[2]} to {last_number}"
    else:
        where = f"draw {number}" if len(draws) == 1 else f"draws {number} to {number + len(draws) - 1}"
    modes = ", ".join(dict.fromkeys(draw.mode_name for draw in draws))
    return f"{where}: {modes}{_target(draws[0])}"


DIVISIONS: dict[str, Callable[[list[Command]], Iterator[Part]]] = {
    "groups": _by_groups,
    "draws": _by_draws,
    "clears": _by_clears,
}
