"""Fonts, shapes and callbacks are those of freeglut 3.4, which runs the same programs under Xvfb."""

from collections.abc import Iterator
from itertools import repeat
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from recordings.logged_calls import LoggedGL
from softshadow.windows import run_script
from softshadow.windows.glut import drawing, fonts
from windows import real_freeglut
from windows.freeglut_programs import CALLBACKS, CALLS, FONTS, SHAPES

pytestmark = pytest.mark.slow
POINTERS = {"glVertexPointer": "positions", "glNormalPointer": "normals", "glTexCoordPointer": "texcoords"}


def written(folder: Path, text: str) -> Path:
    path = folder / "program.py"
    path.write_text(text)
    return path


@pytest.mark.parametrize("text", [FONTS, SHAPES], ids=["fonts", "shapes"])
def test_pixels_depths_and_numbers_are_those_of_freeglut(tmp_path: Path, text: str) -> None:
    real_freeglut.need()
    program = written(tmp_path, text)
    real_freeglut.run(program, str(tmp_path / "real.npz"))
    run_script(program, [str(tmp_path / "here.npz")])
    with np.load(tmp_path / "real.npz") as real, np.load(tmp_path / "here.npz") as here:
        if real["version"] != here["version"]:
            pytest.skip(f"this is freeglut {real['version']}, not {here['version']}")
        assert set(real.files) == set(here.files)
        differing = [name for name in real.files if not np.array_equal(real[name], here[name])]
        assert differing == []
        assert any(real[name].any() for name in real.files if name.endswith("color"))


def single(calls: list[tuple[str, list[Any]]]) -> Iterator[tuple[str, list[Any]]]:
    """Yield the calls; instead of glMultiDraw... the calls for which it stands."""
    for name, arguments in calls:
        if name == "glMultiDrawElements":
            mode, counts, kind, places, _ = arguments
            yield from (("glDrawElements", [mode, *each]) for each in zip(counts, repeat(kind), places, strict=False))
        elif name == "glMultiDrawArrays":
            mode, firsts, counts, _ = arguments
            yield from (("glDrawArrays", [mode, *each]) for each in zip(firsts, counts, strict=True))
        else:
            yield name, arguments


def drawn(calls: list[tuple[str, list[Any]]]) -> list[tuple[Any, ...]]:
    """Return the calls that draw and change state; draws from arrays with the arrays that they read."""
    rows: list[tuple[Any, ...]] = []
    arrays: dict[str, bytes] = {}
    for name, arguments in single(calls):
        plain = [bytes(each) if isinstance(each, np.ndarray | bytes) else each for each in arguments]
        if name in POINTERS:
            arrays[POINTERS[name]] = plain[-1]
        elif name in ("glDrawArrays", "glDrawElements"):
            n = max(np.frombuffer(plain[3], np.uint16)) + 1 if name == "glDrawElements" else plain[1] + plain[2]
            sizes = {"positions": 12 * n, "normals": 12 * n, "texcoords": 8 * n}
            rows.append((name, *plain, {key: array[: sizes[key]] for key, array in arrays.items()}))
        elif name == "glDisableClientState":
            arrays.clear()
            rows.append((name, *plain))
        else:
            rows.append((name, *plain))
    return rows


def test_gl_calls_are_those_of_freeglut(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    real_freeglut.need("apitrace")
    program = written(tmp_path, CALLS)
    traced = real_freeglut.traced_calls(program, str(tmp_path / "real.npz"))
    first = next(number for number, call in enumerate(traced) if call.name == "glPushClientAttrib")
    real = drawn([(call.name, call.arguments) for call in traced[first:] if call.name != "glFlush"])
    log = LoggedGL()
    for module in (drawing, fonts):
        monkeypatch.setattr(module, "gl", log)
    run_script(program, [str(tmp_path / "here.npz")])
    here = drawn([(name, list(arguments)) for name, arguments in log.calls])
    assert len(real) == len(here)
    for number, (theirs, ours) in enumerate(zip(real, here, strict=True)):
        assert theirs == ours, number
    assert len(here) > 20_000


KEYS: dict[str, str | int] = {  # names of X11 for each key
    "a": "a", "Shift+a": "Shift_L,a", "Ctrl+c": "Control_L,c", "Alt+x": "Alt_L,x", "Up": "Up", "Shift+F5": "Shift_L,F5",
    "WheelUp": 4, "WheelDown": 5, "Delete": "Delete", "Esc": "Escape", "Enter": "Return", "Ctrl+/": "Control_L,slash",
    "Ctrl+3": "Control_L,3", "Shift+1": "Shift_L,1", "Shift+Ctrl+a": "Shift_L,Control_L,a", "Tab": "Tab",
    "Ctrl+Space": "Control_L,space", "Backspace": "BackSpace", "PageDown": "Next", "A": "Shift_L,a",
}  # fmt: skip
CLICKS = [(30, 40), (50, 20, "middle"), (5, 5, "right")]
BUTTONS = {"left": 1, "middle": 2, "right": 3}


def merged(lines: list[str]) -> list[str]:
    """Return the lines, without those that repeat the line before: X11 tells twice that the pointer has come."""
    return [line for before, line in zip(["", *lines], lines, strict=False) if line != before]


def callbacks(folder: Path, events: list[tuple[Any, ...]], last: int, **here: Any) -> tuple[list[str], list[str]]:
    """Return what freeglut calls for events, and what is called here."""
    real_freeglut.need()
    program = written(folder, CALLBACKS)
    real_freeglut.run(program, str(folder / "real.txt"), repr(events), str(last))
    run_script(program, [str(folder / "here.txt"), "[]", str(last)], **here)
    real, ours = ((folder / name).read_text().splitlines() for name in ("real.txt", "here.txt"))
    return merged(real), ours


def test_keys_call_what_they_call_in_freeglut(tmp_path: Path) -> None:
    keys = [("wheel", key) if isinstance(key, int) else ("keys", *key.split(",")) for key in KEYS.values()]
    events = [("move", 0, 0), *keys]
    real, here = callbacks(tmp_path, events, len(events) + 1, keys=",".join(KEYS))
    # there, a frame more: the pointer comes
    entered = real.index("display 2")
    del real[entered - 2 : entered + 1]
    plain = [line for line in real if not line.startswith("display")]
    assert plain == [line for line in here if not line.startswith("display")]
    assert len(plain) > 2 * len(KEYS)


def test_clicks_and_drags_call_what_they_call_in_freeglut(tmp_path: Path) -> None:
    places = [(x, y, BUTTONS[button[0] if button else "left"]) for x, y, *button in CLICKS]
    events = [*(("click", *place) for place in places), ("drag", 10, 20, 40, 60, 1)]
    real, here = callbacks(tmp_path, events, 5, clicks=CLICKS, drags=[(10, 20, 40, 60)])
    assert real == here
    assert len(real) > 20
