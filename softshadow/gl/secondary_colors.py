"""The current secondary colour, which GL_COLOR_SUM adds after texturing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from softshadow.context import current
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.conversions import (
    from_byte,
    from_int,
    from_short,
    from_unsigned_byte,
    from_unsigned_int,
    from_unsigned_short,
    vector,
)
from softshadow.gl.vertex_format import carry_attribute, set_attribute


def set_secondary(red: float, green: float, blue: float, alpha: float = 1.0) -> None:
    """Set the current secondary colour; only arrays bring an alpha, which nothing uses."""
    context = current()
    carry_attribute(context, "secondary", 3)
    set_attribute(context, "secondary", 3, (float(red), float(green), float(blue), float(alpha)))


@in_lists
def glSecondaryColor3f(red: float, green: float, blue: float) -> None:
    """Set the current secondary colour."""
    set_secondary(red, green, blue)


@in_lists
def glSecondaryColor3fv(v: Any) -> None:
    """Set the current secondary colour from a vector."""
    set_secondary(*vector(v, 3))


glSecondaryColor3d, glSecondaryColor3dv = glSecondaryColor3f, glSecondaryColor3fv


def _calls_for(convert: Callable[[Any], float]) -> tuple[Callable[..., None], ...]:
    """Return glSecondaryColor3 and glSecondaryColor3v for integers that represent 0 to 1 or -1 to 1."""

    @in_lists
    def three(red: int, green: int, blue: int) -> None:
        """Set the current secondary colour from integers."""
        set_secondary(convert(red), convert(green), convert(blue))

    @in_lists
    def three_of_vector(v: Any) -> None:
        """Set the current secondary colour from a vector of integers."""
        set_secondary(*vector(v, 3, convert))

    return three, three_of_vector


glSecondaryColor3b, glSecondaryColor3bv = _calls_for(from_byte)
glSecondaryColor3ub, glSecondaryColor3ubv = _calls_for(from_unsigned_byte)
glSecondaryColor3s, glSecondaryColor3sv = _calls_for(from_short)
glSecondaryColor3us, glSecondaryColor3usv = _calls_for(from_unsigned_short)
glSecondaryColor3i, glSecondaryColor3iv = _calls_for(from_int)
glSecondaryColor3ui, glSecondaryColor3uiv = _calls_for(from_unsigned_int)


__all__ = spelled_like_gl(globals())
