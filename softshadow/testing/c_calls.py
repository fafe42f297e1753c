"""Calls of Mesa's functions with the arguments that a C program gave them, as a trace holds them.

PyOpenGL knows the C types of the arguments. Its own functions are not used: they convert and check arguments in ways
that a C program does not have.
"""

from __future__ import annotations

import ctypes
import importlib
import pkgutil
import re
from collections.abc import Iterable
from contextlib import suppress
from functools import lru_cache
from typing import Any

# names of framebuffers and renderbuffers that no glGen* call returned are allowed in the calls of the extension only
SAME_CALLS = {"glBindFramebuffer": "glBindFramebufferEXT", "glBindRenderbuffer": "glBindRenderbufferEXT"}
NUMBERS = tuple("bBhHiIlLqQfd?")  # the codes of ctypes for types of numbers
RETURNED_ADDRESSES = ("glMapBuffer", "glMapBufferARB", "glMapBufferRange")


class CCalls:
    """GL's functions in Mesa's library; needs a current context of OSMesa."""

    def __init__(self) -> None:
        from OpenGL.platform import PLATFORM

        self._address_of = PLATFORM.GL.OSMesaGetProcAddress
        self._address_of.restype, self._address_of.argtypes = ctypes.c_void_p, [ctypes.c_char_p]
        self._found: dict[str, tuple[Any, tuple[Any, ...]] | None] = {}

    def call(self, name: str, arguments: Iterable[Any]) -> tuple[Any, list[Any]]:
        """Make a call; return its result, and the arguments in C, whose memory GL may read later.

        Raises
        ------
        LookupError                  there is no such function
        TypeError                    the arguments are not of its types
        """
        name = SAME_CALLS.get(name, name)
        if name not in self._found:
            self._found[name] = self._find(name)
        found = self._found[name]
        if found is None:
            raise LookupError(f"Mesa or PyOpenGL has no {name}")
        function, types = found
        values = list(arguments)
        if len(values) != len(types):
            raise TypeError(f"{name} has {len(types)} arguments, not {len(values)}")
        given = [in_c(value, type) for value, type in zip(values, types, strict=True)]
        return function(*given), given

    def __getattr__(self, name: str) -> Any:
        return lambda *arguments: self.call(name, arguments)[0]

    def _find(self, name: str) -> tuple[Any, tuple[Any, ...]] | None:
        address, types = self._address_of(name.encode()), argument_types(name)
        if not address or types is None:
            return None
        plain = [type if is_number(type) else ctypes.c_void_p for type in types]
        result = ctypes.c_void_p if name in RETURNED_ADDRESSES else ctypes.c_uint
        return ctypes.CFUNCTYPE(result, *plain)(address), types


@lru_cache(32)
def declarations(vendor: str) -> tuple[Any, ...]:
    """Return PyOpenGL's modules with C declarations: the versions of GL ("VERSION"), or a vendor's extensions."""
    try:
        package = importlib.import_module(f"OpenGL.raw.GL.{vendor}")
    except ModuleNotFoundError:
        return ()
    modules = []
    for each in pkgutil.iter_modules(package.__path__):
        with suppress(AttributeError):  # PyOpenGL 3.1.10 has a module that lacks a type
            modules.append(importlib.import_module(f"{package.__name__}.{each.name}"))
    return tuple(modules)


@lru_cache(4096)
def argument_types(name: str) -> tuple[Any, ...] | None:
    """Return the C types of a function's arguments as PyOpenGL declares them, or None."""
    suffix = re.search("(?:ARB|EXT|KHR|OES|NV|NVX|AMD|ATI|SGIS|SGIX|SGI|APPLE|IBM|MESA|INTEL|SUN|GREMEDY)$", name)
    for vendor in ("VERSION", suffix[0] if suffix else "ARB", "KHR"):
        for module in declarations(vendor):
            function = getattr(module, name, None)
            if function is not None:
                return tuple(function.argtypes or ())
    return None


def is_number(type: Any) -> bool:
    """Return whether a C type is a number, not an address."""
    return getattr(type, "_type_", None) in NUMBERS


def in_c(value: Any, type: Any) -> Any:
    """Return a recorded argument as a value for C.

    Examples
    --------
    >>> in_c(1, ctypes.c_float), in_c(True, ctypes.c_ubyte), in_c(None, ctypes.c_void_p)
    (1.0, 1, None)
    >>> list(in_c([1, -0.0], ctypes.POINTER(ctypes.c_float)))
    [1.0, -0.0]
    """
    if is_number(type):
        value = 0 if value is None else value  # not `value or 0`, which would make 0 of -0
        return float(value) if type in (ctypes.c_float, ctypes.c_double) else int(value)
    if value is None or isinstance(value, int):
        return value
    if isinstance(value, str):
        value = value.encode()
    if isinstance(value, bytes):
        return ctypes.create_string_buffer(value, len(value) + 1)
    if not isinstance(value, list):
        raise TypeError(f"a recorded value {value!r:.80} for a pointer")
    element: Any = getattr(type, "_type_", None)
    if not is_number(element):
        if any(isinstance(each, bytes) for each in value):
            raise TypeError("an array of arrays")
        element = ctypes.c_float if any(isinstance(each, float) for each in value) else ctypes.c_int
    return (element * max(1, len(value)))(*(in_c(each, element) for each in value))
