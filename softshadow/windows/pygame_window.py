"""pygame's window, events and clock without a screen: what programs with OpenGL use of it.

Images are read by Pillow. The rest of pygame (fonts, sounds, drawing on surfaces) is not here.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from softshadow.windows.desktop import FRAME_MS, desktop
from softshadow.windows.events import BUTTONS, SHIFTED, Click, Drag, Key, Wheel

QUIT, KEYDOWN, KEYUP, MOUSEMOTION, MOUSEBUTTONDOWN, MOUSEBUTTONUP, VIDEORESIZE = 256, 768, 769, 1024, 1025, 1026, 32769
MOUSEWHEEL = 1027
HELD = {"Shift": 1, "Ctrl": 64, "Alt": 256}  # KMOD_LSHIFT and so on
UNSHIFTED = {shifted: key for key, shifted in SHIFTED.items()}
SPECIAL = {
    "Right": 1073741903, "Left": 1073741904, "Down": 1073741905, "Up": 1073741906, "Home": 1073741898,
    "End": 1073741901, "PageUp": 1073741899, "PageDown": 1073741902, "Insert": 1073741897,
    **{f"F{number}": 1073741881 + number for number in range(1, 13)},
}  # fmt: skip
TOKENS: dict[str, int] = {
    "QUIT": QUIT, "KEYDOWN": KEYDOWN, "KEYUP": KEYUP, "MOUSEMOTION": MOUSEMOTION, "MOUSEBUTTONDOWN": MOUSEBUTTONDOWN,
    "MOUSEBUTTONUP": MOUSEBUTTONUP, "MOUSEWHEEL": MOUSEWHEEL,
    "VIDEORESIZE": VIDEORESIZE, "OPENGL": 2, "DOUBLEBUF": 1 << 30, "RESIZABLE": 16,
    "FULLSCREEN": -(1 << 31), "HWSURFACE": 1, "GL_DEPTH_SIZE": 6, "GL_STENCIL_SIZE": 7, "GL_DOUBLEBUFFER": 5,
    "GL_MULTISAMPLEBUFFERS": 13, "GL_MULTISAMPLESAMPLES": 14, "GL_ALPHA_SIZE": 3, "GL_SWAP_CONTROL": 16,
    "KMOD_NONE": 0, "KMOD_SHIFT": 3, "KMOD_CTRL": 192, "KMOD_ALT": 768, "KMOD_LSHIFT": 1, "KMOD_LCTRL": 64,
    "KMOD_LALT": 256, "K_ESCAPE": 27, "K_RETURN": 13, "K_SPACE": 32, "K_TAB": 9, "K_BACKSPACE": 8,
    "K_UP": SPECIAL["Up"],
    "K_DOWN": SPECIAL["Down"], "K_LEFT": SPECIAL["Left"], "K_RIGHT": SPECIAL["Right"], "K_HOME": SPECIAL["Home"],
    "K_END": SPECIAL["End"], "K_PAGEUP": SPECIAL["PageUp"], "K_PAGEDOWN": SPECIAL["PageDown"],
    **{f"K_F{number}": SPECIAL[f"F{number}"] for number in range(1, 13)},
    **{f"K_{chr(code)}": code for code in (*range(97, 123), *range(48, 58))},
}  # fmt: skip


class Surface:
    """An image, as pygame.image.load returns it."""

    def __init__(self, image: Any) -> None:
        self._image = image

    def get_size(self) -> tuple[int, int]:
        """Return (width, height)."""
        size: tuple[int, int] = self._image.size
        return size

    def get_width(self) -> int:
        """Return the width."""
        return self.get_size()[0]

    def get_height(self) -> int:
        """Return the height."""
        return self.get_size()[1]

    def get_rect(self) -> Any:
        """Return a rectangle with width and height."""
        width, height = self.get_size()
        return SimpleNamespace(width=width, height=height, w=width, h=height, size=(width, height), x=0, y=0)

    def convert(self, *_: Any) -> Surface:
        """Return the image itself."""
        return self

    convert_alpha = convert

    def content(self, format: str, flipped: bool) -> bytes:
        """Return the pixels, "RGB" or "RGBA", the top row first or, flipped, the bottom row."""
        from PIL import Image

        image = self._image.convert("RGBA" if format in ("RGBA", "RGBX") else "RGB")
        if flipped:
            image = image.transpose(Image.Transpose.FLIP_TOP_BOTTOM)
        pixels: bytes = image.tobytes()
        return pixels


class Pygame:
    """The state of pygame for one program."""

    def __init__(self) -> None:
        self.pressed: set[int] = set()
        self.held = 0  # modifiers

    def set_mode(self, size: tuple[int, int] = (640, 480), *_: Any, **__: Any) -> Any:
        """Open the window, or return it."""
        if desktop().context is None:
            desktop().open_window(int(size[0]), int(size[1]))
        width, height = desktop().size or size
        return SimpleNamespace(get_size=lambda: (width, height), get_width=lambda: width, get_height=lambda: height)

    def events(self, *_: Any) -> list[Any]:
        """Return what happened since the frame before: a key or a click."""
        self.pressed.clear()
        event = desktop().next_event() if desktop().frame else None
        self.held = 0
        if isinstance(event, Click | Drag):
            return self._mouse(event)
        if isinstance(event, Wheel):
            turned = SimpleNamespace(type=MOUSEWHEEL, x=0, y=event.direction, flipped=False)
            button = {"pos": desktop().pointer, "button": 4 if event.direction > 0 else 5}
            pressed, released = (SimpleNamespace(type=kind, **button) for kind in (MOUSEBUTTONDOWN, MOUSEBUTTONUP))
            return [pressed, released, turned]
        if isinstance(event, Key):
            code = SPECIAL[event.name] if event.is_special else ord(UNSHIFTED.get(event.name, event.name.lower()))
            self.pressed.add(code)
            self.held = sum(HELD[name] for name in event.modifiers)
            text = "" if event.is_special else event.name
            return [SimpleNamespace(type=kind, key=code, unicode=text, mod=self.held) for kind in (KEYDOWN, KEYUP)]
        return []

    def _mouse(self, event: Click | Drag) -> list[Any]:
        """Return a button pressed, moved and released."""
        number = BUTTONS.index(event.button)
        end = (event.to_x, event.to_y) if isinstance(event, Drag) else (event.x, event.y)
        pressed = SimpleNamespace(type=MOUSEBUTTONDOWN, pos=(event.x, event.y), button=number + 1)
        released = SimpleNamespace(type=MOUSEBUTTONUP, pos=end, button=number + 1)
        desktop().pointer = end
        if isinstance(event, Click):
            return [pressed, released]
        buttons = tuple(int(each == number) for each in range(len(BUTTONS)))
        way = end[0] - event.x, end[1] - event.y
        return [pressed, SimpleNamespace(type=MOUSEMOTION, pos=end, rel=way, buttons=buttons), released]

    def key_states(self) -> Any:
        """Return which keys are pressed, by their codes."""
        pressed = self.pressed

        class States:
            def __getitem__(self, code: int) -> bool:
                return code in pressed

        return States()


class Clock:
    """pygame.time.Clock: every frame takes a sixtieth of a second."""

    def tick(self, *_: Any) -> int:
        """Return the milliseconds of a frame."""
        return round(FRAME_MS)

    tick_busy_loop = tick

    def get_fps(self) -> float:
        """Return 60."""
        return 60.0

    def get_time(self) -> int:
        """Return the milliseconds of a frame."""
        return round(FRAME_MS)


def pygame_modules() -> dict[str, dict[str, Any]]:
    """Return the names in pygame's modules, by module."""
    state = Pygame()

    def nothing(*_: Any, **__: Any) -> None:
        return None

    def load(path: Any, *_: Any) -> Surface:
        from PIL import Image

        return Surface(Image.open(path))

    def content(surface: Surface, format: str, flipped: bool = False) -> bytes:
        return surface.content(format, flipped)

    def ticks() -> int:
        return int(desktop().clock_ms)

    display = {
        "init": nothing, "set_mode": state.set_mode, "set_caption": nothing, "set_icon": nothing,
        "flip": lambda: desktop().end_frame(), "update": lambda *_: desktop().end_frame(),
        "gl_set_attribute": nothing, "gl_get_attribute": lambda _: 0, "get_surface": state.set_mode, "quit": nothing,
        "Info": lambda: SimpleNamespace(current_w=1920, current_h=1080), "get_window_size": lambda: desktop().size,
    }  # fmt: skip
    event = {"get": state.events, "poll": lambda: next(iter(state.events()), SimpleNamespace(type=0)),
             "pump": nothing, "set_grab": nothing, "clear": nothing, "set_allowed": nothing}  # fmt: skip
    mouse = {"get_pos": lambda: desktop().pointer, "get_pressed": lambda *_: (0, 0, 0), "get_rel": lambda: (0, 0),
             "set_visible": nothing, "set_pos": nothing}  # fmt: skip
    time = {"Clock": Clock, "get_ticks": ticks, "wait": nothing, "delay": nothing}
    key = {"get_pressed": state.key_states, "get_mods": lambda: state.held, "set_repeat": nothing}
    image = {"load": load, "tostring": content, "tobytes": content}
    return {
        "pygame": {"init": lambda: (6, 0), "quit": nothing, "get_init": lambda: True, "error": RuntimeError,
                   "Surface": Surface, **TOKENS},
        "pygame.locals": dict(TOKENS),
        "pygame.display": display,
        "pygame.event": event,
        "pygame.mouse": mouse,
        "pygame.time": time,
        "pygame.key": key,
        "pygame.image": image,
    }  # fmt: skip
