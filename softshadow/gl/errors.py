"""GL's errors: recorded for glGetError, and raised unless the context was made with ``raise_errors=False``."""

from __future__ import annotations

from collections.abc import Container
from numbers import Integral
from typing import Any

from softshadow import tokens as gl
from softshadow.context import Context, current, thread
from softshadow.errors import SoftShadowError
from softshadow.tokens import token_name

ERROR_NAMES = (
    "GL_INVALID_ENUM", "GL_INVALID_VALUE", "GL_INVALID_OPERATION", "GL_STACK_OVERFLOW", "GL_STACK_UNDERFLOW",
    "GL_OUT_OF_MEMORY", "GL_INVALID_FRAMEBUFFER_OPERATION",
)  # fmt: skip
FIRST_DISTINCT_TOKEN = 0x100  # numbers below are shared by many tokens: GL_ZERO, GL_FALSE, GL_POINTS ...


class GLError(SoftShadowError):
    """A GL call that failed and changed nothing. All attributes but `operation` are also in PyOpenGL's error.

    Attributes
    ----------
    err : int, GL's error code
    description : str, as gluErrorString describes it; in PyOpenGL bytes, and set only after the error was printed
    baseOperation : str, the call; in PyOpenGL the function
    result : None, since a failed call returns nothing
    operation : str, the call
    """

    result = None

    def __init__(self, err: int, operation: str, message: str) -> None:
        argument, colon, expected = message.partition(": ")
        has_argument = colon and "=" in argument.split(" ")[0]
        text = f"{operation}({argument}): {expected}" if has_argument else f"{operation}: {message}"
        name = token_name(err, ERROR_NAMES)
        super().__init__(f"{name}: {text}")
        self.err, self.operation, self.baseOperation = err, operation, operation
        self.description = name.removeprefix("GL_").replace("ENUM", "ENUMERANT").replace("_", " ").lower()


def fail(code: int, operation: str, message: str) -> Any:
    """Record an error and raise it; return None in a context with ``raise_errors=False``.

    `message` is "argument=value: expected ...", with the value as the caller wrote it.
    """
    context = current()
    if context.error == gl.GL_NO_ERROR:  # GL keeps the first error until glGetError returns it
        context.error = code
    if context.raise_errors:
        raise GLError(code, operation, message)
    return None


def glGetError() -> int:
    """Return the first error since the last glGetError and clear it. Between glBegin and glEnd this is an error."""
    context = current()
    if context.primitive is not None:
        context.error = context.error or gl.GL_INVALID_OPERATION  # recorded only: PyOpenGL does not check this call
        return gl.GL_NO_ERROR
    code, context.error = context.error, gl.GL_NO_ERROR
    return code


def wrong_enum(operation: str, argument: str, value: Any, expected: str) -> Any:
    """Fail with GL_INVALID_ENUM for one argument."""
    is_token = isinstance(value, Integral) and int(value) >= FIRST_DISTINCT_TOKEN
    spelled = token_name(int(value)) if is_token else repr(value)
    return fail(gl.GL_INVALID_ENUM, operation, f"{argument}={spelled}: expected {expected}")


def is_one_of(operation: str, argument: str, value: Any, allowed: Container[int], expected: str) -> bool:
    """Return whether an enum argument is allowed; otherwise the call fails."""
    if value in allowed:
        return True
    wrong_enum(operation, argument, value, expected)
    return False


def outside_begin(operation: str) -> Context | None:
    """Return the current context; between glBegin and glEnd the call fails, and None is returned."""
    context = thread.context
    if context.primitive is None:
        return context
    fail(gl.GL_INVALID_OPERATION, operation, "not allowed between glBegin and glEnd")
    return None


__all__ = ["GLError", "glGetError"]
