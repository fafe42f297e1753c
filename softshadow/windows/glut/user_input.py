"""What a key, a click, a drag, the wheel or a menu calls in a GLUT program."""

from __future__ import annotations

from softshadow.windows.desktop import desktop
from softshadow.windows.events import BUTTONS, Choice, Click, Drag, Event, Key, Wheel
from softshadow.windows.glut.program import Program
from softshadow.windows.glut.tokens import TOKENS
from softshadow.windows.glut.window import Window

DOWN, UP = TOKENS["GLUT_DOWN"], TOKENS["GLUT_UP"]
SPECIAL = {
    "Left": 100, "Up": 101, "Right": 102, "Down": 103, "PageUp": 104, "PageDown": 105, "Home": 106, "End": 107,
    "Insert": 108, **{f"F{number}": number for number in range(1, 13)},
}  # fmt: skip
HELD = {"Shift": 112, "Ctrl": 114, "Alt": 116}  # the keys themselves: GLUT_KEY_SHIFT_L and so on
MASKS = {"Shift": 1, "Ctrl": 2, "Alt": 4}
# what X11 makes of Ctrl and a character, where it is no letter
WITH_CTRL = {" ": 0, "2": 0, "3": 27, "4": 28, "5": 29, "6": 30, "7": 31, "8": 127, "/": 31}
WHEEL_BUTTONS = {1: 3, -1: 4}  # for programs without glutMouseWheelFunc


def typed(key: Key) -> bytes:
    r"""Return the character that a key gives.

    Examples
    --------
    >>> typed(Key("a")), typed(Key("a", ("Ctrl",)))
    (b'a', b'\x01')
    """
    if "Ctrl" in key.modifiers:
        if key.name in WITH_CTRL:
            return bytes([WITH_CTRL[key.name]])
        if "@" <= key.name < "\x7f":
            return bytes([ord(key.name) & 0x1F])
    return key.name.encode("latin-1", "replace")


def happen(program: Program, window: Window, event: Event) -> None:
    """Call what the program has registered for an event."""
    if isinstance(event, Key):
        _press(program, window, event)
    elif isinstance(event, Wheel):
        x, y = desktop().pointer
        if not _input(program, window, "MouseWheel", 0, event.direction, x, y):
            for state in (DOWN, UP):
                _input(program, window, "Mouse", WHEEL_BUTTONS[event.direction], state, x, y)
    elif isinstance(event, Choice):
        _choose(program, window, event)
    else:
        _point(program, window, event)


def _input(program: Program, window: Window, name: str, *arguments: object, modifiers: tuple[str, ...] = ()) -> bool:
    """Call a callback for input: within it, glutGetModifiers answers."""
    program.modifiers = sum(MASKS[each] for each in modifiers)
    try:
        return window.call(name, *arguments)
    finally:
        program.modifiers = None


def _press(program: Program, window: Window, key: Key) -> None:
    held = key.modifiers
    for number, name in enumerate(held):
        _input(program, window, "Special", HELD[name], *desktop().pointer, modifiers=held[:number])
    code: object = SPECIAL[key.name] if key.is_special else typed(key)
    for callback in ("Special", "SpecialUp") if key.is_special else ("Keyboard", "KeyboardUp"):
        _input(program, window, callback, code, *desktop().pointer, modifiers=held)
    for number, name in reversed(list(enumerate(held))):
        _input(program, window, "SpecialUp", HELD[name], *desktop().pointer, modifiers=held[: number + 1])


def _point(program: Program, window: Window, event: Click | Drag) -> None:
    move_pointer(program, window, (event.x, event.y))
    button = BUTTONS.index(event.button)
    if button in window.menus:
        desktop().tell(f"a click of the {event.button} button opens a menu; choose from it with --keys Menu:LABEL")
        window.is_posted = True  # the menu has covered a part of it
        return
    _input(program, window, "Mouse", button, DOWN, event.x, event.y)
    place = event.x, event.y
    if isinstance(event, Drag):
        place = desktop().pointer = event.to_x, event.to_y
        _input(program, window, "Motion", *place)
    _input(program, window, "Mouse", button, UP, *place)


def move_pointer(program: Program, window: Window, place: tuple[int, int]) -> None:
    """Move the pointer, with no button pressed."""
    if desktop().pointer != place:
        desktop().pointer = place
        if not window.is_entered:
            window.is_entered = True
            window.call("Entry", TOKENS["GLUT_ENTERED"])
        _input(program, window, "PassiveMotion", *place)


def _choose(program: Program, window: Window, choice: Choice) -> None:
    menu, value = program.menus.choose(list(window.menus.values()), choice.label)
    for status in (TOKENS["GLUT_MENU_IN_USE"], TOKENS["GLUT_MENU_NOT_IN_USE"]):
        if program.menu_state is not None:
            program.menu_state(status)
        if program.menu_status is not None:
            program.menu_status(status, *desktop().pointer)
    before, program.menus.current = program.menus.current, menu
    function = program.menus.all[menu].function
    if function is not None:
        function(value)
    if before in program.menus.all:
        program.menus.current = before
    window.is_posted = True  # the menu has covered a part of it
