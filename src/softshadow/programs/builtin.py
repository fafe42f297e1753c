"""The programs that come with the package: `load` puts them into the register, on the first use of any program."""

from functools import cache


@cache
def load() -> None:
    """Register the built-in programs; their kernels compile where they are first drawn with."""
    from softshadow.programs import register
    from softshadow.programs.blinn_phong import BLINN_PHONG
    from softshadow.programs.shadow_map import SHADOW_MAP

    register(BLINN_PHONG)
    register(SHADOW_MAP)
