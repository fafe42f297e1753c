"""What GLX, WGL, EGL and CGL calls of a trace mean: contexts, which one is current, and where a frame ends."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

from softshadow.traces import Call


class NewContext(NamedTuple):
    """A context was created; `shared` is the address of the context that it shares objects with, or 0."""

    context: int
    shared: int


class MadeCurrent(NamedTuple):
    """A context became its thread's current one; 0 is none."""

    context: int


class Shared(NamedTuple):
    """Two contexts share objects from here on."""

    context: int
    shared: int


class Swapped(NamedTuple):
    """The end of a frame."""


Event = NewContext | MadeCurrent | Shared | Swapped


class ShareGroups:
    """Which contexts share objects: each names one other, and whoever names the same one belongs to its group."""

    def __init__(self) -> None:
        self._named: dict[int, int] = {}

    def note(self, event: NewContext | Shared) -> None:
        """Note with which other context one shares objects; 0 is none."""
        self._named[event.context] = event.shared

    def partner(self, context: int, others: Iterable[int]) -> int | None:
        """Return the first of some other contexts that shares objects with one, or None."""
        group = self._group(context)
        return next((other for other in others if other != context and self._group(other) == group), None)

    def _group(self, context: int) -> int:
        seen = {context}
        while (named := self._named.get(context, 0)) and named not in seen:
            seen.add(named)
            context = named
        return context


SWAPS = (
    "glXSwapBuffers", "glXSwapBuffersMscOML", "wglSwapBuffers", "wglSwapLayerBuffers", "SwapBuffers", "eglSwapBuffers",
    "eglSwapBuffersWithDamageKHR", "eglSwapBuffersWithDamageEXT", "CGLFlushDrawable", "aglSwapBuffers",
    "glFrameTerminatorGREMEDY",
)  # fmt: skip
# the arguments that hold the shared context
CREATIONS = {
    "glXCreateContext": 2, "glXCreateNewContext": 3, "glXCreateContextAttribsARB": 2,
    "glXCreateContextWithConfigSGIX": 3, "wglCreateContextAttribsARB": 1, "eglCreateContext": 2,
}  # fmt: skip
# the arguments that hold the context
CURRENT = {
    "glXMakeCurrent": 2, "glXMakeContextCurrent": 3, "glXMakeCurrentReadSGI": 3, "wglMakeCurrent": 1,
    "wglMakeContextCurrentARB": 2, "eglMakeCurrent": 3,
}  # fmt: skip


def event_of(call: Call) -> Event | None:
    """Return what a call means for contexts and frames, or None."""
    read = READERS.get(call.name)
    return None if read is None else read(call)


def _address(value: Any) -> int:
    """Return an argument as an address: lists hold what a pointer points to."""
    if isinstance(value, list):
        return _address(value[0]) if value else 0
    return value if isinstance(value, int) else 0


def _argument(call: Call, index: int) -> int:
    return _address(call.arguments[index]) if index < len(call.arguments) else 0


def _creation(shared: int) -> Callable[[Call], Event]:
    return lambda call: NewContext(_address(call.result), _argument(call, shared))


def _made_current(context: int) -> Callable[[Call], Event | None]:
    return lambda call: MadeCurrent(_argument(call, context)) if call.result or not call.has_returned else None


READERS: dict[str, Callable[[Call], Event | None]] = {
    **{name: lambda _: Swapped() for name in SWAPS},
    **{name: _creation(shared) for name, shared in CREATIONS.items()},
    **{name: _made_current(context) for name, context in CURRENT.items()},
    "wglCreateContext": lambda call: NewContext(_address(call.result), 0),
    "wglCreateLayerContext": lambda call: NewContext(_address(call.result), 0),
    "wglShareLists": lambda call: Shared(_argument(call, 1), _argument(call, 0)),
    "CGLCreateContext": lambda call: NewContext(_argument(call, 2), _argument(call, 1)),
    "CGLSetCurrentContext": lambda call: MadeCurrent(_argument(call, 0)),  # its result is an error code
}
