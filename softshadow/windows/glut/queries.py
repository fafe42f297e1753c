"""What glutGet and its relatives return: numbers about the window, the screen and the devices."""

from __future__ import annotations

from softshadow import gl
from softshadow.windows.desktop import desktop
from softshadow.windows.glut.program import Program
from softshadow.windows.glut.tokens import TOKENS
from softshadow.windows.glut.window import SCREEN

VERSION, DIRECT_RENDERING, FULL_SCREEN = 508, 510, 511  # of freeglut; PyOpenGL has no or other numbers for them
SCREEN_MM = 488, 274  # of X servers with 100 dots per inch
# of windows here, whatever glutInitDisplayMode asks for
WINDOW = {
    "BUFFER_SIZE": 32, "STENCIL_SIZE": 8, "DEPTH_SIZE": 24, "RED_SIZE": 8, "GREEN_SIZE": 8, "BLUE_SIZE": 8,
    "ALPHA_SIZE": 8, "ACCUM_RED_SIZE": 16, "ACCUM_GREEN_SIZE": 16, "ACCUM_BLUE_SIZE": 16, "ACCUM_ALPHA_SIZE": 16,
    "RGBA": 1, "COLORMAP_SIZE": 0, "NUM_SAMPLES": 0, "STEREO": 0, "FORMAT_ID": 0, "BORDER_WIDTH": 0, "HEADER_HEIGHT": 0,
}  # fmt: skip
DEVICES = {"GLUT_HAS_KEYBOARD": 1, "GLUT_HAS_MOUSE": 1, "GLUT_NUM_MOUSE_BUTTONS": 5, "GLUT_DEVICE_KEY_REPEAT": 1}
LAYERS = {"GLUT_OVERLAY_DAMAGED": -1}  # there is no overlay


def get(program: Program, token: int) -> int:
    """Return a number about the program; -1 for what freeglut does not know."""
    number = {**_of_the_program(program), **_of_the_window(program)}.get(int(token))
    if number is None:
        desktop().tell(f"glutGet({token}) returns -1: freeglut does not know this token")
        return -1
    return number


def _of_the_program(program: Program) -> dict[int, int]:
    menu = program.menus.entries
    named = {
        "GLUT_ELAPSED_TIME": int(desktop().clock_ms), "GLUT_INIT_STATE": 1, "GLUT_MENU_NUM_ITEMS": len(menu),
        "GLUT_SCREEN_WIDTH": SCREEN[0], "GLUT_SCREEN_HEIGHT": SCREEN[1], "GLUT_SCREEN_WIDTH_MM": SCREEN_MM[0],
        "GLUT_SCREEN_HEIGHT_MM": SCREEN_MM[1], "GLUT_INIT_WINDOW_X": program.asked_position[0],
        "GLUT_INIT_WINDOW_Y": program.asked_position[1], "GLUT_INIT_WINDOW_WIDTH": program.asked_size[0],
        "GLUT_INIT_WINDOW_HEIGHT": program.asked_size[1], "GLUT_INIT_DISPLAY_MODE": program.mode,
        "GLUT_DISPLAY_MODE_POSSIBLE": 1, "GLUT_INIT_MAJOR_VERSION": program.version[0],
        "GLUT_INIT_MINOR_VERSION": program.version[1], "GLUT_INIT_FLAGS": 0, "GLUT_INIT_PROFILE": 0,
        "GLUT_ACTION_ON_WINDOW_CLOSE": program.close_action, "GLUT_RENDERING_CONTEXT": 0, "GLUT_MULTISAMPLE": 4,
        "GLUT_AUX": 1,
    }  # fmt: skip
    return {VERSION: 30400, DIRECT_RENDERING: 2, **{TOKENS[name]: value for name, value in named.items()}}


def _of_the_window(program: Program) -> dict[int, int]:
    window = program.window
    if window is None:
        return {value: 0 for name, value in TOKENS.items() if name.startswith("GLUT_WINDOW_")}
    named = {
        **WINDOW, "X": max(window.position[0], 0), "Y": max(window.position[1], 0), "WIDTH": window.size[0],
        "HEIGHT": window.size[1], "DOUBLEBUFFER": int(bool(window.mode & TOKENS["GLUT_DOUBLE"])),
        "PARENT": window.parent, "CURSOR": window.cursor,
        "NUM_CHILDREN": sum(each.parent == window.number for each in program.windows.values()),
    }  # fmt: skip
    return {
        FULL_SCREEN: int(window.size_before is not None),
        **{TOKENS[f"GLUT_WINDOW_{name}"]: value for name, value in named.items()},
    }


def _named(table: dict[str, int], token: int) -> int:
    return {TOKENS[name]: value for name, value in table.items()}.get(int(token), 0)


def device_get(token: int) -> int:
    """Return a number about the devices: a keyboard and a mouse."""
    return _named(DEVICES, token)


def layer_get(token: int) -> int:
    """Return a number about overlays, of which there are none."""
    return _named(LAYERS, token)


def game_mode_get(program: Program, token: int) -> int:
    """Return a number about the game mode."""
    width, height, depth, rate = program.game_mode
    active = int(program.game_window in program.windows)
    numbers = {
        "ACTIVE": active, "POSSIBLE": 1, "WIDTH": width, "HEIGHT": height, "PIXEL_DEPTH": depth, "REFRESH_RATE": rate,
        "DISPLAY_CHANGED": active,
    }  # fmt: skip
    return _named({f"GLUT_GAME_MODE_{name}": value for name, value in numbers.items()}, token)


def extension_supported(name: str | bytes) -> int:
    """Return 1 for an extension of this OpenGL, else 0."""
    if desktop().context is None:
        return 0
    extensions = gl.glGetString(gl.GL_EXTENSIONS)
    named = name.decode() if isinstance(name, bytes) else name
    return int(named in (extensions.decode() if isinstance(extensions, bytes) else extensions).split())
