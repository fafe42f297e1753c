"""What a user does at a program's window: keys, clicks, drags, turns of the wheel, and choices from menus."""

from __future__ import annotations

import re
from dataclasses import dataclass

# names of keys for --keys that no single character spells
SPECIAL_KEYS = ("Up", "Down", "Left", "Right", "PageUp", "PageDown", "Home", "End", "Insert",
                *(f"F{number}" for number in range(1, 13)))  # fmt: skip
NAMED_CHARACTERS = {
    "Space": " ", "Enter": "\r", "Tab": "\t", "Esc": "\x1b", "Comma": ",", "Backspace": "\b", "Delete": "\x7f",
}  # fmt: skip
SYNONYMS = {"Escape": "Esc", "Return": "Enter"}
MODIFIERS = ("Shift", "Ctrl", "Alt")
WHEELS = {"WheelUp": 1, "WheelDown": -1}
BUTTONS = ("left", "middle", "right")
# what Shift makes of characters on a US keyboard, besides capital letters
SHIFTED = dict(zip("`1234567890-=[]\\;',./", '~!@#$%^&*()_+{}|:"<>?', strict=True))
WITH_MODIFIERS = re.compile(rf"((?:(?:{'|'.join(MODIFIERS)})\+)*)(.+)", re.DOTALL)


@dataclass(frozen=True)
class Key:
    """A key that is pressed: a character, or one of `SPECIAL_KEYS`; `modifiers` are held down meanwhile."""

    name: str
    modifiers: tuple[str, ...] = ()

    @property
    def is_special(self) -> bool:
        """Whether the key has no character."""
        return self.name in SPECIAL_KEYS


@dataclass(frozen=True)
class Click:
    """A click of a button: x from the left, y from the top."""

    x: int
    y: int
    button: str = "left"


@dataclass(frozen=True)
class Drag:
    """A button pressed at (x, y), and released at (to_x, to_y)."""

    x: int
    y: int
    to_x: int
    to_y: int
    button: str = "left"


@dataclass(frozen=True)
class Wheel:
    """A turn of the mouse wheel: 1 up, -1 down."""

    direction: int


@dataclass(frozen=True)
class Choice:
    """An entry of a GLUT menu, named by its label; "colour/red" is the entry "red" of the submenu "colour"."""

    label: str


Event = Key | Click | Drag | Wheel | Choice


def keys_of(text: str) -> list[Event]:
    """Return what a text such as "a,Ctrl+Up,WheelDown,Menu:red" names.

    Raises
    ------
    ValueError                   a name is neither a character nor that of a key

    Examples
    --------
    >>> keys_of("a,Shift+Up,Space")
    [Key(name='a', modifiers=()), Key(name='Up', modifiers=('Shift',)), Key(name=' ', modifiers=())]
    >>> keys_of("Escape") == keys_of("Esc")
    True
    """
    return [_named(text, name) for name in text.split(",")] if text else []


def _named(text: str, name: str) -> Event:
    if name in WHEELS:
        return Wheel(WHEELS[name])
    if name.startswith("Menu:") and len(name) > len("Menu:"):
        return Choice(name.removeprefix("Menu:"))
    found = WITH_MODIFIERS.fullmatch(name)
    held, key = found.groups() if found else ("", name)
    key = SYNONYMS.get(key, key)
    spelled = NAMED_CHARACTERS.get(key, key)
    if len(spelled) != 1 and spelled not in SPECIAL_KEYS:
        names = ", ".join((*NAMED_CHARACTERS, *SPECIAL_KEYS, *WHEELS))
        raise ValueError(
            f"keys={text!r}: {name!r} is no key; expected a character or one of {names}, after Shift+, Ctrl+ or Alt+ "
            "if they are held, or Menu: and the label of a menu's entry"
        )
    modifiers = held.rstrip("+").split("+") if held else []
    if len(spelled) == 1:
        if "Shift" in modifiers:
            spelled = SHIFTED.get(spelled, spelled.upper())
        if spelled in SHIFTED.values() or "A" <= spelled <= "Z":
            modifiers.append("Shift")
    return Key(spelled, tuple(each for each in MODIFIERS if each in modifiers))


def click_of(place: tuple[int, int] | tuple[int, int, str]) -> Click:
    """Return the click that (x, y) or (x, y, "right") names.

    Raises
    ------
    ValueError                   the button is none
    """
    x, y, *button = place
    return Click(int(x), int(y), _button(button[0] if button else "left"))


def drag_of(way: tuple[int, int, int, int] | tuple[int, int, int, int, str]) -> Drag:
    """Return the drag that (x, y, to_x, to_y) or (x, y, to_x, to_y, "right") names.

    Raises
    ------
    ValueError                   the button is none
    """
    x, y, to_x, to_y, *button = way
    return Drag(int(x), int(y), int(to_x), int(to_y), _button(button[0] if button else "left"))


def _button(name: object) -> str:
    if name not in BUTTONS:
        raise ValueError(f"button {name!r}: expected {', '.join(BUTTONS)}")
    return str(name)
